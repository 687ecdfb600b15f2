// What solvers and mesh generators read and write: regions and sets on the way, the many layouts, and what is said of broken
// files.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <sstream>
#include <string>

#include "tests/core/meshes.h"
#include "tests/core/random.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mesh/inspect.h"

namespace vsplit::test {
namespace {

Expected<ReadResult> read(const std::string& bytes, const ReadOptions& options = {}) {
    return read_mesh(std::as_bytes(std::span(bytes)), options);
}

TriangleMesh must_read(const std::string& bytes) {
    Expected<ReadResult> result = read(bytes);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(result->mesh) : TriangleMesh();
}

/// A torus in three regions with names, and a set of two of them.
TriangleMesh grouped_torus() {
    TriangleMesh mesh = torus(18, 9);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(1 + f * 3 / mesh.face_count());
    mesh.sets = {{"inlet", {1}}, {"wall", {2}}, {"outlet", {3}}, {"ends", {1, 3}}};
    return mesh;
}

/// The faces of each set, whatever the regions are called.
std::map<std::string, std::vector<std::uint32_t>> members(const TriangleMesh& mesh) {
    std::map<std::string, std::vector<std::uint32_t>> sets;
    for (const FaceSet& set : mesh.sets) {
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            if (std::find(set.regions.begin(), set.regions.end(), mesh.regions[f]) != set.regions.end())
                sets[set.name].push_back(f);
        }
    }
    return sets;
}

TEST(SolverFormatsTest, RegionsComeBackFromEveryFormatThatHasThem) {
    const TriangleMesh mesh = grouped_torus();
    for (const MeshFormat format :
         {MeshFormat::kMsh, MeshFormat::kMshAscii, MeshFormat::kMsh2, MeshFormat::kMsh2Ascii, MeshFormat::kInp, MeshFormat::kBdf,
          MeshFormat::kVtk, MeshFormat::kVtkAscii, MeshFormat::kVtu, MeshFormat::k3mf}) {
        const TriangleMesh same = must_read(write_mesh(mesh, format));
        EXPECT_EQ(same.faces, mesh.faces) << format_name(format);
        EXPECT_EQ(same.regions, mesh.regions) << format_name(format);
        EXPECT_EQ(write_mesh(same, format), write_mesh(must_read(write_mesh(same, format)), format)) << format_name(format);
    }
}

TEST(SolverFormatsTest, SetsComeBackFromFormatsThatNameThem) {
    const TriangleMesh mesh = grouped_torus();
    for (const MeshFormat format : {MeshFormat::kMsh, MeshFormat::kMshAscii, MeshFormat::kInp, MeshFormat::k3mf}) {
        EXPECT_EQ(members(must_read(write_mesh(mesh, format))), members(mesh)) << format_name(format);
    }
    std::map<std::string, std::vector<std::uint32_t>> parts = members(mesh);
    parts.erase("ends");  // one region a face, and its name, is all that these know
    for (const MeshFormat format : {MeshFormat::kMsh2, MeshFormat::kMsh2Ascii, MeshFormat::kBdf}) {
        EXPECT_EQ(members(must_read(write_mesh(mesh, format))), parts) << format_name(format);
    }
}

TEST(SolverFormatsTest, OverlappingPhysicalGroupsOfGmshKeepTheirFacesApart) {
    // As Gmsh writes it: "all" = {1, 2}, "top" = {2}; the surface of both has two tags in 4.1, its elements come twice in 2.2.
    const std::string start = "$PhysicalNames\n2\n2 1 \"all\"\n2 2 \"top\"\n$EndPhysicalNames\n";
    const std::string msh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + start +
                             "$Entities\n0 0 2 0\n1 0 0 0 1 1 0 1 1 0\n2 0 0 0 1 1 0 2 1 2 0\n$EndEntities\n"
                             "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
                             "$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n2 2 2 1\n2 1 3 4\n$EndElements\n";
    const std::string msh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + start +
                             "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                             "$Elements\n3\n1 2 2 1 1 1 2 3\n2 2 2 1 2 1 3 4\n3 2 2 2 2 1 3 4\n$EndElements\n";
    const std::map<std::string, std::vector<std::uint32_t>> expected{{"all", {0, 1}}, {"top", {1}}};
    for (const std::string& bytes : {msh4, msh2}) {
        const TriangleMesh mesh = must_read(bytes);
        EXPECT_EQ(mesh.face_count(), 2U);
        EXPECT_EQ(mesh.regions, (std::vector<std::uint32_t>{1, 2}));
        EXPECT_EQ(members(mesh), expected);
    }
}

TEST(SolverFormatsTest, AGroupOfManySurfacesIsOneRegion) {
    std::string bytes =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 13 \"SKIN\"\n$EndPhysicalNames\n"
        "$Entities\n0 0 2 0\n1 0 0 0 1 1 0 1 13 0\n2 0 0 0 1 1 0 1 13 0\n$EndEntities\n"
        "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
        "$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n2 2 2 1\n2 1 3 4\n$EndElements\n";
    const TriangleMesh mesh = must_read(bytes);
    ASSERT_EQ(mesh.sets.size(), 1U);
    EXPECT_EQ(mesh.sets[0].regions, std::vector<std::uint32_t>{13});
    EXPECT_NE(write_mesh(mesh, MeshFormat::kBdf).find("\"SKIN\""), std::string::npos);
    EXPECT_NE(write_mesh(mesh, MeshFormat::kMsh2).find("2 13 \"SKIN\""), std::string::npos);
}

TEST(SolverFormatsTest, NumbersOfInputDecksFitWhatCalculixReads) {
    Random random(20);
    TriangleMesh mesh = torus(12, 6);
    for (Vec3& p : mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) p[axis] *= std::pow(10.0, random.uniform(-12, 12));
    }
    const std::string deck = write_mesh(mesh, MeshFormat::kInp);
    std::istringstream lines(deck.substr(deck.find("*NODE"), deck.find("*ELEMENT") - deck.find("*NODE")));
    std::size_t longest = 0;
    for (std::string number; std::getline(lines, number, ' ');) {
        longest = std::max(longest, number.substr(0, number.find_first_of(",\n")).size());
    }
    EXPECT_LE(longest, 20U);
    const TriangleMesh same = must_read(deck);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(same.positions[v][axis], mesh.positions[v][axis], 1e-12 * std::abs(mesh.positions[v][axis]));
    }
}

