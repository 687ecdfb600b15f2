#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::rest {

/// The services that REST offers, with their comments: what protoc wrote about them, and nothing else. Thread-safe.
class Schema {
public:
    using Services = std::vector<const google::protobuf::ServiceDescriptor*>;

    /// From FileDescriptorSets with imports and source info; a file that is in several is taken from the first. `services` are
    /// full names. \return MALFORMED_INPUT, NOT_FOUND.
    [[nodiscard]] static Expected<std::unique_ptr<Schema>> make(std::span<const std::string_view> descriptor_sets,
                                                                std::span<const std::string> services);

    [[nodiscard]] const Services& services() const { return services_; }

    /// The rpc of this full name; null when there is none.
    [[nodiscard]] const google::protobuf::MethodDescriptor* find_rpc(const std::string& full_name) const;

    /// An empty message.
    [[nodiscard]] std::unique_ptr<google::protobuf::Message> new_message(const google::protobuf::Descriptor* type) const;

private:
    Schema() = default;

    google::protobuf::DescriptorPool pool_;
    mutable google::protobuf::DynamicMessageFactory factory_;
    Services services_;
};

/// The contract as it was when this was built.
[[nodiscard]] std::string_view contract_descriptors();

}  // namespace vsplit::rest
