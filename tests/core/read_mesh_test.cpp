#include "vsplit/io/read_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "tests/temp_directory.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

namespace fs = std::filesystem;

Expected<ReadResult> read(const std::string& bytes, const ReadOptions& options = {}) {
    return read_mesh(std::as_bytes(std::span(bytes)), options);
}

/// Reads what must be readable.
ReadResult must_read(const std::string& bytes, const ReadOptions& options = {}) {
    Expected<ReadResult> result = read(bytes, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *std::move(result) : ReadResult();
}

/// Reads what must not be, for this reason, with a message that holds `place`.
void expect_error(const Expected<ReadResult>& result, Cause cause, const std::string& place) {
    ASSERT_FALSE(result);
    EXPECT_EQ(cause_name(result.error().cause), cause_name(cause)) << result.error().message;
    EXPECT_NE(result.error().message.find(place), std::string::npos) << result.error().message;
}

TriangleMesh triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

/// A little- or big-endian number, by shifting: not with the code under test.
template <class T>
std::string number(T value, bool big_endian = false) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    const std::uint16_t probe = 1;
    char low = 0;
    std::memcpy(&low, &probe, 1);
    if ((low == 0) != big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// --- formats -----------------------------------------------------------------------------------------------------------------

TEST(ReadMeshTest, StlBinary) {
    std::string bytes = std::string(80, 'x') + number<std::uint32_t>(1);
    for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) bytes += number(value);
    bytes += "ab";
    const ReadResult result = must_read(bytes);
    EXPECT_EQ(result.mesh, triangle());
    EXPECT_EQ(result.format, MeshFormat::kStlBinary);
}

TEST(ReadMeshTest, StlBinaryThatSaysSolid) {
    std::string bytes = write_mesh(cube(), MeshFormat::kStlBinary);
    bytes.replace(0, 80, "solid" + std::string(75, ' '));
    EXPECT_EQ(must_read(bytes).mesh.face_count(), 12U);
}

TEST(ReadMeshTest, StlCountsItsRepeatedVerticesAsMerged) {
    for (const MeshFormat format : {MeshFormat::kStlBinary, MeshFormat::kStlAscii}) {
        const ReadResult result = must_read(write_mesh(cube(), format));
        EXPECT_EQ(result.mesh.vertex_count(), 8U);
        EXPECT_EQ(result.weld.merged_vertices, 36U - 8U);
        const ReadResult loose = must_read(write_mesh(cube(), format), {.weld = 0.1});
        EXPECT_EQ(loose.mesh, result.mesh);
        EXPECT_EQ(loose.weld.merged_vertices, 36U - 8U);
    }
}

TEST(ReadMeshTest, StlAsciiWithSeveralSolidsInAnyCaseAndLayout) {
    const std::string text =
        "SOLID first part with facet in its name\nFacet Normal nan -nan(ind) 1.#QNAN outer\tloop vertex 0 0 0\r\nVERTEX +1 "
        "0.0E+000 -0\n"
        "vertex 0 1.0 0 endloop endfacet\nendsolid first part\n\n"
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid";
    const ReadResult result = must_read(text);
    EXPECT_EQ(result.format, MeshFormat::kStlAscii);
    EXPECT_EQ(result.mesh, (TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{0, 1, 2}, {0, 2, 3}},
                                         {1, 0},
                                         {{"first part with facet in its name", {1}}}}));
}

TEST(ReadMeshTest, ObjCornersOfAllKinds) {
    const std::string vertices = "v 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\n";
    for (const std::string face :
         {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//2 3//3", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1", "f -3/-1 2//-1 3", "\tf  1 2 3  ",
          "f 1 2 3 # a comment", "f 1 2 \\\n 3", "f 1 \\\r\n 2 \\\r\n3\r", "fo 1 2 3"}) {
        EXPECT_EQ(must_read(vertices + face).mesh, triangle()) << face;
        EXPECT_EQ(must_read(vertices + face + "\n").mesh, triangle()) << face;
    }
}

TEST(ReadMeshTest, ObjSkipsWhatIsNoGeometry) {
    const std::string text =
        "# comment\r\nmtllib a.mtl\r\no part\r\ng\r\nv 0 0 0\r\nvn 0 0 1\r\nvt 0 0\r\nusemtl steel\r\ns off\r\nv 1 0 0\r\n"
        "v 0 1 0\r\nl 1 2\r\np 1\r\nusemap off\r\nmtllib\r\nbevel on\r\nlod 3\r\nshadow_obj a\r\ncstype bezier\r\ncurv 0 1 1 "
        "2\r\nend\r\nf 1/1/1 2/1/1 3/1/1\r\n";
    EXPECT_EQ(must_read(text).mesh, triangle());
}

