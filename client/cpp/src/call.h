#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <stop_token>
#include <string>

#include "vsplit/base/error.h"
#include "vsplit/client/call_options.h"

namespace vsplit::client {

/// The context of one call: its deadline, and its end when a stop is requested.
class Call {
public:
    explicit Call(const CallOptions& options);

    [[nodiscard]] grpc::ClientContext* context() { return &context_; }
    void cancel() { context_.TryCancel(); }

private:
    grpc::ClientContext context_;
    std::stop_callback<std::function<void()>> on_stop_;  // last: it may fire while it is made
};

/// The error of a failed call; says which server when it is the connection that failed. \pre !status.ok().
[[nodiscard]] Error call_error(const grpc::Status& status, const std::string& target);

}  // namespace vsplit::client
