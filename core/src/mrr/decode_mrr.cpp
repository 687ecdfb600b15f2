#include <cmath>
#include <optional>

#include "base/byte_order.h"
#include "mrr/mrr_layout.h"
#include "mrr/region_section.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit {
namespace {

/// Makes an MRR of a file that was taken apart. Every record is tried on a mesh.
class MrrDecoder {
public:
    explicit MrrDecoder(MrrLayout layout) : layout_(std::move(layout)), codec_(layout_.grid) {}

    Expected<StoredMrr> decode() {
        for (const auto step :
             {&MrrDecoder::read_base, &MrrDecoder::read_blocks, &MrrDecoder::check_end, &MrrDecoder::check_box}) {
            if (const Status status = (this->*step)(); !status) return status.error();
        }
        stored_.faces = layout_.shown;
        stored_.description.assign(reinterpret_cast<const char*>(layout_.description.data()), layout_.description.size());
        stored_.grid = layout_.grid;
        stored_.max_error = layout_.max_error;
        stored_.unit = layout_.unit;
        stored_.source = layout_.source;
        return std::move(stored_);
    }

private:
    [[nodiscard]] RecordList& records() { return stored_.mrr.records; }

    /// \pre the base is not packed: its bytes are as many as the counts say.
    [[nodiscard]] TriangleMesh plain_base() const {
        TriangleMesh base;
        const std::byte* at = layout_.base.data();
        base.positions.resize(layout_.vertices);
        for (Vec3& position : base.positions) {
            for (int axis = 0; axis < 3; ++axis, at += sizeof(double)) position[axis] = load<double>(at);
        }
        base.faces.resize(layout_.faces);
        for (Triangle& face : base.faces) {
            for (std::uint32_t& vertex : face) {
                vertex = load<std::uint32_t>(at);
                at += sizeof(vertex);
            }
        }
        return base;
    }

    Status read_base() {
        TriangleMesh& base = stored_.mrr.base;
        if (layout_.packed) {
            Expected<TriangleMesh> unpacked =
                unpack_base({layout_.base, layout_.vertices, layout_.faces, layout_.ghosts}, layout_.grid);
            if (!unpacked) return error_at(Cause::kCorrupt, layout_.base_at, unpacked.error().message);
            base = *std::move(unpacked);
        } else {
            base = plain_base();
        }
        Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(base, layout_.ghosts);
        if (!mesh) return error_at(Cause::kCorrupt, layout_.base_at, "the base mesh: " + mesh.error().message);
        mesh_ = *std::move(mesh);
        mesh_->foresee(layout_.splits);
        stored_.mrr.ghosts = layout_.ghosts;
        stored_.mrr.ghost_faces = count_ghost_faces(base, layout_.ghosts);
        note_deviation(layout_.base_deviation);
        return Done{};
    }

    Status read_blocks() {
        for (const MrrBlockPlace& place : layout_.blocks) {
            const RecordBlock block{place.first, place.count, place.encoding,
                                    std::string(reinterpret_cast<const char*>(place.payload.data()), place.payload.size()),
                                    place.crc32c};
            if (const Status decoded = codec_.decode(block, *mesh_, &records()); !decoded)
                return error_at(Cause::kCorrupt, place.at, decoded.error().message);
            if (const Status valid = check_block_end(place); !valid) return valid.error();
        }
        return Done{};
    }

    /// That the mesh is now what the index says.
    Status check_block_end(const MrrBlockPlace& place) {
        if (mesh_->level() > layout_.splits) {
            return error_at(Cause::kCorrupt, place.at,
                            "a block brings more splits than the " + std::to_string(layout_.splits) + " announced");
        }
        stored_.mrr.border_splits = mesh_->border_splits();
        const std::uint32_t faces = stored_.mrr.faces_at(mesh_->level());
        if (place.splits.value_or(mesh_->level()) != mesh_->level() || place.faces.value_or(faces) != faces) {
            return error_at(Cause::kCorrupt, place.at,
                            "after the block from record " + std::to_string(place.first) + " on there are " +
                                std::to_string(mesh_->level()) + " splits and " + std::to_string(faces) + " faces, not " +
                                std::to_string(*place.splits) + " and " + std::to_string(*place.faces) + " as the index says");
        }
        if (!std::isnan(place.deviation) && records().kinds().back() != RecordKind::kSplit) {
            return error_at(Cause::kCorrupt, place.at,
                            "a deviation is given after the block from record " + std::to_string(place.first) +
                                " on, which does not end with a split");
        }
        note_deviation(place.deviation);
        return Done{};
    }

    void note_deviation(double most) {
        if (!std::isnan(most)) stored_.deviations.push_back({static_cast<std::uint32_t>(mesh_->level()), most});
    }

    Status check_end() {
        const std::string all = std::to_string(records().size()) + " records";
        if (mesh_->level() != layout_.splits) {
            return error_at(Cause::kCorrupt, kMrrSplitsAt,
                            std::to_string(mesh_->level()) + " of " + all + " are splits, not " + std::to_string(layout_.splits));
        }
        if (!records().empty() && records().kinds().back() != RecordKind::kSplit) {
            return error_at(Cause::kCorrupt, layout_.regions_at,
                            "the last of " + all + " is no split; edits stand before a split");
        }
        if (layout_.regions.empty()) return Done{};
        return decode_regions(layout_.regions, layout_.regions_at, stored_.mrr);
    }

    Status check_box() {
        if (!layout_.box) return Done{};
        const BoundingBox box = box_of_all(stored_.mrr);
        if (box.min == layout_.box->min && box.max == layout_.box->max) return Done{};
        return error_at(Cause::kCorrupt, kMrr2BoxAt, "the bounding box is not that of the positions");
    }

    MrrLayout layout_;
    RecordCodec codec_;
    StoredMrr stored_;
    std::optional<ProgressiveMesh> mesh_;
};

}  // namespace

Expected<StoredMrr> decode_mrr(std::span<const std::byte> bytes) {
    Expected<MrrLayout> layout = read_mrr_layout(bytes);
    if (!layout) return layout.error();
    return MrrDecoder(*std::move(layout)).decode();
}

}  // namespace vsplit
