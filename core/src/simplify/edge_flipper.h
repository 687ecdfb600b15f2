#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simplify/collapse_log.h"
#include "simplify/crease_replacement.h"
#include "simplify/guards.h"
#include "simplify/half_edge_mesh.h"
#include "simplify/local_state.h"
#include "simplify/mesh_parts.h"
#include "simplify/polish_limits.h"

namespace vsplit {

/// Flips edges where the smaller stretch of the two faces grows and both normals stay; never a crease, unless it has gone flat
/// and a face there is to be mended, and no bound breaks that held. Tells the log.
class EdgeFlipper {
public:
    /// With `within` no flip leaves a part of it.
    EdgeFlipper(HalfEdgeMesh& mesh, LocalState& state, CollapseLog& log, const Guards& guards, const PolishLimits& limits,
                const MeshParts* within = nullptr)
        : mesh_(mesh),
          state_(state),
          log_(log),
          guard_(guards.surface),
          creases_(mesh, state, guards.creases, limits.crease_cosine),
          limits_(limits),
          within_(within) {}

    /// All over the mesh, and again around what was flipped. Ends, since each flip betters the worse of two faces. What was
    /// looked at before and has not changed since is left out: it would be refused again. O(faces).
    void flip_all();

    /// The same within one part of those given, and when that is done in all of them between them. `since`: looked_at_all() of
    /// who flips between them; `start`: the mesh's clock before.
    void flip_within(MeshParts::Faces part, std::optional<std::uint32_t> since);
    void flip_between(const MeshParts& parts, std::uint32_t start);

    /// The mesh's clock when all edges began to be looked at last.
    [[nodiscard]] std::optional<std::uint32_t> looked_at_all() const { return looked_at_all_; }

    /// Among the edges of v and of its ring, and again around what was flipped. The faces that changed are in `changed_faces()`.
    void flip_around(std::uint32_t v);

    /// Of the last flip_around; a face may be named more than once.
    [[nodiscard]] const std::vector<std::uint32_t>& changed_faces() const { return changed_; }

    /// Flips edges away from v, those that leave the best shape first, until no more than max_valence are left: stretch may fall,
    /// but no bound breaks that held. Whether any was flipped. O(valence^2).
    bool relieve(std::uint32_t v);

    /// Flips the edge of a face that breaks bounds which leaves its two faces nearest to keeping them. Whether one was flipped.
    bool mend(std::uint32_t face);

private:
    struct Quad;

    template <class Take>
    void note_edges(MeshParts::Faces faces, Take take);
    void flip_noted_edges();
    void flip_open_edges();
    [[nodiscard]] double left_stretch(HalfEdge h) const;
    [[nodiscard]] bool flip_if_better(HalfEdge h);
    [[nodiscard]] bool is_as_refused(HalfEdge h) const;
    [[nodiscard]] bool is_beside_ghost(HalfEdge h) const;
    [[nodiscard]] bool bends(HalfEdge h) const;
    [[nodiscard]] bool may_flip(const Quad& quad) const;
    [[nodiscard]] bool keeps_bounds(const Quad& quad) const;
    template <class Value>
    [[nodiscard]] bool flip_best(Value value_of);
    void flip(const Quad& quad, HalfEdge h);
    [[nodiscard]] bool guards_admit(const Quad& quad, HalfEdge h);
    [[nodiscard]] std::uint32_t edges_at(std::uint32_t v) const;
    [[nodiscard]] bool guard_admits(const Quad& quad, HalfEdge h);
    [[nodiscard]] bool has_edge(std::uint32_t from, std::uint32_t to) const;

    HalfEdgeMesh& mesh_;
    LocalState& state_;
    CollapseLog& log_;
    DeviationGuard* const guard_;
    CreaseReplacement creases_;
    const PolishLimits limits_;
    const MeshParts* const within_;
    std::vector<HalfEdge> edges_;  // of flip_all, last first
    std::vector<HalfEdge> open_;   // edges to look at, last first
    std::optional<std::uint32_t> looked_at_all_;
    std::vector<std::uint32_t> changed_;
};

}  // namespace vsplit