TEST(ReadMeshTest, ObjNeverDropsSurfaceInSilence) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    expect_error(read(text + "hello world\n"), Cause::kMalformedInput,
                 "line 5: expected a keyword such as 'v' or 'f', found 'hello'");
    expect_error(read(text + "F 1 2 3\n"), Cause::kMalformedInput, "line 5: expected a keyword");
    for (const std::string word : {"surf", "call", "csh", "bsp", "bzp"})
        expect_error(read(text + word + " other.obj\n"), Cause::kUnsupported, "line 5: '" + word + "' is not read");
}

TEST(ReadMeshTest, ObjGroupsOverlapAndMayBeAlone) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    const TriangleMesh two = must_read(vertices + "g a all\nf 1 2 3\ng all \\\n b # both\nf 2 4 3\ng none_of_them\n").mesh;
    EXPECT_EQ(two.regions, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(two.sets, (std::vector<FaceSet>{{"a", {1}}, {"all", {1, 2}}, {"b", {2}}}));
    const TriangleMesh one = must_read(vertices + "g a\nf 1 2 3\nf 2 4 3\n").mesh;
    EXPECT_EQ(one.regions, (std::vector<std::uint32_t>{1, 1}));
    EXPECT_EQ(one.sets, (std::vector<FaceSet>{{"a", {1}}}));
    EXPECT_TRUE(must_read(vertices + "g\nf 1 2 3\nf 2 4 3\n").mesh.regions.empty());
}

TEST(ReadMeshTest, PlyRegionsOfAnyTypeAndNoStrips) {
    const auto ply = [](const std::string& type, const std::string& region) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_index\nproperty " +
               type + " region\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " + region + "\n";
    };
    EXPECT_EQ(must_read(ply("float", "7")).mesh.regions, (std::vector<std::uint32_t>{7}));
    EXPECT_EQ(must_read(ply("double", "4294967294")).mesh.regions, (std::vector<std::uint32_t>{4294967294}));
    expect_error(read(ply("float", "0.5")), Cause::kMalformedInput,
                 "line 14: expected a region, an integer up to 4294967294, found 0.5");
    expect_error(read(ply("uint", "4294967295")), Cause::kMalformedInput, "line 14: expected a region");
    EXPECT_TRUE(must_read(ply("int", "-1")).mesh.regions.empty());  // no face has one
    std::string strips = ply("int", "1");
    strips.replace(strips.find("end_header"), 10, "element tristrips 1\nproperty list int int vertex_indices\nend_header");
    expect_error(read(strips + "3 0 1 2\n"), Cause::kUnsupported, "line 10: triangle strips are not read");
}

TEST(ReadMeshTest, ConcavePolygonsDoNotFold) {
    const std::string rows = "0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n";
    EXPECT_DOUBLE_EQ(surface_area(must_read("OFF\n5 1 0\n" + rows + "5 2 3 4 0 1\n").mesh), 10);
    const std::string obj = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\n";
    EXPECT_DOUBLE_EQ(surface_area(must_read(obj + "f 3 4 5 1 2\n").mesh), 10);
    EXPECT_DOUBLE_EQ(surface_area(must_read("f 3 4 5 1 2\n" + obj).mesh), 10) << "before its vertices";
    const std::string vertices = "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_index\n";
    const std::string ply = "ply\nformat ascii 1.0\n";
    EXPECT_DOUBLE_EQ(surface_area(must_read(ply + vertices + faces + "end_header\n" + rows + "5 2 3 4 0 1\n").mesh), 10);
    EXPECT_DOUBLE_EQ(surface_area(must_read(ply + faces + vertices + "end_header\n5 2 3 4 0 1\n" + rows).mesh), 10);
}

TEST(ReadMeshTest, OffWithoutItsKeyword) {
    const std::string text = "# counts\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(must_read(text, {.format = MeshFormat::kOff}).mesh, triangle());
}

