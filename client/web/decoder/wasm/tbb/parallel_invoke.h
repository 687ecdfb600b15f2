#pragma once

namespace tbb {

template <class... Body>
void parallel_invoke(const Body&... bodies) {
    (bodies(), ...);
}

}  // namespace tbb