TEST(SolverFormatsTest, SetsThatHoldEachOtherInALongChainEnd) {
    std::string chain = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n*ELSET, ELSET=a0\n1\n";
    const int sets = 5000;
    for (int i = 1; i <= sets; ++i) chain += "*ELSET, ELSET=a" + std::to_string(i) + "\na" + std::to_string(i - 1) + "\n";
    EXPECT_EQ(must_read(chain).sets.size(), sets + 1U);
    for (int i = sets + 1; i <= 20000; ++i) chain += "*ELSET, ELSET=a" + std::to_string(i) + "\na" + std::to_string(i - 1) + "\n";
    const Expected<ReadResult> refused = read(chain);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().cause, Cause::kLimitExceeded);
    const TriangleMesh ring = must_read(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n"
        "*ELSET, ELSET=a\nb, 1\n*ELSET, ELSET=b\na\n");
    EXPECT_EQ(members(ring), (std::map<std::string, std::vector<std::uint32_t>>{{"a", {0}}, {"b", {0}}}));
}

TEST(SolverFormatsTest, LargeRegionsAreNumberedAnewWhereAFormatHasNoRoom) {
    TriangleMesh mesh = grouped_torus();
    for (std::uint32_t& region : mesh.regions) region += 4'000'000'000U;
    for (FaceSet& set : mesh.sets) {
        for (std::uint32_t& region : set.regions) region += 4'000'000'000U;
    }
    const std::vector<std::uint32_t> anew = grouped_torus().regions;
    for (const MeshFormat format : {MeshFormat::kMsh, MeshFormat::kMsh2, MeshFormat::kBdf}) {
        const TriangleMesh same = must_read(write_mesh(mesh, format));
        EXPECT_EQ(same.regions, anew) << format_name(format);
    }
    EXPECT_EQ(must_read(write_mesh(mesh, MeshFormat::kStlBinary)).regions, anew);
    EXPECT_EQ(must_read(write_mesh(mesh, MeshFormat::kInp)).regions, anew);  // by its sets
}

TEST(SolverFormatsTest, NamesOfSetsFitSolvers) {
    TriangleMesh mesh = grouped_torus();
    mesh.sets = {{std::string(95, 'x'), {1}}, {std::string(95, 'x') + "y", {2}}, {"Eall", {3}}, {"gone", {7}}};
    const std::string deck = write_mesh(mesh, MeshFormat::kInp);
    std::istringstream lines(deck);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t name = line.find("SET=");
        if (line.starts_with("*") && name != std::string::npos) {
            EXPECT_LE(line.size() - name - 4, 80U) << line;
        }
    }
    EXPECT_NE(deck.find("ELSET=Eall_2"), std::string::npos);
    EXPECT_EQ(deck.find("gone"), std::string::npos);
    EXPECT_EQ(write_mesh(mesh, MeshFormat::kMshAscii).find("gone"), std::string::npos);
}

TEST(SolverFormatsTest, ManySetsAreWrittenInLinearTime) {
    // Names alike in the 60 characters that decks take, too.
    const auto with_sets = [](std::uint32_t sets) {
        TriangleMesh mesh;
        for (std::uint32_t i = 0; i < sets; ++i) {
            for (const Vec3& p : {Vec3(i, 0, 0), Vec3(i + 1, 0, 0), Vec3(i, 1, 0)}) mesh.positions.push_back(p);
            mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            mesh.regions.push_back(i + 1);
            mesh.sets.push_back({std::string(70, 'a') + std::to_string(i), {i + 1, (i + 1) % sets + 1}});
        }
        return mesh;
    };
    const auto seconds = [](const TriangleMesh& mesh, MeshFormat format) {  // of this process: others may keep the machine busy
        double least = 1e9;
        for (int run = 0; run < 3; ++run) {
            const std::clock_t start = std::clock();
            EXPECT_FALSE(write_mesh(mesh, format).empty());
            least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        }
        return least;
    };
    const TriangleMesh few = with_sets(2000), many = with_sets(20000);
    for (const MeshFormat format : {MeshFormat::kMsh, MeshFormat::kMsh2, MeshFormat::k3mf, MeshFormat::kInp})
        EXPECT_LT(seconds(many, format), 40 * seconds(few, format)) << format_name(format) << ": of the square it is 100";
}

TEST(SolverFormatsTest, AConcaveQuadrilateralIsCutWhereItDoesNotFold) {
    const TriangleMesh arrow =
        must_read("*NODE\n1, 0, 0, 0\n2, 2, -1, 0\n3, 0.5, 0, 0\n4, 2, 1, 0\n*ELEMENT, TYPE=S4\n1, 2, 3, 4, 1\n");
    ASSERT_EQ(arrow.face_count(), 2U);
    for (const Triangle& t : arrow.faces) {
        const Vec3 normal = (arrow.positions[t[1]] - arrow.positions[t[0]]).cross(arrow.positions[t[2]] - arrow.positions[t[0]]);
        EXPECT_GT(normal.z(), 0);
    }
}

TEST(SolverFormatsTest, ASetOfAllElementsSaysNothingUnlessItIsOfSome) {
    const std::string nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n";
    const TriangleMesh all = must_read(
        nodes + "*ELEMENT, TYPE=S3, ELSET=EALL\n1, 1, 2, 3\n2, 1, 3, 4\n*SURFACE, NAME=TOP, TYPE=ELEMENT\nEALL, SPOS\n");
    EXPECT_EQ(members(all), (std::map<std::string, std::vector<std::uint32_t>>{{"TOP", {0, 1}}}));
    const TriangleMesh half = must_read(nodes + "*ELEMENT, TYPE=S3, ELSET=Eall\n1, 1, 2, 3\n*ELEMENT, TYPE=S3\n2, 1, 3, 4\n");
    EXPECT_EQ(members(half), (std::map<std::string, std::vector<std::uint32_t>>{{"Eall", {0}}}));
    EXPECT_TRUE(must_read(nodes + "*ELEMENT, TYPE=S3, ELSET=Eall\n1, 1, 2, 3\n2, 1, 3, 4\n").regions.empty());
}

TEST(SolverFormatsTest, BulkDataEndWhereTheySay) {
    const std::string cards = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCTRIA3,1,1,1,2,3\n";
    EXPECT_EQ(must_read("BEGIN BULK\n" + cards + "ENDDATA\n").face_count(), 1U);
    EXPECT_EQ(must_read(cards).face_count(), 1U);  // a part that others include
    const Expected<ReadResult> cut = read("BEGIN BULK\n" + cards);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().cause, Cause::kTruncatedInput);
}

TEST(SolverFormatsTest, RegionsWithoutNamesStaySoInGmshFiles) {
    TriangleMesh mesh = grouped_torus();
    mesh.sets = {{"ends", {1, 3}}};
    const TriangleMesh same = must_read(write_mesh(mesh, MeshFormat::kMsh));
    EXPECT_EQ(same.regions, mesh.regions);
    EXPECT_EQ(same.sets, mesh.sets);
}

