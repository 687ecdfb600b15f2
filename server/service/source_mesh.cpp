#include "service/source_mesh.h"

#include <utility>

#include "service/guarded.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit::service {

Status check_settings(const MeshSettings& settings) {
    TriangleMesh none;  // the rule for tolerances is the weld's; asked with nothing to merge it costs nothing
    const Expected<WeldCounts> welded = weld(none, settings.weld);
    if (!welded) return welded.error();
    return Done{};
}

Expected<std::shared_ptr<const SourceMesh>> read_source(std::span<const std::byte> bytes, const MeshSettings& settings,
                                                        const Limits& limits) {
    return guarded([&]() -> Expected<std::shared_ptr<const SourceMesh>> {
        Expected<ReadResult> read = read_mesh(bytes, {settings.format, settings.weld, limits.faces});
        if (!read) return read.error();
        Expected<MeshReport> report = inspect_source(read->mesh, read->weld, settings.repair);
        if (!report) return report.error();
        return std::make_shared<const SourceMesh>(
            SourceMesh{std::make_shared<const TriangleMesh>(std::move(read->mesh)), *std::move(report)});
    });
}

}  // namespace vsplit::service
