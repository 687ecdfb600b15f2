#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "stream_test.h"
#include "tests/core/meshes.h"

namespace vsplit::test {
namespace {

using Case = std::tuple<std::filesystem::path, v1::Mode, EncodingChoice>;

/// Meshes of the real world, improved by default options. Nothing where that collection is not on this machine.
class RealStreamTest : public StreamTest, public ::testing::WithParamInterface<Case> {
protected:
    void SetUp() override {
        client::MeshingClient client = connect();
        const auto session = client.create_session();
        ASSERT_TRUE(session) << session.error().message;
        const auto uploaded = client.upload_mesh(session->id(), std::get<0>(GetParam()));
        ASSERT_TRUE(uploaded) << uploaded.error().message;
        v1::ImproveOptions options;
        options.set_mode(std::get<1>(GetParam()));
        improve_session(session->id(), options);
    }
    [[nodiscard]] static const EncodingChoice& choice() { return std::get<2>(GetParam()); }
};

TEST_P(RealStreamTest, AThousandJumpsGiveWhatDownloadMeshGives) { jump(choice(), 1000); }

TEST_P(RealStreamTest, AConnectionThatIsCutFiftyTimesStartsNothingOver) { cut_fifty_times(choice()); }

std::vector<std::filesystem::path> meshes() {
    std::vector<std::filesystem::path> paths;
    for (std::filesystem::path& path : shared_closed_meshes()) {
        if (path.filename() == "cad_counter_assembly_84k.stl" || path.filename() == "scan_nefertiti_70k.obj")
            paths.push_back(std::move(path));
    }
    return paths;
}

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
    const auto& [path, mode, choice] = info.param;
    return test_name(path) + '_' + v1::Mode_Name(mode) +
           (choice.bits == 0 ? "_FLOAT64" : '_' + std::to_string(choice.bits) + "_bits");
}

INSTANTIATE_TEST_SUITE_P(Shared, RealStreamTest,
                         ::testing::Combine(::testing::ValuesIn(meshes()), ::testing::Values(v1::STRICT, v1::EXTENDED),
                                            ::testing::Values(EncodingChoice{RecordEncoding::kFloat64, 0},
                                                              EncodingChoice{RecordEncoding::kQuantised, 14})),
                         case_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RealStreamTest);

}  // namespace
}  // namespace vsplit::test
