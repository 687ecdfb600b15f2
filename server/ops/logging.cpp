#include "ops/logging.h"

#include <grpc/support/log.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <string>
#include <utility>

#include "service/quoted.h"
#include "wire/error_table.h"

namespace vsplit::ops {
namespace {

// For who looks for a fault in gRPC: what it calls an error is often a client that went away, and what matters to people is said
// by the program in words of its own.
void log_grpc(gpr_log_func_args* args) { spdlog::debug("grpc: {}", args->message); }

}  // namespace

void start_logging(spdlog::level::level_enum level) {
    auto logger = std::make_shared<spdlog::logger>("vsplitd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_level(level);
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
    logger->flush_on(spdlog::level::debug);
    spdlog::set_default_logger(std::move(logger));
    gpr_set_log_function(log_grpc);
}

void log_rpc(const rpc::RpcRecord& record) {
    const double ms = std::chrono::duration<double, std::milli>(record.elapsed).count();
    const std::string session = record.session.empty() ? "-" : service::quoted(record.session);
    if (record.status.ok()) {
        spdlog::info("rpc {} OK {:.1f} ms session {}", record.method, ms, session);
        return;
    }
    const Error error = wire::from_status(record.status);
    spdlog::info("rpc {} {} {:.1f} ms session {}: {}", record.method, cause_name(error.cause), ms, session, error.message);
}

void log_http(const rest::HttpRecord& record) {
    const double ms = std::chrono::duration<double, std::milli>(record.elapsed).count();
    spdlog::info("http {} {} {} {:.1f} ms in {} out {}", service::quoted(record.method), service::quoted(record.target),
                 record.status, ms, record.bytes_in, record.bytes_out);
}

}  // namespace vsplit::ops
