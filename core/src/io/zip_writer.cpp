#include "io/zip_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "base/byte_order.h"
#include "io/zip_layout.h"

namespace vsplit {
namespace {

constexpr std::uint16_t kVersion = 20;    // what a reader must know: deflate
constexpr std::uint16_t kVersion64 = 45;  // and 64-bit sizes
constexpr std::uint16_t kUtf8Name = 1U << 11U;
constexpr std::uint32_t kNoTime = 0x00210000;  // 1 January 1980, 0:00: the first that can be written

template <class T>
void put(std::string& bytes, T number) {
    std::array<char, sizeof(T)> raw{};
    store(raw.data(), number);
    bytes.append(raw.data(), raw.size());
}

}  // namespace

struct ZipWriter::Deflater {
    z_stream zlib{};

    Deflater() {
        if (deflateInit2(&zlib, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
    ~Deflater() { deflateEnd(&zlib); }

    void run(std::string_view in, int flush, std::string& out) {
        std::array<char, 16384> piece;
        // zlib takes no const, and does not write to it.
        zlib.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(in.data()));
        zlib.avail_in = static_cast<uInt>(in.size());
        do {
            zlib.next_out = reinterpret_cast<Bytef*>(piece.data());
            zlib.avail_out = static_cast<uInt>(piece.size());
            deflate(&zlib, flush);
            out.append(piece.data(), piece.size() - zlib.avail_out);
        } while (zlib.avail_out == 0);
    }
};

ZipWriter::ZipWriter(std::uint64_t most_in_32_bits) : most_(most_in_32_bits) {}
ZipWriter::~ZipWriter() = default;

void ZipWriter::begin(std::string_view name) {
    end();
    entry_.name = name;
    entry_.crc = static_cast<std::uint32_t>(crc32(0, nullptr, 0));
    deflater_ = std::make_unique<Deflater>();
}

void ZipWriter::add(std::string_view bytes) {
    constexpr std::size_t kMost = std::size_t{1} << 30U;  // zlib counts in 32 bits
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kMost))) {
        const std::string_view part = bytes.substr(0, kMost);
        entry_.crc = static_cast<std::uint32_t>(
            crc32(entry_.crc, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(part.size())));
        entry_.size += part.size();
        deflater_->run(part, Z_NO_FLUSH, packed_);
    }
}

/// Sizes are known now: the header goes before the bytes.
void ZipWriter::end() {
    if (!deflater_) return;
    deflater_->run({}, Z_FINISH, packed_);
    deflater_.reset();
    entry_.packed = packed_.size();
    entry_.at = bytes_.size();
    const std::string extra = extra_of({entry_.size, entry_.packed});
    put(bytes_, zip::kLocalHeader);
    put_facts(entry_, !extra.empty());
    put(bytes_, static_cast<std::uint16_t>(extra.size()));
    bytes_ += entry_.name;
    bytes_ += extra;
    bytes_ += packed_;
    packed_.clear();
    entries_.push_back(std::exchange(entry_, {}));
}

/// What stands in both of an entry's headers, up to the length of its name.
void ZipWriter::put_facts(const Entry& entry, bool large) {
    put(bytes_, large ? kVersion64 : kVersion);
    put(bytes_, kUtf8Name);
    put(bytes_, zip::kDeflated);
    put(bytes_, kNoTime);
    put(bytes_, entry.crc);
    put(bytes_, low(entry.packed));
    put(bytes_, low(entry.size));
    put(bytes_, static_cast<std::uint16_t>(entry.name.size()));
}

std::uint32_t ZipWriter::low(std::uint64_t number) const {
    return number > most_ ? zip::kElsewhere : static_cast<std::uint32_t>(number);
}

/// The extra field that holds what `low` does not.
std::string ZipWriter::extra_of(std::initializer_list<std::uint64_t> numbers) const {
    std::string large;
    for (const std::uint64_t number : numbers) {
        if (number > most_) put(large, number);
    }
    if (large.empty()) return large;
    std::string extra;
    put(extra, zip::kExtra64);
    put(extra, static_cast<std::uint16_t>(large.size()));
    return extra + large;
}

void ZipWriter::put_table_entry(const Entry& entry) {
    const std::string extra = extra_of({entry.size, entry.packed, entry.at});
    put(bytes_, zip::kTableEntry);
    put(bytes_, extra.empty() ? kVersion : kVersion64);
    put_facts(entry, !extra.empty());
    put(bytes_, static_cast<std::uint16_t>(extra.size()));
    bytes_.append(10, '\0');  // no comment, first disk, no attributes
    put(bytes_, low(entry.at));
    bytes_ += entry.name;
    bytes_ += extra;
}

void ZipWriter::put_large_table_end(std::uint64_t at, std::uint64_t bytes) {
    const std::uint64_t here = bytes_.size();
    put(bytes_, zip::kTableEnd64);
    put(bytes_, std::uint64_t{zip::kTableEnd64Bytes - 12});  // what follows
    put(bytes_, kVersion64);
    put(bytes_, kVersion64);
    put(bytes_, std::uint64_t{0});  // disks
    put(bytes_, std::uint64_t{entries_.size()});
    put(bytes_, std::uint64_t{entries_.size()});
    put(bytes_, bytes);
    put(bytes_, at);
    put(bytes_, zip::kTableEnd64Locator);
    put(bytes_, std::uint32_t{0});
    put(bytes_, here);
    put(bytes_, std::uint32_t{1});  // disks
}

std::string ZipWriter::take() {
    end();
    const std::uint64_t at = bytes_.size();
    for (const Entry& entry : entries_) put_table_entry(entry);
    const std::uint64_t bytes = bytes_.size() - at;
    if (at > most_ || bytes > most_) put_large_table_end(at, bytes);
    put(bytes_, zip::kTableEnd);
    put(bytes_, std::uint32_t{0});  // disks
    put(bytes_, static_cast<std::uint16_t>(entries_.size()));
    put(bytes_, static_cast<std::uint16_t>(entries_.size()));
    put(bytes_, low(bytes));
    put(bytes_, low(at));
    put(bytes_, std::uint16_t{0});  // no comment
    return std::move(bytes_);
}

}  // namespace vsplit
