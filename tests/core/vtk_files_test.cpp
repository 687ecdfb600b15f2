// VTK's two formats as others write them: all kinds of cells and of data beside them, and where what is wrong stands.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "vsplit/io/read_mesh.h"

namespace vsplit::test {
namespace {

Expected<ReadResult> read(const std::string& bytes) { return read_mesh(std::as_bytes(std::span(bytes)), {}); }

TriangleMesh must_read(const std::string& bytes) {
    Expected<ReadResult> result = read(bytes);
    EXPECT_TRUE(result) << bytes << result.error().message;
    return result ? std::move(result->mesh) : TriangleMesh();
}

void expect_error(const std::string& bytes, Cause cause, const std::string& says) {
    const Expected<ReadResult> result = read(bytes);
    ASSERT_FALSE(result) << bytes;
    EXPECT_EQ(cause_name(result.error().cause), cause_name(cause)) << result.error().message;
    EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message << "\nexpected " << says;
}

const std::string kHead = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
const std::string kPoints = "POINTS 4 float\n0 0 0 1 0 0 0 1 0\n1 1 0\n";
const std::string kGrid = kHead + "UNSTRUCTURED_GRID\n" + kPoints;
const std::string kTwo = kGrid + "CELLS 2 8\n3 0 1 2\n3 1 3 2\nCELL_TYPES 2\n5 5\n";
const std::vector<std::uint32_t> kRegions = {4, 5};

TEST(VtkFilesTest, StripsAndPixelsAreFaces) {
    const TriangleMesh strip = must_read(kGrid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n6\n");
    EXPECT_EQ(strip.faces, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
    const TriangleMesh pixel = must_read(kGrid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n8\n");
    EXPECT_EQ(pixel.faces, (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}}));
    const TriangleMesh both = must_read(kHead + "POLYDATA\n" + kPoints +
                                        "POLYGONS 1 4\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 2 1 3\nCELL_DATA 2\n"
                                        "SCALARS region int\nLOOKUP_TABLE default\n4 5\n");
    EXPECT_EQ(both.faces, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {1, 2, 3}}));
    EXPECT_EQ(both.regions, (std::vector<std::uint32_t>{4, 5, 5}));
}

TEST(VtkFilesTest, DataBesideTheRegionsIsReadOver) {
    const std::string region = "SCALARS region int 1\nLOOKUP_TABLE default\n4 5\n";
    const std::string points =
        "POINT_DATA 4\nSCALARS t float\nLOOKUP_TABLE default\n1 2 3 4\nVECTORS v float\n1 2 3 4 5 6 7 8 9 10 11 12\n";
    for (const std::string& data :
         {"CELL_DATA 2\n" + region, std::string(points).append("CELL_DATA 2\n").append(region),
          std::string("CELL_DATA 2\n").append(region).append(points), "CELL_DATA 2\nVECTORS v double\n1 2 3 4 5 6\n" + region,
          "CELL_DATA 2\nNORMALS n double\n1 2 3 4 5 6\n" + region,
          "CELL_DATA 2\nTENSORS n double\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n" + region,
          "CELL_DATA 2\nSCALARS s float 1\nLOOKUP_TABLE mine\n1 2\nLOOKUP_TABLE mine 2\n1 0 0 1 0 0 1 1\n" + region,
          "CELL_DATA 2\nCOLOR_SCALARS c 3\n1 0 0 0 0.5 0\n" + region,
          "CELL_DATA 2\nTEXTURE_COORDINATES c 2 float\n1 0 0 0.5\n" + region,
          points +
              "FIELD f 1\nregion 1 4 int\n9 9 9 9\nCELL_DATA 2\nFIELD f 2\nn 3 2 float\n1 2 3 4 5 6\nregion 1 2 int\n4 5\n"}) {
        EXPECT_EQ(must_read(kTwo + data).regions, kRegions) << data;
    }
    expect_error(kTwo + "CELL_DATA 2\nSCALAR region int 1\n", Cause::kMalformedInput,
                 "line 14: expected data of points or cells, such as SCALARS or FIELD, found 'SCALAR'");
}

/// Big-endian, as the format has it.
template <class T>
void put(std::string& bytes, T value) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::little) bytes.append(raw.rbegin(), raw.rend());
    if constexpr (std::endian::native == std::endian::big) bytes.append(raw.begin(), raw.end());
}

