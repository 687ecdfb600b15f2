#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <string_view>

#include "rest/exchange.h"
#include "rest/json_body.h"
#include "rest/router.h"
#include "rest/rpc_client.h"
#include "rest/turns.h"

namespace vsplit::rest {

/// What every handler needs.
struct Tools {
    RpcClient& rpcs;
    JsonWorks json;
    Turns& files;  ///< to begin to send one
};

inline constexpr std::string_view kBytesType = "application/octet-stream";

/// One function a shape of rpc: it reads what it needs of the body, calls the rpc, and writes the answer. None throws but
/// bad_alloc.
Awaitable<void> serve_unary(Exchange& exchange, const Route& route, const Target& target, Tools tools);

/// Accept decides: the result as JSON when it is there, an event a line, or the events as they are.
Awaitable<void> serve_events(Exchange& exchange, const Route& route, const Target& target, Tools tools);

/// A file, or the range of it that is asked for. Every file is also just bytes.
Awaitable<void> serve_file(Exchange& exchange, const Route& route, const Target& target, Tools tools);

/// The body goes in as it comes, a chunk at a time.
Awaitable<void> serve_upload(Exchange& exchange, const Route& route, const Target& target, Tools tools);

/// Whether the rpc takes a mesh as its body beside JSON: CreateSession.
[[nodiscard]] bool takes_mesh_body(const google::protobuf::MethodDescriptor& rpc);

/// Whether the request creates a session and brings its mesh: a CreateSession whose body is something but no JSON.
[[nodiscard]] bool creates_with_mesh(Exchange& exchange, const Route& route);

/// CreateSession, then UploadMesh into it; when that fails, there is no session.
Awaitable<void> serve_create_with_mesh(Exchange& exchange, const Route& route, const Target& target, Tools tools);

}  // namespace vsplit::rest
