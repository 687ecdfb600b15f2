#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>

#include "base/byte_order.h"
#include "mrr/mrr_layout.h"
#include "mrr/region_section.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit {
namespace {

std::uint32_t crc_of(const std::string& bytes, std::size_t from, std::size_t to) {
    return crc32c(std::as_bytes(std::span(bytes).subspan(from, to - from)));
}

template <class T>
void put(std::string& bytes, T value) {
    bytes.resize(bytes.size() + sizeof(value));
    store(bytes.data() + bytes.size() - sizeof(value), value);
}

void put_point(std::string& bytes, const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, point[axis]);
}

std::string base_bytes(const StoredMrr& stored) {
    const TriangleMesh& base = stored.mrr.base;
    if (stored.grid.encoding() != RecordEncoding::kFloat64) return pack_base(base, stored.mrr.ghosts, stored.grid);
    std::string bytes(base.positions.size() * kMrrVertexBytes + base.faces.size() * kMrrFaceBytes, '\0');
    char* to = bytes.data();
    for (const Vec3& position : base.positions) {
        for (int axis = 0; axis < 3; ++axis) to = store(to, position[axis]);
    }
    for (const Triangle& face : base.faces) {
        for (const std::uint32_t vertex : face) to = store(to, vertex);
    }
    return bytes;
}

/// Blocks one after the other, each up to the next of some records at which one must end.
class BlockWriter {
public:
    explicit BlockWriter(const StoredMrr& stored) : stored_(stored), records_(stored.mrr.records), codec_(stored.grid) {
        if (stored.grid.encoding() == RecordEncoding::kFloat64) return;
        Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(stored.mrr.base, stored.mrr.ghosts);
        assert(mesh.has_value());
        mesh_ = *std::move(mesh);
    }

    std::vector<RecordBlock> write() {
        std::vector<RecordBlock> blocks;
        std::size_t first = 0;
        for (const std::size_t end : ends()) {
            while (first < end) {
                blocks.push_back(next(first, end));
                first += blocks.back().count;
            }
        }
        return blocks;
    }

private:
    [[nodiscard]] std::vector<std::size_t> ends() const {
        std::vector<std::size_t> ends{stored_.mrr.record_of_level(stored_.mrr.level_for(stored_.faces)), records_.size()};
        for (const LevelDeviation& known : stored_.deviations) ends.push_back(stored_.mrr.record_of_level(known.level));
        std::sort(ends.begin(), ends.end());
        return ends;
    }

    RecordBlock next(std::size_t first, std::size_t end) {
        if (mesh_) {
            Expected<RecordBlock> block = codec_.encode(records_, first, end, *mesh_);
            assert(block.has_value());
            return *std::move(block);
        }
        const RecordSpan due = records_.slice(first, std::min(end - first, kMaxBlockBytes));  // none takes less than a byte
        const std::size_t count = records_that_fit(due, RecordEncoding::kFloat64);
        return encode_block(records_.slice(first, count), static_cast<std::uint32_t>(first), RecordEncoding::kFloat64);
    }

    const StoredMrr& stored_;
    const RecordList& records_;
    RecordCodec codec_;
    std::optional<ProgressiveMesh> mesh_;  // where records are coded relative to one
};

double deviation_at(const StoredMrr& stored, std::size_t level) {
    const auto known = std::find_if(stored.deviations.begin(), stored.deviations.end(),
                                    [level](const LevelDeviation& deviation) { return deviation.level == level; });
    return known == stored.deviations.end() ? kNotMeasured : known->most;
}

std::string index_of(const StoredMrr& stored, const std::vector<RecordBlock>& blocks, std::uint64_t at) {
    const MultiresMesh& mrr = stored.mrr;
    std::string index;
    std::uint32_t level = 0;
    at += blocks.size() * kMrr2IndexBytes;
    for (const RecordBlock& block : blocks) {
        const RecordSpan records = mrr.records.slice(block.first, block.count);
        level += static_cast<std::uint32_t>(records.splits.size());
        const bool at_level = records.kinds.back() == RecordKind::kSplit;
        const auto bytes = static_cast<std::uint32_t>(block.payload.size());
        for (const std::uint32_t field : {block.first, block.count, level, mrr.faces_at(level)}) put(index, field);
        put(index, at_level ? deviation_at(stored, level) : kNotMeasured);
        put(index, at);
        put(index, bytes);
        put(index, block.crc32c);
        at += bytes;
    }
    return index;
}

/// Up to what is known when all else is made: the bytes of the whole file and the checksums.
std::string header_of(const StoredMrr& stored, std::uint64_t base_bytes, std::size_t blocks) {
    const MultiresMesh& mrr = stored.mrr;
    const PositionGrid& grid = stored.grid;
    std::string bytes(kMrrMagic);
    for (const std::uint32_t field :
         {kMrrVersion, mrr.base.vertex_count(), mrr.base.face_count(), mrr.ghosts, static_cast<std::uint32_t>(mrr.levels()),
          static_cast<std::uint32_t>(mrr.records.size()), stored.faces, static_cast<std::uint32_t>(stored.description.size()),
          static_cast<std::uint32_t>(blocks), static_cast<std::uint32_t>(grid.encoding()), grid.bits(), number_of(stored.unit)}) {
        put(bytes, field);
    }
    put(bytes, base_bytes);
    put_point(bytes, grid.origin());
    for (const double length : {grid.step(), stored.max_error, deviation_at(stored, 0)}) put(bytes, length);
    const BoundingBox box = box_of_all(mrr);
    put_point(bytes, box.min);
    put_point(bytes, box.max);
    const SourceHash hash = stored.source.value_or(SourceHash{});
    bytes.append(hash.begin(), hash.end());
    assert(bytes.size() == kMrr2FileBytesAt);
    return bytes;
}

}  // namespace

std::string encode_mrr(const StoredMrr& stored) {
    [[maybe_unused]] constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();
    assert(stored.description.size() <= kLargest && stored.mrr.records.size() <= kLargest);
    const std::vector<RecordBlock> blocks = BlockWriter(stored).write();
    std::string body = base_bytes(stored);
    std::string bytes = header_of(stored, body.size(), blocks.size());
    body += stored.description;
    body += index_of(stored, blocks, kMrr2HeaderBytes + body.size());
    const std::string regions = encode_regions(stored.mrr);
    std::uint64_t whole = kMrr2HeaderBytes + body.size() + regions.size();
    for (const RecordBlock& block : blocks) whole += block.payload.size();
    put(bytes, whole);
    put(bytes, crc_of(body, 0, body.size()));
    put(bytes, crc_of(bytes, 0, kMrr2HeaderCrcAt));
    bytes.reserve(whole);
    bytes += body;
    for (const RecordBlock& block : blocks) bytes += block.payload;
    return bytes + regions;
}

}  // namespace vsplit
