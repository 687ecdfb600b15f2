#include <array>

#include "base/byte_order.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0x82F63B78;
constexpr std::size_t kSlices = 8;

/// tables[k][b]: what byte b, followed by k zero bytes, adds to the checksum.
constexpr std::array<std::array<std::uint32_t, 256>, kSlices> make_tables() {
    std::array<std::array<std::uint32_t, 256>, kSlices> tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t crc = byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? kReflectedPolynomial : 0);
        tables[0][byte] = crc;
    }
    for (std::size_t slice = 1; slice < kSlices; ++slice) {
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t before = tables[slice - 1][byte];
            tables[slice][byte] = before >> 8U ^ tables[0][before & 0xFFU];
        }
    }
    return tables;
}

constexpr auto kTables = make_tables();

// Eight bytes a step (M. Kounavis, F. Berry, "A systematic approach to building high performance software-based CRC generators",
// ISCC 2005); a byte a step would be slower than the wire.
std::uint32_t update_by_tables(std::uint32_t crc, std::span<const std::byte> bytes) {
    for (; bytes.size() >= kSlices; bytes = bytes.subspan(kSlices)) {
        const std::uint64_t eight = load<std::uint64_t>(bytes.data()) ^ crc;
        crc = 0;
        for (std::size_t k = 0; k < kSlices; ++k) crc ^= kTables[kSlices - 1 - k][eight >> (8 * k) & 0xFFU];
    }
    for (const std::byte byte : bytes) crc = crc >> 8U ^ kTables[0][(crc ^ static_cast<std::uint32_t>(byte)) & 0xFFU];
    return crc;
}

#if defined(__x86_64__)
// The processor's own instruction, four times as fast, which all have had since 2008 but which the compiler may not assume.
__attribute__((target("sse4.2"))) std::uint32_t update_by_instruction(std::uint32_t crc, std::span<const std::byte> bytes) {
    std::uint64_t wide = crc;
    for (; bytes.size() >= sizeof(wide); bytes = bytes.subspan(sizeof(wide)))
        wide = __builtin_ia32_crc32di(wide, load<std::uint64_t>(bytes.data()));
    return update_by_tables(static_cast<std::uint32_t>(wide), bytes);
}

std::uint32_t update(std::uint32_t crc, std::span<const std::byte> bytes) {
    static const bool has_instruction = __builtin_cpu_supports("sse4.2") != 0;
    return has_instruction ? update_by_instruction(crc, bytes) : update_by_tables(crc, bytes);
}
#else
std::uint32_t update(std::uint32_t crc, std::span<const std::byte> bytes) { return update_by_tables(crc, bytes); }
#endif

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) { return ~update(~before, bytes); }

}  // namespace vsplit
