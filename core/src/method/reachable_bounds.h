#pragma once

#include "vsplit/method/method_options.h"

namespace vsplit {

/// Whether any mesh of the source's shape can keep what is asked for, as far as that is certain before a run:
///
/// - A face's longest edge is no longer than its component is, so min_size is not either.
/// - The mean valence of a closed component of genus 2 and more is over 6 at any number of faces, so max_valence is 7 at least.
/// - A frozen boundary keeps its edges, so max_size and sizing.max_size are as long at least.
///
/// \pre `source` is manifold; `options` were checked. \return INVALID_OPTION. O(faces).
[[nodiscard]] Status check_reachable(const TriangleMesh& source, const ControlOptions& options);
[[nodiscard]] Status check_reachable(const TriangleMesh& source, const ImproveOptions& options);

}  // namespace vsplit
