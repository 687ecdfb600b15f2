#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "rest/header_fields.h"

namespace vsplit::rest {

/// What the server has to say without an rpc: health, metrics, documents, files of a page.
struct Page {
    std::string content_type;
    std::function<std::string()> text;
    HeaderFields fields = {};
    std::string cache_control = "no-store";
    std::string digest = {};  ///< of a text that never changes, by which a client knows that it has it; empty for others
    bool guarded = false;     ///< for those only whom Backend::admit lets in
};

/// `page`, whose text never changes, with its digest. O(text).
[[nodiscard]] Page unchanging(Page page);

/// By path. A path ends in no slash but "/".
using Pages = std::map<std::string, Page, std::less<>>;

/// What those pages are made of that are always there.
struct Operations {
    std::function<bool()> ready;           ///< whether new work is taken
    std::function<std::string()> metrics;  ///< in Prometheus' text format; empty for no such page
    std::string openapi;                   ///< the document
};

/// "/", "/healthz", "/metrics" and "/openapi.json". What is not ready is a problem, so kReadyPath is none of them.
[[nodiscard]] Pages operations_pages(const Operations& operations);

inline constexpr std::string_view kHealthPath = "/healthz";
inline constexpr std::string_view kReadyPath = "/readyz";

}  // namespace vsplit::rest
