#include "service/session_features.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "service/bounded_work.h"
#include "service/guarded.h"
#include "service/memory_use.h"

namespace vsplit::service {
namespace {

Expected<std::shared_ptr<const SourceMesh>> source_of(const Session& session) {
    std::shared_ptr<const SourceMesh> source = session.snapshot().source;
    if (!source) return Error{Cause::kNotReady, "session " + session.id() + " has no mesh yet; upload one first", "session"};
    return source;
}

/// `remove_features` within the limits that methods have.
Expected<FeaturelessMesh> remove_within_limits(MeshingService& service, const TriangleMesh& mesh, const FeatureRemoval& removal,
                                               const StillWanted& wanted) {
    const Limits& limits = service.options().limits;
    const std::string what = "removing features of " + std::to_string(mesh.face_count()) + " faces";
    const Expected<MemoryBudget::Share> room = service.memory().reserve(memory_to_repair(mesh.face_count()), what);
    if (!room) return room.error();
    const BoundedWork work(what, limits, wanted);
    Expected<FeaturelessMesh> made = remove_features(mesh, removal, work.context());
    if (!made) return work.explained(made.error());
    if (made->mesh.face_count() > limits.faces) {
        return Error{Cause::kLimitExceeded,
                     "without these features the mesh has " + std::to_string(made->mesh.face_count()) +
                         " faces; the server's limit max_faces is " + std::to_string(limits.faces),
                     "ids"};
    }
    return made;
}

}  // namespace

Expected<FeaturesFound> list_features_of(MeshingService& service, std::string_view session, const FeatureSearch& search,
                                         const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = service.sessions().find(session, caller.owner);
    if (!found) return found.error();
    const Expected<std::shared_ptr<const SourceMesh>> source = source_of(**found);
    if (!source) return source.error();
    return guarded([&]() -> Expected<FeaturesFound> {
        const Expected<std::shared_ptr<const TriangleMesh>> mesh = (*source)->mesh->get();
        if (!mesh) return mesh.error();
        const Expected<MemoryBudget::Share> room =
            service.memory().borrow(memory_to_measure((*mesh)->face_count()), "looking for features of this mesh");
        if (!room) return room.error();
        Expected<std::vector<ShapeFeature>> features = list_features(**mesh, search);
        if (!features) return features.error();
        return FeaturesFound{*std::move(features), (*source)->report.unit};
    });
}

namespace {

/// Tells the metrics and the log.
void record(const MeshingService& service, const Session& session, const Caller& caller, std::uint32_t faces,
            std::chrono::steady_clock::time_point began, const Expected<FeaturesRemoved>& outcome) {
    if (!service.options().job_observer) return;
    JobRecord record{"RemoveFeatures"};
    record.session = session.id();
    record.mark = caller.mark;
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    record.faces_in = faces;
    if (outcome) {
        record.faces_out = static_cast<std::uint32_t>(outcome->made.mesh.face_count());
    } else {
        record.outcome = outcome.error().cause;
    }
    service.options().job_observer(record);
}

}  // namespace

Expected<FeaturesRemoved> remove_features_of(MeshingService& service, std::string_view session, const FeatureRemoval& removal,
                                             const StillWanted& wanted, const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = service.sessions().find(session, caller.owner);
    if (!found) return found.error();
    const std::shared_ptr<void> held = Session::hold(*found);
    if (Status idle = (*found)->require_idle(); !idle) return idle.error();
    const Expected<std::shared_ptr<const SourceMesh>> before = source_of(**found);
    if (!before) return before.error();
    const auto began = std::chrono::steady_clock::now();
    std::uint32_t faces = 0;
    Expected<FeaturesRemoved> outcome = guarded([&]() -> Expected<FeaturesRemoved> {
        const Expected<std::shared_ptr<const TriangleMesh>> whole = (*before)->mesh->get();
        if (!whole) return whole.error();
        faces = static_cast<std::uint32_t>((*whole)->face_count());
        Expected<FeaturelessMesh> made = remove_within_limits(service, **whole, removal, wanted);
        if (!made) return made.error();
        if (made->removed.empty()) return FeaturesRemoved{*std::move(made), *before};
        MeshReport report = inspect(made->mesh);
        if (!wanted()) return ExecutionContext::cancelled_error();
        report.unit = (*before)->report.unit;
        auto source = make_source(std::move(made->mesh), std::move(report), service.memory());
        if (Status set = (*found)->replace_source(*before, source); !set) return set.error();
        (*found)->touch();
        return FeaturesRemoved{*std::move(made), std::move(source)};
    });
    record(service, **found, caller, faces, began, outcome);
    return outcome;
}

}  // namespace vsplit::service
