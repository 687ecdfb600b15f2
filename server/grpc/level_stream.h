#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "grpc/mailbox.h"
#include "grpc/message_source.h"
#include "service/meshing_service.h"
#include "service/resolution.h"
#include "vsplit/mrr/record_block.h"
#include "vsplit/v1/meshing.pb.h"
#include "wire/base_mesh.h"

namespace vsplit::rpc {

/// The base mesh and the records of a plan, in parts. What has to be worked out (all but FLOAT64) an errand does, a part ahead of
/// the reader: beside what all readers share, a stream holds the message under way and the one after it.
class LevelParts {
public:
    using Step = MessageSource<v1::ProgressiveEvent>::Step;

    /// `wake` is called when `next` said kWait and has more now. \pre the service outlives this.
    LevelParts(service::MeshingService& service, service::ResolutionPlan plan, const EncodingChoice& choice, Wake wake);

    /// kEnd when there are no more. O(a part). \return UNAVAILABLE; an error of the encoder.
    [[nodiscard]] Expected<Step> next(v1::ProgressiveEvent& event);

private:
    /// What an errand brings.
    struct Made {
        std::shared_ptr<service::EncodedRecords> encoded;
        std::optional<wire::PackedBaseMesh> base;
        service::EncodedRecords::Block block;
    };
    using MadeBox = Mailbox<Expected<Made>>;

    [[nodiscard]] bool next_regions(v1::ProgressiveEvent& event);
    [[nodiscard]] bool next_plain(v1::ProgressiveEvent& event);
    /// Sends a part of it, with what is the same in all of them.
    void send(v1::BaseMesh part, v1::ProgressiveEvent& event) const;
    /// What the stream begins with: the coarsest mesh or a keyframe.
    [[nodiscard]] const TriangleMesh& plain_base() const { return plan_.keyframe ? *plan_.keyframe : plan_.levels->mrr().base; }
    [[nodiscard]] Status take_made();
    [[nodiscard]] Status make_block();
    [[nodiscard]] Status begin_errand();
    void send(RecordBlock block, v1::ProgressiveEvent& event);

    service::MeshingService* service_;
    service::ResolutionPlan plan_;
    EncodingChoice choice_;
    Wake wake_;
    std::size_t base_part_ = 0;
    std::size_t base_parts_ = 0;
    std::size_t region_part_ = 0;
    std::size_t region_parts_ = 0;
    std::size_t record_ = 0;
    Made made_;
    bool waiting_ = false;
    std::shared_ptr<MadeBox> box_ = std::make_shared<MadeBox>();
};

/// SetResolution: parts, and last the representation, whose figures an errand works out meanwhile.
class LevelSource final : public MessageSource<v1::ProgressiveEvent> {
public:
    /// \return NOT_FOUND, NOT_READY, INVALID_OPTION (encoding), UNAVAILABLE. What else is wrong with the request the stream ends
    /// with.
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const service::Caller& caller,
                                                                       const v1::SetResolutionRequest& request, const Wake& wake);

    [[nodiscard]] Step next(v1::ProgressiveEvent& event, grpc::Status& end) override;

private:
    /// What the errand brings: first where to begin, later what the level is like.
    struct News {
        Mailbox<Expected<service::ResolutionPlan>> plan;
        Mailbox<Expected<v1::Representation>> last;
    };

    LevelSource(service::MeshingService& service, const EncodingChoice& choice, Wake wake, std::shared_ptr<News> news)
        : service_(service), choice_(choice), wake_(std::move(wake)), news_(std::move(news)) {}

    [[nodiscard]] Expected<Step> next_or_error(v1::ProgressiveEvent& event);

    service::MeshingService& service_;
    const EncodingChoice choice_;
    const Wake wake_;
    const std::shared_ptr<News> news_;
    std::optional<LevelParts> parts_;
    bool ended_ = false;
};

}  // namespace vsplit::rpc
