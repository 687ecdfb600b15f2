#include <malloc.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <variant>

#include "grpc/grpc_server.h"
#include "ops/listen_address.h"
#include "ops/logging.h"
#include "ops/server_options.h"
#include "service/meshing_service.h"

namespace vsplit::ops {
namespace {

constexpr std::chrono::seconds kGrace{5};

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

int serve(const ServerOptions& options, const ListenAddress& address) {
    service::MeshingService service(options.service);
    Expected<std::unique_ptr<rpc::GrpcServer>> server = rpc::GrpcServer::start(address.text(address.port), service, log_rpc);
    if (!server) return fail(server.error().message + ": " + why_not_listening(address));
    std::cout << "vsplitd listening on " << address.text(std::to_string((*server)->port())) << std::endl;
    const int signal = wait_for_stop_signal();
    spdlog::info("signal {}: draining for at most {} s; a second signal ends it at once", signal, kGrace.count());
    std::thread([] { std::_Exit(128 + wait_for_stop_signal()); }).detach();
    (*server)->shutdown(kGrace);
    service.shutdown();
    spdlog::info("stopped");
    return 0;
}

int run(int argc, const char* const* argv) {
    const std::variant<ServerOptions, int> parsed = parse_server_options(argc, argv);
    if (const int* status = std::get_if<int>(&parsed)) return *status;
    const auto& options = std::get<ServerOptions>(parsed);
    const Expected<ListenAddress> address = parse_listen_address(options.listen);
    if (!address) return fail(address.error().message);
    block_stop_signals();
    return_large_memory();
    start_logging(options.log_level);
    return serve(options, *address);
}

}  // namespace
}  // namespace vsplit::ops

int main(int argc, char** argv) { return vsplit::ops::run(argc, argv); }
