// What core asks an operating system for, here who imports the module, and what libc++ would end the process with: so none of its
// calls gets into the module.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>

#include "base/number_text.h"
#include "mesh/point_hash.h"

namespace {

#define VSPLIT_IMPORT(name) __attribute__((import_module("decoder"), import_name(#name))) extern "C"

/// 32 bits that nobody can foresee.
VSPLIT_IMPORT(random) std::uint32_t random_bits();

/// A number as text. \return how many bytes of `room` it took.
VSPLIT_IMPORT(number_text) std::size_t put_number(double value, char* to, std::size_t room);

void* allocate(std::size_t bytes) {
    void* const memory = std::malloc(bytes);
    if (memory == nullptr) __builtin_trap();  // what a caller takes for lack of memory
    return memory;
}

std::array<std::uint64_t, 7> random_keys() {
    std::array<std::uint64_t, 7> keys{};
    for (std::uint64_t& key : keys) key = std::uint64_t{random_bits()} << 32U | random_bits();
    return keys;
}

}  // namespace

namespace vsplit {

PointHash::PointHash() {
    static const std::array<std::uint64_t, 7> keys = random_keys();
    keys_ = keys;
}

std::string number_text(double value) {
    std::array<char, 32> text{};
    return {text.data(), put_number(value, text.data(), text.size())};
}

}  // namespace vsplit

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
