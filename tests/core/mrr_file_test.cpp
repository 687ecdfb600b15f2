#include "vsplit/mrr/mrr_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "mrr/mrr_layout.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/mrr/record_codec.h"

namespace vsplit::test {
namespace {

namespace fs = std::filesystem;

/// `count` splits that fit `base`: any corner of the mesh as it grows, one step, points near by; and moves before some of them.
MultiresMesh grown(const TriangleMesh& base, std::size_t count) {
    Random random(5);
    MultiresMesh mrr{base, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t corners = 3 * mrr.faces_at(i);
        const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
        if (random.below(4) == 0) mrr.records.push_back(VertexMove{random.below(base.vertex_count()), point()});
        mrr.records.push_back(VertexSplit{random.below(corners), 1 + random.below(2), point(), point()});
    }
    return mrr;
}

/// As docs/format.md has them.
TriangleMesh documented_base() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}
RecordList documented_records() {
    return {VertexSplit{8, 2, {0, 0, 1}, {0.5, 0.5, 0.5}}, EdgeFlip{3}, VertexMove{2, {0, 0.75, 0}},
            VertexSplit{0, 1, {0, 0, 1}, {0, 0.5, 0.5}}};
}

/// Where things stand in a file since version 2 (docs/format.md).
constexpr std::size_t kHeaderCrcAt = 204, kHeaderBytes = 208, kIndexBytes = 40;

/// Three splits, a flip and a move.
StoredMrr example() {
    MultiresMesh mrr{documented_base(), documented_records()};
    mrr.records.push_back(VertexSplit{5, 1, {0, 0, 0}, {1, 1, 1}});
    return {mrr, 10, R"({"method":"IMPROVE"})"};
}

Expected<StoredMrr> decode(const std::string& bytes) { return decode_mrr(std::as_bytes(std::span(bytes))); }

void expect_error(const std::string& bytes, Cause cause, const std::string& place) {
    const Expected<StoredMrr> result = decode(bytes);
    ASSERT_FALSE(result) << place;
    EXPECT_EQ(cause_name(result.error().cause), cause_name(cause)) << result.error().message;
    EXPECT_NE(result.error().message.find(place), std::string::npos) << result.error().message;
}

void put(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes.at(at + i) = static_cast<char>(value >> (8 * i));
}

std::uint32_t crc_of(const std::string& bytes, std::size_t at, std::size_t count) {
    return crc32c(std::as_bytes(std::span(bytes).subspan(at, count)));
}

/// The header's checksum fits again: a file that lies, not one that was damaged.
std::string with_field(std::string bytes, std::size_t at, std::uint32_t value) {
    put(bytes, at, value);
    put(bytes, kHeaderCrcAt, crc_of(bytes, 0, kHeaderCrcAt));
    return bytes;
}

/// The same of version 1.
std::string with_field_1(std::string bytes, std::size_t at, std::uint32_t value) {
    put(bytes, at, value);
    put(bytes, 44, crc_of(bytes, 0, 44));
    return bytes;
}

/// Base mesh, description and index of example() end here.
/// Four vertices and four faces.
constexpr std::size_t kBaseBytes = std::size_t{4} * 24 + std::size_t{4} * 12;

std::size_t blocks_of_example_at() { return kHeaderBytes + kBaseBytes + example().description.size() + kIndexBytes; }

/// A field of the index of example(), whose checksum fits again.
std::string with_index(std::string bytes, std::size_t at, std::uint32_t value) {
    const std::size_t end = blocks_of_example_at();
    put(bytes, end - kIndexBytes + at, value);
    return with_field(bytes, 200, crc_of(bytes, kHeaderBytes, end - kHeaderBytes));
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A file as version 1 had them: what docs/format.md shows.
std::string example_of_version_1() { return bytes_of(data_file("golden/file_1_example.vsplit")); }

TEST(MrrFileTest, DecodesWhatItEncoded) {
    for (const std::size_t splits : {0, 1, 3, 4599, 20000}) {  // some 4000 fill a block
        const StoredMrr stored{grown(torus(24, 12), splits), 700, "made by a test"};
        const Expected<StoredMrr> decoded = decode(encode_mrr(stored));
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_TRUE(*decoded == stored) << splits;
    }
}

TEST(MrrFileTest, DescriptionIsOpaque) {
    StoredMrr stored = example();
    for (const std::string& description : {std::string(), std::string("\0\xFF\n", 3), std::string(100'000, 'x')}) {
        stored.description = description;
        const Expected<StoredMrr> decoded = decode(encode_mrr(stored));
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_EQ(decoded->description, description);
    }
}

TEST(MrrFileTest, SameInputGivesSameBytes) { EXPECT_EQ(encode_mrr(example()), encode_mrr(example())); }

/// The bytes that docs/format.md prints, so that page and program cannot part ways: lines of an offset, a colon and bytes.
std::string documented_bytes(const fs::path& page) {
    std::ifstream file(page);
    std::string bytes;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        if (!(words >> word) || word.size() != 5 || word.back() != ':') continue;
        EXPECT_EQ(std::stoul(word, nullptr, 16), bytes.size()) << line;
        while (words >> word && word != "|") bytes += static_cast<char>(std::stoul(word, nullptr, 16));
    }
    return bytes;
}

/// Those of the lines that begin with `mark`, an offset and a colon.
std::string documented_bytes(const fs::path& page, char mark) {
    std::ifstream file(page);
    std::string bytes;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        if (!(words >> word) || word.size() != 4 || word.front() != mark || word.back() != ':') continue;
        EXPECT_EQ(std::stoul(word.substr(1), nullptr, 16), bytes.size()) << line;
        while (words >> word && word != "|") bytes += static_cast<char>(std::stoul(word, nullptr, 16));
    }
    return bytes;
}

TEST(MrrFileTest, WorkedExampleOfTheQuantisedEncodingIsWhatIsMade) {
    const MultiresMesh mrr{documented_base(), documented_records()};
    const PositionGrid grid = *PositionGrid::over(mrr, {RecordEncoding::kQuantised, 14});
    const TriangleMesh base = on_grid(mrr, grid).base;
    const std::string packed = documented_bytes(data_file("../../docs/format.md"), '=');
    EXPECT_EQ(packed, pack_base(base, 0, grid));
    const auto unpacked = unpack_base({std::as_bytes(std::span(packed)), 4, 4, 0}, grid);
    ASSERT_TRUE(unpacked) << unpacked.error().message;
    EXPECT_EQ(*unpacked, base);

    const std::string payload = documented_bytes(data_file("../../docs/format.md"), '+');
    ProgressiveMesh mesh = *ProgressiveMesh::from_base(base);
    RecordCodec codec(grid);
    const auto block = codec.encode(mrr.records, 0, mrr.records.size(), mesh);
    ASSERT_TRUE(block);
    EXPECT_EQ(payload, block->payload);
    ProgressiveMesh decoded = *ProgressiveMesh::from_base(base);
    RecordList records;
    const RecordBlock printed{0, 4, RecordEncoding::kQuantised, payload, crc32c(std::as_bytes(std::span(payload)))};
    ASSERT_TRUE(codec.decode(printed, decoded, &records));
    EXPECT_EQ(records, on_grid(mrr, grid).records);
}

TEST(MrrFileTest, WorkedExampleOfTheFormatPageIsWhatIsWritten) {
    StoredMrr stored{{documented_base(), documented_records()}, 8, "{}"};
    stored.unit = LengthUnit::kMillimetre;
    stored.deviations = {{1, 0.25}};
    const std::string bytes = documented_bytes(data_file("../../docs/format.md"));
    EXPECT_EQ(bytes, encode_mrr(stored));
    const Expected<StoredMrr> decoded = decode(bytes);
    ASSERT_TRUE(decoded) << decoded.error().message;
    // As the page draws them, record by record.
    const std::vector<std::vector<Triangle>> drawn{
        {{0, 2, 1}, {0, 1, 3}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}},
        {{3, 0, 2}, {3, 2, 1}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}},
        {{3, 0, 2}, {3, 2, 1}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}},
        {{5, 0, 2}, {3, 2, 1}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}, {3, 5, 2}, {5, 3, 0}}};
    auto mesh = ProgressiveMesh::from_base(decoded->mrr.base);
    ASSERT_TRUE(mesh);
    for (std::size_t n = 0; n < drawn.size(); ++n) {
        ASSERT_TRUE(mesh->refine(decoded->mrr.records.slice(n, 1)));
        EXPECT_EQ(mesh->mesh().faces, drawn[n]) << n;
    }
    EXPECT_EQ(mesh->mesh().positions[2], Vec3(0, 0.75, 0));
    EXPECT_EQ(mesh->mesh().positions[5], Vec3(0, 0.5, 0.5));
}

