#pragma once

#include <grpcpp/support/status.h>

#include <functional>

namespace vsplit::rpc {

/// Where the messages of a stream come from, one at a time and only when the one before is on its way: what a slow reader has not
/// asked for does not exist yet.
template <class M>
class MessageSource {
public:
    using Message = M;

    enum class Step {
        kMessage,  ///< `message` was filled
        kWait,     ///< nothing yet; the source wakes the stream when to ask again
        kEnd,      ///< no more; `end` is the stream's status
    };

    MessageSource() = default;
    virtual ~MessageSource() = default;
    MessageSource(const MessageSource&) = delete;
    MessageSource& operator=(const MessageSource&) = delete;

    /// The next message. Never called twice at a time; must not block. `message` is what it was made the time before.
    [[nodiscard]] virtual Step next(Message& message, grpc::Status& end) = 0;

    /// Nobody listens any more; `next` is not called again.
    virtual void cancel() {}
};

/// Makes a stream ask its source again. Any thread; harmless when the stream is gone.
using Wake = std::function<void()>;

}  // namespace vsplit::rpc
