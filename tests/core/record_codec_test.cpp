#include "vsplit/mrr/record_codec.h"

#include <gtest/gtest.h>

#include "mesh/corners.h"
#include "mesh/half_edges.h"
#include "tests/core/edited_mrr.h"
#include "tests/core/meshes.h"
#include "vsplit/mrr/base_codec.h"

namespace vsplit::test {
namespace {

const std::vector<EncodingChoice> kChoices = {{RecordEncoding::kFloat64, 0},    {RecordEncoding::kFloat32, 0},
                                              {RecordEncoding::kQuantised, 10}, {RecordEncoding::kQuantised, 14},
                                              {RecordEncoding::kQuantised, 16}, {RecordEncoding::kQuantised, 24}};

std::vector<NamedMesh> meshes() {
    return {{"sphere", bumpy_sphere(3, 0.02, 5)},
            {"plate", plate_with_holes(2)},
            {"hubs", sliver_cylinder(40, 3)},  // valences far above those with columns of their own
            {"open", punctured(torus(16, 10), {0, 35, 70, 105})},
            {"two", joined(icosphere(2), cube_frame(), Vec3(10, 0, 0))},
            {"far", joined(icosphere(1), icosphere(1), Vec3(1e9, 0, 0))}};
}

/// Both ends of a stream: the mesh of the one that encodes, and that of the one that decodes.
struct Ends {
    MultiresMesh mrr;
    PositionGrid grid;
    MultiresMesh rounded;
    RecordCodec codec;
    ProgressiveMesh mesh;

