#pragma once

#include <stop_token>
#include <string>

#include "cli/arguments.h"
#include "cli/progress_bar.h"
#include "vsplit/base/expected.h"
#include "vsplit/client/meshing_client.h"

namespace vsplit::cli {

/// The session a command works in: one that was named, or one of its own that goes with this object unless it is to be kept.
class RemoteSession {
public:
    /// Uploads IN where no session is named. The client must outlive this object.
    [[nodiscard]] static Expected<RemoteSession> open(client::MeshingClient& client, const Arguments& arguments,
                                                      ProgressBar& progress, const std::stop_token& stop);

    RemoteSession(RemoteSession&& other) noexcept;
    RemoteSession& operator=(RemoteSession&&) = delete;
    RemoteSession(const RemoteSession&) = delete;
    RemoteSession& operator=(const RemoteSession&) = delete;
    ~RemoteSession();

    /// As it was when it was opened.
    [[nodiscard]] const v1::Session& session() const { return session_; }
    [[nodiscard]] const std::string& id() const { return session_.id(); }

private:
    enum class AtEnd { kNothing, kDelete, kTell };

    RemoteSession(client::MeshingClient& client, v1::Session session, AtEnd at_end);

    client::MeshingClient& client_;
    v1::Session session_;
    AtEnd at_end_;
};

}  // namespace vsplit::cli
