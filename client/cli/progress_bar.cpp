#include "cli/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>

#include "cli/number_text.h"

namespace vsplit::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kInterval(100);
constexpr std::size_t kWidth = 24;
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

ProgressBar::ProgressBar(Shown shown) : shown_(shown == Shown::kOnTerminals && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (drawn_) std::cerr << kClearLine << std::flush;
}

bool ProgressBar::due(std::string_view stage) {
    const Clock::time_point now = Clock::now();
    if (stage == stage_ && now < next_) return false;
    stage_ = stage;
    next_ = now + kInterval;
    return true;
}

void ProgressBar::show(std::string_view stage, double fraction, const std::string& detail) {
    if (!shown_ || !due(stage)) return;
    std::cerr << kClearLine << progress_line(stage, fraction, detail) << std::flush;
    drawn_ = true;
}

void ProgressBar::show(std::string_view stage, double fraction, std::uint32_t faces) {
    if (shown_) show(stage, fraction, faces == 0 ? std::string() : grouped(faces) + " faces");
}

std::string progress_line(std::string_view stage, double fraction, const std::string& detail) {
    const double share = std::clamp(fraction, 0.0, 1.0);
    const auto full = static_cast<std::size_t>(share * static_cast<double>(kWidth));
    std::array<char, 32> figures{};
    std::snprintf(figures.data(), figures.size(), "%3.0f %%", share * 100);
    std::string line =
        "[" + std::string(full, '#') + std::string(kWidth - full, ' ') + "] " + figures.data() + "  " + std::string(stage);
    return detail.empty() ? line : line + "  " + detail;
}

}  // namespace vsplit::cli
