#include "service/meshing_service.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

namespace vsplit::service {
namespace {

constexpr unsigned kDiskThreads = 2;

unsigned cores() { return std::max(1U, std::thread::hardware_concurrency()); }

std::chrono::milliseconds sweep_interval(std::chrono::milliseconds ttl) {
    return std::clamp<std::chrono::milliseconds>(ttl / 4, std::chrono::milliseconds(20), std::chrono::seconds(10));
}

}  // namespace

MeshingService::MeshingService(const ServiceOptions& options, std::unique_ptr<SessionArchive> archive)
    : options_(options),
      memory_(options.limits.memory_bytes),
      archive_(std::move(archive)),
      upload_room_(*archive_, options.limits.disk_bytes),
      methods_(options.workers == 0 ? cores() : options.workers),
      errands_(std::max(2U, cores())),
      intake_(std::max(2U, cores())),
      disk_(kDiskThreads),
      sessions_({options_, memory_, *archive_, methods_}),
      sweeper_(sweep_interval(options.session_ttl), [this] { sweep(); }) {}

void MeshingService::sweep() {
    sessions_.remove_expired();
    static_cast<void>(sessions_.note_time());  // where the archive cannot be written to, uploads and methods say so
}

MeshingService::~MeshingService() { shutdown(); }

Expected<SessionSnapshot> MeshingService::snapshot(std::string_view session, const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = sessions_.find(session, caller.owner);
    if (!found) return found.error();
    return (*found)->snapshot();
}

Expected<SessionSnapshot> MeshingService::keep_alive(std::string_view session, const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = sessions_.find(session, caller.owner);
    if (!found) return found.error();
    if (Status noted = sessions_.note_use(*found); !noted) return noted.error();
    return (*found)->snapshot();
}

Expected<SessionSnapshot> MeshingService::create_session(const Caller& caller) {
    const Expected<std::shared_ptr<Session>> created = sessions_.create(nullptr, caller.owner);
    if (!created) return created.error();
    return (*created)->snapshot();
}

Expected<SessionSnapshot> MeshingService::create_session(std::span<const std::byte> bytes, const MeshSettings& settings,
                                                         const Caller& caller, const StillWanted& wanted) {
    if (Status fits = check_upload_bytes(bytes.size(), options_.limits, "mesh"); !fits) return fits.error();
    if (Status room = sessions_.require_room(caller.owner); !room) return room.error();
    if (Status ok = check_settings(settings); !ok) return ok.error();
    Expected<std::shared_ptr<const SourceMesh>> source = read_source(bytes, settings, options_.limits, memory_, wanted);
    if (!source) return source.error();
    if (!wanted()) return ExecutionContext::cancelled_error();
    const Expected<std::shared_ptr<Session>> created = sessions_.create(*std::move(source), caller.owner);
    if (!created) return created.error();
    return (*created)->snapshot();
}

Expected<Upload> MeshingService::begin_upload(std::string_view session, const UploadSettings& settings, const Caller& caller) {
    Expected<std::shared_ptr<Session>> found = sessions_.find(session, caller.owner);
    if (!found) return found.error();
    return Upload::begin(*std::move(found), settings, options_, memory_, upload_room_);
}

Expected<RunningMethod> MeshingService::start(std::string_view session, const MethodRequest& request, JobEvents events,
                                              const Caller& caller) {
    const Expected<std::shared_ptr<Session>> found = sessions_.find(session, caller.owner);
    if (!found) return found.error();
    if (Status room = require_room_in_queue(); !room) return room.error();
    if (Status ok = std::visit([](const auto& options) { return check_options(options); }, request.options); !ok)
        return ok.error();
    const auto noted = events.on_noted;
    auto note = std::make_shared<JobNote>(*archive_, (*found)->number(), request);
    const auto make = [&](const SessionSnapshot& now) -> Expected<std::shared_ptr<Job>> {
        Expected<PickedMesh> source = PickedMesh::pick(now, request.source);
        if (!source) return source.error();
        if (Status accepted = source->require_accepted(); !accepted) return accepted.error();
        const MethodHost host{options_, memory_, disk_};
        return std::shared_ptr<Job>(
            std::make_shared<MethodJob>(*found, *std::move(source), request, host, note, std::move(events), caller));
    };
    Expected<std::shared_ptr<Job>> job = (*found)->enqueue(request.options, make);
    if (!job) return job.error();
    const bool taken = disk_errand([note, noted] {
        note->write();
        if (noted) noted();
    });
    if (!taken && noted) noted();
    return RunningMethod{*found, *std::move(job)};
}

Status MeshingService::require_room_in_queue() const {
    const std::size_t waiting = methods_.load().waiting + sessions_.waiting_jobs();
    if (waiting < options_.limits.queued_jobs) return Done{};
    return Error{Cause::kLimitExceeded,
                 std::to_string(waiting) + " methods wait in this server, its limit max_queued; try again when some are done", "",
                 kRetryAfter};
}

ServiceLoad MeshingService::load() const {
    const WorkerPool::Load methods = methods_.load();
    std::error_code unknown;
    const std::uint64_t free = std::filesystem::space(TempFile::directory_of(options_.temp_directory), unknown).available;
    return {sessions_.count(), methods.running, methods.waiting + sessions_.waiting_jobs(),
            memory_.use(),     archive_->use(), unknown ? 0 : free};
}

void MeshingService::end_sessions() {
    static_cast<void>(sessions_.note_time());
    sessions_.clear({Cause::kUnavailable, "the server is shutting down", ""});
}

void MeshingService::shutdown() {
    sweeper_.stop();
    end_sessions();
    methods_.shutdown();
    errands_.shutdown();
    intake_.shutdown();
    disk_.shutdown();
}

}  // namespace vsplit::service
