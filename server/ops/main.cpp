#include <malloc.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "grpc/grpc_server.h"
#include "ops/listen_address.h"
#include "ops/logging.h"
#include "ops/metrics.h"
#include "ops/page.h"
#include "ops/server_options.h"
#include "rest/openapi.h"
#include "rest/rest_server.h"
#include "service/meshing_service.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::ops {
namespace {

constexpr std::chrono::seconds kGrace{5};

// For the last bytes of answers to reach clients that read them.
constexpr std::chrono::seconds kFlushTime{1};

sigset_t stop_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    return signals;
}

// Whole meshes and files come and go: their memory goes back to the system when it is freed, not into the heaps of threads.
void return_large_memory() {
#if defined(__GLIBC__)
    constexpr int kLarge = 1 << 20;
    static_cast<void>(mallopt(M_MMAP_THRESHOLD, kLarge));
#endif
}

// Threads inherit what is blocked, so this comes before the first of them.
void block_stop_signals() {
    const sigset_t signals = stop_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
}

int wait_for_stop_signal() {
    const sigset_t signals = stop_signals();
    int number = 0;
    sigwait(&signals, &number);
    return number;
}

int fail(const std::string& message) {
    std::cerr << "vsplitd: " << message << '\n';
    return 1;
}

rest::Backend backend_of(rpc::GrpcServer& server, service::MeshingService& service, Metrics& metrics) {
    rest::Backend backend;
    backend.channel = server.channel();
    backend.descriptor_sets = {rest::contract_descriptors()};
    backend.services = {v1::Meshing::service_full_name()};
    backend.ready = [&server] { return server.ready(); };
    backend.metrics = [&metrics, &service] { return metrics.text(service.load()); };
    backend.pages = page_files();
    backend.version = VSPLIT_VERSION;
    return backend;
}

// Null where --http is off.
Expected<std::unique_ptr<rest::RestServer>> start_rest(const ServerOptions& options, const std::optional<ListenAddress>& address,
                                                       rest::Backend backend, Metrics& metrics) {
    if (!address) return std::unique_ptr<rest::RestServer>();
    const auto observe = [&metrics](const rest::HttpRecord& record) {
        metrics.http_ended(record);
        log_http(record);
    };
    return rest::RestServer::start(address->host, address->port, std::move(backend), options.rest, observe);
}

void drain(rpc::GrpcServer& server, rest::RestServer* rest) {
    if (rest != nullptr) rest->drain();
    server.drain(kGrace);
    if (rest != nullptr) rest->shutdown(kFlushTime);
    server.shutdown(std::chrono::milliseconds(0));
}

int serve(const ServerOptions& options, const ListenAddress& address, const std::optional<ListenAddress>& http) {
    Metrics metrics;
    service::MeshingService service(options.service);
    Expected<std::unique_ptr<rpc::GrpcServer>> server =
        rpc::GrpcServer::start(address.text(address.port), service, {log_rpc, &metrics, {}});
    if (!server) return fail(server.error().message + ": " + why_not_listening(address));
    const Expected<std::unique_ptr<rest::RestServer>> rest =
        start_rest(options, http, backend_of(**server, service, metrics), metrics);
    if (!rest) return fail(rest.error().message);
    std::cout << "vsplitd listening on " << address.text(std::to_string((*server)->port()));
    if (*rest) std::cout << " and http://" << http->text(std::to_string((*rest)->port()));
    std::cout << std::endl;
    const int signal = wait_for_stop_signal();
    spdlog::info("signal {}: draining for at most {} s; a second signal ends it at once", signal, kGrace.count());
    std::thread([] { std::_Exit(128 + wait_for_stop_signal()); }).detach();
    drain(**server, rest->get());
    service.shutdown();
    spdlog::info("stopped");
    return 0;
}

int print_openapi() {
    const std::vector<std::string_view> sets{rest::contract_descriptors()};
    const std::vector<std::string> services{v1::Meshing::service_full_name()};
    const auto schema = rest::Schema::make(sets, services);
    if (!schema) return fail(schema.error().message);
    const auto router = rest::Router::make(**schema);
    if (!router) return fail(router.error().message);
    std::cout << rest::openapi_document(**schema, *router, VSPLIT_VERSION);
    return 0;
}

int run(int argc, const char* const* argv) {
    const std::variant<ServerOptions, int> parsed = parse_server_options(argc, argv);
    if (const int* status = std::get_if<int>(&parsed)) return *status;
    const auto& options = std::get<ServerOptions>(parsed);
    if (options.print_openapi) return print_openapi();
    const Expected<ListenAddress> address = parse_listen_address("listen", options.listen);
    if (!address) return fail(address.error().message);
    std::optional<ListenAddress> http;
    if (options.http != "off") {
        const Expected<ListenAddress> at = parse_listen_address("http", options.http);
        if (!at) return fail(at.error().message);
        http = *at;
    }
    block_stop_signals();
    return_large_memory();
    start_logging(options.log_level);
    return serve(options, *address, http);
}

}  // namespace
}  // namespace vsplit::ops

int main(int argc, char** argv) { return vsplit::ops::run(argc, argv); }
