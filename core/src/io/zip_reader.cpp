#include "io/zip_reader.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/byte_order.h"
#include "io/read_error.h"
#include "io/text_lines.h"
#include "io/zip_layout.h"

namespace vsplit {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{64} * 1024;
constexpr std::uint64_t kMostDeflateRatio = 1032;  // zlib's technical notes

/// The size of the extra field's parts that 32 bits did not hold, in their order.
class Extra64 {
public:
    explicit Extra64(std::span<const std::byte> extra) {
        while (extra.size() >= 4) {
            const auto id = load<std::uint16_t>(extra.data());
            const std::size_t bytes = std::min<std::size_t>(load<std::uint16_t>(extra.data() + 2), extra.size() - 4);
            if (id == zip::kExtra64) numbers_ = extra.subspan(4, bytes);
            extra = extra.subspan(4 + bytes);
        }
    }

    /// `number`, or the next of the 64-bit ones in its place; empty where that is missing.
    [[nodiscard]] std::optional<std::uint64_t> resolve(std::uint32_t number) {
        if (number != zip::kElsewhere) return number;
        if (numbers_.size() < sizeof(std::uint64_t)) return {};
        const auto value = load<std::uint64_t>(numbers_.data());
        numbers_ = numbers_.subspan(sizeof(std::uint64_t));
        return value;
    }

private:
    std::span<const std::byte> numbers_;
};

/// Where the end of the table stands: before a comment that is seldom there.
std::optional<std::size_t> find_table_end(std::span<const std::byte> bytes) {
    if (bytes.size() < zip::kTableEndBytes) return {};
    const std::size_t last = bytes.size() - zip::kTableEndBytes;
    const std::size_t first = last - std::min<std::size_t>(last, 0xFFFF);
    for (std::size_t at = last + 1; at-- > first;) {
        if (load<std::uint32_t>(bytes.data() + at) == zip::kTableEnd) return at;
    }
    return {};
}

struct Table {
    std::uint64_t at = 0;
    std::uint64_t entries = 0;
};

/// Where the table is; by the record for large archives where there is one.
Expected<Table> find_table(std::span<const std::byte> bytes) {
    const std::optional<std::size_t> end = find_table_end(bytes);
    if (!end)
        return read_error(Cause::kTruncatedInput, at_byte(bytes.size()), "the zip archive ends without its table of contents");
    Table table{load<std::uint32_t>(bytes.data() + *end + 16), load<std::uint16_t>(bytes.data() + *end + 10)};
    if (*end < zip::kLocatorBytes) return table;
    const std::byte* locator = bytes.data() + *end - zip::kLocatorBytes;
    if (load<std::uint32_t>(locator) != zip::kTableEnd64Locator) return table;
    const auto at = load<std::uint64_t>(locator + 8);
    const bool there = at <= bytes.size() && bytes.size() - at >= zip::kTableEnd64Bytes;
    if (!there || load<std::uint32_t>(bytes.data() + at) != zip::kTableEnd64)
        return read_error(Cause::kMalformedInput, at_byte(*end), "the zip archive's 64-bit table is not where it is said to be");
    return Table{load<std::uint64_t>(bytes.data() + at + 48), load<std::uint64_t>(bytes.data() + at + 32)};
}

Error entry_error(Cause cause, const ZipEntry& entry, const std::string& what) {
    return read_error(cause, at_byte(static_cast<std::size_t>(entry.at)), quoted(entry.name) + " " + what);
}

}  // namespace

struct ZipStream::State {
    ZipEntry entry;
    std::span<const std::byte> packed;  // still to be taken
    std::uint64_t given = 0;
    uLong crc = 0;
    std::vector<char> piece;
    z_stream zlib{};
    bool inflating = false;

    State(const ZipEntry& e, std::span<const std::byte> bytes) : entry(e), packed(bytes), crc(crc32(0, nullptr, 0)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (inflating) inflateEnd(&zlib);
    }

    [[nodiscard]] Expected<std::string_view> take() {
        Expected<std::string_view> bytes = entry.method == zip::kStored ? take_stored() : inflate_some();
        if (!bytes) return bytes;
        given += bytes->size();
        crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes->data()), static_cast<uInt>(bytes->size()));
        if (given > entry.size) return wrong("unpacks to more bytes than the " + std::to_string(entry.size) + " it claims");
        if (!bytes->empty()) return bytes;
        if (given < entry.size)
            return wrong("unpacks to " + std::to_string(given) + " bytes instead of the " + std::to_string(entry.size) +
                         " it claims");
        if (crc != entry.crc) return wrong("does not have its checksum: it is damaged");
        return bytes;
    }

private:
    [[nodiscard]] Error wrong(const std::string& what) const { return entry_error(Cause::kMalformedInput, entry, what); }

    [[nodiscard]] Expected<std::string_view> take_stored() {
        const std::span<const std::byte> part = packed.first(std::min(packed.size(), kPieceBytes));
        packed = packed.subspan(part.size());
        return as_text(part);
    }

    [[nodiscard]] Expected<std::string_view> inflate_some() {
        if (!inflating) {
            piece.resize(kPieceBytes);
            if (inflateInit2(&zlib, -MAX_WBITS) != Z_OK) return Error{Cause::kLimitExceeded, "not enough memory to unpack", ""};
            inflating = true;
        }
        zlib.next_out = reinterpret_cast<Bytef*>(piece.data());
        zlib.avail_out = static_cast<uInt>(piece.size());
        int result = Z_OK;
        while (zlib.avail_out > 0 && result == Z_OK) {
            const std::size_t part = std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max());
            // zlib takes no const, and does not write to it.
            zlib.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
            zlib.avail_in = static_cast<uInt>(part);
            result = inflate(&zlib, Z_NO_FLUSH);
            packed = packed.subspan(part - zlib.avail_in);
        }
        const std::size_t made = piece.size() - zlib.avail_out;
        if (result == Z_MEM_ERROR) return Error{Cause::kLimitExceeded, "not enough memory to unpack", ""};
        if (result == Z_DATA_ERROR || result == Z_NEED_DICT) return wrong("cannot be unpacked: it is damaged");
        return std::string_view(piece.data(), made);
    }
};

