#pragma once

#include <span>
#include <string>

#include "store/blob_store.h"

namespace vsplit::store {

/// SHA-256 of `parts`, one after the other: 64 hexadecimal digits. O(bytes).
[[nodiscard]] std::string sha256(std::span<const Bytes> parts);

}  // namespace vsplit::store
