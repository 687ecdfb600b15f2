/// CGAL's edge collapse by Garland and Heckbert's quadrics (probabilistic planes), a program of its own as peer_cgal_remesh is:
/// CGAL is under the GPL.
///
///     peer_cgal_decimate IN.off OUT.off FACES
///
/// Prints one line of JSON: faces, and seconds, the CPU time of the collapses alone.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Policies = sms::GarlandHeckbert_probabilistic_plane_policies<Mesh, Kernel>;

int run(const char* in, const char* out, double faces) {
    Mesh mesh;
    if (!CGAL::IO::read_OFF(in, mesh) || mesh.number_of_faces() == 0) {
        std::fprintf(stderr, "%s: CGAL reads no manifold mesh from it\n", in);
        return 1;
    }
    const std::clock_t start = std::clock();
    const Policies policies(mesh);
    const sms::Bounded_normal_change_filter<> filter;
    // On a closed mesh a collapse takes three edges and two faces.
    const sms::Count_stop_predicate<Mesh> stop(static_cast<std::size_t>(1.5 * faces));
    sms::edge_collapse(mesh, stop,
                       CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()).filter(filter));
    mesh.collect_garbage();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!CGAL::IO::write_OFF(out, mesh, CGAL::parameters::stream_precision(17))) {
        std::fprintf(stderr, "%s: cannot be written\n", out);
        return 1;
    }
    std::printf("{\"faces\": %zu, \"seconds\": %.3f}\n", static_cast<std::size_t>(mesh.number_of_faces()), seconds);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 || !(std::strtod(argv[3], nullptr) >= 4)) {
        std::fputs("usage: peer_cgal_decimate IN.off OUT.off FACES\n", stderr);
        return 1;
    }
    try {
        return run(argv[1], argv[2], std::strtod(argv[3], nullptr));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "CGAL: %s\n", e.what());
        return 1;
    }
}
