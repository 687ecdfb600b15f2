#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit {

/// A file in a zip archive, as the archive's table tells of it.
struct ZipEntry {
    std::string_view name;
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
    std::uint32_t crc = 0;
    std::uint64_t packed = 0;  ///< bytes in the archive
    std::uint64_t size = 0;    ///< bytes unpacked
    std::uint64_t at = 0;      ///< of its header in the archive
};

/// The bytes of an entry, unpacked a piece at a time: it takes the same little memory whatever the entry holds.
class ZipStream {
public:
    ZipStream(const ZipEntry& entry, std::span<const std::byte> packed);
    ZipStream(ZipStream&&) noexcept;
    ZipStream& operator=(ZipStream&&) noexcept;
    ZipStream(const ZipStream&) = delete;
    ZipStream& operator=(const ZipStream&) = delete;
    ~ZipStream();

    /// The next bytes; valid until the next call. Empty at the end, where there were as many as the table tells and their
    /// checksum is right. \return MALFORMED_INPUT, TRUNCATED_INPUT.
    [[nodiscard]] Expected<std::string_view> next();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A zip archive in memory. What its table claims is checked against the bytes that are there before anything is unpacked.
class ZipReader {
public:
    /// \return TRUNCATED_INPUT, MALFORMED_INPUT with the byte. O(entries).
    [[nodiscard]] static Expected<ZipReader> open(std::span<const std::byte> bytes);

    /// By name, in any case, the first of two; null where there is none. O(log entries).
    [[nodiscard]] const ZipEntry* find(std::string_view name) const;

    /// Bytes of all entries, unpacked, by what the table claims.
    [[nodiscard]] std::uint64_t unpacked_size() const { return unpacked_size_; }

    /// \return UNSUPPORTED for one that is encrypted or packed otherwise than by deflate; MALFORMED_INPUT for one that claims
    /// more bytes than deflate can make of those that are there; TRUNCATED_INPUT.
    [[nodiscard]] Expected<ZipStream> unpack(const ZipEntry& entry) const;

private:
    explicit ZipReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] Status read_table();
    [[nodiscard]] Expected<std::size_t> read_entry(std::size_t at);

    std::span<const std::byte> bytes_;
    std::map<std::string, ZipEntry> entries_;  // by name in upper case
    std::uint64_t unpacked_size_ = 0;
};

}  // namespace vsplit
