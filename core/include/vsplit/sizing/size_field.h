#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vsplit/base/expected.h"
#include "vsplit/features/sharp_edges.h"
#include "vsplit/mesh/triangle_mesh.h"
#include "vsplit/sizing/sizing_options.h"
#include "vsplit/subdivide/subdivide.h"

namespace vsplit {

/// The longest edge allowed at each point of a surface. It has two parts, and the lesser counts:
/// - sizes at the source's vertices (chord error, field, max_size, and the other part there), graded along edges, linear inside
///   faces;
/// - spheres and boxes, evaluated at the point itself: their size inside, and `gradation` more per unit of distance through space
///   outside. Through space is never farther than along the surface, so this part keeps the gradation on any mesh, and a face
///   that holds a sphere no vertex is near still learns of it: at its corners, from afar.
class SizeField {
public:
    /// One a vertex of the source, infinity where nothing bounds: the surface's sizes, everything counted.
    [[nodiscard]] const std::vector<double>& vertex_sizes() const { return vertex_sizes_; }

    /// What spheres and boxes allow at `point`; infinity without any. O(spheres + boxes).
    [[nodiscard]] double size_of_shapes(const Vec3& point) const;

    [[nodiscard]] double gradation() const { return gradation_; }

private:
    friend Expected<SizeField> make_size_field(const TriangleMesh&, const SizingOptions&, const std::vector<SharpEdge>&);

    std::vector<double> vertex_sizes_;
    std::vector<SizeSphere> spheres_;
    std::vector<SizeBox> boxes_;
    double gradation_ = kDefaultGradation;
};

/// The size field of `options` on `mesh`; `creases` bound the smooth patches that curvature is measured in.
/// \pre `mesh` is manifold. \return what check_sizing and check_sizing_on return.
/// O(faces log faces + vertices * (spheres + boxes)).
[[nodiscard]] Expected<SizeField> make_size_field(const TriangleMesh& mesh, const SizingOptions& options,
                                                  const std::vector<SharpEdge>& creases);

/// Sizes at the vertices of a subdivision of the source the field was made for, in any order of its vertices and faces: linear
/// inside the parent, the shapes at the point itself, graded along the edges of `fine`. Infinity where nothing bounds.
///
/// Guaranteed, whatever the mesh: sizes at the ends of an edge differ by at most gradation * its length; none is over the size of
/// a shape that holds its vertex, nor over the linear one; none is below min_size. In slivers the linear part may be steeper than
/// the gradation; there sizes come out below what `subdivide_to_sizes` split to. \pre `fine.parent` names faces of `source`.
/// O(faces log faces + vertices * (spheres + boxes)).
[[nodiscard]] std::vector<double> sizes_on(const SubdividedMesh& fine, const TriangleMesh& source, const SizeField& field);

/// The field at `point`, which lies in or near face `face` of the source. O(spheres + boxes).
[[nodiscard]] double size_at(const TriangleMesh& source, const SizeField& field, std::uint32_t face, const Vec3& point);

/// Sizes brought down until they differ along each edge by at most gradation * its length; the largest such sizes there are.
/// The same for any order of faces. O(faces log faces).
[[nodiscard]] std::vector<double> graded_sizes(const TriangleMesh& mesh, std::vector<double> sizes, double gradation);

/// 1 / r of the largest normal curvature along the edges at each vertex, within smooth patches: normals are averaged over the
/// faces between two creases only. 0 where flat. On a regular mesh at least 3/4 of the largest principal curvature.
/// \pre `mesh` is manifold. O(faces).
[[nodiscard]] std::vector<double> largest_curvature(const TriangleMesh& mesh, const std::vector<SharpEdge>& creases);

/// Faces that subdivide_to_sizes would make, or `limit` + 1 when they are more. Takes no memory to speak of.
/// \pre `field` was made for `mesh`. O(min(result, limit) * (1 + spheres + boxes)).
[[nodiscard]] std::uint64_t predict_subdivision(const TriangleMesh& mesh, const SizeField& field, std::uint64_t limit,
                                                const ExecutionContext* context = nullptr);

/// Selective midpoint subdivision as in `subdivide_to_size`, but an edge is split when it is longer than the size at either end;
/// midpoints have the field's size at their own place. The surface does not change.
///
/// Guaranteed: no edge is longer than the field's size at its ends, and no face that meets a sphere or box has an edge longer
/// than that shape's size / (1 - gradation / sqrt(3)), 1.21 times the size by default: the nearest corner is within the longest
/// edge / sqrt(3), and may be allowed gradation times that more.
///
/// Stage "subdivide". \pre `field` was made for `mesh`. \return LIMIT_EXCEEDED (field "sizing") when more than `limit.most` faces
/// would come out, naming a min_size that fits; CANCELLED. O(result * (1 + spheres + boxes)).
[[nodiscard]] Expected<SubdividedMesh> subdivide_to_sizes(const TriangleMesh& mesh, const SizeField& field,
                                                          const FaceLimit& limit, const ExecutionContext& context);

}  // namespace vsplit