TEST(ReadMeshTest, ObjFaceBeforeItsVertices) {
    EXPECT_EQ(must_read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").mesh, triangle());
    expect_error(read("f 1 2 3\nf 1 3 4\nf 5 1 2\nf 1 2 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"), Cause::kIndexOutOfRange,
                 "line 3: a face names vertex 5");
}

TEST(ReadMeshTest, PolygonsBecomeFans) {
    const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    const std::string rows = "0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n";
    EXPECT_EQ(must_read("OFF\n5 1 0\n" + rows).mesh.faces, fan);
    EXPECT_EQ(must_read("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                        "element face 1\nproperty list uchar int vertex_index\nend_header\n" +
                        rows)
                  .mesh.faces,
              fan);
    EXPECT_EQ(must_read("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n").mesh.faces, fan);
}

TEST(ReadMeshTest, OffInItsManyLayouts) {
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
    for (const std::string& text :
         {"OFF\n3 1 3\n" + vertices + "3 0 1 2\n", "OFF 3 1 3\n" + vertices + "3 0 1 2",
          "OFF\r\n3 1\r\n" + vertices + "3 0 1 2 0.5 0.5 0.5\r\n",
          "# made by hand\nOFF # it is\n\n# the counts\n3 1 3 # here\n\n" + vertices + "# faces\n3 0 1 2 # one\n# end\n\n",
          std::string("COFF\n3 1 3\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n"),
          std::string("NOFF\n3 1 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 17\n")}) {
        const ReadResult result = must_read(text);
        EXPECT_EQ(result.mesh, triangle()) << text;
        EXPECT_EQ(result.format, MeshFormat::kOff);
    }
}

TEST(ReadMeshTest, PlyOfEveryTypeAndByteOrder) {
    // Each coordinate of another type, lists and elements that are of no interest in between.
    const std::string header =
        " 1.0\r\ncomment of no interest\r\nobj_info neither\r\nelement note 2\r\nproperty list ushort double values\r\nproperty "
        "char c\r\n"
        "element vertex 3\r\nproperty uchar red\r\nproperty short x\r\nproperty list uint8 int16 extras\r\nproperty float64 y\r\n"
        "property uint32 z\r\nelement face 1\r\nproperty float32 area\r\nproperty list uint uint16 vertex_indices\r\nproperty "
        "list char int flags\r\n"
        "element edge 1\r\nproperty int a\r\nproperty int32 b\r\nelement nothing 4000000000\r\nend_header\r\n";
    for (const bool big : {false, true}) {
        std::string body;
        const auto add = [&](auto... values) { ((body += number(values, big)), ...); };
        add(std::uint16_t{1}, 0.5, std::int8_t{-1}, std::uint16_t{0}, std::int8_t{7});
        add(std::uint8_t{9}, std::int16_t{0}, std::uint8_t{0}, 0.0, std::uint32_t{0});
        add(std::uint8_t{9}, std::int16_t{1}, std::uint8_t{2}, std::int16_t{5}, std::int16_t{6}, 0.0, std::uint32_t{0});
        add(std::uint8_t{9}, std::int16_t{0}, std::uint8_t{0}, 1.0, std::uint32_t{0});
        add(0.25F, std::uint32_t{3}, std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2}, std::int8_t{1}, std::int32_t{4});
        add(std::int32_t{0}, std::int32_t{1});
        std::string text = big ? "ply\r\nformat binary_big_endian" : "ply\r\nformat binary_little_endian";
        text.append(header).append(body);
        const ReadResult result = must_read(text);
        EXPECT_EQ(result.mesh, triangle());
        EXPECT_EQ(result.format, MeshFormat::kPlyBinary);
    }
    const ReadResult ascii =
        must_read("ply\r\nformat ascii" + header +
                  "1 0.5 -1\r\n0 7\r\n9 0 0 0 0\r\n9 1 2 5 6 0 0\r\n\r\n9 0 0 1 0\r\n0.25 3 0 1 2 1 4\r\n0 1\r\n\r\n");
    EXPECT_EQ(ascii.mesh, triangle());
    EXPECT_EQ(ascii.format, MeshFormat::kPlyAscii);
}

TEST(ReadMeshTest, PlyFacesBeforeVertices) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(must_read(text).mesh, triangle());
}

TEST(ReadMeshTest, ByteOrderMarkIsSkipped) {
    EXPECT_EQ(must_read("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").mesh, triangle());
    EXPECT_EQ(must_read("\xEF\xBB\xBFOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").mesh, triangle());
}

