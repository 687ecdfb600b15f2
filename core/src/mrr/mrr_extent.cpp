#include "vsplit/mrr/mrr_extent.h"

namespace vsplit {

MrrExtent extent_of(const MultiresMesh& mrr) {
    return {mrr.faces_min(), mrr.faces_max(), static_cast<std::uint32_t>(mrr.records.splits().size()),
            static_cast<std::uint32_t>(mrr.records.flips().size()), static_cast<std::uint32_t>(mrr.records.moves().size())};
}

}  // namespace vsplit
