#pragma once

#include <cstddef>
#include <memory>

#include "grpc/mailbox.h"
#include "grpc/message_source.h"
#include "service/meshing_service.h"
#include "service/resolution.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::rpc {

/// The base mesh and the records of a plan, in parts.
class LevelParts {
public:
    LevelParts(service::ResolutionPlan plan, RecordEncoding encoding);

    /// False when there are no more. O(a part).
    [[nodiscard]] bool next(v1::ProgressiveEvent& event);

private:
    void next_block(v1::ProgressiveEvent& event);

    const service::ResolutionPlan plan_;
    const RecordEncoding encoding_;
    std::size_t base_part_ = 0;
    std::size_t base_parts_ = 0;
    std::size_t region_part_ = 0;
    std::size_t region_parts_ = 0;
    std::size_t record_ = 0;
};

/// SetResolution: parts, and last the representation, whose figures an errand works out meanwhile.
class LevelSource final : public MessageSource<v1::ProgressiveEvent> {
public:
    /// \return NOT_FOUND, NOT_READY, INVALID_OPTION, UNAVAILABLE.
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const v1::SetResolutionRequest& request, const Wake& wake);

    [[nodiscard]] Step next(v1::ProgressiveEvent& event, grpc::Status& end) override;

private:
    using Last = Mailbox<Expected<v1::Representation>>;

    LevelSource(LevelParts parts, std::shared_ptr<Last> last) : parts_(std::move(parts)), last_(std::move(last)) {}

    LevelParts parts_;
    const std::shared_ptr<Last> last_;
    bool ended_ = false;
};

}  // namespace vsplit::rpc
