#include <fcntl.h>
#include <google/protobuf/struct.pb.h>
#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is POSIX
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): pseudo-terminals are POSIX
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "cli/file_hash.h"
#include "tests/client/command.h"
#include "tests/core/drilled_plate.h"
#include "tests/core/meshes.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mesh/inspect.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/json.h"

namespace vsplit::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using test::Command;
using test::CommandResult;

class CommandLineTest : public testing::Test {
protected:
    [[nodiscard]] std::string file(const std::string& name) const { return (directory_.path() / name).string(); }

    /// A mesh of this name, written in the format of its extension.
    std::string mesh_file(const std::string& name, const TriangleMesh& mesh) {
        std::string path = file(name);
        EXPECT_TRUE(write_mesh_file(mesh, *format_by_extension(name), path));
        return path;
    }

    static std::vector<std::string> words(std::initializer_list<std::string> arguments) {
        std::vector<std::string> all{VSPLIT_BINARY};
        all.insert(all.end(), arguments);
        return all;
    }

    static CommandResult run(std::initializer_list<std::string> arguments) { return test::run_command(words(arguments)); }

    /// A file made by improving a part of many flat faces.
    std::string improved_file() {
        std::string path = file("improved.vsplit");
        const CommandResult made =
            run({"improve", mesh_file("frame.off", test::cube_frame()), "--subdivide", "0.3", "--faces", "1000", "-o", path});
        EXPECT_EQ(made.exit_status, 0) << made.err;
        return path;
    }

    test::TempDirectory directory_;
};

template <class Message>
Message json_of(const CommandResult& result) {
    Message message;
    const Status read = wire::from_json(result.out, message);
    EXPECT_TRUE(read) << result.out << result.err;
    return message;
}

TEST_F(CommandLineTest, QualityAgainstTellsTheDistanceBothWays) {
    TriangleMesh inner = test::cube();
    for (Vec3& p : inner.positions) p = p * 0.5 + Vec3(0.25, 0.25, 0.25);
    const std::string one = mesh_file("inner.off", inner);
    const std::string other = mesh_file("cube.stl", test::cube());
    const CommandResult told = run({"quality", one, "--against", other});
    EXPECT_EQ(told.exit_status, 0) << told.err;
    EXPECT_NE(told.out.find("to source         0.25 to 0.25"), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("from source       0.433013 to "), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("creases lost      100.00 % of their length"), std::string::npos) << told.out;

    google::protobuf::Struct document;
    ASSERT_TRUE(wire::from_json(run({"quality", one, "--against", other, "--json"}).out, document));
    const auto& fields = document.fields();
    EXPECT_NEAR(fields.at("fromSource").struct_value().fields().at("lower").number_value(), 0.4330127, 1e-6);
    EXPECT_GE(fields.at("deviationMax").number_value(), fields.at("deviationMeasured").number_value());
    EXPECT_EQ(fields.at("creasesAgainst").number_value(), 12);

    ASSERT_TRUE(
        wire::from_json(run({"quality", mesh_file("ball.off", test::icosphere(3)), "--against", other, "--json"}).out, document));
    EXPECT_TRUE(document.fields().at("creasesFromSource").struct_value().fields().at("upper").has_null_value())
        << "there is no crease to be near to";
}

TEST_F(CommandLineTest, QualityAgainstMeasuresAsCloselyAsAsked) {
    const std::string ball = mesh_file("ball.ply", test::bumpy_sphere(3, 0.1, 1));
    const std::string coarse = mesh_file("coarse.ply", test::bumpy_sphere(2, 0.1, 2));
    const auto gap = [&](const std::string& error) {
        google::protobuf::Struct document;
        EXPECT_TRUE(wire::from_json(run({"quality", coarse, "--against", ball, "--error", error, "--json"}).out, document));
        return document.fields().at("deviationMax").number_value() - document.fields().at("deviationMeasured").number_value();
    };
    EXPECT_LE(gap("1e-7"), 1e-7);
    EXPECT_GT(gap("0.01"), 1e-7);
    const CommandResult none = run({"quality", coarse, "--against", ball, "--error", "0"});
    EXPECT_EQ(none.exit_status, 1);
    EXPECT_NE(none.err.find("a length above 0"), std::string::npos) << none.err;
}

TEST_F(CommandLineTest, QualityAgainstRefusesWhatItCannotCompare) {
    const std::string cube = mesh_file("cube.stl", test::cube());
    EXPECT_NE(run({"quality", cube, "--against", file("none.stl")}).err.find("none.stl"), std::string::npos);
    const CommandResult remote = run({"quality", cube, "--against", cube, "--server", "127.0.0.1:1"});
    EXPECT_EQ(remote.exit_status, 1);
    EXPECT_NE(remote.err.find("leave --server out"), std::string::npos) << remote.err;
    const CommandResult faces = run({"quality", cube, "--against", cube, "--faces", "10"});
    EXPECT_NE(faces.err.find("--faces"), std::string::npos) << faces.err;
}

TEST_F(CommandLineTest, InfoDescribesAMesh) {
    const std::string torus = mesh_file("torus.obj", test::torus(20, 10));
    const CommandResult told = run({"info", torus});
    EXPECT_EQ(told.exit_status, 0);
    EXPECT_EQ(told.err, "");
    EXPECT_NE(told.out.find("genus             1\n"), std::string::npos) << told.out;
    const auto summary = json_of<v1::MeshSummary>(run({"info", torus, "--json"}));
    EXPECT_EQ(summary.faces(), 400U);
    EXPECT_EQ(summary.vertices(), 200U);
    EXPECT_EQ(summary.genus(), 1);
    EXPECT_EQ(summary.quality().worst_faces_size(), 0);
}

TEST_F(CommandLineTest, QualityListsTheWorstFaces) {
    const std::string slivers = mesh_file("slivers.ply", test::sliver_cylinder(40, 10));
    const auto summary = json_of<v1::MeshSummary>(run({"quality", slivers, "--json"}));
    ASSERT_EQ(summary.quality().worst_faces_size(), 20);
    EXPECT_EQ(summary.quality().worst_faces(0).stretch(), summary.quality().stretch_min());
    const CommandResult told = run({"quality", slivers});
    EXPECT_NE(told.out.find("---- 0.2 --"), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("worst face"), std::string::npos) << told.out;
}

