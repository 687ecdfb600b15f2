#pragma once

#include <vector>

#include "io/model_3mf.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

struct ReadOptions;

/// One mesh of what a 3MF archive's build holds: every item with its components, each where it is put, mirrored ones turned
/// outside out again.
///
/// Each object with a mesh is a region, named by the set of its name (else that of the object it is a component of, else
/// "object_<id>"), and so is each combination of an object's triangle sets, which are sets too. Regions are numbered from 1 in
/// order of their first face; where there is one object only, 0 are the faces in none of its sets, and without sets there are no
/// regions. Support is left out.
///
/// `models`: the root first. \return LIMIT_EXCEEDED for more than `options.max_faces`, a million placed objects, or components 64
/// deep; MALFORMED_INPUT for an object that is not defined, or not before; INVALID_COORDINATE.
/// O(faces of the result).
[[nodiscard]] Expected<TriangleMesh> assemble_3mf(const std::vector<Model3mf>& models, const ReadOptions& options);

}  // namespace vsplit
