#pragma once

#include <stddef.h>
#include <stdint.h>

/// The decoder of records for other languages: a mesh that a stream builds, at any resolution that has come. Plain C; ctypes and
/// the like call it. A decoder is owned by who made it, and used by one thread at a time. Functions that can fail return 0 for
/// done and another number for failure; vsplit_decoder_error then says what was wrong.
#ifdef __cplusplus
extern "C" {
#endif

typedef struct vsplit_decoder vsplit_decoder;

/// Never null but for lack of memory. To be freed with vsplit_decoder_free.
vsplit_decoder* vsplit_decoder_new(void);
void vsplit_decoder_free(vsplit_decoder* decoder);

/// Of the last call that failed; valid until the next call.
const char* vsplit_decoder_error(const vsplit_decoder* decoder);

/// Begins with a base mesh of FLOAT64: 3 doubles a vertex, 3 indices a face.
int vsplit_decoder_begin(vsplit_decoder* decoder, const double* positions, uint32_t vertices, const uint32_t* indices,
                         uint32_t faces, uint32_t ghosts);

/// Begins with a keyframe, a mesh of FLOAT64 that the first `first_record` records are in: it goes on with that record.
int vsplit_decoder_begin_keyframe(vsplit_decoder* decoder, const double* positions, uint32_t vertices, const uint32_t* indices,
                                  uint32_t faces, uint32_t ghosts, uint32_t first_record);

/// Begins with a packed one and its checksum: `bits`, `origin` (3 doubles) and `step` of QUANTISED, 0, 0 and 0 of FLOAT32.
int vsplit_decoder_begin_packed(vsplit_decoder* decoder, const uint8_t* bytes, size_t size, uint32_t crc32c, uint32_t vertices,
                                uint32_t faces, uint32_t ghosts, uint32_t encoding, uint32_t bits, const double* origin,
                                double step);

/// Begins with the bytes of a `.vsplit` file, and brings all its records. The level to show is shown.
int vsplit_decoder_load(vsplit_decoder* decoder, const uint8_t* bytes, size_t size);

/// The fields of a RecordBlock.
int vsplit_decoder_append(vsplit_decoder* decoder, uint32_t first, uint32_t count, uint32_t encoding, uint32_t crc32c,
                          const uint8_t* payload, size_t size);

/// Regions: an id a face of the finest resolution, faces that touch a ghost (0) included, after the base mesh has begun; in the
/// place of those before. Then sets, each a name (UTF-8) for some regions.
int vsplit_decoder_set_regions(vsplit_decoder* decoder, const uint32_t* ids, uint32_t faces);
int vsplit_decoder_add_set(vsplit_decoder* decoder, const char* name, const uint32_t* regions, uint32_t count);

/// Shows the resolution nearest to `faces` of those that have come.
int vsplit_decoder_show(vsplit_decoder* decoder, uint32_t faces);

/// Faces of the finest resolution and records that have come, those that a keyframe has in it too; vertices and faces of what is
/// shown.
uint32_t vsplit_decoder_faces_held(const vsplit_decoder* decoder);
uint32_t vsplit_decoder_records_held(const vsplit_decoder* decoder);
uint32_t vsplit_decoder_vertices(const vsplit_decoder* decoder);
uint32_t vsplit_decoder_faces(const vsplit_decoder* decoder);

/// Copies what is shown: 3 doubles a vertex, 3 indices a face.
void vsplit_decoder_copy(const vsplit_decoder* decoder, double* positions, uint32_t* indices);

/// Whether the mesh has regions (1) or none (0), and those of what is shown: an id a face.
int vsplit_decoder_has_regions(const vsplit_decoder* decoder);
void vsplit_decoder_copy_regions(const vsplit_decoder* decoder, uint32_t* ids);

/// How many sets there are; of one of them the name (UTF-8, as long as the decoder stays as it is), how many regions it has, and
/// which. Precondition: set < vsplit_decoder_sets(decoder).
uint32_t vsplit_decoder_sets(const vsplit_decoder* decoder);
const char* vsplit_decoder_set_name(const vsplit_decoder* decoder, uint32_t set);
uint32_t vsplit_decoder_set_size(const vsplit_decoder* decoder, uint32_t set);
void vsplit_decoder_copy_set(const vsplit_decoder* decoder, uint32_t set, uint32_t* regions);

/// Of the lengths of a file: "um", "mm", "cm", "m", "in", "ft", or "" where that is not known; "" for a stream, which says it
/// elsewhere.
const char* vsplit_decoder_unit(const vsplit_decoder* decoder);

#ifdef __cplusplus
}
#endif
