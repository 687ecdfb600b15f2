#pragma once

#include <spdlog/formatter.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vsplit::ops {

/// Messages of this logger are objects of JSON already.
inline constexpr const char* kObjectLogger = "object";

/// What makes a line of the log: an object, or text. A message of kObjectLogger gives its members.
[[nodiscard]] std::unique_ptr<spdlog::formatter> log_formatter(bool json);

/// As the log has it; bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

/// A line about the log itself, with its end.
[[nodiscard]] std::string log_line(bool json, spdlog::level::level_enum level, const std::string& text);

/// Says at once, on stderr, why the program ends: "vsplitd: MESSAGE", or an object as the log's.
void say_failure(const std::string& message, bool json);

}  // namespace vsplit::ops
