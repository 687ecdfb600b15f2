#include "grpc/method_name.h"

#include <google/protobuf/descriptor.h>

#include <map>
#include <string>

#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::rpc {
namespace {

using Names = std::map<std::string, MethodName, std::less<>>;

Names all_names() {
    Names names;
    const google::protobuf::ServiceDescriptor* const contract =
        google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(v1::Meshing::service_full_name());
    for (int i = 0; i < contract->method_count(); ++i) {
        const std::string& name = contract->method(i)->name();
        names['/' + contract->full_name() + '/' + name] = {MethodName::Kind::kContract, name};
    }
    // Those that gRPC brings.
    for (const char* open : {"grpc.health.v1.Health/Watch", "grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"}) {
        names[std::string("/") + open] = {MethodName::Kind::kOpen, open};
    }
    constexpr const char* kProbe = "grpc.health.v1.Health/Check";
    names[std::string("/") + kProbe] = {MethodName::Kind::kProbe, kProbe};
    return names;
}

}  // namespace

MethodName method_name(std::string_view path) {
    static const Names names = all_names();
    const auto found = names.find(path);
    return found == names.end() ? MethodName{} : found->second;
}

}  // namespace vsplit::rpc
