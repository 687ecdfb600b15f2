#pragma once

#include <stop_token>

#include "cli/arguments.h"
#include "cli/outcome.h"
#include "cli/progress_bar.h"
#include "vsplit/base/expected.h"

namespace vsplit::cli {

/// How many of the worst faces `quality` lists.
inline constexpr std::uint32_t kWorstFaces = 20;

/// The verb with the engine in this process. \return what the engine returns; INVALID_OPTION, UNSUPPORTED.
[[nodiscard]] Expected<Outcome> run_locally(const Arguments& arguments, ProgressBar& progress, const std::stop_token& stop);

/// A .vsplit file at a resolution, described. `faces` empty: the one stored.
[[nodiscard]] Expected<Outcome> load_representation(const std::string& path, std::optional<std::uint32_t> faces);

}  // namespace vsplit::cli
