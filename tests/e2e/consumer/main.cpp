#include <vsplit/vsplit.h>

#include <cstdio>

namespace {

// A block of 3 x 1 x 1.
vsplit::TriangleMesh block() {
    return {{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}, {0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {0, 1, 1}},
            {{0, 2, 1},
             {0, 3, 2},
             {4, 5, 6},
             {4, 6, 7},
             {0, 1, 5},
             {0, 5, 4},
             {1, 2, 6},
             {1, 6, 5},
             {2, 3, 7},
             {2, 7, 6},
             {3, 0, 4},
             {3, 4, 7}}};
}

int fail(const vsplit::Error& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: consumer FILE.obj\n");
        return 1;
    }
    vsplit::ImproveOptions options;
    options.subdivision_size = 0.25;
    const vsplit::ExecutionContext context;
    const auto result = vsplit::improve(block(), options, {}, context);
    if (!result) return fail(result.error());

    const vsplit::TriangleMesh mesh = vsplit::mesh_at(result->mrr, result->mrr.level_for(result->faces));
    const auto written = vsplit::write_mesh_file(mesh, vsplit::MeshFormat::kObj, argv[1]);
    if (!written) return fail(written.error());
    std::printf("improved to %u faces, mean stretch %.3f\n", mesh.face_count(), result->quality.stretch_mean);
    return result->quality.stretch_mean > 0.5 ? 0 : 1;
}
