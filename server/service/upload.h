#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "service/session.h"
#include "service/source_mesh.h"
#include "service/temp_file.h"
#include "service/upload_room.h"

namespace vsplit::service {

/// What the first part of an upload says of the whole.
struct UploadSettings {
    MeshSettings mesh;
    std::optional<std::uint64_t> size;  ///< bytes of the whole file
};

/// One rule for every way that a file comes by. \return LIMIT_EXCEEDED, naming `field`.
[[nodiscard]] Status check_upload_bytes(std::uint64_t bytes, const Limits& limits, const char* field);

/// A mesh file on its way into a session, kept in an unnamed temporary file meanwhile. The session changes with a `commit` that
/// succeeds and by nothing else; of two uploads at once the one that commits last stays. Not thread-safe.
class Upload {
public:
    /// \return LIMIT_EXCEEDED for a declared size over the limit, INVALID_OPTION (weld), BUSY, NOT_FOUND, what `disk_error`
    /// returns.
    [[nodiscard]] static Expected<Upload> begin(std::shared_ptr<Session> session, const UploadSettings& settings,
                                                const ServiceOptions& options, MemoryBudget& memory, UploadRoom& disk);

    /// Takes the next bytes; writes to the disk. \return OUT_OF_ORDER when `offset` is not the number of bytes taken so far;
    /// LIMIT_EXCEEDED; MALFORMED_INPUT for more than the declared size; what `disk_error` returns.
    [[nodiscard]] Status append(std::uint64_t offset, std::span<const std::byte> bytes);

    /// Reads the mesh and puts it into the session, provided that `still_wanted()` when it has been read. Heavy.
    /// \return TRUNCATED_INPUT for less than the declared size; what `read_source` and Session::set_source return; CANCELLED.
    [[nodiscard]] Expected<SessionSnapshot> commit(const std::function<bool()>& still_wanted) const;

private:
    Upload(std::shared_ptr<Session> session, const UploadSettings& settings, const Limits& limits, MemoryBudget& memory,
           std::unique_ptr<UploadRoom::Share> room, TempFile file);

    std::shared_ptr<Session> session_;
    std::shared_ptr<void> held_;
    UploadSettings settings_;
    Limits limits_;
    MemoryBudget* memory_;
    std::unique_ptr<UploadRoom::Share> room_;
    TempFile file_;
};

}  // namespace vsplit::service
