#pragma once

namespace vsplit {

/// A flip turns neither new face away from either old one by more than this, a cosine: 26 degrees. More is a fold or a new bend.
inline constexpr double kLeastFlipCosine = 0.9;

}  // namespace vsplit
