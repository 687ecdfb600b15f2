#include "grpc/file_shelf.h"

namespace vsplit::rpc {

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

std::pair<std::shared_ptr<SharedFile>, bool> FileShelf::join(const std::string& key, std::shared_ptr<const void> origin) {
    const std::lock_guard lock(mutex_);
    std::erase_if(files_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<SharedFile>& place = files_[key];
    if (std::shared_ptr<SharedFile> there = place.lock()) return {std::move(there), false};
    auto made = std::make_shared<SharedFile>(std::move(origin));
    place = made;
    return {std::move(made), true};
}

}  // namespace vsplit::rpc
