#include "vsplit/shapes/remove_features.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "mesh/drop_unused.h"
#include "shapes/fillet_cut.h"
#include "shapes/improve_patch.h"
#include "shapes/rims.h"
#include "vsplit/features/face_normals.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kSameDiameter = 1e-4;  // share of it: 6 in a file of floats is 6.0000003

Edge edge(std::uint32_t a, std::uint32_t b) { return std::minmax({a, b}); }

double mean_size(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.faces) sum += face_size(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    return sum / mesh.face_count();
}

/// The ids asked for, ascending, each once.
Expected<std::vector<std::uint32_t>> chosen(const std::vector<ShapeFeature>& features, const FeatureRemoval& removal) {
    if (removal.ids.empty() && !removal.max_diameter)
        return Error{Cause::kInvalidOption, "neither ids nor a diameter are given; one of them says which features go", "ids"};
    if (removal.max_diameter && !(*removal.max_diameter > 0)) {
        return Error{Cause::kInvalidOption,
                     "max_diameter is " + number_text(*removal.max_diameter) + "; accepted are lengths over 0", "max_diameter"};
    }
    if (!removal.kinds.empty() && !removal.max_diameter) {
        return Error{Cause::kInvalidOption, "kinds are given without max_diameter; they say which features under it go", "kinds"};
    }
    const auto wanted = [&](ShapeFeature::Kind kind) {
        return removal.kinds.empty() || std::find(removal.kinds.begin(), removal.kinds.end(), kind) != removal.kinds.end();
    };
    std::set<std::uint32_t> ids;
    for (const std::uint32_t id : removal.ids) {
        if (id >= features.size()) {
            const std::string there = features.empty() ? "the mesh has no features"
                                                       : "the mesh has those from 0 to " + std::to_string(features.size() - 1);
            return Error{Cause::kInvalidOption, "there is no feature " + std::to_string(id) + "; " + there, "ids"};
        }
        ids.insert(id);
    }
    for (const ShapeFeature& feature : features) {
        const bool under = removal.max_diameter && feature.diameter <= (1 + kSameDiameter) * *removal.max_diameter;
        if (under && wanted(feature.kind)) ids.insert(feature.id);
    }
    return std::vector<std::uint32_t>(ids.begin(), ids.end());
}

/// What goes with a feature, and the rings it leaves open.
struct Cut {
    std::vector<std::uint32_t> faces;  // ascending
    std::vector<Rim> rims;             // whole ones, or parts that a straight line closes
    bool banded = false;               // a band between the feature's sides is to come as well
};

/// A patch on a ring.
struct Filling {
    Ring ring;
    Patch patch;               // its border in order, as the ring runs
    std::uint32_t beside = 0;  // a face beside the ring, or where that belongs to another surface one that it replaces
};

class Remover {
public:
    explicit Remover(const TriangleMesh& mesh)
        : mesh_(mesh), normals_(face_normals(mesh)), twin_(half_edge_twins(mesh)), gone_(mesh.faces.size(), false) {
        result_.mesh = mesh;
        result_.size = mean_size(mesh);
    }

    void plan(const std::vector<ShapeFeature>& features, const std::vector<std::uint32_t>& ids) {
        std::vector<bool> on_rim(mesh_.positions.size(), false);
        for (const std::uint32_t id : ids) {
            const Expected<Cut> cut = cut_out(features[id]);
            if (!cut) continue;  // `remove` says so
            for (const Rim& rim : cut->rims) mark(on_rim, rim);
            for (const std::vector<std::uint32_t>& side : features[id].sides) {
                for (const std::uint32_t v : side) on_rim[v] = true;
            }
        }
        for (HalfEdge h = 0; h < twin_.size(); ++h) {
            const std::uint32_t a = origin(mesh_, h), b = origin(mesh_, next(h));
            if (h < twin_[h] && on_rim[a] && on_rim[b]) edges_.insert(edge(a, b));
        }
    }

    void remove(const ShapeFeature& feature) {
        const Expected<Cut> cut = cut_out(feature);
        const Expected<std::vector<Filling>> fillings = cut ? fill(feature, *cut) : cut.error();
        if (!fillings) {
            result_.kept.push_back({feature.id, fillings.error().message});
            return;
        }
        for (const std::uint32_t f : cut->faces) gone_[f] = true;
        for (const Filling& filling : *fillings) put(filling);
        result_.removed.push_back(feature.id);
    }

