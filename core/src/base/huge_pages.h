#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vsplit {

/// Asks for large pages under memory that is about to be used, where it is large enough for some: who jumps about in many
/// megabytes otherwise waits for the tables that say where the small ones are. A wish; nothing depends on it.
inline void prefer_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::size_t kHugePage = std::size_t{1} << 21U;
    std::size_t room = bytes;
    if (std::align(kHugePage, kHugePage, begin, room) != nullptr)
        static_cast<void>(madvise(begin, room / kHugePage * kHugePage, MADV_HUGEPAGE));
#endif
}

/// Makes room for `count` elements in all, in large pages where that helps.
template <class Element>
void reserve_large(std::vector<Element>& elements, std::size_t count) {
    if (count <= elements.capacity()) return;
    std::vector<Element> larger;
    larger.reserve(count);
    prefer_huge_pages(larger.data(), count * sizeof(Element));
    larger.insert(larger.end(), elements.begin(), elements.end());
    elements.swap(larger);
}

/// `count` elements, in large pages where that helps.
template <class Element>
[[nodiscard]] std::vector<Element> large_vector(std::size_t count, const Element& value = Element()) {
    std::vector<Element> elements;
    reserve_large(elements, count);
    elements.resize(count, value);
    return elements;
}

}  // namespace vsplit
