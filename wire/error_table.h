#pragma once

#include <grpcpp/support/status.h>

#include <optional>
#include <span>
#include <string_view>

#include "vsplit/base/error.h"

namespace vsplit::wire {

/// How a cause is told over gRPC and over HTTP. The one table; both front doors and all clients read it.
struct ErrorRow {
    Cause cause{};
    grpc::StatusCode grpc_code{};
    int http_status = 0;
    int http_status_later = http_status;  ///< for an error that says when to try again
};

/// Domain of the google.rpc.ErrorInfo that every status carries.
inline constexpr std::string_view kErrorDomain = "vsplit";

/// Longest message that travels, in bytes: a status lives in HTTP/2 trailers, which hold 8 KiB.
inline constexpr std::size_t kMaxMessageBytes = 1000;

/// All rows, one a cause, in the order of Cause.
[[nodiscard]] std::span<const ErrorRow> error_table();

/// The row of a cause. O(1).
[[nodiscard]] const ErrorRow& error_row(Cause cause);

/// The HTTP status of an error. O(1).
[[nodiscard]] int http_status(const Error& error);

/// The inverse of cause_name; empty for a name that is none.
[[nodiscard]] std::optional<Cause> cause_by_name(std::string_view name);

/// The status of an error: code from the table, message made valid UTF-8 and cut to kMaxMessageBytes, and as details a
/// google.rpc.Status with ErrorInfo{reason: cause's name, domain: kErrorDomain, metadata["field"] where a field is at fault},
/// and RetryInfo where the error says when to try again.
[[nodiscard]] grpc::Status to_status(const Error& error);

/// The error of a status: cause, field and when to try again from its details, or, where it comes without (from gRPC itself, a
/// proxy, another server), the cause that its code suggests. \pre !status.ok().
[[nodiscard]] Error from_status(const grpc::Status& status);

}  // namespace vsplit::wire
