#include "store/wal_check.h"

#include <algorithm>
#include <bit>

namespace vsplit::store {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kHeader = 32;
constexpr std::size_t kFrameHeader = 24;
constexpr std::uint32_t kMagic = 0x377f0682;  // its last bit: checksums are of big-endian words
constexpr std::uint32_t kFormat = 3'007'000;
constexpr std::uint32_t kLeastPage = 512, kMostPage = 65536;  // powers of two

std::uint32_t word(Bytes bytes, std::size_t at, bool big_endian = true) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = value << 8U | std::to_integer<std::uint32_t>(bytes[at + (big_endian ? i : 3 - i)]);
    }
    return value;
}

struct Checksum {
    std::uint32_t a = 0;
    std::uint32_t b = 0;

    void add(Bytes bytes, bool big_endian) {
        for (std::size_t at = 0; at < bytes.size(); at += 8) {
            a += word(bytes, at, big_endian) + b;
            b += word(bytes, at + 4, big_endian) + a;
        }
    }

    [[nodiscard]] bool is_at(Bytes bytes, std::size_t at) const { return a == word(bytes, at) && b == word(bytes, at + 4); }
};

struct Header {
    std::size_t page = 0;  // bytes; 0: the header is damaged
    bool big_endian = false;
    Checksum checksum;
};

Header read_header(Bytes log) {
    Header header;
    header.big_endian = (word(log, 0) & 1U) != 0;
    header.checksum.add(log.first(24), header.big_endian);
    const bool sound = (word(log, 0) & ~1U) == kMagic && word(log, 4) == kFormat && header.checksum.is_at(log, 24);
    const std::uint32_t page = word(log, 8);
    if (sound && std::has_single_bit(page) && page >= kLeastPage && page <= kMostPage) header.page = page;
    return header;
}

}  // namespace

std::uint64_t transactions_lost(Bytes log) {
    if (log.size() <= kHeader) return 0;
    const Header header = read_header(log);
    const auto is_empty = [](std::byte byte) { return byte == std::byte{0}; };
    if (header.page == 0) return std::all_of(log.begin() + kHeader, log.end(), is_empty) ? 0 : 1;
    Checksum checksum = header.checksum;
    bool sound = true;
    std::uint64_t lost = 0;
    const std::size_t size = kFrameHeader + header.page;
    for (std::size_t at = kHeader; at + size <= log.size(); at += size) {
        const Bytes frame = log.subspan(at, size);
        const bool of_this_log = std::equal(frame.begin() + 8, frame.begin() + 16, log.begin() + 16);
        if (sound) {
            checksum.add(frame.first(8), header.big_endian);
            checksum.add(frame.subspan(kFrameHeader), header.big_endian);
            sound = of_this_log && word(frame, 0) != 0 && checksum.is_at(frame, 16);
            continue;  // the end of the transaction that the first bad frame is of may be what a crash cut short
        }
        if (of_this_log && word(frame, 4) != 0) ++lost;
    }
    return lost;
}

}  // namespace vsplit::store
