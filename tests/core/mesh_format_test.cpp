#include "vsplit/io/mesh_format.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/core/meshes.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::test {
namespace {

const std::span<const MeshFormat> kFormats = mesh_formats();

std::optional<MeshFormat> detect(const std::string& text) { return detect_format(std::as_bytes(std::span(text))); }

TEST(MeshFormatTest, NamesAreReadBack) {
    for (const MeshFormat format : kFormats) {
        const Expected<MeshFormat> found = format_by_name(format_name(format));
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, format);
    }
}

TEST(MeshFormatTest, UnknownNameListsTheNames) {
    const Expected<MeshFormat> found = format_by_name("step");
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().cause, Cause::kInvalidOption);
    EXPECT_EQ(found.error().field, "format");
    for (const MeshFormat format : kFormats) {
        EXPECT_NE(found.error().message.find(format_name(format)), std::string::npos) << found.error().message;
    }
}

TEST(MeshFormatTest, ExtensionsInAnyCase) {
    const std::vector<std::pair<std::string, MeshFormat>> cases = {
        {"a.stl", MeshFormat::kStlBinary}, {"/dir.obj/B.STL", MeshFormat::kStlBinary},
        {"a.b.Obj", MeshFormat::kObj},     {"a.ply", MeshFormat::kPlyBinary},
        {"a.off", MeshFormat::kOff},       {"a.msh", MeshFormat::kMsh},
        {"a.inp", MeshFormat::kInp},       {"a.bdf", MeshFormat::kBdf},
        {"a.NAS", MeshFormat::kBdf},       {"a.vtk", MeshFormat::kVtk},
        {"a.vtu", MeshFormat::kVtu},       {"part.3MF", MeshFormat::k3mf}};
    for (const auto& [name, format] : cases) {
        const Expected<MeshFormat> found = format_by_extension(name);
        ASSERT_TRUE(found) << name;
        EXPECT_EQ(*found, format) << name;
    }
}

TEST(MeshFormatTest, UnknownExtensionListsTheExtensions) {
    for (const std::string name : {"a", "a.", "a.step", "", "a.stl/b", ".", "stl"}) {
        const Expected<MeshFormat> found = format_by_extension(name);
        ASSERT_FALSE(found) << name;
        EXPECT_EQ(found.error().cause, Cause::kUnknownFormat);
        EXPECT_NE(found.error().message.find(".stl, .obj, .ply, .off"), std::string::npos) << found.error().message;
    }
}

TEST(MeshFormatTest, WhatIsWrittenIsDetected) {
    for (const auto& [name, mesh] : small_meshes()) {
        for (const MeshFormat format : kFormats) {
            EXPECT_EQ(detect(write_mesh(mesh, format)), format) << name << " as " << format_name(format);
        }
    }
}

TEST(MeshFormatTest, BinaryStlThatSaysSolidIsToldByItsLength) {
    std::string bytes = write_mesh(cube(), MeshFormat::kStlBinary);
    bytes.replace(0, 10, "solid cube");
    EXPECT_EQ(detect(bytes), MeshFormat::kStlBinary);
    // Nothing but spaces and text up to the count, and the first coordinates without a zero byte.
    std::string spaced = "solid" + std::string(75, ' ') + bytes.substr(80);
    EXPECT_EQ(detect(spaced), MeshFormat::kStlBinary);
    EXPECT_EQ(detect(spaced.substr(0, spaced.size() - 30)), MeshFormat::kStlBinary) << "cut off, it is still no text";
}

