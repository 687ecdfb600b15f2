#include "service/machine_memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>

#include "tests/temp_directory.h"

namespace vsplit::service {
namespace {

class ControlGroupTest : public ::testing::Test {
protected:
    void write(const std::string& file, const std::string& text) {
        const auto path = scratch_.path() / file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    std::uint64_t memory() const { return control_group_memory(scratch_.path() / "groups", scratch_.path() / "self"); }

    static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
    test::TempDirectory scratch_;
};

TEST_F(ControlGroupTest, NoneLimitsNothing) {
    EXPECT_EQ(memory(), kNone);
    write("self", "0::/some\n");
    write("groups/some/memory.max", "max\n");
    EXPECT_EQ(memory(), kNone);
}

TEST_F(ControlGroupTest, OfVersion2TheLeastOnTheWayHolds) {
    write("self", "0::/system.slice/vsplitd.service\n");
    write("groups/system.slice/vsplitd.service/memory.max", "max\n");
    write("groups/system.slice/memory.max", "4096\n");
    EXPECT_EQ(memory(), 4096U);
    write("groups/system.slice/vsplitd.service/memory.max", "1024\n");
    EXPECT_EQ(memory(), 1024U);
}

TEST_F(ControlGroupTest, OfVersion1MemoryHasAGroupOfItsOwn) {
    write("self", "12:cpu,cpuacct:/a\n7:memory:/b\n0::/\n");
    write("groups/memory/a/memory.limit_in_bytes", "5\n");
    write("groups/memory/b/memory.limit_in_bytes", "512\n");
    EXPECT_EQ(memory(), 512U);
}

// It sees its group as the root, and is told of its name on the host.
TEST_F(ControlGroupTest, AContainerSeesItsOwn) {
    write("self", "7:memory:/docker/1234\n");
    write("groups/memory/memory.limit_in_bytes", "536870912\n");
    EXPECT_EQ(memory(), 536870912U);
    write("self", "0::/../..\n");
    write("groups/memory.max", "100\n");
    EXPECT_EQ(memory(), 100U);
}

TEST_F(ControlGroupTest, WhatIsNoMembershipLimitsNothing) {
    for (const char* text : {"", "memory", "7:memory", ":", "::", "7:xmemory:/b\n"}) {
        write("self", text);
        write("groups/memory/b/memory.limit_in_bytes", "512\n");
        EXPECT_EQ(memory(), kNone) << text;
    }
}

}  // namespace
}  // namespace vsplit::service
