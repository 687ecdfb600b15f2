// The golden files of tests/data/golden never change: what a version of this library wrote, every later one reads, and so do the
// decoders for other languages (client/web/decoder). A new encoding adds files: VSPLIT_WRITE_GOLDEN=DIRECTORY golden_test writes
// all that this version makes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/core/meshes.h"
#include "vsplit/method/improve.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::test {
namespace {

constexpr std::size_t kBlocks = 4;

std::string hex(std::span<const std::byte> bytes) {
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes) {
        text += kDigits[static_cast<unsigned>(byte) >> 4U];
        text += kDigits[static_cast<unsigned>(byte) & 15U];
    }
    return text;
}

std::string unhex(const std::string& text) {
    std::string bytes;
    for (std::size_t n = 0; n + 1 < text.size(); n += 2)
        bytes.push_back(static_cast<char>(std::stoul(text.substr(n, 2), nullptr, 16)));
    return bytes;
}

std::string hex(double value) { return hex(std::as_bytes(std::span(&value, 1))); }
double double_of(const std::string& text) {
    double value = 0;
    std::memcpy(&value, unhex(text).data(), sizeof(value));
    return value;
}

std::string state_of(const TriangleMesh& mesh) {
    std::ostringstream text;
    text << mesh.vertex_count() << ' ' << mesh.face_count() << ' ' << crc32c(std::as_bytes(std::span(mesh.positions))) << ' '
         << crc32c(std::as_bytes(std::span(mesh.faces)));
    return text.str();
}

/// A line a thing: its kind and what belongs to it, numbers in decimal, doubles and bytes in hex.
std::string write_golden(const MultiresMesh& mrr, const EncodingChoice& choice) {
    const PositionGrid grid = *PositionGrid::over(mrr, choice);
    const TriangleMesh base = on_grid(mrr, grid).base;
    std::ostringstream text;
    text << "base " << base.vertex_count() << ' ' << base.face_count() << ' ' << mrr.ghosts << ' '
         << static_cast<std::uint32_t>(grid.encoding()) << ' ' << grid.bits() << ' ' << hex(grid.origin().x()) << ' '
         << hex(grid.origin().y()) << ' ' << hex(grid.origin().z()) << ' ' << hex(grid.step()) << '\n';
    if (choice.encoding == RecordEncoding::kFloat64) {
        text << "positions " << hex(std::as_bytes(std::span(base.positions))) << '\n'
             << "corners " << hex(std::as_bytes(std::span(base.faces))) << '\n';
    } else {
        const std::string packed = pack_base(base, mrr.ghosts, grid);
        text << "packed " << hex(std::as_bytes(std::span(packed))) << '\n';
    }
    ProgressiveMesh mesh = *ProgressiveMesh::from_base(base, mrr.ghosts);
    RecordCodec codec(grid);
    for (std::size_t n = 1; n <= kBlocks; ++n) {
        const auto block = codec.encode(mrr.records, mesh.records(), mrr.records.size() * n / kBlocks, mesh);
        text << "block " << block->first << ' ' << block->count << ' ' << static_cast<std::uint32_t>(block->encoding) << ' '
             << block->crc32c << ' ' << hex(std::as_bytes(std::span(block->payload))) << '\n'
             << "mesh " << state_of(mesh.mesh()) << '\n';
    }
    return text.str();
}

/// Says all that a header can say.
std::string write_file(const MultiresMesh& mrr, const EncodingChoice& choice) {
    StoredMrr stored{mrr, mrr.faces_at(mrr.levels() / 2), "{}"};
    stored.unit = LengthUnit::kMillimetre;
    SourceHash hash{};
    for (std::size_t n = 0; n < hash.size(); ++n) hash[n] = static_cast<std::uint8_t>(8 * n + 1);
    stored.source = hash;
    stored.deviations = {{0, 0.5}, {static_cast<std::uint32_t>(mrr.levels() / 4), 0.25}};
    return encode_mrr(*in_encoding(stored, choice));
}

/// "closed" and "open" are what files of version 1 hold, so that all versions hold the same. Many points of "improved" are the
/// mean of their ring.
std::vector<std::pair<std::string, MultiresMesh>> all_representations() {
    std::vector<std::pair<std::string, MultiresMesh>> all;
    for (const std::string name : {"closed", "open"})
        all.emplace_back(name, load_mrr(data_file("golden/file_1_" + name + ".vsplit"))->mrr);
    ImproveOptions options;
    options.mode = Mode::kStrict;
    options.subdivision_size = 0.2;
    options.tolerance = 0.1;
    options.faces_min = 300;
    all.emplace_back("improved", improve(bumpy_sphere(3, 0.02, 5), options, {}, {})->mrr);
    return all;
}

std::vector<std::pair<std::string, std::string>> all_golden() {
    std::vector<std::pair<std::string, std::string>> files;
    for (const auto& [of, mrr] : all_representations()) {
        if (of == "improved") files.emplace_back("records_2_float64_improved.golden", write_golden(mrr, {}));
        for (const auto& [name, choice] : {std::pair("float32", EncodingChoice{RecordEncoding::kFloat32, 0}),
                                           {"quantised10", {RecordEncoding::kQuantised, 10}},
                                           {"quantised14", {RecordEncoding::kQuantised, 14}},
                                           {"quantised16", {RecordEncoding::kQuantised, 16}},
                                           {"quantised24", {RecordEncoding::kQuantised, 24}}})
            files.emplace_back(std::string("records_2_") + name + "_" + of + ".golden", write_golden(mrr, choice));
        for (const auto& [name, choice] : {std::pair("float64", EncodingChoice{RecordEncoding::kFloat64, 0}),
                                           {"float32", {RecordEncoding::kFloat32, 0}},
                                           {"quantised14", {RecordEncoding::kQuantised, 14}}})
            files.emplace_back(std::string("file_3_") + name + "_" + of + ".vsplit", write_file(mrr, choice));
    }
    return files;
}