TEST(ReadMeshTest, NumbersOfAllSpellings) {
    const std::vector<std::pair<std::string, double>> cases = {{"1", 1},
                                                               {"+1", 1},
                                                               {"-1.", -1},
                                                               {".5", 0.5},
                                                               {"1e3", 1000},
                                                               {"1E+03", 1000},
                                                               {"1.5e-003", 0.0015},
                                                               {"-0", 0},
                                                               {"1e-400", 0},
                                                               {"-1e-400", 0},
                                                               {"0." + std::string(400, '0') + "1", 0},
                                                               {"0." + std::string(400, '0') + "1e400", 0.1},
                                                               {"1" + std::string(400, '0') + "e-400", 1},
                                                               {"1e-99999999999999999999", 0},
                                                               {"4.9406564584124654e-324", 5e-324}};
    for (const auto& [text, value] : cases) {
        const ReadResult result = must_read("v 9 0 0\nv 0 9 0\nv 0 " + text + " 9\nf 1 2 3\n");
        EXPECT_EQ(result.mesh.positions.at(2).y(), value) << text;
    }
    const std::string large = "1" + std::string(400, '0');
    for (const std::string& text : {std::string("1e400"), std::string("-1e400"), large, std::string("1e99999999999999999999"),
                                    std::string("inf"), std::string("-nan"), std::string("1.0000001e15")}) {
        expect_error(read("v 9 0 0\nv 0 9 0\nv 0 " + text + " 9\nf 1 2 3\n"), Cause::kInvalidCoordinate, "line 3: y");
    }
    for (const std::string text : {"+-1", "1,5", "0x10", "1d5", "1e", "--1", "one", "1.#INF", "+"}) {
        expect_error(read("v 9 0 0\nv 0 9 0\nv 0 " + text + " 9\nf 1 2 3\n"), Cause::kMalformedInput,
                     "line 3: expected 3 coordinates");
    }
}

// --- options -----------------------------------------------------------------------------------------------------------------

