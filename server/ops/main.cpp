#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
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
#include "guard/gatekeeper.h"
#include "ops/exposure.h"
#include "ops/listen_address.h"
#include "ops/log_line.h"
#include "ops/logging.h"
#include "ops/metrics.h"
#include "ops/new_token.h"
#include "ops/page.h"
#include "ops/self_check.h"
#include "ops/server_options.h"
#include "ops/tls_refusals.h"
#include "rest/openapi.h"
#include "rest/rest_server.h"
#include "service/machine_memory.h"
#include "service/meshing_service.h"
#include "service/sweeper.h"
#include "store/data_dir.h"
#include "vsplit/base/memory.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::ops {
namespace {

// For the last bytes of answers to reach clients that read them, and for methods that are cut off to notice.
constexpr std::chrono::seconds kFlushTime{1};
constexpr std::chrono::seconds kCutOffTime{5};

constexpr std::chrono::seconds kTrimPause{5};

sigset_t stop_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    return signals;
}

// Many small pieces, those of messages above all, stay with the heaps of threads when they are freed.
void return_free_memory() {
#if defined(__GLIBC__)
    constexpr std::size_t kMuch = std::size_t{64} << 20;
    if (mallinfo2().fordblks > kMuch) malloc_trim(0);
#endif
}

// Connections, of which --max-connections may be many, and uploads have one each or two.
void take_all_descriptors() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    static_cast<void>(setrlimit(RLIMIT_NOFILE, &limit));
}

// Threads inherit what is blocked, so this comes before the first of them.
void block_stop_signals() {
    const sigset_t signals = stop_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    // SIGHUP: files that may change are watched, so there is nothing to read again.
    for (const int ignored : {SIGPIPE, SIGHUP}) static_cast<void>(std::signal(ignored, SIG_IGN));
}

int wait_for_stop_signal() {
    const sigset_t signals = stop_signals();
    int number = 0;
    sigwait(&signals, &number);
    return number;
}

int fail(const ServerOptions& options, const std::string& message) {
    say_failure(message, options.log_format == "json");
    return 1;
}

// What holds for every call, and must outlive the doors.
struct Guard {
    std::shared_ptr<guard::TlsBook> tls;  // null: plain
    std::unique_ptr<guard::Gatekeeper> gate;
};

void warn_of_open_key(const std::string& file) {
    struct stat about {};
    if (stat(file.c_str(), &about) == 0 && (about.st_mode & (S_IRGRP | S_IROTH)) != 0)
        spdlog::warn("{} can be read by others than its owner; whoever has this key can be this server", file);
}

Expected<Guard> make_guard(const ServerOptions& options, Metrics& metrics) {
    const guard::ReloadObserver on_read = [&metrics](const std::string& file, const Status& read) {
        log_reload(file, read);
        metrics.file_read(file, read.has_value());
    };
    Guard made;
    if (!options.tls.cert.empty()) {
        Expected<std::shared_ptr<guard::TlsBook>> tls = guard::TlsBook::open(options.tls, on_read);
        if (!tls) return tls.error();
        made.tls = *std::move(tls);
        warn_of_open_key(options.tls.key);
    }
    std::unique_ptr<guard::TokenBook> tokens;
    if (!options.token_file.empty()) {
        Expected<std::unique_ptr<guard::TokenBook>> opened = guard::TokenBook::open(options.token_file, on_read);
        if (!opened) return opened.error();
        tokens = *std::move(opened);
    }
    made.gate = std::make_unique<guard::Gatekeeper>(std::move(tokens), options.max_request_rate);
    return made;
}

