#pragma once

#include <bit>
#include <cstddef>

namespace vsplit {

/// How files hold a number as bytes. All are doubles once read: integers of 64 bits beyond 2^53 are rounded.
enum class NumberKind { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

/// Bytes of a number.
[[nodiscard]] std::size_t size_of(NumberKind kind);
[[nodiscard]] bool is_integer(NumberKind kind);

/// \pre size_of(kind) bytes are at `from`.
[[nodiscard]] double load_number(const std::byte* from, NumberKind kind, std::endian order);

}  // namespace vsplit
