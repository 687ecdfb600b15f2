#include "rest/schema.h"

#include <google/protobuf/descriptor.pb.h>

#include "google/api/annotations.pb.h"

namespace vsplit::rest {
namespace pb = google::protobuf;

Expected<std::unique_ptr<Schema>> Schema::make(std::span<const std::string_view> descriptor_sets,
                                               std::span<const std::string> services) {
    std::unique_ptr<Schema> schema(new Schema());
    for (const std::string_view bytes : descriptor_sets) {
        pb::FileDescriptorSet set;
        if (!set.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
            return Error{Cause::kMalformedInput, "not a FileDescriptorSet", ""};
        }
        for (const pb::FileDescriptorProto& file : set.file()) {
            if (schema->pool_.FindFileByName(file.name()) != nullptr) continue;
            if (schema->pool_.BuildFile(file) == nullptr) {
                return Error{Cause::kMalformedInput, "the descriptors of " + file.name() + " do not fit together", ""};
            }
        }
    }
    for (const std::string& name : services) {
        const pb::ServiceDescriptor* const service = schema->pool_.FindServiceByName(name);
        if (service == nullptr) return Error{Cause::kNotFound, "no descriptor of the service " + name, ""};
        schema->services_.push_back(service);
    }
    return schema;
}

const pb::MethodDescriptor* Schema::find_rpc(const std::string& full_name) const { return pool_.FindMethodByName(full_name); }

std::unique_ptr<pb::Message> Schema::new_message(const pb::Descriptor* type) const {
    return std::unique_ptr<pb::Message>(factory_.GetPrototype(type)->New());
}

}  // namespace vsplit::rest
