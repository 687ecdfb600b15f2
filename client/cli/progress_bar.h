#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace vsplit::cli {

/// One line on stderr that says how far a verb has come; redrawn at most ten times a second, gone when the object goes.
class ProgressBar {
public:
    enum class Shown { kNever, kOnTerminals };

    explicit ProgressBar(Shown shown);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `fraction` 0..1 of the stage; `detail` follows it.
    void show(std::string_view stage, double fraction, const std::string& detail);

    /// The same with a mesh's number of faces.
    void show(std::string_view stage, double fraction, std::uint32_t faces);

private:
    [[nodiscard]] bool due(std::string_view stage);

    bool shown_;
    bool drawn_ = false;
    std::string stage_;
    std::chrono::steady_clock::time_point next_{};
};

/// The line itself, without control characters.
[[nodiscard]] std::string progress_line(std::string_view stage, double fraction, const std::string& detail);

}  // namespace vsplit::cli
