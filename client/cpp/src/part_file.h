#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "vsplit/base/expected.h"

namespace vsplit::client {

/// A file written piece by piece under another name beside its own; only commit() gives it its name.
class PartFile {
public:
    /// \return FILE_ACCESS or NOT_FOUND with the system's reason.
    [[nodiscard]] static Expected<PartFile> create(const std::filesystem::path& path);

    PartFile(PartFile&& other) noexcept;
    PartFile& operator=(PartFile&&) = delete;
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    /// Removes what was written unless it was committed.
    ~PartFile();

    /// FILE_ACCESS, e.g. when the disk is full.
    [[nodiscard]] Status write(std::string_view bytes);

    /// Bytes written so far.
    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Makes it the file that was asked for, on the disk.
    [[nodiscard]] Status commit();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }  // NOLINT(bugprone-unused-return-value): read by commit()
    };

    PartFile(std::filesystem::path path, std::filesystem::path part, std::FILE* file);

    std::filesystem::path path_;
    std::filesystem::path part_;  // empty once committed or moved from
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t size_ = 0;
};

}  // namespace vsplit::client
