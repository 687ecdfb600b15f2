// Sizes and speeds of the encodings of records, against mesh files and mesh codecs, on .vsplit files: tables in Markdown.
// bench_records FILE...; bench_records --stream FILE prints the stream at 14 bits instead.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numeric>
#include <vector>

#include "records/mesh_codecs.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/record_codec.h"

namespace {

using namespace vsplit;

/// Of this process: others on the machine do not count.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// As many as in JavaScript (client/web/decoder/test/bench.ts): a process that has just begun is given its memory slowly.
constexpr int kRounds = 5;

struct Figures {
    std::size_t base = 0, records = 0;
    double encode = std::numeric_limits<double>::max(), decode = encode;  ///< seconds, the fewest of kRounds
};

/// What goes over the wire up to a level, and how long it takes at both ends.
Figures measure(const MultiresMesh& mrr, const EncodingChoice& choice, std::size_t level) {
    const PositionGrid grid = *PositionGrid::over(mrr, choice);
    TriangleMesh base = mrr.base;
    for (Vec3& position : base.positions) position = grid.snap(position);
    Figures figures;
    figures.base = choice.encoding == RecordEncoding::kFloat64 ? 24 * base.positions.size() + 12 * base.faces.size()
                                                               : pack_base(base, mrr.ghosts, grid).size();
    const ProgressiveMesh start = *ProgressiveMesh::from_base(base, mrr.ghosts);
    RecordCodec codec(grid);
    const std::size_t records = mrr.record_of_level(level);
    for (int round = 0; round < kRounds; ++round) {
        ProgressiveMesh sender = start, reader = start;
        std::vector<RecordBlock> blocks;
        double begin = cpu_seconds();
        while (sender.records() < records) blocks.push_back(*codec.encode(mrr.records, sender.records(), records, sender));
        figures.encode = std::min(figures.encode, cpu_seconds() - begin);
        begin = cpu_seconds();
        reader.foresee(level);  // as a stream's base mesh and a file's header announce
        for (const RecordBlock& block : blocks) {
            if (const Status done = codec.decode(block, reader); !done) std::printf("%s\n", done.error().message.c_str());
        }
        figures.decode = std::min(figures.decode, cpu_seconds() - begin);
        if (reader.mesh() != sender.mesh()) std::printf("the meshes differ\n");
        figures.records = std::accumulate(blocks.begin(), blocks.end(), std::size_t{0},
                                          [](std::size_t sum, const RecordBlock& block) { return sum + block.payload.size(); });
    }
    return figures;
}

void print_encodings(const std::string& name, const MultiresMesh& mrr) {
    for (const auto& [text, choice] : {std::pair("FLOAT64", EncodingChoice{RecordEncoding::kFloat64, 0}),
                                       {"FLOAT32", {RecordEncoding::kFloat32, 0}},
                                       {"QUANTISED 16", {RecordEncoding::kQuantised, 16}},
                                       {"QUANTISED 14", {RecordEncoding::kQuantised, 14}}}) {
        const Figures f = measure(mrr, choice, mrr.levels());
        const auto splits = static_cast<double>(mrr.levels());
        std::printf("| %s | %s | %u | %zu | %.1f | %.2f | %.2f | %.2f |\n", name.c_str(), text, mrr.faces_max(), mrr.levels(),
                    static_cast<double>(f.base) / mrr.base.vertex_count(), static_cast<double>(f.records) / splits,
                    splits / f.encode / 1e6, splits / f.decode / 1e6);
    }
}

void print_whole(const std::string& name, const MultiresMesh& mrr, std::uint32_t faces) {
    const std::size_t level = mrr.level_for(faces);
    const TriangleMesh mesh = mesh_at(mrr, level);
    const Figures f = measure(mrr, {RecordEncoding::kQuantised, 14}, level);
    const std::size_t whole = f.base + f.records, draco = bench::encode_draco(mesh).size();
    std::printf("| %s | %u | %zu | %zu | %zu | %zu | %zu | %.2f |\n", name.c_str(), mesh.face_count(),
                write_mesh(mesh, MeshFormat::kStlBinary).size(), write_mesh(mesh, MeshFormat::kPlyBinary).size(),
                bench::encode_meshoptimizer(mesh).size(), draco, whole, static_cast<double>(whole) / static_cast<double>(draco));
}

std::string hex(std::span<const std::byte> bytes) {
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes) {
        text += kDigits[static_cast<unsigned>(byte) >> 4U];
        text += kDigits[static_cast<unsigned>(byte) & 15U];
    }
    return text;
}

std::string hex(double value) { return hex(std::as_bytes(std::span(&value, 1))); }

/// The stream of a representation at 14 bits, as the golden files of tests/data/golden are written: for client/web/decoder.
void print_stream(const MultiresMesh& mrr) {
    const PositionGrid grid = *PositionGrid::over(mrr, {RecordEncoding::kQuantised, 14});
    TriangleMesh base = mrr.base;
    for (Vec3& position : base.positions) position = grid.snap(position);
    const std::string packed = pack_base(base, mrr.ghosts, grid);
    std::printf("base %u %u %u 3 14 %s %s %s %s\npacked %s\n", base.vertex_count(), base.face_count(), mrr.ghosts,
                hex(grid.origin().x()).c_str(), hex(grid.origin().y()).c_str(), hex(grid.origin().z()).c_str(),
                hex(grid.step()).c_str(), hex(std::as_bytes(std::span(packed))).c_str());
    ProgressiveMesh mesh = *ProgressiveMesh::from_base(base, mrr.ghosts);
    RecordCodec codec(grid);
    while (mesh.records() < mrr.records.size()) {
        const auto block = codec.encode(mrr.records, mesh.records(), mrr.records.size(), mesh);
        std::printf("block %u %u 3 %u %s\n", block->first, block->count, block->crc32c,
                    hex(std::as_bytes(std::span(block->payload))).c_str());
    }
}

}  // namespace

int main(int count, char** arguments) {
    const bool stream = count == 3 && std::string(arguments[1]) == "--stream";
    std::vector<std::pair<std::string, MultiresMesh>> all;
    for (int n = stream ? 2 : 1; n < count; ++n) {
        const std::filesystem::path path = arguments[n];
        Expected<StoredMrr> stored = load_mrr(path);
        if (!stored) {
            std::fprintf(stderr, "%s: %s\n", path.c_str(), stored.error().message.c_str());
            return 1;
        }
        all.emplace_back(path.stem(), std::move(stored->mrr));
    }
    if (stream) {
        print_stream(all.front().second);
        return 0;
    }
    std::printf(
        "| Representation | Encoding | Faces | Splits | Base, bytes a vertex | Bytes a split | Encode, M splits/s | "
        "Decode and apply, M splits/s |\n|---|---|--:|--:|--:|--:|--:|--:|\n");
    for (const auto& [name, mrr] : all) print_encodings(name, mrr);
    std::printf(
        "\nThe level of 30,000 faces, bytes. Draco and meshoptimizer carry one mesh, records also every coarser one; what "
        "meshoptimizer's codecs\n"
        "are meant to be followed by, a general compressor, was left out.\n"
        "\n| Mesh | Faces | Binary STL | Binary PLY (doubles) | meshoptimizer, 14 bit | Draco, 14 bit | Records, 14 bit | "
        "Records / Draco |\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const auto& [name, mrr] : all) print_whole(name, mrr, 30'000);
    return 0;
}
