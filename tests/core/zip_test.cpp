// Zip archives as we write and read them, and what is said of those that lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "io/xml_stream.h"
#include "io/zip_reader.h"
#include "io/zip_writer.h"
#include "tests/core/random.h"

namespace vsplit::test {
namespace {

using ::testing::HasSubstr;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

/// Half noise, half runs: neither all kept nor all shrunk.
std::string some_text(std::size_t size) {
    Random random(11);
    std::string text;
    while (text.size() < size)
        text += text.size() % 1000 < 500 ? std::string(20, 'a') : std::string(1, static_cast<char>(random.uniform(0, 256)));
    return text;
}

std::string archive_of(const std::string& text, std::uint64_t most_in_32_bits = 0xFFFFFFFE) {
    ZipWriter writer(most_in_32_bits);
    writer.begin("first");
    writer.begin("dir/second.txt");
    for (std::size_t at = 0; at < text.size(); at += 70'000) writer.add(std::string_view(text).substr(at, 70'000));
    return writer.take();
}

Expected<std::string> unpacked(const std::string& archive, std::string_view name) {
    const Expected<ZipReader> reader = ZipReader::open(bytes_of(archive));
    if (!reader) return reader.error();
    const ZipEntry* entry = reader->find(name);
    if (entry == nullptr) return Error{Cause::kNotFound, "no such entry", ""};
    Expected<ZipStream> stream = reader->unpack(*entry);
    if (!stream) return stream.error();
    std::string text;
    for (;;) {
        const Expected<std::string_view> piece = stream->next();
        if (!piece) return piece.error();
        if (piece->empty()) return text;
        text += *piece;
    }
}

template <class T>
void put_at(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}

/// Where the table's entry of the second file is.
std::size_t second_entry(const std::string& archive) { return archive.rfind("PK\x01\x02"); }

Error error_of(const std::string& archive) {
    const Expected<std::string> text = unpacked(archive, "dir/second.txt");
    EXPECT_FALSE(text);
    return text ? Error{} : text.error();
}

TEST(ZipTest, WhatIsPutInComesOut) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{300'000}}) {
        const std::string text = some_text(size);
        for (const std::uint64_t most : {std::uint64_t{0xFFFFFFFE}, std::uint64_t{0}}) {  // in 32 bits, and all in 64
            const std::string archive = archive_of(text, most);
            const Expected<std::string> same = unpacked(archive, "DIR/Second.TXT");
            ASSERT_TRUE(same) << same.error().message;
            EXPECT_EQ(*same, text);
            EXPECT_EQ(*unpacked(archive, "first"), "");
            EXPECT_EQ(ZipReader::open(bytes_of(archive))->unpacked_size(), text.size());
            EXPECT_EQ(archive, archive_of(text, most)) << "the same bytes";
        }
    }
}

