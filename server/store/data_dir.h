#pragma once

#include <filesystem>
#include <memory>

#include "service/session_archive.h"
#include "store/report.h"
#include "store/session_index.h"
#include "vsplit/base/expected.h"

namespace vsplit::store {

/// Where a server keeps its sessions, and whatever else it writes:
///
///     sessions.db     the index
///     blobs/          the blobs; blobs/aside/ those that the index does not know
///     reserve         room that a full disk leaves for deleting sessions
///     uploads/        mesh files on their way
///     damaged-1/ ...  an index that was damaged and its blobs, kept there as they were
class DataDir {
public:
    /// Makes the directory if need be. No other server may have it. One that may not be written to is served all the same, and
    /// reported: whatever would change it is refused.
    /// \param quota bytes of disk that meshes and representations may take; 0: no limit.
    /// \return UNAVAILABLE, LIMIT_EXCEEDED, UNSUPPORTED (made by a later version), INVALID_OPTION (no directory).
    [[nodiscard]] static Expected<DataDir> open(const std::filesystem::path& directory, std::uint64_t quota,
                                                const Report& report);

    ~DataDir();
    DataDir(DataDir&& other) noexcept;
    DataDir& operator=(DataDir&&) = delete;

    /// For files that are gone with the process.
    [[nodiscard]] std::filesystem::path uploads() const { return directory_ / "uploads"; }

    /// The archive, given away, once. It must not outlive this.
    [[nodiscard]] std::unique_ptr<service::SessionArchive> take_archive() { return std::move(archive_); }

private:
    DataDir(std::filesystem::path directory, int lock, bool writable)
        : directory_(std::move(directory)), lock_(lock), writable_(writable) {}

    [[nodiscard]] Expected<std::unique_ptr<SessionIndex>> open_index(const Report& report) const;
    [[nodiscard]] Status open_archive(std::uint64_t quota, const Report& report);

    std::filesystem::path directory_;
    int lock_ = -1;
    bool writable_ = true;
    std::unique_ptr<service::SessionArchive> archive_;
};

}  // namespace vsplit::store
