// What core uses of zstd, where zstd itself is not there: the frames of columns are unpacked by who imports this module, and
// nothing is packed.
#include <zstd.h>

#include <cstdint>

#include "base/byte_order.h"

namespace {

/// \return how many bytes it was, which are at `to` when they are `room`; any other number where that is no whole frame.
__attribute__((import_module("decoder"), import_name("unpack_frame"))) extern "C" std::size_t unpack_frame(void* to,
                                                                                                           std::size_t room,
                                                                                                           const void* from,
                                                                                                           std::size_t size);

template <class Number>
unsigned long long number_at(const std::byte* from) {
    return vsplit::load<Number>(from);
}

}  // namespace

ZSTD_CCtx* ZSTD_createCCtx() { return nullptr; }
std::size_t ZSTD_freeCCtx(ZSTD_CCtx* /*context*/) { return 0; }
ZSTD_DCtx* ZSTD_createDCtx() { return nullptr; }
std::size_t ZSTD_freeDCtx(ZSTD_DCtx* /*context*/) { return 0; }

std::size_t ZSTD_decompressDCtx(ZSTD_DCtx* /*context*/, void* to, std::size_t room, const void* from, std::size_t size) {
    return unpack_frame(to, room, from, size);
}

/// RFC 8878, 3.1.1.1.
unsigned long long ZSTD_getFrameContentSize(const void* from, std::size_t size) {
    const auto* const frame = static_cast<const std::byte*>(from);
    constexpr std::size_t kDescriptorAt = 4;
    if (size < kDescriptorAt + 2 || vsplit::load<std::uint32_t>(frame) != ZSTD_MAGICNUMBER) return ZSTD_CONTENTSIZE_ERROR;
    const auto descriptor = static_cast<unsigned>(frame[kDescriptorAt]);
    const bool single = (descriptor >> 5U & 1U) != 0;
    const unsigned width = descriptor >> 6U == 0 ? (single ? 1 : 0) : 1U << (descriptor >> 6U);
    constexpr unsigned kDictionaryBytes[] = {0, 1, 2, 4};
    const std::size_t at = kDescriptorAt + (single ? 1 : 2) + kDictionaryBytes[descriptor & 3U];
    if (width == 0) return ZSTD_CONTENTSIZE_UNKNOWN;
    if (at + width > size) return ZSTD_CONTENTSIZE_ERROR;
    if (width == 1) return number_at<std::uint8_t>(frame + at);
    if (width == 2) return number_at<std::uint16_t>(frame + at) + 256;
    return width == 4 ? number_at<std::uint32_t>(frame + at) : number_at<std::uint64_t>(frame + at);
}