TEST_F(CommandLineTest, ImproveWritesEveryOutput) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const CommandResult result = run({"improve", input, "--subdivide", "0.3", "--faces", "1000", "--json", "-o", file("a.vsplit"),
                                      "-o", file("a.stl"), "-o", file("a.obj"), "-o", file("a.ply"), "-o", file("a.off")});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto made = json_of<v1::Representation>(result);
    EXPECT_EQ(made.method(), v1::IMPROVE);
    EXPECT_EQ(made.source().faces(), test::cube_frame().face_count());
    EXPECT_EQ(made.improve_options().subdivision_size(), 0.3);
    EXPECT_TRUE(made.improve_options().has_tolerance());  // defaults are filled in
    EXPECT_EQ(made.quality().faces(), made.faces());
    const Expected<StoredMrr> stored = load_mrr(file("a.vsplit"));
    ASSERT_TRUE(stored);
    EXPECT_EQ(stored->faces, made.faces());
    const TriangleMesh mesh = mesh_at(stored->mrr, stored->mrr.level_for(stored->faces));
    for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off"}) {
        EXPECT_EQ(test::file_content(file(name)), write_mesh(mesh, *format_by_extension(name))) << name;
    }
}

TEST_F(CommandLineTest, SaysWhatAFileHasNoRoomFor) {
    TriangleMesh mesh = test::cube_frame();
    for (Vec3& position : mesh.positions) position.x() += 1e8;
    mesh.regions.assign(mesh.faces.size(), 1);
    std::fill(mesh.regions.begin(), mesh.regions.begin() + 8, 2);
    mesh.sets = {{"skin", {1, 2}}, {"rim", {2}}, {"edge", {2}}};
    const std::string from = mesh_file("far.msh", mesh);
    const auto err_of = [&](const char* name) {
        const CommandResult made = run({"improve", from, "--subdivide", "9", "--faces", "100", "-o", file(name)});
        EXPECT_EQ(made.exit_status, 0) << made.err;
        return made.err;
    };
    EXPECT_NE(err_of("far.obj").find("far.obj: obj has no room for 2 sets: skin, edge\n"), std::string::npos);
    const std::string stl = err_of("far.stl");
    EXPECT_NE(stl.find("has no room for 3 sets: rim, skin, edge\n"), std::string::npos) << stl;
    EXPECT_NE(stl.find("rounds coordinates to 11.9"), std::string::npos) << stl;
    const std::string inp = err_of("far.inp");
    EXPECT_EQ(inp.find("no room"), std::string::npos) << inp;
    EXPECT_EQ(inp.find("rounds"), std::string::npos) << inp;
}

TEST_F(CommandLineTest, RunsAreIdentical) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    for (const char* threads : {"1", "2"}) {
        const CommandResult made =
            run({"improve", input, "--subdivide", "0.3", "--threads", threads, "-o", file(std::string(threads) + ".ply")});
        EXPECT_EQ(made.exit_status, 0) << made.err;
    }
    EXPECT_FALSE(test::file_content(file("1.ply")).empty());
    EXPECT_EQ(test::file_content(file("1.ply")), test::file_content(file("2.ply")));
}

TEST_F(CommandLineTest, ResolutionGivesTheMeshThatTheRecordsGive) {
    const std::string improved = improved_file();
    const Expected<StoredMrr> stored = load_mrr(improved);
    ASSERT_TRUE(stored);
    for (const std::uint32_t faces : {stored->mrr.faces_max(), stored->faces, stored->mrr.faces_min() + 4}) {
        const auto shown = json_of<v1::Representation>(
            run({"resolution", improved, "--faces", std::to_string(faces), "-o", file("r.ply"), "--json"}));
        EXPECT_EQ(shown.faces(), faces);
        EXPECT_EQ(shown.quality().faces(), faces);
        EXPECT_EQ(test::file_content(file("r.ply")),
                  write_mesh(mesh_at(stored->mrr, stored->mrr.level_for(faces)), MeshFormat::kPlyBinary));
    }
}

TEST_F(CommandLineTest, ResolutionOutOfRangeSaysWhichWasTaken) {
    const std::string improved = improved_file();
    const CommandResult result = run({"resolution", improved, "--faces", "100000000", "--json"});
    EXPECT_EQ(result.exit_status, 0);
    const auto shown = json_of<v1::Representation>(result);
    EXPECT_EQ(shown.faces(), shown.faces_max());
    EXPECT_NE(result.err.find("is the nearest resolution"), std::string::npos) << result.err;
}

TEST_F(CommandLineTest, MiddlesAfterImproveAndControlLieOnTheOriginalSurface) {
    const std::string ball = mesh_file("ball.off", test::icosphere(5));
    const std::string improved = file("i.vsplit"), controlled = file("c.vsplit");
    ASSERT_EQ(run({"improve", ball, "--faces", "300", "--max-deviation", "0.1", "-o", improved}).exit_status, 0);
    const CommandResult made = run({"control", improved, "--order", "2", "-o", file("c.vtk"), "--format", "vtk-ascii"});
    ASSERT_EQ(made.exit_status, 0) << made.err;
    EXPECT_EQ(made.err.find("note"), std::string::npos);
    const std::string text = test::file_content(file("c.vtk"));
    std::istringstream points(text.substr(text.find("POINTS ")));
    std::string word;
    std::size_t count = 0, middles = 0, off = 0;
    points >> word >> count >> word;
    std::vector<Vec3> all(count);
    for (Vec3& p : all) points >> p.x() >> p.y() >> p.z();
    std::istringstream cells(text.substr(text.find("CELLS ")));
    std::size_t faces = 0;
    cells >> word >> faces >> word;
    for (std::size_t f = 0, size = 0; f < faces && cells >> size; ++f) {
        for (std::size_t i = 0, node = 0; i < size && cells >> node; ++i) {
            if (i < 3) continue;
            ++middles;
            off += std::abs(all.at(node).norm() - 1) > 0.003 ? 1 : 0;
        }
    }
    EXPECT_GT(middles, 500U);
    EXPECT_EQ(off, 0U);
    // A file of the result knows the mesh that control was given alone, and says so.
    ASSERT_EQ(run({"control", improved, "-o", controlled}).exit_status, 0);
    EXPECT_NE(run({"resolution", controlled, "--order", "2", "-o", file("c.inp")}).err.find("control was given"),
              std::string::npos);
    EXPECT_EQ(run({"resolution", improved, "--order", "2", "-o", file("i.inp")}).err.find("control was given"),
              std::string::npos);
}

