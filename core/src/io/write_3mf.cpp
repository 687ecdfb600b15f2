#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "io/model_3mf.h"
#include "io/named_regions.h"
#include "io/text_writer.h"
#include "io/writers.h"
#include "io/xml_stream.h"
#include "io/zip_writer.h"
#include "mesh/half_edges.h"

namespace vsplit {
namespace {

constexpr std::string_view kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
constexpr std::string_view kContentTypes =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr std::string_view kRelationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

/// The mesh's sets, and one for each region that is in none of them.
std::vector<FaceSet> sets_to_write(const TriangleMesh& mesh) {
    if (mesh.regions.empty()) return {};
    std::vector<FaceSet> sets = mesh.sets;
    std::set<std::uint32_t> named{0};
    for (const FaceSet& set : sets) named.insert(set.regions.begin(), set.regions.end());
    for (const NamedRegion& region : named_regions(mesh)) {
        if (named.count(region.region) == 0) sets.push_back({region.name, {region.region}});
    }
    return sets;
}

/// Writes XML to an archive, a piece at a time.
class ModelWriter {
public:
    explicit ModelWriter(ZipWriter& archive) : archive_(archive) {}

    void put(const TriangleMesh& mesh, std::optional<LengthUnit> unit) {
        const std::vector<FaceSet> sets = sets_to_write(mesh);
        text_ << kXml << "<model";
        if (unit) text_ << " unit=\"" << unit_name_3mf(*unit) << "\"";
        text_ << " xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"";
        if (!sets.empty()) text_ << " xmlns:t=\"http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07\"";
        const std::vector<HalfEdge> twins = half_edge_twins(mesh);
        const bool closed = std::find(twins.begin(), twins.end(), kNone) == twins.end();
        text_ << ">\n<resources>\n<object id=\"1\" type=\"" << (closed ? "model" : "surface") << "\">\n<mesh>\n";
        put_mesh(mesh);
        if (!sets.empty()) put_sets(mesh, sets);
        text_ << "</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n";
        pass_on(0);
    }

private:
    void put_mesh(const TriangleMesh& mesh) {
        text_ << "<vertices>\n";
        for (const Vec3& p : mesh.positions) {
            text_ << "<vertex x=\"" << p.x() << "\" y=\"" << p.y() << "\" z=\"" << p.z() << "\"/>\n";
            pass_on(kPiece);
        }
        text_ << "</vertices>\n<triangles>\n";
        for (const Triangle& f : mesh.faces) {
            text_ << "<triangle v1=\"" << f[0] << "\" v2=\"" << f[1] << "\" v3=\"" << f[2] << "\"/>\n";
            pass_on(kPiece);
        }
        text_ << "</triangles>\n";
    }

    void put_sets(const TriangleMesh& mesh, const std::vector<FaceSet>& sets) {
        text_ << "<t:trianglesets>\n";
        const FacesOfRegions of_regions = faces_of_regions(mesh);
        for (std::size_t s = 0; s < sets.size(); ++s) {
            text_ << "<t:triangleset name=\"" << xml_escaped(sets[s].name) << "\" identifier=\"set_" << s + 1 << "\">\n";
            const std::vector<std::uint32_t> faces = faces_of_set(sets[s], of_regions);
            for (std::size_t i = 0; i < faces.size(); ++i) {
                const std::uint32_t first = faces[i];
                while (i + 1 < faces.size() && faces[i + 1] == faces[i] + 1) ++i;
                if (first == faces[i])
                    text_ << "<t:ref index=\"" << first << "\"/>\n";
                else
                    text_ << "<t:refrange startindex=\"" << first << "\" endindex=\"" << faces[i] << "\"/>\n";
                pass_on(kPiece);
            }
            text_ << "</t:triangleset>\n";
        }
        text_ << "</t:trianglesets>\n";
    }

    /// What has come to more than `least` bytes goes into the archive.
    void pass_on(std::size_t least) {
        if (text_.size() <= least) return;
        archive_.add(text_.take());
        text_ = TextWriter(kPiece + 1024);
    }

    static constexpr std::size_t kPiece = std::size_t{64} * 1024;

    ZipWriter& archive_;
    TextWriter text_{kPiece + 1024};
};

}  // namespace

std::string write_3mf(const TriangleMesh& mesh, std::optional<LengthUnit> unit) {
    ZipWriter archive;
    archive.begin("[Content_Types].xml");
    archive.add(std::string(kXml).append(kContentTypes));
    archive.begin("_rels/.rels");
    archive.add(std::string(kXml).append(kRelationships));
    archive.begin("3D/3dmodel.model");
    ModelWriter(archive).put(mesh, unit);
    return archive.take();
}

}  // namespace vsplit