TEST(SolverFormatsTest, PartitionsOfGmshKeepTheirGroupsAndTotalsAreChecked) {
    const std::string msh =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"skin\"\n$EndPhysicalNames\n"
        "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 7 0\n$EndEntities\n"
        "$PartitionedEntities\n2\n0\n0 0 2 0\n2 2 1 1 1 0 0 0 1 1 0 1 7 0\n3 2 1 1 2 0 0 0 1 1 0 1 7 0\n"
        "$EndPartitionedEntities\n"
        "$Nodes\n1 4 1 4\n2 2 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
        "$Elements\n2 2 1 2\n2 2 2 1\n1 1 2 3\n2 3 2 1\n2 1 3 4\n$EndElements\n";
    EXPECT_EQ(members(must_read(msh)), (std::map<std::string, std::vector<std::uint32_t>>{{"skin", {0, 1}}}));
    for (const auto& [right, wrong] : {std::pair<std::string, std::string>{"$Nodes\n1 4 ", "$Nodes\n1 5 "},
                                       std::pair<std::string, std::string>{"$Elements\n2 2 ", "$Elements\n2 9 "}}) {
        std::string other = msh;
        other.replace(other.find(right), right.size(), wrong);
        const Expected<ReadResult> refused = read(other);
        ASSERT_FALSE(refused) << wrong;
        EXPECT_NE(refused.error().message.find("are announced"), std::string::npos) << refused.error().message;
    }
}

TEST(SolverFormatsTest, AnElementIsDefinedOnce) {
    const Expected<ReadResult> twice =
        read("*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3\n7, 1, 2, 3\n8, 1, 2, 3\n7, 2, 3, 1\n");
    ASSERT_FALSE(twice);
    EXPECT_NE(twice.error().message.find("line 8"), std::string::npos) << twice.error().message;
    EXPECT_NE(twice.error().message.find("line 6"), std::string::npos) << twice.error().message;
}

TEST(SolverFormatsTest, BulkDataKeepElevenDigits) {
    TriangleMesh mesh = bumpy_sphere(2, 0.1, 3);
    Random random(5);
    for (Vec3& p : mesh.positions) p *= std::pow(10, random.uniform(-12, 12));
    const TriangleMesh same = must_read(write_mesh(mesh, MeshFormat::kBdf));
    ASSERT_EQ(same.positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LE(std::abs(same.positions[v][axis] - mesh.positions[v][axis]), 5e-11 * std::abs(mesh.positions[v][axis]));
    }
    EXPECT_NE(write_mesh(cube(), MeshFormat::kBdf).find("GRID*   1                               0."), std::string::npos);
}

constexpr const char* kInpNodes = "*NODE\n1, 0, 0, 0\n2, 1, 0\n3, 0, 1.\n7, 1, 1, 0\n";

TEST(SolverFormatsTest, InputDecksInTheirManyLayouts) {
    const std::string nodes = kInpNodes;
    const TriangleMesh two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    for (const std::string& text : {"*HEADING\nany text, 1\n" + nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n2, 2, 7, 3\n",
                                    "** comment\n*Element, type = s3r\n1, 1, 2, 3,\n2, 2, 7, 3\n" + nodes,
                                    nodes + "*ELEMENT,TYPE=CPS3\n1,\n1, 2,\n3\n2, 2, 7, 3\n",
                                    nodes + "*ELEMENT, TYPE=C3D4\n9, 1, 2, 3, 7\n*ELEMENT, TYPE=M3D3\n1, 1, 2, 3\n2, 2, 7, "
                                            "3\n*MATERIAL, NAME=x\n*ELASTIC\n1, 2\n",
                                    nodes + "*ELEMENT, TYPE=S6\n1, 1, 2, 3, 91, 92, 93\n2, 2, 7, 3, 94, 95, 96\n"}) {
        const TriangleMesh mesh = must_read(text);
        EXPECT_EQ(mesh, two) << text;
    }
    EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=S4\n1, 1, 2, 7, 3\n").faces, (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}}));
}

TEST(SolverFormatsTest, SetsOfInputDecks) {
    const std::string elements =
        std::string(kInpNodes) + "*ELEMENT, TYPE=S3, ELSET=a\n5, 1, 2, 3\n*ELEMENT, TYPE=S3\n6, 2, 7, 3\n";
    using Sets = std::map<std::string, std::vector<std::uint32_t>>;
    EXPECT_EQ(members(must_read(elements)), (Sets{{"a", {0}}}));
    EXPECT_EQ(members(must_read(elements + "*ELSET, ELSET=b, GENERATE\n1, 100, 5\n*ELSET, ELSET=c\nA, 6\n")),
              (Sets{{"a", {0}}, {"b", {1}}, {"c", {0, 1}}}));
    EXPECT_EQ(members(must_read(elements + "*SURFACE, NAME=s, TYPE=ELEMENT\na, SPOS\n6, S1\n")),
              (Sets{{"a", {0}}, {"s", {0, 1}}}));
    EXPECT_EQ(members(must_read(elements + "*ELSET, ELSET=x\ny\n*ELSET, ELSET=y\nx, 6\n")),
              (Sets{{"a", {0}}, {"x", {1}}, {"y", {1}}}));
}

TEST(SolverFormatsTest, SetsOfInputDecksHoldWhatIsDefined) {
    const std::string deck =
        std::string(kInpNodes) +
        "*ELEMENT, TYPE=S3, ELSET=a\n5, 1, 2, 3\n*ELEMENT, TYPE=B31\n7, 1, 2\n*ELEMENT, TYPE=C3D4\n9, 1, 2, 3, 7\n";
    for (const char* fault : {"*ELSET, ELSET=b\n5, 6\n", "*SURFACE, NAME=b, TYPE=ELEMENT\n6, S1\n"}) {
        const Expected<ReadResult> result = read(deck + fault);
        ASSERT_FALSE(result) << fault;
        EXPECT_EQ(result.error().cause, Cause::kIndexOutOfRange);
        EXPECT_EQ(result.error().message, "line 13: set 'b' names element 6, which the file does not define");
    }
    const Expected<ReadResult> range = read(deck + "*ELSET, ELSET=b, GENERATE\n10, 90\n");
    ASSERT_FALSE(range);
    EXPECT_EQ(range.error().message, "line 13: set 'b' names elements 10 to 90, of which the file defines none");
    // Elements without a face are there, and a set of them alone is told of.
    const Expected<ReadResult> set =
        read(deck + "*ELSET, ELSET=b\n5, 7, 9\n*ELSET, ELSET=c\n7, 9\n*ELSET, ELSET=d, GENERATE\n1, 99\n");
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_EQ(set->mesh.sets.size(), 3U);
    EXPECT_EQ(set->weld.unused_sets, std::vector<std::string>{"c"});
    const MeshReport report = inspect(set->mesh, set->weld);
    EXPECT_NE(std::find_if(report.findings.begin(), report.findings.end(),
                           [](const Finding& f) {
                               return f.kind == Finding::Kind::kUnusedSet && f.message.find("'c'") != std::string::npos;
                           }),
              report.findings.end());
}

