#include "tests/core/meshes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "tests/core/random.h"

namespace vsplit::test {
namespace {

using Cell = std::array<int, 3>;

// The sides of the unit cell, counter-clockwise seen from outside, as offsets of their corners, with where each looks.
struct CellSide {
    Cell outward;
    std::array<Cell, 4> corners;
};
constexpr std::array<CellSide, 6> kCellSides{{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
    {{1, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
    {{0, 1, 0}, {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}}},
    {{0, 0, -1}, {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
}};

Cell operator+(const Cell& a, const Cell& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// The outside of the unit cells of an nx * ny * nz grid that are solid.
class CellSurface {
public:
    CellSurface(Cell size, std::function<bool(const Cell&)> solid) : size_(size), solid_(std::move(solid)) {}

    [[nodiscard]] TriangleMesh build() {
        for (int z = 0; z < size_[2]; ++z) {
            for (int y = 0; y < size_[1]; ++y) {
                for (int x = 0; x < size_[0]; ++x) add_sides({x, y, z});
            }
        }
        return std::move(mesh_);
    }

private:
    [[nodiscard]] bool is_solid(const Cell& cell) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (cell[axis] < 0 || cell[axis] >= size_[axis]) return false;
        }
        return solid_(cell);
    }

    void add_sides(const Cell& cell) {
        if (!is_solid(cell)) return;
        for (const CellSide& side : kCellSides) {
            if (is_solid(cell + side.outward)) continue;
            std::array<std::uint32_t, 4> v{};
            for (std::size_t i = 0; i < 4; ++i) v[i] = vertex(cell + side.corners[i]);
            mesh_.faces.push_back({v[0], v[1], v[2]});
            mesh_.faces.push_back({v[0], v[2], v[3]});
        }
    }

    std::uint32_t vertex(const Cell& corner) {
        const auto [where, is_new] = vertices_.try_emplace(corner, mesh_.vertex_count());
        if (is_new) mesh_.positions.emplace_back(corner[0], corner[1], corner[2]);
        return where->second;
    }

    Cell size_;
    std::function<bool(const Cell&)> solid_;
    std::map<Cell, std::uint32_t> vertices_;
    TriangleMesh mesh_;
};

TriangleMesh icosahedron() {
    const double g = std::numbers::phi;
    TriangleMesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& p : mesh.positions) p.normalize();
    return mesh;
}

// Cuts every face in four with the new vertices on the unit sphere.
TriangleMesh subdivided_sphere(const TriangleMesh& coarse) {
    TriangleMesh fine;
    fine.positions = coarse.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
        const auto [where, is_new] = midpoints.try_emplace(std::minmax(a, b), fine.vertex_count());
        if (is_new) fine.positions.emplace_back((fine.positions[a] + fine.positions[b]).normalized());
        return where->second;
    };
    for (const auto& [a, b, c] : coarse.faces) {
        const std::uint32_t ab = midpoint(a, b);
        const std::uint32_t bc = midpoint(b, c);
        const std::uint32_t ca = midpoint(c, a);
        fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

// A permutation of 0 .. count - 1 (Fisher-Yates).
std::vector<std::uint32_t> permutation(std::uint32_t count, Random& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::uint32_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
}

}  // namespace

TriangleMesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

TriangleMesh cube() {
    return CellSurface({1, 1, 1}, [](const Cell&) { return true; }).build();
}

TriangleMesh icosphere(unsigned subdivisions) {
    TriangleMesh mesh = icosahedron();
    for (unsigned i = 0; i < subdivisions; ++i) mesh = subdivided_sphere(mesh);
    return mesh;
}

TriangleMesh torus(std::uint32_t around, std::uint32_t across) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const double r = 1 + 0.4 * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
            const std::uint32_t here = i * across;
            const std::uint32_t there = (i + 1) % around * across;
            const std::uint32_t next = (j + 1) % across;
            mesh.faces.push_back({here + j, there + j, there + next});
            mesh.faces.push_back({here + j, there + next, here + next});
        }
    }
    return mesh;
}

