#pragma once

#include <string_view>

namespace vsplit::test {

/// FileDescriptorSet of rest_probe.proto.
[[nodiscard]] std::string_view probe_descriptors();

}  // namespace vsplit::test
