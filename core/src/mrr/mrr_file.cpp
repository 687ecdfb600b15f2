#include "vsplit/mrr/mrr_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/mapped_file.h"
#include "base/write_file.h"

namespace vsplit {

Expected<StoredMrr> in_encoding(StoredMrr stored, const EncodingChoice& choice) {
    const Expected<PositionGrid> grid = PositionGrid::over(stored.mrr, choice);
    if (!grid) return grid.error();
    const BoundingBox box = box_of_all(stored.mrr);
    const double largest = box.empty() ? 0 : std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
    const double error = grid->max_error(largest);
    stored.mrr = on_grid(stored.mrr, *grid);
    stored.grid = *grid;
    stored.max_error += error;
    // Both surfaces move with their corners, and none of those by more than this.
    for (LevelDeviation& known : stored.deviations) known.most += std::numbers::sqrt3 * error;
    return stored;
}

Status save_mrr(const StoredMrr& stored, const std::filesystem::path& path) { return write_file(path, encode_mrr(stored)); }

Expected<StoredMrr> load_mrr(const std::filesystem::path& path) {
    const Expected<MappedFile> file = MappedFile::open(path);
    if (!file) return file.error();
    return decode_mrr(file->bytes());
}

}  // namespace vsplit