TEST(SolverFormatsTest, NamesThatNoFaceHasAreTold) {
    const Expected<ReadResult> bulk = read(
        std::string("$HMNAME COMP 3\"flange\"\n$HMNAME COMP 4\"gone\"\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
                    "CTRIA3,2,3,1,2,3\n"));
    ASSERT_TRUE(bulk);
    EXPECT_EQ(bulk->weld.unused_sets, std::vector<std::string>{"gone"});
    EXPECT_EQ(bulk->mesh.sets.size(), 1U);
    const Expected<ReadResult> gmsh =
        read(std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"skin\"\n2 9 "
                         "\"gone\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n"
                         "2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n"));
    ASSERT_TRUE(gmsh) << gmsh.error().message;
    EXPECT_EQ(gmsh->weld.unused_sets, std::vector<std::string>{"gone"});
}

TEST(SolverFormatsTest, ElementsOfGmshLieOnSurfacesThatThereAre) {
    std::string text = write_mesh(cube(), MeshFormat::kMshAscii);
    const std::size_t block = text.find("\n2 1 2 12 ");
    ASSERT_NE(block, std::string::npos);
    text.replace(block, 5, "\n2 9 ");
    const Expected<ReadResult> result = read(text);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().cause, Cause::kIndexOutOfRange);
    EXPECT_NE(result.error().message.find(": elements are on surface 9, which $Entities does not define"), std::string::npos)
        << result.error().message;
}

TEST(SolverFormatsTest, NumbersOfInputDecksMayBeFortrans) {
    const TriangleMesh mesh =
        must_read("*NODE\n1, 0.D0, 0.d0, 0\n2, 1.D+00, 0, -2.5d-1\n3, 0, 1.5-1, 1E3\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n");
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, -0.25}, {0, 0.15, 1000}}));
    const Expected<ReadResult> word = read(std::string("*NODE\n1, 0.D0x, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1, 1\n"));
    ASSERT_FALSE(word);
    EXPECT_EQ(word.error().message, "line 2: expected a coordinate, found '0.D0x'");
}

TEST(SolverFormatsTest, BulkDataInSmallLargeAndFreeFields) {
    const TriangleMesh one{{{0, 0, 0}, {1.5, 0, 0}, {0, 0.025, -300}}, {{0, 1, 2}}};
    for (const std::string& text :
         {std::string(
              "BEGIN BULK\nGRID           1              0.      0.      0.\nGRID           2             1.5      0.      0.\n"
              "GRID           3              0.   2.5-2   -3.+2\nCTRIA3         4       1       1       2       3\nENDDATA\n"),
          std::string("GRID*                  1                              0.              0.*G1\n*G1                   0.\n"
                      "GRID*                  2                         1.5D+00              0.*G2\n*G2                   0.\n"
                      "GRID*                  3                              0.          .025E0*G3\n*G3              -3.D2\n"
                      "CTRIA3*                4               1               1               2\n*                      3\n"),
          std::string("$ free\nGRID,1,,0.,0.,0.\nGRID,2,0,1.5,,\nGRID,3,,0.,2.5e-2,-300.\nCTRIA6,4,1,1,2,3,11,12,+\n+,13\n"
                      "CHEXA,9,1,1,2,3,4,5,6,+\n+,7,8\n")}) {
        EXPECT_EQ(must_read(text), one) << text;
    }
    const TriangleMesh named = must_read(
        "$HMNAME COMP                   3\"flange\"\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,1.,1.,0.\n"
        "CQUAD4,1,3,1,2,4,3\nCTRIA3,2,8,1,2,3\n");
    EXPECT_EQ(named.regions, (std::vector<std::uint32_t>{3, 3, 8}));
    EXPECT_EQ(named.sets, (std::vector<FaceSet>{{"flange", {3}}}));
}

TEST(SolverFormatsTest, InputDecksOfEveryFamilyOfFaces) {
    const std::string nodes = kInpNodes;
    for (const char* type : {"S3", "S3RS", "STRI3", "DS3", "M3D3", "SFM3D3", "R3D3", "CPS3", "CPE3H", "CPEG3", "CAX3", "CGAX3H",
                             "DC2D3", "DCAX3", "AC2D3", "US3", "WARP2D3"}) {
        EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=" + type + "\n1, 1, 2, 3\n").faces.size(), 1U) << type;
    }
    for (const char* type : {"S4", "S4R5", "S4RSW", "M3D4R", "SFM3D4", "R3D4", "CPS4R", "CPE4RH", "CAX4", "DS4", "DC2D4E"}) {
        EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=" + type + "\n1, 1, 2, 7, 3\n").faces.size(), 2U) << type;
    }
    for (const char* type : {"S6", "STRI65", "M3D6", "CPE6M", "CAX6"}) {
        EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=" + type + "\n1, 1, 2, 3, 4, 5, 6\n").faces.size(), 1U) << type;
    }
    for (const char* type : {"S8R", "S8R5", "M3D8", "CPS8R", "CAX8"}) {
        EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=" + type + "\n1, 1, 2, 7, 3, 4, 5, 6, 8\n").faces.size(), 2U) << type;
    }
    for (const char* type : {"S9R5", "M3D9R"}) {
        EXPECT_EQ(must_read(nodes + "*ELEMENT, TYPE=" + type + "\n1, 1, 2, 7, 3, 4, 5, 6, 8, 9\n").faces.size(), 2U) << type;
    }
}

TEST(SolverFormatsTest, InputDecksPassOverElementsThatHaveNoFace) {
    const std::string face = std::string(kInpNodes) + "*ELEMENT, TYPE=S3, ELSET=a\n1, 1, 2, 3\n";
    for (const char* element : {"B31\n2, 1, 2", "T3D2\n2, 1, 2", "SPRINGA\n2, 1, 2", "MASS\n2, 1", "CONN3D2\n2, 1, 2",
                                "DCOUP3D\n2, 1", "SC6R\n2, 1, 2, 3, 4, 5, 6", "CSS8\n2, 1, 2, 3, 4, 5, 6, 7, 8",
                                "C3D20R\n2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n16, 17, 18, 19, 20",
                                "C3D15V\n2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n16", "D\n2, 1, 2, 3",
                                "SAX1\n2, 1, 2", "RB3D2\n2, 1, 2"}) {
        const TriangleMesh mesh = must_read(face + "*ELEMENT, ELSET=b, TYPE=" + element + "\n*ELSET, ELSET=both\na, b\n");
        EXPECT_EQ(mesh.faces.size(), 1U) << element;
        EXPECT_EQ(members(mesh)["both"], (std::vector<std::uint32_t>{0})) << element;
    }
}

