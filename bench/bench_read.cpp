/// Reading at the memory's speed: a binary STL read, welded and inspected, against the time that md5sum takes on the same file
/// (`scripts/bench` measures that and prints the ratio).
///
///     bench_read MESH FILE [--faces N] [--rounds N]     makes FILE from MESH, cut to about N faces, if it is not there

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "vsplit/vsplit.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Cut by length to no more than `faces`.
vsplit::TriangleMesh densify(const vsplit::TriangleMesh& mesh, std::uint32_t faces) {
    const vsplit::ExecutionContext context;
    double size = vsplit::bounding_box(mesh).diagonal();
    while (vsplit::predict_subdivision(mesh, size / 1.1, 2ULL * faces) <= faces) size /= 1.1;
    auto dense = vsplit::subdivide_to_size(mesh, size, 2 * faces, context);
    if (!dense) return mesh;
    return std::move(dense->mesh);
}

bool make(const std::string& from, const std::string& to, std::uint32_t faces) {
    const auto read = vsplit::read_mesh_file(from, {});
    if (!read) {
        std::fprintf(stderr, "%s\n", read.error().message.c_str());
        return false;
    }
    const auto written = vsplit::write_mesh_file(densify(read->mesh, faces), vsplit::MeshFormat::kStlBinary, to);
    if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
    return static_cast<bool>(written);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("usage: bench_read MESH FILE [--faces N=5000000] [--rounds N=3]\n", stderr);
        return 1;
    }
    std::uint32_t faces = 5'000'000;
    int rounds = 3;
    for (int i = 3; i + 1 < argc; i += 2) {
        const std::string word = argv[i];
        if (word == "--faces") faces = static_cast<std::uint32_t>(std::strtod(argv[i + 1], nullptr));
        if (word == "--rounds") rounds = std::max(1, std::atoi(argv[i + 1]));
    }
    if (!std::filesystem::exists(argv[2]) && !make(argv[1], argv[2], faces)) return 1;
    std::vector<std::pair<double, double>> times;
    std::uint32_t found = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto start = Clock::now();
        const auto read = vsplit::read_mesh_file(argv[2], {});
        const double reading = seconds_since(start);
        if (!read) return 1;
        const auto report = vsplit::inspect(read->mesh);
        times.emplace_back(seconds_since(start), reading);
        found = report.faces;
    }
    std::sort(times.begin(), times.end());
    const auto [all, reading] = times[times.size() / 2];
    std::printf("{\"faces\": %u, \"read_weld_seconds\": %.3f, \"inspect_seconds\": %.3f, \"seconds\": %.3f}\n", found, reading,
                all - reading, all);
    return 0;
}