std::vector<std::filesystem::path> golden_files(const std::string& extension) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(data_file("golden"))) {
        if (entry.path().extension() == extension) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Reads a golden file line by line.
class GoldenReader {
public:
    explicit GoldenReader(const std::filesystem::path& path) : file_(path) {}

    void check() {
        for (std::string line; std::getline(file_, line);) {
            std::istringstream words(line);
            std::string kind;
            words >> kind;
            if (kind == "base") read_base(words);
            if (kind == "packed") unpack(words);
            if (kind == "positions") fill(words, base_.positions, vertices_);
            if (kind == "corners") fill(words, base_.faces, faces_);
            if (kind == "block") decode(words);
            if (kind != "mesh") continue;
            ASSERT_EQ(' ' + state_of(mesh_->mesh()), line.substr(kind.size())) << line;
        }
        ASSERT_EQ(blocks_, kBlocks);
        mesh_->rewind(0);
        EXPECT_EQ(mesh_->mesh(), base_);
    }

private:
    void read_base(std::istringstream& words) {
        std::uint32_t encoding = 0, bits = 0;
        std::string x, y, z, step;
        words >> vertices_ >> faces_ >> ghosts_ >> encoding >> bits >> x >> y >> z >> step;
        if (RecordEncoding{encoding} == RecordEncoding::kFloat32) grid_ = PositionGrid::float32();
        if (RecordEncoding{encoding} == RecordEncoding::kQuantised)
            grid_ = *PositionGrid::quantised(bits, Vec3(double_of(x), double_of(y), double_of(z)), double_of(step));
    }
    void unpack(std::istringstream& words) {
        std::string text;
        words >> text;
        const std::string bytes = unhex(text);
        const auto base = unpack_base({std::as_bytes(std::span(bytes)), vertices_, faces_, ghosts_}, grid_);
        ASSERT_TRUE(base) << base.error().message;
        base_ = *base;
    }
    template <class Element>
    static void fill(std::istringstream& words, std::vector<Element>& elements, std::size_t count) {
        std::string text;
        words >> text;
        const std::string bytes = unhex(text);
        ASSERT_EQ(bytes.size(), count * sizeof(Element));
        elements.resize(count);
        std::memcpy(static_cast<void*>(elements.data()), bytes.data(), bytes.size());
    }
    void decode(std::istringstream& words) {
        if (!mesh_) mesh_ = *ProgressiveMesh::from_base(base_, ghosts_);
        RecordBlock block;
        std::uint32_t encoding = 0;
        std::string text;
        words >> block.first >> block.count >> encoding >> block.crc32c >> text;
        block.encoding = RecordEncoding{encoding};
        block.payload = unhex(text);
        const Status decoded = RecordCodec(grid_).decode(block, *mesh_);
        ASSERT_TRUE(decoded) << decoded.error().message;
        ++blocks_;
    }

    std::ifstream file_;
    std::uint32_t vertices_ = 0, faces_ = 0, ghosts_ = 0;
    PositionGrid grid_;
    TriangleMesh base_;
    std::optional<ProgressiveMesh> mesh_;
    std::size_t blocks_ = 0;
};

TEST(GoldenTest, EveryStreamDecodesToTheMeshesItWasMadeFrom) {
    if (const char* directory = std::getenv("VSPLIT_WRITE_GOLDEN")) {
        for (const auto& [name, bytes] : all_golden()) {
            std::ofstream file(std::filesystem::path(directory) / name, std::ios::binary);
            file << bytes;
        }
    }
    const auto files = golden_files(".golden");
    ASSERT_GE(files.size(), 28U);
    for (const std::filesystem::path& path : files) {
        SCOPED_TRACE(path.filename());
        GoldenReader(path).check();
    }
}

TEST(GoldenTest, EveryFileOfThisVersionLoadsAndIsWrittenAsItIs) {
    std::size_t seen = 0;
    for (const std::filesystem::path& path : golden_files(".vsplit")) {
        if (!path.filename().string().starts_with("file_3_")) continue;
        ++seen;
        const auto stored = load_mrr(path);
        ASSERT_TRUE(stored) << path.filename() << ": " << stored.error().message;
        std::ifstream file(path, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        EXPECT_EQ(encode_mrr(*stored), bytes) << path.filename();
    }
    EXPECT_EQ(seen, 9U);
}

TEST(GoldenTest, FilesOfAllVersionsHoldTheSame) {
    for (const std::string name : {"closed", "open"}) {
        const auto first = load_mrr(data_file("golden/file_1_" + name + ".vsplit"));
        ASSERT_TRUE(first) << name;
        for (const std::string version : {"file_2_", "file_3_"}) {
            const auto load = [&](const char* encoding) {
                return load_mrr(data_file((std::ostringstream() << "golden/" << version << encoding << name << ".vsplit").str()));
            };
            const auto later = load("float64_");
            ASSERT_TRUE(later) << version << name;
            EXPECT_EQ(first->mrr, later->mrr) << version << name;
            EXPECT_EQ(first->description, later->description);
            for (const char* const encoding : {"float32_", "quantised14_"}) {
                const auto rounded = load(encoding);
                ASSERT_TRUE(rounded) << version << encoding << name;
                EXPECT_EQ(on_grid(first->mrr, rounded->grid), rounded->mrr) << version << encoding << name;
            }
        }
    }
}

}  // namespace
}  // namespace vsplit::test