ZipStream::ZipStream(const ZipEntry& entry, std::span<const std::byte> packed) : state_(std::make_unique<State>(entry, packed)) {}
ZipStream::ZipStream(ZipStream&&) noexcept = default;
ZipStream& ZipStream::operator=(ZipStream&&) noexcept = default;
ZipStream::~ZipStream() = default;

Expected<std::string_view> ZipStream::next() { return state_->take(); }

Expected<ZipReader> ZipReader::open(std::span<const std::byte> bytes) {
    ZipReader reader(bytes);
    if (Status read = reader.read_table(); !read) return read.error();
    return reader;
}

Status ZipReader::read_table() {
    const Expected<Table> table = find_table(bytes_);
    if (!table) return table.error();
    if (table->at > bytes_.size() || table->entries > (bytes_.size() - table->at) / zip::kTableEntryBytes) {
        return read_error(Cause::kTruncatedInput, at_byte(bytes_.size()),
                          "the zip archive announces a table of " + std::to_string(table->entries) + " entries at byte " +
                              std::to_string(table->at) + ", which is beyond its end");
    }
    auto at = static_cast<std::size_t>(table->at);
    for (std::uint64_t i = 0; i < table->entries; ++i) {
        const Expected<std::size_t> behind = read_entry(at);
        if (!behind) return behind.error();
        at = *behind;
    }
    return Done{};
}

Expected<std::size_t> ZipReader::read_entry(std::size_t at) {
    const std::byte* from = bytes_.data() + at;
    const std::size_t left = bytes_.size() - at;
    if (left < zip::kTableEntryBytes || load<std::uint32_t>(from) != zip::kTableEntry)
        return read_error(Cause::kMalformedInput, at_byte(at), "expected an entry of the zip archive's table");
    const std::size_t name = load<std::uint16_t>(from + 28);
    const std::size_t extra = load<std::uint16_t>(from + 30);
    const std::size_t all = zip::kTableEntryBytes + name + extra + load<std::uint16_t>(from + 32);
    if (left < all) return read_error(Cause::kTruncatedInput, at_byte(at), "an entry of the zip archive's table is cut off");
    ZipEntry entry;
    entry.name = as_text(bytes_.subspan(at + zip::kTableEntryBytes, name));
    entry.flags = load<std::uint16_t>(from + 8);
    entry.method = load<std::uint16_t>(from + 10);
    entry.crc = load<std::uint32_t>(from + 16);
    Extra64 large(bytes_.subspan(at + zip::kTableEntryBytes + name, extra));
    const std::optional<std::uint64_t> size = large.resolve(load<std::uint32_t>(from + 24));
    const std::optional<std::uint64_t> packed = large.resolve(load<std::uint32_t>(from + 20));
    const std::optional<std::uint64_t> header = large.resolve(load<std::uint32_t>(from + 42));
    if (!size || !packed || !header)
        return read_error(Cause::kMalformedInput, at_byte(at), "an entry of the zip archive's table lacks its 64-bit numbers");
    entry.size = *size;
    entry.packed = *packed;
    entry.at = *header;
    unpacked_size_ += std::min(entry.size, std::numeric_limits<std::uint64_t>::max() - unpacked_size_);
    entries_.try_emplace(upper_case(entry.name), entry);
    return at + all;
}

const ZipEntry* ZipReader::find(std::string_view name) const {
    const auto found = entries_.find(upper_case(name));
    return found == entries_.end() ? nullptr : &found->second;
}

Expected<ZipStream> ZipReader::unpack(const ZipEntry& entry) const {
    if ((entry.flags & 1U) != 0) return entry_error(Cause::kUnsupported, entry, "is encrypted; save the file without a password");
    if (entry.method != zip::kStored && entry.method != zip::kDeflated) {
        return entry_error(Cause::kUnsupported, entry,
                           "is packed by method " + std::to_string(entry.method) + "; read are 0 (stored) and 8 (deflate)");
    }
    const std::uint64_t most =
        entry.method == zip::kStored ? entry.packed : kMostDeflateRatio * std::min(entry.packed, bytes_.size());
    if (entry.size > most) {
        return entry_error(Cause::kMalformedInput, entry,
                           "claims " + std::to_string(entry.size) + " bytes, more than its " + std::to_string(entry.packed) +
                               " packed ones can hold");
    }
    const std::size_t size = bytes_.size();
    if (entry.at > size || size - entry.at < zip::kLocalHeaderBytes)
        return entry_error(Cause::kTruncatedInput, entry, "would begin beyond the file's end");
    const std::byte* from = bytes_.data() + entry.at;
    if (load<std::uint32_t>(from) != zip::kLocalHeader)
        return entry_error(Cause::kMalformedInput, entry, "does not begin with a header of a zip entry");
    const std::uint64_t begin =
        entry.at + zip::kLocalHeaderBytes + load<std::uint16_t>(from + 26) + load<std::uint16_t>(from + 28);
    if (begin > size || size - begin < entry.packed) return entry_error(Cause::kTruncatedInput, entry, "is cut off");
    return ZipStream(entry, bytes_.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(entry.packed)));
}

}  // namespace vsplit
