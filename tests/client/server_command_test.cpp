#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is POSIX

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/client/command.h"
#include "tests/core/drilled_plate.h"
#include "tests/core/meshes.h"
#include "vsplit/client/meshing_client.h"
#include "vsplit/io/write_mesh.h"
#include "vsplit/mrr/mrr_file.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/json.h"

namespace vsplit::cli {
namespace {

using std::chrono::seconds;
using test::Command;
using test::CommandResult;

/// `vsplit --server` against a real server on loopback; what it does locally is the measure.
class ServerCommandTest : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(server_.says("\n", seconds(60))) << server_.err();
        const std::string said = server_.out();
        const std::size_t begin = said.find("127.0.0.1:");
        ASSERT_NE(begin, std::string::npos) << said;
        target_ = said.substr(begin, said.find_first_of(" \n", begin) - begin);
    }

    [[nodiscard]] std::string file(const std::string& name) const { return (directory_.path() / name).string(); }

    std::string mesh_file(const std::string& name, const TriangleMesh& mesh) {
        std::string path = file(name);
        EXPECT_TRUE(write_mesh_file(mesh, *format_by_extension(name), path));
        return path;
    }

    static CommandResult locally(std::vector<std::string> words) {
        words.insert(words.begin(), VSPLIT_BINARY);
        return test::run_command(words);
    }

    [[nodiscard]] CommandResult remotely(std::vector<std::string> words) const {
        words.insert(words.end(), {"--server", target_});
        return locally(std::move(words));
    }

    [[nodiscard]] int sessions() const {
        Expected<client::MeshingClient> client = client::MeshingClient::connect(target_);
        EXPECT_TRUE(client);
        const auto listed = client->list_sessions();
        EXPECT_TRUE(listed);
        return listed->sessions_size();
    }

    test::TempDirectory directory_;
    Command server_{{VSPLITD_BINARY, "--listen", "127.0.0.1:0"}};
    std::string target_;
};

v1::Representation representation_of(const CommandResult& result) {
    v1::Representation made;
    EXPECT_TRUE(wire::from_json(result.out, made)) << result.out << result.err;
    return made;
}

/// Without what must differ: the server names it, and takes its own time.
std::string comparable(v1::Representation made) {
    made.clear_id();
    made.clear_elapsed();
    made.mutable_source()->clear_representation();
    return wire::to_json(made);
}

TEST_F(ServerCommandTest, ImproveIsWhatItIsLocally) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const auto improve = [&](const std::string& name) {
        return std::vector<std::string>{
            "improve",           input, "--subdivide",         "0.2", "--faces", "1000", "--json", "-o",
            file(name + ".ply"), "-o",  file(name + ".vsplit")};
    };
    const CommandResult here = locally(improve("here"));
    const CommandResult there = remotely(improve("there"));
    EXPECT_EQ(there.exit_status, 0) << there.err;
    EXPECT_EQ(there.err, "");
    EXPECT_FALSE(representation_of(there).id().empty());
    EXPECT_EQ(comparable(representation_of(here)), comparable(representation_of(there)));
    EXPECT_EQ(test::file_content(file("here.ply")), test::file_content(file("there.ply")));
    const auto stored_here = load_mrr(file("here.vsplit"));
    const auto stored_there = load_mrr(file("there.vsplit"));
    ASSERT_TRUE(stored_here && stored_there);
    EXPECT_EQ(stored_here->mrr, stored_there->mrr);
    EXPECT_EQ(stored_here->faces, stored_there->faces);
    EXPECT_EQ(stored_here->source, stored_there->source);
    EXPECT_TRUE(stored_there->source);
    EXPECT_EQ(stored_here->deviations, stored_there->deviations);
    EXPECT_EQ(sessions(), 0);
}

