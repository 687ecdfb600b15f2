#include <algorithm>
#include <limits>
#include <optional>

#include "base/byte_order.h"
#include "mrr/mrr_layout.h"
#include "mrr/region_section.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {
namespace {

Error error_at(Cause cause, std::size_t byte, const std::string& what) {
    return {cause, "byte " + std::to_string(byte) + ": " + what, ""};
}

/// Reads a `.vsplit` file front to back. Nothing is taken from it that was not checked, and every record is tried on a mesh.
class MrrDecoder {
public:
    explicit MrrDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {}

    Expected<StoredMrr> decode() {
        for (const auto step : {&MrrDecoder::check_magic, &MrrDecoder::check_header, &MrrDecoder::check_sizes,
                                &MrrDecoder::read_base, &MrrDecoder::read_blocks, &MrrDecoder::check_end}) {
            if (const Status status = (this->*step)(); !status) return status.error();
        }
        return std::move(stored_);
    }

private:
    [[nodiscard]] std::uint32_t field(std::size_t at) const { return load<std::uint32_t>(bytes_.data() + at); }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

    Status check_magic() {
        const std::size_t present = std::min(kMrrMagic.size(), bytes_.size());
        const std::string_view begin(reinterpret_cast<const char*>(bytes_.data()), present);
        if (begin != kMrrMagic.substr(0, present)) {
            return error_at(Cause::kUnknownFormat, 0,
                            "this is no .vsplit file; one begins with the bytes 89 56 53 50 0d 0a 1a 0a");
        }
        if (bytes_.size() >= kMrrHeaderBytes) return Done{};
        return error_at(Cause::kTruncatedInput, bytes_.size(),
                        "the file ends within its header of " + std::to_string(kMrrHeaderBytes) + " bytes");
    }

    Status check_header() {
        const std::uint32_t version = field(kMrrVersionAt);
        if (version > kMrrVersion) {
            return error_at(Cause::kUnsupported, kMrrVersionAt,
                            "the file is of version " + std::to_string(version) + " of the format; this program reads version " +
                                std::to_string(kMrrVersion));
        }
        if (crc32c(bytes_.first(kMrrHeaderCrcAt)) != field(kMrrHeaderCrcAt)) {
            return error_at(Cause::kCorrupt, kMrrHeaderCrcAt, "the header's checksum does not fit it");
        }
        if (version == kMrrVersion) return Done{};
        return error_at(Cause::kCorrupt, kMrrVersionAt, "there is no version " + std::to_string(version) + " of the format");
    }

    /// What the header announces must be there, and every corner must have a number.
    Status check_sizes() {
        at_ = kMrrHeaderBytes;
        base_bytes_ = std::uint64_t{field(kMrrVerticesAt)} * kMrrVertexBytes + std::uint64_t{field(kMrrFacesAt)} * kMrrFaceBytes +
                      field(kMrrDescriptionAt);
        if (base_bytes_ > left()) {
            return error_at(Cause::kTruncatedInput, at_,
                            "base mesh and description take " + std::to_string(base_bytes_) + " bytes; the file has " +
                                std::to_string(left()) + " more");
        }
        const std::uint64_t corners = 3 * (field(kMrrFacesAt) + 2 * std::uint64_t{field(kMrrSplitsAt)});
        if (corners >= std::numeric_limits<std::uint32_t>::max())
            return error_at(Cause::kCorrupt, kMrrSplitsAt, "the finest level would have more corners than 32 bits can number");
        if (field(kMrrSplitsAt) <= field(kMrrRecordsAt)) return Done{};
        return error_at(
            Cause::kCorrupt, kMrrSplitsAt,
            std::to_string(field(kMrrSplitsAt)) + " splits among " + std::to_string(field(kMrrRecordsAt)) + " records");
    }

