#include "cli/remote_session.h"

#include <chrono>
#include <iostream>
#include <span>
#include <utility>

#include "cli/input_check.h"
#include "cli/local_run.h"
#include "cli/number_text.h"
#include "vsplit/io/write_mesh.h"

namespace vsplit::cli {
namespace {

client::UploadOptions upload_options(const Arguments& a, ProgressBar& progress) {
    client::UploadOptions options;
    options.weld = a.weld;
    options.repair = a.repair;
    options.stitch = a.stitch;
    options.hole_size = a.hole_size;
    options.speck_size = a.speck_size;
    options.unit = a.unit;
    options.on_progress = [&progress](std::uint64_t sent, std::uint64_t total) {
        progress.show("upload", static_cast<double>(sent) / static_cast<double>(total), grouped(sent >> 20) + " MiB");
    };
    return options;
}

/// Uploads IN; of a .vsplit file, its mesh at the resolution asked for.
Expected<v1::Session> upload(client::MeshingClient& client, const std::string& session, const Arguments& a, ProgressBar& progress,
                             const std::stop_token& stop) {
    if (!is_representation_file(a.input)) return client.upload_mesh(session, a.input, upload_options(a, progress), {{}, stop});
    const Expected<Outcome> stored = load_representation(a.input, a.source_faces, a.unit);
    if (!stored) return stored.error();
    const std::string bytes = write_mesh(*stored->mesh, MeshFormat::kPlyBinary);
    client::UploadOptions options = upload_options(a, progress);
    options.unit = unit_of(stored->document);
    return client.upload_mesh(session, std::as_bytes(std::span(bytes)), options, {{}, stop});
}

}  // namespace

RemoteSession::RemoteSession(client::MeshingClient& client, v1::Session session, AtEnd at_end)
    : client_(client), session_(std::move(session)), at_end_(at_end) {}

RemoteSession::RemoteSession(RemoteSession&& other) noexcept
    : client_(other.client_), session_(std::move(other.session_)), at_end_(std::exchange(other.at_end_, AtEnd::kNothing)) {}

RemoteSession::~RemoteSession() {
    if (at_end_ == AtEnd::kTell) std::cerr << "session " + session_.id() + "\n";
    if (at_end_ != AtEnd::kDelete) return;
    // Also after Ctrl-C, so without its stop token. The server forgets the session by itself where this fails.
    [[maybe_unused]] const Status deleted = client_.delete_session(session_.id(), {std::chrono::seconds(5), {}});
}

Expected<RemoteSession> RemoteSession::open(client::MeshingClient& client, const Arguments& a, ProgressBar& progress,
                                            const std::stop_token& stop) {
    if (!a.session.empty()) {
        Expected<v1::Session> existing = client.get_session(a.session, {{}, stop});
        if (!existing) return existing.error();
        return RemoteSession(client, *std::move(existing), AtEnd::kNothing);
    }
    Expected<v1::Session> created = client.create_session({{}, stop});
    if (!created) return created.error();
    RemoteSession session(client, *std::move(created), a.keep ? AtEnd::kTell : AtEnd::kDelete);
    Expected<v1::Session> uploaded = upload(client, session.id(), a, progress, stop);
    if (!uploaded) return in_file(uploaded.error(), a.input);
    session.session_ = *std::move(uploaded);
    return session;
}

}  // namespace vsplit::cli
