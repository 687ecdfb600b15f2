#pragma once

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "vsplit/base/error.h"

namespace vsplit {

/// What the system said (`errno`) when it refused to do `what` ("open", "write") with `path`.
[[nodiscard]] inline Error file_error(std::string_view what, const std::filesystem::path& path, int reason = errno) {
    const Cause cause = reason == ENOENT ? Cause::kNotFound : Cause::kFileAccess;
    return {cause, "cannot " + std::string(what) + " '" + path.string() + "': " + std::generic_category().message(reason), ""};
}

}  // namespace vsplit
