#include <cstdint>
#include <span>
#include <string>

#include "check.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace {

using namespace vsplit;

// docs/format.md
constexpr std::size_t kHeader = 48;
constexpr std::size_t kBlockHeader = 20;

std::uint32_t get(const std::uint8_t* from) { return from[0] | from[1] << 8U | from[2] << 16U | std::uint32_t{from[3]} << 24U; }

void put(std::uint8_t* to, std::uint32_t value) {
    for (unsigned byte = 0; byte < 4; ++byte) to[byte] = static_cast<std::uint8_t>(value >> (8 * byte));
}

std::uint32_t crc(const std::uint8_t* data, std::size_t size) { return crc32c(std::as_bytes(std::span(data, size))); }

/// Makes the checksums fit: what is behind them is to be tried, and no mutation finds a checksum.
void mend_checksums(std::uint8_t* data, std::size_t size) {
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