TriangleMesh plate_with_holes(std::uint32_t holes) {
    const auto solid = [](const Cell& cell) { return cell[1] != 1 || cell[0] % 2 == 0; };
    return CellSurface({static_cast<int>(2 * holes + 1), 3, 1}, solid).build();
}

TriangleMesh cube_frame() {
    const auto solid = [](const Cell& cell) { return std::count(cell.begin(), cell.end(), 1) <= 1; };
    return CellSurface({3, 3, 3}, solid).build();
}

TriangleMesh sliver_cylinder(std::uint32_t segments, double length) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const double angle = 2 * std::numbers::pi * i / segments;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), length);
        const std::uint32_t low = 2 * i;
        const std::uint32_t next = 2 * ((i + 1) % segments);
        mesh.faces.push_back({low, next, next + 1});
        mesh.faces.push_back({low, next + 1, low + 1});
    }
    for (std::uint32_t i = 1; i + 1 < segments; ++i) {
        mesh.faces.push_back({0, 2 * (i + 1), 2 * i});
        mesh.faces.push_back({1, 2 * i + 1, 2 * (i + 1) + 1});
    }
    return mesh;
}

TriangleMesh bumpy_sphere(unsigned subdivisions, double noise, std::uint64_t seed) {
    TriangleMesh mesh = icosphere(subdivisions);
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        const double waves = 0.1 * std::sin(5 * p.x()) * std::sin(4 * p.y() + 1) + 0.05 * std::cos(9 * p.z());
        p *= 1 + waves + random.uniform(-noise, noise);
    }
    return mesh;
}

TriangleMesh noisy_cube(std::uint32_t cells, double noise, std::uint64_t seed) {
    const auto size = static_cast<int>(cells);
    TriangleMesh mesh = CellSurface({size, size, size}, [](const Cell&) { return true; }).build();
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        for (double& x : p) x = (x + random.uniform(-noise, noise)) / cells;
    }
    return mesh;
}

TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
    Random random(seed);
    const std::vector<std::uint32_t> new_index = permutation(mesh.vertex_count(), random);
    TriangleMesh result;
    result.positions.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) result.positions[new_index[v]] = mesh.positions[v];
    for (const std::uint32_t f : permutation(mesh.face_count(), random)) {
        Triangle face = mesh.faces[f];
        std::rotate(face.begin(), face.begin() + random.below(3), face.end());
        for (std::uint32_t& v : face) v = new_index[v];
        result.faces.push_back(face);
    }
    return result;
}

TriangleMesh joined(const TriangleMesh& left, const TriangleMesh& right, const Vec3& offset) {
    TriangleMesh mesh = left;
    for (const Vec3& p : right.positions) mesh.positions.emplace_back(p + offset);
    const std::uint32_t first = left.vertex_count();
    for (const auto& [a, b, c] : right.faces) mesh.faces.push_back({first + a, first + b, first + c});
    return mesh;
}

TriangleMesh punctured(const TriangleMesh& mesh, const std::vector<std::uint32_t>& at) {
    TriangleMesh open;
    std::vector<std::uint32_t> number(mesh.positions.size(), 0);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (std::find(at.begin(), at.end(), v) != at.end()) continue;
        number[v] = open.vertex_count();
        open.positions.push_back(mesh.positions[v]);
    }
    for (const Triangle& f : mesh.faces) {
        if (std::find_first_of(f.begin(), f.end(), at.begin(), at.end()) != f.end()) continue;
        open.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
    }
    return open;
}

TriangleMesh square(std::uint32_t cells) {
    TriangleMesh mesh;
    for (std::uint32_t y = 0; y <= cells; ++y) {
        for (std::uint32_t x = 0; x <= cells; ++x) mesh.positions.emplace_back(x, y, 0);
    }
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t corner = y * (cells + 1) + x, above = corner + cells + 1;
            mesh.faces.push_back({corner, corner + 1, above + 1});
            mesh.faces.push_back({corner, above + 1, above});
        }
    }
    return mesh;
}