TEST(SolverFormatsTest, KeywordsMayGoOnOverLines) {
    const std::string nodes = kInpNodes;
    using Sets = std::map<std::string, std::vector<std::uint32_t>>;
    EXPECT_EQ(members(must_read(nodes + "*ELEMENT, TYPE=S3,\n** between\n  ELSET=a\n1, 1, 2, 3\n")), (Sets{{"a", {0}}}));
    EXPECT_EQ(members(must_read(nodes + "*ELEMENT, TYPE=S3, ELSET=a,\n1, 1, 2, 3\n")), (Sets{{"a", {0}}}));
    EXPECT_EQ(must_read("*NODE,\n1, 0, 0, 0\n2, 1, 0\n3, 0, 1.\n*Element,\ntype=S3\n1, 1, 2, 3\n*End Step\n").faces.size(), 1U);
    std::string old = nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n";
    std::replace(old.begin(), old.end(), '\n', '\r');
    EXPECT_EQ(must_read(old).faces.size(), 1U);
}

/// A square of two faces in a set, and what places it.
std::string assembly_of(const std::string& instances, const std::string& rest = "") {
    return "*PART, NAME=P\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT, TYPE=S4, ELSET=skin\n1,1,2,3,4\n*END PART\n"
           "*ASSEMBLY, NAME=A\n" +
           instances + rest + "*END ASSEMBLY\n";
}

TEST(SolverFormatsTest, AnInstanceIsItsPartMoved) {
    const TriangleMesh two =
        must_read(assembly_of("*INSTANCE, NAME=I, PART=p\n10.,0.,0.\n*END INSTANCE\n"
                              "*INSTANCE, NAME=J, PART=P\n20.,,\n*END INSTANCE\n"));
    ASSERT_EQ(two.faces.size(), 4U);
    EXPECT_EQ(
        two.positions,
        (std::vector<Vec3>{{10, 0, 0}, {11, 0, 0}, {11, 1, 0}, {10, 1, 0}, {20, 0, 0}, {21, 0, 0}, {21, 1, 0}, {20, 1, 0}}));
    EXPECT_EQ(two.faces[2], (Triangle{4, 5, 6}));
    // Moved by (0, 0, 1), then turned by 90 degrees about the line x = 2, y = 0.
    const TriangleMesh turned = must_read(assembly_of("*INSTANCE, NAME=I, PART=P\n0,0,1\n2,0,0, 2,0,5, 90\n*END INSTANCE\n"));
    const std::vector<Vec3> expected{{2, -2, 1}, {2, -1, 1}, {1, -1, 1}, {1, -2, 1}};
    ASSERT_EQ(turned.positions.size(), expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v) EXPECT_LT((turned.positions[v] - expected[v]).norm(), 1e-15);
    EXPECT_EQ(
        must_read("*PART, NAME=P\n*END PART\n*ASSEMBLY\n*INSTANCE, NAME=I, PART=P\n0,0,3\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n"
                  "*ELEMENT, TYPE=S3\n1,1,2,3\n*END INSTANCE\n*END ASSEMBLY\n")
            .positions[0],
        Vec3(0, 0, 3))
        << "a mesh within the instance moves with it";
}

TEST(SolverFormatsTest, AssembliesNameSetsOfInstances) {
    using Sets = std::map<std::string, std::vector<std::uint32_t>>;
    const std::string one = "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n";
    const std::string two = one + "*INSTANCE, NAME=J, PART=P\n5,0,0\n*END INSTANCE\n";
    EXPECT_EQ(members(must_read(assembly_of(one, "*NODE\n1, 9, 9, 9\n*NSET, NSET=rp\n1\n"))), (Sets{{"skin", {0, 1}}}))
        << "a reference point may have a number of the part's";
    EXPECT_EQ(members(must_read(assembly_of(one, "*SURFACE, NAME=s, TYPE=ELEMENT\nI.skin, SPOS\n"))),
              (Sets{{"skin", {0, 1}}, {"s", {0, 1}}}));
    EXPECT_EQ(members(must_read(assembly_of(two, "*ELSET, ELSET=skin, INSTANCE=J\n1\n*ELSET, ELSET=all\nI.1, skin\n"))),
              (Sets{{"I.skin", {0, 1}}, {"J.skin", {2, 3}}, {"skin", {2, 3}}, {"all", {0, 1, 2, 3}}}));
    EXPECT_EQ(members(must_read(assembly_of(one, "*ELSET, ELSET=skin, INSTANCE=I, GENERATE\n1, 1\n"))),
              (Sets{{"I.skin", {0, 1}}, {"skin", {0, 1}}}))
        << "a set of the assembly is not the part's of that name";
    EXPECT_EQ(members(must_read(assembly_of(one, "*SURFACE, NAME=t\nI.skin, SPOS\n*SURFACE, NAME=u, COMBINE=UNION\nt\n"))),
              (Sets{{"skin", {0, 1}}, {"t", {0, 1}}, {"u", {0, 1}}}));
}

