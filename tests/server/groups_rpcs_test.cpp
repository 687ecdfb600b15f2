// Groups of faces over the wire: in a session, in lists of sessions, and of a representation at any resolution.
#include <gtest/gtest.h>

#include <string>

#include "test_client.h"
#include "test_server.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

/// In `regions` of the same size, the first of them called "wall".
std::string file_in_regions(TriangleMesh mesh, std::uint32_t regions) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) mesh.regions.push_back(1 + f % regions);  // 0 has no name in MSH
    mesh.sets = {{"wall", {1}}};
    return file_of(mesh, MeshFormat::kMsh);
}

TEST(GroupsRpcsTest, ASessionTellsThem) {
    TestServer server;
    const auto created = create_session(server.stub(), file_in_regions(icosphere(2), 160));
    ASSERT_TRUE(created.status.ok()) << created.status.error_message();
    const v1::MeshSummary& source = created.message.source();
    EXPECT_EQ(source.group_count(), 160U);
    ASSERT_EQ(source.groups_size(), 100) << "no more are listed";
    EXPECT_EQ(source.groups(0).name(), "wall");
    EXPECT_EQ(source.groups(0).faces(), 2U);
    EXPECT_EQ(source.groups(99).faces(), 2U);
    EXPECT_EQ(get_session(server.stub(), created.message.id()).message.source().groups_size(), 100);
    v1::ListSessionsResponse list;
    ASSERT_TRUE(server.stub().ListSessions(call().get(), {}, &list).ok());
    EXPECT_EQ(list.sessions(0).source().groups_size(), 10);
    EXPECT_EQ(list.sessions(0).source().group_count(), 160U);
}

TEST(GroupsRpcsTest, EveryResolutionTellsItsOwn) {
    TestServer server;
    const std::string session = create_session(server.stub(), file_in_regions(torus(20, 12), 2)).message.id();
    const Received made = improve(server.stub(), small_improve(session));
    ASSERT_TRUE(made.status.ok()) << made.status.error_message();
    for (const std::uint32_t faces : {made.representation->faces(), made.representation->faces_max()}) {
        v1::SetResolutionRequest request;
        request.set_session(session);
        request.set_faces(faces);
        const Received at = set_resolution(server.stub(), request);
        ASSERT_TRUE(at.status.ok());
        ASSERT_EQ(at.representation->groups_size(), 2) << faces;
        EXPECT_EQ(at.representation->groups(0).name(), "wall");
        EXPECT_EQ(at.representation->groups(0).faces() + at.representation->groups(1).faces(), faces);
    }
}

}  // namespace
}  // namespace vsplit::test