TEST_F(CommandLineTest, ResolutionStoresTheRepresentationAtAnother) {
    const std::string improved = improved_file();
    ASSERT_EQ(run({"resolution", improved, "--faces", "500", "-o", file("at500.vsplit")}).exit_status, 0);
    const Expected<StoredMrr> before = load_mrr(improved);
    const Expected<StoredMrr> after = load_mrr(file("at500.vsplit"));
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->mrr, after->mrr);
    EXPECT_EQ(json_of<v1::Representation>(run({"info", file("at500.vsplit"), "--json"})).faces(), after->faces);
    EXPECT_NE(before->faces, after->faces);
}

TEST_F(CommandLineTest, AFileSaysUnitSourceAndDeviation) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const CommandResult made = run({"improve", input, "--unit", "cm", "--subdivide", "0.3", "--json", "-o", file("a.vsplit")});
    ASSERT_EQ(made.exit_status, 0) << made.err;
    const Expected<StoredMrr> stored = load_mrr(file("a.vsplit"));
    ASSERT_TRUE(stored) << stored.error().message;
    EXPECT_EQ(stored->unit, LengthUnit::kCentimetre);
    ASSERT_TRUE(stored->source);
    const Expected<SourceHash> hash = hash_of_file(input);
    ASSERT_TRUE(hash);
    EXPECT_EQ(*stored->source, *hash);
    ASSERT_EQ(stored->deviations.size(), 1U);
    EXPECT_EQ(stored->deviations[0].level, stored->mrr.level_for(stored->faces));
    EXPECT_EQ(stored->deviations[0].most, json_of<v1::Representation>(made).quality().deviation_max());
    // What is known stays known at another resolution and in another encoding.
    ASSERT_EQ(
        run({"resolution", file("a.vsplit"), "--faces", "500", "--encoding", "quantised:16", "-o", file("b.vsplit")}).exit_status,
        0);
    const Expected<StoredMrr> other = load_mrr(file("b.vsplit"));
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(other->source, stored->source);
    EXPECT_EQ(other->unit, stored->unit);
    ASSERT_EQ(other->deviations.size(), 1U);
    EXPECT_EQ(other->deviations[0].level, stored->deviations[0].level);
    EXPECT_GT(other->deviations[0].most, stored->deviations[0].most);
}

TEST_F(CommandLineTest, TheHashIsThatOfSha256sum) {
    std::ofstream(file("abc"), std::ios::binary) << "abc";
    const Expected<SourceHash> hash = hash_of_file(file("abc"));
    ASSERT_TRUE(hash);
    const SourceHash expected{0xba, 0x78, 0x16, 0xbf, 0x8f, 0x01, 0xcf, 0xea, 0x41, 0x41, 0x40, 0xde, 0x5d, 0xae, 0x22, 0x23,
                              0xb0, 0x03, 0x61, 0xa3, 0x96, 0x17, 0x7a, 0x9c, 0xb4, 0x10, 0xff, 0x61, 0xf2, 0x00, 0x15, 0xad};
    EXPECT_EQ(*hash, expected);
    EXPECT_FALSE(hash_of_file(file("nothing")));
}

TEST_F(CommandLineTest, FilesAreWrittenInTheEncodingAskedFor) {
    const std::string improved = improved_file();
    const Expected<StoredMrr> exact = load_mrr(improved);
    ASSERT_TRUE(exact);
    EXPECT_EQ(exact->grid.encoding(), RecordEncoding::kFloat64);
    std::uintmax_t larger = std::filesystem::file_size(improved);
    for (const auto& [name, encoding, bits] :
         {std::tuple("float32", RecordEncoding::kFloat32, 0U), std::tuple("quantised:18", RecordEncoding::kQuantised, 18U),
          std::tuple("quantised", RecordEncoding::kQuantised, 14U)}) {
        const CommandResult result = run({"resolution", improved, "--encoding", name, "-o", file("e.vsplit")});
        ASSERT_EQ(result.exit_status, 0) << result.err;
        const Expected<StoredMrr> stored = load_mrr(file("e.vsplit"));
        ASSERT_TRUE(stored) << stored.error().message;
        EXPECT_EQ(stored->grid.encoding(), encoding);
        EXPECT_EQ(stored->grid.bits(), bits);
        EXPECT_EQ(stored->mrr, on_grid(exact->mrr, stored->grid));
        EXPECT_LT(std::filesystem::file_size(file("e.vsplit")), larger) << name;
        larger = std::filesystem::file_size(file("e.vsplit"));
    }
    // Where nothing is asked a file stays in its encoding, bit for bit.
    ASSERT_EQ(run({"resolution", file("e.vsplit"), "-o", file("f.vsplit")}).exit_status, 0);
    EXPECT_EQ(load_mrr(file("f.vsplit"))->grid, load_mrr(file("e.vsplit"))->grid);
}

TEST_F(CommandLineTest, EncodingsThatThereAreNoneOfAreRefused) {
    const std::string improved = improved_file();
    for (const char* name : {"float16", "quantised:9", "quantised:25", "quantised:", "float32:8", "quantised:14x"}) {
        const CommandResult result = run({"resolution", improved, "--encoding", name, "-o", file("x.vsplit")});
        EXPECT_EQ(result.exit_status, 1) << name;
        EXPECT_NE(result.err.find("quantised:10 to quantised:24"), std::string::npos) << result.err;
    }
    const CommandResult mesh = run({"resolution", improved, "--encoding", "float32", "-o", file("x.stl")});
    EXPECT_EQ(mesh.exit_status, 1);
    EXPECT_NE(mesh.err.find("--encoding"), std::string::npos) << mesh.err;
}

TEST_F(CommandLineTest, InfoAndQualityDescribeAStoredRepresentation) {
    const std::string improved = improved_file();
    const auto info = json_of<v1::Representation>(run({"info", improved, "--json"}));
    EXPECT_EQ(info.method(), v1::IMPROVE);
    EXPECT_EQ(info.improve_options().subdivision_size(), 0.3);
    EXPECT_EQ(info.quality().worst_faces_size(), 0);
    const auto quality = json_of<v1::Representation>(run({"quality", improved, "--faces", "800", "--json"}));
    EXPECT_EQ(quality.faces(), 800U);
    EXPECT_EQ(quality.quality().worst_faces_size(), 20);
}

