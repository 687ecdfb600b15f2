#pragma once

#include <stop_token>
#include <vector>

#include "cli/arguments.h"
#include "cli/outcome.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "vsplit/base/expected.h"

namespace vsplit::cli {

/// The verb on a server: upload, run, and build the mesh here from the records that come; or, with a session, on what is there.
/// A session made here is deleted at the end, also after a failure, unless it is to be kept.
/// \return the server's errors; UNAVAILABLE; INVALID_OPTION.
[[nodiscard]] Expected<Outcome> run_on_server(const Arguments& arguments, const std::vector<Output>& outputs,
                                              ProgressBar& progress, const std::stop_token& stop);

}  // namespace vsplit::cli
