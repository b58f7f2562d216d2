/* byte_codec.h - one description of a binary format for both directions: each
 * function writes a value to the end of the bytes, or reads it from them.
 *
 * Numbers have a fixed size and the least significant byte first, on any
 * machine; doubles are the bits of IEEE 754.  Where bytes are missing, `failed`
 * is set and every later value is 0, so that the caller checks once.
 */
#ifndef PARTS_BYTE_CODEC_H
#define PARTS_BYTE_CODEC_H

#include "base/memory.h"
#include "geom/ratio.h"

struct byte_codec {
  bool writes;
  bool failed;             /* bytes were missing, or a value was not valid */
  bool out_of_memory;      /* and that is why */
  struct byte_array bytes; /* written; owned */
  const unsigned char *at; /* reading: the next one, */
  size_t left;             /* and how many are left */
};

void byte_codec_u8(struct byte_codec *codec, uint8_t *value);
void byte_codec_u16(struct byte_codec *codec, uint16_t *value);
void byte_codec_u32(struct byte_codec *codec, uint32_t *value);
void byte_codec_u64(struct byte_codec *codec, uint64_t *value);
void byte_codec_i64(struct byte_codec *codec, int64_t *value);
void byte_codec_float(struct byte_codec *codec, float *value);
void byte_codec_double(struct byte_codec *codec, double *value);
void byte_codec_bool(struct byte_codec *codec, bool *value);

/* A parameter of an edge: in [0, 1], numbers below 2^126. */
void byte_codec_ratio(struct byte_codec *codec, struct ratio *value);

/* A number of items of at least `size` bytes each, of which there cannot be
 * more than there are bytes; 0 after a failure. */
void byte_codec_count(struct byte_codec *codec, size_t *count, size_t size);

/* A text; in reading, allocated, the caller's to free, NULL after a failure.
 * It has no NUL within. */
void byte_codec_text(struct byte_codec *codec, char **text);

/* The checksum of 64 bits of so many bytes, by the polynomial of ECMA-182: each
 * change of up to 64 consecutive bits changes it. */
uint64_t byte_codec_checksum(const void *bytes, size_t count);

#endif
