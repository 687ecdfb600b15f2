#pragma once

#include <string>
#include <string_view>

namespace vsplit::rest {

/// What the conditions of a request (RFC 9110 13) make of its answer.
enum class Condition {
    kHolds,        ///< serve
    kNotModified,  ///< 304: the client has it already
    kFailed,       ///< 412: the client wants another one than there is
};

/// Judges If-Match and If-None-Match for GET and HEAD of something whose strong entity tag is `etag`, quotes included; empty
/// headers ask for nothing. What cannot be read in a header is passed over. O(headers).
[[nodiscard]] Condition judge(std::string_view if_match, std::string_view if_none_match, std::string_view etag);

/// Whether Range is to be obeyed: there is no If-Range, or it names exactly this. A date never does: nothing here is dated.
[[nodiscard]] bool range_holds(std::string_view if_range, std::string_view etag);

/// The strong entity tag of bytes with this digest, sent in a coding ("gzip") or as they are (""): other bytes, another tag.
[[nodiscard]] std::string entity_tag(std::string_view digest, std::string_view coding);

}  // namespace vsplit::rest
