#pragma once

namespace vsplit {

/// A flip turns neither new face away from either old one by more than this, a cosine: 26 degrees. More is a fold or a new bend.
inline constexpr double kLeastFlipCosine = 0.9;

/// Gains of stretch below this are not worth a record.
inline constexpr double kLeastGain = 2e-4;

}  // namespace vsplit
