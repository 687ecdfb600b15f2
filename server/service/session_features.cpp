#include "service/session_features.h"

#include <utility>

#include "service/guarded.h"

namespace vsplit::service {
namespace {

Expected<std::shared_ptr<const SourceMesh>> source_of(const Session& session) {
    std::shared_ptr<const SourceMesh> source = session.snapshot().source;
    if (!source) return Error{Cause::kNotReady, "session " + session.id() + " has no mesh yet; upload one first", "session"};
    return source;
}

}  // namespace

Expected<std::vector<ShapeFeature>> list_features_of(MeshingService& service, std::string_view session,
                                                     const FeatureSearch& search, const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = service.sessions().find(session, caller.owner);
    if (!found) return found.error();
    const Expected<std::shared_ptr<const SourceMesh>> source = source_of(**found);
    if (!source) return source.error();
    return guarded([&] { return list_features(*(*source)->mesh, search); });
}

Expected<FeaturesRemoved> remove_features_of(MeshingService& service, std::string_view session, const FeatureRemoval& removal,
                                             const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = service.sessions().find(session, caller.owner);
    if (!found) return found.error();
    if (Status idle = (*found)->require_idle(); !idle) return idle.error();
    const Expected<std::shared_ptr<const SourceMesh>> before = source_of(**found);
    if (!before) return before.error();
    return guarded([&]() -> Expected<FeaturesRemoved> {
        const ExecutionContext context;
        Expected<FeaturelessMesh> made = remove_features(*(*before)->mesh, removal, context);
        if (!made) return made.error();
        if (made->removed.empty()) return FeaturesRemoved{*std::move(made), *before};
        const auto mesh = std::make_shared<const TriangleMesh>(std::move(made->mesh));
        auto source = std::make_shared<const SourceMesh>(SourceMesh{mesh, inspect(*mesh)});
        if (Status set = (*found)->replace_source(*before, source); !set) return set.error();
        (*found)->touch();
        return FeaturesRemoved{*std::move(made), std::move(source)};
    });
}

}  // namespace vsplit::service
