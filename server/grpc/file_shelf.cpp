#include "grpc/file_shelf.h"

#include <algorithm>

namespace vsplit::rpc {
namespace {

// Not by the address, which another mesh may get.
bool is_same(const std::weak_ptr<const void>& a, const std::weak_ptr<const void>& b) {
    return !a.owner_before(b) && !b.owner_before(a);
}

}  // namespace

const Expected<MeshFile>* SharedFile::get() const {
    const std::lock_guard lock(mutex_);
    return file_ ? &*file_ : nullptr;
}

void SharedFile::call_when_there(Wake wake) {
    {
        const std::lock_guard lock(mutex_);
        if (!file_) {
            waiting_.push_back(std::move(wake));
            return;
        }
    }
    wake();
}

void SharedFile::put(Expected<MeshFile> file) {
    std::vector<Wake> waiting;
    {
        const std::lock_guard lock(mutex_);
        file_.emplace(std::move(file));
        waiting.swap(waiting_);
    }
    for (const Wake& wake : waiting) wake();
}

FileShelf::FileShelf(const ShelfLimits& limits)
    : limits_(limits), sweeper_(std::max(limits.rest / 5, std::chrono::milliseconds(10)), [this] { sweep(); }) {}

std::pair<std::shared_ptr<SharedFile>, bool> FileShelf::join(const FileName& name) {
    const std::lock_guard lock(mutex_);
    Entry& entry = entry_of(name);
    entry.read = Clock::now();
    if (std::shared_ptr<SharedFile> there = entry.file.lock()) return {std::move(there), false};
    auto made = std::make_shared<SharedFile>();
    entry.file = made;
    return {std::move(made), true};
}

std::optional<FileFacts> FileShelf::find(const FileName& name) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(name.text);
    if (found == entries_.end() || !is_same(found->second.original, name.original)) return std::nullopt;
    return found->second.facts;
}

void FileShelf::made(const FileName& name, const std::shared_ptr<SharedFile>& file, const FileFacts& facts, Rest rest) {
    Dropped dropped;
    const std::lock_guard lock(mutex_);
    Entry& entry = entry_of(name);
    if (entry.file.lock() != file) return;
    entry.facts = facts;
    entry.read = Clock::now();
    if (rest == Rest::kYes) entry.resting = file;
    keep_to_limits(dropped);
}

void FileShelf::clear() {
    Dropped dropped;
    const std::lock_guard lock(mutex_);
    for (auto& [text, entry] : entries_) dropped.push_back(std::exchange(entry.resting, nullptr));
}

// Lock held. An entry of that name, of that mesh.
FileShelf::Entry& FileShelf::entry_of(const FileName& name) {
    Entry& entry = entries_[name.text];
    if (!is_same(entry.original, name.original)) entry = Entry{name.original};
    return entry;
}

void FileShelf::sweep() {
    Dropped dropped;
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    for (auto& [text, entry] : entries_) {
        const bool being_read = entry.is_read();
        if (being_read) entry.read = now;
        if (!being_read && now - entry.read >= limits_.rest) dropped.push_back(std::exchange(entry.resting, nullptr));
    }
    std::erase_if(entries_, [](const auto& named) {
        const Entry& entry = named.second;
        return !entry.resting && !entry.is_read() && (!entry.facts || entry.original.expired());
    });
    keep_to_limits(dropped);
}

// Lock held.
void FileShelf::keep_to_limits(Dropped& dropped) {
    std::vector<std::pair<Clock::time_point, std::map<std::string, Entry>::iterator>> unread;
    std::uint64_t bytes = 0;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (entry->second.is_read()) continue;
        if (entry->second.resting) bytes += entry->second.facts->size;
        unread.emplace_back(entry->second.read, entry);
    }
    std::sort(unread.begin(), unread.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [read, entry] : unread) {
        if (bytes > limits_.resting_bytes && entry->second.resting) {
            bytes -= entry->second.facts->size;
            dropped.push_back(std::exchange(entry->second.resting, nullptr));
        }
        if (entries_.size() <= limits_.facts) continue;
        dropped.push_back(std::exchange(entry->second.resting, nullptr));
        entries_.erase(entry);
    }
}

}  // namespace vsplit::rpc