template <class T>
std::string raw(const std::vector<T>& values) {
    std::string bytes;
    for (const T value : values) put(bytes, value);
    return bytes + "\n";
}

std::string binary_grid(const std::vector<std::int32_t>& cells) {
    return "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" +
           raw<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + "CELLS 2 8\n" + raw(cells) + "CELL_TYPES 2\n" +
           raw<std::int32_t>({5, 5});
}

TEST(VtkFilesTest, ArraysThatAreNoNumbersAreReadOverAndMinusOneIsNoRegion) {
    const std::string fields = kTwo + "CELL_DATA 2\nFIELD FieldData 2\n";
    for (const std::string& other : {std::string("names 1 2 string\nleft%20side\nright\n"), std::string("marks 1 2 bit\n0 1\n"),
                                     std::string("small 1 2 signed_char\n-3 7\n")}) {
        std::string file = fields;
        file.append(other).append("region 1 2 int\n4 5\n");
        EXPECT_EQ(must_read(file).regions, kRegions) << other;
    }
    EXPECT_EQ(must_read(kTwo + "CELL_DATA 2\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n-1 5\n").regions,
              (std::vector<std::uint32_t>{0, 5}));
}

TEST(VtkFilesTest, BinaryDataOfPointsMayComeFirst) {
    const std::string data = "POINT_DATA 4\nFIELD FieldData 1\nt 1 4 double\n" + raw<double>({1, 2, 3, 4}) +
                             "SCALARS s float\nLOOKUP_TABLE mine\n" + raw<float>({1, 2, 3, 4}) + "LOOKUP_TABLE mine 1\n" +
                             "\n\r\n\t" + "\nCELL_DATA 2\nFIELD FieldData 1\nregion 1 2 int\n" + raw<std::int32_t>({4, 5});
    EXPECT_EQ(must_read(binary_grid({3, 0, 1, 2, 3, 1, 3, 2}) + data).regions, kRegions);
}

TEST(VtkFilesTest, WhatIsWrongIsNamedWhereItStands) {
    const std::string bad = binary_grid({3, 0, 1, 2, 3, 1, 7, 2});
    const std::size_t cells = bad.find("CELLS 2 8\n") + 10;
    expect_error(bad, Cause::kIndexOutOfRange,
                 "byte " + std::to_string(cells + std::size_t{4} * 6) + ": cell 1 names point 7; there are 0 to 3");
    expect_error(kGrid + "CELLS 3 12\n3 0 1 2\n3 0 1 4\n3 1 3 2\nCELL_TYPES 3\n5 5 5\n", Cause::kIndexOutOfRange,
                 "line 10: cell 1 names point 4");
    expect_error(kGrid + "CELLS 3 6\nOFFSETS int\n0 3\n6\nCONNECTIVITY int\n0 1 2\n1 3 -2\nCELL_TYPES 2\n5 5\n",
                 Cause::kIndexOutOfRange, "line 14: cell 1 names point -2");
    expect_error(kGrid + "CELLS 3 6\nOFFSETS int\n0 3\n5\nCONNECTIVITY int\n0 1 2\n1 3 2\nCELL_TYPES 2\n5 5\n",
                 Cause::kMalformedInput, "line 11: cell 1 begins at 3 of 6 points and ends at 5; the last one must end where");
    expect_error(kGrid + "CELLS 2 9\n3 0 1 2\n4 1 3 2 0\nCELL_TYPES 2\n5\n5\n", Cause::kMalformedInput,
                 "line 10: cell 1 of type 5 has 4 points; expected 3");
    expect_error(kTwo + "CELL_DATA 2\nSCALARS region float\nLOOKUP_TABLE default\n1\n1.5\n", Cause::kMalformedInput,
                 "line 17: expected a region, an integer up to 4294967294, found 1.5");
    expect_error(kGrid + "CELLS 2 8\n3 0 1 2\n3 1 3 2\nCELL_TYPES 0\n", Cause::kMalformedInput, "0 types are given for 2 cells");
    expect_error(kGrid + "CELLS 2 8\n3 0 1 2\n3 1 3 2\n", Cause::kTruncatedInput, "the file ends before CELL_TYPES");
}

