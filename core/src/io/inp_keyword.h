#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/read_error.h"
#include "io/text_lines.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// A line such as `*ELEMENT, TYPE=S3, ELSET=skin` of an input deck.
struct InpKeyword {
    std::string name;                                             ///< in upper case, without blanks: "*ENDPART"
    std::vector<std::pair<std::string, std::string>> parameters;  ///< the first likewise, the second as it stands, unquoted

    [[nodiscard]] bool has(std::string_view key) const;
    /// Empty where it is not given.
    [[nodiscard]] std::string value(std::string_view key) const;
};

/// The keyword that the line of `lines` begins, and the lines that it goes on over: after a comma at its end.
[[nodiscard]] InpKeyword take_inp_keyword(TextLines& lines);

/// \return UNSUPPORTED for a keyword that makes, moves or fetches nodes and elements, for one that is not known and begins as
/// those of nodes and elements do, and for a parameter that is not known of those that are read.
[[nodiscard]] Status check_inp_keyword(const InpKeyword& keyword, Place place);

}  // namespace vsplit
