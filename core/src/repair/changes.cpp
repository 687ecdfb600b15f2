#include "repair/changes.h"

#include <string>
#include <utility>

#include "base/number_text.h"

namespace vsplit {
namespace {

std::string_view what_changed(Finding::Kind kind) {
    switch (kind) {
        case Finding::Kind::kMergedVertex:
            return "vertices were merged with one nearby";
        case Finding::Kind::kDroppedFace:
            return "faces with two equal corners were dropped";
        case Finding::Kind::kFlattenedFace:
            return "faces without area were flipped, contracted or dropped";
        case Finding::Kind::kDroppedDuplicate:
            return "faces were dropped: copies of others on the same three vertices, and walls of no thickness";
        case Finding::Kind::kStitchedVertex:
            return "vertices of borders were joined to a border nearby";
        case Finding::Kind::kTurnedFace:
            return "faces were turned to agree with their neighbours or to look outwards";
        case Finding::Kind::kSplitEdge:
            return "edges with more than two faces, or faces that disagree, were cut apart";
        case Finding::Kind::kSplitVertex:
            return "vertices with more than one fan of faces were cut apart";
        case Finding::Kind::kDroppedSpeck:
            return "pieces were dropped for being small";
        case Finding::Kind::kFilledHole:
            return "holes were filled";
        case Finding::Kind::kLostFace:
            return "faces were dropped that no other replaces in their region or sets";
        case Finding::Kind::kEmptiedGroup:
            return "sets, or regions in no set, lost all their faces";
        default:
            return "changes were made";
    }
}

std::string place_text(const Vec3& p) {
    return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ")";
}

/// The first few of what lost faces.
std::string losses_text(const std::map<std::string, std::uint32_t>& losses) {
    constexpr std::size_t kShown = 10;
    std::string text;
    std::size_t shown = 0;
    for (const auto& [of, faces] : losses) {
        if (shown++ == kShown) return text + ", and " + std::to_string(losses.size() - kShown) + " more";
        text.append(text.empty() ? ": " : ", ").append(std::to_string(faces)).append(" of ").append(of);
    }
    return text;
}

}  // namespace

void Changes::add(Finding::Kind kind, const Vec3& place, std::uint32_t face) {
    Finding& finding = findings_[kind];
    finding.kind = kind;
    ++finding.count;
    finding.places.push_back(place);
    if (face != kNoFace && finding.elements.size() < Finding::kExamples) finding.elements.push_back(face);
}

void Changes::add_loss(Finding::Kind kind, const Vec3& place, std::uint32_t face, const std::string& of, std::uint32_t faces) {
    add(kind, place, face);
    losses_[kind][of] += faces;
}

std::vector<Finding> Changes::take() {
    std::vector<Finding> all;
    for (auto& [kind, finding] : findings_) {
        finding.message = std::to_string(finding.count) + " " + std::string(what_changed(kind)) + losses_text(losses_[kind]) +
                          "; first at " + place_text(finding.places.front());
        all.push_back(std::move(finding));
    }
    findings_.clear();
    return all;
}

}  // namespace vsplit
