#pragma once

#include <string>
#include <string_view>

namespace vsplit {

/// What went wrong, by name. One list for the engine, the service, both front doors and the command line;
/// `wire/error_table.h` maps each cause to a gRPC code and an HTTP status.
enum class Cause {
    kEmptyInput,         ///< No bytes, or no faces.
    kTruncatedInput,     ///< The bytes end before what their header announces.
    kMalformedInput,     ///< The bytes break their format's grammar.
    kUnknownFormat,      ///< The bytes are of no format that is read here.
    kInvalidCoordinate,  ///< A coordinate is NaN, infinite, or too large to compute with.
    kIndexOutOfRange,    ///< A face names a vertex that does not exist.
    kNonManifold,        ///< An edge with more than two faces, a vertex with more than one fan, or faces that disagree on a side.
    kOpenMesh,           ///< The mesh has boundary edges.
    kLimitExceeded,      ///< More bytes, faces, sessions or jobs than a limit allows.
    kInvalidOption,      ///< An option out of its range, or two options that contradict each other.
    kUnsupported,        ///< Valid, but not offered by this version.
    kNotFound,           ///< No such session, representation or file.
    kNotReady,           ///< The session has no mesh yet.
    kBusy,               ///< The session is at work on something that excludes the request.
    kOutOfOrder,         ///< A stream's part does not follow the one before it.
    kCorrupt,            ///< A checksum or an invariant of stored data does not hold.
    kFileAccess,         ///< The operating system refused a read or a write.
    kUnavailable,        ///< A server cannot be reached, or is shutting down.
    kCancelled,          ///< The caller asked to stop.
    kDeadlineExceeded,   ///< The caller's deadline passed.
    kUnauthenticated,    ///< The call does not say who makes it, or not in a way that is believed.
    kForbidden,          ///< Who makes the call may not do this.
    kInternal,           ///< A defect of this program.
};

/// The cause's name in UPPER_SNAKE_CASE, as it appears in messages and on the wire, e.g. "NON_MANIFOLD".
[[nodiscard]] std::string_view cause_name(Cause cause);

/// A failure that a person can act on: the message says what was wrong, where (line, byte, face index) and what would be
/// accepted. `field` names the option or request field at fault, in snake_case, or is empty.
struct Error {
    Cause cause = Cause::kInternal;
    std::string message;
    std::string field;
    /// Seconds after which the same request may well succeed; 0 where waiting does not help.
    unsigned retry_after = 0;
};

}  // namespace vsplit
