#include "mrr/mrr_layout.h"

#include <algorithm>
#include <string>

#include "base/byte_order.h"

namespace vsplit {

Error error_at(Cause cause, std::size_t byte, const std::string& what) {
    return {cause, "byte " + std::to_string(byte) + ": " + what, ""};
}

std::uint32_t number_of(std::optional<LengthUnit> unit) { return unit ? static_cast<std::uint32_t>(*unit) + 1 : 0; }

bool unit_by_number(std::uint32_t number, std::optional<LengthUnit>& unit) {
    if (number > length_units().size()) return false;
    if (number > 0) unit = LengthUnit{static_cast<int>(number - 1)};
    return true;
}

namespace {

constexpr std::size_t kVersionBytes = kMrrVersionAt + sizeof(std::uint32_t);

Status check_mark(std::span<const std::byte> bytes) {
    const std::size_t present = std::min(kMrrMagic.size(), bytes.size());
    const std::string_view begin(reinterpret_cast<const char*>(bytes.data()), present);
    if (begin != kMrrMagic.substr(0, present)) {
        return error_at(Cause::kUnknownFormat, 0, "this is no .vsplit file; one begins with the bytes 89 56 53 50 0d 0a 1a 0a");
    }
    if (bytes.size() >= kVersionBytes) return Done{};
    return error_at(Cause::kTruncatedInput, bytes.size(), "the file ends within its header");
}

/// What both versions read alike. Nothing is taken from the bytes that was not checked.
class LayoutReader {
public:
    explicit LayoutReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

protected:
    template <class T = std::uint32_t>
    [[nodiscard]] T field(std::size_t at) const {
        return load<T>(bytes_.data() + at);
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    /// \pre size <= left().
    std::span<const std::byte> take(std::size_t size) {
        const std::span<const std::byte> taken = bytes_.subspan(at_, size);
        at_ += size;
        return taken;
    }

    Status check_header(std::size_t header_bytes, std::size_t crc_at) {
        if (bytes_.size() < header_bytes) {
            return error_at(Cause::kTruncatedInput, bytes_.size(),
                            "the file ends within its header of " + std::to_string(header_bytes) + " bytes");
        }
        if (crc32c(bytes_.first(crc_at)) != field(crc_at))
            return error_at(Cause::kCorrupt, crc_at, "the header's checksum does not fit it");
        at_ = layout_.base_at = header_bytes;
        layout_.vertices = field(kMrrVerticesAt);
        layout_.faces = field(kMrrFacesAt);
        layout_.ghosts = field(kMrrGhostsAt);
        layout_.splits = field(kMrrSplitsAt);
        layout_.records = field(kMrrRecordsAt);
        layout_.shown = field(kMrrShownAt);
        return Done{};
    }

    [[nodiscard]] std::uint64_t plain_base_bytes() const {
        return std::uint64_t{layout_.vertices} * kMrrVertexBytes + std::uint64_t{layout_.faces} * kMrrFaceBytes;
    }

    /// What follows the header must be there, and every corner must have a number.
    Status check_sizes(std::uint64_t body_bytes, const char* body) {
        if (body_bytes > left()) {
            return error_at(Cause::kTruncatedInput, at_,
                            std::string(body) + " take " + std::to_string(body_bytes) + " bytes; the file has " +
                                std::to_string(left()) + " more");
        }
        const std::uint64_t corners = 3 * (layout_.faces + 2 * std::uint64_t{layout_.splits});
        if (corners >= std::numeric_limits<std::uint32_t>::max())
            return error_at(Cause::kCorrupt, kMrrSplitsAt, "the finest level would have more corners than 32 bits can number");
        if (layout_.splits <= layout_.records) return Done{};
        return error_at(Cause::kCorrupt, kMrrSplitsAt,
                        std::to_string(layout_.splits) + " splits among " + std::to_string(layout_.records) + " records");
    }

    Status check_body(std::uint64_t body_bytes, std::uint32_t crc, const char* body) const {
        if (crc32c(bytes_.subspan(at_, body_bytes)) == crc) return Done{};
        return error_at(Cause::kCorrupt, at_, std::string("the checksum of ") + body + " does not fit them");
    }

    /// Blocks follow one another from record 0 on.
    Status check_place(const MrrBlockPlace& block, std::size_t named_at) const {
        const std::uint32_t due = layout_.records - read_;
        if (block.first == read_ && block.count > 0 && block.count <= due) return Done{};
        return error_at(Cause::kCorrupt, named_at,
                        "a block has records " + std::to_string(block.first) + " and on, " + std::to_string(block.count) +
                            " in all, where up to " + std::to_string(due) + " from " + std::to_string(read_) + " on are due");
    }

    [[nodiscard]] Status truncated() const {
        return error_at(Cause::kTruncatedInput, bytes_.size(),
                        "the file ends after " + std::to_string(read_) + " of " + std::to_string(layout_.records) + " records");
    }

    Status take_payload(MrrBlockPlace& block, std::uint32_t bytes) {
        if (bytes > left()) return truncated();
        block.payload = take(bytes);
        read_ += block.count;
        layout_.blocks.push_back(block);
        return Done{};
    }

    void take_regions() {
        layout_.regions_at = at_;
        layout_.regions = take(left());
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    std::uint32_t read_ = 0;  // records in the blocks so far
    MrrLayout layout_;
};

class Version1Reader : LayoutReader {
public:
    using LayoutReader::LayoutReader;

    Expected<MrrLayout> read() {
        if (Status valid = check_header(kMrr1HeaderBytes, kMrr1HeaderCrcAt); !valid) return valid.error();
        const std::uint64_t body_bytes = plain_base_bytes() + field(kMrrDescriptionAt);
        constexpr const char* kBody = "base mesh and description";
        if (Status valid = check_sizes(body_bytes, kBody); !valid) return valid.error();
        if (Status valid = check_body(body_bytes, field(kMrr1BaseCrcAt), kBody); !valid) return valid.error();
        layout_.base = take(plain_base_bytes());
        layout_.description = take(field(kMrrDescriptionAt));
        while (read_ < layout_.records) {
            if (Status read = read_block(); !read) return read.error();
        }
        take_regions();
        return std::move(layout_);
    }

private:
    Status read_block() {
        MrrBlockPlace block;
        block.at = at_;
        if (left() < kMrr1BlockHeaderBytes) return truncated();
        take(kMrr1BlockHeaderBytes);
        block.first = field(block.at);
        block.count = field(block.at + 4);
        block.encoding = RecordEncoding{field(block.at + 8)};
        block.crc32c = field(block.at + 16);
        if (Status due = check_place(block, block.at); !due) return due;
        return take_payload(block, field(block.at + 12));
    }
};

class Version2Reader : LayoutReader {
public:
    using LayoutReader::LayoutReader;

    Expected<MrrLayout> read() {
        if (Status valid = check_header(kMrr2HeaderBytes, kMrr2HeaderCrcAt); !valid) return valid.error();
        if (Status whole = check_whole(); !whole) return whole.error();
        if (Status valid = read_facts(); !valid) return valid.error();
        const auto base_bytes = field<std::uint64_t>(kMrr2BaseBytesAt);
        const std::uint64_t others = field(kMrrDescriptionAt) + std::uint64_t{field(kMrr2BlocksAt)} * kMrr2IndexBytes;
        constexpr const char* kBody = "base mesh, description and block index";
        if (Status valid = check_sizes(std::max(base_bytes, base_bytes + others), kBody); !valid) return valid.error();
        if (Status valid = check_body(base_bytes + others, field(kMrr2BodyCrcAt), kBody); !valid) return valid.error();
        if (!layout_.packed && base_bytes != plain_base_bytes()) {
            return error_at(
                Cause::kCorrupt, kMrr2BaseBytesAt,
                "the base mesh takes " + std::to_string(plain_base_bytes()) + " bytes, not " + std::to_string(base_bytes));
        }
        layout_.base = take(base_bytes);
        layout_.description = take(field(kMrrDescriptionAt));
        index_at_ = at_;
        take(field(kMrr2BlocksAt) * kMrr2IndexBytes);
        for (std::uint32_t n = 0; n < field(kMrr2BlocksAt); ++n) {
            if (Status read = read_block(index_at_ + n * kMrr2IndexBytes); !read) return read.error();
        }
        if (read_ < layout_.records) {
            return error_at(Cause::kCorrupt, kMrrRecordsAt,
                            "the blocks have " + std::to_string(read_) + " records, not " + std::to_string(layout_.records));
        }
        take_regions();
        return std::move(layout_);
    }

private:
    [[nodiscard]] Vec3 point(std::size_t at) const { return {field<double>(at), field<double>(at + 8), field<double>(at + 16)}; }

    [[nodiscard]] Status check_whole() const {
        const auto whole = field<std::uint64_t>(kMrr2FileBytesAt);
        if (bytes_.size() == whole) return Done{};
        return error_at(bytes_.size() < whole ? Cause::kTruncatedInput : Cause::kCorrupt, bytes_.size(),
                        "the file has " + std::to_string(bytes_.size()) + " bytes, and its header says " + std::to_string(whole));
    }

    /// All that the header says beyond counts.
    Status read_facts() {
        if (Status read = read_grid(); !read) return read;
        if (!unit_by_number(field(kMrr2UnitAt), layout_.unit)) {
            return error_at(Cause::kCorrupt, kMrr2UnitAt,
                            "there is no unit " + std::to_string(field(kMrr2UnitAt)) + "; known are 0 to " +
                                std::to_string(length_units().size()));
        }
        layout_.max_error = field<double>(kMrr2MaxErrorAt);
        if (!is_length(layout_.max_error)) return error_at(Cause::kCorrupt, kMrr2MaxErrorAt, "the largest error is no length");
        layout_.base_deviation = field<double>(kMrr2BaseDeviationAt);
        if (Status valid = check_deviation(layout_.base_deviation, kMrr2BaseDeviationAt); !valid) return valid;
        layout_.box = BoundingBox{point(kMrr2BoxAt), point(kMrr2BoxAt + 24)};
        SourceHash hash{};
        std::transform(bytes_.begin() + kMrr2SourceAt, bytes_.begin() + kMrr2SourceAt + hash.size(), hash.begin(),
                       [](std::byte byte) { return static_cast<std::uint8_t>(byte); });
        if (hash != SourceHash{}) layout_.source = hash;
        return Done{};
    }

    Status read_grid() {
        const std::uint32_t encoding = field(kMrr2EncodingAt), bits = field(kMrr2BitsAt);
        const Vec3 origin = point(kMrr2OriginAt);
        const double step = field<double>(kMrr2StepAt);
        layout_.packed = RecordEncoding{encoding} != RecordEncoding::kFloat64;
        if (RecordEncoding{encoding} == RecordEncoding::kQuantised) {
            const Expected<PositionGrid> grid = PositionGrid::quantised(bits, origin, step);
            if (!grid) return error_at(Cause::kCorrupt, kMrr2BitsAt, grid.error().message);
            layout_.grid = *grid;
            return Done{};
        }
        if (RecordEncoding{encoding} == RecordEncoding::kFloat32) layout_.grid = PositionGrid::float32();
        if (encoding == 0 || encoding > static_cast<std::uint32_t>(RecordEncoding::kQuantised))
            return error_at(Cause::kCorrupt, kMrr2EncodingAt, "there is no encoding " + std::to_string(encoding));
        if (bits == 0 && origin == Vec3::Zero() && step == 0) return Done{};
        return error_at(Cause::kCorrupt, kMrr2BitsAt,
                        "the encoding " + std::to_string(encoding) + " has no grid, and one is given");
    }

    static bool is_length(double value) { return value >= 0 && value < std::numeric_limits<double>::infinity(); }
    static Status check_deviation(double value, std::size_t at) {
        if (value != value || is_length(value)) return Done{};  // NaN: not measured
        return error_at(Cause::kCorrupt, at, "a deviation is no length");
    }

    Status read_block(std::size_t entry) {
        MrrBlockPlace block;
        block.at = at_;
        block.first = field(entry);
        block.count = field(entry + 4);
        block.splits = field(entry + 8);
        block.faces = field(entry + 12);
        block.deviation = field<double>(entry + 16);
        block.encoding = layout_.grid.encoding();
        block.crc32c = field(entry + 36);
        if (Status due = check_place(block, entry); !due) return due;
        if (Status valid = check_deviation(block.deviation, entry + 16); !valid) return valid;
        if (const auto offset = field<std::uint64_t>(entry + 24); offset != at_) {
            return error_at(
                Cause::kCorrupt, entry + 24,
                "a block begins at byte " + std::to_string(offset) + ", where the one before ends at " + std::to_string(at_));
        }
        return take_payload(block, field(entry + 32));
    }

    std::size_t index_at_ = 0;
};

}  // namespace

Expected<MrrLayout> read_mrr_layout(std::span<const std::byte> bytes) {
    if (Status valid = check_mark(bytes); !valid) return valid.error();
    const auto version = load<std::uint32_t>(bytes.data() + kMrrVersionAt);
    if (version > kMrrVersion) {
        return error_at(Cause::kUnsupported, kMrrVersionAt,
                        "the file is of version " + std::to_string(version) +
                            " of the format; this program reads versions 1 to " + std::to_string(kMrrVersion));
    }
    if (version == 0) return error_at(Cause::kCorrupt, kMrrVersionAt, "there is no version 0 of the format");
    return version == 1 ? Version1Reader(bytes).read() : Version2Reader(bytes).read();
}

}  // namespace vsplit