TEST(SolverFormatsTest, InstancesAreBounded) {
    std::string text = "*PART, NAME=P\n*NODE\n";
    for (int n = 1; n < 1000; ++n) text += std::to_string(n) + ", 0, 0, 0\n";
    text += "*END PART\n";
    for (int i = 0; i < 20'000; ++i) text += "*INSTANCE, NAME=I" + std::to_string(i) + ", PART=P\n";
    const Expected<ReadResult> result = read(text, {.format = {}, .weld = 0, .max_faces = 10'000});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().cause, Cause::kLimitExceeded) << result.error().message;
    text.replace(text.find("*NODE"), 5, "*HEAT");
    const Expected<ReadResult> no_nodes = read(text, {.format = {}, .weld = 0, .max_faces = 10'000});
    ASSERT_FALSE(no_nodes);
    EXPECT_NE(no_nodes.error().message.find("line 1: the instances of the file's parts come to more text and sets"),
              std::string::npos)
        << no_nodes.error().message;
    text.replace(text.find("*HEAT"), 5, "*ELSET, ELSET=s");
    const Expected<ReadResult> sets = read(text, {.format = {}, .weld = 0, .max_faces = 10'000});
    ASSERT_FALSE(sets);
    EXPECT_EQ(sets.error().cause, Cause::kLimitExceeded) << sets.error().message;
}

TEST(SolverFormatsTest, BulkDataOfEveryCardWithAFace) {
    const std::string grids = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,1.,1.,0.\n";
    for (const char* card :
         {"CTRIA3", "CTRIA6", "CTRIAR", "CTRIAX", "CTRAX3", "CTRAX6", "CPLSTN3", "CPLSTN6", "CPLSTS3", "CPLSTS6"})
        EXPECT_EQ(must_read(grids + card + ",7,1,1,2,3\n").faces, (std::vector<Triangle>{{0, 1, 2}})) << card;
    for (const char* card : {"CQUAD4", "CQUAD8", "CQUADR", "CQUAD", "CSHEAR", "CQUADX", "CQUADX4", "CQUADX8", "CPLSTN4",
                             "CPLSTN8", "CPLSTS4", "CPLSTS8"})
        EXPECT_EQ(must_read(grids + card + ",7,1,1,2,4,3\n").faces.size(), 2U) << card;
    EXPECT_EQ(must_read(grids + "CTRIAX6,7,1,1,91,2,92,3,93\n").faces, (std::vector<Triangle>{{0, 1, 2}}))
        << "corners and middles in turn";
    EXPECT_EQ(must_read("SOL 101\nCEND\nCMETHOD = 3\nBEGIN BULK\n" + grids +
                        "CTRIA3,7,1,1,2,3\nCBAR,8,1,1,2,,,1.\nCONM2,9,1,,1.\nCORD2R,1,,0.,0.,0.,0.,0.,1.\n+,1.,0.,0.\nCELAS2,3,1."
                        ",1,1\nENDDATA\n")
                  .faces.size(),
              1U);
}

TEST(SolverFormatsTest, BulkDataWithTabsMarksBlanksAndLeftOutFields) {
    const TriangleMesh one{{{0, 5, 0}, {1, 0, 5}, {0, 1, 5}}, {{0, 1, 2}}};
    for (const std::string& text :
         {std::string("GRID*,1,,0.,5.\n*,\nGRID*,2,,1.\n*,5.\nGRID*,3,,0.,1.,*A\n*A,5.\nCTRIA3*,1,1,1,2,*B\n*B,3\n"),
          std::string("GRID\t1\t\t0.\t5.\nGRID\t2\t0\t1.\t\t5.\nGRID\t3\t\t\t1.\t5.\nCTRIA3\t1\t1\t1\t2\t3\n"),
          std::string(
              "  GRID,1,,0.,5.\n GRID    2               1.              5.\n\tGRID,\t3,\t,0.,1.,5.\n   CTRIA3,1,1,1,2,3\n")}) {
        EXPECT_EQ(must_read(text), one) << text;
    }
    EXPECT_EQ(must_read("GRDSET,,3,,,,,123456\nGRID,1,0,0.,5.\nGRID,2,0,1.,,5.\nGRID,3,0,,1.,5.\nCTRIA3,1,1,1,2,3\n"), one)
        << "a default that no point takes";
}

TEST(SolverFormatsTest, GmshFilesWithMoreThanTriangles) {
    const std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 5 \"edge\"\n2 7 \"face of it\"\n$EndPhysicalNames\n"
        "$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 1 1 0\n40 0 1 0\n$EndNodes\n$Elements\n4\n1 15 2 0 1 10\n2 1 2 5 1 10 20\n"
        "3 3 2 7 1 10 20 30 40\n4 2 3 0 1 0 10 20 30\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";
    const TriangleMesh mesh = must_read(text);
    EXPECT_EQ(mesh.faces, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
    EXPECT_EQ(mesh.regions, (std::vector<std::uint32_t>{7, 7, 0}));
    EXPECT_EQ(mesh.sets, (std::vector<FaceSet>{{"face of it", {7}}}));
}

TEST(SolverFormatsTest, VtkFilesInTheirManyLayouts) {
    const TriangleMesh two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    const std::string points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n";
    const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
    const std::string poly = head + "POLYDATA\n" + points;
    const std::string grid = head + "UNSTRUCTURED_GRID\n" + points;
    for (const std::string& text :
         {poly + "POLYGONS 2 8\n3 0 1 2\n3 1 3 2\n",
          poly +
              "VERTICES 1 2\n1 0\nPOLYGONS 2 8\n3 0 1 2 3 1 3 2\nPOINT_DATA 4\nSCALARS a float\nLOOKUP_TABLE default\n1 2 3 4\n",
          grid + "CELLS 3 11\n2 0 1\n3 0 1 2\n3 1 3 2\nCELL_TYPES 3\n3 5 5\n",
          grid + "METADATA\nINFORMATION 0\n\nCELLS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 1 3 "
                 "2\nCELL_TYPES 2\n5\n5\n"}) {
        EXPECT_EQ(must_read(text), two) << text;
    }
    EXPECT_EQ(must_read(poly + "VERTICES 1 2\n1 0\nPOLYGONS 2 8\n3 0 1 2\n3 1 3 2\nCELL_DATA 3\n"
                               "FIELD f 2\nother 2 3 float\n1 2 3 4 5 6\nPhysicalIds 1 3 int\n9 4 5\n")
                  .regions,
              (std::vector<std::uint32_t>{4, 5}));
    const std::string vtu =
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" "
        "NumberOfCells=\"2\">\n<PointData>\n<DataArray type=\"Float32\" Name=\"n\" format=\"ascii\">1 2 3 "
        "4</DataArray></PointData>"
        "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 "
        "0</DataArray></Points>"
        "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2\n1 3 2</DataArray>"
        "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray>"
        "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
    EXPECT_EQ(must_read(vtu), two);
    // Base64 of a length of 2 bytes and the bytes 5 5.
    std::string base64 = vtu;
    base64.replace(base64.find("format=\"ascii\">5 5"), 18, "format=\"binary\">AgAAAAUF");
    EXPECT_EQ(must_read(base64), two);
}

struct Broken {
    std::string text;
    Cause cause;
    std::string says;
};

TEST(SolverFormatsTest, BrokenFilesAreErrorsThatSayWhere) {
    const std::string nodes = kInpNodes;
    const std::string grids = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n";
    const std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
    const std::string vtk =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
    const std::vector<Broken> all{
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 99\n", Cause::kIndexOutOfRange, "line 7: element 1 names node 99"},
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, 2\n*END\n", Cause::kMalformedInput,
         "line 7: element 1 of type 'S3' ends after 2 nodes"},
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3, 7\n", Cause::kMalformedInput, "line 7: element 1 of type 'S3' has 4 nodes"},
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, two, 3\n", Cause::kMalformedInput, "line 7: expected a node's number, found 'two'"},
        {nodes + "*ELEMENT\n1, 1, 2, 3\n", Cause::kMalformedInput, "line 6: *ELEMENT needs a TYPE"},
        {nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 7\n", Cause::kUnsupported, "1 solid elements and no triangle"},
        {"*NODE\n1, 0, x, 0\n", Cause::kMalformedInput, "line 2: expected a coordinate, found 'x'"},
        {"*NODE\n1, 0, nan, 0\n", Cause::kInvalidCoordinate, "line 2"},
        {nodes + "*NODE\n2, 5, 5, 5\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n", Cause::kMalformedInput,
         "line 7: node 2 is defined a second"},
        {nodes + "*INCLUDE, INPUT=x\n", Cause::kUnsupported, "line 6: *INCLUDE"},
        {nodes + "*PART, NAME=a\n*END PART\n*PART, NAME=b\n*END PART\n", Cause::kUnsupported,
         "line 8: the file has 2 parts, and no *INSTANCE"},
        {nodes + "*PART, NAME=a\n*END PART\n*PART, NAME=A\n*END PART\n", Cause::kMalformedInput,
         "line 8: part 'A' is there a second time"},
        {nodes + "*PART, NAME=a\n*NODE\n", Cause::kTruncatedInput, "the file ends before the *END PART of part 'a'"},
        {nodes + "*PART, NAME=a\n*PART, NAME=b\n", Cause::kMalformedInput, "line 7: *PART within part 'a'"},
        {nodes + "*INSTANCE, NAME=i, PART=a\n", Cause::kMalformedInput,
         "line 6: *INSTANCE is of part 'a', which does not come before"},
        {nodes + "*INSTANCE, LIBRARY=job, INSTANCE=i\n", Cause::kUnsupported, "line 6: *INSTANCE: the parameter 'LIBRARY'"},
        {assembly_of("*INSTANCE, NAME=I, PART=P\n*INSTANCE, NAME=i, PART=P\n"), Cause::kMalformedInput,
         "line 12: instance 'i' is there a second time"},
        {assembly_of("*INSTANCE, NAME=I, PART=P\n0, 0, x\n"), Cause::kMalformedInput,
         "line 12: expected a coordinate, found 'x'"},
        {assembly_of("*INSTANCE, NAME=I, PART=P\n\n0,0,0, 0,0,1, 90\n"), Cause::kMalformedInput, "line 13: expected 3 numbers"},
        {assembly_of("*INSTANCE, NAME=I, PART=P\n0,0,0\n0,0,1, 0,0,1, 90\n"), Cause::kMalformedInput,
         "line 13: the axis of the rotation"},
        {assembly_of("*INSTANCE, NAME=I, PART=P\n*INSTANCE, NAME=J, PART=P\n*ELEMENT, TYPE=S3\n8, 1, 2, 99\n"),
         Cause::kIndexOutOfRange, "line 14: element J.8 names node J.99, which"},
        {assembly_of("", "*ELSET, ELSET=s, INSTANCE=K\n1\n"), Cause::kMalformedInput, "line 11: set 's' is of instance 'K'"},
        {nodes + "*ELEMENT, TYPE=U1\n1, 1, 2, 3\n", Cause::kUnsupported, "line 6: elements of type 'U1' are not known"},
        {nodes + "*ELEMENT, TYPE=F3D4\n1, 1, 2, 3, 7\n", Cause::kUnsupported, "line 6: elements of type 'F3D4' are not known"},
        {nodes + "*ELEMENT, TYPE=B31\n1, 1, 2\n", Cause::kUnsupported,
         "line 6: the file has elements of type 'B31', but no triangle"},
        {nodes + "*ELEMNT, TYPE=S3\n1, 1, 2, 3\n", Cause::kUnsupported, "line 6: '*ELEMNT' is not known"},
        {"*NODES\n1, 0, 0, 0\n", Cause::kUnsupported, "line 1: '*NODES' is not known"},
        {nodes + "*ELGEN\n1, 1\n", Cause::kUnsupported, "line 6: *ELGEN makes or moves nodes or elements"},
        {nodes + "*NCOPY, CHANGE NUMBER=5\n", Cause::kUnsupported, "line 6: *NCOPY makes or moves"},
        {nodes + "*NGEN\n1, 2\n", Cause::kUnsupported, "line 6: *NGEN makes or moves"},
        {nodes + "*ELSET, ELSET=a,\nb, c\n", Cause::kUnsupported, "line 6: *ELSET: the parameter 'B' is not read"},
        {nodes + "*ELEMENT, TYPE=S3, OFFSET=100\n1, 1, 2, 3\n", Cause::kUnsupported,
         "line 6: *ELEMENT: the parameter 'OFFSET' is not read; accepted are TYPE, ELSET, SOLIDELEMENTNUMBERING"},
        {"*NODE, SYSTEM=C\n1, 1, 0, 0\n", Cause::kUnsupported, "line 1: *NODE, SYSTEM=C is not read"},
        {"*NODE, INPUT=nodes.txt\n", Cause::kUnsupported, "line 1: *NODE: the parameter 'INPUT' is not read"},
        {nodes + "*SURFACE, NAME=s, COMBINE=DIFFERENCE\na, b\n", Cause::kUnsupported, "line 6: *SURFACE, COMBINE=DIFFERENCE"},
        {nodes + "*ELSET, ELSET=s, GENERATE\n11, 1, 2\n", Cause::kMalformedInput,
         "line 7: expected a last element from the first, 11, on, found 1"},
        {grids + "CFOO,1,1,1,2,3\n", Cause::kUnsupported, "line 4: CFOO: a card of this name is not known"},
        {"GRDSET,,2\n" + grids + "CTRIA3,1,1,1,2,3\n", Cause::kUnsupported,
         "line 1: GRDSET: grid points are given in coordinate system '2'"},
        {grids + "GRID*,4,,0.,1.\nCTRIA3,1,1,1,2,3\n", Cause::kTruncatedInput,
         "line 4: GRID: field 6 is on a line more, which does not follow"},
        {grids + "CTRIA3*,1,1,1,2\n", Cause::kTruncatedInput, "line 4: CTRIA3: field 6 is on a line more"},
        {"BEGIN BULK\n" + grids + "BEGIN SUPER=1\n", Cause::kUnsupported, "line 5: BEGIN SU: superelements"},
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n*ELSET, ELSET=s\nnone\n", Cause::kMalformedInput,
         "line 9: set 's' names the set 'none'"},
        {nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n*ELSET\n1\n", Cause::kMalformedInput, "line 8: a set needs a name"},
        {nodes + "*ELSET, ELSET=s, GENERATE\n1, 2, 0\n", Cause::kMalformedInput, "line 7: expected a step"},
        {nodes, Cause::kEmptyInput, "no face"},
        {grids + "CTRIA3,1,1,1,2,9\n", Cause::kIndexOutOfRange, "line 4: element 1 names node 9"},
        {grids + "CTRIA3,1,1,1,2\n", Cause::kMalformedInput, "line 4: CTRIA3: expected a grid point's number in field 6"},
        {grids + "CTRIA3,x,1,1,2,3\n", Cause::kMalformedInput,
         "line 4: CTRIA3: expected an element's number in field 2, found 'x'"},
        {"GRID,1,,zero,0.,0.\n", Cause::kMalformedInput, ""},
        {"GRID,1,4,0.,0.,0.\nCTRIA3,1,1,1,1,1\n", Cause::kUnsupported,
         "line 1: GRID: grid point 1 is given in coordinate system '4'"},
        {grids + "CTETRA,1,1,1,2,3,4\n", Cause::kUnsupported, "1 solid elements"},
        {"$MeshFormat\n3 0 8\n$EndMeshFormat\n", Cause::kUnsupported, "line 2: version 3 is not read"},
        {"$MeshFormat\n2.2 0 8\n$EndMesh\n", Cause::kMalformedInput, "line 3: expected '$EndMeshFormat', found '$EndMesh'"},
        {msh + "$Elements\n1\n1 2 2 0 0 1 2 9\n$EndElements\n", Cause::kIndexOutOfRange, "line 12: element 1 names node 9"},
        {msh + "$Elements\n1\n1 77 2 0 0 1 2 3\n$EndElements\n", Cause::kUnsupported, "line 12: elements of type 77"},
        {msh + "$Elements\n2\n1 2 2 0 0 1 2 3\n$EndElements\n", Cause::kMalformedInput,
         "line 13: expected an element's number, found '$EndElements'"},
        {msh + "$Elements\n1\n1 2 2 0 0 1 2", Cause::kTruncatedInput, "line 12: the file ends where a node of an element"},
        {msh + "$Unknown\n1 2 3\n", Cause::kTruncatedInput, "the file ends before '$EndUnknown'"},
        {msh + "Elements\n", Cause::kMalformedInput, "line 10: expected the name of a section, found 'Elements'"},
        {vtk + "CELLS 1 4\n3 0 1 5\nCELL_TYPES 1\n5\n", Cause::kIndexOutOfRange,
         "line 8: cell 0 names point 5; there are 0 to 2"},
        {vtk + "CELLS 1 4\n4 0 1 2\nCELL_TYPES 1\n5\n", Cause::kMalformedInput,
         "line 8: cell 0 is to have 4 points, but 3 numbers follow"},
        {vtk + "CELLS 2 4\n3 0 1 2\nCELL_TYPES 1\n5\n", Cause::kMalformedInput,
         "line 8: 2 cells are announced, but the numbers make 1"},
        {vtk + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n99\n", Cause::kUnsupported, "line 10: cell 0 is of type 99"},
        {vtk + "CELLS 1 4\n3 0 1 2\n", Cause::kTruncatedInput, "the file ends before CELL_TYPES"},
        {vtk + "CELLS 1 5\n4 0 1 2 2\nCELL_TYPES 1\n10\n", Cause::kUnsupported, "1 solid elements"},
        {vtk + "CELLS 1 4\n3 0 one 2\n", Cause::kMalformedInput, "line 8: expected a point of a cell, found 'one'"},
        {"# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n", Cause::kUnsupported,
         "line 4: a dataset of 'STRUCTURED_POINTS'"},
        {"<VTKFile type=\"PolyData\">\n", Cause::kUnsupported, "line 1: a file of type 'PolyData'"},
        {"<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">", Cause::kUnsupported,
         "'vtkLZ4DataCompressor' is not read"},
        {"<VTKFile type=\"UnstructuredGrid\">\n<Piece", Cause::kTruncatedInput, "line 2: the file ends within the tag 'Piece'"},
        {"<VTKFile type=\"UnstructuredGrid\">\n<Points>\n</Points></VTKFile>", Cause::kMalformedInput, "the file has no Points"},
    };
    for (const auto& [text, cause, says] : all) {
        const Expected<ReadResult> result = read(text);
        ASSERT_FALSE(result) << text;
        EXPECT_EQ(cause_name(result.error().cause), cause_name(cause)) << text << result.error().message;
        EXPECT_NE(result.error().message.find(says), std::string::npos) << text << "\n" << result.error().message;
    }
}

TEST(SolverFormatsTest, AFileThatIsCutOffIsNeverTakenForAWhole) {
    const TriangleMesh mesh = grouped_torus();
    for (const MeshFormat format : {MeshFormat::kMsh, MeshFormat::kMshAscii, MeshFormat::kMsh2, MeshFormat::kMsh2Ascii,
                                    MeshFormat::kVtu, MeshFormat::kVtk}) {
        const std::string bytes = write_mesh(mesh, format);
        // Behind the faces come only regions (VTK), whose absence nothing announces, and ends of tags.
        const std::size_t whole = format == MeshFormat::kVtk ? bytes.find("CELL_DATA") : bytes.size() - 40;
        for (std::size_t size = 60; size < whole; size += 97) {
            EXPECT_FALSE(read(bytes.substr(0, size))) << format_name(format) << " at " << size << " of " << bytes.size();
        }
    }
}

TEST(SolverFormatsTest, NoDamageDoesMoreThanAnError) {
    const TriangleMesh mesh = grouped_torus();
    Random random(11);
    for (const MeshFormat format : mesh_formats()) {
        const std::string good = write_mesh(mesh, format);
        for (int trial = 0; trial < 200; ++trial) {
            std::string bad = good;
            for (int i = 0; i < 3; ++i) {
                const std::size_t at = random.below(static_cast<std::uint32_t>(trial % 2 == 0 ? bad.size() : 400));
                bad[at] = static_cast<char>(random.below(256));
            }
            const Expected<ReadResult> result = read(bad, {.format = {}, .weld = 0, .max_faces = 100'000});
            if (!result) {
                EXPECT_FALSE(result.error().message.empty());
                continue;
            }
            for (const Triangle& face : result->mesh.faces) {
                for (const std::uint32_t v : face) EXPECT_LT(v, result->mesh.vertex_count());
            }
        }
    }
}

}  // namespace
}  // namespace vsplit::test
