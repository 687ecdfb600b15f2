#include "ops/self_check.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_certificate_verifier.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <memory>
#include <string>

namespace vsplit::ops {
namespace {

constexpr std::chrono::seconds kLongest{3};

// HealthCheckResponse { status: SERVING }, and a request for the server as a whole is empty.
constexpr std::string_view kServing("\x08\x01", 2);

std::shared_ptr<grpc::ChannelCredentials> credentials(const guard::TlsFiles& files) {
    namespace tls = grpc::experimental;
    if (files.cert.empty()) return grpc::InsecureChannelCredentials();
    constexpr unsigned kLookEvery = 60;  // seconds
    tls::TlsChannelCredentialsOptions options;
    // Nobody is verified, but gRPC wants some roots; a small image has none of the system's.
    const std::string& roots = files.cert;
    options.set_certificate_provider(
        std::make_shared<tls::FileWatcherCertificateProvider>(files.key, files.cert, roots, kLookEvery));
    options.watch_identity_key_cert_pairs();
    options.watch_root_certs();
    options.set_verify_server_certs(false);
    options.set_check_call_host(false);
    options.set_certificate_verifier(std::make_shared<tls::NoOpCertificateVerifier>());
    return tls::TlsCredentials(options);
}

// A server that listens at every address is asked at its own.
ListenAddress reachable(const ListenAddress& address) {
    if (address.host == "0.0.0.0") return {"127.0.0.1", address.port};
    if (address.host == "::") return {"::1", address.port};
    return address;
}

std::string text_of(const grpc::ByteBuffer& buffer) {
    grpc::Slice slice;
    if (!buffer.DumpToSingleSlice(&slice).ok()) return {};
    return {reinterpret_cast<const char*>(slice.begin()), slice.size()};
}

/// Whether TLS at the address gets as far as the server's certificate, whatever comes of it then.
bool shows_certificate(const ListenAddress& at) {
    using boost::asio::ip::tcp;
    boost::asio::io_context context;
    boost::system::error_code failed;
    tcp::socket socket(context);
    for (const auto& found : tcp::resolver(context).resolve(at.host, at.port, failed)) {
        socket = tcp::socket(context);
        if (!socket.connect(found.endpoint(), failed)) break;
    }
    if (failed || !socket.is_open()) return false;
    const timeval longest{kLongest.count(), 0};
    setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    setsockopt(socket.native_handle(), SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
    const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> tls(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
    const std::unique_ptr<SSL, decltype(&SSL_free)> connection(SSL_new(tls.get()), &SSL_free);
    if (connection == nullptr || SSL_set_fd(connection.get(), socket.native_handle()) != 1) return false;
    static_cast<void>(SSL_connect(connection.get()));
    return SSL_get0_peer_certificate(connection.get()) != nullptr;
}

}  // namespace

Status check_server(const ListenAddress& address, const guard::TlsFiles& tls) {
    const ListenAddress at = reachable(address);
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
    grpc::GenericStub stub(grpc::CreateCustomChannel(at.text(at.port), credentials(tls), arguments));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kLongest);
    grpc::CompletionQueue queue;
    const grpc::ByteBuffer request(nullptr, 0);
    const auto call = stub.PrepareUnaryCall(&context, "/grpc.health.v1.Health/Check", request, &queue);
    call->StartCall();
    grpc::ByteBuffer reply;
    grpc::Status status;
    call->Finish(&reply, &status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    if (status.ok() && text_of(reply) == kServing) return Done{};
    // Its own certificate need not be one that it takes from clients.
    if (!status.ok() && !tls.client_ca.empty() && shows_certificate(at)) return Done{};
    return Error{
        Cause::kUnavailable,
        "the server at " + at.text(at.port) + " does not serve: " + (status.ok() ? "NOT_SERVING" : status.error_message()), ""};
}

}  // namespace vsplit::ops
