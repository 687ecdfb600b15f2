#include "vsplit/mesh/length_unit.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>

namespace vsplit {
namespace {

struct UnitName {
    LengthUnit unit;
    std::string_view symbol;
    std::int64_t micrometres;  // in one; an inch is 25.4 mm by definition, so all are whole
};

constexpr std::array<UnitName, 6> kUnits = {{{LengthUnit::kMicrometre, "um", 1},
                                             {LengthUnit::kMillimetre, "mm", 1'000},
                                             {LengthUnit::kCentimetre, "cm", 10'000},
                                             {LengthUnit::kMetre, "m", 1'000'000},
                                             {LengthUnit::kInch, "in", 25'400},
                                             {LengthUnit::kFoot, "ft", 304'800}}};

const UnitName& name_of(LengthUnit unit) {
    return *std::find_if(kUnits.begin(), kUnits.end(), [unit](const UnitName& known) { return known.unit == unit; });
}

}  // namespace

std::span<const LengthUnit> length_units() {
    static const auto all = [] {
        std::array<LengthUnit, kUnits.size()> units{};
        std::transform(kUnits.begin(), kUnits.end(), units.begin(), [](const UnitName& known) { return known.unit; });
        return units;
    }();
    return all;
}

std::string_view unit_symbol(LengthUnit unit) { return name_of(unit).symbol; }

Expected<LengthUnit> unit_by_symbol(std::string_view symbol) {
    std::string accepted;
    for (const UnitName& known : kUnits) {
        if (known.symbol == symbol) return known.unit;
        accepted.append(accepted.empty() ? "" : ", ").append(known.symbol);
    }
    return Error{Cause::kInvalidOption, "no unit of length is called '" + std::string(symbol) + "'; known are " + accepted,
                 "unit"};
}

Expected<std::optional<LengthUnit>> agreed_unit(std::optional<LengthUnit> told, std::optional<LengthUnit> stated) {
    if (!told || !stated || *told == *stated) return told ? told : stated;
    return Error{Cause::kInvalidOption,
                 "the file says its lengths are in " + std::string(unit_symbol(*told)) + ", and " +
                     std::string(unit_symbol(*stated)) + " is stated; leave the unit out, or state the file's",
                 "unit"};
}

double metres_in(LengthUnit unit) {
    return static_cast<double>(name_of(unit).micrometres) / static_cast<double>(name_of(LengthUnit::kMetre).micrometres);
}

void convert_lengths(std::span<Vec3> positions, LengthUnit from, LengthUnit to) {
    const std::int64_t shared = std::gcd(name_of(from).micrometres, name_of(to).micrometres);
    const std::int64_t times = name_of(from).micrometres / shared;
    const std::int64_t parts = name_of(to).micrometres / shared;
    for (Vec3& position : positions) position = position * static_cast<double>(times) / static_cast<double>(parts);
}

}  // namespace vsplit