TEST(ZipTest, ClaimsAreCheckedBeforeAnythingIsUnpacked) {
    const std::string good = archive_of(some_text(50'000));
    std::string bad = good;
    put_at(bad, second_entry(bad) + 24, std::uint32_t{0xFFFFFFF0});
    EXPECT_EQ(error_of(bad).cause, Cause::kMalformedInput);
    EXPECT_THAT(error_of(bad).message, HasSubstr("claims 4294967280 bytes, more than"));
    bad = good;
    put_at(bad, second_entry(bad) + 20, std::uint32_t{0xFFFFFFF0});
    EXPECT_EQ(error_of(bad).cause, Cause::kTruncatedInput);
    bad = good;
    put_at(bad, second_entry(bad) + 42, std::uint32_t{0xFFFFFF00});
    EXPECT_EQ(error_of(bad).cause, Cause::kTruncatedInput);
    bad = good;
    put_at(bad, second_entry(bad) + 42, std::uint32_t{0xFFFFFFFF});
    EXPECT_THAT(error_of(bad).message, HasSubstr("lacks its 64-bit numbers"));
    bad = good;
    put_at(bad, good.size() - 12, std::uint16_t{60'000});
    EXPECT_THAT(error_of(bad).message, HasSubstr("table of 60000 entries"));
}

TEST(ZipTest, UnpackingEndsWhereTheClaimDoes) {
    const std::string good = archive_of(some_text(50'000));
    const auto claiming = [&](std::uint32_t size) {
        std::string bad = good;
        put_at(bad, second_entry(bad) + 24, size);
        return error_of(bad);
    };
    EXPECT_THAT(claiming(40'000).message, HasSubstr("more bytes than the 40000 it claims"));
    EXPECT_THAT(claiming(60'000).message, HasSubstr("bytes instead of the 60000 it claims"));
    std::string bad = good;
    put_at(bad, second_entry(bad) + 16, std::uint32_t{1});
    EXPECT_THAT(error_of(bad).message, HasSubstr("checksum"));
}

TEST(ZipTest, WhatIsNotReadIsNamed) {
    const std::string good = archive_of(some_text(5000));
    std::string bad = good;
    put_at(bad, second_entry(bad) + 8, std::uint16_t{1});
    EXPECT_EQ(error_of(bad).cause, Cause::kUnsupported);
    EXPECT_THAT(error_of(bad).message, HasSubstr("encrypted"));
    bad = good;
    put_at(bad, second_entry(bad) + 10, std::uint16_t{12});
    EXPECT_EQ(error_of(bad).cause, Cause::kUnsupported);
    EXPECT_THAT(error_of(bad).message, HasSubstr("method 12"));
}

TEST(ZipTest, NoPrefixAndNoDamagedByteIsTakenForWhole) {
    const std::string text = some_text(3000);
    const std::string good = archive_of(text);
    for (std::size_t size = 0; size < good.size(); size += 7) EXPECT_FALSE(unpacked(good.substr(0, size), "dir/second.txt"));
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
        std::string bad = good;
        char& byte = bad[static_cast<std::size_t>(random.uniform(0, static_cast<double>(bad.size())))];
        byte = static_cast<char>(byte ^ (1 << (i % 8)));
        const Expected<std::string> read = unpacked(bad, "dir/second.txt");
        EXPECT_TRUE(!read || *read == text);  // a date, a flag that says nothing
    }
}

std::vector<std::string> tags_of(const std::string& xml) {
    ZipWriter writer;
    writer.begin("x");
    writer.add(xml);
    const std::string archive = writer.take();
    const Expected<ZipReader> reader = ZipReader::open(bytes_of(archive));
    XmlStream stream(*reader->unpack(*reader->find("x")));
    std::vector<std::string> tags;
    for (;;) {
        const Expected<std::optional<XmlTag>> tag = stream.next();
        if (!tag) {
            tags.push_back(tag.error().message);
            return tags;
        }
        if (!*tag) return tags;
        std::string text = std::to_string((*tag)->place.number) + ((*tag)->ends ? " /" : " ") + std::string((*tag)->name);
        for (const auto& [key, value] : (*tag)->attributes) text.append(" ").append(key).append("=").append(value);
        tags.push_back(text);
    }
}

TEST(XmlStreamTest, TagsAcrossPiecesHaveTheirLines) {
    using Tags = std::vector<std::string>;
    const std::string long_comment = "<!--" + std::string(200'000, '\n') + "-->";
    EXPECT_EQ(tags_of("<?xml version=\"1.0\"?>\n<!-- <a/> -->\n<b c='>' d=\"e\"><![CDATA[<f>]]>\n\n<g/></b> "),
              (Tags{"3 b c=> d=e", "5 g", "5 /b"}));
    EXPECT_EQ(tags_of(long_comment + "<a b=\"" + std::string(100'000, 'x') + "\"/>").back().size(), 100'000 + 11U);
    EXPECT_EQ(tags_of("<a>" + std::string(70'000, ' ') + "<b/></a>"), (Tags{"1 a", "1 b", "1 /a"}));
}

TEST(XmlStreamTest, SaysWhatIsWrongAndWhere) {
    EXPECT_THAT(tags_of("<a>\n<b c=\"d").back(), HasSubstr("line 2: the file ends within '<b c="));
    EXPECT_THAT(tags_of("\n<!DOCTYPE a [<!ENTITY b \"c\">]><a/>").back(), HasSubstr("line 2: a document type"));
    EXPECT_THAT(tags_of("\n<a b=c/>").back(), HasSubstr("line 2: expected an attribute"));
    EXPECT_THAT(tags_of(std::string("\xFF\xFE<\0a\0", 6)).back(), HasSubstr("UTF-16"));
    EXPECT_THAT(tags_of("<a b=\"" + std::string(3'000'000, 'x') + "\"/>").back(), HasSubstr("over 1048576 bytes"));
    EXPECT_THAT(tags_of("<a>" + std::string(70'000, ' ') + "\n" + std::string(300, ' ') + "<b=/></a>").back(),
                HasSubstr("line 2, column 301: "))
        << "long lines have columns";
}

TEST(XmlStreamTest, TagsMustNestAndBeWhole) {
    EXPECT_THAT(tags_of("<a>\n<vertices>\n</vertexes></a>").back(),
                HasSubstr("line 3: expected '</vertices>', the end of the tag of line 2, found '</vertexes>'"));
    EXPECT_THAT(tags_of("<a>\n<b></a>").back(), HasSubstr("line 2: expected '</b>'"));
    EXPECT_THAT(tags_of("<a>\n<b>").back(), HasSubstr("line 2: the file ends before '</b>'"));
    EXPECT_THAT(tags_of("<a/>\n<b/>").back(), HasSubstr("line 2: a tag 'b' follows the end"));
    EXPECT_THAT(tags_of("<a/>\nand").back(), HasSubstr("line 1: text follows the end of the XML: 'and'"));
    EXPECT_THAT(tags_of("</a>").back(), HasSubstr("line 1: '</a>' ends a tag that was not begun"));
    EXPECT_THAT(tags_of("<a></a b=\"c\">").back(), HasSubstr("expected '>' behind the end of 'a'"));
    EXPECT_THAT(tags_of("<a b=\"1\" b=\"2\"/>").back(), HasSubstr("the attribute 'b' of 'a' is there twice"));
    EXPECT_THAT(tags_of("<a / b=\"1\"/>").back(), HasSubstr("expected an attribute of 'a'"));
    EXPECT_THAT(tags_of("<a b c=\"1\"/>").back(), HasSubstr("expected an attribute of 'a'"));
    EXPECT_THAT(tags_of("< a/>").back(), HasSubstr("expected a tag's name"));
    std::string deep;
    for (int i = 0; i < 1001; ++i) deep += "<a>";
    EXPECT_THAT(tags_of(deep).back(), HasSubstr("over 1000 deep"));
}

TEST(XmlStreamTest, NamesAreEscapedAndComeBack) {
    for (const std::string name : {"", "plain", "a & b < c > \"d\" 'e'", "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80", "&amp;"})
        EXPECT_EQ(xml_unescaped(xml_escaped(name)), name);
    EXPECT_EQ(xml_escaped("caf\xE9"), "caf\xC3\xA9") << "Latin-1";
    EXPECT_EQ(xml_escaped("\xC3"), "\xC3\x83");
    EXPECT_EQ(xml_escaped("\xED\xA0\x80").size(), 6U) << "half a surrogate is no character";
    EXPECT_EQ(xml_escaped(std::string("a\nb\0c", 5)), "a_b_c");
    EXPECT_EQ(xml_unescaped("&#65;&#x42;&apos;&#x20AC;"), "AB'\xE2\x82\xAC");
    for (const std::string left : {"&", "&;", "&nothing;", "&#xD800;", "&#1114112;", "&#x;", "a &b"})
        EXPECT_EQ(xml_unescaped(left), left);
}

}  // namespace
}  // namespace vsplit::test