TEST(MrrFileTest, OpenMeshesComeBackWithTheirGhosts) {
    for (const TriangleMesh& mesh : {square(12), punctured(torus(24, 12), {0, 40, 80})}) {
        const StoredMrr stored{edited_mrr(mesh, 100, 4).mrr, 30, ""};
        ASSERT_FALSE(stored.mrr.border_splits.empty());
        const Expected<StoredMrr> decoded = decode(encode_mrr(stored));
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_TRUE(*decoded == stored);
    }
}

TEST(MrrFileTest, CutAnywhereItIsTruncated) {
    const std::string whole = encode_mrr(example());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Expected<StoredMrr> result = decode(whole.substr(0, length));
        ASSERT_FALSE(result) << length;
        EXPECT_EQ(result.error().cause, Cause::kTruncatedInput) << length << ": " << result.error().message;
    }
}

TEST(MrrFileTest, AnyChangedByteIsNoticed) {
    const std::string whole = encode_mrr(example());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const int flip : {0x01, 0x80}) {
            std::string changed = whole;
            changed[at] = static_cast<char>(changed[at] ^ flip);
            EXPECT_FALSE(decode(changed)) << "byte " << at;
        }
    }
}

TEST(MrrFileTest, OtherFilesAreNoMrr) {
    expect_error("solid cube", Cause::kUnknownFormat, "byte 0");
    expect_error(std::string(1000, '\0'), Cause::kUnknownFormat, "byte 0");
}