TEST(ReadMeshTest, FormatAskedForMustBeTheOneThereIs) {
    const std::string obj = write_mesh(cube(), MeshFormat::kObj);
    EXPECT_EQ(must_read(obj, {.format = MeshFormat::kObj}).mesh, cube());
    expect_error(read(obj, {.format = MeshFormat::kOff}), Cause::kMalformedInput, "byte 0: the bytes are obj, not off");
    EXPECT_EQ(read(obj, {.format = MeshFormat::kOff}).error().field, "format");
    // The kinds of STL and PLY are told by the bytes.
    EXPECT_EQ(must_read(write_mesh(cube(), MeshFormat::kStlAscii), {.format = MeshFormat::kStlBinary}).format,
              MeshFormat::kStlAscii);
    EXPECT_EQ(must_read(write_mesh(cube(), MeshFormat::kPlyBinary), {.format = MeshFormat::kPlyAscii}).format,
              MeshFormat::kPlyBinary);
    // What cannot be told is read as asked.
    expect_error(read("short", {.format = MeshFormat::kStlBinary}), Cause::kTruncatedInput, "byte 5");
    EXPECT_EQ(must_read("bevel on\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {.format = MeshFormat::kObj}).mesh, triangle());
}

TEST(ReadMeshTest, FaceLimitHoldsInEveryFormat) {
    for (const MeshFormat format : {MeshFormat::kStlBinary, MeshFormat::kStlAscii, MeshFormat::kObj, MeshFormat::kPlyBinary,
                                    MeshFormat::kPlyAscii, MeshFormat::kOff}) {
        const std::string bytes = write_mesh(cube(), format);
        EXPECT_TRUE(read(bytes, {.max_faces = 12})) << format_name(format);
        expect_error(read(bytes, {.max_faces = 11}), Cause::kLimitExceeded, "limit of 11");
    }
    const std::string polygon = "OFF\n5 1 0\n0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n";
    EXPECT_TRUE(read(polygon, {.max_faces = 3}));
    expect_error(read(polygon, {.max_faces = 2}), Cause::kLimitExceeded, "line 8: 3 faces");
}

TEST(ReadMeshTest, WeldToleranceClosesCracks) {
    std::string text;
    for (const auto& [a, b, c] : tetrahedron().faces) {  // every face its own vertices, off by a little
        for (const std::uint32_t vertex : {a, b, c}) {
            const Vec3 position = tetrahedron().positions[vertex] * (1 + 1e-6 * a);
            text += "v " + std::to_string(position.x()) + " " + std::to_string(position.y()) + " " +
                    std::to_string(position.z()) + "\n";
        }
    }
    text += "f 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\n";
    const ReadResult result = must_read(text, {.weld = 1e-3});
    EXPECT_EQ(result.mesh.vertex_count(), 4U);
    EXPECT_EQ(result.weld.merged_vertices, 8U);
}

TEST(ReadMeshTest, WeldToleranceMustBeALength) {
    for (const double weld : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        const Expected<ReadResult> result = read(write_mesh(cube(), MeshFormat::kStlBinary), {.weld = weld});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().cause, Cause::kInvalidOption);
        EXPECT_EQ(result.error().field, "weld");
    }
}

TEST(ReadMeshTest, WeldThatLeavesNoFaceIsAnError) {
    expect_error(read(write_mesh(cube(), MeshFormat::kObj), {.weld = 10}), Cause::kEmptyInput, "12 faces");
}

// --- files -------------------------------------------------------------------------------------------------------------------

TEST(ReadMeshTest, FilesThatCannotBeRead) {
    expect_error(read_mesh_file("/no/such/file.stl", {}), Cause::kNotFound, "/no/such/file.stl");
    expect_error(read_mesh_file(VSPLIT_TEST_DATA, {}), Cause::kFileAccess, VSPLIT_TEST_DATA);
    expect_error(read_mesh_file("/dev/null", {}), Cause::kEmptyInput, "empty");
}

struct BrokenFile {
    std::string name;
    Cause cause;
    std::string place;  // what the message must hold: where it is, and what was found
};

const std::vector<BrokenFile>& broken_files() {
    static const std::vector<BrokenFile> files = {
        {"obj_bad_number.obj", Cause::kMalformedInput, "line 4: expected 3 coordinates of a vertex, found '1,0' for number 2"},
        {"obj_binary_in_text.obj", Cause::kMalformedInput, "line 4: expected a keyword such as 'v' or 'f', found '\\x01\\xff'"},
        {"obj_index_beyond.obj", Cause::kIndexOutOfRange, "line 8: a face names vertex 5, but the file has 4"},
        {"obj_index_beyond_backwards.obj", Cause::kIndexOutOfRange, "line 8: a face names vertex -5 where 4 are given"},
        {"obj_index_no_number.obj", Cause::kMalformedInput,
         "line 8: expected a corner such as '1', '1/2', '1//3' or '1/2/3', found 'x'"},
        {"obj_index_of_20_digits.obj", Cause::kMalformedInput,
         "line 8: expected a corner such as '1', '1/2', '1//3' or '1/2/3', found '99999999999999999999'"},
        {"obj_index_zero.obj", Cause::kIndexOutOfRange, "line 8: a face names vertex 0 where 4 are given"},
        {"obj_nan.obj", Cause::kInvalidCoordinate, "line 4: y of a vertex is nan"},
        {"obj_no_faces.obj", Cause::kEmptyInput, "the file has 4 vertices, but no face"},
        {"obj_overflowing_number.obj", Cause::kInvalidCoordinate, "line 4: y of a vertex is inf"},
        {"obj_two_coordinates.obj", Cause::kMalformedInput,
         "line 4: expected 3 coordinates of a vertex, found the line's end for number 3"},
        {"obj_two_corners.obj", Cause::kMalformedInput, "line 8: a face has 2 corners"},
        {"off_bad_coordinate.off", Cause::kMalformedInput, "line 5: expected a coordinate, found 'zero'"},
        {"off_bad_counts.off", Cause::kMalformedInput, "line 2: expected the counts of vertices and faces, found '4 four 6'"},
        {"off_binary.off", Cause::kUnsupported, "line 1: binary OFF is not read"},
        {"off_cut_in_faces.off", Cause::kTruncatedInput, "line 9: the file ends where face 3 of 4 should follow"},
        {"off_cut_in_vertices.off", Cause::kTruncatedInput, "line 5: the file ends where vertex 2 of 4 should follow"},
        {"off_index_beyond.off", Cause::kIndexOutOfRange, "line 9: a face names vertex 4"},
        {"off_infinite.off", Cause::kInvalidCoordinate, "line 5: y of a vertex is inf"},
        {"off_line_too_many.off", Cause::kMalformedInput, "line 11: a line follows the last announced face"},
        {"off_missing_corner.off", Cause::kMalformedInput, "line 9: expected corner 3 of a face, found the line's end"},
        {"off_negative_counts.off", Cause::kMalformedInput, "line 2: expected the counts of vertices and faces, found '4 -4 6'"},
        {"off_no_counts.off", Cause::kTruncatedInput,
         "line 1: the file ends where the counts of vertices and faces should follow"},
        {"off_says_4_billion_vertices.off", Cause::kTruncatedInput,
         "line 2: 4000000000 vertices are announced, but the 57 bytes that follow hold at most 9"},
        {"off_two_corners.off", Cause::kMalformedInput, "line 9: a face has 2 corners"},
        {"ply_ascii_cut.ply", Cause::kTruncatedInput, "line 17: expected an integer, found the line's end"},
        {"ply_ascii_fraction_of_a_vertex.ply", Cause::kMalformedInput, "line 17: expected an integer, found '2.5'"},
        {"ply_ascii_index_beyond.ply", Cause::kIndexOutOfRange, "line 17: a face names vertex 4"},
        {"ply_ascii_long_row.ply", Cause::kMalformedInput, "line 13: expected the row to end, found '7'"},
        {"ply_ascii_negative_index.ply", Cause::kIndexOutOfRange, "line 17: a face names vertex -1"},
        {"ply_ascii_row_too_many.ply", Cause::kMalformedInput, "line 19: expected the file to end, found '3'"},
        {"ply_ascii_says_4_billion_vertices.ply", Cause::kTruncatedInput,
         "line 4: 4000000000 vertex rows are announced, but the 57 bytes that follow hold at most 9"},
        {"ply_ascii_short_row.ply", Cause::kMalformedInput, "line 13: expected a number, found the line's end"},
        {"ply_ascii_two_corners.ply", Cause::kMalformedInput, "line 17: a face has 2 corners"},
        {"ply_binary_big_endian_nan.ply", Cause::kInvalidCoordinate, "byte 232: z of a vertex is nan"},
        {"ply_binary_bytes_after_end.ply", Cause::kMalformedInput, "byte 291: 3 bytes follow the last announced row"},
        {"ply_binary_cut.ply", Cause::kTruncatedInput, "byte 287: the file ends within a row"},
        {"ply_binary_index_beyond.ply", Cause::kIndexOutOfRange, "byte 278: a face names vertex 4"},
        {"ply_binary_list_beyond_end.ply", Cause::kTruncatedInput, "byte 291: the file ends within a row"},
        {"ply_binary_says_4_billion_faces.ply", Cause::kTruncatedInput,
         "line 8: 4000000000 face rows are announced, but the 52 bytes that follow hold at most 52"},
        {"ply_float_corners.ply", Cause::kMalformedInput,
         "line 8: element 'face' needs a list of integers named 'vertex_indices' or 'vertex_index'"},
        {"ply_negative_count.ply", Cause::kMalformedInput, "line 4: expected how many rows the element has, found '-4'"},
        {"ply_no_corners.ply", Cause::kMalformedInput,
         "line 8: element 'face' needs a list of integers named 'vertex_indices' or 'vertex_index'"},
        {"ply_no_end_header.ply", Cause::kTruncatedInput, "line 6: the file ends before 'end_header'"},
        {"ply_no_format.ply", Cause::kMalformedInput, "line 9: the header ends without a 'format' line"},
        {"ply_no_z.ply", Cause::kMalformedInput, "line 4: element 'vertex' needs the properties x, y and z"},
        {"ply_points_only.ply", Cause::kEmptyInput, "the file has 4 vertices, but no face"},
        {"ply_unknown_format.ply", Cause::kMalformedInput,
         "line 2: expected 'ascii', 'binary_little_endian' or 'binary_big_endian', found 'ascii_middle_endian'"},
        {"ply_unknown_type.ply", Cause::kMalformedInput, "line 6: expected a type such as 'float' or 'uint8', found 'half'"},
        {"ply_version_2.ply", Cause::kMalformedInput, "line 2: expected version 1.0 of PLY, found '2.0'"},
        {"ply_vertex_twice.ply", Cause::kMalformedInput, "line 8: element 'vertex' is announced twice"},
        {"stl_all_points_equal.stl", Cause::kEmptyInput, "each of the file's 4 faces has two equal corners after the weld"},
        {"stl_ascii_bad_number.stl", Cause::kMalformedInput, "line 5: expected a coordinate, found 'one'"},
        {"stl_ascii_cut_in_facet.stl", Cause::kTruncatedInput, "line 14: the file ends where 'endloop' should follow"},
        {"stl_ascii_four_corners.stl", Cause::kMalformedInput, "line 7: expected 'endloop', found 'vertex'"},
        {"stl_ascii_misspelt.stl", Cause::kMalformedInput, "line 7: expected 'endloop', found 'endlop'"},
        {"stl_ascii_nan.stl", Cause::kInvalidCoordinate, "line 13: y of a vertex is nan"},
        {"stl_ascii_no_endsolid.stl", Cause::kTruncatedInput, "line 29: the file ends where 'facet' or 'endsolid' should follow"},
        {"stl_ascii_text_after_end.stl", Cause::kMalformedInput, "line 31: expected 'solid', found 'and'"},
        {"stl_ascii_two_corners.stl", Cause::kMalformedInput, "line 6: expected 'vertex', found 'endloop'"},
        {"stl_cut_in_facet.stl", Cause::kTruncatedInput, "byte 80: 4 facets of 50 bytes are announced, but the file holds 3"},
        {"stl_cut_in_header.stl", Cause::kUnknownFormat, "byte 0: the bytes are of no format that is read"},
        {"stl_empty.stl", Cause::kEmptyInput, "byte 0: the file is empty"},
        {"stl_infinite.stl", Cause::kInvalidCoordinate, "byte 120: x of a vertex is inf"},
        {"stl_nan.stl", Cause::kInvalidCoordinate, "byte 170: y of a vertex is nan"},
        {"stl_no_faces.stl", Cause::kEmptyInput, "the file has 0 vertices, but no face"},
        {"stl_only_a_header.stl", Cause::kTruncatedInput,
         "byte 80: 4294967295 facets of 50 bytes are announced, but the file holds 0"},
        {"stl_says_4_billion_faces.stl", Cause::kTruncatedInput,
         "byte 80: 4294967295 facets of 50 bytes are announced, but the file holds 4"},
        {"stl_says_too_few_faces.stl", Cause::kMalformedInput,
         "byte 80: 2 facets of 50 bytes are announced, but the file holds 4 and 0 bytes"},
        {"stl_solid_header_cut.stl", Cause::kTruncatedInput, "byte 80: 4 facets of 50 bytes are announced, but the file holds 3"},
        {"stl_too_large.stl", Cause::kInvalidCoordinate, "byte 170: z of a vertex is 1999999973982208"},
        {"unknown_png.png", Cause::kUnknownFormat, "byte 0: the bytes are of no format that is read"},
        {"unknown_prose.txt", Cause::kUnknownFormat, "byte 0: the bytes are of no format that is read"},
    };
    return files;
}

TEST(ReadMeshTest, BrokenFilesSayWhatIsWrongAndWhere) {
    for (const BrokenFile& file : broken_files()) {
        SCOPED_TRACE(file.name);
        expect_error(read_mesh_file(data_file("broken/" + file.name), {}), file.cause, file.place);
    }
}

TEST(ReadMeshTest, EveryBrokenFileIsInTheTable) {
    std::set<std::string> listed;
    for (const BrokenFile& file : broken_files()) listed.insert(file.name);
    for (const fs::directory_entry& entry : fs::directory_iterator(data_file("broken"))) {
        if (entry.path().extension() == ".vsplit") continue;  // mrr_file_test has those
        EXPECT_TRUE(listed.contains(entry.path().filename().string())) << entry.path();
    }
}

TEST(ReadMeshTest, MessagesArePrintableWhateverTheFileHolds) {
    const Expected<ReadResult> result = read("v 0 0 \xFF\x01\n" + std::string(1000, 'x'));
    ASSERT_FALSE(result);
    for (const char c : result.error().message) EXPECT_TRUE(c >= ' ' && c < 127) << result.error().message;
    EXPECT_LT(result.error().message.size(), 200U);
}

TEST(ReadMeshTest, CutAnywhereItIsAnErrorOrAMesh) {
    // What is left of an OBJ is an OBJ; all others must notice that something is missing.
    for (const MeshFormat format : {MeshFormat::kStlBinary, MeshFormat::kStlAscii, MeshFormat::kObj, MeshFormat::kPlyBinary,
                                    MeshFormat::kPlyAscii, MeshFormat::kOff}) {
        const std::string whole = write_mesh(tetrahedron(), format);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const Expected<ReadResult> result = read(whole.substr(0, length), {.format = format});
            const bool whole_but_for_white_space = whole.find_first_not_of(" \n", length) == std::string::npos;
            const bool within_a_name = format == MeshFormat::kStlAscii && length > whole.rfind("endsolid") + 7;
            const bool within_last_index =
                format != MeshFormat::kPlyBinary && format != MeshFormat::kStlBinary && length + 1 >= whole.size();
            if (format == MeshFormat::kObj || whole_but_for_white_space || within_a_name || within_last_index) continue;
            EXPECT_FALSE(result) << format_name(format) << " cut to " << length << " of " << whole.size();
        }
    }
}