TEST(MeshFormatTest, TextIsToldByItsFirstWord) {
    EXPECT_EQ(detect("solid\nfacet"), MeshFormat::kStlAscii);
    EXPECT_EQ(detect("  SOLID name"), MeshFormat::kStlAscii);
    EXPECT_EQ(detect("OFF 8 6 12\n"), MeshFormat::kOff);
    EXPECT_EQ(detect("# comment\n\nCOFF\n"), MeshFormat::kOff);
    EXPECT_EQ(detect("STCNOFF\n"), MeshFormat::kOff);
    EXPECT_EQ(detect("# comment\r\n\r\nmtllib a.mtl\r\n"), MeshFormat::kObj);
    EXPECT_EQ(detect("\xEF\xBB\xBFv 0 0 0\n"), MeshFormat::kObj);
    EXPECT_EQ(detect(std::string(10000, '#')), MeshFormat::kObj) << "a comment longer than what is looked at";
    EXPECT_EQ(detect("** a deck\n*HEADING\n"), MeshFormat::kInp);
    EXPECT_EQ(detect("$ a comment\nSOL 101\nCEND\nBEGIN BULK\n"), MeshFormat::kBdf);
    EXPECT_EQ(detect("GRID,1,,0.,0.,0.\n"), MeshFormat::kBdf);
    EXPECT_EQ(detect("$MeshFormat\n2.2 1 8\n"), MeshFormat::kMsh2);
    EXPECT_EQ(detect("$Comments\n$EndComments\n$MeshFormat\n4.1 0 8\n"), MeshFormat::kMshAscii);
    EXPECT_EQ(detect("# vtk DataFile Version 4.2\ntitle\nASCII\n"), MeshFormat::kVtkAscii);
    EXPECT_EQ(detect("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">"), MeshFormat::kVtu);
    EXPECT_EQ(detect("<?xml version=\"1.0\"?>\n<svg/>"), std::nullopt);
    EXPECT_EQ(detect("ply\nformat ascii 1.0\n"), MeshFormat::kPlyAscii);
    EXPECT_EQ(detect("ply\r\ncomment a\r\nformat binary_big_endian 1.0\r\n"), MeshFormat::kPlyBinary);
}

TEST(MeshFormatTest, CommentsMayBeLong) {
    const auto times = [](int count, const std::string& line) {
        std::string text;
        for (int i = 0; i < count; ++i) text += line;
        return text;
    };
    EXPECT_EQ(detect(times(500, "# a line of comment\n") + "OFF\n3 1 0\n"), MeshFormat::kOff);
    EXPECT_EQ(detect(times(500, "** a line of comment\n") + "*NODE\n"), MeshFormat::kInp);
    EXPECT_EQ(detect(times(500, "$$ a line of comment\n") + "GRID,1,,0.,0.,0.\n"), MeshFormat::kBdf);
    EXPECT_EQ(detect("$Comments\n" + times(500, "a line of comment\n") + "$EndComments\n$MeshFormat\n2.2 0 8\n"),
              MeshFormat::kMsh2Ascii);
    EXPECT_EQ(
        detect("<?xml version=\"1.0\"?>\n<!--" + times(500, "a line of comment\n") + "-->\n<VTKFile type=\"UnstructuredGrid\">"),
        MeshFormat::kVtu);
    EXPECT_EQ(detect("ply\n" + times(500, "comment a line\n") + "format binary_little_endian 1.0\n"), MeshFormat::kPlyBinary);
}

TEST(MeshFormatTest, DecksBehindAMebibyteOfCommentsAreToldByThem) {
    for (const auto& [comment, format] :
         {std::pair{"$ a line of comment\n", MeshFormat::kBdf}, std::pair{"** a line of comment\n", MeshFormat::kInp},
          std::pair{"# a line of comment\n", MeshFormat::kObj}}) {
        std::string text;
        while (text.size() <= std::size_t{1} << 20) text += comment;
        EXPECT_EQ(detect(text + "whatever\n"), format);
    }
}

TEST(MeshFormatTest, EveryKeywordThatTheObjReaderKnowsTellsAnObj) {
    for (const char* word : {"v", "fo", "vp", "cstype", "deg", "curv", "surf", "call", "usemap", "bevel", "trace_obj", "csh"})
        EXPECT_EQ(detect(std::string(word) + " 1 2 3\nf 1 2 3\n"), MeshFormat::kObj) << word;
}

TEST(MeshFormatTest, AnOffMayLeaveItsKeywordOut) {
    EXPECT_EQ(detect("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), MeshFormat::kOff);
    EXPECT_EQ(detect("# counts\n3 1\n\n# places\n0 -1e3 .5 # one\n"), MeshFormat::kOff);
    EXPECT_EQ(detect("3 1 0\n"), std::nullopt);
    EXPECT_EQ(detect("3 1 0 2\n0 0 0\n"), std::nullopt);
    EXPECT_EQ(detect("3.5 1 0\n0 0 0\n"), std::nullopt) << "points";
    EXPECT_EQ(detect("3 1 0\n0 0\n"), std::nullopt);
}

TEST(MeshFormatTest, BulkDataBeginWithAnyCommandOrCard) {
    const std::string grid = "\nGRID           1              0.      0.      0.\n";
    for (const char* first : {"PARAM,POST,-1", "GRDSET,,,,,,,6", "CORD2R  1               0.", "ASSIGN OUTPUT2='a.op2'",
                              "INIT MASTER(S)", "INCLUDE 'a.bdf'", "SET 1 = 1 THRU 5", "FORMAT H3D", "DISPLACEMENT(PLOT) = ALL",
                              "TITLE = a part", "FORCE,1,2", "  $ comment\n   PARAM,POST,-1"}) {
        EXPECT_EQ(detect(first + grid), MeshFormat::kBdf) << first;
        EXPECT_EQ(detect(std::string(first) + "\nBEGIN BULK\n"), MeshFormat::kBdf) << first;
    }
    EXPECT_EQ(detect("  GRID,1,,0.,0.,0.\n"), MeshFormat::kBdf);
    EXPECT_EQ(detect("\tCQUAD4\t1\t1\t1\t2\t3\t4\n"), MeshFormat::kBdf);
    EXPECT_EQ(detect("A text about a\nGRID of 5 by 5\n"), std::nullopt);
}

TEST(MeshFormatTest, AFewOddBytesDoNotMakeATextBinary) {
    const auto damaged = [](std::string text) {
        text[text.size() / 2] = '\0';
        return text;
    };
    for (const MeshFormat format :
         {MeshFormat::kStlAscii, MeshFormat::kObj, MeshFormat::kOff, MeshFormat::kInp, MeshFormat::kBdf})
        EXPECT_EQ(detect(damaged(write_mesh(cube(), format))), format) << format_name(format);
    EXPECT_EQ(detect(damaged("A letter of more than 84 bytes is text all the same. " + std::string(200, '.'))), std::nullopt);
}

TEST(MeshFormatTest, ANameTellsWhatBytesDoNotTell) {
    const auto told = [](const std::string& text, const char* name) {
        return format_where_bytes_do_not_tell(std::as_bytes(std::span(text)), name);
    };
    EXPECT_EQ(told("EIGRL,1\n", "a.nas"), MeshFormat::kBdf);
    EXPECT_EQ(told("3 1 0\n", "a.off"), MeshFormat::kOff);
    EXPECT_EQ(told("3 1 0\n0 0 0\n", "a.bdf"), std::nullopt) << "the bytes tell it";
    EXPECT_EQ(told("deform 1\n", "a.OBJ"), MeshFormat::kObj);
    EXPECT_EQ(told("OFF\n3 1 0\n", "a.bdf"), std::nullopt) << "the bytes tell it";
    EXPECT_EQ(told("any text", "a.stl"), std::nullopt) << "an STL has a mark";
    EXPECT_EQ(told("any text", "a.txt"), std::nullopt);
}

TEST(MeshFormatTest, OtherBytesAreNoFormat) {
    EXPECT_EQ(detect(""), std::nullopt);
    EXPECT_EQ(detect(" \n \n"), std::nullopt);
    EXPECT_EQ(detect("solidity"), std::nullopt);
    EXPECT_EQ(detect("plywood"), std::nullopt);
    EXPECT_EQ(detect("OFFICE"), std::nullopt);
    EXPECT_EQ(detect("{\"vertices\": []}"), std::nullopt);
    EXPECT_EQ(detect(std::string(1000, '\x81')), std::nullopt);
    EXPECT_EQ(detect("A letter of more than 84 bytes is text all the same. " + std::string(200, '.')), std::nullopt);
}

}  // namespace
}  // namespace vsplit::test