    Ends(MultiresMesh given, const EncodingChoice& choice)
        : mrr(std::move(given)), grid(*PositionGrid::over(mrr, choice)), rounded(on_grid(mrr, grid)), codec(grid), mesh(base()) {}
    [[nodiscard]] ProgressiveMesh base() const { return *ProgressiveMesh::from_base(rounded.base, mrr.ghosts); }
    [[nodiscard]] RecordBlock encode(std::size_t last) { return *codec.encode(mrr.records, mesh.records(), last, mesh); }
};

TEST(RecordCodecTest, EveryMeshIsTheRoundedOneBitForBit) {
    for (const NamedMesh& named : meshes()) {
        for (const EncodingChoice& choice : kChoices) {
            SCOPED_TRACE(named.name + ", encoding " + std::to_string(static_cast<int>(choice.encoding)) + ", " +
                         std::to_string(choice.bits));
            Ends ends(edited_mrr(named.mesh, 200, 7).mrr, choice);
            ProgressiveMesh decoded = ends.base();
            ProgressiveMesh expected = ends.base();
            RecordList records;
            const std::size_t all = ends.mrr.records.size();
            Random random(3);
            while (ends.mesh.records() < all) {  // blocks end anywhere, also between two splits
                const std::size_t from = ends.mesh.records();
                const RecordBlock block = ends.encode(std::min<std::size_t>(all, from + 1 + random.below(90)));
                EXPECT_EQ(block.first, from);
                const Status done = ends.codec.decode(block, decoded, &records);
                ASSERT_TRUE(done) << done.error().message;
                ASSERT_TRUE(expected.refine(ends.rounded.records.slice(from, block.count)));
                ASSERT_EQ(decoded.mesh(), expected.mesh());
                ASSERT_EQ(ends.mesh.mesh(), expected.mesh());
            }
            EXPECT_EQ(records, ends.rounded.records);
            EXPECT_EQ(decoded.border_splits(), ends.mrr.border_splits);
            decoded.coarsen(decoded.level());
            EXPECT_EQ(decoded.mesh(), ends.rounded.base);
        }
    }
}

TEST(RecordCodecTest, BytesDoNotDependOnHowTheMeshWasReached) {
    for (const EncodingChoice& choice : kChoices) {
        Ends ends(edited_mrr(bumpy_sphere(3, 0.02, 5), 300, 11).mrr, choice);
        const std::size_t all = ends.mrr.records.size(), half = all / 2;
        ASSERT_GT(half, 100U);
        static_cast<void>(ends.encode(half));
        const RecordBlock straight = ends.encode(all);
        ends.mesh.rewind(half / 3);
        ASSERT_TRUE(ends.mesh.refine(ends.rounded.records.slice(half / 3, all - half / 3)));
        ends.mesh.rewind(half);
        const RecordBlock back = ends.encode(all);
        EXPECT_EQ(back.payload, straight.payload);
    }
}

TEST(RecordCodecTest, RefusesDamageByTheBlocksFirstRecordAndChangesNothing) {
    for (const EncodingChoice& choice : kChoices) {
        Ends ends(edited_mrr(bumpy_sphere(2, 0.02, 5), 80, 11).mrr, choice);
        ProgressiveMesh mesh = ends.base();
        RecordList records;
        const RecordBlock first = ends.encode(30), second = ends.encode(ends.mrr.records.size());
        ASSERT_TRUE(ends.codec.decode(first, mesh, &records));
        const TriangleMesh before = mesh.mesh();
        const auto refused = [&](const RecordBlock& block, const std::string& what) {
            const Status done = ends.codec.decode(block, mesh, &records);
            ASSERT_FALSE(done) << what;
            EXPECT_EQ(done.error().cause, Cause::kCorrupt) << what;
            EXPECT_NE(done.error().message.find("from record 30 on"), std::string::npos) << done.error().message;
            EXPECT_EQ(mesh.mesh(), before) << what;
            EXPECT_EQ(records.size(), 30U) << what;
        };
        const auto with_checksum = [](RecordBlock block) {
            block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
            return block;
        };
        RecordBlock changed = second;
        changed.payload[changed.payload.size() / 2] ^= 1;
        refused(changed, "a bit turned");
        changed = second;
        changed.payload.pop_back();
        refused(changed, "cut");
        refused(with_checksum(changed), "cut, with a checksum that fits");
        changed = second;
        changed.payload.push_back('\0');
        refused(with_checksum(changed), "longer");
        changed = second;
        ++changed.count;
        refused(changed, "a record too many");
        changed = second;
        --changed.count;
        refused(changed, "a record too few");
        changed = second;
        changed.encoding = RecordEncoding{17};
        refused(changed, "an encoding that is not there");
        changed = second;
        changed.payload.clear();
        refused(with_checksum(changed), "empty");
        EXPECT_TRUE(ends.codec.decode(second, mesh, &records));
    }
}

TEST(RecordCodecTest, AnyBitThatIsTurnedIsRefusedOrGivesAClosedMesh) {
    for (const EncodingChoice& choice : {kChoices[1], kChoices[3]}) {
        Ends ends(edited_mrr(bumpy_sphere(1, 0.02, 5), 20, 11).mrr, choice);
        const RecordBlock block = ends.encode(ends.mrr.records.size());
        std::size_t accepted = 0;
        for (std::size_t bit = 0; bit < 8 * block.payload.size(); ++bit) {
            RecordBlock changed = block;
            changed.payload[bit / 8] = static_cast<char>(changed.payload[bit / 8] ^ (1 << bit % 8));
            changed.crc32c = crc32c(std::as_bytes(std::span(changed.payload)));
            ProgressiveMesh mesh = ends.base();
            if (!ends.codec.decode(changed, mesh)) continue;
            ++accepted;
            mesh.coarsen(mesh.level());
            ASSERT_EQ(mesh.mesh(), ends.rounded.base);
        }
        EXPECT_LT(accepted, 8 * block.payload.size());
    }
}

TEST(RecordCodecTest, NoBlockIsOverTheLimit) {
    // Positions without any pattern: nothing can be predicted, and nothing compressed.
    MultiresMesh mrr{tetrahedron(), {}, 0, 0, {}};
    Random random(5);
    const auto point = [&random] {
        return Vec3(1e3 * random.uniform(0, 1), 1e-3 * random.uniform(0, 1), 1e6 * random.uniform(0, 1));
    };
    for (std::uint32_t n = 0; n < 40000; ++n) mrr.records.push_back(VertexSplit{random.below(12 + 6 * n), 1, point(), point()});
    for (const EncodingChoice& choice : kChoices) {
        Ends ends(mrr, choice);
        ProgressiveMesh decoded = ends.base();
        while (ends.mesh.records() < mrr.records.size()) {
            const RecordBlock block = ends.encode(mrr.records.size());
            ASSERT_LE(block.payload.size(), kMaxBlockBytes);
            ASSERT_TRUE(ends.codec.decode(block, decoded));
        }
        EXPECT_EQ(decoded.mesh(), ends.mesh.mesh());
    }
}

TEST(RecordCodecTest, CompactBlocksAreCompact) {
    // A surface as methods make it: quartered and smooth.
    MultiresMesh mrr = edited_mrr(icosphere(4), 1500, 3).mrr;
    const auto bytes_a_split = [&mrr](const EncodingChoice& choice) {
        Ends ends(mrr, choice);
        std::size_t bytes = 0;
        while (ends.mesh.records() < mrr.records.size()) bytes += ends.encode(mrr.records.size()).payload.size();
        return static_cast<double>(bytes) / static_cast<double>(mrr.levels());
    };
    const double exact = bytes_a_split(kChoices[0]), single = bytes_a_split(kChoices[1]), grid = bytes_a_split(kChoices[3]);
    EXPECT_LT(single, exact / 2);
    EXPECT_LT(grid, single * 0.7);
}

/// The same splits, but every third `kept` and every third `added` lies `off` the mean of its ring, the other one included.
MultiresMesh with_means(const MultiresMesh& mrr, const Vec3& off) {
    MultiresMesh result{mrr.base, {}, mrr.ghosts, mrr.ghost_faces, mrr.border_splits, {}, {}};
    ProgressiveMesh mesh = *ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    for_each_record(mrr.records.slice(0, mrr.records.size()), [&](auto record) {
        if constexpr (std::is_same_v<decltype(record), VertexSplit>) {
            const TriangleMesh& now = mesh.mesh();
            Vec3 fan = record.kept, rest = record.added;
            std::uint32_t valence = 0;
            HalfEdge corner = record.anchor;
            do {
                const Vec3& neighbour = now.positions[now.faces[next(corner) / 3][next(corner) % 3]];
                if (valence <= record.steps) fan += neighbour;
                if (valence >= record.steps || valence == 0) rest += neighbour;
                ++valence;
                corner = mesh.twins()[prev(corner)];
            } while (corner != record.anchor);
            if (mesh.level() % 3 == 0) record.added = off + fan / (record.steps + 2.0);
            if (mesh.level() % 3 == 1) record.kept = off + rest / (valence - record.steps + 2.0);
        }
        EXPECT_TRUE(mesh.refine(record));
        result.records.push_back(record);
    });
    return result;
}

TEST(RecordCodecTest, PointsThatAreTheMeanOfTheirRingTakeFewerBytes) {
    const MultiresMesh any = edited_mrr(bumpy_sphere(4, 0.02, 5), 1500, 3).mrr;
    const MultiresMesh near = with_means(any, Vec3::Constant(0.01)), exact = with_means(any, Vec3::Zero());
    for (const EncodingChoice& choice : {kChoices[1], kChoices[3], kChoices[4]}) {
        std::size_t bytes[2] = {0, 0};
        for (const bool is_exact : {false, true}) {
            Ends ends(is_exact ? exact : near, choice);
            ProgressiveMesh decoded = ends.base();
            RecordList records;
            while (ends.mesh.records() < any.records.size()) {
                const RecordBlock block = ends.encode(any.records.size());
                bytes[is_exact ? 1 : 0] += block.payload.size();
                ASSERT_TRUE(ends.codec.decode(block, decoded, &records));
            }
            EXPECT_EQ(records, ends.rounded.records);
            EXPECT_EQ(decoded.mesh(), ends.mesh.mesh());
        }
        EXPECT_LT(static_cast<double>(bytes[1]), 0.92 * static_cast<double>(bytes[0])) << choice.bits;
    }
}

TEST(RecordCodecTest, ALayoutThatIsNotKnownIsRefused) {
    for (const EncodingChoice& choice : {kChoices[1], kChoices[3]}) {
        Ends ends(edited_mrr(bumpy_sphere(1, 0.02, 5), 20, 11).mrr, choice);
        RecordBlock block = ends.encode(ends.mrr.records.size());
        block.payload[0] = static_cast<char>(choice.bits | 2U << 5U);
        block.crc32c = crc32c(std::as_bytes(std::span(block.payload)));
        ProgressiveMesh mesh = ends.base();
        const Status done = ends.codec.decode(block, mesh);
        ASSERT_FALSE(done);
        EXPECT_NE(done.error().message.find("its layout is 2; this program reads layouts up to 1"), std::string::npos)
            << done.error().message;
    }
}

TEST(BaseCodecTest, BaseMeshesComeBackBitForBit) {
    std::vector<NamedMesh> all = meshes();
    all.push_back({"tetrahedron", tetrahedron()});
    for (const NamedMesh& named : all) {
        const MultiresMesh mrr = edited_mrr(named.mesh, named.name == "tetrahedron" ? 0 : 10, 7).mrr;
        for (const EncodingChoice& choice : std::span(kChoices).subspan(1)) {
            const PositionGrid grid = *PositionGrid::over(mrr, choice);
            TriangleMesh base = on_grid(mrr, grid).base;
            for (const bool walk : {true, false}) {
                SCOPED_TRACE(named.name + (walk ? ", as the walk goes" : ", in another order"));
                if (!walk) std::swap(base.faces.front(), base.faces.back());
                const std::string packed = pack_base(base, mrr.ghosts, grid);
                EXPECT_EQ(packed[1], walk ? 0 : 1);
                const PackedBase bytes{std::as_bytes(std::span(packed)), base.vertex_count(), base.face_count(), mrr.ghosts};
                const auto unpacked = unpack_base(bytes, grid);
                ASSERT_TRUE(unpacked) << unpacked.error().message;
                EXPECT_EQ(*unpacked, base);
                for (std::size_t size = 0; size < packed.size(); ++size) {
                    PackedBase cut = bytes;
                    cut.bytes = bytes.bytes.first(size);
                    ASSERT_FALSE(unpack_base(cut, grid)) << size;
                }
                PackedBase more = bytes;
                ++more.faces;
                EXPECT_FALSE(unpack_base(more, grid));
            }
        }
    }
}

TEST(BaseCodecTest, BasesOfMethodsTakeFewBytes) {
    const MultiresMesh mrr = edited_mrr(icosphere(4), 300, 7).mrr;
    const PositionGrid grid = *PositionGrid::over(mrr, {RecordEncoding::kQuantised, 14});
    const TriangleMesh base = on_grid(mrr, grid).base;
    EXPECT_LT(pack_base(base, mrr.ghosts, grid).size(), 5U * base.vertex_count());
}

}  // namespace
}  // namespace vsplit::test
