#include "upload.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>

#include "call.h"
#include "wire/convert.h"

namespace vsplit::client {
namespace {

constexpr std::size_t kPartBytes = std::size_t{256} * 1024;
constexpr std::size_t kTellingBytes = std::size_t{2} << 20;  // as many as may tell a format

/// Fills `part` with the next bytes; leaves it empty at the end.
using NextPart = std::function<Status(std::string& part)>;

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }  // read only: closing loses nothing
};
using FilePointer = std::unique_ptr<std::FILE, FileCloser>;

Error refused(const char* what, const std::filesystem::path& file, int reason) {
    return {reason == ENOENT ? Cause::kNotFound : Cause::kFileAccess,
            std::string("cannot ") + what + " '" + file.string() + "': " + std::generic_category().message(reason), ""};
}

/// The name tells the format where the bytes do not, as it does for who reads the file here.
std::optional<MeshFormat> format_of(std::FILE* file, const std::filesystem::path& name) {
    std::string begin(kTellingBytes, '\0');
    begin.resize(std::fread(begin.data(), 1, begin.size(), file));
    std::rewind(file);
    return format_where_bytes_do_not_tell(std::as_bytes(std::span(begin)), name.filename().string());
}

v1::UploadMeshRequest first_message(const std::string& session, const UploadOptions& options, std::optional<std::uint64_t> size) {
    v1::UploadMeshRequest message;
    message.set_session(session);
    message.set_format(wire::to_proto(options.format));
    message.set_weld(options.weld);
    message.set_repair(options.repair);
    if (options.stitch) message.set_stitch(*options.stitch);
    if (options.hole_size) message.set_hole_size(*options.hole_size);
    if (options.speck_size) message.set_speck_size(*options.speck_size);
    message.set_unit(wire::to_proto(options.unit));
    if (size) message.set_size(*size);
    return message;
}

/// Sends part after part until there is none, or until the server has closed the stream (its status says why).
Status send_parts(grpc::ClientWriter<v1::UploadMeshRequest>& writer, v1::UploadMeshRequest message, const UploadOptions& options,
                  const NextPart& next) {
    const std::uint64_t total = message.size();
    std::uint64_t sent = 0;
    for (;;) {
        if (Status read = next(*message.mutable_data()); !read) return read;
        const std::size_t bytes = message.data().size();
        if (bytes == 0 && sent > 0) return Done{};
        message.set_offset(sent);
        if (!writer.Write(message) || bytes == 0) return Done{};
        sent += bytes;
        if (options.on_progress) options.on_progress(sent, std::max(sent, total));
        message.clear_session();  // the rest goes without what only the first part says
        message.clear_format();
        message.clear_weld();
        message.clear_repair();
        message.clear_stitch();
        message.clear_hole_size();
        message.clear_speck_size();
        message.clear_unit();
        message.clear_size();
    }
}

Expected<v1::Session> upload(const UploadTarget& target, const v1::UploadMeshRequest& first, const UploadOptions& options,
                             const CallOptions& call_options, const NextPart& next) {
    Call call(call_options);
    v1::Session session;
    const auto writer = target.stub.UploadMesh(call.context(), &session);
    if (Status read = send_parts(*writer, first, options, next); !read) {
        call.cancel();
        const grpc::Status ignored = writer->Finish();
        return read.error();
    }
    writer->WritesDone();
    const grpc::Status status = writer->Finish();
    if (!status.ok()) return call_error(status, target.server);
    return session;
}

}  // namespace

Expected<v1::Session> upload_file(const UploadTarget& target, const std::filesystem::path& file, const UploadOptions& options,
                                  const CallOptions& call) {
    const FilePointer handle(std::fopen(file.c_str(), "rb"));
    if (!handle) return refused("open", file, errno);
    std::optional<std::uint64_t> size;  // a pipe has none to announce
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) size = std::filesystem::file_size(file, error);
    if (error) return refused("read", file, error.value());
    UploadOptions told = options;
    if (size && !told.format) told.format = format_of(handle.get(), file);
    const NextPart next = [&](std::string& part) -> Status {
        part.resize(kPartBytes);
        part.resize(std::fread(part.data(), 1, part.size(), handle.get()));
        if (std::ferror(handle.get()) != 0) return refused("read", file, errno);
        return Done{};
    };
    return upload(target, first_message(target.session, told, size), options, call, next);
}

Expected<v1::Session> upload_bytes(const UploadTarget& target, std::span<const std::byte> bytes, const UploadOptions& options,
                                   const CallOptions& call) {
    std::span<const std::byte> rest = bytes;
    const NextPart next = [&](std::string& part) -> Status {
        const std::size_t count = std::min(kPartBytes, rest.size());
        part.assign(reinterpret_cast<const char*>(rest.data()), count);
        rest = rest.subspan(count);
        return Done{};
    };
    return upload(target, first_message(target.session, options, bytes.size()), options, call, next);
}

}  // namespace vsplit::client
