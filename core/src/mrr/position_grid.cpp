#include "vsplit/mrr/position_grid.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "base/number_text.h"
#include "mesh/coordinate.h"
#include "mrr/grid_codes.h"

namespace vsplit {
namespace {

Status check_bits(std::uint32_t bits) {
    if (bits >= kFewestBits && bits <= kMostBits) return Done{};
    return Error{Cause::kInvalidOption,
                 "quantisation_bits is " + std::to_string(bits) + "; accepted are " + std::to_string(kFewestBits) + " to " +
                     std::to_string(kMostBits),
                 "quantisation_bits"};
}

}  // namespace

Expected<EncodingChoice> check_encoding(EncodingChoice choice) {
    if (choice.encoding == RecordEncoding::kQuantised) {
        if (choice.bits == 0) choice.bits = kUsualBits;
        if (Status valid = check_bits(choice.bits); !valid) return valid.error();
        return choice;
    }
    if (choice.bits == 0) return choice;
    return Error{Cause::kInvalidOption,
                 "quantisation_bits is " + std::to_string(choice.bits) + "; it goes with the encoding QUANTISED only",
                 "quantisation_bits"};
}

PositionGrid PositionGrid::float32() {
    PositionGrid grid;
    grid.encoding_ = RecordEncoding::kFloat32;
    return grid;
}

Expected<PositionGrid> PositionGrid::quantised(std::uint32_t bits, const Vec3& origin, double step) {
    if (Status valid = check_bits(bits); !valid) return valid.error();
    const Vec3 end = origin + Vec3::Constant(step * static_cast<double>((std::uint64_t{1} << bits) - 1));
    // A lesser step has no reciprocal, and codes come from a product with it.
    constexpr double kLeastStep = std::numeric_limits<double>::min();
    if (!(step >= kLeastStep) || !is_valid_position(origin) || !is_valid_position(end)) {
        return Error{Cause::kInvalidOption,
                     "a grid from (" + number_text(origin.x()) + ", " + number_text(origin.y()) + ", " + number_text(origin.z()) +
                         ") on in steps of " + number_text(step) + "; accepted are steps from " + number_text(kLeastStep) +
                         " on and coordinates up to 1e15",
                     ""};
    }
    PositionGrid grid;
    grid.encoding_ = RecordEncoding::kQuantised;
    grid.bits_ = bits;
    grid.origin_ = origin;
    grid.step_ = step;
    return grid;
}

Expected<PositionGrid> PositionGrid::over(const MultiresMesh& mrr, const EncodingChoice& choice) {
    return over(choice.encoding == RecordEncoding::kQuantised ? box_of_all(mrr) : BoundingBox(), choice);
}

Expected<PositionGrid> PositionGrid::over(const BoundingBox& box, const EncodingChoice& choice) {
    const Expected<EncodingChoice> checked = check_encoding(choice);
    if (!checked) return checked.error();
    if (checked->encoding == RecordEncoding::kFloat64) return PositionGrid();
    if (checked->encoding == RecordEncoding::kFloat32) return float32();
    const double side = (box.max - box.min).maxCoeff();
    const double step = side / static_cast<double>((std::uint64_t{1} << checked->bits) - 1);
    // All points are one, or so near each other that a double cannot divide the distance.
    return quantised(checked->bits, box.min, std::max(step, std::numeric_limits<double>::min()));
}

double PositionGrid::max_error(double largest) const {
    constexpr double kFloatHalf = 0x1p-24, kDoubleHalf = 0x1p-53, kLeastFloatHalf = 0x1p-150;
    if (encoding_ == RecordEncoding::kFloat64) return 0;
    if (encoding_ == RecordEncoding::kFloat32) return std::max(largest * kFloatHalf, kLeastFloatHalf);
    return step_ * (0.5 + 0x1p-20) + 8 * largest * kDoubleHalf;  // half a step, and what rounding adds
}

Vec3 PositionGrid::snap(const Vec3& position) const {
    if (encoding_ == RecordEncoding::kFloat64) return position;
    if (encoding_ == RecordEncoding::kFloat32)
        return {rounded_to_float(position.x()), rounded_to_float(position.y()), rounded_to_float(position.z())};
    const QuantisedCodes codes(*this);
    Vec3 snapped;
    for (unsigned axis = 0; axis < 3; ++axis) snapped[axis] = codes.value(codes.code(position[axis], axis), axis);
    return snapped;
}

BoundingBox box_of_all(const MultiresMesh& mrr) {
    BoundingBox box;
    for_each_position(mrr, [&box](const Vec3& position) {
        box.min = box.min.cwiseMin(position);
        box.max = box.max.cwiseMax(position);
    });
    return box;
}

RecordList on_grid(const RecordSpan& records, const PositionGrid& grid) {
    RecordList rounded;
    rounded.reserve(records.splits.size(), records.flips.size(), records.moves.size());
    for_each_record(records, [&](auto record) {
        using AnyRecord = decltype(record);
        if constexpr (std::is_same_v<AnyRecord, VertexSplit>) {
            record.kept = grid.snap(record.kept);
            record.added = grid.snap(record.added);
        } else if constexpr (std::is_same_v<AnyRecord, VertexMove>) {
            record.position = grid.snap(record.position);
        }
        rounded.push_back(record);
    });
    return rounded;
}

MultiresMesh on_grid(const MultiresMesh& mrr, const PositionGrid& grid) {
    MultiresMesh result{mrr.base, on_grid(mrr.records, grid), mrr.ghosts, mrr.ghost_faces, mrr.border_splits, mrr.regions,
                        mrr.sets};
    for (Vec3& position : result.base.positions) position = grid.snap(position);
    return result;
}

}  // namespace vsplit