rpc::GrpcExtras extras_of(const ServerOptions& options, const Guard& guard, Metrics& metrics) {
    rpc::GrpcExtras extras;
    extras.observer = log_rpc;
    extras.meter = &metrics;
    extras.on_connection_refused = [&metrics] { metrics.connection_refused(); };
    extras.gate = guard.gate.get();
    extras.tls = guard.tls;
    extras.limits.connections = options.rest.limits.connections;
    extras.limits.rpcs = options.max_rpcs;
    extras.limits.message_bytes = static_cast<int>(options.max_message_bytes);
    extras.limits.message_memory = options.max_message_memory;
    extras.limits.streams = static_cast<int>(options.max_streams);
    // Of the disk that files of sessions may take, those that nobody reads just now take a tenth at most.
    constexpr std::uint64_t kRestingShare = 10;
    if (options.max_disk_bytes > 0) {
        extras.shelf.resting_bytes = std::min(extras.shelf.resting_bytes, options.max_disk_bytes / kRestingShare);
    }
    extras.life = {std::chrono::seconds(options.keepalive), std::chrono::seconds(options.max_connection_age)};
    return extras;
}

rest::Backend backend_of(rpc::GrpcServer& server, service::MeshingService& service, Metrics& metrics, guard::Gatekeeper& gate) {
    rest::Backend backend;
    backend.channel = server.channel();
    backend.descriptor_sets = {rest::contract_descriptors()};
    backend.services = {v1::Meshing::service_full_name()};
    backend.ready = [&server] { return server.ready(); };
    backend.admit = rest::admission_of(gate);
    backend.pace = rest::pace_of(gate);
    backend.metrics = [&metrics, &service] { return metrics.text(service.load()); };
    backend.pages = page_files();
    backend.version = VSPLIT_VERSION;
    return backend;
}

// Null where --http is off.
Expected<std::unique_ptr<rest::RestServer>> start_rest(const ServerOptions& options, const std::optional<ListenAddress>& address,
                                                       rest::Backend backend, Metrics& metrics, TlsRefusals& refusals,
                                                       std::shared_ptr<guard::TlsBook> tls) {
    if (!address) return std::unique_ptr<rest::RestServer>();
    const auto observe = [&metrics](const rest::HttpRecord& record) {
        metrics.http_ended(record);
        log_http(record);
    };
    rest::RestOptions rest = options.rest;
    rest.limits.message_bytes = options.max_message_bytes;
    rest.on_connection_refused = [&metrics] { metrics.connection_refused(); };
    rest.on_tls_failed = [&refusals](const std::string& peer, const std::string& reason) { refusals.note("http", peer, reason); };
    rest.own_hosts_only = tls == nullptr && options.token_file.empty() && is_loopback(*address);
    return rest::RestServer::start(address->host, address->port, std::move(backend), std::move(rest), observe, std::move(tls));
}

void drain(rpc::GrpcServer& server, rest::RestServer* rest, service::MeshingService& service, std::chrono::seconds grace) {
    if (rest != nullptr) rest->drain();
    if (!server.drain(grace)) {
        spdlog::warn("cut off what was not done after {} s", grace.count());
        // Before the connections are: clients are told why, and what they asked for is known after the next start.
        service.end_sessions();
        server.drain(kCutOffTime);
    }
    if (rest != nullptr) rest->shutdown(kFlushTime);
    server.shutdown(std::chrono::milliseconds(0));
}

Expected<std::optional<store::DataDir>> open_data_dir(const ServerOptions& options) {
    if (options.data_dir.empty()) return std::optional<store::DataDir>();
    const auto report = [](const std::string& message) { spdlog::warn("{}", message); };
    Expected<store::DataDir> opened = store::DataDir::open(options.data_dir, options.max_disk_bytes, report);
    if (!opened) return opened.error();
    return std::optional(*std::move(opened));
}

