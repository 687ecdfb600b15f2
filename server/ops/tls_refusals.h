#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "ops/metrics.h"

namespace vsplit::ops {

/// Clients with which no TLS came about: without the certificate that is asked for, of a strange authority, in plain text. Each
/// is counted, and one a second logged: whoever reaches the port can make any number. gRPC's are taken from its log while this
/// lives, of which there is to be one. Thread-safe.
class TlsRefusals {
public:
    /// `metrics` must outlive it.
    explicit TlsRefusals(Metrics& metrics);
    ~TlsRefusals();
    TlsRefusals(const TlsRefusals&) = delete;
    TlsRefusals& operator=(const TlsRefusals&) = delete;

    /// \param door "grpc" or "http" \param peer empty where it is not known
    void note(const std::string& door, const std::string& peer, const std::string& reason);

private:
    Metrics& metrics_;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point quiet_until_{};
    std::uint64_t untold_ = 0;
};

}  // namespace vsplit::ops
