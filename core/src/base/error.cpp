#include "vsplit/base/error.h"

namespace vsplit {

std::string_view cause_name(Cause cause) {
    switch (cause) {
        case Cause::kEmptyInput:
            return "EMPTY_INPUT";
        case Cause::kTruncatedInput:
            return "TRUNCATED_INPUT";
        case Cause::kMalformedInput:
            return "MALFORMED_INPUT";
        case Cause::kUnknownFormat:
            return "UNKNOWN_FORMAT";
        case Cause::kInvalidCoordinate:
            return "INVALID_COORDINATE";
        case Cause::kIndexOutOfRange:
            return "INDEX_OUT_OF_RANGE";
        case Cause::kNonManifold:
            return "NON_MANIFOLD";
        case Cause::kOpenMesh:
            return "OPEN_MESH";
        case Cause::kLimitExceeded:
            return "LIMIT_EXCEEDED";
        case Cause::kInvalidOption:
            return "INVALID_OPTION";
        case Cause::kUnsupported:
            return "UNSUPPORTED";
        case Cause::kNotFound:
            return "NOT_FOUND";
        case Cause::kNotReady:
            return "NOT_READY";
        case Cause::kBusy:
            return "BUSY";
        case Cause::kOutOfOrder:
            return "OUT_OF_ORDER";
        case Cause::kCorrupt:
            return "CORRUPT";
        case Cause::kFileAccess:
            return "FILE_ACCESS";
        case Cause::kUnavailable:
            return "UNAVAILABLE";
        case Cause::kCancelled:
            return "CANCELLED";
        case Cause::kDeadlineExceeded:
            return "DEADLINE_EXCEEDED";
        case Cause::kUnauthenticated:
            return "UNAUTHENTICATED";
        case Cause::kForbidden:
            return "FORBIDDEN";
        case Cause::kInternal:
            return "INTERNAL";
    }
    return "INTERNAL";
}

}  // namespace vsplit