TEST_F(CommandLineTest, ControlWorksOnAStoredRepresentation) {
    const std::string improved = improved_file();
    const CommandResult result = run({"control", improved, "--source-faces", "700", "--subdivisions", "1", "--min-stretch",
                                      "0.05", "--json", "-o", file("c.stl")});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    const auto made = json_of<v1::Representation>(result);
    EXPECT_EQ(made.method(), v1::CONTROL);
    EXPECT_EQ(made.source().faces(), 700U);
    EXPECT_EQ(made.faces_max(), 2800U);
    EXPECT_TRUE(made.bounds_satisfied());
    EXPECT_TRUE(fs::exists(file("c.stl")));
}

TEST_F(CommandLineTest, ABoundThatCannotBeMetIsStatusTwo) {
    const std::string input = mesh_file("slivers.off", test::sliver_cylinder(24, 5));
    const CommandResult result = run({"control", input, "--min-stretch", "0.99", "--json", "-o", file("c.obj")});
    EXPECT_EQ(result.exit_status, 2);
    const auto made = json_of<v1::Representation>(result);
    EXPECT_FALSE(made.bounds_satisfied());
    ASSERT_EQ(made.violations_size(), 1);
    EXPECT_NE(result.err.find("bound not met: min_stretch 0.99: "), std::string::npos) << result.err;
    EXPECT_EQ(static_cast<std::uint32_t>(made.violations(0).elements_size()), made.violations(0).count());
    EXPECT_NE(result.err.find(made.violations(0).reason()), std::string::npos) << result.err;
    EXPECT_TRUE(fs::exists(file("c.obj")));  // done all the same
}

TEST_F(CommandLineTest, UnitsAreStatedKeptAndConverted) {
    const std::string frame = mesh_file("frame.off", test::cube_frame());
    EXPECT_EQ(json_of<v1::MeshSummary>(run({"info", frame, "--json"})).unit(), v1::LENGTH_UNIT_UNSPECIFIED);
    const CommandResult made =
        run({"improve", frame, "--subdivide", "0.3", "--faces", "1000", "--unit", "in", "--output-unit", "mm", "--json", "-o",
             file("frame.vsplit"), "-o", file("frame.3mf"), "-o", file("frame.ply")});
    EXPECT_EQ(made.exit_status, 0) << made.err;
    EXPECT_EQ(json_of<v1::Representation>(made).unit(), v1::INCH);
    const auto told = read_mesh_file(file("frame.3mf"), {});
    const auto plain = read_mesh_file(file("frame.ply"), {});
    ASSERT_TRUE(told && plain) << told.error().message;
    EXPECT_EQ(told->unit, LengthUnit::kMillimetre);
    EXPECT_EQ(told->mesh, plain->mesh);
    const auto stored = load_mrr(file("frame.vsplit"));
    ASSERT_TRUE(stored);
    TriangleMesh same = mesh_at(stored->mrr, stored->mrr.level_for(stored->faces));
    convert_lengths(same.positions, LengthUnit::kInch, LengthUnit::kMillimetre);
    EXPECT_EQ(same.positions, plain->mesh.positions) << "the file of the representation is in inches";

    EXPECT_EQ(json_of<v1::Representation>(run({"info", file("frame.vsplit"), "--json"})).unit(), v1::INCH) << "it says so";
    EXPECT_NE(run({"info", file("frame.vsplit"), "--unit", "mm"}).err.find("in in, and mm is stated"), std::string::npos);
    EXPECT_NE(run({"info", file("frame.3mf"), "--unit", "in"}).err.find("in mm, and in is stated"), std::string::npos);
    const CommandResult compared = run({"quality", file("frame.vsplit"), "--against", file("frame.3mf")});
    EXPECT_NE(compared.out.find("diagonal "), std::string::npos) << compared.err;
    EXPECT_NE(compared.out.find(" in\n"), std::string::npos) << compared.out;
    google::protobuf::Struct document;
    ASSERT_TRUE(wire::from_json(run({"quality", file("frame.vsplit"), "--against", file("frame.3mf"), "--json"}).out, document));
    EXPECT_EQ(document.fields().at("unit").string_value(), "INCH");
    EXPECT_LT(document.fields().at("deviationMax").number_value(), 1e-4) << "one was converted to the other's unit";
}

TEST_F(CommandLineTest, FormatOverridesTheExtension) {
    const std::string cube = mesh_file("cube.obj", test::cube());
    ASSERT_EQ(run({"info", cube, "-o", file("x.dat"), "--format", "ply-ascii"}).exit_status, 0);
    EXPECT_TRUE(test::file_content(file("x.dat")).starts_with("ply\nformat ascii"));
    EXPECT_EQ(run({"info", cube, "-o", file("x.dat"), "--format", "docx"}).exit_status, 1);
}

