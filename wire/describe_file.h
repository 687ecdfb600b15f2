#pragma once

namespace vsplit::wire {

/// Metadata of a call that is answered with a file: what is known of it without making it, and no bytes, is all that is wanted.
/// Its value says nothing.
inline constexpr const char* kDescribeFileKey = "vsplit-describe-file";

}  // namespace vsplit::wire
