#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "vsplit/base/expected.h"

namespace vsplit::service {

/// The bytes of a file, mapped for reading. Movable; unmaps at its end.
class FileMapping {
public:
    FileMapping() = default;
    FileMapping(void* address, std::size_t size) : address_(address), size_(size) {}
    ~FileMapping();
    FileMapping(FileMapping&& other) noexcept;
    FileMapping& operator=(FileMapping&& other) noexcept;

    [[nodiscard]] std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(address_), size_}; }

private:
    void* address_ = nullptr;
    std::size_t size_ = 0;
};

/// A file without a name: it is gone with the process, however that ends.
class TempFile {
public:
    /// Where `create` makes files: `wanted`, or $TMPDIR or /tmp where that is empty.
    [[nodiscard]] static std::filesystem::path directory_of(const std::filesystem::path& wanted);

    /// In `directory_of(directory)`. \return what `disk_error` returns.
    [[nodiscard]] static Expected<TempFile> create(const std::filesystem::path& directory = {});

    ~TempFile();
    TempFile(TempFile&& other) noexcept;
    TempFile& operator=(TempFile&& other) noexcept;

    /// \return what `disk_error` returns.
    [[nodiscard]] Status append(std::span<const std::byte> bytes);

    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// The mapping outlives the TempFile if need be. \return what `disk_error` returns.
    [[nodiscard]] Expected<FileMapping> map() const;

private:
    explicit TempFile(int descriptor) : descriptor_(descriptor) {}

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace vsplit::service
