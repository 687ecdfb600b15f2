#include "mesh/index_table.h"

#include <algorithm>

#include "base/huge_pages.h"

namespace vsplit {

void IndexTable::reserve(std::size_t count) {
    const std::size_t needed = count + count / 2 + 1;
    if (needed <= slots_.size()) return;
    auto old = large_vector<Slot>(std::max(needed, 2 * slots_.size()));
    old.swap(slots_);
    for (const Slot& slot : old) {
        if (slot.index != kNone) insert(slot.hash, slot.index);
    }
}

void IndexTable::insert(std::uint32_t hash, std::uint32_t index) {
    std::size_t slot = home(hash);
    while (slots_[slot].index != kNone) slot = after(slot);
    slots_[slot] = {hash, index};
}

}  // namespace vsplit
