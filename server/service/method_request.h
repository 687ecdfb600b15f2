#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "vsplit/method/method_options.h"

namespace vsplit::service {

/// A mesh of a session: the upload, or one of its representations at a resolution.
struct MeshRef {
    std::string representation;  ///< empty: the upload
    std::uint32_t faces = 0;     ///< 0: the resolution the representation was made for; the upload has but one

    friend bool operator==(const MeshRef&, const MeshRef&) = default;
};

/// A method to run in a session.
struct MethodRequest {
    MeshRef source;
    MethodOptions options;

    friend bool operator==(const MethodRequest&, const MethodRequest&) = default;
};

}  // namespace vsplit::service
