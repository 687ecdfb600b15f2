#pragma once

#include <cstdint>

// What the module exports: one mesh an instance, so that its memory goes when the instance does. Bytes come in through `room`;
// what can fail returns whether it was done, and the view says why not. TypeScript (src/engine.ts) is the only caller, but for
// the fuzzer.
#ifdef __wasm__
#define VSPLIT_EXPORT(name) extern "C" __attribute__((export_name(#name)))
#else
#define VSPLIT_EXPORT(name)
#endif

namespace vsplit::web {

/// What the caller reads after each call: addresses and numbers, all of 32 bits.
struct View {
    const double* positions = nullptr;  ///< three a vertex
    std::uint32_t vertices = 0;
    const std::uint32_t* corners = nullptr;  ///< three a face
    std::uint32_t faces = 0;
    std::uint32_t level = 0;
    std::uint32_t records = 0;  ///< applied
    std::uint32_t undone = 0;
    const std::uint32_t* changes = nullptr;
    std::uint32_t change_count = 0;
    const char* error = nullptr;
    std::uint32_t error_size = 0;
};

/// The same at every call.
VSPLIT_EXPORT(view) const View* view();

/// Where so many bytes go that the next call is about.
VSPLIT_EXPORT(room) char* room(std::uint32_t bytes);

/// Of the bytes in `room`, which go on after those whose checksum was `before`; 0 where there are none.
VSPLIT_EXPORT(crc32c) std::uint32_t checksum(std::uint32_t before);

/// The grid of what follows.
VSPLIT_EXPORT(grid) bool set_grid(std::uint32_t encoding, std::uint32_t bits, double x, double y, double z, double step);

/// Unpacks a base mesh, which then is in the view.
VSPLIT_EXPORT(unpack_base) bool unpack(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts);

/// Begins with the base mesh in `room`: positions, then corners, as many as the counts say.
VSPLIT_EXPORT(begin) bool begin_plain(std::uint32_t vertices, std::uint32_t faces, std::uint32_t ghosts);

// The others want a mesh that has begun, and are as HeldMesh has them.

VSPLIT_EXPORT(foresee) void foresee(std::uint32_t splits);
/// A block whose payload is in `room`.
VSPLIT_EXPORT(append) bool append(std::uint32_t first, std::uint32_t count, std::uint32_t encoding, std::uint32_t crc);
VSPLIT_EXPORT(coarsen) void coarsen(std::uint32_t levels);
VSPLIT_EXPORT(refine) void refine(std::uint32_t level);
VSPLIT_EXPORT(rewind) void rewind_to(std::uint32_t records);
VSPLIT_EXPORT(follow) void follow();
/// They then are in the view.
VSPLIT_EXPORT(changes) void changes();

}  // namespace vsplit::web
