#include <cstdint>
#include <span>
#include <string>

#include "check.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace {

using namespace vsplit;

std::uint32_t get(const std::uint8_t* from) { return from[0] | from[1] << 8U | from[2] << 16U | std::uint32_t{from[3]} << 24U; }

void put(std::uint8_t* to, std::uint32_t value) {
    for (unsigned byte = 0; byte < 4; ++byte) to[byte] = static_cast<std::uint8_t>(value >> (8 * byte));
}

std::uint32_t crc(const std::uint8_t* data, std::size_t size) { return crc32c(std::as_bytes(std::span(data, size))); }

// Checksums are made to fit: what is behind them is to be tried, and no mutation finds one. Offsets are those of docs/format.md.

void mend_version_1(std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHeader = 48, kBlockHeader = 20;
    if (size < kHeader) return;
    const std::uint64_t base = 24 * std::uint64_t{get(data + 12)} + 12 * std::uint64_t{get(data + 16)} + get(data + 36);
    if (base <= size - kHeader) {
        put(data + 40, crc(data + kHeader, base));
        for (std::size_t at = kHeader + base; size - at >= kBlockHeader;) {
            const std::uint64_t payload = get(data + at + 12);
            if (payload > size - at - kBlockHeader) break;
            put(data + at + 16, crc(data + at + kBlockHeader, payload));
            at += kBlockHeader + payload;
        }
    }
    put(data + 44, crc(data, 44));
}

/// Sizes too: the file's, and where blocks begin.
void mend_version_2(std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHeader = 208, kEntry = 40;
    if (size < kHeader) return;
    put(data + 192, static_cast<std::uint32_t>(size));
    put(data + 196, 0);
    const std::uint64_t index_at = kHeader + std::uint64_t{get(data + 56)} + get(data + 36);
    const std::uint64_t blocks_at = index_at + kEntry * std::uint64_t{get(data + 40)};
    if (get(data + 60) == 0 && blocks_at <= size) {
        std::uint64_t block_at = blocks_at;
        for (std::uint64_t entry = index_at; entry < blocks_at; entry += kEntry) {
            const std::uint64_t payload = get(data + entry + 32);
            if (payload > size - block_at) break;
            put(data + entry + 24, static_cast<std::uint32_t>(block_at));
            put(data + entry + 28, 0);
            put(data + entry + 36, crc(data + block_at, payload));
            block_at += payload;
        }
        put(data + 200, crc(data + kHeader, blocks_at - kHeader));
    }
    put(data + 204, crc(data, 204));
}

void mend_checksums(std::uint8_t* data, std::size_t size) {
    if (size < 12) return;
    if (get(data + 8) == 1) mend_version_1(data, size);
    if (get(data + 8) == 2) mend_version_2(data, size);
}

}  // namespace

// libFuzzer gives these their names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
    const std::size_t changed = LLVMFuzzerMutate(data, size, max_size);
    if (seed % 8 != 0) mend_checksums(data, changed);
    return changed;
}

// NOLINTEND(readability-identifier-naming)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Expected<StoredMrr> stored = decode_mrr(std::as_bytes(std::span(data, size)));
    if (!stored) {
        fuzz::check(!stored.error().message.empty(), "an error has a message");
        return 0;
    }
    const std::string again = encode_mrr(*stored);
    const Expected<StoredMrr> twice = decode_mrr(std::as_bytes(std::span(again)));
    fuzz::check(twice && encode_mrr(*twice) == again, "what was decoded is encoded and decoded again");
    const MultiresMesh& mrr = stored->mrr;
    const TriangleMesh finest = mesh_at(mrr, mrr.levels());
    fuzz::check(finest.face_count() == mrr.faces_max(), "every record of a decoded file can be applied");
    fuzz::check(mesh_at(mrr, 0).face_count() == mrr.faces_min(), "the base has the faces it says");
    fuzz::check(mrr.level_for(mrr.faces_max()) == mrr.levels(), "every level is found by its faces");
    return 0;
}
