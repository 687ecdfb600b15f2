#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "grpc/rpc_meter.h"
#include "rest/connection.h"
#include "service/meshing_service.h"

namespace vsplit::ops {

/// What the server counts, for /metrics. Thread-safe.
///
/// vsplit_rpc_seconds (histogram by method) and vsplit_rpcs_total (by method and code) count an rpc once, whichever door it came
/// by; vsplit_message_bytes_total (by direction) its messages. vsplit_http_requests_total (by status) and vsplit_http_bytes_total
/// (bodies, by direction) are HTTP's own, vsplit_connections_refused_total and vsplit_tls_handshakes_failed_total (by door) are
/// of both doors' connections. vsplit_jobs_total (by method and outcome), vsplit_job_seconds, vsplit_job_wait_seconds and
/// vsplit_job_faces_total (by method) are of methods that a worker was at. vsplit_memory_bytes and vsplit_evictions_total are of
/// the budget of memory, vsplit_disk_bytes, vsplit_sessions_set_aside, vsplit_blobs_set_aside and vsplit_data_dir_refuses_writes
/// of the data directory, vsplit_files_unusable of certificates and tokens. process_* are those that Prometheus' clients have.
class Metrics final : public rpc::RpcMeter {
public:
    Metrics();

    void rpc_began(std::string_view method) override;
    void rpc_ended(std::string_view method, grpc::StatusCode code, std::chrono::steady_clock::duration elapsed) override;
    void message_in(std::size_t bytes) override;
    void message_out(std::size_t bytes) override;
    void http_ended(const rest::HttpRecord& record);
    void connection_refused();
    /// No TLS came about with a client at the door "grpc" or "http".
    void tls_failed(const std::string& door);
    void job_ended(const service::JobRecord& record);
    void session_expired();
    /// A file that is watched was read anew, or could not be used.
    void file_read(const std::string& file, bool usable);

    /// Everything in Prometheus' text format, with the load of this moment.
    [[nodiscard]] std::string text(const service::ServiceLoad& load);

private:
    std::mutex scraping_;  // one scrape moves the counters that are read off elsewhere at a time
    prometheus::Registry registry_;
    prometheus::Family<prometheus::Counter>& rpcs_;
    prometheus::Family<prometheus::Histogram>& seconds_;
    prometheus::Gauge& running_;
    prometheus::Counter& bytes_in_;
    prometheus::Counter& bytes_out_;
    prometheus::Family<prometheus::Counter>& requests_;
    prometheus::Counter& http_in_;
    prometheus::Counter& http_out_;
    prometheus::Counter& refused_;
    prometheus::Family<prometheus::Counter>& tls_failed_;
    prometheus::Family<prometheus::Counter>& jobs_;
    prometheus::Family<prometheus::Histogram>& job_seconds_;
    prometheus::Family<prometheus::Histogram>& job_waited_;
    prometheus::Family<prometheus::Counter>& job_faces_;
    prometheus::Gauge& sessions_;
    prometheus::Counter& expired_;
    prometheus::Gauge& methods_running_;
    prometheus::Gauge& methods_waiting_;
    prometheus::Gauge& memory_;
    prometheus::Gauge& memory_limit_;
    prometheus::Counter& evictions_;
    prometheus::Gauge& disk_;
    prometheus::Gauge& disk_limit_;
    prometheus::Gauge& disk_free_;
    prometheus::Gauge& set_aside_;
    prometheus::Gauge& blobs_aside_;
    prometheus::Gauge& refuses_writes_;
    prometheus::Gauge& files_unusable_;
    std::mutex reading_;
    std::set<std::string> unusable_;  // files
    prometheus::Gauge& resident_;
    prometheus::Gauge& descriptors_;
    prometheus::Gauge& most_descriptors_;
    prometheus::Gauge& started_;
};

}  // namespace vsplit::ops