TEST_F(ServerCommandTest, FeaturesAreWhatTheyAreLocally) {
    const std::string mesh = mesh_file("plate.ply", test::drilled_plate(2, 10, 4, {{4, 4, 24}, {3, 2, 24}}));
    const CommandResult listed = remotely({"features", mesh, "--json"});
    ASSERT_EQ(listed.exit_status, 0) << listed.err;
    EXPECT_EQ(listed.out, locally({"features", mesh, "--json"}).out);
    EXPECT_NE(listed.out.find("THROUGH_HOLE"), std::string::npos);
    const CommandResult removed = remotely({"remove-features", mesh, "--max-diameter", "3.5", "-o", file("far.ply"), "--json"});
    ASSERT_EQ(removed.exit_status, 0) << removed.err;
    EXPECT_EQ(removed.out, locally({"remove-features", mesh, "--max-diameter", "3.5", "-o", file("near.ply"), "--json"}).out);
    EXPECT_EQ(test::file_content(file("far.ply")), test::file_content(file("near.ply")));
    const std::vector<std::string> through{"remove-features", mesh,     "--max-diameter", "5",     "--kind",
                                           "through-hole",    "--kind", "fillet",         "--json"};
    const CommandResult one = remotely(through);
    ASSERT_EQ(one.exit_status, 0) << one.err;
    EXPECT_EQ(one.out, locally(through).out);
    EXPECT_NE(one.out, removed.out);
    EXPECT_NE(locally({"remove-features", mesh, "--max-diameter", "5", "--kind", "rib"}).exit_status, 0);
    const CommandResult refused = remotely({"remove-features", mesh, "--id", "9"});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_NE(refused.err.find("--id"), std::string::npos) << refused.err;
    const std::vector<std::string> small{"remove-features", mesh, "--max-diameter", "1"};
    EXPECT_EQ(remotely(small).err, locally(small).err);
    EXPECT_NE(remotely(small).err.find("2 larger"), std::string::npos);
}

TEST_F(ServerCommandTest, FindingsAndGroupsAreWhatTheyAreLocally) {
    TriangleMesh mesh = test::cube_frame();
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(f < 8 ? 3 : 8);
    mesh.sets = {{"wall", {3}}};
    std::swap(mesh.faces[7][0], mesh.faces[7][1]);
    const std::string input = mesh_file("groups.msh", mesh);
    const std::vector<std::string> described{"info", input, "--repair", "safe", "--json"};
    EXPECT_EQ(remotely(described).out, locally(described).out);
    EXPECT_NE(remotely(described).out.find("\"wall\""), std::string::npos);
    const std::vector<std::string> improve{"improve", input,     "--repair", "safe",  "--subdivide",
                                           "0.3",     "--faces", "1000",     "--json"};
    const CommandResult here = locally(improve);
    const CommandResult there = remotely(improve);
    EXPECT_NE(there.err.find("vsplit: finding: TURNED_FACE"), std::string::npos) << there.err;
    EXPECT_EQ(there.err, here.err);
    EXPECT_EQ(comparable(representation_of(there)), comparable(representation_of(here)));
    EXPECT_GT(representation_of(there).source_findings_size(), 0);
    std::ofstream(file("bad.obj")) << "v 0 0 0\nv 1 0 x\n";
    EXPECT_EQ(remotely({"info", file("bad.obj")}).err, locally({"info", file("bad.obj")}).err);
}

