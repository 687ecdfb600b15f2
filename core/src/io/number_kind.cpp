#include "io/number_kind.h"

#include <array>
#include <cstdint>

#include "base/byte_order.h"

namespace vsplit {

std::size_t size_of(NumberKind kind) {
    constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(kind)];
}

bool is_integer(NumberKind kind) { return kind != NumberKind::kFloat32 && kind != NumberKind::kFloat64; }

double load_number(const std::byte* from, NumberKind kind, std::endian order) {
    switch (kind) {
        case NumberKind::kInt8:
            return load<std::int8_t>(from, order);
        case NumberKind::kUint8:
            return load<std::uint8_t>(from, order);
        case NumberKind::kInt16:
            return load<std::int16_t>(from, order);
        case NumberKind::kUint16:
            return load<std::uint16_t>(from, order);
        case NumberKind::kInt32:
            return load<std::int32_t>(from, order);
        case NumberKind::kUint32:
            return load<std::uint32_t>(from, order);
        case NumberKind::kInt64:
            return static_cast<double>(load<std::int64_t>(from, order));
        case NumberKind::kUint64:
            return static_cast<double>(load<std::uint64_t>(from, order));
        case NumberKind::kFloat32:
            return load<float>(from, order);
        case NumberKind::kFloat64:
            break;
    }
    return load<double>(from, order);
}

}  // namespace vsplit
