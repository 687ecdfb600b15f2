#include "service/session_snapshot.h"

#include <algorithm>

#include "service/quoted.h"

namespace vsplit::service {
namespace {

std::string ids_of(const SessionSnapshot& session) {
    std::string ids;
    for (const SessionSnapshot::RepresentationPointer& existing : session.representations) ids += ' ' + existing->id();
    return ids;
}

Error unknown_representation(const SessionSnapshot& session, std::string_view id) {
    std::string message = "the session has no representation " + quoted(id);
    if (session.representations.empty()) return {Cause::kNotFound, message + "; it has none yet", "representation"};
    return {Cause::kNotFound, message + "; it has" + ids_of(session), "representation"};
}

Error no_resolutions(const SessionSnapshot& session, std::uint32_t faces) {
    std::string message =
        "faces is " + std::to_string(faces) +
        ", which chooses a resolution, but the upload has one only; accepted is faces together with the id of a "
        "representation, or neither";
    if (!session.representations.empty()) message += "; the session has" + ids_of(session);
    return {Cause::kInvalidOption, message, "faces"};
}

}  // namespace

Expected<SessionSnapshot::RepresentationPointer> find_representation(const SessionSnapshot& session, std::string_view id) {
    const auto found = std::find_if(session.representations.begin(), session.representations.end(),
                                    [id](const SessionSnapshot::RepresentationPointer& r) { return r->id() == id; });
    if (found == session.representations.end()) return unknown_representation(session, id);
    return *found;
}

Expected<SessionSnapshot::RepresentationPointer> newest_representation(const SessionSnapshot& session) {
    if (session.representations.empty()) {
        return Error{Cause::kNotReady, "the session has no representation yet; Improve or Control makes one", "session"};
    }
    return session.representations.back();
}

Expected<PickedMesh> PickedMesh::pick(const SessionSnapshot& session, const MeshRef& ref) {
    PickedMesh picked;
    if (session.source == nullptr) {
        return Error{Cause::kNotReady, "the session has no mesh yet; UploadMesh gives it one", "session"};
    }
    if (ref.representation.empty()) {
        if (ref.faces != 0) return no_resolutions(session, ref.faces);
        picked.upload_ = session.source;
        return picked;
    }
    Expected<SessionSnapshot::RepresentationPointer> found = find_representation(session, ref.representation);
    if (!found) return found.error();
    picked.representation_ = *found;
    picked.faces_ = ref.faces == 0 ? (*found)->figures().faces : ref.faces;
    return picked;
}

std::optional<LengthUnit> PickedMesh::unit() const { return upload_ ? upload_->report.unit : representation_->figures().unit; }

Status PickedMesh::require_accepted() const {
    if (upload_) return require_manifold(upload_->report);
    return Done{};
}

Expected<OpenedMesh> PickedMesh::open() const { return upload_ ? open_upload() : open_level(); }

Expected<OpenedMesh> PickedMesh::open_upload() const {
    Expected<std::shared_ptr<const TriangleMesh>> mesh = upload_->mesh->get();
    if (!mesh) return mesh.error();
    return OpenedMesh{{std::string(), (*mesh)->face_count()}, *std::move(mesh), upload_->report.quality};
}

Expected<OpenedMesh> PickedMesh::open_level() const {
    const Expected<std::shared_ptr<const Levels>> levels = representation_->levels().get();
    if (!levels) return levels.error();
    const MultiresMesh& mrr = (*levels)->mrr();
    const std::size_t level = mrr.level_for(faces_);
    const MethodFigures& figures = representation_->figures();
    OpenedMesh opened{{representation_->id(), mrr.faces_at(level)}, (*levels)->mesh(level), std::nullopt};
    if (opened.ref.faces == figures.faces) opened.known_quality = figures.quality;
    return opened;
}

}  // namespace vsplit::service
