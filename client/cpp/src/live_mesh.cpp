#include "vsplit/client/live_mesh.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "backoff.h"
#include "vsplit/base/execution_context.h"
#include "wire/convert.h"

namespace vsplit::client {
namespace {

/// What is uploaded at once: smaller ranges are not worth a call.
constexpr std::size_t kStride = 256;

/// Whoever shows the receiver's mesh to another thread wraps what changes it.
using Guard = std::function<Status(const std::function<Status()>&)>;

Status unguarded(const std::function<Status()>& change) { return change(); }

EventHandlers guarded_handlers(MeshReceiver& receiver, const Guard& guard) {
    EventHandlers handlers;
    handlers.on_base_mesh = [&receiver, &guard](StreamBase base) {
        return guard([&] { return receiver.begin(std::move(base)); });
    };
    handlers.on_regions = [&receiver, &guard](const v1::Regions& part) {
        return guard([&] { return receiver.take_regions(part); });
    };
    handlers.on_block = [&receiver, &guard](const RecordBlock& block) { return guard([&] { return receiver.append(block); }); };
    return handlers;
}

v1::SetResolutionRequest request_for(const ResolutionTarget& target, const MeshReceiver& receiver) {
    const EncodingChoice encoding = receiver.has_mesh() ? receiver.encoding() : target.encoding;
    v1::SetResolutionRequest request;
    request.set_session(target.session);
    request.set_representation(target.representation);
    request.set_faces(target.faces);
    request.set_encoding(wire::to_proto(encoding.encoding));
    request.set_quantisation_bits(encoding.bits);
    request.set_keyframe(target.keyframes);
    if (!receiver.has_mesh() || !receiver.has_regions()) return request;
    // Faces say what is held where no record is, records also where it ends between two splits.
    if (receiver.records_held() == 0) request.set_faces_held(receiver.faces_held());
    request.set_resume_from(receiver.records_held());
    return request;
}

std::size_t state_of(const MeshReceiver& receiver) { return receiver.has_mesh() ? 1 + receiver.records_held() : 0; }

Expected<std::uint32_t> shown(MeshReceiver& receiver, std::uint32_t faces, const Guard& guard) {
    if (Status done = guard([&] { return receiver.show(faces); }); !done) return done.error();
    return receiver.mesh().face_count();
}

Expected<std::uint32_t> move_guarded(MeshingClient& client, const ResolutionTarget& target, MeshReceiver& receiver,
                                     const ResumeOptions& resume, const CallOptions& call, const Guard& guard) {
    const auto leave = [&receiver] {
        receiver.leave_keyframe();
        return Status(Done{});
    };
    if (receiver.on_keyframe() && target.faces < receiver.held().faces_min()) {
        if (Status left = guard(leave); !left) return left.error();
    }
    if (receiver.has_mesh() && target.faces <= receiver.faces_held()) return shown(receiver, target.faces, guard);
    const EventHandlers handlers = guarded_handlers(receiver, guard);
    Backoff backoff(resume, call.stop);
    for (;;) {
        const std::size_t before = state_of(receiver);
        const auto made = client.set_resolution(request_for(target, receiver), handlers, call);
        if (made) {
            receiver.end_stream();
            return shown(receiver, made->faces(), guard);
        }
        if (made.error().cause != Cause::kUnavailable) return made.error();
        if (state_of(receiver) != before) backoff.reset();
        if (!backoff.again()) return call.stop.stop_requested() ? ExecutionContext::cancelled_error() : made.error();
    }
}

/// Copies what differs, and notes where, in strides.
template <class Element>
void bring_up_to_date(const std::vector<Element>& from, std::vector<Element>& to, std::vector<ElementRange>& changed) {
    const std::size_t common = std::min(from.size(), to.size());
    to.resize(from.size());
    for (std::size_t first = 0; first < from.size(); first += kStride) {
        const std::size_t end = std::min(first + kStride, from.size());
        if (end <= common && std::equal(from.begin() + first, from.begin() + end, to.begin() + first)) continue;
        std::copy(from.begin() + first, from.begin() + end, to.begin() + first);
        if (!changed.empty() && changed.back().first + changed.back().count == first) {
            changed.back().count += static_cast<std::uint32_t>(end - first);
        } else {
            changed.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)});
        }
    }
}

}  // namespace

Expected<std::uint32_t> move_to(MeshingClient& client, const ResolutionTarget& target, MeshReceiver& receiver,
                                const ResumeOptions& resume, const CallOptions& call) {
    return move_guarded(client, target, receiver, resume, call, unguarded);
}

struct LiveMesh::Impl {
    Impl(MeshingClient& of, ResolutionTarget to, const ResumeOptions& options)
        : client(of), resume(options), target(std::move(to)), thread([this](const std::stop_token& stop) { run(stop); }) {}

    ~Impl() {
        thread.request_stop();
        const std::lock_guard lock(mutex);
        call_stop.request_stop();
    }

    void run(const std::stop_token& stop) {
        std::unique_lock lock(mutex);
        while (wished.wait(lock, stop, [this] { return fulfilled != wish; })) {
            const std::uint64_t serving = wish;
            const ResolutionTarget to = target;
            call_stop = std::stop_source();
            CallOptions call;
            call.stop = call_stop.get_token();
            lock.unlock();
            const Guard guard = [this](const std::function<Status()>& change) {
                const std::lock_guard showing(shown_mutex);
                return change();
            };
            Expected<std::uint32_t> done = move_guarded(client, to, receiver, resume, call, guard);
            lock.lock();
            if (serving != wish) continue;  // left for a newer wish
            outcome = std::move(done);
            fulfilled = serving;
            ended.notify_all();
        }
    }

    MeshingClient& client;
    const ResumeOptions resume;
    std::mutex shown_mutex;  // of the receiver; taken alone
    MeshReceiver receiver;
    std::mutex mutex;  // of all below
    std::condition_variable_any wished, ended;
    ResolutionTarget target;
    std::uint64_t wish = 1, fulfilled = 0;
    std::stop_source call_stop;
    Expected<std::uint32_t> outcome = 0U;
    std::jthread thread;  // last: it uses the others
};

LiveMesh::LiveMesh(MeshingClient& client, ResolutionTarget target, const ResumeOptions& resume)
    : impl_(std::make_unique<Impl>(client, std::move(target), resume)) {}

LiveMesh::~LiveMesh() = default;

void LiveMesh::go_to(std::uint32_t faces) {
    const std::lock_guard lock(impl_->mutex);
    impl_->target.faces = faces;
    ++impl_->wish;
    impl_->call_stop.request_stop();
    impl_->wished.notify_all();
}

Expected<std::uint32_t> LiveMesh::wait() {
    std::unique_lock lock(impl_->mutex);
    impl_->ended.wait(lock, [this] { return impl_->fulfilled == impl_->wish; });
    return impl_->outcome;
}

MeshUpdate LiveMesh::fetch(TriangleMesh& mesh) {
    MeshUpdate update;
    const std::lock_guard lock(impl_->shown_mutex);
    if (!impl_->receiver.has_mesh()) return update;
    const TriangleMesh& now = impl_->receiver.mesh();
    bring_up_to_date(now.positions, mesh.positions, update.vertices);
    bring_up_to_date(now.faces, mesh.faces, update.faces);
    return update;
}

}  // namespace vsplit::client
