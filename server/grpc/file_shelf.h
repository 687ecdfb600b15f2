#pragma once

#include <chrono>
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
#include "service/sweeper.h"
#include "service/temp_file.h"
#include "vsplit/base/expected.h"

namespace vsplit::rpc {

/// What is told of a mesh file beside its bytes.
struct FileFacts {
    service::MeshRef mesh;  ///< as written
    std::uint64_t size = 0;
    std::string digest;  ///< SHA-256
    std::uint32_t nodes_on_chord = 0;
};

/// A mesh as a file: unnamed and on disk, so that a slow reader costs one chunk of memory and not a file. A full disk keeps
/// nobody from reading: it is in memory then.
struct MeshFile {
    FileFacts facts;
    std::optional<service::FileMapping> mapping;
    std::string text;  ///< instead, where there is no disk to write to

    [[nodiscard]] std::span<const std::byte> bytes() const { return mapping ? mapping->bytes() : std::as_bytes(std::span(text)); }
};

/// A file that several wait for. Thread-safe.
class SharedFile {
public:
    /// Null until it is there; never changes afterwards.
    [[nodiscard]] const Expected<MeshFile>* get() const;

    /// `wake` is called when it is there, at once if it is already.
    void call_when_there(Wake wake);

    void put(Expected<MeshFile> file);

private:
    mutable std::mutex mutex_;
    std::optional<Expected<MeshFile>> file_;
    std::vector<Wake> waiting_;
};

/// What makes a file the one that it is: whoever asks for the same gets the same bytes.
struct FileName {
    std::string text;                    ///< session, representation, resolution, format and options
    std::weak_ptr<const void> original;  ///< the mesh that the session has, which an upload replaces
};

/// What may lie on the shelf.
struct ShelfLimits {
    std::chrono::milliseconds rest{5000};                  ///< a file lies there so long after its last reader
    std::uint64_t resting_bytes = std::uint64_t{1} << 30;  ///< of files that nobody reads; those unread for longest go first
    std::size_t facts = 4096;                              ///< files that are known without being there
};

/// The files that are being downloaded, made once for all who ask for the same; each rests a while after its last reader, for one
/// who comes back for a part of it. What was told of a file is known for longer. Thread-safe.
class FileShelf {
public:
    explicit FileShelf(const ShelfLimits& limits);

    /// The file of that name, and whether it is new and so is to be made by the caller. O(log files).
    [[nodiscard]] std::pair<std::shared_ptr<SharedFile>, bool> join(const FileName& name);

    /// What is known of a file that was made before. O(log files).
    [[nodiscard]] std::optional<FileFacts> find(const FileName& name);

    enum class Rest { kYes, kNo };

    /// To be called when `file` has been made, before it is put there for those who wait: they may ask about it at once.
    /// O(files).
    void made(const FileName& name, const std::shared_ptr<SharedFile>& file, const FileFacts& facts, Rest rest);

    /// Gives up what rests, where there is no room for another file.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    struct Entry {
        std::weak_ptr<const void> original;
        std::weak_ptr<SharedFile> file{};
        std::shared_ptr<SharedFile> resting{};  ///< the same, once it is there
        Clock::time_point read{};               ///< when it was last seen in use
        std::optional<FileFacts> facts{};

        /// Whether somebody has it beside the shelf.
        [[nodiscard]] bool is_read() const { return file.use_count() > (resting ? 1 : 0); }
    };

    [[nodiscard]] Entry& entry_of(const FileName& name);
    /// Freed after the lock is released: it may be gigabytes.
    using Dropped = std::vector<std::shared_ptr<SharedFile>>;

    void sweep();
    void keep_to_limits(Dropped& dropped);

    const ShelfLimits limits_;
    std::mutex mutex_;
    std::map<std::string, Entry> entries_;
    service::Sweeper sweeper_;  // last: it uses the others
};

}  // namespace vsplit::rpc
