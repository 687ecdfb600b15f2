#pragma once

#include <stop_token>

#include "cli/arguments.h"
#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"

namespace vsplit::cli {

/// How to reach the server: TLS and the token as the command line has them; where it names no file of a token, that of the
/// variable VSPLIT_TOKEN; and the trace of TRACEPARENT. \return FILE_ACCESS, EMPTY_INPUT for the token's file.
[[nodiscard]] Expected<client::ConnectOptions> connect_options(const Arguments& arguments, const std::stop_token& stop);

}  // namespace vsplit::cli
