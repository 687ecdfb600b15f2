#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <variant>
#include <vector>

#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Undoes one edge collapse (i, j) -> k ([Date05] 2.1, [Hoppe96]): the vertex at corner `anchor` splits in two.
///
/// A corner is 3 * face + (0, 1 or 2); it names a vertex of a face, and the half-edge that leaves it along the face.
/// Let v be the vertex at corner `anchor`. Counter-clockwise around v, the face of `anchor` and those after it, `steps` in
/// all, go over to a new vertex w. Split number s (from 0) of a representation whose base mesh has n0 vertices and f0 faces
/// makes the vertex w = n0 + s and the faces f0 + 2s = (v, w, e) and f0 + 2s + 1 = (w, v, b), where b is the ring vertex at
/// which the fan that moves begins and e the one at which it ends. Afterwards v lies at `kept` and w at `added`.
struct VertexSplit {
    std::uint32_t anchor = 0;
    std::uint32_t steps = 0;  ///< 1 .. valence(v) - 1
    Vec3 kept = Vec3::Zero();
    Vec3 added = Vec3::Zero();

    friend bool operator==(const VertexSplit&, const VertexSplit&) = default;
};

/// Turns an edge clockwise within the quad of its two faces.
///
/// Let the half-edge run p -> q in the face (p, q, r), its twin in (q, p, s). Afterwards it runs r -> s in (r, s, q), the twin
/// s -> r in (s, r, p), corner by corner: p becomes r, q becomes s, r becomes q in the first face; q becomes s, p becomes r,
/// s becomes p in the second. Undone it turns counter-clockwise, exactly back. Either half-edge of the edge says the same.
struct EdgeFlip {
    std::uint32_t half_edge = 0;  ///< by the corner it leaves

    friend bool operator==(const EdgeFlip&, const EdgeFlip&) = default;
};

/// Moves a vertex. Where it lay before is remembered by who applies it.
struct VertexMove {
    std::uint32_t vertex = 0;
    Vec3 position = Vec3::Zero();  ///< afterwards

    friend bool operator==(const VertexMove&, const VertexMove&) = default;
};

enum class RecordKind : std::uint8_t { kSplit = 0, kFlip = 1, kMove = 2 };

/// One record of any kind, where speed does not count.
using Record = std::variant<VertexSplit, EdgeFlip, VertexMove>;

/// A run of records, seen: the kinds in order, and those of each kind in order.
struct RecordSpan {
    std::span<const RecordKind> kinds;
    std::span<const VertexSplit> splits;
    std::span<const EdgeFlip> flips;
    std::span<const VertexMove> moves;

    [[nodiscard]] std::size_t size() const { return kinds.size(); }
    [[nodiscard]] bool empty() const { return kinds.empty(); }
    /// Whether the arrays hold what the kinds announce. O(size).
    [[nodiscard]] bool consistent() const;
};

/// Calls visit(const VertexSplit&), visit(EdgeFlip) or visit(const VertexMove&) for each in order. \pre records.consistent().
template <class Visit>
void for_each_record(const RecordSpan& records, Visit visit) {
    auto split = records.splits.begin();
    auto flip = records.flips.begin();
    auto move = records.moves.begin();
    for (const RecordKind kind : records.kinds) {
        if (kind == RecordKind::kSplit) {
            visit(*split++);
        } else if (kind == RecordKind::kFlip) {
            visit(*flip++);
        } else {
            visit(*move++);
        }
    }
}

/// Records in order, 57 bytes a split, 5 a flip, 33 a move. Any run of them is at hand at once.
class RecordList {
public:
    RecordList() = default;
    RecordList(std::initializer_list<Record> records);

    void push_back(const VertexSplit& split);
    void push_back(EdgeFlip flip);
    void push_back(const VertexMove& move);
    void push_back(const Record& record);

    /// \pre records.consistent(). O(records).
    void append(const RecordSpan& records);

    void reserve(std::size_t splits, std::size_t flips, std::size_t moves);
    void clear();

    /// Drops all records but the first `records`. \pre records <= size(). O(1): at most 255 kinds are counted.
    void truncate(std::size_t records);

    [[nodiscard]] std::size_t size() const { return kinds_.size(); }
    [[nodiscard]] bool empty() const { return kinds_.empty(); }
    [[nodiscard]] std::span<const RecordKind> kinds() const { return kinds_; }
    [[nodiscard]] std::span<const VertexSplit> splits() const { return splits_; }
    [[nodiscard]] std::span<const EdgeFlip> flips() const { return flips_; }
    [[nodiscard]] std::span<const VertexMove> moves() const { return moves_; }

    /// Records [first, first + count); the view ends with the next change of the list. \pre first + count <= size(). O(1): at
    /// most 2 * 255 kinds are counted.
    [[nodiscard]] RecordSpan slice(std::size_t first, std::size_t count) const;

    /// All of them.
    operator RecordSpan() const { return {kinds_, splits_, flips_, moves_}; }  // NOLINT(google-explicit-constructor)

    /// \pre number < size(). O(1) as slice.
    [[nodiscard]] Record operator[](std::size_t number) const;

    /// Number of the record that split number `split` is. \pre split < splits().size(). O(log(size)).
    [[nodiscard]] std::size_t record_of_split(std::size_t split) const;

    friend bool operator==(const RecordList&, const RecordList&) = default;

private:
    /// Records of each kind before some record.
    struct Counts {
        std::uint32_t splits = 0;
        std::uint32_t flips = 0;
        std::uint32_t moves = 0;

        void add(RecordKind kind);
        friend bool operator==(const Counts&, const Counts&) = default;
    };
    [[nodiscard]] Counts before(std::size_t record) const;
    void push_kind(RecordKind kind);

    std::vector<RecordKind> kinds_;
    std::vector<VertexSplit> splits_;
    std::vector<EdgeFlip> flips_;
    std::vector<VertexMove> moves_;
    std::vector<Counts> marks_;  // before records 0, kMarkEvery, 2 kMarkEvery ...
    Counts all_;
};

}  // namespace vsplit
