#include "ops/metrics.h"

#include <google/protobuf/descriptor.h>
#include <prometheus/text_serializer.h>

#include <array>

#include "ops/process_use.h"
#include "vsplit/v1/meshing.grpc.pb.h"

namespace vsplit::ops {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Registry;

// From the quickest answer to a method of minutes, seconds.
const prometheus::Histogram::BucketBoundaries kSeconds{0.001, 0.005, 0.02, 0.1, 0.5, 2, 10, 60, 300};

Family<Counter>& counters(Registry& registry, const char* name, const char* help) {
    return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

Gauge& gauge(Registry& registry, const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

const char* code_name(grpc::StatusCode code) {
    static constexpr std::array kNames{
        "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
        "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
        "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
        "DATA_LOSS", "UNAUTHENTICATED"};
    const auto number = static_cast<std::size_t>(code);
    return number < kNames.size() ? kNames.at(number) : "UNKNOWN";
}

}  // namespace

Metrics::Metrics()
    : rpcs_(counters(registry_, "vsplit_rpcs_total", "Rpcs that ended")),
      seconds_(prometheus::BuildHistogram().Name("vsplit_rpc_seconds").Help("How long rpcs took").Register(registry_)),
      running_(gauge(registry_, "vsplit_rpcs_running", "Rpcs that run now")),
      bytes_in_(counters(registry_, "vsplit_message_bytes_total", "Bytes of messages").Add({{"direction", "in"}})),
      bytes_out_(counters(registry_, "vsplit_message_bytes_total", "Bytes of messages").Add({{"direction", "out"}})),
      requests_(counters(registry_, "vsplit_http_requests_total", "HTTP requests that ended; status 0 had no answer")),
      http_in_(counters(registry_, "vsplit_http_bytes_total", "Bytes of HTTP bodies").Add({{"direction", "in"}})),
      http_out_(counters(registry_, "vsplit_http_bytes_total", "Bytes of HTTP bodies").Add({{"direction", "out"}})),
      refused_(
          counters(registry_, "vsplit_connections_refused_total", "Connections over --max-connections, of both doors").Add({})),
      tls_failed_(counters(registry_, "vsplit_tls_handshakes_failed_total", "Clients with which no TLS came about")),
      jobs_(counters(registry_, "vsplit_jobs_total", "Methods that a worker was at, by outcome")),
      job_seconds_(prometheus::BuildHistogram().Name("vsplit_job_seconds").Help("How long methods ran").Register(registry_)),
      job_waited_(
          prometheus::BuildHistogram().Name("vsplit_job_wait_seconds").Help("How long methods waited").Register(registry_)),
      job_faces_(counters(registry_, "vsplit_job_faces_total", "Faces that methods were given, of those that succeeded")),
      sessions_(gauge(registry_, "vsplit_sessions", "Sessions that are held")),
      expired_(counters(registry_, "vsplit_sessions_expired_total", "Sessions that nobody used for --session-ttl").Add({})),
      methods_running_(gauge(registry_, "vsplit_jobs_running", "Methods that a worker is at")),
      methods_waiting_(gauge(registry_, "vsplit_jobs_queued", "Methods that wait")),
      memory_(gauge(registry_, "vsplit_memory_bytes", "Memory of meshes, representations and methods, as estimated")),
      memory_limit_(gauge(registry_, "vsplit_memory_limit_bytes", "What they may take together, --max-memory-bytes")),
      evictions_(counters(registry_, "vsplit_evictions_total", "Meshes and representations that left memory for others").Add({})),
      disk_(gauge(registry_, "vsplit_disk_bytes", "Meshes and representations in the data directory")),
      disk_limit_(gauge(registry_, "vsplit_disk_limit_bytes", "What they may take together, --max-disk-bytes; 0: no limit")),
      disk_free_(gauge(registry_, "vsplit_disk_free_bytes", "Room on the file system of uploads and of the data directory")),
      set_aside_(gauge(registry_, "vsplit_sessions_set_aside",
                       "Sessions in the data directory that are damaged and not served, and indices (damaged-N)")),
      blobs_aside_(gauge(registry_, "vsplit_blobs_set_aside", "Files in blobs/aside of the data directory, that no session has")),
      refuses_writes_(
          gauge(registry_, "vsplit_data_dir_refuses_writes",
                "1 while nothing can be written to the data directory: it is full or read-only; looked at every ten seconds")),
      files_unusable_(
          gauge(registry_, "vsplit_files_unusable",
                "Files of certificates and tokens that were changed and cannot be used; what they said before holds")),
      resident_(gauge(registry_, "process_resident_memory_bytes", "Memory of the process that is in RAM")),
      descriptors_(gauge(registry_, "process_open_fds", "Open file descriptors")),
      most_descriptors_(gauge(registry_, "process_max_fds", "Most open file descriptors")),
      started_(gauge(registry_, "process_start_time_seconds", "When the process began, seconds since 1970")) {
    started_.SetToCurrentTime();
    prometheus::BuildGauge()
        .Name("vsplit_build_info")
        .Help("1, with the version")
        .Register(registry_)
        .Add({{"version", VSPLIT_VERSION}})
        .Set(1);
    // A label's values are known from the first scrape on: a rate over a counter that appears late misses its first step.
    for (const char* method : {"Improve", "Control", "RemoveFeatures"}) {
        jobs_.Add({{"method", method}, {"outcome", "OK"}});
        job_faces_.Add({{"method", method}});
    }
    const auto* contract =
        google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(v1::Meshing::service_full_name());
    for (int i = 0; i < contract->method_count(); ++i) {
        for (const char* code : {"INTERNAL", "UNKNOWN", "DATA_LOSS"}) {
            rpcs_.Add({{"method", contract->method(i)->name()}, {"code", code}});
        }
    }
    requests_.Add({{"status", "401"}});
    for (const char* door : {"grpc", "http"}) tls_failed_.Add({{"door", door}});
}

void Metrics::rpc_began(std::string_view /*method*/) { running_.Increment(); }

void Metrics::rpc_ended(std::string_view method, grpc::StatusCode code, std::chrono::steady_clock::duration elapsed) {
    const std::string name(method);
    running_.Decrement();
    rpcs_.Add({{"method", name}, {"code", code_name(code)}}).Increment();
    seconds_.Add({{"method", name}}, kSeconds).Observe(std::chrono::duration<double>(elapsed).count());
}

void Metrics::message_in(std::size_t bytes) { bytes_in_.Increment(static_cast<double>(bytes)); }

void Metrics::message_out(std::size_t bytes) { bytes_out_.Increment(static_cast<double>(bytes)); }

void Metrics::http_ended(const rest::HttpRecord& record) {
    requests_.Add({{"status", std::to_string(record.status)}}).Increment();
    http_in_.Increment(static_cast<double>(record.bytes_in));
    http_out_.Increment(static_cast<double>(record.bytes_out));
}

void Metrics::session_expired() { expired_.Increment(); }

void Metrics::connection_refused() { refused_.Increment(); }

void Metrics::tls_failed(const std::string& door) { tls_failed_.Add({{"door", door}}).Increment(); }

void Metrics::job_ended(const service::JobRecord& record) {
    const std::string method(record.method);
    const std::string outcome(record.outcome ? cause_name(*record.outcome) : "OK");
    jobs_.Add({{"method", method}, {"outcome", outcome}}).Increment();
    job_seconds_.Add({{"method", method}}, kSeconds).Observe(record.seconds);
    job_waited_.Add({{"method", method}}, kSeconds).Observe(record.waited);
    if (!record.outcome) job_faces_.Add({{"method", method}}).Increment(record.faces_in);
}

void Metrics::file_read(const std::string& file, bool usable) {
    const std::lock_guard lock(reading_);
    if (usable) {
        unusable_.erase(file);
    } else {
        unusable_.insert(file);
    }
    files_unusable_.Set(static_cast<double>(unusable_.size()));
}

std::string Metrics::text(const service::ServiceLoad& load) {
    const std::lock_guard lock(scraping_);
    sessions_.Set(static_cast<double>(load.sessions));
    methods_running_.Set(static_cast<double>(load.methods_running));
    methods_waiting_.Set(static_cast<double>(load.methods_waiting));
    memory_.Set(static_cast<double>(load.memory.bytes));
    memory_limit_.Set(static_cast<double>(load.memory.limit));
    evictions_.Increment(static_cast<double>(load.memory.evictions) - evictions_.Value());
    disk_.Set(static_cast<double>(load.archive.bytes));
    disk_limit_.Set(static_cast<double>(load.archive.limit));
    disk_free_.Set(static_cast<double>(load.disk_free));
    set_aside_.Set(static_cast<double>(load.archive.set_aside));
    blobs_aside_.Set(static_cast<double>(load.archive.blobs_aside));
    refuses_writes_.Set(load.archive.writable ? 0 : 1);
    const ProcessUse use = process_use();
    resident_.Set(static_cast<double>(use.resident_bytes));
    descriptors_.Set(static_cast<double>(use.descriptors));
    most_descriptors_.Set(static_cast<double>(use.most_descriptors));
    return prometheus::TextSerializer().Serialize(registry_.Collect());
}

}  // namespace vsplit::ops
