#pragma once

#include <grpcpp/support/status.h>

#include "grpc/call_origin.h"
#include "grpc/rpc_meter.h"
#include "grpc/rpc_record.h"
#include "guard/gatekeeper.h"

namespace vsplit::rpc {

/// Refuses rpcs of the contract that carry no token which the server knows, at their header: gRPC gives an rpc to its handler
/// with its whole message only, and a stranger's messages are to take no memory. Everything else is decided when the handler has
/// the rpc. Thread-safe.
class StrangerCheck {
public:
    /// \param gate, meter may be null; what is not must outlive the check. Both hear of rpcs that are refused as of any others.
    StrangerCheck(RpcObserver observer, guard::Gatekeeper* gate, RpcMeter* meter);

    /// \param header of an rpc, with its ":path". O(tokens). \return OK, UNAUTHENTICATED.
    [[nodiscard]] grpc::Status look(const HeaderLookup& header) const;

private:
    const RpcObserver observer_;
    guard::Gatekeeper* const gate_;
    RpcMeter* const meter_;
};

}  // namespace vsplit::rpc
