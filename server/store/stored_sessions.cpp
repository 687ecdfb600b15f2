#include "store/stored_sessions.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "store/mesh_blob.h"
#include "store/stored_values.h"
#include "vsplit/mrr/mrr_file.h"

namespace vsplit::store {
namespace {

using service::Kept;
using service::Levels;
using service::MemoryBudget;
using std::chrono::milliseconds;

std::int64_t since_1970(std::chrono::system_clock::time_point time) {
    return std::chrono::duration_cast<milliseconds>(time.time_since_epoch()).count();
}

/// What reads a blob, and tells the operator where it cannot. `read(bytes)` returns an Expected<std::shared_ptr<const Value>>.
template <class Value, class Read>
typename Kept<Value>::Load loader(std::shared_ptr<BlobStore> blobs, BlobEntry entry, std::shared_ptr<const Report> report,
                                  Read read) {
    return [blobs = std::move(blobs), entry = std::move(entry), report = std::move(report),
            read = std::move(read)]() -> Expected<std::shared_ptr<const Value>> {
        const Expected<std::shared_ptr<const Blob>> blob = blobs->get(entry);
        Expected<std::shared_ptr<const Value>> value =
            blob ? read((*blob)->bytes()) : Expected<std::shared_ptr<const Value>>(blob.error());
        if (!value) (*report)(value.error().message);
        return value;
    };
}

auto mesh_reader(std::vector<FaceSet> sets) {
    return [sets = std::move(sets)](Bytes bytes) -> Expected<std::shared_ptr<const TriangleMesh>> {
        Expected<TriangleMesh> mesh = read_mesh_blob(bytes);
        if (!mesh) return mesh.error();
        mesh->sets = sets;
        return std::make_shared<const TriangleMesh>(*std::move(mesh));
    };
}

auto levels_reader(MemoryBudget& budget) {
    return [&budget](Bytes bytes) -> Expected<std::shared_ptr<const Levels>> {
        Expected<StoredMrr> stored = decode_mrr(bytes);
        if (!stored) return stored.error();
        return std::make_shared<const Levels>(std::move(stored->mrr), budget);
    };
}

/// Whether a blob is there with its size; what it holds is looked at when it is used.
Status require_blob(const std::vector<BlobEntry>& blobs, const std::string& key, std::uint64_t bytes) {
    const auto at = std::lower_bound(blobs.begin(), blobs.end(), key,
                                     [](const BlobEntry& blob, const std::string& wanted) { return blob.key < wanted; });
    if (at == blobs.end() || at->key != key) return Error{Cause::kCorrupt, key + " is missing", ""};
    if (at->bytes == bytes) return Done{};
    return Error{Cause::kCorrupt, key + " has " + std::to_string(at->bytes) + " bytes instead of " + std::to_string(bytes), ""};
}

std::vector<std::string> keys_of(const std::vector<BlobEntry>& blobs) {
    std::vector<std::string> keys;
    for (const BlobEntry& blob : blobs) keys.push_back(blob.key);
    return keys;
}

}  // namespace

StoredSessions::StoredSessions(std::shared_ptr<BlobStore> blobs, std::unique_ptr<SessionIndex> index, DiskReserve reserve,
                               std::uint64_t quota, Report report, IndexCount damaged)
    : blobs_(std::move(blobs)),
      index_(std::move(index)),
      reserve_(std::move(reserve)),
      quota_(quota),
      report_(std::make_shared<const Report>(std::move(report))),
      damaged_indices_(std::move(damaged)) {}

Expected<service::Restored> StoredSessions::restore(MemoryBudget& budget) {
    const Expected<IndexContents> contents = index_->load();
    if (!contents) return contents.error();
    Expected<Blobs> blobs = blobs_->list();
    if (!blobs) return blobs.error();
    std::map<std::uint64_t, service::SessionRecord> records;
    std::map<std::uint64_t, Error> damage;
    for (const SessionRow& row : contents->sessions) {
        Expected<service::SessionRecord> record = recall(row, *blobs, budget);
        if (!record) damage.emplace(row.number, record.error());
        if (record) records.emplace(row.number, *std::move(record));
    }
    for (const RepresentationRow& row : contents->representations) {
        const auto record = records.find(row.session);
        if (record == records.end()) continue;
        Expected<std::shared_ptr<const service::Representation>> made = recall(row, *blobs, budget);
        if (!made) damage.emplace(row.session, made.error());
        if (made) record->second.representations.push_back(*std::move(made));
    }
    for (const JobRow& row : contents->jobs) {
        const auto record = records.find(row.session);
        if (record == records.end()) continue;
        Expected<service::MethodRequest> request = read_request(row.info);
        if (row.sound && request) {
            record->second.unfinished.push_back({row.number, *std::move(request)});
        } else {
            (*report_)("session " + record->second.id +
                       ": which method of it was cut off is not as it was written, and is not told");
        }
    }
    service::Restored restored{{}, contents->last_session, milliseconds(contents->now.value_or(0)), {}};
    if (!contents->now) forget_expiry(records);
    for (const SessionRow& row : contents->sessions) {
        const auto why = damage.find(row.number);
        judge(row, why == damage.end() ? nullptr : &why->second);
        if (why == damage.end()) {
            restored.sessions.push_back(std::move(records.at(row.number)));
        } else {
            restored.damaged.push_back({row.number, row.id, row.owner, why->second.message});
        }
    }
    put_unknown_aside(keys_of(*blobs));
    collect();
    return restored;
}

/// Without a clock nobody knows how long a session was not used.
void StoredSessions::forget_expiry(std::map<std::uint64_t, service::SessionRecord>& sessions) const {
    for (auto& [number, session] : sessions) session.expires.reset();
    (*report_)(
        "the data directory's clock is not as it was written; nothing expires by it, all sessions live their full time again");
}

Expected<service::SessionRecord> StoredSessions::recall(const SessionRow& row, const Blobs& blobs, MemoryBudget& budget) const {
    if (!row.sound) return Error{Cause::kCorrupt, "its row of the index is not as it was written", ""};
    service::SessionRecord record;
    record.number = row.number;
    record.id = row.id;
    record.owner = row.owner;
    record.create_time = std::chrono::system_clock::time_point(milliseconds(row.created));
    record.expires = milliseconds(row.expires);
    record.made = row.made;
    if (row.source.blob.empty()) return record;
    Expected<ToldSource> told = read_source(row.source.info);
    if (!told) return told.error();
    if (Status there = require_blob(blobs, row.source.blob, told->blob_bytes); !there) return there.error();
    auto load = loader<TriangleMesh>(blobs_, {row.source.blob, told->blob_bytes}, report_, mesh_reader(std::move(told->sets)));
    auto mesh = Kept<TriangleMesh>::elsewhere(std::move(load), told->memory, budget);
    record.source = std::make_shared<const service::SourceMesh>(service::SourceMesh{std::move(mesh), std::move(told->report)});
    return record;
}

Expected<std::shared_ptr<const service::Representation>> StoredSessions::recall(const RepresentationRow& row, const Blobs& blobs,
                                                                                MemoryBudget& budget) const {
    if (!row.sound) return Error{Cause::kCorrupt, "the index's row of a representation is not as it was written", ""};
    Expected<ToldRepresentation> told = read_representation(row.item.info);
    if (!told) return told.error();
    if (Status there = require_blob(blobs, row.item.blob, told->blob_bytes); !there) return there.error();
    auto load = loader<Levels>(blobs_, {row.item.blob, told->blob_bytes}, report_, levels_reader(budget));
    return std::make_shared<const service::Representation>(std::move(told->id), std::move(told->asked), std::move(told->figures),
                                                           told->extent,
                                                           Kept<Levels>::elsewhere(std::move(load), told->memory, budget));
}

/// Tells what is new of a session's damage. What the index cannot be told is told again when the server next starts.
void StoredSessions::judge(const SessionRow& row, const Error* damage) {
    if (damage != nullptr) {
        const std::lock_guard lock(judging_);
        damaged_.insert(row.number);
        ++aside_;
    }
    if (damage != nullptr && !row.set_aside) {
        (*report_)("session " + row.id + " is damaged and set aside: " + damage->message);
        static_cast<void>(index_->set_aside(row.number, damage->message));
    }
    if (damage == nullptr && row.set_aside) {
        (*report_)("session " + row.id + " is sound again");
        static_cast<void>(index_->set_aside(row.number, ""));
    }
}

/// An index that lost something knows nothing of blobs that are still there. They may be all that is left of sessions.
void StoredSessions::put_unknown_aside(const std::vector<std::string>& blobs) {
    const Expected<std::vector<std::string>> unknown = index_->unknown(blobs);
    if (!unknown || unknown->empty()) return;
    std::size_t done = 0;
    for (const std::string& key : *unknown) done += blobs_->put_aside(key) ? 1 : 0;
    (*report_)(std::to_string(done) + " of " + std::to_string(blobs.size()) +
               " stored meshes and representations are in no session of the index; they are put aside, not deleted");
}

Expected<StoredSessions::KeptItem> StoredSessions::keep_source(const service::SourceMesh& source) {
    const Expected<std::shared_ptr<const TriangleMesh>> mesh = source.mesh->get();
    if (!mesh) return mesh.error();
    const MeshBlob encoded(**mesh);
    const Expected<BlobEntry> blob = put(encoded.parts());
    if (!blob) return blob.error();
    return KeptItem{{blob->key, write_source(source, **mesh, blob->bytes)}, *blob};
}

Expected<StoredSessions::KeptItem> StoredSessions::keep_levels(const service::Representation& representation) {
    const Expected<std::shared_ptr<const Levels>> levels = representation.levels().get();
    if (!levels) return levels.error();
    const std::string file = encode_mrr({(*levels)->mrr(), representation.figures().faces, {}});
    const Bytes bytes = std::as_bytes(std::span(file));
    const Expected<BlobEntry> blob = put({&bytes, 1});
    if (!blob) return blob.error();
    return KeptItem{{blob->key, write_representation(representation, blob->bytes)}, *blob};
}

Expected<BlobEntry> StoredSessions::put(std::span<const Bytes> parts) {
    if (Status noted = index_->add_loose(blobs_->key_of(parts)); !noted) return noted.error();
    return blobs_->put(parts);
}

Status StoredSessions::add(const service::SessionRecord& session) {
    const std::shared_lock lock(collecting_);
    SessionRow row{session.number,
                   session.id,
                   session.owner,
                   since_1970(session.create_time),
                   session.expires.value_or(milliseconds(0)).count(),
                   session.made,
                   {}};
    BlobEntry blob;
    if (session.source) {
        Expected<KeptItem> item = keep_source(*session.source);
        if (!item) return item.error();
        row.source = std::move(item->row);
        blob = std::move(item->blob);
    }
    if (Status added = index_->add_session(row); !added) return added;
    if (session.source) can_be_loaded(*session.source, blob);
    return Done{};
}

Status StoredSessions::set_source(std::uint64_t session, const service::SourceMesh& source) {
    {
        const std::shared_lock lock(collecting_);
        const Expected<KeptItem> item = keep_source(source);
        if (!item) return item.error();
        if (Status set = index_->set_source(session, item->row); !set) return set;
        can_be_loaded(source, item->blob);
    }
    collect();
    return Done{};
}

void StoredSessions::can_be_loaded(const service::SourceMesh& source, const BlobEntry& blob) const {
    const Expected<std::shared_ptr<const TriangleMesh>> mesh = source.mesh->get();
    if (mesh) source.mesh->can_be_loaded(loader<TriangleMesh>(blobs_, blob, report_, mesh_reader((*mesh)->sets)));
}

Status StoredSessions::add_representation(std::uint64_t session, const service::Representation& representation,
                                          std::uint64_t made) {
    const std::shared_lock lock(collecting_);
    const Expected<KeptItem> item = keep_levels(representation);
    if (!item) return item.error();
    if (Status added = index_->add_representation({session, made, item->row}, made); !added) return added;
    MemoryBudget& budget = representation.levels().budget();
    representation.levels().can_be_loaded(loader<Levels>(blobs_, item->blob, report_, levels_reader(budget)));
    return Done{};
}

Status StoredSessions::remove(const std::vector<std::uint64_t>& sessions) {
    Status removed = index_->remove_sessions(sessions);
    if (!removed && removed.error().cause == Cause::kLimitExceeded) {
        reserve_.give();
        removed = index_->remove_sessions(sessions);
    }
    if (removed) collect();
    reserve_.take();
    for (const std::uint64_t session : removed ? sessions : std::vector<std::uint64_t>{}) {
        const std::lock_guard lock(judging_);
        if (damaged_.erase(session) != 0) --aside_;
    }
    return removed;
}

/// Removes what is loose. What cannot be removed now is tried again with the next that becomes loose, and when the server starts.
void StoredSessions::collect() {
    const std::unique_lock lock(collecting_);
    const Expected<std::vector<std::string>> loose = index_->loose();
    if (!loose) return;
    std::vector<std::string> gone;
    for (const std::string& key : *loose) {
        if (blobs_->remove(key)) gone.push_back(key);
    }
    static_cast<void>(index_->remove_loose(gone));
}

Status StoredSessions::note_time(milliseconds now, const std::vector<std::pair<std::uint64_t, milliseconds>>& expire) {
    std::vector<std::pair<std::uint64_t, std::int64_t>> rows;
    rows.reserve(expire.size());
    for (const auto& [session, time] : expire) rows.emplace_back(session, time.count());
    Status noted = index_->note_time(now.count(), rows);
    if (const bool was = writable_.exchange(noted.has_value()); was != noted.has_value())
        (*report_)(noted ? "the data directory can be written to again"
                         : "nothing can be written to the data directory, what is there is served: " + noted.error().message);
    return noted;
}

Expected<std::uint64_t> StoredSessions::add_job(std::uint64_t session, const service::MethodRequest& request) {
    return index_->add_job(session, write_request(request));
}

Status StoredSessions::remove_jobs(const std::vector<std::uint64_t>& jobs) { return index_->remove_jobs(jobs); }

service::ArchiveUse StoredSessions::use() const {
    return {blobs_->bytes(), quota_, aside_ + damaged_indices_(), blobs_->aside(), writable_};
}

}  // namespace vsplit::store