TEST_F(ServerCommandTest, OneSessionServesSeveralCommands) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const CommandResult improved = remotely({"improve", input, "--subdivide", "0.2", "--faces", "1000", "--keep", "--json"});
    ASSERT_TRUE(improved.err.starts_with("session ")) << improved.err;
    const std::string session = improved.err.substr(8, improved.err.find('\n') - 8);
    const std::string first = representation_of(improved).id();
    ASSERT_EQ(locally({"improve", input, "--subdivide", "0.2", "--faces", "1000", "-o", file("i.vsplit")}).exit_status, 0);

    const CommandResult there = remotely(
        {"control", "--session", session, "--representation", first, "--min-stretch", "0.05", "--json", "-o", file("there.ply")});
    const CommandResult here = locally({"control", file("i.vsplit"), "--min-stretch", "0.05", "--json", "-o", file("here.ply")});
    EXPECT_EQ(there.exit_status, here.exit_status) << there.err;
    EXPECT_EQ(comparable(representation_of(there)), comparable(representation_of(here)));
    EXPECT_EQ(representation_of(there).source().representation(), first);
    EXPECT_EQ(test::file_content(file("there.ply")), test::file_content(file("here.ply")));

    for (const char* faces : {"1500", "700", "2001"}) {
        const CommandResult shown = remotely(
            {"resolution", "-", "--session", session, "--representation", first, "--faces", faces, "-o", file("there.off")});
        EXPECT_EQ(shown.exit_status, 0) << shown.err;
        EXPECT_EQ(locally({"resolution", file("i.vsplit"), "--faces", faces, "-o", file("here.off")}).exit_status, 0);
        EXPECT_EQ(test::file_content(file("there.off")), test::file_content(file("here.off"))) << faces;
    }
    const CommandResult own = remotely({"resolution", "--session", session, "--json"});  // the newest, as it was made
    EXPECT_EQ(representation_of(own).id(), representation_of(there).id());
    EXPECT_EQ(representation_of(own).faces(), representation_of(there).faces());
    EXPECT_EQ(sessions(), 1);
}

TEST_F(ServerCommandTest, DescriptionsAreWhatTheyAreLocally) {
    const std::string input = mesh_file("slivers.ply", test::sliver_cylinder(40, 10));
    for (const char* verb : {"info", "quality"}) {
        const CommandResult here = locally({verb, input, "--json"});
        const CommandResult there = remotely({verb, input, "--json"});
        EXPECT_EQ(there.exit_status, 0) << there.err;
        EXPECT_EQ(there.out, here.out);
    }
    ASSERT_EQ(remotely({"info", input, "-o", file("copy.off")}).exit_status, 0);
    ASSERT_EQ(locally({"info", input, "-o", file("local.off")}).exit_status, 0);
    EXPECT_EQ(test::file_content(file("copy.off")), test::file_content(file("local.off")));
    EXPECT_EQ(sessions(), 0);
}

TEST_F(ServerCommandTest, UnitsAreWhatTheyAreLocally) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const auto improve = [&](const std::string& name) {
        return std::vector<std::string>{"improve", input,           "--subdivide", "0.2", "--faces",           "1000",  "--unit",
                                        "in",      "--output-unit", "mm",          "-o",  file(name + ".3mf"), "--json"};
    };
    const CommandResult here = locally(improve("here"));
    const CommandResult there = remotely(improve("there"));
    ASSERT_EQ(there.exit_status, 0) << there.err;
    EXPECT_EQ(representation_of(there).unit(), v1::INCH);
    EXPECT_EQ(comparable(representation_of(there)), comparable(representation_of(here)));
    EXPECT_EQ(test::file_content(file("there.3mf")), test::file_content(file("here.3mf")));
    const std::vector<std::string> told{"quality", file("here.3mf"), "-o", file("copy.off"), "--output-unit", "m"};
    EXPECT_EQ(remotely(told).out, locally(told).out);
    const CommandResult unknown = remotely({"info", input, "-o", file("copy.off"), "--output-unit", "m"});
    EXPECT_EQ(unknown.exit_status, 1);
    EXPECT_NE(unknown.err.find("(--unit)"), std::string::npos) << unknown.err;
    EXPECT_EQ(sessions(), 0);
}

