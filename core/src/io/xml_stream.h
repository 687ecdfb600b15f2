#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/xml_tags.h"
#include "io/zip_reader.h"
#include "vsplit/base/expected.h"

namespace vsplit {

/// The tags of XML that is unpacked on the way: as XmlTags, with no more of the text in memory than a tag and what came with it.
/// Tags must nest (XmlNesting), and nothing but space and comments may follow the last one.
class XmlStream {
public:
    explicit XmlStream(ZipStream bytes) : bytes_(std::move(bytes)) {}

    /// The next tag, valid until the next call; empty at the end of the file. \return what ZipStream, XmlTags and XmlNesting
    /// return; UNSUPPORTED for text of 16 bits; MALFORMED_INPUT for a document type (which formats on zip archives forbid) and
    /// for a tag or comment of over a mebibyte.
    [[nodiscard]] Expected<std::optional<XmlTag>> next();

private:
    [[nodiscard]] Expected<bool> read_on();
    [[nodiscard]] Expected<bool> find_opening();
    [[nodiscard]] Expected<std::size_t> find_end();
    [[nodiscard]] Status go_over_text(std::size_t at);
    void go_to(std::size_t at);

    ZipStream bytes_;
    std::string text_;  // what is there and not done with
    std::size_t at_ = 0;
    XmlPosition position_;
    XmlNesting nesting_;
    bool begun_ = false;
    bool ended_ = false;
};

/// The characters that `text`, an attribute's, stands for: &lt; and the like, &#65; as UTF-8. What is no such reference stays.
[[nodiscard]] std::string xml_unescaped(std::string_view text);

/// `name` as an attribute's text. Bytes that are no UTF-8 are taken for Latin-1; control characters, which XML has not, become
/// '_'.
[[nodiscard]] std::string xml_escaped(std::string_view name);

}  // namespace vsplit
