#pragma once

#include <cstddef>

#include "service/representation.h"
#include "service/session_snapshot.h"
#include "vsplit/v1/meshing.pb.h"

/// What the service knows, as messages.
namespace vsplit::rpc {

[[nodiscard]] v1::Session to_proto(const service::SessionSnapshot& session);

/// What a list of sessions leaves out of each.
void shorten_groups(v1::Session& session);

/// At the resolution it was made for. O(1).
[[nodiscard]] v1::Representation to_proto(const service::Representation& representation);

/// At another level. Heavy: O(level + faces log faces).
[[nodiscard]] v1::Representation to_proto(const service::Representation& representation, const service::Levels& levels,
                                          std::size_t level);

}  // namespace vsplit::rpc
