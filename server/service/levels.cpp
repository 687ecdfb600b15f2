#include "service/levels.h"

#include <utility>

#include "service/memory_use.h"
#include "vsplit/mrr/progressive_mesh.h"

namespace vsplit::service {
namespace {

constexpr std::size_t kCachedMeshes = 2;
constexpr std::size_t kKeptEncodings = 2;
constexpr std::size_t kKeptQualities = 64;  // some hundred bytes each

/// The value of `key` in `cache`, from `make()` when it is not there; it stays there if memory has room for the `bytes(value)`.
template <class Value, class Make, class Bytes>
std::shared_ptr<const Value> cached(LruCache<Paid<Value>>& cache, std::size_t key, MemoryBudget& budget, const Make& make,
                                    const Bytes& bytes) {
    std::shared_ptr<const Paid<Value>> paid = cache.find(key);
    if (!paid) {
        auto made = std::make_shared<Paid<Value>>(Paid<Value>{make(), {}});
        Expected<MemoryBudget::Share> share = budget.reserve(bytes(made->value), "a cached level");
        const bool room = share.has_value();
        if (room) made->share = *std::move(share);
        paid = room ? cache.insert(key, std::move(made)) : std::move(made);
    }
    return {paid, &paid->value};
}

}  // namespace

Levels::Levels(MultiresMesh mrr, MemoryBudget& budget)
    : mrr_(std::move(mrr)),
      box_(box_of_all(mrr_)),
      budget_(budget),
      meshes_(kCachedMeshes),
      qualities_(kKeptQualities),
      encoded_(kKeptEncodings) {}

std::shared_ptr<const TriangleMesh> Levels::mesh(std::size_t level) const {
    return cached(
        meshes_, level, budget_, [&] { return mesh_at(mrr_, level); }, [](const TriangleMesh& mesh) { return memory_of(mesh); });
}

std::shared_ptr<const Quality> Levels::quality(std::size_t level) const {
    if (std::shared_ptr<const Quality> kept = qualities_.find(level)) return kept;
    return qualities_.insert(level, std::make_shared<const Quality>(measure_quality(*mesh(level))));
}

std::shared_ptr<EncodedRecords> Levels::encoded(const EncodingChoice& choice) const {
    const std::size_t key = static_cast<std::size_t>(choice.encoding) * (kMostBits + 1) + choice.bits;
    // Blocks and the mesh they are made with come bit by bit; half of what the representation takes is more than they get.
    const auto half = [this](const std::shared_ptr<EncodedRecords>&) { return memory_of(mrr_) / 2; };
    return *cached(
        encoded_, key, budget_, [&] { return std::make_shared<EncodedRecords>(mrr_, box_, choice); }, half);
}

}  // namespace vsplit::service
