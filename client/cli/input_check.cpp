#include "cli/input_check.h"

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
    const bool repairs = a.repair != v1::REPAIR_UNSPECIFIED;
    if ((!repairs && a.weld == 0) || reads_mesh(a)) return Done{};
    const std::string what = a.session.empty() ? "a .vsplit file holds" : "the session holds";
    return Error{Cause::kInvalidOption,
                 what + " a mesh as it was welded and repaired when it was read; accepted where a mesh file is read",
                 repairs ? "repair" : "weld"};
}

Error in_file(Error error, const std::string& path) {
    const bool names_it = error.message.find(path) != std::string::npos;
    if (is_about_content(error) && !names_it) error.message = path + ": " + error.message;
    return error;
}

}  // namespace vsplit::cli
