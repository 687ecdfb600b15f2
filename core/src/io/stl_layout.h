#pragma once

#include <cstddef>

namespace vsplit {

/// A binary STL: a header, a count (u32), then facets of a normal and three corners (12 f32) and an attribute (u16), all
/// little-endian.
inline constexpr std::size_t kStlHeaderBytes = 80;
inline constexpr std::size_t kStlCountBytes = 4;
inline constexpr std::size_t kStlFacetsAt = kStlHeaderBytes + kStlCountBytes;
inline constexpr std::size_t kStlPointBytes = 12;
inline constexpr std::size_t kStlFacetBytes = 50;

}  // namespace vsplit
