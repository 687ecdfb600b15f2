#include "service/session_snapshot.h"

#include <algorithm>

#include "service/quoted.h"

namespace vsplit::service {
namespace {

Error unknown_representation(const SessionSnapshot& session, std::string_view id) {
    std::string message = "the session has no representation " + quoted(id);
    if (session.representations.empty()) return {Cause::kNotFound, message + "; it has none yet", "representation"};
    message += "; it has";
    for (const SessionSnapshot::RepresentationPointer& existing : session.representations) message += ' ' + existing->id();
    return {Cause::kNotFound, message, "representation"};
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
        picked.upload_ = session.source;
        return picked;
    }
    Expected<SessionSnapshot::RepresentationPointer> found = find_representation(session, ref.representation);
    if (!found) return found.error();
    picked.representation_ = *found;
    picked.level_ = picked.representation_->level_for(ref.faces);
    return picked;
}

MeshRef PickedMesh::ref() const { return {upload_ ? std::string() : representation_->id(), faces()}; }

std::uint32_t PickedMesh::faces() const {
    return upload_ ? upload_->mesh->face_count() : representation_->mrr().faces_at(level_);
}

Status PickedMesh::require_accepted() const {
    if (upload_) return require_manifold(upload_->report);
    return Done{};
}

std::shared_ptr<const TriangleMesh> PickedMesh::mesh() const { return upload_ ? upload_->mesh : representation_->mesh(level_); }

Quality PickedMesh::quality() const { return upload_ ? upload_->report.quality : representation_->quality(level_); }

}  // namespace vsplit::service
