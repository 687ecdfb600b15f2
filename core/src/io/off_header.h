#pragma once

#include <string_view>

namespace vsplit {

/// Whether `word` begins an OFF whose vertices have three coordinates: "OFF", with the letters before it that announce texture
/// coordinates (ST), colours (C) and normals (N).
[[nodiscard]] inline bool is_off_keyword(std::string_view word) {
    if (word.starts_with("ST")) word.remove_prefix(2);
    if (word.starts_with('C')) word.remove_prefix(1);
    if (word.starts_with('N')) word.remove_prefix(1);
    return word == "OFF";
}

}  // namespace vsplit
