#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "grpc/rpc_record.h"
#include "rest/connection.h"
#include "service/method_job.h"
#include "vsplit/base/expected.h"

namespace vsplit::ops {

/// What is logged, and how.
struct LogOptions {
    std::string level = "info";  ///< debug, info, warning, error, off
    bool json = false;           ///< an object a line, with time, level, event, message and what the event has
    double slow_job = 0;         ///< seconds; a method that takes longer is a warning; 0: none
};

/// Sends the program's log, and what gRPC itself has to say, to stderr: a line each, time in UTC. Nobody waits for who reads it:
/// where it is not read the oldest lines are dropped, and counted.
void start_logging(const LogOptions& options);

/// Gives the log a moment to be written; at the program's end.
void flush_log();

/// Hears from now on, on any thread, why a client of gRPC's door has no TLS; empty: nobody does.
void on_grpc_tls_failure(std::function<void(std::string_view reason)> hear);

/// One line for an rpc: method, code, milliseconds, session, request, and what went wrong.
void log_rpc(const rpc::RpcRecord& record);

/// One line for an HTTP request: method, target, status, milliseconds, bytes of the bodies, request.
void log_http(const rest::HttpRecord& record);

/// One line for a method that took longer than slow_job; nothing for another.
void log_job(const service::JobRecord& record);

/// One line for a file that was read anew.
void log_reload(const std::string& file, const Status& read);

}  // namespace vsplit::ops