TEST(ReadMeshTest, ChangedBytesNeverHarm) {
    Random random(23);
    for (const MeshFormat format : {MeshFormat::kStlBinary, MeshFormat::kStlAscii, MeshFormat::kObj, MeshFormat::kPlyBinary,
                                    MeshFormat::kPlyAscii, MeshFormat::kOff}) {
        const std::string whole = write_mesh(tetrahedron(), format);
        for (int round = 0; round < 2000; ++round) {
            std::string changed = whole;
            for (std::uint32_t i = 0; i <= random.below(3); ++i)
                changed[random.below(static_cast<std::uint32_t>(changed.size()))] = static_cast<char>(random.below(256));
            const Expected<ReadResult> result = read(changed);
            if (!result) {
                EXPECT_FALSE(result.error().message.empty());
                continue;
            }
            EXPECT_FALSE(result->mesh.faces.empty());
            for (const Triangle& face : result->mesh.faces) {
                for (const std::uint32_t vertex : face) ASSERT_LT(vertex, result->mesh.vertex_count());
            }
            for (const Vec3& position : result->mesh.positions) ASSERT_LE(position.cwiseAbs().maxCoeff(), 1e15);
        }
    }
}

// --- real meshes -------------------------------------------------------------------------------------------------------------

struct RealMesh {
    std::string name;
    std::uint32_t vertices;
    std::uint32_t faces;
};

