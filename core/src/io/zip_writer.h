#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vsplit {

/// Writes a zip archive into memory, entries deflated, without times: the same entries give the same bytes.
class ZipWriter {
public:
    /// `most_in_32_bits`: sizes and places beyond it are written as 64-bit numbers.
    explicit ZipWriter(std::uint64_t most_in_32_bits = 0xFFFFFFFE);
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;
    ~ZipWriter();

    /// Begins an entry; the one before is done. At most 65,535.
    void begin(std::string_view name);

    /// Bytes of the entry. \pre begun.
    void add(std::string_view bytes);

    /// The archive. Nothing may be added after.
    [[nodiscard]] std::string take();

private:
    struct Deflater;
    struct Entry {
        std::string name;
        std::uint32_t crc = 0;
        std::uint64_t packed = 0;
        std::uint64_t size = 0;
        std::uint64_t at = 0;
    };

    void end();
    void put_facts(const Entry& entry, bool large);
    void put_table_entry(const Entry& entry);
    void put_large_table_end(std::uint64_t at, std::uint64_t bytes);
    [[nodiscard]] std::uint32_t low(std::uint64_t number) const;
    [[nodiscard]] std::string extra_of(std::initializer_list<std::uint64_t> numbers) const;

    std::uint64_t most_;
    std::string bytes_;
    std::vector<Entry> entries_;
    Entry entry_;  // the one that is begun, and its bytes so far
    std::string packed_;
    std::unique_ptr<Deflater> deflater_;
};

}  // namespace vsplit
