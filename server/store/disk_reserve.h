#pragma once

#include <filesystem>
#include <utility>

namespace vsplit::store {

/// A file that holds a little of the disk back, so that on a full one sessions can still be deleted: the index writes to do that.
class DiskReserve {
public:
    static constexpr std::size_t kBytes = std::size_t{256} * 1024;

    explicit DiskReserve(std::filesystem::path file) : file_(std::move(file)) { take(); }

    /// Takes the room, if it is there and not taken already.
    void take() const;

    /// Gives the room up for what is to be written now.
    void give() const;

private:
    std::filesystem::path file_;
};

}  // namespace vsplit::store
