#pragma once

#include <grpcpp/support/status.h>

#include "grpc/call_origin.h"
#include "grpc/live_calls.h"
#include "grpc/rpc_meter.h"
#include "grpc/rpc_record.h"
#include "guard/gatekeeper.h"

namespace vsplit::rpc {

/// Refuses at their header rpcs of the contract that carry no token which the server knows, and any over the limit of LiveCalls:
/// gRPC gives an rpc to its handler with its whole message only, and a stranger's are to take no memory. Everything else is
/// decided when the handler has the rpc. Thread-safe.
class StrangerCheck {
public:
    /// \param gate, meter may be null; what is not must outlive the check. Observer and meter hear of rpcs of the contract that
    /// are refused as of any others, the meter alone of the rest.
    StrangerCheck(const LiveCalls& live, RpcObserver observer, guard::Gatekeeper* gate, RpcMeter* meter);

    /// \param header of an rpc, with its ":path". O(tokens). \return OK, UNAUTHENTICATED, RESOURCE_EXHAUSTED.
    [[nodiscard]] grpc::Status look(const grpc_auth_context* connection, const HeaderLookup& header) const;

private:
    [[nodiscard]] Status decide(const grpc_auth_context* connection, const HeaderLookup& header) const;
    void tell(const HeaderLookup& header, const grpc::Status& refused) const;

    const LiveCalls& live_;
    const RpcObserver observer_;
    guard::Gatekeeper* const gate_;
    RpcMeter* const meter_;
};

}  // namespace vsplit::rpc
