#include "mesh/point_hash.h"

#include <random>

namespace vsplit {
namespace {

std::array<std::uint64_t, 7> random_keys() {
    std::random_device device;
    std::array<std::uint64_t, 7> keys{};
    for (std::uint64_t& key : keys) key = (std::uint64_t{device()} << 32) | device();
    return keys;
}

}  // namespace

PointHash::PointHash() {
    static const std::array<std::uint64_t, 7> keys = random_keys();
    keys_ = keys;
}

}  // namespace vsplit
