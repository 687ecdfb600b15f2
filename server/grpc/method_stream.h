#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "grpc/level_stream.h"
#include "grpc/mailbox.h"
#include "grpc/message_source.h"
#include "service/meshing_service.h"
#include "vsplit/v1/meshing.pb.h"

namespace vsplit::rpc {

/// Improve and Control: progress while the method waits and runs, then the result's parts, and last the representation. The first
/// word is always "queued"; of the progress that follows only the newest is kept, so a reader that falls behind misses some.
class MethodSource final : public MessageSource<v1::ProgressiveEvent> {
public:
    /// Starts the method. \return what MeshingService::start returns, INVALID_OPTION.
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const service::Caller& caller,
                                                                       const v1::ImproveRequest& request, const Wake& wake);
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> make(service::MeshingService& service,
                                                                       const service::Caller& caller,
                                                                       const v1::ControlRequest& request, const Wake& wake);

    [[nodiscard]] Step next(v1::ProgressiveEvent& event, grpc::Status& end) override;

    /// Cancels the method: nobody else could hear of its result.
    void cancel() override;

private:
    struct News {
        std::atomic<bool> noted = false;
        Mailbox<v1::Progress> progress;
        Mailbox<service::JobOutcome> outcome;
    };

    template <class Request>
    [[nodiscard]] static Expected<std::unique_ptr<MessageSource>> begin(service::MeshingService& service,
                                                                        const service::Caller& caller, const Request& request,
                                                                        const Wake& wake);

    MethodSource(service::MeshingService& service, service::RunningMethod running, std::shared_ptr<News> news,
                 const EncodingChoice& choice, Wake wake)
        : service_(service), running_(std::move(running)), news_(std::move(news)), choice_(choice), wake_(std::move(wake)) {}

    [[nodiscard]] Step next_news(v1::ProgressiveEvent& event, grpc::Status& end);
    [[nodiscard]] Step next_part(v1::ProgressiveEvent& event, grpc::Status& end);

    service::MeshingService& service_;
    const service::RunningMethod running_;
    const std::shared_ptr<News> news_;
    const EncodingChoice choice_;
    const Wake wake_;
    service::SessionSnapshot::RepresentationPointer result_;
    std::optional<LevelParts> parts_;
    bool begun_ = false;
    bool ended_ = false;
};

}  // namespace vsplit::rpc
