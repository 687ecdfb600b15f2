#pragma once

#include <optional>

#include "vsplit/base/expected.h"
#include "vsplit/client/call_options.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/base_mesh.h"

namespace vsplit::client {

/// Takes the events of one stream, in order, and hands them to the handlers.
class EventStream {
public:
    explicit EventStream(const EventHandlers& handlers) : handlers_(handlers) {}

    /// \return OUT_OF_ORDER, CORRUPT, LIMIT_EXCEEDED for events that break the contract; what a handler returned.
    [[nodiscard]] Status take(v1::ProgressiveEvent event);

    /// What a stream that succeeded ends with. \return CORRUPT when it ended without.
    [[nodiscard]] Expected<v1::Representation> finish();

private:
    [[nodiscard]] Status take_base(const v1::BaseMesh& part);
    [[nodiscard]] Status take_block(v1::RecordBlock block);

    const EventHandlers& handlers_;
    std::optional<wire::BaseMeshAssembler> base_;  // while its parts come
    std::optional<v1::Representation> representation_;
};

}  // namespace vsplit::client