std::string vtu(const std::string& counts, const std::string& points, const std::string& connectivity,
                const std::string& offsets) {
    return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n<Piece " + counts +
           ">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" + points +
           "</DataArray></Points>\n<Cells><DataArray type=\"Int32\" Name=\"connectivity\">" + connectivity +
           "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\">" + offsets +
           "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\">5 5</DataArray></Cells>\n"
           "<CellData><DataArray type=\"Int32\" Name=\"region\">4 "
           "5</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>\n";
}

const std::string kCounts = "NumberOfPoints=\"4\" NumberOfCells=\"2\"";
const std::string kFour = "0 0 0 1 0 0\n0 1 0 1 1 0\n";

TEST(VtkFilesTest, VtuCountsAndIndicesAreChecked) {
    const std::string good = vtu(kCounts, kFour, "0 1 2\n1 3 2", "3 6");
    EXPECT_EQ(must_read(good).regions, kRegions) << "text is the default format";
    expect_error(vtu("NumberOfPoints=\"5\" NumberOfCells=\"2\"", kFour, "0 1 2 1 3 2", "3 6"), Cause::kMalformedInput,
                 "line 3: expected 3 coordinates for each of 5 points, found 12 numbers");
    expect_error(vtu("NumberOfPoints=\"4\" NumberOfCells=\"3\"", kFour, "0 1 2 1 3 2", "3 6"), Cause::kMalformedInput,
                 "line 7: 3 cells are announced, but there are 2 offsets");
    expect_error(vtu("NumberOfPoints=\"4\"", kFour, "0 1 2 1 3 2", "3 6"), Cause::kMalformedInput,
                 "line 2: expected an integer of 0 or more as NumberOfCells of the piece, found none");
    expect_error(vtu(kCounts, kFour, "0 1 2\n1 3 1.7", "3 6"), Cause::kMalformedInput,
                 "line 7: expected an integer of 0 or more in connectivity, found 1.7");
    expect_error(vtu(kCounts, kFour, "0 1 2\n\n1 3 4", "3 6"), Cause::kIndexOutOfRange, "line 8: cell 1 names point 4");
    expect_error(vtu(kCounts, kFour, "0 1 2 1 3 2 0 1 3", "3 6"), Cause::kMalformedInput,
                 "line 7: cell 1 begins at 3 of 9 points and ends at 6; the last one must end where the points do");
    expect_error(vtu(kCounts, "0 0 0 1 0 0\n0 1 0 1 inf 0", "0 1 2 1 3 2", "3 6"), Cause::kInvalidCoordinate, "line 4");
    std::string untyped = good;
    untyped.replace(untyped.find("\"types\">5 5"), 11, "\"types\">");
    expect_error(untyped, Cause::kMalformedInput, "line 9: 0 types are given for 2 cells");
    std::string flat = good;
    flat.replace(flat.find("NumberOfComponents=\"3\""), 22, "NumberOfComponents=\"2\"");
    expect_error(flat, Cause::kMalformedInput, "line 3: expected points of 3 components, found 2");
    for (const char* before : {"<CellData>", "<DataArray type=\"Int32\" Name=\"region\"", "</CellData>", "</VTKFile>"})
        expect_error(good.substr(0, good.find(before)), Cause::kTruncatedInput, "the file ends before");
}

TEST(VtkFilesTest, Base64MayHaveLines) {
    // 96 bytes of doubles behind a length of 4, in lines of 76 letters as base64 -w 76 makes them.
    const std::vector<double> coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    std::string bytes("\x60\0\0\0", 4);
    bytes.append(reinterpret_cast<const char*>(coordinates.data()), 96);
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    bytes.append(2, '\0');  // to whole triples
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])); };
        const unsigned bits = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        for (const unsigned shift : {18U, 12U, 6U, 0U}) text += kLetters[bits >> shift & 63U];
        if (text.size() % 77 == 76) text += '\n';
    }
    std::string file = vtu(kCounts, text, "0 1 2 1 3 2", "3 6");
    file.replace(file.find("NumberOfComponents=\"3\""), 22, "NumberOfComponents=\"3\" format=\"binary\"");
    const TriangleMesh mesh = must_read(file);
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.positions[3], Vec3(1, 1, 0));
}

}  // namespace
}  // namespace vsplit::test