TEST_F(CommandLineTest, RepairMendsAndTells) {
    TriangleMesh broken = test::torus(80, 40);
    std::swap(broken.faces[7][0], broken.faces[7][1]);
    broken.faces.pop_back();
    const std::string path = mesh_file("broken.ply", broken);
    EXPECT_EQ(run({"improve", path}).exit_status, 1);
    const auto mended = json_of<v1::MeshSummary>(run({"info", path, "--repair", "full", "--json"}));
    EXPECT_TRUE(mended.closed());
    ASSERT_EQ(mended.findings_size(), 2);
    EXPECT_EQ(mended.findings(0).kind(), "TURNED_FACE");
    EXPECT_EQ(mended.findings(0).elements(0), 7U);
    EXPECT_EQ(mended.findings(1).kind(), "FILLED_HOLE");
    const CommandResult improved = run({"improve", path, "--repair", "full", "--faces", "1000"});
    EXPECT_EQ(improved.exit_status, 0) << improved.err;
    EXPECT_NE(improved.err.find("vsplit: finding: TURNED_FACE: 1 faces"), std::string::npos) << improved.err;
    EXPECT_NE(improved.err.find("vsplit: finding: FILLED_HOLE: "), std::string::npos) << improved.err;
    const auto told = json_of<v1::Representation>(
        run({"control", path, "--repair", "FULL", "--json", "--subdivisions", "0", "-o", file("mended.vsplit")}));
    ASSERT_EQ(told.source_findings_size(), 2);
    EXPECT_EQ(told.source_findings(1).kind(), "FILLED_HOLE");
    EXPECT_EQ(json_of<v1::Representation>(run({"info", file("mended.vsplit"), "--json"})).source_findings_size(), 0);
    EXPECT_NE(run({"info", path, "--repair", "safe"}).out.find("TURNED_FACE: 1 faces"), std::string::npos);
    EXPECT_NE(run({"info", path, "--repair", "none"}).out.find("INCONSISTENT_EDGE"), std::string::npos);
    EXPECT_FALSE(json_of<v1::MeshSummary>(run({"info", path, "--repair", "full", "--hole-size", "1e-3", "--json"})).closed());
    // A piece of half the size goes where it is a speck.
    const std::string two = mesh_file("two.ply", test::joined(test::torus(20, 10), test::icosphere(2), Vec3(9, 0, 0)));
    const auto pieces = [&](const char* size) {
        return json_of<v1::MeshSummary>(run({"info", two, "--repair", "full", "--speck-size", size, "--json"})).components();
    };
    EXPECT_EQ(pieces("1"), 2U);
    EXPECT_EQ(pieces("3.5"), 1U);
    // A gap of 0.01 between two squares.
    const TriangleMesh sheet = test::square(4);
    const double width = bounding_box(sheet).max.x() - bounding_box(sheet).min.x();
    const std::string cracked = mesh_file("cracked.ply", test::joined(sheet, sheet, Vec3(width + 0.01, 0, 0)));
    const auto parts = [&](const char* stitch) {
        return json_of<v1::MeshSummary>(run({"info", cracked, "--repair", "full", "--stitch", stitch, "--json"})).components();
    };
    EXPECT_EQ(parts("1e-3"), 2U);
    EXPECT_EQ(parts("0.02"), 1U);
}

TEST_F(CommandLineTest, ErrorsNameTheFileWhateverItHolds) {
    const std::string path = file("x.obj");
    std::ofstream(path) << "v 0 0 " << path << "\n";
    const CommandResult told = run({"info", path});
    EXPECT_NE(told.err.find("vsplit: MALFORMED_INPUT: " + path + ": line 1: "), std::string::npos) << told.err;
}

TEST_F(CommandLineTest, NoBytesOfAFileReachTheTerminalRaw) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const std::string& text : {vertices + "g \xff\x1b[31mwall\nf 1 2 3\n", vertices + "f 1 2 3\n\xff\x1b[31m\n",
                                    std::string("GRID,1,,0.,0.,0.\nCTRI\xff\x1b[31m,1,1,1,2,3\n"),
                                    std::string("*NODE, SYSTEM=\xff\x1b[31m\n1, 0, 0, 0\n")}) {
        std::ofstream(file("raw"), std::ios::binary) << text;
        const CommandResult told = run({"info", file("raw")});
        const std::string all = told.out + told.err;
        EXPECT_FALSE(all.empty());
        EXPECT_EQ(all.find('\x1b'), std::string::npos) << text;
        EXPECT_EQ(all.find('\xff'), std::string::npos) << text;
    }
}

TEST_F(CommandLineTest, GroupsAreListedOfMeshesAndRepresentations) {
    TriangleMesh mesh = test::cube_frame();
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(f % 2 == 0 ? 3 : 8);
    mesh.sets = {{"wall", {3}}};
    const std::string path = mesh_file("groups.msh", mesh);
    const auto summary = json_of<v1::MeshSummary>(run({"info", path, "--json"}));
    ASSERT_EQ(summary.groups_size(), 2);
    EXPECT_EQ(summary.group_count(), 2U);
    EXPECT_EQ(summary.groups(0).name(), "wall");
    EXPECT_EQ(summary.groups(0).faces(), mesh.face_count() / 2);
    EXPECT_EQ(summary.groups(1).name(), "");
    EXPECT_EQ(summary.groups(1).regions(0), 8U);
    ASSERT_EQ(run({"improve", path, "--subdivide", "0.5", "--faces", "2000", "-o", file("groups.vsplit")}).exit_status, 0);
    const auto finest = json_of<v1::Representation>(run({"info", file("groups.vsplit"), "--json"}));
    ASSERT_EQ(finest.groups_size(), 2);
    EXPECT_EQ(finest.groups(0).name(), "wall");
    EXPECT_EQ(finest.groups(0).faces() + finest.groups(1).faces(), finest.faces());
    const CommandResult told = run({"info", file("groups.vsplit")});
    EXPECT_NE(told.out.find("group             wall: "), std::string::npos) << told.out;
    const Expected<StoredMrr> stored = load_mrr(file("groups.vsplit"));
    ASSERT_TRUE(stored);
    EXPECT_EQ(stored->description.find("wall"), std::string::npos) << "the mesh tells it";
}

TEST_F(CommandLineTest, AnOpenMeshIsToldOfByAMethodToo) {
    const std::string open = mesh_file("open.off", test::square(6));
    const CommandResult improved = run({"improve", open, "--faces", "40"});
    EXPECT_EQ(improved.exit_status, 0) << improved.err;
    EXPECT_NE(improved.err.find("vsplit: finding: BOUNDARY_EDGE: 24 "), std::string::npos) << improved.err;
}

TEST_F(CommandLineTest, WhatIsWrongInAFileIsToldWithItsName) {
    const std::string good = mesh_file("good.off", test::cube());
    const std::string bad = file("bad.obj");
    std::ofstream(bad) << "v 0 0 0\nv 1 0 x\n";
    const std::string said = "vsplit: MALFORMED_INPUT: " + bad + ": line 2: ";
    EXPECT_TRUE(run({"info", bad}).err.starts_with(said)) << run({"info", bad}).err;
    EXPECT_TRUE(run({"improve", bad}).err.starts_with(said));
    EXPECT_TRUE(run({"quality", good, "--against", bad}).err.starts_with(said));
    std::ofstream(file("none.stl")) << "what is this";
    const std::string unknown = run({"info", file("none.stl")}).err;
    EXPECT_TRUE(unknown.starts_with("vsplit: UNKNOWN_FORMAT: " + file("none.stl") + ": ")) << unknown;
    const std::string absent = run({"info", file("absent.stl")}).err;
    EXPECT_EQ(absent.find(file("absent.stl")), absent.rfind(file("absent.stl"))) << "once: " << absent;
}

