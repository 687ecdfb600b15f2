#include "ops/tls_refusals.h"

#include <spdlog/spdlog.h>

#include <string_view>
#include <utility>

#include "ops/logging.h"

namespace vsplit::ops {
namespace {

constexpr std::chrono::seconds kPause{1};

}  // namespace

TlsRefusals::TlsRefusals(Metrics& metrics) : metrics_(metrics) {
    on_grpc_tls_failure([this](std::string_view reason) { note("grpc", "", std::string(reason)); });
}

TlsRefusals::~TlsRefusals() { on_grpc_tls_failure({}); }

void TlsRefusals::note(const std::string& door, const std::string& peer, const std::string& reason) {
    metrics_.tls_failed(door);
    std::uint64_t more = 0;
    {
        const std::lock_guard lock(mutex_);
        const auto now = std::chrono::steady_clock::now();
        if (now < quiet_until_) return static_cast<void>(++untold_);
        quiet_until_ = now + kPause;
        more = std::exchange(untold_, 0);
    }
    spdlog::warn("no TLS at the {} door with {}: {}; {} more since the last of these lines", door,
                 peer.empty() ? "a client" : peer, reason, more);
}

}  // namespace vsplit::ops
