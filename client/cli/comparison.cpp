#include "cli/comparison.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "wire/convert.h"

namespace vsplit::cli {
namespace {

/// Digits enough to read the same number back.
std::string number(double value) {
    if (!std::isfinite(value)) return "null";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return text.data();
}

std::string object(const DirectedDeviation& d) {
    return R"({"lower": )" + number(d.lower) + R"(, "upper": )" + number(d.upper) + R"(, "at": {"x": )" + number(d.at.x()) +
           R"(, "y": )" + number(d.at.y()) + R"(, "z": )" + number(d.at.z()) + "}}";
}

}  // namespace

Expected<Comparison> compare(const TriangleMesh& mesh, const TriangleMesh& against, std::optional<double> error,
                             const ExecutionContext& context) {
    if (error && !(*error > 0 && std::isfinite(*error))) {
        return Error{Cause::kInvalidOption, "the error is " + number(*error) + "; a length above 0 is accepted", "error"};
    }
    DeviationOptions accuracy;
    if (error) accuracy = {.relative_error = 0, .absolute_error = *error};
    const Expected<Deviation> surface = measure_deviation(mesh, against, accuracy, context);
    if (!surface) return surface.error();
    const Expected<CreaseDeviation> creases = measure_crease_deviation(mesh, against, {.accuracy = accuracy}, context);
    if (!creases) return creases.error();
    return Comparison{mesh.face_count(), against.face_count(), bounding_box(against).diagonal(), {}, *surface, *creases};
}

std::string to_json(const Comparison& c) {
    std::string text = "{\n";
    text += R"( "faces": )" + std::to_string(c.faces) + ",\n";
    text += R"( "facesAgainst": )" + std::to_string(c.faces_against) + ",\n";
    text += R"( "unit": ")" + v1::LengthUnit_Name(wire::to_proto(c.unit)) + "\",\n";
    text += R"( "diagonal": )" + number(c.diagonal) + ",\n";
    text += R"( "deviationMax": )" + number(c.surface.max()) + ",\n";
    text += R"( "deviationMeasured": )" + number(c.surface.measured()) + ",\n";
    text += R"( "toSource": )" + object(c.surface.to_source) + ",\n";
    text += R"( "fromSource": )" + object(c.surface.from_source) + ",\n";
    text += R"( "creases": )" + std::to_string(c.creases.result_creases) + ",\n";
    text += R"( "creasesAgainst": )" + std::to_string(c.creases.source_creases) + ",\n";
    text += R"( "creasesFromSource": )" + object(c.creases.from_source) + ",\n";
    text += R"( "creasesLost": )" + number(c.creases.lost) + "\n}\n";
    return text;
}

}  // namespace vsplit::cli