TEST(ReadMeshTest, RealMeshesHaveTheirCounts) {
    const std::vector<RealMesh> meshes = {{"analog_fire_phone_case.stl", 2051, 4102},
                                          {"cad_adis16480_ascii.stl", 3672, 7436},
                                          {"cad_counter_assembly_84k.stl", 41837, 83750},
                                          {"cad_fanuc_lrmate200id_link3.stl", 2927, 5850},
                                          {"cad_robotiq_ft300.stl", 29017, 58058},
                                          {"cad_tray_bottom_panel_ascii.stl", 2216, 4520},
                                          {"cad_unitree_z1_link01.stl", 28132, 56264},
                                          {"combined_cycloidal_drive.ply", 21384, 43368},
                                          {"combined_generic_twin.obj", 9874, 19704},
                                          {"combined_openscad_goodmouse_3k.stl", 1744, 3496},
                                          {"dirty_openscad_nonmanifold_crash.obj", 658, 1442},
                                          {"dirty_unitree_r1_head_cracked.stl", 44760, 68969},
                                          {"fe_sfepy_wheelset_surface.off", 3320, 6636},
                                          {"open_featuretype.stl", 2010, 3476},
                                          {"open_unitree_rubber_hand_70k.stl", 34852, 69696},
                                          {"scan_hammer_60k.obj", 30082, 60160},
                                          {"scan_nefertiti_70k.obj", 35002, 70000}};
    const fs::path directory = VSPLIT_SHARED_MESHES;
    for (const auto& [name, vertices, faces] : meshes) {
        if (!fs::exists(directory / name)) {
            GTEST_LOG_(WARNING) << directory / name << " is not on this machine; its counts are not checked";
            continue;
        }
        const Expected<ReadResult> result = read_mesh_file(directory / name, {});
        ASSERT_TRUE(result) << name << ": " << result.error().message;
        EXPECT_EQ(result->mesh.vertex_count(), vertices) << name;
        EXPECT_EQ(result->mesh.face_count(), faces) << name;
    }
    const fs::path malformed = directory / "dirty_assimp_malformed_index.obj";
    if (fs::exists(malformed))
        expect_error(read_mesh_file(malformed, {}), Cause::kIndexOutOfRange, "line 28: a face names vertex 0");
}

