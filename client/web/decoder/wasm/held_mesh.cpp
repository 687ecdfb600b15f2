#include "held_mesh.h"

#include <algorithm>
#include <cassert>

#include "mesh/half_edges.h"

namespace vsplit::web {

void HeldMesh::foresee(std::uint32_t splits) {
    mesh_.foresee(splits);
    records_.reserve(records_.splits().size() +
                         std::min<std::size_t>(splits, ProgressiveMesh::kMostForeseen * mesh_.mesh().positions.size()),
                     records_.flips().size(), records_.moves().size());
}

Status HeldMesh::append(RecordCodec& codec, const RecordBlock& block) {
    apply_to(records_.size());
    const std::size_t before = records_.size();
    Status decoded = codec.decode(block, mesh_, &records_);
    if (!decoded || !follows_) return decoded;
    // Where a record is shows while the mesh stands before it, which the codec does not tell: so it goes there once more.
    mesh_.rewind(before);
    apply_to(records_.size());
    return decoded;
}

void HeldMesh::apply_to(std::size_t records) {
    if (records <= mesh_.records()) return;
    const RecordSpan span = records_.slice(mesh_.records(), records - mesh_.records());
    if (!follows_) {
        [[maybe_unused]] const Status applied = mesh_.refine(span);
        assert(applied.has_value());
        return;
    }
    for_each_record(span, [this](const auto& record) {
        note(record);
        [[maybe_unused]] const Status applied = mesh_.refine(record);
        assert(applied.has_value());
    });
}

void HeldMesh::undo_to(std::size_t records) {
    if (!follows_) return mesh_.rewind(records);
    if (records >= mesh_.records()) return;
    const RecordSpan span = records_.slice(records, mesh_.records() - records);
    auto split = span.splits.end();
    auto flip = span.flips.end();
    auto move = span.moves.end();
    for (std::size_t n = span.size(); n-- > 0;) {
        mesh_.rewind(records + n);
        if (span.kinds[n] == RecordKind::kSplit) {
            note(*--split);
        } else if (span.kinds[n] == RecordKind::kFlip) {
            note(*--flip);
        } else {
            note(*--move);
        }
    }
}

void HeldMesh::coarsen(std::uint32_t levels) {
    const std::size_t left = mesh_.level() - std::min<std::size_t>(levels, mesh_.level());
    const std::size_t records = left == 0 ? 0 : records_.record_of_split(left - 1) + 1;
    undo_to(records);
}

void HeldMesh::refine(std::uint32_t level) {
    if (level <= mesh_.level()) return;
    apply_to(level <= records_.splits().size() ? records_.record_of_split(level - 1) + 1 : records_.size());
}

void HeldMesh::rewind(std::uint32_t records) {
    undo_to(records);
    records_.truncate(mesh_.records());
}

void HeldMesh::note(const VertexSplit& split) {
    const TriangleMesh& mesh = mesh_.mesh();
    HalfEdge last = split.anchor;
    for (std::uint32_t step = 1; step < split.steps; ++step) last = mesh_.twins()[prev(last)];
    for (const HalfEdge corner : {split.anchor, next(split.anchor), prev(last)}) vertices_.add(origin(mesh, corner));
    vertices_.add(mesh.vertex_count());  // that it adds
}

void HeldMesh::note(EdgeFlip flip) {
    const HalfEdge twin = mesh_.twins()[flip.half_edge];
    for (const HalfEdge corner : {flip.half_edge, prev(flip.half_edge), twin, prev(twin)})
        vertices_.add(origin(mesh_.mesh(), corner));
}

const std::vector<std::uint32_t>& HeldMesh::take_changes() {
    vertices_.take([this](std::uint32_t vertex) {
        if (vertex >= mesh_.mesh().vertex_count()) return;
        const HalfEdge start = mesh_.corner_of(vertex);
        HalfEdge corner = start;
        do {
            faces_.add(face_of(corner));
            corner = mesh_.twins()[prev(corner)];
        } while (corner != start);
    });
    changes_.clear();
    faces_.take([this](std::uint32_t face) { changes_.push_back(face); });
    return changes_;
}

}  // namespace vsplit::web
