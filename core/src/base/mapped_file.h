#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit {

/// The bytes of a file, for as long as this object lives. Regular files are mapped, pipes and devices are read to their end.
/// The system ends a program that reads a mapped file past a place where another program has cut it in the meantime: whoever
/// lets strangers write to the files must hand over copies.
class MappedFile {
public:
    /// \return NOT_FOUND, FILE_ACCESS with the system's reason, or LIMIT_EXCEEDED for over 4 GiB from a pipe or a device.
    [[nodiscard]] static Expected<MappedFile> open(const std::filesystem::path& path);

    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile();

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

private:
    MappedFile() = default;

    [[nodiscard]] static Expected<MappedFile> map(int descriptor, std::size_t size, const std::filesystem::path& path);
    [[nodiscard]] static Expected<MappedFile> read_all(int descriptor, const std::filesystem::path& path);

    std::span<const std::byte> bytes_;
    std::vector<std::byte> copy_;  // of what cannot be mapped
};

}  // namespace vsplit
