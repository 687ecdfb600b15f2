#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <chrono>
#include <cstddef>
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
/// (bodies, by direction) are HTTP's own.
class Metrics final : public rpc::RpcMeter {
public:
    Metrics();

    void rpc_began(std::string_view method) override;
    void rpc_ended(std::string_view method, grpc::StatusCode code, std::chrono::steady_clock::duration elapsed) override;
    void message_in(std::size_t bytes) override;
    void message_out(std::size_t bytes) override;
    void http_ended(const rest::HttpRecord& record);

    /// Everything in Prometheus' text format, with the load of this moment.
    [[nodiscard]] std::string text(const service::ServiceLoad& load);

private:
    prometheus::Registry registry_;
    prometheus::Family<prometheus::Counter>& rpcs_;
    prometheus::Family<prometheus::Histogram>& seconds_;
    prometheus::Gauge& running_;
    prometheus::Counter& bytes_in_;
    prometheus::Counter& bytes_out_;
    prometheus::Family<prometheus::Counter>& requests_;
    prometheus::Counter& http_in_;
    prometheus::Counter& http_out_;
    prometheus::Gauge& sessions_;
    prometheus::Gauge& methods_running_;
    prometheus::Gauge& methods_waiting_;
};

}  // namespace vsplit::ops
