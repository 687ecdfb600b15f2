#include "vsplit/shapes/remove_features.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "mesh/drop_unused.h"
#include "shapes/improve_patch.h"
#include "shapes/rims.h"
#include "vsplit/quality/stretch.h"

namespace vsplit {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

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
        if (removal.max_diameter && feature.diameter <= *removal.max_diameter) ids.insert(feature.id);
    }
    return std::vector<std::uint32_t>(ids.begin(), ids.end());
}

/// What comes in the place of a feature's faces.
struct Filling {
    std::vector<Patch> patches;  // their borders in order, as the rims run
    std::vector<Rim> rims;
};

class Remover {
public:
    explicit Remover(const TriangleMesh& mesh) : mesh_(mesh), twin_(half_edge_twins(mesh)), gone_(mesh.faces.size(), false) {
        result_.mesh = mesh;
        result_.size = mean_size(mesh);
    }

    void plan(const std::vector<ShapeFeature>& features, const std::vector<std::uint32_t>& ids) {
        std::vector<bool> on_rim(mesh_.positions.size(), false);
        for (const std::uint32_t id : ids) {
            const Expected<std::vector<Rim>> rims = find_rims(mesh_, twin_, features[id].faces);
            if (!rims) continue;  // `remove` says so
            for (const Rim& rim : *rims) {
                for (const HalfEdge h : rim) on_rim[origin(mesh_, h)] = true;
            }
        }
        for (HalfEdge h = 0; h < twin_.size(); ++h) {
            const std::uint32_t a = origin(mesh_, h), b = origin(mesh_, next(h));
            if (h < twin_[h] && on_rim[a] && on_rim[b]) edges_.insert(edge(a, b));
        }
    }

    void remove(const ShapeFeature& feature) {
        Expected<Filling> filling = fill(feature);
        if (!filling) {
            result_.kept.push_back({feature.id, filling.error().message});
            return;
        }
        for (const std::uint32_t f : feature.faces) gone_[f] = true;
        for (std::size_t i = 0; i < filling->rims.size(); ++i) put(filling->patches[i], filling->rims[i]);
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
    Expected<Filling> fill(const ShapeFeature& feature) {
        Expected<std::vector<Rim>> rims = find_rims(mesh_, twin_, feature.faces);
        if (!rims) return rims.error();
        Filling filling{{}, *std::move(rims)};
        std::set<Edge> added;
        for (const Rim& rim : filling.rims) {
            for (const HalfEdge h : rim) {
                if (gone_[face_of(twin_[h])])
                    return Error{Cause::kUnsupported, "its rim lies on a feature that goes as well", ""};
            }
            const auto has_edge = [&](std::uint32_t a, std::uint32_t b) {
                return edges_.count(edge(a, b)) > 0 || added.count(edge(a, b)) > 0;
            };
            const Expected<std::vector<Triangle>> faces = fill_rim(mesh_, rim, has_edge);
            if (!faces) return faces.error();
            filling.patches.push_back(improved(rim, *faces, has_edge));
            for (const Edge& e : inner_edges(filling.patches.back(), rim)) added.insert(e);
        }
        edges_.merge(added);
        return filling;
    }

    /// The filling of a rim, improved; as it was where that would join two vertices that are joined already.
    template <class HasEdge>
    Patch improved(const Rim& rim, const std::vector<Triangle>& faces, const HasEdge& has_edge) const {
        Patch raw{{{}, faces}, static_cast<std::uint32_t>(rim.size())};
        std::vector<Edge> number;  // vertex of the mesh, place on the rim
        for (std::uint32_t i = 0; i < raw.border; ++i) {
            number.emplace_back(origin(mesh_, rim[i]), i);
            raw.mesh.positions.push_back(mesh_.positions[number.back().first]);
        }
        std::sort(number.begin(), number.end());
        for (Triangle& t : raw.mesh.faces) {
            for (std::uint32_t& corner : t) corner = std::lower_bound(number.begin(), number.end(), Edge(corner, 0))->second;
        }
        Patch better = improve_patch(raw, result_.size);
        const std::vector<Edge> edges = inner_edges(better, rim);
        const bool joined = std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return has_edge(e.first, e.second); });
        return joined ? raw : better;
    }

    /// Edges inside a patch between two vertices of the rim.
    std::vector<Edge> inner_edges(const Patch& patch, const Rim& rim) const {
        std::vector<Edge> edges;
        const std::vector<HalfEdge> twins = half_edge_twins(patch.mesh);
        for (HalfEdge h = 0; h < twins.size(); ++h) {
            const std::uint32_t a = origin(patch.mesh, h), b = origin(patch.mesh, next(h));
            if (twins[h] != kNone && h < twins[h] && a < patch.border && b < patch.border)
                edges.push_back(edge(origin(mesh_, rim[a]), origin(mesh_, rim[b])));
        }
        return edges;
    }

    void put(const Patch& patch, const Rim& rim) {
        std::vector<std::uint32_t> number;
        for (const HalfEdge h : rim) number.push_back(origin(mesh_, h));
        for (std::uint32_t v = patch.border; v < patch.mesh.vertex_count(); ++v) {
            number.push_back(result_.mesh.vertex_count());
            result_.mesh.positions.push_back(patch.mesh.positions[v]);
        }
        for (const Triangle& t : patch.mesh.faces) {
            faces_.push_back({number[t[0]], number[t[1]], number[t[2]]});
            beside_.push_back(face_of(twin_[rim.front()]));
        }
    }

    const TriangleMesh& mesh_;
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
