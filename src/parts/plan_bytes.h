/* plan_bytes.h - long arrays of a plan: one description for writing and
 * reading, without a copy, and the sum by which damage is found.
 *
 * An array has the least significant byte of each number first, and zeros
 * behind it up to a multiple of 32 bytes. */
#ifndef PARTS_PLAN_BYTES_H
#define PARTS_PLAN_BYTES_H

#include "base/file_reader.h"
#include "base/stream.h"

enum { PLAN_BLOCK = 32, PLAN_LANES = 4 };

/* Zero-initialised it writes to a stream that is yet to be set. */
struct plan_bytes {
  struct stream *stream;            /* writing; else NULL */
  const struct file_reader *reader; /* reading */
  uint64_t place;                   /* in the file, of the next array */
  uint64_t lane[PLAN_LANES];        /* the sum: hashes of every fourth word */
  recto_status status;              /* reading: of the first error; */
  recto_error *error;               /*   where it goes */
};

/* How many items, at least, an array must have room for in reading. */
static inline size_t plan_bytes_room(size_t count, size_t size) {
  return count + PLAN_BLOCK / size + 1;
}

/* How many bytes an array takes in the file. */
static inline uint64_t plan_bytes_size(size_t count, size_t size) {
  return ((uint64_t)count * size + PLAN_BLOCK - 1) / PLAN_BLOCK * PLAN_BLOCK;
}

/* Begins another sum. */
void plan_bytes_begin_sum(struct plan_bytes *bytes);
/* Adds blocks of PLAN_BLOCK bytes to it. */
void plan_bytes_add(struct plan_bytes *bytes, const void *item, size_t blocks);
uint64_t plan_bytes_sum(const struct plan_bytes *bytes);

/* Writes or reads an array of numbers of 1, 4 or 8 bytes.
 * item  in reading, room for plan_bytes_room of them */
void plan_bytes_array(struct plan_bytes *bytes, void *item, size_t count,
                      size_t size);

#endif
