#include "call.h"

#include <chrono>

#include "wire/error_table.h"

namespace vsplit::client {

Call::Call(const CallOptions& options) : on_stop_(options.stop, [this] { context_.TryCancel(); }) {
    if (options.deadline) context_.set_deadline(std::chrono::system_clock::now() + *options.deadline);
}

Error call_error(const grpc::Status& status, const std::string& target) {
    Error error = wire::from_status(status);
    if (error.cause == Cause::kUnavailable) error.message = "server " + target + ": " + error.message;
    if (error.cause == Cause::kUnsupported && status.error_details().empty()) {  // not vsplit's own word
        error.message = "server " + target + " does not offer this call (is it a vsplit server?): " + error.message;
    }
    return error;
}

}  // namespace vsplit::client
