#include "service/upload.h"

#include <string>
#include <utility>

namespace vsplit::service {

Status check_upload_bytes(std::uint64_t bytes, const Limits& limits, const char* field) {
    if (bytes <= limits.upload_bytes) return Done{};
    return Error{Cause::kLimitExceeded,
                 "the file has " + std::to_string(bytes) + " bytes or more; the server's limit max_upload_bytes is " +
                     std::to_string(limits.upload_bytes),
                 field};
}

Upload::Upload(std::shared_ptr<Session> session, const UploadSettings& settings, const Limits& limits, MemoryBudget& memory,
               std::unique_ptr<UploadRoom::Share> room, TempFile file)
    : session_(std::move(session)),
      held_(Session::hold(session_)),
      settings_(settings),
      limits_(limits),
      memory_(&memory),
      room_(std::move(room)),
      file_(std::move(file)) {}

Expected<Upload> Upload::begin(std::shared_ptr<Session> session, const UploadSettings& settings, const ServiceOptions& options,
                               MemoryBudget& memory, UploadRoom& disk) {
    const Limits& limits = options.limits;
    if (Status fits = check_upload_bytes(settings.size.value_or(0), limits, "size"); !fits) return fits.error();
    if (Status room = disk.require(settings.size.value_or(0)); !room) return room.error();
    if (Status ok = check_settings(settings.mesh); !ok) return ok.error();
    if (Status idle = session->require_idle(); !idle) return idle.error();
    Expected<TempFile> file = TempFile::create(options.temp_directory);
    if (!file) return file.error();
    return Upload(std::move(session), settings, limits, memory, disk.share(), *std::move(file));
}

Status Upload::append(std::uint64_t offset, std::span<const std::byte> bytes) {
    session_->touch();
    const std::uint64_t expected = file_.size();
    if (offset != expected) {
        return Error{Cause::kOutOfOrder,
                     "offset is " + std::to_string(offset) + ", expected is " + std::to_string(expected) +
                         ", the number of bytes received before",
                     "offset"};
    }
    const std::uint64_t total = expected + bytes.size();
    if (Status fits = check_upload_bytes(total, limits_, "data"); !fits) return fits;
    if (settings_.size && total > *settings_.size) {
        return Error{Cause::kMalformedInput,
                     "at least " + std::to_string(total) + " bytes came, " + std::to_string(*settings_.size) + " were declared",
                     "size"};
    }
    if (Status room = room_->grow(bytes.size()); !room) return room;
    return file_.append(bytes);
}

Expected<SessionSnapshot> Upload::commit(const std::function<bool()>& still_wanted) const {
    if (settings_.size && file_.size() < *settings_.size) {
        return Error{Cause::kTruncatedInput,
                     "the upload ended after " + std::to_string(file_.size()) + " bytes, " + std::to_string(*settings_.size) +
                         " were declared",
                     "size"};
    }
    const Expected<FileMapping> mapped = file_.map();
    if (!mapped) return mapped.error();
    Expected<std::shared_ptr<const SourceMesh>> source =
        read_source(mapped->bytes(), settings_.mesh, limits_, *memory_, still_wanted);
    if (!still_wanted()) return Error{Cause::kCancelled, "the upload was cut off; the session is as it was", ""};
    if (!source) return source.error();
    if (Status set = session_->set_source(*source); !set) return set.error();
    session_->touch();
    return session_->snapshot();
}

}  // namespace vsplit::service
