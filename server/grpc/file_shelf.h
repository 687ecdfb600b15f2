#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "grpc/message_source.h"
#include "service/method_request.h"
#include "service/temp_file.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// A mesh as a file: unnamed and on disk, so that a slow reader costs one chunk of memory and not a file. A full disk keeps
/// nobody from reading: it is in memory then.
struct MeshFile {
    service::MeshRef mesh;  ///< as written
    std::optional<service::FileMapping> mapping;
    std::string text;    ///< instead, where there is no disk to write to
    std::string digest;  ///< SHA-256
    std::uint32_t nodes_on_chord = 0;

    [[nodiscard]] std::span<const std::byte> bytes() const { return mapping ? mapping->bytes() : std::as_bytes(std::span(text)); }
};

/// A file that several wait for. Thread-safe.
class SharedFile {
public:
    /// `origin` is held for as long as the file is asked for, so that nothing else takes its address.
    explicit SharedFile(std::shared_ptr<const void> origin) : origin_(std::move(origin)) {}

    /// Null until it is there; never changes afterwards.
    [[nodiscard]] const Expected<MeshFile>* get() const;

    /// `wake` is called when it is there, at once if it is already.
    void call_when_there(Wake wake);

    void put(Expected<MeshFile> file);

private:
    const std::shared_ptr<const void> origin_;
    mutable std::mutex mutex_;
    std::optional<Expected<MeshFile>> file_;
    std::vector<Wake> waiting_;
};

/// The files that are being downloaded: made once for all who ask for the same at the same time, and gone with the last of them.
/// Thread-safe.
class FileShelf {
public:
    /// The file of `key`, and whether it is new and so is to be made by the caller. O(files).
    [[nodiscard]] std::pair<std::shared_ptr<SharedFile>, bool> join(const std::string& key, std::shared_ptr<const void> origin);

private:
    std::mutex mutex_;
    std::map<std::string, std::weak_ptr<SharedFile>> files_;
};

}  // namespace vsplit::rpc
