#include "grpc/stranger_check.h"

#include <google/protobuf/descriptor.h>

#include <string>
#include <utility>

#include "vsplit/v1/meshing.grpc.pb.h"
#include "wire/error_table.h"

namespace vsplit::rpc {
namespace {

/// Null for a path that is no rpc of the contract.
const google::protobuf::MethodDescriptor* rpc_at(std::string_view path) {
    static const google::protobuf::ServiceDescriptor* const contract =
        google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(v1::Meshing::service_full_name());
    static const std::string ours = '/' + contract->full_name() + '/';
    if (!path.starts_with(ours)) return nullptr;
    return contract->FindMethodByName(std::string(path.substr(ours.size())));
}

}  // namespace

StrangerCheck::StrangerCheck(RpcObserver observer, guard::Gatekeeper* gate, RpcMeter* meter)
    : observer_(std::move(observer)), gate_(gate), meter_(meter) {}

grpc::Status StrangerCheck::look(const HeaderLookup& header) const {
    if (gate_ == nullptr) return {};
    const google::protobuf::MethodDescriptor* const rpc = rpc_at(header(":path"));
    if (rpc == nullptr) return {};
    const Status known = gate_->recognise(header("authorization"));
    if (known) return {};
    grpc::Status refused = wire::to_status(known.error());
    if (meter_ != nullptr) {
        meter_->rpc_began(rpc->name());
        meter_->rpc_ended(rpc->name(), refused.error_code(), {});
    }
    if (observer_) {
        RpcRecord record{rpc->name(), "", refused};
        record.origin = origin_of(header, "");
        record.origin.authorization.clear();
        observer_(record);
    }
    return refused;
}

}  // namespace vsplit::rpc
