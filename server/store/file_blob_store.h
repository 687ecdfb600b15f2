#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>

#include "store/blob_store.h"

namespace vsplit::store {

/// Blobs as files, directory/ab/abcdef...: written beside their place, synchronised and linked into it. Those put aside are in
/// directory/aside.
class FileBlobStore final : public BlobStore {
public:
    /// Makes the directory if need be, and removes what was being written when a server ended; one that is not `writable` is left
    /// as it is, and whatever would write fails.
    /// \param quota bytes that all blobs may take together; 0: no limit. \return UNAVAILABLE, LIMIT_EXCEEDED.
    [[nodiscard]] static Expected<std::unique_ptr<FileBlobStore>> open(std::filesystem::path directory, std::uint64_t quota,
                                                                       bool writable = true);

    [[nodiscard]] Expected<BlobEntry> put(std::span<const Bytes> parts) override;
    [[nodiscard]] Expected<std::shared_ptr<const Blob>> get(const BlobEntry& entry) const override;
    [[nodiscard]] std::string key_of(std::span<const Bytes> parts) const override;
    [[nodiscard]] Status put_aside(const std::string& key) override;
    [[nodiscard]] std::uint64_t aside() const override;
    [[nodiscard]] Status remove(const std::string& key) override;
    [[nodiscard]] Expected<std::vector<BlobEntry>> list() const override;
    [[nodiscard]] std::uint64_t bytes() const override;

private:
    FileBlobStore(std::filesystem::path directory, std::uint64_t quota)
        : directory_(std::move(directory)), incoming_(directory_ / "incoming"), quota_(quota) {}

    [[nodiscard]] std::filesystem::path place_of(const std::string& key) const;
    [[nodiscard]] Status take_room(std::uint64_t bytes);
    void give_back(std::uint64_t bytes);
    enum class InPlace { kNothing, kDamaged };
    [[nodiscard]] Expected<bool> write(const std::string& key, std::span<const Bytes> parts, InPlace found);

    const std::filesystem::path directory_;
    const std::filesystem::path incoming_;
    const std::uint64_t quota_;
    std::atomic<std::uint64_t> written_ = 0;  // names of files in incoming_
    mutable std::mutex mutex_;
    std::uint64_t bytes_ = 0;
};

}  // namespace vsplit::store
