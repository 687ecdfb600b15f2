#pragma once

#include <stop_token>

#include "cli/arguments.h"
#include "cli/outcome.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "vsplit/base/expected.h"

namespace vsplit::cli {

/// How many of the worst faces `quality` lists.
inline constexpr std::uint32_t kWorstFaces = 20;

/// The verb with the engine in this process; `outputs` are not written, but refused before a method runs where they cannot be.
/// \return what the engine returns; INVALID_OPTION, UNSUPPORTED.
[[nodiscard]] Expected<Outcome> run_locally(const Arguments& arguments, const std::vector<Output>& outputs, ProgressBar& progress,
                                            const std::stop_token& stop);

/// A .vsplit file at a resolution, described. `faces` empty: the one stored; `unit`: of its lengths, where it does not say it.
[[nodiscard]] Expected<Outcome> load_representation(const std::string& path, std::optional<std::uint32_t> faces,
                                                    std::optional<LengthUnit> unit);

}  // namespace vsplit::cli
