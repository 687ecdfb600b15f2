#pragma once

#include <string_view>

namespace vsplit::rpc {

/// What the server calls the rpc at "/package.Service/Method".
struct MethodName {
    enum class Kind {
        kContract,
        kProbe,  ///< is answered at once, and to everybody, or the server is taken for dead
        kOpen,   ///< stays for as long as its client likes
        kUnknown
    };

    Kind kind = Kind::kUnknown;
    /// "Improve" for an rpc of vsplit.v1.Meshing, "grpc.health.v1.Health/Check" for one of gRPC's own, which need no token, and
    /// "(unknown)" for any other: a name that a client made up would be one more label of metrics. Lives as long as the program.
    std::string_view text = "(unknown)";
};

/// O(log methods).
[[nodiscard]] MethodName method_name(std::string_view path);

}  // namespace vsplit::rpc
