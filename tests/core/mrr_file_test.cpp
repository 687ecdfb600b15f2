#include "vsplit/mrr/mrr_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit::test {
namespace {

namespace fs = std::filesystem;

/// `count` splits that fit `base`: any corner of the mesh as it grows, one step, points near by.
MultiresMesh grown(const TriangleMesh& base, std::size_t count) {
    Random random(5);
    MultiresMesh mrr{base, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t corners = 3 * mrr.faces_at(i);
        const auto point = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
        mrr.splits.push_back({random.below(corners), 1 + random.below(2), point(), point()});
    }
    return mrr;
}

StoredMrr example() { return {grown(tetrahedron(), 3), 8, R"({"method":"IMPROVE"})"}; }

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
    put(bytes, 36, crc_of(bytes, 0, 36));
    return bytes;
}

bool operator==(const StoredMrr& left, const StoredMrr& right) {
    return left.mrr == right.mrr && left.faces == right.faces && left.description == right.description;
}

TEST(MrrFileTest, DecodesWhatItEncoded) {
    for (const std::size_t splits : {0, 1, 3, 4681, 4682, 20000}) {  // 4681 fill a block
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

TEST(MrrFileTest, WorkedExampleOfTheFormatPageIsWhatIsWritten) {
    const TriangleMesh base{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const StoredMrr stored{{base, {{8, 2, {0, 0, 1}, {0.5, 0.5, 0.5}}, {0, 1, {0, 0, 0}, {0.5, 0.25, -0.25}}}}, 8, "{}"};
    const std::string bytes = documented_bytes(data_file("../../docs/format.md"));
    EXPECT_EQ(bytes, encode_mrr(stored));
    const Expected<StoredMrr> decoded = decode(bytes);
    ASSERT_TRUE(decoded) << decoded.error().message;
    const TriangleMesh finest = mesh_at(decoded->mrr, 2);
    // As the page draws them, level by level.
    EXPECT_EQ(mesh_at(decoded->mrr, 1).faces,
              (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}}));
    EXPECT_EQ(finest.faces,
              (std::vector<Triangle>{{5, 2, 1}, {0, 1, 3}, {1, 2, 4}, {2, 0, 4}, {3, 4, 0}, {4, 3, 1}, {0, 5, 1}, {5, 0, 2}}));
    EXPECT_EQ(finest.positions[4], Vec3(0.5, 0.5, 0.5));
    EXPECT_EQ(finest.positions[5], Vec3(0.5, 0.25, -0.25));
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
    put(bytes, 8, 2);  // the rest may look like anything, checksum included
    expect_error(bytes, Cause::kUnsupported, "byte 8: the file is of version 2");
    expect_error(with_field(bytes, 8, 0), Cause::kCorrupt, "byte 8");
}

TEST(MrrFileTest, HeadersThatLie) {
    const std::string bytes = encode_mrr(example());
    expect_error(with_field(bytes, 12, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 40");  // vertices
    expect_error(with_field(bytes, 16, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 40");  // faces
    expect_error(with_field(bytes, 28, 0xFFFFFFFF), Cause::kTruncatedInput, "byte 40");  // description
    expect_error(with_field(bytes, 20, 0xFFFFFFFF), Cause::kCorrupt, "byte 20");         // splits
    expect_error(with_field(bytes, 20, 4), Cause::kTruncatedInput, "after 3 of 4 splits");
    expect_error(with_field(bytes, 20, 2), Cause::kCorrupt, "a block has splits 0 and on, 3 in all");
    expect_error(with_field(bytes, 20, 0), Cause::kCorrupt, "bytes follow the last of 0 splits");
    expect_error(with_field(bytes, 12, 3), Cause::kCorrupt, "byte 40: the checksum");
    expect_error(bytes + "x", Cause::kCorrupt, "1 bytes follow the last of 3 splits");
}

TEST(MrrFileTest, BaseMeshMustBeClosedAndSound) {
    StoredMrr open = example();
    open.mrr.base.faces.pop_back();
    open.mrr.splits.clear();
    expect_error(encode_mrr(open), Cause::kCorrupt, "byte 40: the base mesh");
    StoredMrr out_of_range = example();
    out_of_range.mrr.base.faces[0][0] = 99;
    expect_error(encode_mrr(out_of_range), Cause::kCorrupt, "byte 40: the base mesh");
    StoredMrr not_finite = example();
    not_finite.mrr.base.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
    expect_error(encode_mrr(not_finite), Cause::kCorrupt, "byte 40: the base mesh");
    expect_error(encode_mrr(StoredMrr()), Cause::kCorrupt, "byte 40: the base mesh");
    StoredMrr too_large = example();  // finite, but its squares are not
    too_large.mrr.base.positions[0].x() = 1e300;
    expect_error(encode_mrr(too_large), Cause::kCorrupt, "byte 40: the base mesh");
}

TEST(MrrFileTest, SplitsMustFitTheMesh) {
    const std::size_t block_at = 40 + 4 * 24 + 4 * 12 + example().description.size();
    StoredMrr beyond = example();
    beyond.mrr.splits[1].anchor = 18;  // level 1 has 6 faces, 18 corners
    expect_error(encode_mrr(beyond), Cause::kCorrupt, "byte " + std::to_string(block_at) + ": vertex split 1");
    StoredMrr around = example();
    around.mrr.splits[2].steps = 0xFFFFFFFF;
    expect_error(encode_mrr(around), Cause::kCorrupt, "byte " + std::to_string(block_at) + ": vertex split 2");
}

TEST(MrrFileTest, BlocksMustFollowEachOther) {
    StoredMrr stored{grown(tetrahedron(), 5000), 4, ""};  // two blocks
    std::string bytes = encode_mrr(stored);
    const std::size_t second = 40 + 4 * 24 + 4 * 12 + 20 + 4681 * std::size_t{56};
    put(bytes, second, 0);
    expect_error(bytes, Cause::kCorrupt, "byte " + std::to_string(second) + ": a block has splits 0");
    put(bytes, second, 4681);
    EXPECT_TRUE(decode(bytes));
    put(bytes, second + 4, 0);
    expect_error(bytes, Cause::kCorrupt, "byte " + std::to_string(second));
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
         {BrokenFile{"mrr_of_version_2.vsplit", Cause::kUnsupported, "byte 8"},
          BrokenFile{"mrr_cut_in_header.vsplit", Cause::kTruncatedInput, "byte 30"},
          BrokenFile{"mrr_cut_in_block.vsplit", Cause::kTruncatedInput, "byte 288: the file ends after 0 of 2 splits"},
          BrokenFile{"mrr_changed_header.vsplit", Cause::kCorrupt, "byte 36"},
          BrokenFile{"mrr_changed_position.vsplit", Cause::kCorrupt, "byte 40"},
          BrokenFile{"mrr_changed_split.vsplit", Cause::kCorrupt, "byte 186: record block from split 0 on"},
          BrokenFile{"mrr_open_base.vsplit", Cause::kCorrupt, "byte 40: the base mesh"},
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
