#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "vsplit/base/expected.h"

namespace vsplit::guard {

/// Notices when files were written anew or replaced, by their times, size and inode. Not thread-safe.
class WatchedFiles {
public:
    /// \param pause files are looked at no more often
    explicit WatchedFiles(std::vector<std::string> names, std::chrono::milliseconds pause = std::chrono::seconds(1));

    /// Whether any is another than at the last call that said so, or at construction.
    [[nodiscard]] bool changed();

    /// What came of reading them. Where they could not be used `changed` asks for it again after a pause, whatever is seen of
    /// them. \return whether that is news.
    [[nodiscard]] bool note(const Status& read);

private:
    using Clock = std::chrono::steady_clock;
    using Marks = std::vector<std::int64_t>;

    [[nodiscard]] Marks look() const;

    const std::vector<std::string> names_;
    const std::chrono::milliseconds pause_;
    Marks seen_;
    std::string failure_;  // of the last reading; empty: none
    Clock::time_point looked_ = Clock::now();
};

/// A whole file. \return FILE_ACCESS with the reason, LIMIT_EXCEEDED beyond `most` bytes.
[[nodiscard]] Expected<std::string> read_small_file(const std::string& name, std::size_t most);

}  // namespace vsplit::guard