int serve(const ServerOptions& options, const ListenAddress& address, const std::optional<ListenAddress>& http) {
    Metrics metrics;
    TlsRefusals refusals(metrics);
    const Expected<Guard> guard = make_guard(options, metrics);
    if (!guard) return fail(options, guard.error().message);
    service::ServiceOptions service_options = options.service;
    service_options.on_expired = [&metrics](const std::string& session) {
        metrics.session_expired();
        spdlog::info("session {} expired", session);
    };
    service_options.job_observer = [&metrics](const service::JobRecord& record) {
        metrics.job_ended(record);
        log_job(record);
    };
    if (service_options.limits.memory_bytes == 0) service_options.limits.memory_bytes = service::usual_memory_limit();
    Expected<std::optional<store::DataDir>> data = open_data_dir(options);
    if (!data) return fail(options, data.error().message);
    if (*data) service_options.temp_directory = (*data)->uploads();
    if (*data) service_options.limits.disk_bytes = options.max_disk_bytes;
    service::MeshingService service(service_options,
                                    *data ? (*data)->take_archive() : std::make_unique<service::SessionArchive>());
    if (const Status restored = service.restore(); !restored) return fail(options, restored.error().message);
    Expected<std::unique_ptr<rpc::GrpcServer>> server =
        rpc::GrpcServer::start(address.host, address.port, service, extras_of(options, *guard, metrics));
    if (!server) return fail(options, server.error().message);
    const Expected<std::unique_ptr<rest::RestServer>> rest =
        start_rest(options, http, backend_of(**server, service, metrics, *guard->gate), metrics, refusals, guard->tls);
    if (!rest) return fail(options, rest.error().message);
    std::cout << "vsplitd listening on " << address.text(std::to_string((*server)->port()));
    const std::string scheme = guard->tls == nullptr ? "http://" : "https://";
    if (*rest) std::cout << " and " << scheme << http->text(std::to_string((*rest)->port()));
    std::cout << std::endl;
    spdlog::info("vsplitd {} serves {} sessions{}; TLS {}, tokens {}", VSPLIT_VERSION, service.load().sessions,
                 options.data_dir.empty() ? "" : " of " + options.data_dir, guard->tls ? "on" : "off",
                 options.token_file.empty() ? "off" : "on");
    const service::Sweeper trimmer(kTrimPause, return_free_memory);
    const int signal = wait_for_stop_signal();
    spdlog::info("signal {}: draining for at most {} s; a second signal ends it at once", signal, options.drain);
    std::thread([] { std::_Exit(128 + wait_for_stop_signal()); }).detach();
    drain(**server, rest->get(), service, std::chrono::seconds(options.drain));
    service.shutdown();
    spdlog::info("stopped");
    return 0;
}

int print_new_token(const ServerOptions& options) {
    const Expected<NewToken> made = make_token(options.new_token);
    if (!made) return fail(options, made.error().message);
    std::cout << made->token << '\n' << made->line << '\n';
    return 0;
}

int print_openapi(const ServerOptions& options) {
    const std::vector<std::string_view> sets{rest::contract_descriptors()};
    const std::vector<std::string> services{v1::Meshing::service_full_name()};
    const auto schema = rest::Schema::make(sets, services);
    if (!schema) return fail(options, schema.error().message);
    const auto router = rest::Router::make(**schema);
    if (!router) return fail(options, router.error().message);
    std::cout << rest::openapi_document(**schema, *router, VSPLIT_VERSION);
    return 0;
}

int run(int argc, const char* const* argv) {
    const std::variant<ServerOptions, int> parsed = parse_server_options(argc, argv);
    if (const int* status = std::get_if<int>(&parsed)) return *status;
    const auto& options = std::get<ServerOptions>(parsed);
    if (options.print_openapi) return print_openapi(options);
    if (!options.new_token.empty()) return print_new_token(options);
    const Expected<ListenAddress> address = parse_listen_address("listen", options.listen);
    if (!address) return fail(options, address.error().message);
    std::optional<ListenAddress> http;
    if (options.http != "off") {
        const Expected<ListenAddress> at = parse_listen_address("http", options.http);
        if (!at) return fail(options, at.error().message);
        http = *at;
    }
    if (Status safe = options.check ? Status(Done{}) : check_exposure(options, *address, http); !safe)
        return fail(options, safe.error().message);
    if (options.check) {
        const Status serves = check_server(*address, options.tls);
        return serves ? 0 : fail(options, serves.error().message);
    }
    umask(S_IRWXG | S_IRWXO);  // what it writes is for its own user
    block_stop_signals();
    return_large_memory();
    take_all_descriptors();
    start_logging({options.log_level, options.log_format == "json", options.slow_job});
    const int status = serve(options, *address, http);
    flush_log();
    return status;
}

}  // namespace
}  // namespace vsplit::ops

int main(int argc, char** argv) { return vsplit::ops::run(argc, argv); }