TEST_F(ServerCommandTest, QualityOfARepresentationAtAnyResolution) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    const CommandResult improved = remotely({"improve", input, "--subdivide", "0.2", "--keep", "--json"});
    const std::string session = improved.err.substr(8, improved.err.find('\n') - 8);
    const std::string id = representation_of(improved).id();
    const CommandResult measured =
        remotely({"quality", "--session", session, "--representation", id, "--faces", "901", "--json"});
    EXPECT_EQ(representation_of(measured).faces(), 900U);
    EXPECT_EQ(representation_of(measured).quality().faces(), 900U);
    EXPECT_EQ(representation_of(measured).quality().worst_faces_size(), 20);
    const CommandResult written =
        remotely({"info", "--session", session, "--representation", id, "--faces", "900", "-o", file("r.off")});
    EXPECT_EQ(written.exit_status, 0) << written.err;
    EXPECT_TRUE(test::file_content(file("r.off")).find(" 900 ") != std::string::npos);
}

TEST_F(ServerCommandTest, AStoredRepresentationIsUploadedAtItsResolution) {
    const std::string input = mesh_file("frame.off", test::cube_frame());
    ASSERT_EQ(locally({"improve", input, "--subdivide", "0.2", "--faces", "1000", "-o", file("i.vsplit")}).exit_status, 0);
    const std::vector<std::string> control{"control",       file("i.vsplit"), "--source-faces", "800",
                                           "--min-stretch", "0.05",           "--json"};
    EXPECT_EQ(comparable(representation_of(remotely(control))), comparable(representation_of(locally(control))));
}

TEST_F(ServerCommandTest, ErrorsOfTheServerKeepTheirCause) {
    TriangleMesh touching_mesh = test::square(2);
    touching_mesh.faces = {{0, 1, 4}, {0, 4, 3}, {4, 5, 8}, {4, 8, 7}};
    const std::string touching = mesh_file("touching.obj", touching_mesh);
    const std::string broken = test::data_file("broken/stl_says_4_billion_faces.stl").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> refusals{
        {{"improve", touching}, "NON_MANIFOLD: the boundary touches itself at vertex 3"},  // unused ones are dropped
        {{"info", broken}, "TRUNCATED_INPUT"},
        {{"info", file("none.stl")}, "NOT_FOUND"},
        {{"info", "--session", "nobody"}, "(--session)"},
        {{"improve", touching, "--subdivide", "-1"}, "(--subdivide)"},
        {{"improve", mesh_file("cube.obj", test::cube()), "--subdivide", "1e-5"}, "LIMIT_EXCEEDED"},
    };
    for (const auto& [words, said] : refusals) {
        const CommandResult result = remotely(words);
        EXPECT_EQ(result.exit_status, 1) << said;
        EXPECT_EQ(result.out, "") << said;
        EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
    }
    EXPECT_EQ(sessions(), 0);
}

TEST_F(ServerCommandTest, AnInterruptStopsTheServersWorkToo) {
    const std::string input = mesh_file("ball.ply", test::icosphere(6));
    Command command({VSPLIT_BINARY, "improve", input, "--subdivide", "0.004", "--server", target_});
    ASSERT_TRUE(command.blocks(SIGINT, seconds(30)));
    for (int i = 0; i < 1000 && sessions() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // into the work
    ASSERT_EQ(::kill(command.pid(), SIGINT), 0);
    const CommandResult result = command.wait(seconds(30));
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_EQ(result.err, "vsplit: cancelled\n");
    EXPECT_EQ(sessions(), 0);
}

TEST_F(ServerCommandTest, AServerThatGoesAwayIsTold) {
    const std::string input = mesh_file("ball.ply", test::icosphere(6));
    Command command({VSPLIT_BINARY, "improve", input, "--subdivide", "0.004", "--server", target_});
    for (int i = 0; i < 1000 && sessions() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_EQ(::kill(server_.pid(), SIGKILL), 0);
    const CommandResult result = command.wait(seconds(60));
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_NE(result.err.find("UNAVAILABLE: server " + target_), std::string::npos) << result.err;
}

}  // namespace
}  // namespace vsplit::cli