TEST(ReadMeshTest, ANameTellsTheFormatWhereBytesDoNot) {
    const TempDirectory directory;
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(directory.path() / name) << text;
        return directory.path() / name;
    };
    // No line of the first MiB says what this is.
    std::string cards;
    while (cards.size() < (1 << 20)) cards += "FORCE,1,1,0,1.,0.,0.,1.\n";
    cards += "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCTRIA3,1,1,1,2,3\n";
    expect_error(read_mesh_file(write("a.txt", cards), {}), Cause::kUnknownFormat, "of no format that is read");
    const Expected<ReadResult> named = read_mesh_file(write("a.bdf", cards), {});
    ASSERT_TRUE(named) << named.error().message;
    EXPECT_EQ(named->format, MeshFormat::kBdf);
    expect_error(read_mesh_file(write("b.nas", "EIGRL,1\n"), {}), Cause::kEmptyInput, "but no face; it was read as bdf");
}

TEST(ReadMeshTest, OddBytesInATextAreErrorsOfTheText) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n# " + std::string(100, 'c') + "\nf 1 2 3\n";
    text[text.find('1')] = '\0';
    expect_error(read_mesh(std::as_bytes(std::span(text)), {}), Cause::kMalformedInput, "line 2: expected");
    const std::string stl = write_mesh(cube(), MeshFormat::kStlBinary).substr(0, 300);
    expect_error(read_mesh(std::as_bytes(std::span(stl)), {}), Cause::kTruncatedInput, "the bytes were taken for a binary STL");
}

TEST(ReadMeshTest, OwnMeshesAreRead) {
    for (const fs::path& path : own_closed_meshes()) {
        const Expected<ReadResult> result = read_mesh_file(path, {});
        ASSERT_TRUE(result) << path << ": " << result.error().message;
        EXPECT_EQ(result->weld.collapsed_faces, 0U) << path;
        EXPECT_GT(result->mesh.face_count(), 100U) << path;
    }
}

}  // namespace
}  // namespace vsplit::test
