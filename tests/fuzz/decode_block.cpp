#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "check.h"
#include "vsplit/mrr/record_block.h"

/// first, count, encoding (u32 each, as this machine has them), a byte whose lowest bit asks for a checksum that fits, the
/// payload.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit;
    constexpr std::size_t kHeader = 13;
    if (size < kHeader) return 0;
    std::array<std::uint32_t, 3> fields{};
    std::memcpy(fields.data(), data, sizeof(fields));
    RecordBlock block{fields[0], fields[1], RecordEncoding{fields[2]}, std::string(data + kHeader, data + size), 0};
    if ((data[kHeader - 1] & 1U) != 0) block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));

    const Expected<RecordList> records = decode_block(block);
    if (!records) {
        fuzz::check(records.error().cause == Cause::kCorrupt, "what is no block is corrupt");
        return 0;
    }
    fuzz::check(records_that_fit(*records, block.encoding) == records->size(), "what came in a block fits one");
    const RecordBlock again = encode_block(*records, block.first, block.encoding);
    fuzz::check(again.payload == block.payload && again.count == block.count && again.crc32c == block.crc32c,
                "a block that was decoded encodes to the same bytes");
    return 0;
}
