#include "connect.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "call.h"
#include "credentials.h"
#include "vsplit/base/execution_context.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::client {
namespace {

using Clock = std::chrono::system_clock;

bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc() && end == text.data() + text.size() && port != 0;
}

/// Without this, gRPC takes a missing port for 443 and an unknown scheme for a host's name.
Status check_target(const std::string& target) {
    const std::size_t colon = target.rfind(':');
    const bool is_socket = target.starts_with("unix:") && target.size() > 5;
    if (is_socket || (colon != std::string::npos && colon > 0 && is_port(std::string_view(target).substr(colon + 1))))
        return Done{};
    return Error{Cause::kInvalidOption, "server is '" + target + "'; accepted is HOST:PORT, e.g. 127.0.0.1:50051", "server"};
}

std::shared_ptr<grpc::Channel> create_channel(const std::string& target, const ConnectOptions& options,
                                              const std::shared_ptr<grpc::ChannelCredentials>& credentials) {
    constexpr int kMaxMessage = 64 << 20;  // a page of sessions with many representations
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(kMaxMessage);
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);  // a proxy for the web must not come between a client and its own machine
    // A block in one frame rather than in sixteen, and the next on its way while this one is read. Without the probe the window
    // would start at 64 KiB and grow by guesses about the wire.
    constexpr int kFrame = 1 << 20, kLookahead = 4 << 20;
    arguments.SetInt(GRPC_ARG_HTTP2_MAX_FRAME_SIZE, kFrame);
    arguments.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, kLookahead);
    // A connection that broke is tried again soon: who waits holds half a stream. (What gRPC calls the least backoff is what one
    // attempt has for TCP, TLS and HTTP/2's first words: round trips, not a pause.)
    constexpr int kFirstMs = 50, kLongestMs = 2000, kAttemptMs = 20'000;
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstMs);
    arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kAttemptMs);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLongestMs);
    return grpc::experimental::CreateCustomChannelWithInterceptors(target, credentials, arguments, call_marks(options));
}

/// What may be the matter where somebody listens, and does not speak as the client does.
std::string advice(const std::string& reason, const TlsOptions& tls) {
    const auto tells = [&reason](std::string_view words) { return reason.find(words) != std::string::npos; };
    if (tells("ALPN")) return "; that may be the server's port for HTTP, and not the one for gRPC";
    if (!tells("losed") && !tells("andshake") && !tells("SSL") && !tells("no answer")) return "";
    if (tls.ca.empty()) return "; a server with TLS wants tls_ca, and a port for HTTP does not speak gRPC";
    if (tells("wrong version number")) return "; the server may have no TLS: leave tls_ca out";
    if (tells("CERTIFICATE_VERIFY_FAILED") || tells("certificate verify failed"))
        return "; tls_ca did not sign the server's certificate, or it is for another name";
    return tls.cert.empty() ? "; the server may want a client's certificate, tls_cert and tls_key"
                            : "; the server may not take this client's certificate, tls_cert";
}

/// Why a channel does not connect: only a call is told.
Error unreachable(const std::shared_ptr<grpc::Channel>& channel, const std::string& target, const TlsOptions& tls) {
    Call call({std::chrono::milliseconds(200), {}});
    v1::ListSessionsResponse response;
    const grpc::Status status = v1::Meshing::NewStub(channel)->ListSessions(call.context(), v1::ListSessionsRequest(), &response);
    const std::string reason = status.error_code() == grpc::StatusCode::UNAVAILABLE ? status.error_message() : "no answer";
    return {Cause::kUnavailable, "no vsplit server can be reached at " + target + ": " + reason + advice(reason, tls), "server"};
}

}  // namespace

Expected<std::shared_ptr<grpc::Channel>> open_channel(const std::string& target, const ConnectOptions& options) {
    if (Status valid = check_target(target); !valid) return valid.error();
    const Expected<std::shared_ptr<grpc::ChannelCredentials>> credentials = channel_credentials(options);
    if (!credentials) return credentials.error();
    std::shared_ptr<grpc::Channel> channel = create_channel(target, options, *credentials);
    const Clock::time_point deadline = Clock::now() + options.timeout;
    for (;;) {
        const grpc_connectivity_state state = channel->GetState(true);
        if (state == GRPC_CHANNEL_READY) return channel;
        if (options.stop.stop_requested()) return ExecutionContext::cancelled_error();
        if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || Clock::now() >= deadline) return unreachable(channel, target, options.tls);
        // In short steps, to hear of a stop.
        channel->WaitForStateChange(state, std::min(deadline, Clock::now() + std::chrono::milliseconds(50)));
    }
}

}  // namespace vsplit::client
