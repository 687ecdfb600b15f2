#pragma once

#include <grpcpp/support/status.h>

#include <string>
#include <string_view>

#include "vsplit/base/error.h"

namespace vsplit::rest {

/// What a request that fails is answered with: RFC 9457's application/problem+json, with the cause, words and field that gRPC
/// tells too.
struct Problem {
    Error error;
    unsigned status = 0;
    std::string allow = {};          ///< methods that the path has, where that is what was wrong
    std::string content_range = {};  ///< of a file whose range that was asked for does not exist
};

inline constexpr std::string_view kProblemType = "application/problem+json";

/// The HTTP status is that of the one table, wire/error_table.h.
[[nodiscard]] Problem problem_of(const Error& error);

/// \pre !status.ok().
[[nodiscard]] Problem problem_of(const grpc::Status& status);

/// For what HTTP itself has a status for and the engine no cause.
[[nodiscard]] Problem http_problem(unsigned status, Cause cause, std::string message, std::string field = "");

/// {"title", "status", "detail", "cause"} and "field" and "retryAfter" where there are such.
[[nodiscard]] std::string problem_json(const Problem& problem);

}  // namespace vsplit::rest