TEST_F(CommandLineTest, UnitsThatAreAssumedAreTold) {
    const std::string one = mesh_file("one.off", test::cube());
    const std::string other = mesh_file("other.off", test::cube());
    const std::string inches = file("inches.3mf");
    ASSERT_TRUE(write_mesh_file(test::cube(), MeshFormat::k3mf, inches, LengthUnit::kInch));
    EXPECT_EQ(run({"quality", one, "--against", other}).err, "") << "nothing is assumed";
    const std::string stated = run({"quality", one, "--unit", "mm", "--against", other}).err;
    EXPECT_EQ(stated, "vsplit: note: the unit of " + other + " is not known; taken is mm, that of " + one + "\n");
    EXPECT_EQ(run({"quality", one, "--unit", "MM", "--against", inches}).err, "") << "converted";
    const CommandResult taken = run({"quality", one, "--against", inches});
    EXPECT_EQ(taken.err, "vsplit: note: the unit of " + one + " is not known; taken is in, that of " + inches + "\n");
    EXPECT_NE(taken.out.find("diagonal          1.73205 in\n"), std::string::npos) << taken.out;
}

TEST_F(CommandLineTest, NothingRemovedIsSaid) {
    const std::string plate = mesh_file("plate.ply", test::drilled_plate(2, 10, 4, {{4, 4, 24}, {3, 2, 24}}));
    const CommandResult none = run({"remove-features", plate, "--unit", "mm", "--max-diameter", "1"});
    EXPECT_EQ(none.exit_status, 0);
    EXPECT_NE(none.err.find("no feature has a diameter of 1 mm or less; 2 larger: from "), std::string::npos) << none.err;
    EXPECT_EQ(run({"remove-features", plate, "--max-diameter", "9"}).err, "");
}

TEST_F(CommandLineTest, NamesAreThoseOfTheServerToo) {
    const std::string cube = mesh_file("cube.off", test::cube());
    for (const char* unit : {"mm", "MM", "MILLIMETRE", "millimetre"}) {
        const CommandResult written = run({"info", cube, "--unit", unit, "--format", "THREE_MF", "-o", file("x")});
        EXPECT_NE(written.out.find("unit              mm\n"), std::string::npos) << written.err;
        EXPECT_TRUE(test::file_content(file("x")).starts_with("PK")) << unit;
    }
    EXPECT_EQ(run({"info", cube, "--repair", "FULL", "--format", "STL_ASCII", "-o", file("y")}).exit_status, 0);
    EXPECT_TRUE(test::file_content(file("y")).starts_with("solid"));
    EXPECT_EQ(run({"info", cube, "--format", "3", "-o", file("z")}).exit_status, 1);
    EXPECT_NE(run({"improve", cube, "--subdivide", "0.3", "--mode", "Strict", "--json"}).out.find("\"STRICT\""),
              std::string::npos);
}

TEST_F(CommandLineTest, QualityByAProfile) {
    const std::string path = mesh_file("part.off", test::sliver_cylinder(40, 10));
    const auto summary = json_of<v1::MeshSummary>(run({"quality", path, "--profile", "verdict", "--json"}));
    const v1::ProfileReport& report = summary.quality().profile();
    EXPECT_EQ(report.profile(), v1::VERDICT);
    EXPECT_EQ(report.passed() + report.warned() + report.failed(), 156U);
    EXPECT_GE(report.failed(), 80U);
    EXPECT_NE(run({"quality", path, "--profile", "optistruct"}).out.find("by OPTISTRUCT: "), std::string::npos);
    const CommandResult limits = run({"quality", path, "--profile", "OPTISTRUCT"});
    EXPECT_NE(limits.out.find(" > 50 "), std::string::npos) << limits.out;
    EXPECT_NE(limits.out.find(" > 500 "), std::string::npos) << limits.out;
    EXPECT_NE(limits.out.find(" < 15 "), std::string::npos) << limits.out;
    EXPECT_EQ(report.criteria(0).fail_limit(), 1.3);
    EXPECT_TRUE(report.criteria(0).upper());
    EXPECT_NE(run({"quality", path, "--profile", "none"}).err.find("accepted is one of optistruct, stretch-02, verdict"),
              std::string::npos);
}

TEST_F(CommandLineTest, WeldClosesSmallGaps) {
    TriangleMesh gapped = test::cube();
    gapped.positions.push_back(gapped.positions[gapped.faces[0][0]] + Vec3(1e-6, 0, 0));
    gapped.faces[0][0] = gapped.vertex_count() - 1;
    const std::string input = mesh_file("gapped.off", gapped);
    EXPECT_FALSE(json_of<v1::MeshSummary>(run({"info", input, "--json"})).closed());
    EXPECT_TRUE(json_of<v1::MeshSummary>(run({"info", input, "--weld", "1e-5", "--json"})).closed());
}

/// A line, and what stderr must say to it.
struct Refusal {
    std::vector<std::string> arguments;
    std::string said;
};

