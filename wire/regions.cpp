#include "wire/regions.h"

#include <algorithm>
#include <string>

#include "wire/base_mesh.h"
#include "wire/utf8.h"

namespace vsplit::wire {
namespace {

constexpr std::size_t kIdBytes = 4;
constexpr std::size_t kIdsAPart = kMaxPartBytes / kIdBytes;

}  // namespace

std::size_t region_parts(const MultiresMesh& mrr) { return (mrr.regions.size() + kIdsAPart - 1) / kIdsAPart; }

v1::Regions region_part(const MultiresMesh& mrr, std::size_t part) {
    v1::Regions proto;
    const std::size_t first = part * kIdsAPart;
    const std::size_t count = std::min(kIdsAPart, mrr.regions.size() - first);
    proto.set_faces(static_cast<std::uint32_t>(mrr.regions.size()));
    proto.set_first(static_cast<std::uint32_t>(first));
    std::string& ids = *proto.mutable_ids();
    ids.reserve(count * kIdBytes);
    for (std::size_t f = first; f < first + count; ++f) {
        for (unsigned shift = 0; shift < 32; shift += 8) ids += static_cast<char>(mrr.regions[f] >> shift & 0xFFU);
    }
    if (part > 0) return proto;
    for (const FaceSet& set : mrr.sets) {
        v1::FaceSet& added = *proto.add_sets();
        added.set_name(valid_utf8(set.name, 4096));
        added.mutable_regions()->Add(set.regions.begin(), set.regions.end());
    }
    return proto;
}

Status add_regions(const v1::Regions& part, MultiresMesh& mrr) {
    if (part.first() != mrr.regions.size()) {
        return Error{Cause::kOutOfOrder,
                     "regions of face " + std::to_string(part.first()) + " and on came, expected are those from " +
                         std::to_string(mrr.regions.size()) + " on",
                     ""};
    }
    const std::string& ids = part.ids();
    if (ids.size() % kIdBytes != 0 || ids.size() / kIdBytes + mrr.regions.size() > part.faces()) {
        return Error{Cause::kCorrupt,
                     std::to_string(ids.size()) + " bytes of regions came for " + std::to_string(part.faces()) + " faces", ""};
    }
    for (std::size_t at = 0; at < ids.size(); at += kIdBytes) {
        std::uint32_t id = 0;
        for (std::size_t i = kIdBytes; i-- > 0;) id = id << 8U | static_cast<unsigned char>(ids[at + i]);
        mrr.regions.push_back(id);
    }
    for (const v1::FaceSet& set : part.sets()) mrr.sets.push_back({set.name(), {set.regions().begin(), set.regions().end()}});
    return Done{};
}

}  // namespace vsplit::wire