TEST(MrrFileTest, NewerVersionIsUnsupportedWhateverFollows) {
    std::string bytes = encode_mrr(example());
    put(bytes, 8, 4);  // the rest may look like anything, checksum included
    expect_error(bytes, Cause::kUnsupported,
                 "byte 8: the file is of version 4 of the format; this program reads versions 1 to 3");
    expect_error(bytes.substr(0, 12), Cause::kUnsupported, "byte 8");
    expect_error(with_field(bytes, 8, 0), Cause::kCorrupt, "byte 8");
}

TEST(MrrFileTest, HeadersThatLie) {
    const std::string bytes = encode_mrr(example());
    expect_error(with_field(bytes, 16, 0xFFFFFFFF), Cause::kCorrupt, "byte 24");          // faces
    expect_error(with_field(bytes, 36, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 208");  // description
    expect_error(with_field(bytes, 40, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 208");  // blocks
    expect_error(with_field(bytes, 60, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 208");  // base mesh
    expect_error(with_field(bytes, 56, 143), Cause::kCorrupt, "byte 208: the checksum");
    expect_error(with_field(bytes, 12, 3), Cause::kCorrupt, "byte 56: the base mesh takes 120 bytes, not 144");
    expect_error(with_field(bytes, 12, 0xFFFFFFFF), Cause::kCorrupt, "byte 56");
    expect_error(with_field(bytes, 20, 5), Cause::kCorrupt, "5 ghosts among 4 vertices");
    expect_error(with_field(bytes, 20, 2), Cause::kCorrupt, "joins two ghosts");
    expect_error(with_field(bytes, 24, 0xFFFFFFFF), Cause::kCorrupt, "byte 24");  // splits
    expect_error(with_field(bytes, 24, 6), Cause::kCorrupt, "byte 24: 6 splits among 5 records");
    expect_error(with_field(bytes, 24, 4), Cause::kCorrupt, "byte 24: 3 of 5 records are splits, not 4");
    expect_error(with_field(bytes, 24, 2), Cause::kCorrupt, "more splits than the 2 announced");
    expect_error(with_field(bytes, 28, 6), Cause::kCorrupt, "byte 28: the blocks have 5 records, not 6");
    expect_error(with_field(bytes, 28, 4), Cause::kCorrupt, "a block has records 0 and on, 5 in all");
    expect_error(with_field(bytes, 44, 0), Cause::kCorrupt, "byte 44: there is no encoding 0");
    expect_error(with_field(bytes, 44, 4), Cause::kCorrupt, "byte 44: there is no encoding 4");
    expect_error(with_field(bytes, 44, 2), Cause::kCorrupt, "byte 208: packed base mesh");
    expect_error(with_field(bytes, 44, 3), Cause::kCorrupt, "byte 48: quantisation_bits is 0");
    expect_error(with_field(bytes, 48, 14), Cause::kCorrupt, "byte 48: the encoding 1 has no grid");
    expect_error(with_field(bytes, 52, 7), Cause::kCorrupt, "byte 52: there is no unit 7");
    expect_error(with_field(bytes, 100, 0x80100000), Cause::kCorrupt, "byte 96: the largest error is no length");
    expect_error(with_field(bytes, 108, 0x80100000), Cause::kCorrupt, "byte 104: a deviation is no length");
    expect_error(with_field(bytes, 116, 0x40100000), Cause::kCorrupt, "byte 112: the bounding box");
    expect_error(bytes + "x", Cause::kCorrupt, "bytes, and its header says");
}

TEST(MrrFileTest, IndicesThatLie) {
    const std::string bytes = encode_mrr(example());
    const std::string block = "byte " + std::to_string(blocks_of_example_at());
    ASSERT_TRUE(with_index(bytes, 4, 5) == bytes);
    expect_error(with_index(bytes, 0, 1), Cause::kCorrupt, "a block has records 1 and on");
    expect_error(with_index(bytes, 4, 4), Cause::kCorrupt, "the blocks have 4 records, not 5");
    expect_error(with_index(bytes, 4, 0), Cause::kCorrupt, "0 in all");
    expect_error(with_index(bytes, 8, 2), Cause::kCorrupt, block + ": after the block from record 0 on there are 3 splits");
    expect_error(with_index(bytes, 12, 8), Cause::kCorrupt, "10 faces, not 3 and 8 as the index says");
    expect_error(with_index(bytes, 20, 0x80100000), Cause::kCorrupt, "a deviation is no length");
    expect_error(with_index(bytes, 24, 5), Cause::kCorrupt, "a block begins at byte 5");
    expect_error(with_index(bytes, 32, 0xFFFFFFFF), Cause::kTruncatedInput, "after 0 of 5 records");
    expect_error(with_index(bytes, 36, 1), Cause::kCorrupt, block + ": record block from record 0 on: the CRC-32C");
}

TEST(MrrFileTest, FilesOfVersion1AreReadAndCheckedAsEver) {
    const std::string bytes = example_of_version_1();
    const Expected<StoredMrr> stored = decode(bytes);
    ASSERT_TRUE(stored) << stored.error().message;
    EXPECT_EQ(*stored, (StoredMrr{{documented_base(), documented_records()}, 8, "{}"}));
    expect_error(with_field_1(bytes, 12, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 48");  // vertices
    expect_error(with_field_1(bytes, 16, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 48");  // faces
    expect_error(with_field_1(bytes, 36, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 48");  // description
    expect_error(with_field_1(bytes, 20, 5), Cause::kCorrupt, "5 ghosts among 4 vertices");
    expect_error(with_field_1(bytes, 24, 0xFFFFFFFF), Cause::kCorrupt, "byte 24");  // splits
    expect_error(with_field_1(bytes, 24, 1), Cause::kCorrupt, "more splits than the 1 announced");
    expect_error(with_field_1(bytes, 28, 0xFFFFFFFF), Cause::kTruncatedInput, "after 4 of 4294967295 records");
    expect_error(with_field_1(bytes, 28, 3), Cause::kCorrupt, "a block has records 0 and on, 4 in all");
    expect_error(with_field_1(with_field_1(bytes, 24, 0), 28, 0), Cause::kCorrupt, "bytes follow the last of 0 records");
    expect_error(with_field_1(bytes, 12, 3), Cause::kCorrupt, "byte 48: the checksum");
    expect_error(bytes + "x", Cause::kCorrupt, "1 bytes follow the last of 4 records");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        EXPECT_FALSE(decode(changed)) << "byte " << at;
        const Expected<StoredMrr> cut = decode(bytes.substr(0, at));
        ASSERT_FALSE(cut) << at;
        EXPECT_EQ(cut.error().cause, Cause::kTruncatedInput) << at << ": " << cut.error().message;
    }
}

TEST(MrrFileTest, BaseMeshMustBeClosedAndSound) {
    StoredMrr open = example();
    open.mrr.base.faces.pop_back();
    open.mrr.records.clear();
    expect_error(encode_mrr(open), Cause::kCorrupt, "byte 208: the base mesh");
    StoredMrr out_of_range = example();
    out_of_range.mrr.base.faces[0][0] = 99;
    expect_error(encode_mrr(out_of_range), Cause::kCorrupt, "byte 208: the base mesh");
    StoredMrr not_finite = example();
    not_finite.mrr.base.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
    expect_error(encode_mrr(not_finite), Cause::kCorrupt, "byte 208: the base mesh");
    expect_error(encode_mrr(StoredMrr()), Cause::kCorrupt, "byte 208: the base mesh");
    StoredMrr too_large = example();  // finite, but its squares are not
    too_large.mrr.base.positions[0].x() = 1e300;
    expect_error(encode_mrr(too_large), Cause::kCorrupt, "byte 208: the base mesh");
}

TEST(MrrFileTest, RecordsMustFitTheMesh) {
    const auto refused = [](const RecordList& records, const std::string& what) {
        const StoredMrr stored{{documented_base(), records}, 100, ""};
        const std::string block_at = std::to_string(kHeaderBytes + kBaseBytes + kIndexBytes);
        expect_error(encode_mrr(stored), Cause::kCorrupt, "byte " + block_at + ": record block from record 0 on: " + what);
    };
    const VertexSplit good{0, 1, {0, 0, 0}, {1, 1, 1}};
    refused({good, VertexSplit{18, 1, {0, 0, 0}, {1, 1, 1}}, good}, "record 1, vertex split: anchor 18");
    refused({good, good, VertexSplit{0, 0xFFFFFFFF, {0, 0, 0}, {1, 1, 1}}}, "record 2, vertex split");
    refused({EdgeFlip{0}, good}, "record 0, edge flip: at vertex");
    refused({VertexMove{4, {0, 0, 0}}, good}, "record 0, vertex move: 4 is no vertex");
}

TEST(MrrFileTest, EditsStandBeforeASplit) {
    expect_error(encode_mrr({{documented_base(), {VertexMove{2, {0, 2, 0}}}}, 8, ""}), Cause::kCorrupt, "is no split");
    RecordList records = documented_records();
    records.push_back(VertexMove{2, {0, 2, 0}});
    expect_error(encode_mrr({{documented_base(), records}, 8, ""}), Cause::kCorrupt, "the last of 5 records is no split");
}

MultiresMesh many_splits() {
    RecordList records;
    for (int n = 0; n < 5000; ++n) records.push_back(VertexSplit{0, 1, {0, 0, 0}, {1, 1, 1}});
    return {tetrahedron(), records};
}

TEST(MrrFileTest, BlocksMustFollowEachOther) {
    const std::string bytes = encode_mrr({many_splits(), 4, ""});  // two blocks
    const std::size_t index = kHeaderBytes + kBaseBytes, second = index + kIndexBytes;
    const auto with = [&](std::size_t at, std::uint32_t value) {
        std::string changed = bytes;
        put(changed, at, value);
        return with_field(changed, 200, crc_of(changed, kHeaderBytes, index + 2 * kIndexBytes - kHeaderBytes));
    };
    EXPECT_TRUE(with(second, 4599) == bytes);
    EXPECT_TRUE(decode(bytes));
    expect_error(with(second, 0), Cause::kCorrupt, "byte " + std::to_string(second) + ": a block has records 0");
    expect_error(with(second + 4, 0), Cause::kCorrupt, "byte " + std::to_string(second));
}

TEST(MrrFileTest, EveryEncodingComesBackAsItWasRounded) {
    for (const TriangleMesh& mesh : {torus(24, 12), punctured(torus(24, 12), {0, 40, 80})}) {
        const StoredMrr exact{edited_mrr(mesh, 200, 4).mrr, 300, "{}"};
        std::size_t larger = encode_mrr(exact).size();
        for (const EncodingChoice choice : {EncodingChoice{RecordEncoding::kFloat32, 0},
                                            {RecordEncoding::kQuantised, 20},
                                            {RecordEncoding::kQuantised, 14},
                                            {RecordEncoding::kQuantised, 10}}) {
            const Expected<StoredMrr> rounded = in_encoding(exact, choice);
            ASSERT_TRUE(rounded);
            const std::string bytes = encode_mrr(*rounded);
            EXPECT_LT(bytes.size(), larger);
            larger = bytes.size();
            const Expected<StoredMrr> decoded = decode(bytes);
            ASSERT_TRUE(decoded) << decoded.error().message;
            EXPECT_TRUE(*decoded == *rounded);
            EXPECT_EQ(encode_mrr(*decoded), bytes);
            EXPECT_EQ(decoded->mrr, on_grid(exact.mrr, decoded->grid));
            EXPECT_GT(decoded->max_error, 0);
            const TriangleMesh finest = mesh_at(exact.mrr, exact.mrr.levels());
            const TriangleMesh got = mesh_at(decoded->mrr, decoded->mrr.levels());
            ASSERT_EQ(got.faces, finest.faces);
            for (std::size_t v = 0; v < finest.positions.size(); ++v)
                EXPECT_LE((got.positions[v] - finest.positions[v]).cwiseAbs().maxCoeff(), decoded->max_error);
            for (std::size_t at = 0; at < bytes.size(); at += 7) {
                std::string changed = bytes;
                changed[at] = static_cast<char>(changed[at] ^ 16);
                EXPECT_FALSE(decode(changed)) << "byte " << at;
                EXPECT_FALSE(decode(bytes.substr(0, at))) << at;
            }
        }
    }
    EXPECT_FALSE(in_encoding(example(), {RecordEncoding::kQuantised, 25}));
}

TEST(MrrFileTest, AHeaderSaysUnitSourceAndDeviations) {
    StoredMrr stored{many_splits(), 2000, ""};
    stored.unit = LengthUnit::kInch;
    stored.source.emplace().fill(0xA5);
    stored.deviations = {{0, 2.5}, {700, 1.25}, {5000, 0}};
    const std::string bytes = encode_mrr(stored);
    const Expected<StoredMrr> decoded = decode(bytes);
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(*decoded == stored);
    // Blocks end at level 700, at the level to show (998), and where they are full.
    const MrrLayout layout = *read_mrr_layout(std::as_bytes(std::span(bytes)));
    ASSERT_EQ(layout.blocks.size(), 3U);
    EXPECT_EQ(layout.blocks[0].splits, 700U);
    EXPECT_EQ(layout.blocks[0].faces, 1404U);
    EXPECT_EQ(layout.blocks[0].deviation, 1.25);
    EXPECT_EQ(layout.blocks[1].splits, 998U);
    EXPECT_TRUE(std::isnan(layout.blocks[1].deviation));
    EXPECT_EQ(layout.blocks[2].splits, 5000U);

    const Expected<StoredMrr> rounded = in_encoding(stored, {RecordEncoding::kQuantised, 12});
    ASSERT_TRUE(rounded);
    EXPECT_GE(rounded->deviations[1].most, 1.25 + rounded->max_error);
    EXPECT_LE(rounded->deviations[1].most, 1.25 + 2 * rounded->max_error);
}

TEST(MrrFileTest, ADeviationIsThatOfALevel) {
    StoredMrr stored{{documented_base(), documented_records()}, 0, ""};
    stored.mrr.records.truncate(3);  // the last is a move: what follows the block is no level
    std::string bytes = encode_mrr(stored);
    const std::size_t index = kHeaderBytes + kBaseBytes;
    put(bytes, index + 20, 0);  // the high half of NaN becomes that of a length
    bytes = with_field(bytes, 24, 1);
    bytes = with_field(bytes, 200, crc_of(bytes, kHeaderBytes, index + kIndexBytes - kHeaderBytes));
    expect_error(bytes, Cause::kCorrupt, "which does not end with a split");
}

TEST(MrrFileTest, FilesAreSavedAndLoaded) {
    const fs::path path = fs::temp_directory_path() / ("vsplit_mrr_test_" + std::to_string(::getpid()) + ".vsplit");
    ASSERT_TRUE(save_mrr(example(), path));
    const Expected<StoredMrr> loaded = load_mrr(path);
    fs::remove(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(*loaded == example());

    const Expected<StoredMrr> missing = load_mrr(path);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().cause, Cause::kNotFound);
    EXPECT_FALSE(save_mrr(example(), "/no/such/directory/a.vsplit"));
}

TEST(MrrFileTest, BrokenFilesSayWhatIsWrongAndWhere) {
    struct BrokenFile {
        std::string name;
        Cause cause;
        std::string place;
    };
    std::size_t listed = 0;
    for (const auto& [name, cause, place] :
         {BrokenFile{"mrr_of_version_4.vsplit", Cause::kUnsupported, "byte 8"},
          BrokenFile{"mrr_cut_in_header.vsplit", Cause::kTruncatedInput, "byte 30"},
          BrokenFile{"mrr_cut_in_block.vsplit", Cause::kTruncatedInput, "byte 330: the file ends after 0 of 4 records"},
          BrokenFile{"mrr_changed_header.vsplit", Cause::kCorrupt, "byte 44"},
          BrokenFile{"mrr_changed_position.vsplit", Cause::kCorrupt, "byte 48"},
          BrokenFile{"mrr_changed_split.vsplit", Cause::kCorrupt, "byte 194: record block from record 0 on"},
          BrokenFile{"mrr_open_base.vsplit", Cause::kCorrupt, "byte 48: the base mesh"},
          BrokenFile{"mrr_ghosts_side_by_side.vsplit", Cause::kCorrupt, "byte 48: the base mesh: face 0 joins two ghosts"},
          BrokenFile{"mrr_flips_twice.vsplit", Cause::kCorrupt,
                     "byte 194: record block from record 0 on: record 2, edge flip: at vertex 0 of valence under 4"},
          BrokenFile{"mrr_ends_with_a_move.vsplit", Cause::kCorrupt, "the last of 3 records is no split"},
          BrokenFile{"mrr_sent_as_text.vsplit", Cause::kUnknownFormat, "byte 0"}}) {
        SCOPED_TRACE(name);
        const Expected<StoredMrr> result = load_mrr(data_file("broken/" + name));
        ++listed;
        ASSERT_FALSE(result);
        EXPECT_EQ(cause_name(result.error().cause), cause_name(cause)) << result.error().message;
        EXPECT_NE(result.error().message.find(place), std::string::npos) << result.error().message;
    }
    std::size_t present = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(data_file("broken")))
        present += entry.path().extension() == ".vsplit" ? 1 : 0;
    EXPECT_EQ(present, listed) << "a broken file is in no table";
}

}  // namespace
}  // namespace vsplit::test
