#include "ops/logging.h"

#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "grpc/tls_failures.h"
#include "ops/line_writer.h"
#include "ops/log_line.h"
#include "service/quoted.h"
#include "wire/error_table.h"

namespace vsplit::ops {
namespace {

using Json = nlohmann::ordered_json;
using Level = spdlog::level::level_enum;

// Set once, before there are threads.
LogOptions& options() {
    static LogOptions held;
    return held;
}

struct TlsListener {
    std::mutex mutex;
    std::function<void(std::string_view)> hear;
};

// gRPC's log knows a function only.
TlsListener& tls_listener() {
    static TlsListener held;
    return held;
}

// For who looks for a fault in gRPC: what it calls an error is often a client that went away, and what matters to people is said
// by the program in words of its own.
void log_grpc(gpr_log_func_args* args) {
    if (const std::optional<std::string_view> reason = rpc::tls_failure_in(*args)) {
        TlsListener& listener = tls_listener();
        const std::lock_guard lock(listener.mutex);
        if (listener.hear) listener.hear(*reason);
    }
    if (spdlog::should_log(spdlog::level::debug)) spdlog::debug("grpc: {}", args->message);
}

// As above: a client that sends letters that are none gets its answer.
void log_protobuf(google::protobuf::LogLevel /*level*/, const char* /*file*/, int /*line*/, const std::string& message) {
    if (spdlog::should_log(spdlog::level::debug)) spdlog::debug("protobuf: {}", message);
}

class Sink final : public spdlog::sinks::base_sink<std::mutex> {
public:
    explicit Sink(bool json)
        : writer_(STDERR_FILENO, [json](std::uint64_t lines) {
              return log_line(json, Level::warn, std::to_string(lines) + " lines of the log were dropped: stderr was not read");
          }) {
        formatter_ = log_formatter(json);
    }

    bool wait(std::chrono::milliseconds longest) { return writer_.flush(longest); }

protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        writer_.put(fmt::to_string(line));
    }

    void flush_() override {}

private:
    LineWriter writer_;
};

std::shared_ptr<Sink>& sink() {
    static std::shared_ptr<Sink> held;
    return held;
}

std::shared_ptr<spdlog::logger>& objects() {
    static std::shared_ptr<spdlog::logger> held;
    return held;
}

void write(Level level, const Json& json) { objects()->log(level, spdlog::string_view_t(json_text(json))); }

double milliseconds(std::chrono::steady_clock::duration time) {
    constexpr double kTenths = 10;
    return std::round(std::chrono::duration<double, std::milli>(time).count() * kTenths) / kTenths;
}

void add_origin(Json& json, const std::string& request, const wire::TraceContext& trace, const std::string& parent,
                const std::string& peer) {
    json["request"] = request;
    json["trace"] = trace.trace_id;
    json["span"] = trace.span_id;
    if (!parent.empty()) json["parent_span"] = parent;
    if (!peer.empty()) json["peer"] = peer;
}

Json rpc_json(const rpc::RpcRecord& record) {
    Json json{{"event", "rpc"}, {"method", std::string(record.method)}, {"code", "OK"}, {"ms", milliseconds(record.elapsed)}};
    add_origin(json, record.origin.request_id, record.origin.trace, record.origin.parent_span, record.origin.peer);
    constexpr std::size_t kMost = 64;
    if (!record.session.empty()) json["session"] = record.session.substr(0, kMost);
    if (!record.owner.empty()) json["token"] = record.owner;
    if (record.status.ok()) return json;
    const Error error = wire::from_status(record.status);
    json["code"] = std::string(cause_name(error.cause));
    json["message"] = error.message;
    return json;
}

}  // namespace

void start_logging(const LogOptions& wanted) {
    options() = wanted;
    sink() = std::make_shared<Sink>(wanted.json);
    auto logger = std::make_shared<spdlog::logger>("vsplitd", sink());
    logger->set_level(wanted.level == "error" ? spdlog::level::err : spdlog::level::from_str(wanted.level));
    objects() = logger->clone(kObjectLogger);
    spdlog::set_default_logger(std::move(logger));
    gpr_set_log_function(log_grpc);
    google::protobuf::SetLogHandler(log_protobuf);
}

void on_grpc_tls_failure(std::function<void(std::string_view reason)> hear) {
    const std::lock_guard lock(tls_listener().mutex);
    tls_listener().hear = std::move(hear);
}

void flush_log() {
    constexpr std::chrono::seconds kLongest{1};
    if (sink() != nullptr) sink()->wait(kLongest);
}

void log_rpc(const rpc::RpcRecord& record) {
    if (!spdlog::should_log(Level::info)) return;
    if (options().json) return write(Level::info, rpc_json(record));
    const double ms = milliseconds(record.elapsed);
    const std::string session = record.session.empty() ? "-" : service::quoted(record.session);
    if (record.status.ok()) {
        spdlog::info("rpc {} OK {:.1f} ms session {} request {}", record.method, ms, session, record.origin.request_id);
        return;
    }
    const Error error = wire::from_status(record.status);
    spdlog::info("rpc {} {} {:.1f} ms session {} request {}: {}", record.method, cause_name(error.cause), ms, session,
                 record.origin.request_id, error.message);
}

void log_http(const rest::HttpRecord& record) {
    if (!spdlog::should_log(Level::info)) return;
    const double ms = milliseconds(record.elapsed);
    if (options().json) {
        Json json{{"event", "http"}, {"method", record.method},     {"target", record.target},      {"status", record.status},
                  {"ms", ms},        {"bytes_in", record.bytes_in}, {"bytes_out", record.bytes_out}};
        add_origin(json, record.mark.id, record.mark.trace, record.mark.parent_span, record.mark.peer);
        return write(Level::info, json);
    }
    spdlog::info("http {} {} {} {:.1f} ms in {} out {} request {}", service::quoted(record.method),
                 service::quoted(record.target), record.status, ms, record.bytes_in, record.bytes_out, record.mark.id);
}

void log_job(const service::JobRecord& record) {
    if (options().slow_job <= 0 || record.seconds < options().slow_job) return;
    const std::string outcome(record.outcome ? cause_name(*record.outcome) : "OK");
    if (options().json) {
        return write(Level::warn, Json{{"event", "slow_job"},
                                       {"method", std::string(record.method)},
                                       {"code", outcome},
                                       {"seconds", record.seconds},
                                       {"waited", record.waited},
                                       {"faces_in", record.faces_in},
                                       {"faces_out", record.faces_out},
                                       {"session", record.session},
                                       {"request", record.mark.request_id},
                                       {"trace", record.mark.trace_id},
                                       {"span", record.mark.span_id}});
    }
    spdlog::warn("slow job: {} {} {:.1f} s after {:.1f} s of waiting, {} faces in, {} out, session {} request {}", record.method,
                 outcome, record.seconds, record.waited, record.faces_in, record.faces_out, record.session,
                 record.mark.request_id);
}

void log_reload(const std::string& file, const Status& read) {
    if (read) {
        spdlog::info("read anew: {}", file);
    } else {
        spdlog::error("cannot be used as changed, what held before holds: {}: {}", file, read.error().message);
    }
}

}  // namespace vsplit::ops
