#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "check.h"
#include "wasm/decoder.h"

namespace {

using namespace vsplit;

/// The octahedron of the fuzz target decode_compact.
constexpr std::array<double, 18> kPositions{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
constexpr std::array<std::uint32_t, 24> kCorners{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

void put(const void* bytes, std::size_t size) { std::memcpy(web::room(static_cast<std::uint32_t>(size)), bytes, size); }

void begin(std::uint32_t ghosts) {
    std::string bytes(sizeof(kPositions) + sizeof(kCorners), '\0');
    std::memcpy(bytes.data(), kPositions.data(), sizeof(kPositions));
    std::memcpy(bytes.data() + sizeof(kPositions), kCorners.data(), sizeof(kCorners));
    put(bytes.data(), bytes.size());
    fuzz::check(web::begin_plain(6, 8, ghosts), "the base is a mesh");
}

struct Mesh {
    std::vector<double> positions;
    std::vector<std::uint32_t> corners;

    Mesh() {
        const web::View& view = *web::view();
        positions.assign(view.positions, view.positions + std::size_t{3} * view.vertices);
        corners.assign(view.corners, view.corners + std::size_t{3} * view.faces);
    }
    friend bool operator==(const Mesh&, const Mesh&) = default;

    [[nodiscard]] std::array<std::array<double, 3>, 3> face(std::uint32_t f) const {
        std::array<std::array<double, 3>, 3> points{};
        for (std::size_t c = 0; c < 3; ++c)
            std::copy_n(positions.begin() + std::ptrdiff_t{3} * corners[3 * f + c], 3, points.at(c).begin());
        return points;
    }
};

void check_changes(const Mesh& before) {
    web::changes();
    const web::View& view = *web::view();
    const std::span told(view.changes, view.change_count);
    fuzz::check(std::is_sorted(told.begin(), told.end()), "changes are in order");
    const Mesh now;
    for (std::uint32_t f = 0; f < view.faces; ++f) {
        const bool same = 3 * f < before.corners.size() && before.face(f) == now.face(f);
        fuzz::check(same || std::binary_search(told.begin(), told.end(), f), "a face that changed is told");
    }
}

/// All that has come.
Mesh finest() {
    web::refine(0xFFFFFFFFU);
    fuzz::check(web::view()->undone == 0, "all can be had back");
    return {};
}

void try_block(std::uint32_t encoding, std::uint16_t count, std::span<const std::uint8_t> payload) {
    const Mesh before = finest();
    const std::uint32_t records = web::view()->records;
    put(payload.data(), payload.size());
    const std::uint32_t crc = web::checksum(0);
    if (web::append(records, count, encoding, crc)) {
        fuzz::check(web::view()->records == records + count, "a block brings what it says");
        return;
    }
    fuzz::check(web::view()->error_size > 0, "what is refused has a reason");
    fuzz::check(Mesh() == before && web::view()->records == records, "a refused block changes nothing");
}

void try_level(std::uint8_t operation, std::uint8_t by) {
    const std::uint32_t records = web::view()->records + web::view()->undone;
    const Mesh now = finest();
    if (operation == 0) {
        web::coarsen(by);
    } else {
        web::coarsen(0xFFFFFFFFU);
        web::refine(by);
        fuzz::check(web::view()->level <= by, "no further than asked for");
    }
    fuzz::check(web::view()->records + web::view()->undone == records, "no record is lost");
    fuzz::check(finest() == now, "all comes back");
    web::coarsen(by);
}

}  // namespace

/// A byte of choices (the lowest bit: which encoding, then two: how many ghosts, whether changes are followed), then operations:
/// a byte which; a block has two bytes for its count, two for its size and so many more, the others one byte.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> left(data, size);
    const auto next = [&left]() -> std::uint8_t {
        if (left.empty()) return 0;
        const std::uint8_t byte = left.front();
        left = left.subspan(1);
        return byte;
    };
    const auto next_two = [&next] {
        const unsigned low = next();
        return static_cast<std::uint16_t>(low | static_cast<unsigned>(next()) << 8U);
    };
    const std::uint8_t choice = next();
    const std::uint32_t encoding = (choice & 1U) != 0 ? 2 : 3;
    fuzz::check(encoding == 2 ? web::set_grid(2, 0, 0, 0, 0, 0) : web::set_grid(3, 14, -1, -1, -1, 0x1p-13), "the grid is one");
    begin(choice >> 1U & 1U);
    const bool followed = (choice & 4U) != 0;
    if (followed) web::follow();
    Mesh told;
    while (!left.empty()) {
        const unsigned operation = next() % 8U;
        if (operation < 3) {
            const std::uint16_t count = next_two();
            const auto bytes = std::min<std::size_t>(next_two(), left.size());
            try_block(encoding, count, left.first(bytes));
            left = left.subspan(bytes);
        } else if (operation < 5) {
            try_level(static_cast<std::uint8_t>(operation - 3), next());
        } else if (operation == 5) {
            web::rewind_to(next());
        } else if (operation == 6) {
            web::foresee(next());
        } else if (followed) {
            check_changes(told);
            told = Mesh();
        }
    }
    return 0;
}
