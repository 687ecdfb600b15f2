#include "mrr/region_section.h"

#include <string_view>

#include "base/byte_order.h"
#include "vsplit/mrr/record_block.h"

namespace vsplit {
namespace {

constexpr std::string_view kTag = "REGN";
constexpr std::size_t kCrcAt = 4;  // of all that follows it
constexpr std::size_t kBodyAt = 8;

void put(std::string& bytes, std::uint32_t value) {
    bytes.resize(bytes.size() + sizeof(value));
    store(bytes.data() + bytes.size() - sizeof(value), value);
}

std::uint32_t crc_of(std::string_view text) { return crc32c(std::as_bytes(std::span(text.data(), text.size()))); }

/// Takes numbers and names off the bytes; after one that is not there, zeros.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::uint32_t number() {
        if (!has(sizeof(std::uint32_t))) return 0;
        const auto value = load<std::uint32_t>(bytes_.data());
        bytes_ = bytes_.subspan(sizeof(std::uint32_t));
        return value;
    }
    std::string name(std::size_t length) {
        if (!has(length)) return {};
        std::string text(reinterpret_cast<const char*>(bytes_.data()), length);
        bytes_ = bytes_.subspan(length);
        return text;
    }
    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    bool has(std::size_t count) {
        ok_ = ok_ && count <= bytes_.size();
        return ok_;
    }

    std::span<const std::byte> bytes_;
    bool ok_ = true;
};

Error corrupt(std::size_t at, const std::string& what) {
    return {Cause::kCorrupt, "byte " + std::to_string(at) + ": " + what, ""};
}

}  // namespace

std::string encode_regions(const MultiresMesh& mrr) {
    const std::size_t faces = mrr.base.faces.size() + 2 * mrr.levels();
    if (mrr.regions.size() < faces) return {};
    std::string body;
    // Runs of equal ids: a region's count, then the region. Splits add faces two by two, mostly within one.
    std::string runs;
    std::uint32_t run_count = 0;
    for (std::size_t begin = 0; begin < faces; ++run_count) {
        std::size_t end = begin + 1;
        while (end < faces && mrr.regions[end] == mrr.regions[begin]) ++end;
        put(runs, static_cast<std::uint32_t>(end - begin));
        put(runs, mrr.regions[begin]);
        begin = end;
    }
    put(body, run_count);
    body += runs;
    put(body, static_cast<std::uint32_t>(mrr.sets.size()));
    for (const FaceSet& set : mrr.sets) {
        put(body, static_cast<std::uint32_t>(set.name.size()));
        body += set.name;
        put(body, static_cast<std::uint32_t>(set.regions.size()));
        for (const std::uint32_t region : set.regions) put(body, region);
    }
    std::string bytes(kTag);
    put(bytes, crc_of(body));
    return bytes + body;
}

Status decode_regions(std::span<const std::byte> bytes, std::size_t at, MultiresMesh& mrr) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with(kTag) || text.size() < kBodyAt)
        return corrupt(at, std::to_string(bytes.size()) + " bytes follow the last of " + std::to_string(mrr.records.size()) +
                               " records; expected nothing, or regions");
    if (load<std::uint32_t>(bytes.data() + kCrcAt) != crc_of(text.substr(kBodyAt)))
        return corrupt(at, "the checksum of the regions does not hold");
    Reader reader(bytes.subspan(kBodyAt));
    const std::size_t faces = mrr.base.faces.size() + 2 * mrr.levels();
    const std::uint32_t runs = reader.number();
    for (std::uint32_t run = 0; run < runs && reader.ok(); ++run) {
        const std::uint32_t count = reader.number();
        const std::uint32_t region = reader.number();
        if (count > faces - mrr.regions.size())
            return corrupt(at, "there are more regions than the " + std::to_string(faces) + " faces");
        mrr.regions.insert(mrr.regions.end(), count, region);
    }
    const std::uint32_t sets = reader.number();
    for (std::uint32_t s = 0; s < sets && reader.ok(); ++s) {
        FaceSet& set = mrr.sets.emplace_back();
        set.name = reader.name(reader.number());
        const std::uint32_t count = reader.number();
        for (std::uint32_t i = 0; i < count && reader.ok(); ++i) set.regions.push_back(reader.number());
    }
    if (!reader.ok() || reader.left() > 0 || mrr.regions.size() != faces)
        return corrupt(at, "the regions are not one for each of the " + std::to_string(faces) + " faces, or names are missing");
    return Done{};
}

}  // namespace vsplit
