#include "wire/trace_context.h"

#include <algorithm>

namespace vsplit::wire {
namespace {

constexpr std::size_t kVersionEnd = 2, kTraceEnd = 35, kSpanEnd = 52, kWhole = 55;
constexpr std::size_t kLongestRequestId = 64;

bool is_hex(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

bool is_zero(std::string_view text) { return text.find_first_not_of('0') == std::string_view::npos; }

}  // namespace

std::optional<TraceContext> parse_traceparent(std::string_view text) {
    if (text.size() < kWhole || text[kVersionEnd] != '-' || text[kTraceEnd] != '-' || text[kSpanEnd] != '-') return std::nullopt;
    const std::string_view version = text.substr(0, kVersionEnd);
    if (!is_hex(version) || version == "ff" || (version == "00" && text.size() != kWhole)) return std::nullopt;
    if (text.size() > kWhole && text[kWhole] != '-') return std::nullopt;
    const std::string_view trace = text.substr(kVersionEnd + 1, kTraceEnd - kVersionEnd - 1);
    const std::string_view span = text.substr(kTraceEnd + 1, kSpanEnd - kTraceEnd - 1);
    const std::string_view flags = text.substr(kSpanEnd + 1, kWhole - kSpanEnd - 1);
    if (!is_hex(trace) || !is_hex(span) || !is_hex(flags) || is_zero(trace) || is_zero(span)) return std::nullopt;
    // Bits that are not defined are not passed on: of those there are one says that the caller records the trace.
    const int last = flags.back() <= '9' ? flags.back() - '0' : flags.back() - 'a' + 10;
    return TraceContext{std::string(trace), std::string(span), last % 2 == 1 ? "01" : "00"};
}

std::string to_traceparent(const TraceContext& trace) { return "00-" + trace.trace_id + '-' + trace.span_id + '-' + trace.flags; }

bool is_request_id(std::string_view text) {
    return !text.empty() && text.size() <= kLongestRequestId && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '-';
    });
}

}  // namespace vsplit::wire
