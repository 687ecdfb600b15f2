#include "service/source_mesh.h"

#include <algorithm>
#include <string>
#include <utility>

#include "service/guarded.h"
#include "service/memory_use.h"
#include "vsplit/io/read_mesh.h"
#include "vsplit/mesh/weld.h"

namespace vsplit::service {

Status check_settings(const MeshSettings& settings) {
    TriangleMesh none;  // the rule for tolerances is the weld's; asked with nothing to merge it costs nothing
    const Expected<WeldCounts> welded = weld(none, settings.weld);
    if (!welded) return welded.error();
    return settings.repair ? check_options(*settings.repair) : Done{};
}

namespace {

/// With the server's limit by its name, where a reader knows but a number.
Error explained(Error error, const Limits& limits) {
    if (error.cause == Cause::kLimitExceeded &&
        error.message.find("limit of " + std::to_string(limits.faces)) != std::string::npos)
        error.message += ", the server's max_faces";
    return error;
}

}  // namespace

std::shared_ptr<const SourceMesh> make_source(TriangleMesh mesh, MeshReport report, MemoryBudget& budget) {
    const std::uint64_t bytes = memory_of(mesh);
    auto kept = Kept<TriangleMesh>::hold(std::make_shared<const TriangleMesh>(std::move(mesh)), bytes, budget);
    return std::make_shared<const SourceMesh>(SourceMesh{std::move(kept), std::move(report)});
}

Expected<std::shared_ptr<const SourceMesh>> read_source(std::span<const std::byte> bytes, const MeshSettings& settings,
                                                        const Limits& limits, MemoryBudget& budget, const StillWanted& wanted) {
    return guarded([&]() -> Expected<std::shared_ptr<const SourceMesh>> {
        const ReadingEstimate estimate = estimate_reading(bytes, settings.repair.has_value());
        // What a file of this size usually has; where it has more faces or vertices, as polygons of many corners do, it is read
        // anew.
        constexpr std::uint64_t kMore = 2;
        std::uint64_t most = 0;
        MemoryBudget::Share room;
        Expected<ReadResult> read = Error{};
        do {
            most = std::min<std::uint64_t>(most == 0 ? estimate.faces : kMore * most, limits.faces);
            room.give_back();
            Expected<MemoryBudget::Share> share = budget.reserve(estimate.bytes_a_face * most, "reading this mesh");
            if (!share) return share.error();
            room = *std::move(share);
            read = read_mesh(bytes, {settings.format, settings.weld, static_cast<std::uint32_t>(most), settings.unit});
        } while (!read && read.error().cause == Cause::kLimitExceeded && most < limits.faces);
        if (!read) return explained(read.error(), limits);
        const BoundedWork work("reading this mesh", limits, wanted);
        Expected<MeshReport> report = inspect_source(read->mesh, read->weld, settings.repair, work.context());
        if (!report) return work.explained(report.error());
        report->unit = read->unit;
        return make_source(std::move(read->mesh), *std::move(report), budget);
    });
}

}  // namespace vsplit::service
