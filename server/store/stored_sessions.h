#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <span>
#include <string>
#include <vector>

#include "service/session_archive.h"
#include "store/blob_store.h"
#include "store/disk_reserve.h"
#include "store/report.h"
#include "store/session_index.h"

namespace vsplit::store {

/// Sessions in a blob store and an index. A blob is loose in the index before it is put, and again when it loses a session; only
/// loose ones are ever removed. So the end of the process leaves at most blobs that are known to be nobody's, which `restore`
/// removes.
class StoredSessions final : public service::SessionArchive {
public:
    /// How many indices are put aside.
    using IndexCount = std::function<std::uint32_t()>;

    /// `quota`: bytes of disk. It and `damaged` are for `use` alone.
    StoredSessions(std::shared_ptr<BlobStore> blobs, std::unique_ptr<SessionIndex> index, DiskReserve reserve,
                   std::uint64_t quota, Report report, IndexCount damaged);

    /// A session that is damaged is set aside and reported; the others are served.
    [[nodiscard]] Expected<service::Restored> restore(service::MemoryBudget& budget) override;

    [[nodiscard]] Status add(const service::SessionRecord& session) override;
    [[nodiscard]] Status set_source(std::uint64_t session, const service::SourceMesh& source) override;
    [[nodiscard]] Status add_representation(std::uint64_t session, const service::Representation& representation,
                                            std::uint64_t made) override;
    [[nodiscard]] Status remove(const std::vector<std::uint64_t>& sessions) override;
    [[nodiscard]] Status note_time(std::chrono::milliseconds now,
                                   const std::vector<std::pair<std::uint64_t, std::chrono::milliseconds>>& expire) override;
    [[nodiscard]] Expected<std::uint64_t> add_job(std::uint64_t session, const service::MethodRequest& request) override;
    [[nodiscard]] Status remove_jobs(const std::vector<std::uint64_t>& jobs) override;
    [[nodiscard]] service::ArchiveUse use() const override;

private:
    using Blobs = std::vector<BlobEntry>;

    /// What was kept: for the index, and where it is.
    struct KeptItem {
        StoredItem row;
        BlobEntry blob;
    };

    [[nodiscard]] Expected<KeptItem> keep_source(const service::SourceMesh& source);
    [[nodiscard]] Expected<KeptItem> keep_levels(const service::Representation& representation);
    [[nodiscard]] Expected<service::SessionRecord> recall(const SessionRow& row, const Blobs& blobs,
                                                          service::MemoryBudget& budget) const;
    [[nodiscard]] Expected<std::shared_ptr<const service::Representation>> recall(const RepresentationRow& row,
                                                                                  const Blobs& blobs,
                                                                                  service::MemoryBudget& budget) const;
    [[nodiscard]] Expected<BlobEntry> put(std::span<const Bytes> parts);
    void forget_expiry(std::map<std::uint64_t, service::SessionRecord>& sessions) const;
    void judge(const SessionRow& row, const Error* damage);
    void put_unknown_aside(const std::vector<std::string>& blobs);
    void can_be_loaded(const service::SourceMesh& source, const BlobEntry& blob) const;
    void collect();

    const std::shared_ptr<BlobStore> blobs_;  // also of what loads
    const std::unique_ptr<SessionIndex> index_;
    const DiskReserve reserve_;
    const std::uint64_t quota_;
    const std::shared_ptr<const Report> report_;
    std::atomic<std::uint32_t> aside_{0};
    const IndexCount damaged_indices_;
    std::atomic<bool> writable_{true};
    std::mutex judging_;
    std::set<std::uint64_t> damaged_;  // sessions among aside_
    // Shared from before a blob is put until the index names it; alone while unused ones are removed.
    std::shared_mutex collecting_;
};

}  // namespace vsplit::store
