// Write-ahead logs of SQLite: no more transactions are lost than there are frames, and none less than of the log's beginning.

#include "store/wal_check.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace vsplit;
    constexpr std::size_t kLeastFrame = 24 + 512;
    const auto log = std::as_bytes(std::span(data, size));
    const std::uint64_t lost = store::transactions_lost(log);
    fuzz::check(lost <= 1 + size / kLeastFrame, "a transaction has a frame");
    for (std::size_t part = 1; part < 4; ++part) {
        fuzz::check(store::transactions_lost(log.first(size * part / 4)) <= lost, "a beginning loses no more than all");
    }
    return 0;
}
