/// Strict simplification against OpenMesh's Decimater (quadrics and normal flipping), and meshoptimizer (quadrics, no bound on
/// shape) where it was there to build with: the same dense mesh, the same target, one thread each, in turn in one process.
/// Seconds are CPU. Prints faces removed a second and their ratio, and what shape each leaves; with --json, one line of JSON.
///
///     bench_openmesh MESH [--faces DENSE] [--keep SHARE] [--rounds N] [--json]

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef VSPLIT_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "vsplit/base/memory.h"
#include "vsplit/vsplit.h"

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The most the process ever had, bytes.
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// What of the process is in memory now, bytes.
double resident_memory() {
    std::ifstream statm("/proc/self/statm");
    double all = 0, resident = 0;
    statm >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// What is allocated now, bytes.
double memory_in_use() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Peer = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

struct Options {
    std::string mesh;
    std::uint32_t dense_faces = 300'000;
    double keep = 0.1;
    int rounds = 3;
    bool json = false;
};

struct Outcome {
    double seconds = 0;
    std::uint32_t removed = 0;
    vsplit::Quality quality;
    double peak_bytes = 0;  // of the run beyond what was there before, in the first round
    double mrr_bytes = 0;   // of the representation that is left

    [[nodiscard]] double rate() const { return removed / seconds; }
};

/// The mesh cut so that it has about as many faces as asked.
vsplit::TriangleMesh densify(const vsplit::TriangleMesh& mesh, std::uint32_t faces) {
    const vsplit::ExecutionContext context;
    double size = vsplit::bounding_box(mesh).diagonal();
    while (vsplit::predict_subdivision(mesh, size / 1.1, 2ULL * faces) <= faces) size /= 1.1;
    const auto dense = vsplit::subdivide_to_size(mesh, size, 2 * faces, context);
    return dense ? dense->mesh : mesh;
}

Outcome run_vsplit(const vsplit::TriangleMesh& dense, std::uint32_t target) {
    const double diagonal = vsplit::bounding_box(dense).diagonal();
    const vsplit::ImproveOptions options{.subdivision_size = diagonal,
                                         .tolerance = 0.01 * diagonal,
                                         .faces = target,
                                         .faces_min = target,
                                         .mode = vsplit::Mode::kStrict};
    const vsplit::ExecutionContext context({}, 1);
    malloc_trim(0);
    const double before = memory_in_use(), resident = resident_memory();
    const double start = cpu_seconds();
    const auto result = vsplit::improve(dense, options, {}, context);
    Outcome outcome;
    outcome.seconds = cpu_seconds() - start;
    if (!result) return outcome;
    outcome.peak_bytes = peak_memory() - resident;
    outcome.mrr_bytes = memory_in_use() - before;
    outcome.removed = dense.face_count() - result->mrr.faces_min();
    outcome.quality = result->quality;
    return outcome;
}

Peer to_peer(const vsplit::TriangleMesh& mesh) {
    Peer peer;
    std::vector<Peer::VertexHandle> handles;
    handles.reserve(mesh.positions.size());
    for (const vsplit::Vec3& p : mesh.positions) handles.push_back(peer.add_vertex(Peer::Point(p.x(), p.y(), p.z())));
    for (const vsplit::Triangle& t : mesh.faces) peer.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
    return peer;
}

vsplit::TriangleMesh from_peer(Peer& peer) {
    peer.garbage_collection();
    vsplit::TriangleMesh mesh;
    for (const auto v : peer.vertices()) mesh.positions.emplace_back(peer.point(v)[0], peer.point(v)[1], peer.point(v)[2]);
    for (const auto f : peer.faces()) {
        vsplit::Triangle t{};
        std::size_t corner = 0;
        for (const auto v : f.vertices()) t[corner++] = static_cast<std::uint32_t>(v.idx());
        mesh.faces.push_back(t);
    }
    return mesh;
}

Outcome run_peer(const vsplit::TriangleMesh& dense, std::uint32_t target) {
    Peer peer = to_peer(dense);
    const double start = cpu_seconds();
    peer.request_face_normals();
    peer.update_face_normals();
    OpenMesh::Decimater::DecimaterT<Peer> decimater(peer);
    OpenMesh::Decimater::ModQuadricT<Peer>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<Peer>::Handle flipping;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.add(flipping);
    decimater.initialize();
    const std::size_t collapses = decimater.decimate_to_faces(0, target);
    Outcome outcome;
    outcome.seconds = cpu_seconds() - start;
    const vsplit::TriangleMesh result = from_peer(peer);
    outcome.removed = collapses > 0 ? dense.face_count() - result.face_count() : 0;
    outcome.quality = vsplit::measure_quality(result);
    return outcome;
}

#ifdef VSPLIT_MESHOPTIMIZER
Outcome run_meshoptimizer(const vsplit::TriangleMesh& dense, std::uint32_t target) {
    std::vector<float> points;
    for (const vsplit::Vec3& p : dense.positions) {
        for (const double x : p) points.push_back(static_cast<float>(x));
    }
    std::vector<unsigned> indices;
    for (const vsplit::Triangle& t : dense.faces) indices.insert(indices.end(), t.begin(), t.end());
    std::vector<unsigned> kept(indices.size());
    const double start = cpu_seconds();
    kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), points.data(), dense.positions.size(),
                                 3 * sizeof(float), std::size_t{3} * target, 1.0F));
    Outcome outcome;
    outcome.seconds = cpu_seconds() - start;
    vsplit::TriangleMesh result{dense.positions, {}};
    for (std::size_t i = 0; i + 2 < kept.size(); i += 3) result.faces.push_back({kept[i], kept[i + 1], kept[i + 2]});
    outcome.removed = dense.face_count() - result.face_count();
    outcome.quality = vsplit::measure_quality(result);
    return outcome;
}
#endif

