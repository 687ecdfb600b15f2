#pragma once

namespace vsplit {

/// Leaves the value empty and its memory to others. (`vector = {}` empties a vector and keeps its memory.)
template <class T>
void release(T& value) {
    value = T();
}

}  // namespace vsplit
