#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "vsplit/features/face_normals.h"
#include "vsplit/features/sharp_edges.h"
#include "vsplit/quality/stretch.h"
#include "vsplit/vsplit.h"
using namespace vsplit;
int main(int argc, char** argv) {
    ImproveOptions o;
    double weld = 0;
    std::string out;
    o.mode = Mode::kStrict;
    for (int i = 2; i < argc; ++i) {
        std::string a = argv[i];
        if (a == "-x")
            o.mode = Mode::kExtended;
        else if (a == "-s")
            o.subdivision_size = atof(argv[++i]);
        else if (a == "-t")
            o.tolerance = atof(argv[++i]);
        else if (a == "-w")
            o.feature_weight = atof(argv[++i]);
        else if (a == "-f") {
            o.faces = atoi(argv[++i]);
        } else if (a == "-m") {
            o.faces_min = atoi(argv[++i]);
        } else if (a == "-weld")
            weld = atof(argv[++i]);
        else if (a == "-o")
            out = argv[++i];
    }
    if (!o.faces_min && o.faces) o.faces_min = o.faces;
    auto m = read_mesh_file(argv[1], {.weld = weld});
    if (!m) {
        puts(m.error().message.c_str());
        return 1;
    }
    ExecutionContext c({}, 1);
    auto r = improve(m->mesh, o, {}, c);
    if (!r) {
        puts(r.error().message.c_str());
        return 1;
    }
    const Quality& q = r->quality;
    printf("%s dense %u faces %u min %.3f p01 %.3f mean %.4f <.2 %u valence %u  %.2fs\n",
           argv[1] + std::string(argv[1]).rfind('/') + 1, r->faces_subdivided, q.faces, q.stretch_min, q.stretch_p01,
           q.stretch_mean, q.faces_below_02, q.valence_max, r->elapsed.count());
    if (getenv("AN")) {
        TriangleMesh r2 = mesh_at(r->mrr, r->mrr.level_for(r->faces));
        auto fn = face_normals(r2);
        auto se = find_sharp_edges(r2, fn, {40, 1});
        std::vector<int> deg(r2.vertex_count(), 0), val(r2.vertex_count(), 0);
        for (auto& e : se) {
            ++deg[e.a];
            ++deg[e.b];
        }
        for (auto& f : r2.faces)
            for (auto v : f) ++val[v];
        int hist[4] = {}, all[4] = {}, vh[12] = {}, ch[4] = {};
        for (auto& f : r2.faces) {
            double st = stretch(r2.positions[f[0]], r2.positions[f[1]], r2.positions[f[2]]);
            int c = 0, vmax = 0, corner = 0;
            for (auto v : f) {
                c += deg[v] > 0;
                corner += deg[v] != 0 && deg[v] != 2;
                vmax = std::max(vmax, val[v] >= 8 || val[v] <= 4 ? val[v] : 0);
            }
            ++all[c];
            if (st < q.stretch_p01) {
                ++hist[c];
                ++vh[std::min(vmax, 11)];
                ++ch[corner];
            }
        }
        printf(
            "worst by crease verts %d %d %d %d  of %d %d %d %d; by odd valence 0:%d 3:%d 4:%d 8:%d 9:%d; corners %d %d %d %d\n",
            hist[0], hist[1], hist[2], hist[3], all[0], all[1], all[2], all[3], vh[0], vh[3], vh[4], vh[8], vh[9], ch[0], ch[1],
            ch[2], ch[3]);
    }
    if (!out.empty()) (void)write_mesh_file(mesh_at(r->mrr, r->mrr.level_for(r->faces)), MeshFormat::kPlyBinary, out);
}
