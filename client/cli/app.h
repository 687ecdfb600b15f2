#pragma once

namespace vsplit::cli {

/// Exit statuses of `vsplit`.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;       ///< the input or an option is at fault, or the run was cancelled
inline constexpr int kExitBoundBroken = 2;  ///< done, but a bound of control could not be met

/// The whole command: parses, runs, writes, prints. \return the exit status. Throws nothing.
[[nodiscard]] int run(int argc, const char* const* argv);

}  // namespace vsplit::cli
