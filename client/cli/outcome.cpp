#include "cli/outcome.h"

#include "wire/convert.h"

namespace vsplit::cli {
namespace {

/// One of a later version is not known here.
std::optional<LengthUnit> known(v1::LengthUnit unit) {
    const Expected<std::optional<LengthUnit>> found = wire::from_proto(unit);
    return found ? *found : std::nullopt;
}

std::optional<LengthUnit> of(const v1::MeshSummary& summary) { return known(summary.unit()); }
std::optional<LengthUnit> of(const v1::Representation& representation) { return known(representation.unit()); }
std::optional<LengthUnit> of(const Comparison& comparison) { return comparison.unit; }
std::optional<LengthUnit> of(const v1::ListFeaturesResponse& list) { return known(list.unit()); }
std::optional<LengthUnit> of(const v1::RemoveFeaturesResponse& done) { return known(done.source().unit()); }

}  // namespace

std::optional<LengthUnit> unit_of(const Document& document) {
    return std::visit([](const auto& d) { return of(d); }, document);
}

}  // namespace vsplit::cli
