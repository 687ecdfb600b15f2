#include "wire/error_table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "wire/utf8.h"

namespace vsplit::wire {
namespace {

using grpc::StatusCode;

// 400: the request or its bytes break a grammar. 422: well formed, but no mesh that can be worked on.
constexpr std::array kTable{
    ErrorRow{Cause::kEmptyInput, StatusCode::INVALID_ARGUMENT, 400},
    ErrorRow{Cause::kTruncatedInput, StatusCode::INVALID_ARGUMENT, 400},
    ErrorRow{Cause::kMalformedInput, StatusCode::INVALID_ARGUMENT, 400},
    ErrorRow{Cause::kUnknownFormat, StatusCode::INVALID_ARGUMENT, 415},
    ErrorRow{Cause::kInvalidCoordinate, StatusCode::INVALID_ARGUMENT, 422},
    ErrorRow{Cause::kIndexOutOfRange, StatusCode::INVALID_ARGUMENT, 422},
    ErrorRow{Cause::kNonManifold, StatusCode::FAILED_PRECONDITION, 422},
    ErrorRow{Cause::kOpenMesh, StatusCode::FAILED_PRECONDITION, 422},
    ErrorRow{Cause::kLimitExceeded, StatusCode::RESOURCE_EXHAUSTED, 413, 429},
    ErrorRow{Cause::kInvalidOption, StatusCode::INVALID_ARGUMENT, 400},
    ErrorRow{Cause::kUnsupported, StatusCode::UNIMPLEMENTED, 501},
    ErrorRow{Cause::kNotFound, StatusCode::NOT_FOUND, 404},
    ErrorRow{Cause::kNotReady, StatusCode::FAILED_PRECONDITION, 409},
    ErrorRow{Cause::kBusy, StatusCode::ABORTED, 409},
    ErrorRow{Cause::kOutOfOrder, StatusCode::INVALID_ARGUMENT, 400},
    ErrorRow{Cause::kCorrupt, StatusCode::DATA_LOSS, 500},
    ErrorRow{Cause::kFileAccess, StatusCode::INTERNAL, 500},
    ErrorRow{Cause::kUnavailable, StatusCode::UNAVAILABLE, 503},
    ErrorRow{Cause::kCancelled, StatusCode::CANCELLED, 499},
    ErrorRow{Cause::kDeadlineExceeded, StatusCode::DEADLINE_EXCEEDED, 504},
    ErrorRow{Cause::kUnauthenticated, StatusCode::UNAUTHENTICATED, 401},
    ErrorRow{Cause::kForbidden, StatusCode::PERMISSION_DENIED, 403},
    ErrorRow{Cause::kInternal, StatusCode::INTERNAL, 500},
};

constexpr bool in_order_of_causes() {
    for (std::size_t i = 0; i < kTable.size(); ++i) {
        if (static_cast<std::size_t>(kTable[i].cause) != i) return false;
    }
    return kTable.size() == static_cast<std::size_t>(Cause::kInternal) + 1;
}
static_assert(in_order_of_causes(), "every cause has its row, and a cause's number is its row's");

/// What a bare code suggests; several causes share a code, and these are the ones that gRPC itself means.
Cause cause_of_code(StatusCode code) {
    switch (code) {
        case StatusCode::CANCELLED:
            return Cause::kCancelled;
        case StatusCode::DEADLINE_EXCEEDED:
            return Cause::kDeadlineExceeded;
        case StatusCode::UNAVAILABLE:
            return Cause::kUnavailable;
        case StatusCode::NOT_FOUND:
            return Cause::kNotFound;
        case StatusCode::UNIMPLEMENTED:
            return Cause::kUnsupported;
        case StatusCode::RESOURCE_EXHAUSTED:
            return Cause::kLimitExceeded;
        case StatusCode::INVALID_ARGUMENT:
        case StatusCode::OUT_OF_RANGE:
            return Cause::kInvalidOption;
        case StatusCode::FAILED_PRECONDITION:
            return Cause::kNotReady;
        case StatusCode::ABORTED:
            return Cause::kBusy;
        case StatusCode::UNAUTHENTICATED:
            return Cause::kUnauthenticated;
        case StatusCode::PERMISSION_DENIED:
            return Cause::kForbidden;
        case StatusCode::DATA_LOSS:
            return Cause::kCorrupt;
        default:
            return Cause::kInternal;
    }
}

// What the clock of a client can be trusted with, seconds; whatever another server says.
constexpr std::int64_t kLongestRetry = std::int64_t{24} * 3600;

void take_info(const google::rpc::ErrorInfo& info, Error& error) {
    const std::optional<Cause> cause = cause_by_name(info.reason());
    if (!cause) return;
    error.cause = *cause;
    const auto field = info.metadata().find("field");
    if (field != info.metadata().end()) error.field = field->second;
}

}  // namespace

std::span<const ErrorRow> error_table() { return kTable; }

const ErrorRow& error_row(Cause cause) {
    const auto row = static_cast<std::size_t>(cause);
    assert(row < kTable.size());
    return kTable[row];
}

int http_status(const Error& error) {
    const ErrorRow& row = error_row(error.cause);
    return error.retry_after > 0 ? row.http_status_later : row.http_status;
}

std::optional<Cause> cause_by_name(std::string_view name) {
    for (const ErrorRow& row : kTable) {
        if (cause_name(row.cause) == name) return row.cause;
    }
    return std::nullopt;
}

grpc::Status to_status(const Error& error) {
    const StatusCode code = error_row(error.cause).grpc_code;
    const std::string message = valid_utf8(error.message, kMaxMessageBytes);
    google::rpc::ErrorInfo info;
    info.set_reason(std::string(cause_name(error.cause)));
    info.set_domain(std::string(kErrorDomain));
    if (!error.field.empty()) (*info.mutable_metadata())["field"] = valid_utf8(error.field, kMaxMessageBytes);
    google::rpc::Status details;
    details.set_code(code);
    details.set_message(message);
    details.add_details()->PackFrom(info);
    if (error.retry_after > 0) {
        google::rpc::RetryInfo retry;
        retry.mutable_retry_delay()->set_seconds(error.retry_after);
        details.add_details()->PackFrom(retry);
    }
    return {code, message, details.SerializeAsString()};
}

Error from_status(const grpc::Status& status) {
    assert(!status.ok());
    Error error{cause_of_code(status.error_code()), status.error_message(), ""};
    google::rpc::Status details;
    if (status.error_details().empty() || !details.ParseFromString(status.error_details())) return error;
    for (const google::protobuf::Any& detail : details.details()) {
        google::rpc::ErrorInfo info;
        google::rpc::RetryInfo retry;
        if (detail.UnpackTo(&info) && info.domain() == kErrorDomain) {
            take_info(info, error);
        } else if (detail.UnpackTo(&retry)) {
            error.retry_after = static_cast<unsigned>(std::clamp<std::int64_t>(retry.retry_delay().seconds(), 0, kLongestRetry));
        }
    }
    return error;
}

}  // namespace vsplit::wire