    Status read_base() {
        if (crc32c(bytes_.subspan(at_, base_bytes_)) != field(kMrrBaseCrcAt)) {
            return error_at(Cause::kCorrupt, at_, "the checksum of base mesh and description does not fit them");
        }
        TriangleMesh& base = stored_.mrr.base;
        base.positions.resize(field(kMrrVerticesAt));
        for (Vec3& position : base.positions) {
            for (int axis = 0; axis < 3; ++axis) position[axis] = take<double>();
        }
        base.faces.resize(field(kMrrFacesAt));
        for (Triangle& face : base.faces) {
            for (std::uint32_t& vertex : face) vertex = take<std::uint32_t>();
        }
        const std::span<const std::byte> text = bytes_.subspan(at_, field(kMrrDescriptionAt));
        stored_.description.assign(reinterpret_cast<const char*>(text.data()), text.size());
        at_ += text.size();
        stored_.faces = field(kMrrShownAt);

        Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(base, field(kMrrGhostsAt));
        if (!mesh) return error_at(Cause::kCorrupt, kMrrHeaderBytes, "the base mesh: " + mesh.error().message);
        mesh_ = *std::move(mesh);
        stored_.mrr.ghosts = field(kMrrGhostsAt);
        stored_.mrr.ghost_faces = count_ghost_faces(base, stored_.mrr.ghosts);
        return Done{};
    }

    [[nodiscard]] RecordList& records() { return stored_.mrr.records; }

    Status read_blocks() {
        while (records().size() < field(kMrrRecordsAt)) {
            if (const Status status = read_block(); !status) return status.error();
        }
        return Done{};
    }

    Status check_end() {
        const std::string all = std::to_string(records().size()) + " records";
        if (mesh_->level() != field(kMrrSplitsAt)) {
            return error_at(
                Cause::kCorrupt, kMrrSplitsAt,
                std::to_string(mesh_->level()) + " of " + all + " are splits, not " + std::to_string(field(kMrrSplitsAt)));
        }
        if (!records().empty() && records().kinds().back() != RecordKind::kSplit) {
            return error_at(Cause::kCorrupt, bytes_.size(), "the last of " + all + " is no split; edits stand before a split");
        }
        stored_.mrr.border_splits = mesh_->border_splits();
        return left() == 0 ? Status(Done{}) : decode_regions(bytes_.subspan(at_), at_, stored_.mrr);
    }

    Status read_block() {
        const std::size_t block_at = at_;
        const auto read = static_cast<std::uint32_t>(records().size());
        const std::uint32_t due = field(kMrrRecordsAt) - read;
        if (left() < kMrrBlockHeaderBytes) return truncated();
        RecordBlock block;
        block.first = take<std::uint32_t>();
        block.count = take<std::uint32_t>();
        block.encoding = RecordEncoding{take<std::uint32_t>()};
        const auto payload_bytes = take<std::uint32_t>();
        block.crc32c = take<std::uint32_t>();
        if (block.first != read || block.count == 0 || block.count > due) {
            return error_at(Cause::kCorrupt, block_at,
                            "a block has records " + std::to_string(block.first) + " and on, " + std::to_string(block.count) +
                                " in all, where up to " + std::to_string(due) + " from " + std::to_string(read) + " on are due");
        }
        if (payload_bytes > left()) return truncated();
        block.payload.assign(reinterpret_cast<const char*>(bytes_.data() + at_), payload_bytes);
        at_ += payload_bytes;
        return accept(block, block_at);
    }

    Status accept(const RecordBlock& block, std::size_t block_at) {
        const Expected<RecordList> decoded = decode_block(block);
        if (!decoded) return error_at(Cause::kCorrupt, block_at, decoded.error().message);
        if (decoded->splits().size() > field(kMrrSplitsAt) - mesh_->level()) {
            return error_at(Cause::kCorrupt, block_at,
                            "a block brings more splits than the " + std::to_string(field(kMrrSplitsAt)) + " announced");
        }
        if (const Status fits = mesh_->refine(*decoded); !fits) return error_at(Cause::kCorrupt, block_at, fits.error().message);
        records().append(*decoded);
        return Done{};
    }

    [[nodiscard]] Status truncated() {
        return error_at(Cause::kTruncatedInput, bytes_.size(),
                        "the file ends after " + std::to_string(records().size()) + " of " +
                            std::to_string(field(kMrrRecordsAt)) + " records");
    }

    /// \pre sizeof(T) <= left().
    template <class T>
    T take() {
        const T value = load<T>(bytes_.data() + at_);
        at_ += sizeof(T);
        return value;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    std::uint64_t base_bytes_ = 0;
    StoredMrr stored_;
    std::optional<ProgressiveMesh> mesh_;
};

}  // namespace

Expected<StoredMrr> decode_mrr(std::span<const std::byte> bytes) { return MrrDecoder(bytes).decode(); }

}  // namespace vsplit