TEST_F(CommandLineTest, RefusesWithCauseAndOption) {
    const std::string cube = mesh_file("cube.obj", test::cube());
    TriangleMesh touching_mesh = test::square(2);
    touching_mesh.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const std::string touching = mesh_file("touching.obj", touching_mesh);
    const std::vector<Refusal> refusals{
        {{"improve", cube, "--tolerance", "-1"}, "INVALID_OPTION: tolerance is -1"},
        {{"improve", cube, "--tolerance", "nan"}, "(--tolerance)"},
        {{"improve", cube, "--subdivide", "0"}, "(--subdivide)"},
        {{"improve", cube, "--subdivide", "1e-6"}, "LIMIT_EXCEEDED"},
        {{"improve", cube, "--faces", "3"}, "(--faces)"},
        {{"improve", cube, "--faces", "100", "--faces-min", "200"}, "(--faces-min)"},
        {{"improve", cube, "--feature-angle", "181"}, "(--feature-angle)"},
        {{"improve", cube, "--mode", "strict", "--max-deviation", "1"}, "UNSUPPORTED"},
        {{"improve", cube, "--max-deviation", "1e-12"}, "(--max-deviation)"},
        {{"improve", cube, "--server", ""}, "accepted is HOST:PORT"},
        {{"improv", cube}, "there is no verb 'improv'"},
        {{"improve", cube, "--repair", "some"}, "accepted is one of full, none, safe"},
        {{"control", cube, "--min-stretch", "1.5"}, "(--min-stretch)"},
        {{"control", cube, "--max-valence", "5"}, "(--max-valence)"},
        {{"control", cube, "--min-angle", "60"}, "(--min-angle)"},
        {{"control", cube, "--max-angle", "60"}, "(--max-angle)"},
        {{"control", cube, "--max-aspect-ratio", "0.5"}, "(--max-aspect-ratio)"},
        {{"control", cube, "--min-size", "3", "--max-size", "2"}, "at most max_size, which is 2 (--min-size)"},
        {{"control", cube, "--subdivisions", "13"}, "(--subdivisions)"},
        {{"info", cube, "--weld", "-1"}, "(--weld)"},
        {{"info", cube, "--hole-size", "1"}, "(--hole-size)"},
        {{"info", cube, "--repair", "safe", "--stitch", "1"}, "(--stitch)"},
        {{"info", cube, "--repair", "full", "--speck-size", "-1"}, "(--speck-size)"},
        {{"info", cube, "--unit", "yd"}, "accepted is one of centimetre, cm, foot, ft, in, inch, m, metre"},
        {{"improve", cube, "--subdivide", "0.3", "-o", file("cube.ply"), "--output-unit", "m"}, "(--unit)"},
        {{"info", cube, "-o", file("cube.3mf")}, "a 3mf file says its unit"},
        {{"info", "--unit", "mm", "--session", "s", "--server", "127.0.0.1:1"}, "(--unit)"},
        {{"improve", touching}, "NON_MANIFOLD: the boundary touches itself at vertex 3"},  // unused ones are dropped
        {{"improve", file("none.stl")}, "NOT_FOUND"},
        {{"info", file("none.vsplit")}, "NOT_FOUND"},
        {{"info", directory_.path().string()}, "FILE_ACCESS"},
        {{"info"}, "(IN)"},
        {{"info", cube, "--faces", "10"}, "(--faces)"},
        {{"improve", cube, "--source-faces", "10"}, "(--source-faces)"},
        {{"resolution", cube}, "no .vsplit file"},
        {{"info", cube, "-o", file("cube.vsplit")}, "only a mesh"},
        {{"info", cube, "-o", file("cube.docx")}, "UNKNOWN_FORMAT"},
        {{"info", cube, "-o", "-"}, "INVALID_OPTION: '-' is no file"},
        {{"info", cube, "--format", "stl", "-o", "-"}, "(-o)"},
        {{"info", file("none.vsplit"), "--repair", "full"}, "INVALID_OPTION: a .vsplit file holds a mesh as it was"},
        {{"improve", file("none.vsplit"), "--weld", "0.1"}, "(--weld)"},
        {{"quality", file("none.vsplit"), "--against", file("none.vsplit"), "--repair", "safe"}, "(--repair)"},
        {{"info", "--repair", "none", "--session", "s", "--server", "127.0.0.1:1"}, "(--repair)"},
        {{"improve", file("none.vsplit"), "--repair", "safe", "--server", "127.0.0.1:1"}, "(--repair)"},
        {{"info", cube, "-o", file("no/cube.stl")}, "NOT_FOUND"},
        {{"info", cube, "-o", directory_.path().string() + "/.stl/"}, "NOT_FOUND"},
        {{"info", cube, "--session", "s"}, "--server"},
        {{"info", cube, "--keep"}, "--server"},
        {{"info", cube, "--server", "nowhere"}, "INVALID_OPTION"},
        {{"info", cube, "--server", "127.0.0.1:1"}, "UNAVAILABLE"},
        {{"info", "-", "--server", "127.0.0.1:1"}, "(IN)"},
        {{"info", cube, "--server", "127.0.0.1:1", "--session", "s"}, "(IN)"},
        {{"info", cube, "--server", "127.0.0.1:1", "--representation", "r"}, "(--session)"},
        {{"resolution", cube, "--server", "127.0.0.1:1"}, "(--session)"},
    };
    for (const Refusal& refusal : refusals) {
        std::vector<std::string> all{VSPLIT_BINARY};
        all.insert(all.end(), refusal.arguments.begin(), refusal.arguments.end());
        const CommandResult result = test::run_command(all);
        EXPECT_EQ(result.exit_status, 1) << refusal.said;
        EXPECT_EQ(result.out, "") << refusal.said;
        EXPECT_TRUE(result.err.starts_with("vsplit: ")) << result.err;
        EXPECT_NE(result.err.find(refusal.said), std::string::npos) << result.err << "lacks " << refusal.said;
    }
}

TEST_F(CommandLineTest, SizesAreReadAndRefusedByName) {
    const std::string cube = mesh_file("cube.off", test::cube());
    const auto refused = [&](std::initializer_list<std::string> options, const std::string& part) {
        std::vector<std::string> all = words({"improve", cube});
        all.insert(all.end(), options);
        const CommandResult told = test::run_command(all);
        EXPECT_EQ(told.exit_status, 1);
        EXPECT_NE(told.err.find(part), std::string::npos) << told.err;
    };
    const std::string sizes = file("sizes.txt");
    std::ofstream(sizes) << "1\n0\n 2.5e-1 \n\n-3\n";
    refused({"--size-field", sizes}, "INVALID_OPTION: sizing.field[3] is -3; accepted is");
    refused({"--size-field", sizes}, "(--size-field)");
    std::ofstream(sizes) << "1\n2 much\n";
    refused({"--size-field", sizes}, "MALFORMED_INPUT: line 2 of '" + sizes + "' is '2 much'");
    std::ofstream(sizes) << "\n";
    refused({"--size-field", sizes}, "EMPTY_INPUT: ");
    refused({"--size-field", file("none.txt")}, "NOT_FOUND: cannot read the size field");
    refused({"--size-sphere", "0,0,0,1,-2"},
            "sizing.spheres[0].size is -2; accepted is a positive finite length (--size-sphere)");
    refused({"--gradation", "0"}, "(--gradation)");
    refused({"--min-mean-stretch", "1.5"}, "min_mean_stretch is 1.5; accepted is 0 to 1");
}

