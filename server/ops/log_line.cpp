#include "ops/log_line.h"

#include <spdlog/pattern_formatter.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>

namespace vsplit::ops {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTime = "%Y-%m-%dT%H:%M:%S.%eZ";

// Writes the record as a member list after what every line has.
class JsonFormatter final : public spdlog::formatter {
public:
    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
        time_.format(message, out);
        const spdlog::string_view_t text = message.payload;
        const bool object = std::string_view(message.logger_name.data(), message.logger_name.size()) == kObjectLogger;
        const std::string rest =
            object ? std::string(text.data() + 1, text.size() - 1)
                   : "\"event\":\"server\",\"message\":" + json_text(std::string(text.data(), text.size())) + '}';
        out.append(rest.data(), rest.data() + rest.size());
        out.push_back('\n');
    }

    [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<JsonFormatter>(); }

private:
    spdlog::pattern_formatter time_{std::string("{\"time\":\"") + kTime + "\",\"level\":\"%l\",", spdlog::pattern_time_type::utc,
                                    ""};
};

}  // namespace

std::unique_ptr<spdlog::formatter> log_formatter(bool json) {
    if (json) return std::make_unique<JsonFormatter>();
    return std::make_unique<spdlog::pattern_formatter>(std::string(kTime) + " %l %v", spdlog::pattern_time_type::utc);
}

std::string json_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string log_line(bool json, spdlog::level::level_enum level, const std::string& text) {
    spdlog::memory_buf_t line;
    log_formatter(json)->format(spdlog::details::log_msg("vsplitd", level, text), line);
    return fmt::to_string(line);
}

void say_failure(const std::string& message, bool json) {
    std::cerr << (json ? log_line(true, spdlog::level::err, message) : "vsplitd: " + message + '\n') << std::flush;
}

}  // namespace vsplit::ops
