#include "service/encoded_records.h"

#include <gtest/gtest.h>

#include "tests/core/meshes.h"
#include "vsplit/mrr/base_codec.h"
#include "vsplit/mrr/position_grid.h"

namespace vsplit::service {
namespace {

TEST(EncodedRecordsTest, TheBaseMeshIsMadeOnceForAllReaders) {
    MultiresMesh mrr;
    mrr.base = test::torus(24, 12);
    mrr.records.push_back(VertexMove{0, Vec3(7, 0.1, 0.2)});
    for (const EncodingChoice& choice :
         {EncodingChoice{RecordEncoding::kFloat32, 0}, EncodingChoice{RecordEncoding::kQuantised, 14}}) {
        EncodedRecords encoded(mrr, box_of_all(mrr), choice);
        const std::shared_ptr<const EncodedBase> base = encoded.base();
        EXPECT_EQ(base, encoded.base());
        EXPECT_EQ(base->bytes, pack_base(on_grid(mrr, encoded.grid()).base, 0, encoded.grid()));
        EXPECT_EQ(base->max_error, encoded.grid().max_error(7));  // of the largest coordinate, which only a record has
    }
}

}  // namespace
}  // namespace vsplit::service