const Outcome& median(std::vector<Outcome>& outcomes) {
    std::sort(outcomes.begin(), outcomes.end(), [](const Outcome& l, const Outcome& r) { return l.seconds < r.seconds; });
    return outcomes[outcomes.size() / 2];
}

void print(const char* name, const Outcome& o) {
    std::printf("%-28s %8.3f s %10.0f faces/s   stretch mean %.3f min %.4f p01 %.3f, under 0.2: %u, valence max %u\n", name,
                o.seconds, o.rate(), o.quality.stretch_mean, o.quality.stretch_min, o.quality.stretch_p01,
                o.quality.faces_below_02, o.quality.valence_max);
}

int usage() {
    std::fputs("usage: bench_openmesh MESH [--faces DENSE=300000] [--keep SHARE=0.1] [--rounds N=3] [--json]\n", stderr);
    return 1;
}

bool parse(const std::vector<std::string>& arguments, Options& options) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word.rfind("--", 0) != 0) {
            options.mesh = word;
            continue;
        }
        if (word == "--json") {
            options.json = true;
            continue;
        }
        if (++i == arguments.size()) return false;
        const double value = std::strtod(arguments[i].c_str(), nullptr);
        if (word == "--faces" && value >= 100) {
            options.dense_faces = static_cast<std::uint32_t>(value);
        } else if (word == "--keep" && value > 0 && value < 1) {
            options.keep = value;
        } else if (word == "--rounds" && value >= 1) {
            options.rounds = static_cast<int>(value);
        } else {
            return false;
        }
    }
    return !options.mesh.empty();
}

}  // namespace

int main(int argc, char** argv) {
    vsplit::return_large_memory();  // as the program does
    Options options;
    if (!parse({argv + 1, argv + argc}, options)) return usage();
    const auto read = vsplit::read_mesh_file(options.mesh, {.weld = 0});
    if (!read) {
        std::fprintf(stderr, "%s\n", read.error().message.c_str());
        return 1;
    }
    const vsplit::TriangleMesh dense = densify(read->mesh, options.dense_faces);
    const auto target = static_cast<std::uint32_t>(dense.face_count() * options.keep);
    if (!options.json)
        std::printf("%s: %u faces, subdivided to %u, asked for %u; one thread each, %d rounds in turn, medians\n",
                    options.mesh.c_str(), read->mesh.face_count(), dense.face_count(), target, options.rounds);
    std::vector<Outcome> ours;
    std::vector<Outcome> theirs;
    std::vector<Outcome> optimizer;
    for (int round = 0; round < options.rounds; ++round) {
        ours.push_back(run_vsplit(dense, target));
        theirs.push_back(run_peer(dense, target));
#ifdef VSPLIT_MESHOPTIMIZER
        optimizer.push_back(run_meshoptimizer(dense, target));
#endif
    }
    const double peak_bytes = ours.front().peak_bytes / dense.face_count();
    const Outcome& our_median = median(ours);
    const Outcome& their_median = median(theirs);
    if (options.json) {
        const double ratio = their_median.removed > 0 ? our_median.rate() / their_median.rate() : 0;
        std::printf("{\"faces\": %u, \"seconds\": %.3f, \"faces_a_second\": %.0f, \"openmesh_seconds\": %.3f, \"ratio\": %.3f",
                    dense.face_count(), our_median.seconds, our_median.rate(), their_median.seconds, ratio);
        if (!optimizer.empty()) std::printf(", \"meshoptimizer_seconds\": %.3f", median(optimizer).seconds);
        std::printf(", \"peak_bytes_a_face\": %.1f, \"mrr_bytes_a_face\": %.1f}\n", peak_bytes,
                    our_median.mrr_bytes / dense.face_count());
        return our_median.removed == 0;
    }
    print("vsplit strict", our_median);
    print("OpenMesh Decimater", their_median);
    if (!optimizer.empty()) print("meshoptimizer", median(optimizer));
    if (our_median.removed == 0 || their_median.removed == 0) {
        std::fputs("one of the two removed nothing: no ratio\n", stderr);
        return 1;
    }
    std::printf("ratio of faces removed a second: %.2f\n", our_median.rate() / their_median.rate());
    return 0;
}
