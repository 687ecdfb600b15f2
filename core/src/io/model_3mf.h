#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/read_error.h"
#include "io/xml_stream.h"
#include "vsplit/base/expected.h"
#include "vsplit/mesh/length_unit.h"
#include "vsplit/mesh/triangle_mesh.h"

namespace vsplit {

/// Where an object is put: a point p goes to linear * p + shift.
struct Placement3mf {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Vec3 shift = Vec3::Zero();
};

/// An object named where it is to be put: a component of another one, or an item of the build.
struct Reference3mf {
    std::string part;  ///< the file in the archive that has it; empty: the one that names it
    std::uint64_t object = 0;
    std::optional<Placement3mf> placement;
    Place place = at_line(1);
};

/// A named set of an object's triangles, as ranges, first and last.
struct TriangleSet3mf {
    std::string name;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
};

/// An object of a model: a mesh, or components.
struct Object3mf {
    std::uint64_t id = 0;
    Place place = at_line(1);
    std::string name;
    bool is_support = false;  ///< for the printer alone; no part of the shape
    TriangleMesh mesh;
    std::vector<TriangleSet3mf> sets;
    std::vector<Reference3mf> components;
};

/// A model file of a 3MF archive.
struct Model3mf {
    std::string part;  ///< its name in the archive
    LengthUnit unit = LengthUnit::kMillimetre;
    std::vector<Object3mf> objects;  ///< in the file's order
    std::vector<Reference3mf> items;
};

/// How much more the model files of an archive may hold together, however small they are packed.
struct Room3mf {
    explicit Room3mf(std::uint32_t max_faces) : faces(max_faces), vertices(3 * std::uint64_t{max_faces}) {}

    std::uint32_t faces;
    std::uint64_t vertices;                   ///< more no face could use
    std::uint64_t parts = 1'000'000;          ///< objects, components, items and sets
    std::uint64_t memberships = 100'000'000;  ///< of triangles in sets
};

/// Reads a model file and takes what it holds off `room`. What references name is not looked at.
/// \return UNKNOWN_FORMAT for other XML; UNSUPPORTED for an extension that the file requires and that is not known here;
/// MALFORMED_INPUT, INVALID_COORDINATE, INDEX_OUT_OF_RANGE, LIMIT_EXCEEDED; what XmlStream returns. All with the place.
/// The file is read to its end, so that its checksum is right where a model is returned.
[[nodiscard]] Expected<Model3mf> read_model_3mf(std::string part, XmlStream xml, Room3mf& room);

/// How 3MF writes a unit, as "millimeter".
[[nodiscard]] std::string_view unit_name_3mf(LengthUnit unit);

}  // namespace vsplit
