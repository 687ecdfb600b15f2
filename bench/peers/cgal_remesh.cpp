/// CGAL's isotropic_remeshing as its users run it, a program of its own: CGAL is under the GPL, so nothing of vsplit is linked
/// here and nothing of this is linked into vsplit. Meshes go in and out as OFF files.
///
///     peer_cgal_remesh IN.off OUT.off --faces N [--iterations 5] [--angle 40] [--protect 1] [--seconds 60]
///
/// Edges sharper than the angle (degrees) and boundary edges are constraints. With --protect 1 they are split to the target
/// length first and then left alone (the manual's way to keep creases exactly); with 0 they may be split and collapsed along
/// themselves. The target length is searched until the result has N faces within 2 %, for --seconds of CPU at most; the nearest
/// run is written. Prints one line of JSON: faces, edge_length, runs, and seconds, the CPU time of the run that was written.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using EdgeMark = Mesh::Property_map<Mesh::Edge_index, bool>;

struct Options {
    std::string in;
    std::string out;
    double faces = 0;      ///< faces asked for, >= 4
    int iterations = 5;    ///< of isotropic_remeshing, >= 1
    double angle = 40;     ///< degrees, 0 to 180; sharper edges are constraints
    bool protect = true;   ///< constraints are left alone once they are split to length
    double seconds = 60;   ///< CPU seconds after which the search starts no further run
    double within = 0.02;  ///< share of `faces` the result may be off
    int runs = 8;          ///< most runs of the search
};

struct Run {
    double edge_length = 0;
    double seconds = 0;
    Mesh mesh;

    [[nodiscard]] double faces() const { return static_cast<double>(mesh.number_of_faces()); }
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Run remesh(const Mesh& source, double edge_length, const Options& options) {
    Run run{edge_length, 0, source};
    const double start = cpu_seconds();
    EdgeMark constrained = run.mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
    pmp::detect_sharp_edges(run.mesh, options.angle, constrained);
    if (options.protect) {
        std::vector<Mesh::Edge_index> marked;
        for (const Mesh::Edge_index e : edges(run.mesh)) {
            if (constrained[e]) marked.push_back(e);
        }
        pmp::split_long_edges(marked, edge_length, run.mesh, CGAL::parameters::edge_is_constrained_map(constrained));
    }
    pmp::isotropic_remeshing(faces(run.mesh), edge_length, run.mesh,
                             CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
                                 .protect_constraints(options.protect)
                                 .edge_is_constrained_map(constrained));
    run.mesh.collect_garbage();
    run.seconds = cpu_seconds() - start;
    return run;
}

/// Faces go about with the inverse square of the length; the bracket keeps the next guess where the answer must be.
class LengthSearch {
public:
    LengthSearch(double first, double faces) : next_(first), faces_(faces) {}

    [[nodiscard]] double next() const { return next_; }

    void tell(double faces) {
        (faces > faces_ ? too_short_ : too_long_) = next_;
        const double guess = next_ * std::sqrt(faces / faces_);
        const bool outside = (too_short_ && guess <= *too_short_) || (too_long_ && guess >= *too_long_);
        next_ = outside && too_short_ && too_long_ ? std::sqrt(*too_short_ * *too_long_) : guess;
    }

private:
    double next_;
    double faces_;
    std::optional<double> too_short_;
    std::optional<double> too_long_;
};

Run search(const Mesh& source, const Options& options, int& runs) {
    const double start = cpu_seconds();
    const double equilateral = std::sqrt(4 * CGAL::to_double(pmp::area(source)) / (options.faces * std::sqrt(3.0)));
    LengthSearch search(equilateral, options.faces);
    std::optional<Run> best;
    const auto distance = [&](const Run& run) { return std::abs(run.faces() - options.faces); };
    for (runs = 0; runs < options.runs; ++runs) {
        Run run = remesh(source, search.next(), options);
        search.tell(run.faces());
        if (!best || distance(run) < distance(*best)) best = std::move(run);
        if (distance(*best) <= options.within * options.faces || cpu_seconds() - start > options.seconds) return *best;
    }
    return *best;
}

std::optional<Options> parse(const std::vector<std::string>& words) {
    if (words.size() < 2 || words.size() % 2 != 0) return std::nullopt;
    Options options;
    options.in = words[0];
    options.out = words[1];
    for (std::size_t i = 2; i < words.size(); i += 2) {
        const double value = std::strtod(words[i + 1].c_str(), nullptr);
        if (words[i] == "--faces" && value >= 4) {
            options.faces = value;
        } else if (words[i] == "--iterations" && value >= 1) {
            options.iterations = static_cast<int>(value);
        } else if (words[i] == "--angle" && value >= 0 && value <= 180) {
            options.angle = value;
        } else if (words[i] == "--protect" && (value == 0 || value == 1)) {
            options.protect = value == 1;
        } else if (words[i] == "--seconds" && value > 0) {
            options.seconds = value;
        } else {
            return std::nullopt;
        }
    }
    return options.faces >= 4 ? std::optional(options) : std::nullopt;
}

int run(const Options& options) {
    Mesh source;
    if (!CGAL::IO::read_OFF(options.in, source) || source.number_of_faces() == 0) {
        std::fprintf(stderr, "%s: CGAL reads no manifold mesh from it\n", options.in.c_str());
        return 1;
    }
    pmp::remove_degenerate_faces(source);
    int runs = 0;
    const Run best = search(source, options, runs);
    if (!CGAL::IO::write_OFF(options.out, best.mesh, CGAL::parameters::stream_precision(17))) {
        std::fprintf(stderr, "%s: cannot be written\n", options.out.c_str());
        return 1;
    }
    std::printf("{\"faces\": %zu, \"edge_length\": %.6g, \"runs\": %d, \"seconds\": %.3f}\n",
                static_cast<std::size_t>(best.faces()), best.edge_length, std::min(runs + 1, options.runs), best.seconds);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::optional<Options> options = parse({argv + 1, argv + argc});
    if (!options) {
        std::fputs(
            "usage: peer_cgal_remesh IN.off OUT.off --faces N [--iterations 5] [--angle 40] [--protect 1] [--seconds 60]\n",
            stderr);
        return 1;
    }
    try {
        return run(*options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "CGAL: %s\n", e.what());
        return 1;
    }
}
