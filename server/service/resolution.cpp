#include "service/resolution.h"

#include <algorithm>
#include <string>
#include <utility>

#include "vsplit/mrr/progressive_mesh.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit::service {
namespace {

Expected<std::size_t> level_held(const MultiresMesh& mrr, std::uint32_t faces_held) {
    const std::size_t level = mrr.level_for(faces_held);
    if (mrr.faces_at(level) == faces_held) return level;
    return Error{Cause::kInvalidOption,
                 "faces_held is " + std::to_string(faces_held) +
                     ", which is no resolution of this representation; the nearest is " + std::to_string(mrr.faces_at(level)) +
                     " (it has " + std::to_string(mrr.faces_min()) + " to " + std::to_string(mrr.faces_max()) +
                     (mrr.border_splits.empty() ? " in steps of 2" : " in steps of 1 or 2") + "; 0 means that nothing is held)",
                 "faces_held"};
}

Status check_resume(const MultiresMesh& mrr, std::uint32_t resume_from) {
    if (resume_from <= mrr.records.size()) return Done{};
    return Error{Cause::kInvalidOption,
                 "resume_from is " + std::to_string(resume_from) + "; this representation has " +
                     std::to_string(mrr.records.size()) + " records, so at most that is accepted",
                 "resume_from"};
}

/// Bytes of a mesh as it is sent in the encoding kFloat64, its regions included.
std::size_t mesh_bytes(const MultiresMesh& mrr, std::size_t vertices, std::size_t faces) {
    return vertices * sizeof(Vec3) + faces * sizeof(Triangle) + mrr.regions.size() * sizeof(std::uint32_t);
}

std::size_t bytes_between(const ResolutionPlan& plan) {
    const MultiresMesh& mrr = plan.levels->mrr();
    const RecordSpan records = mrr.records.slice(plan.first_record, plan.last_record - plan.first_record);
    return (plan.with_base ? mesh_bytes(mrr, mrr.base.positions.size(), mrr.base.faces.size()) : 0) +
           records.splits.size() * record_bytes(RecordKind::kSplit) + records.flips.size() * record_bytes(RecordKind::kFlip) +
           records.moves.size() * record_bytes(RecordKind::kMove);
}

/// Where the mesh at the plan's end is less to send than the way to it, that is sent.
Status take_keyframe(ResolutionPlan& plan) {
    const MultiresMesh& mrr = plan.levels->mrr();
    if (plan.last_record == plan.first_record ||
        mesh_bytes(mrr, mrr.base.positions.size() + plan.level, mrr.base.faces.size() + 2 * plan.level) >= bytes_between(plan))
        return Done{};
    Expected<ProgressiveMesh> mesh = ProgressiveMesh::from_base(mrr.base, mrr.ghosts);
    if (!mesh) return mesh.error();
    if (Status refined = mesh->refine(mrr.records.slice(0, plan.last_record)); !refined) return refined;
    plan.keyframe = std::make_shared<const TriangleMesh>(mesh->mesh());
    plan.with_base = true;
    plan.first_record = plan.last_record;
    return Done{};
}

}  // namespace

Expected<SessionSnapshot::RepresentationPointer> find_requested(const SessionSnapshot& session,
                                                                const ResolutionRequest& request) {
    return request.representation.empty() ? newest_representation(session) : find_representation(session, request.representation);
}

Expected<ResolutionPlan> plan_resolution(SessionSnapshot::RepresentationPointer representation,
                                         const ResolutionRequest& request) {
    const Expected<std::shared_ptr<const Levels>> levels = representation->levels().get();
    if (!levels) return levels.error();
    const MultiresMesh& mrr = (*levels)->mrr();
    if (Status ok = check_resume(mrr, request.resume_from); !ok) return ok.error();
    ResolutionPlan plan = plan_from_nothing(std::move(representation), *levels, request.faces);
    if (request.faces_held != 0) {
        const Expected<std::size_t> held = level_held(mrr, request.faces_held);
        if (!held) return held.error();
        plan.first_record = mrr.record_of_level(*held);
    }
    // A record comes after the whole base mesh, so who has one has the base mesh too.
    plan.with_base = request.faces_held == 0 && request.resume_from == 0;
    plan.first_record = std::max<std::size_t>(plan.first_record, request.resume_from);
    plan.last_record = std::max(plan.first_record, plan.last_record);
    if (!request.keyframe) return plan;
    if (Status taken = take_keyframe(plan); !taken) return taken.error();
    return plan;
}

ResolutionPlan plan_from_nothing(SessionSnapshot::RepresentationPointer representation, std::shared_ptr<const Levels> levels,
                                 std::uint32_t faces) {
    const std::size_t level = levels->mrr().level_for(faces);
    const std::size_t records = levels->mrr().record_of_level(level);
    return {std::move(representation), std::move(levels), level, true, 0, records};
}

}  // namespace vsplit::service
