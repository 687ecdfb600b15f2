#include "cli/input_check.h"

#include "vsplit/repair/repair_mesh.h"

namespace vsplit::cli {
namespace {

/// What is read here: IN, and what it is compared with.
bool reads_mesh(const Arguments& a) {
    if (!a.session.empty()) return false;
    return !is_representation_file(a.input) || (!a.against.empty() && !is_representation_file(a.against));
}

bool is_about_content(const Error& error) {
    switch (error.cause) {
        case Cause::kEmptyInput:
        case Cause::kTruncatedInput:
        case Cause::kMalformedInput:
        case Cause::kUnknownFormat:
        case Cause::kInvalidCoordinate:
        case Cause::kIndexOutOfRange:
        case Cause::kUnsupported:
        case Cause::kCorrupt:
            return true;
        case Cause::kLimitExceeded:
            return error.retry_after == 0;  // a server has limits of other things too, which pass
        default:
            return false;
    }
}

}  // namespace

Status check_reading(const Arguments& a) {
    if (Status full = check_options({.mode = a.repair == v1::FULL ? RepairMode::kFull : RepairMode::kNone,
                                     .stitch = a.stitch,
                                     .hole_size = a.hole_size,
                                     .speck_size = a.speck_size});
        !full)
        return full;
    const bool repairs = a.repair != v1::REPAIR_UNSPECIFIED;
    if ((!repairs && a.weld == 0) || reads_mesh(a)) return Done{};
    const std::string what = a.session.empty() ? "a .vsplit file holds" : "the session holds";
    return Error{Cause::kInvalidOption,
                 what + " a mesh as it was welded and repaired when it was read; accepted where a mesh file is read",
                 repairs ? "repair" : "weld"};
}

Error in_file(Error error, const std::string& path) {
    if (is_about_content(error)) error.message = path + ": " + error.message;
    return error;
}

}  // namespace vsplit::cli
