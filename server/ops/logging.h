#pragma once

#include <spdlog/common.h>

#include "grpc/rpc_record.h"
#include "rest/connection.h"

namespace vsplit::ops {

/// Sends the program's log, and what gRPC itself has to say, to stderr: a line each, time in UTC.
void start_logging(spdlog::level::level_enum level);

/// One line for an rpc: method, code, milliseconds, session, and what went wrong.
void log_rpc(const rpc::RpcRecord& record);

/// One line for an HTTP request: method, target, status, milliseconds, bytes of the bodies.
void log_http(const rest::HttpRecord& record);

}  // namespace vsplit::ops