TriangleMesh holed_square(std::uint32_t cells, std::uint32_t holes) {
    TriangleMesh mesh = square(cells);
    TriangleMesh holed{mesh.positions, {}};
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t x = f / 2 % cells, y = f / 2 / cells;
        const bool hole = y == cells / 2 && x % 2 == 1 && x / 2 < holes;
        if (!hole) holed.faces.push_back(mesh.faces[f]);
    }
    return holed;
}

TriangleMesh open_cylinder(std::uint32_t around, std::uint32_t along) {
    TriangleMesh mesh;
    for (std::uint32_t row = 0; row <= along; ++row) {
        for (std::uint32_t n = 0; n < around; ++n) {
            const double angle = 2 * std::numbers::pi * n / around;
            mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 2.0 * row / along);
        }
    }
    for (std::uint32_t row = 0; row < along; ++row) {
        for (std::uint32_t n = 0; n < around; ++n) {
            const std::uint32_t a = row * around + n, b = row * around + (n + 1) % around;
            mesh.faces.push_back({a, b, b + around});
            mesh.faces.push_back({a, b + around, a + around});
        }
    }
    return mesh;
}

TriangleMesh hemisphere(std::uint32_t around, std::uint32_t along) {
    TriangleMesh mesh = open_cylinder(around, along - 1);
    for (std::uint32_t row = 0; row < along; ++row) {
        const double height = std::numbers::pi / 2 * row / along;
        for (std::uint32_t n = 0; n < around; ++n) {
            Vec3& p = mesh.positions[row * around + n];
            p = {p.x() * std::cos(height), p.y() * std::cos(height), std::sin(height)};
        }
    }
    const auto pole = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, 1);
    for (std::uint32_t n = 0; n < around; ++n) mesh.faces.push_back({pole - around + n, pole - around + (n + 1) % around, pole});
    return mesh;
}

std::vector<NamedMesh> small_meshes() {
    return {
        {"tetrahedron", tetrahedron()},
        {"cube", cube()},
        {"icosphere", icosphere(3)},
        {"torus", torus(40, 20)},
        {"plate_with_two_holes", plate_with_holes(2)},
        {"cube_frame", cube_frame()},
        {"sliver_cylinder", sliver_cylinder(64, 20)},
        {"bumpy_sphere", bumpy_sphere(3, 0.01, 1)},
        {"shuffled_torus", shuffled(torus(24, 12), 2)},
        {"two_components", joined(icosphere(2), torus(24, 12), Vec3(4, 0, 0))},
    };
}

std::filesystem::path data_file(const std::string& name) { return std::filesystem::path(VSPLIT_TEST_DATA) / name; }

std::vector<std::filesystem::path> own_closed_meshes() {
    return {data_file("crankshaft.stl"), data_file("bracket.stl"), data_file("combined.stl"), data_file("scan.ply")};
}

std::vector<std::filesystem::path> shared_closed_meshes(bool with_needles) {
    const std::string needles = "combined_generic_twin.obj";
    std::vector<std::filesystem::path> paths;
    for (const char* name : {"analog_fire_phone_case.stl", "cad_adis16480_ascii.stl", "cad_counter_assembly_84k.stl",
                             "cad_fanuc_lrmate200id_link3.stl", "cad_robotiq_ft300.stl", "cad_tray_bottom_panel_ascii.stl",
                             "cad_unitree_z1_link01.stl", "combined_generic_twin.obj", "combined_openscad_goodmouse_3k.stl",
                             "fe_sfepy_wheelset_surface.off", "scan_hammer_60k.obj", "scan_nefertiti_70k.obj"}) {
        std::filesystem::path path = std::filesystem::path(VSPLIT_SHARED_MESHES) / name;
        if (std::filesystem::exists(path) && (with_needles || name != needles)) paths.push_back(std::move(path));
    }
    return paths;
}

std::string test_name(const std::filesystem::path& path) {
    std::string name = path.stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

}  // namespace vsplit::test