    FeaturelessMesh finish() && {
        TriangleMesh& mesh = result_.mesh;
        std::uint32_t to = 0;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            if (gone_[f]) continue;
            mesh.faces[to] = mesh.faces[f];
            if (!mesh.regions.empty()) mesh.regions[to] = mesh.regions[f];
            result_.parent.push_back(f);
            ++to;
        }
        result_.first_new_face = to;
        mesh.faces.resize(to);
        mesh.faces.insert(mesh.faces.end(), faces_.begin(), faces_.end());
        if (!mesh.regions.empty()) mesh.regions.resize(to);
        for (const std::uint32_t beside : beside_) {
            result_.parent.push_back(beside);
            if (!mesh.regions.empty()) mesh.regions.push_back(mesh_.regions[beside]);
        }
        if (!result_.removed.empty()) [[maybe_unused]]
            const WeldCounts dropped = drop_unused(mesh);
        return std::move(result_);
    }

private:
    void mark(std::vector<bool>& on_rim, const Rim& rim) const {
        for (const HalfEdge h : rim) on_rim[origin(mesh_, h)] = on_rim[origin(mesh_, next(h))] = true;
    }

    Expected<Cut> cut_out(const ShapeFeature& feature) const {
        if (feature.kind == ShapeFeature::Kind::kFillet) {
            Expected<FilletCut> cut = cut_fillet(mesh_, normals_, twin_, feature);
            if (!cut) return cut.error();
            return Cut{std::move(cut->faces), std::move(cut->ends), true};
        }
        Expected<std::vector<Rim>> rims = find_rims(mesh_, twin_, feature.faces);
        if (!rims) return rims.error();
        return Cut{feature.faces, *std::move(rims)};
    }

    Status require_untouched(const Cut& cut) const {
        for (const std::uint32_t f : cut.faces) {
            for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
                if (gone_[f] || gone_[face_of(twin_[h])])
                    return Error{Cause::kUnsupported, "its rim lies on a feature that goes as well", ""};
            }
        }
        return Done{};
    }

    /// The edges between faces of a cut: they go with them.
    std::set<Edge> edges_inside(const Cut& cut) const {
        std::set<Edge> edges;
        for (const std::uint32_t f : cut.faces) {
            for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
                if (std::binary_search(cut.faces.begin(), cut.faces.end(), face_of(twin_[h])))
                    edges.insert(edge(origin(mesh_, h), origin(mesh_, next(h))));
            }
        }
        return edges;
    }

    Expected<std::vector<Filling>> fill(const ShapeFeature& feature, const Cut& cut) {
        if (Status untouched = require_untouched(cut); !untouched) return untouched.error();
        std::vector<Filling> fillings;
        std::set<Edge> added;
        const std::set<Edge> leaving = cut.banded ? edges_inside(cut) : std::set<Edge>{};
        const HasEdge has_edge = [&](std::uint32_t a, std::uint32_t b) {
            return (edges_.count(edge(a, b)) > 0 && leaving.count(edge(a, b)) == 0) || added.count(edge(a, b)) > 0;
        };
        const auto add = [&](const Ring& ring, const std::vector<Triangle>& faces, std::uint32_t beside) {
            fillings.push_back({ring, improved(ring, faces, has_edge), beside});
            for (const Edge& e : inner_edges(fillings.back().patch, ring)) added.insert(e);
        };
        if (cut.banded) {
            const Expected<std::vector<BandPiece>> band = band_between_sides(mesh_, normals_, twin_, feature, has_edge);
            if (!band) return band.error();
            for (const BandPiece& piece : *band) {
                for (std::size_t i = 0; i < piece.border.size(); ++i)
                    added.insert(edge(piece.border[i], piece.border[(i + 1) % piece.border.size()]));
            }
            const std::uint32_t beside = face_beside(feature);
            for (const BandPiece& piece : *band) add(piece.border, piece.faces, beside);
        }
        for (const Rim& rim : cut.rims) {
            Ring ring = origins(mesh_, rim);
            if (cut.banded) ring.push_back(origin(mesh_, next(rim.back())));
            const Expected<std::vector<Triangle>> faces = fill_ring(mesh_, ring, has_edge);
            if (!faces) return faces.error();
            add(ring, *faces, cut.banded ? face_of(rim.front()) : face_of(twin_[rim.front()]));
        }
        edges_.merge(added);
        return fillings;
    }

    /// The face on the other side of where a fillet's first side begins.
    std::uint32_t face_beside(const ShapeFeature& fillet) const {
        const std::vector<std::uint32_t>& side = fillet.sides[0];
        for (const std::uint32_t f : fillet.faces) {
            for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
                if (origin(mesh_, h) == side[0] && origin(mesh_, next(h)) == side[1]) return face_of(twin_[h]);
            }
        }
        return fillet.faces.front();
    }

    /// The filling of a ring, improved; as it was where that would join two vertices that are joined already.
    Patch improved(const Ring& ring, const std::vector<Triangle>& faces, const HasEdge& has_edge) const {
        Patch raw{{{}, faces}, static_cast<std::uint32_t>(ring.size())};
        std::vector<Edge> number;  // vertex of the mesh, place on the ring
        for (std::uint32_t i = 0; i < raw.border; ++i) {
            number.emplace_back(ring[i], i);
            raw.mesh.positions.push_back(mesh_.positions[ring[i]]);
        }
        std::sort(number.begin(), number.end());
        for (Triangle& t : raw.mesh.faces) {
            for (std::uint32_t& corner : t) corner = std::lower_bound(number.begin(), number.end(), Edge(corner, 0))->second;
        }
        Patch better = improve_patch(raw, result_.size);
        const std::vector<Edge> edges = inner_edges(better, ring);
        const bool joined = std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return has_edge(e.first, e.second); });
        return joined ? raw : better;
    }

    /// Edges inside a patch between two vertices of the ring.
    static std::vector<Edge> inner_edges(const Patch& patch, const Ring& ring) {
        std::vector<Edge> edges;
        const std::vector<HalfEdge> twins = half_edge_twins(patch.mesh);
        for (HalfEdge h = 0; h < twins.size(); ++h) {
            const std::uint32_t a = origin(patch.mesh, h), b = origin(patch.mesh, next(h));
            if (twins[h] != kNone && h < twins[h] && a < patch.border && b < patch.border)
                edges.push_back(edge(ring[a], ring[b]));
        }
        return edges;
    }

    void put(const Filling& filling) {
        std::vector<std::uint32_t> number = filling.ring;
        const Patch& patch = filling.patch;
        for (std::uint32_t v = patch.border; v < patch.mesh.vertex_count(); ++v) {
            number.push_back(result_.mesh.vertex_count());
            result_.mesh.positions.push_back(patch.mesh.positions[v]);
        }
        for (const Triangle& t : patch.mesh.faces) {
            faces_.push_back({number[t[0]], number[t[1]], number[t[2]]});
            beside_.push_back(filling.beside);
        }
    }

    const TriangleMesh& mesh_;
    const FaceNormals normals_;
    const std::vector<HalfEdge> twin_;
    std::vector<bool> gone_;
    std::set<Edge> edges_;  // between vertices of rims
    std::vector<Triangle> faces_;
    std::vector<std::uint32_t> beside_;
    FeaturelessMesh result_;
};

}  // namespace

Expected<FeaturelessMesh> remove_features(const TriangleMesh& mesh, const FeatureRemoval& removal,
                                          const ExecutionContext& context) {
    const Expected<std::vector<ShapeFeature>> features = list_features(mesh, removal.search);
    if (!features) return features.error();
    const Expected<std::vector<std::uint32_t>> ids = chosen(*features, removal);
    if (!ids) return ids.error();
    Remover remover(mesh);
    remover.plan(*features, *ids);
    for (std::size_t i = 0; i < ids->size(); ++i) {
        if (context.cancelled()) return ExecutionContext::cancelled_error();
        context.report({"remove", static_cast<double>(i) / static_cast<double>(ids->size()), mesh.face_count()});
        remover.remove((*features)[(*ids)[i]]);
    }
    context.report({"remove", 1, mesh.face_count()});
    return std::move(remover).finish();
}

}  // namespace vsplit
