#include "grpc/upload_stream.h"

#include <span>
#include <string>
#include <utility>

#include "grpc/replies.h"
#include "service/guarded.h"
#include "wire/convert.h"
#include "wire/error_table.h"

namespace vsplit::rpc {
namespace {

Error cut_off() { return {Cause::kCancelled, "the upload was cut off; the session is as it was", ""}; }

Error shutting_down() { return {Cause::kUnavailable, "the server is shutting down", ""}; }

Expected<service::UploadSettings> settings_of(const v1::UploadMeshRequest& first) {
    const Expected<std::optional<MeshFormat>> format = wire::from_proto(first.format());
    if (!format) return format.error();
    const Expected<std::optional<RepairOptions>> repair = wire::repair_of(first);
    if (!repair) return repair.error();
    const Expected<std::optional<LengthUnit>> unit = wire::from_proto(first.unit());
    if (!unit) return unit.error();
    service::UploadSettings settings{{*format, first.weld(), *repair, *unit}, std::nullopt};
    if (first.has_size()) settings.size = first.size();
    return settings;
}

Error changed(const char* field) {
    return {
        Cause::kInvalidOption,
        std::string(field) + " is not what the first message of the upload said; give it there and leave it out or equal later",
        field};
}

}  // namespace

UploadStream::UploadStream(service::MeshingService& service, RpcWatch watch, v1::Session* response,
                           const service::Patience& patience)
    : service_(service), watch_(std::move(watch)), response_(response), patience_(patience) {
    if (const Status open = watch_.admit(); open) {
        read();
    } else {
        end(open);  // before the client has sent anything
    }
}

Error UploadStream::stalled() const {
    return {Cause::kUnavailable,
            "the upload stopped after " + std::to_string(received_) + " bytes or came too slowly; " + patience_.accepted() +
                "; the session is as it was, send the mesh again",
            ""};
}

// An alarm that has been cancelled may still call, when the stream is gone: what it looks at first is its own.
void UploadStream::read() {
    reading_ = std::make_shared<std::atomic<bool>>(true);
    alarm_.emplace();
    const auto now = std::chrono::steady_clock::now();
    const auto left = patience_.deadline(start_, now, received_) - now;
    alarm_->Set(std::chrono::system_clock::now() + left, [this, reading = reading_](bool rang) {
        if (rang && reading->exchange(false)) end(stalled());
    });
    StartRead(&part_);
}

void UploadStream::OnReadDone(bool ok) {
    if (!reading_->exchange(false)) return;  // its end came first
    alarm_.reset();
    // Whether the client has sent everything or is gone, a failed read does not tell, and the news of a cancel may come later. So
    // something is sent: that fails on a stream which is closed already.
    if (!ok) return StartSendInitialMetadata();
    if (!service_.disk_errand([this] { read_on(); })) end(shutting_down());
}

void UploadStream::OnSendInitialMetadataDone(bool ok) {
    if (!ok) return end(cut_off());
    if (!service_.intake([this] { finish_upload(); })) end(shutting_down());
}

void UploadStream::finish_upload() {
    end(service::guarded([this] { return commit(); }));
}

void UploadStream::read_on() {
    const Status taken = service::guarded([this] { return take_part(); });
    if (!taken) return end(taken);
    read();
}

Status UploadStream::take_part() {
    received_ += part_.data().size();
    Status ready = upload_ ? check_repeated() : begin();
    if (!ready) return ready;
    return upload_->append(part_.offset(), std::as_bytes(std::span(part_.data())));
}

Status UploadStream::begin() {
    watch_.set_session(part_.session());
    if (Status open = watch_.admit(); !open) return open;
    const Expected<service::UploadSettings> settings = settings_of(part_);
    if (!settings) return settings.error();
    Expected<service::Upload> upload = service_.begin_upload(part_.session(), *settings, watch_.caller());
    if (!upload) return upload.error();
    upload_ = *std::move(upload);
    first_.set_session(part_.session());
    first_.set_format(part_.format());
    first_.set_weld(part_.weld());
    first_.set_repair(part_.repair());
    first_.set_unit(part_.unit());
    if (part_.has_stitch()) first_.set_stitch(part_.stitch());
    if (part_.has_hole_size()) first_.set_hole_size(part_.hole_size());
    if (part_.has_speck_size()) first_.set_speck_size(part_.speck_size());
    if (part_.has_size()) first_.set_size(part_.size());
    return Done{};
}

Status UploadStream::check_repeated() const {
    if (!part_.session().empty() && part_.session() != first_.session()) return changed("session");
    if (part_.format() != v1::MESH_FORMAT_UNSPECIFIED && part_.format() != first_.format()) return changed("format");
    if (part_.weld() != 0 && part_.weld() != first_.weld()) return changed("weld");
    if (part_.repair() != v1::REPAIR_UNSPECIFIED && part_.repair() != first_.repair()) return changed("repair");
    if (part_.unit() != v1::LENGTH_UNIT_UNSPECIFIED && part_.unit() != first_.unit()) return changed("unit");
    const auto differs = [](bool given, double now, bool known, double first) { return given && (!known || now != first); };
    if (differs(part_.has_stitch(), part_.stitch(), first_.has_stitch(), first_.stitch())) return changed("stitch");
    if (differs(part_.has_hole_size(), part_.hole_size(), first_.has_hole_size(), first_.hole_size()))
        return changed("hole_size");
    if (differs(part_.has_speck_size(), part_.speck_size(), first_.has_speck_size(), first_.speck_size()))
        return changed("speck_size");
    if (part_.has_size() && (!first_.has_size() || part_.size() != first_.size())) return changed("size");
    return Done{};
}

Status UploadStream::commit() {
    if (!upload_) {
        return Error{Cause::kInvalidOption, "the upload has no message; the first one names the session", "session"};
    }
    const Expected<service::SessionSnapshot> session = upload_->commit([this] { return !cancelled_; });
    if (!session) return session.error();
    *response_ = to_proto(*session);
    return Done{};
}

void UploadStream::end(const Status& status) {
    upload_.reset();  // the file goes now, not when gRPC has told the client
    const grpc::Status told = status ? grpc::Status() : wire::to_status(status.error());
    watch_.finished(told);
    Finish(told);
}

}  // namespace vsplit::rpc