TEST_F(CommandLineTest, FeatureDetectionIsUsedAndReported) {
    const std::string frame = mesh_file("frame.off", test::cube_frame());
    const auto made = json_of<v1::Representation>(
        run({"improve", frame, "--subdivide", "0.3", "--feature-detection", "normal-voting", "--json"}));
    EXPECT_EQ(made.improve_options().feature_detection(), v1::NORMAL_VOTING);
}

TEST_F(CommandLineTest, AnOpenMeshGoesToAFileAndBackAtEveryResolution) {
    const TriangleMesh source = test::holed_square(8, 2);
    const std::string open = mesh_file("open.ply", source);
    const auto made = json_of<v1::Representation>(
        run({"improve", open, "--subdivide", "0.5", "--faces", "300", "--freeze-boundary", "-o", file("open.vsplit"), "--json"}));
    EXPECT_TRUE(made.improve_options().freeze_boundary());
    for (const std::uint32_t faces : {made.faces_min(), made.faces(), made.faces_max()}) {
        const CommandResult told =
            run({"resolution", file("open.vsplit"), "--faces", std::to_string(faces), "-o", file("at.ply"), "--json"});
        ASSERT_EQ(told.exit_status, 0) << told.err;
        const auto read = read_mesh_file(file("at.ply"), {});
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->mesh.face_count(), faces);
        const MeshReport report = inspect(read->mesh);
        EXPECT_FALSE(report.closed);
        EXPECT_EQ(report.boundary_edges, 40U) << "each edge of it as it was";
        EXPECT_NEAR(surface_area(read->mesh), surface_area(source), 1e-4) << "coordinates are floats";
    }
    EXPECT_FALSE(json_of<v1::Representation>(run({"control", open, "--json"})).control_options().freeze_boundary());
}

TEST_F(CommandLineTest, BrokenFilesAreRefusedNotFollowed) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(test::data_file("broken"))) {
        if (!entry.is_regular_file()) continue;
        const CommandResult result = run({"improve", entry.path().string(), "--json"});
        EXPECT_EQ(result.exit_status, 1) << entry.path();
        EXPECT_EQ(result.out, "") << entry.path();
        EXPECT_TRUE(result.err.starts_with("vsplit: ")) << entry.path() << result.err;
        ++files;
    }
    EXPECT_GT(files, 10U);
}

TEST_F(CommandLineTest, DamagedRepresentationFilesAreRefused) {
    const std::string improved = improved_file();
    const std::string whole = test::file_content(improved);
    const auto check = [&](const std::string& bytes, const std::string& what) {
        std::ofstream(file("damaged.vsplit"), std::ios::binary) << bytes;
        const CommandResult result = run({"info", file("damaged.vsplit")});
        EXPECT_EQ(result.exit_status, 1) << what;
        EXPECT_TRUE(result.err.starts_with("vsplit: ")) << what << result.err;
    };
    check("", "empty");
    check(whole.substr(0, whole.size() / 2), "half");
    check(whole.substr(0, 10), "ten bytes");
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    check(flipped, "one bit");
}

TEST_F(CommandLineTest, HelpShowsUnitsDefaultsAndAnExample) {
    EXPECT_EQ(run({"--version"}).out, "vsplit " VSPLIT_VERSION "\n");
    const CommandResult help = run({"--help"});
    EXPECT_EQ(help.exit_status, 0);
    for (const char* verb : {"info", "improve", "control", "resolution", "quality"}) {
        EXPECT_NE(help.out.find(verb), std::string::npos);
        const CommandResult of_verb = run({verb, "--help"});
        EXPECT_EQ(of_verb.exit_status, 0);
        EXPECT_NE(of_verb.out.find(std::string("Example:\n  vsplit ") + verb), std::string::npos) << of_verb.out;
    }
    const std::string improve = run({"improve", "--help"}).out;
    for (const char* option : {"--subdivide",      "--tolerance",      "--faces", "--faces-min", "--max-deviation",
                               "--feature-angle",  "--feature-weight", "--mode",  "--repair",    "--weld",
                               "--threads",        "--format",         "--json",  "--server",    "--session",
                               "--representation", "--no-progress",    "-o",      "Default",     "degrees"}) {
        EXPECT_NE(improve.find(option), std::string::npos) << option;
    }
}

TEST_F(CommandLineTest, AFullDiskIsToldNotSwallowed) {
    const std::string cube = mesh_file("cube.obj", test::cube());
    const CommandResult result =
        test::run_command({"/bin/sh", "-c", std::string(VSPLIT_BINARY) + " info " + cube + " > /dev/full"});
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_NE(result.err.find("FILE_ACCESS"), std::string::npos) << result.err;
}

TEST_F(CommandLineTest, AnInterruptCancelsCleanly) {
    const std::string input = mesh_file("ball.ply", test::icosphere(6));
    Command command(words({"improve", input, "--subdivide", "0.004", "-o", file("ball.vsplit")}));
    ASSERT_TRUE(command.blocks(SIGINT, seconds(30)));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // into the work
    ASSERT_EQ(::kill(command.pid(), SIGINT), 0);
    const auto begin = std::chrono::steady_clock::now();
    const CommandResult result = command.wait(seconds(60));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_EQ(result.err, "vsplit: cancelled\n");
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), fs::directory_iterator()), 1);  // the input
}

/// What a command writes to a terminal that is its stderr.
std::string said_to_terminal(const std::vector<std::string>& words) {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) return "no terminal";
    const int slave = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
    Command command(words, slave);
    ::close(slave);
    std::string said;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::read(master, buffer.data(), buffer.size())) > 0;)
        said.append(buffer.data(), static_cast<std::size_t>(got));
    ::close(master);
    EXPECT_EQ(command.wait().exit_status, 0);
    return said;
}

TEST_F(CommandLineTest, ProgressIsShownOnTerminalsOnly) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const std::string shown = said_to_terminal(words({"improve", input, "--subdivide", "0.1"}));
    EXPECT_NE(shown.find("simplify"), std::string::npos) << shown;
    EXPECT_TRUE(shown.ends_with("\r\033[K")) << shown;  // it leaves a clean line
    EXPECT_EQ(said_to_terminal(words({"improve", input, "--subdivide", "0.3", "--no-progress"})), "");
    EXPECT_EQ(run({"improve", input, "--subdivide", "0.3"}).err, "");
}

}  // namespace
}  // namespace vsplit::cli
