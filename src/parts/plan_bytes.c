/* plan_bytes.c - long arrays of a plan, as bytes of a file.
 *
 * Performance  A section has tens of megabytes: its sum takes 32 bytes at a
 * time, in four chains that do not wait for each other. */
#include "parts/plan_bytes.h"

#include <string.h>

#include "base/hash.h"

void plan_bytes_begin_sum(struct plan_bytes *bytes) {
  memset(bytes->lane, 0, sizeof bytes->lane);
}

uint64_t plan_bytes_sum(const struct plan_bytes *bytes) {
  uint64_t sum = 0;
  for (int i = 0; i < PLAN_LANES; i++)
    sum = hash_add(sum, bytes->lane[i]);
  return sum;
}

/* The word whose least significant byte comes first. */
static inline uint64_t load_word(const unsigned char *at) {
  uint64_t low = (uint64_t)at[0] | (uint64_t)at[1] << 8 |
                 (uint64_t)at[2] << 16 | (uint64_t)at[3] << 24;
  uint64_t high = (uint64_t)at[4] | (uint64_t)at[5] << 8 |
                  (uint64_t)at[6] << 16 | (uint64_t)at[7] << 24;
  return high << 32 | low;
}

/* Each step is a bijection, so that no change of a single word leaves the sum
 * as it was. */
void plan_bytes_add(struct plan_bytes *bytes, const void *item, size_t blocks) {
  const unsigned char *at = item;
  uint64_t a = bytes->lane[0], b = bytes->lane[1], c = bytes->lane[2],
           d = bytes->lane[3];
  for (size_t i = 0; i < blocks; i++, at += PLAN_BLOCK) {
    a = hash_add(a, load_word(at));
    b = hash_add(b, load_word(at + 8));
    c = hash_add(c, load_word(at + 16));
    d = hash_add(d, load_word(at + 24));
  }
  bytes->lane[0] = a;
  bytes->lane[1] = b;
  bytes->lane[2] = c;
  bytes->lane[3] = d;
}

static bool is_little_endian(void) {
  const uint32_t one = 1;
  unsigned char first;
  memcpy(&first, &one, 1);
  return first == 1;
}

/* Reverses the bytes of each number. */
static void swap_numbers(void *item, size_t count, size_t size) {
  unsigned char *at = item;
  for (size_t i = 0; i < count; i++, at += size)
    for (size_t k = 0; k < size / 2; k++) {
      unsigned char byte = at[k];
      at[k] = at[size - 1 - k];
      at[size - 1 - k] = byte;
    }
}

/* Writes some bytes, and zeros up to a whole block. */
static void write_blocks(struct plan_bytes *bytes, const void *item,
                         size_t count) {
  size_t blocks = count / PLAN_BLOCK, rest = count % PLAN_BLOCK;
  unsigned char last[PLAN_BLOCK] = {0};
  plan_bytes_add(bytes, item, blocks);
  stream_write(bytes->stream, item, count);
  if (rest == 0)
    return;
  memcpy(last, (const unsigned char *)item + blocks * PLAN_BLOCK, rest);
  plan_bytes_add(bytes, last, 1);
  stream_write(bytes->stream, last + rest, PLAN_BLOCK - rest);
}

/* The same of numbers that are stored the other way round. */
static void write_swapped(struct plan_bytes *bytes, const void *item,
                          size_t count, size_t size) {
  unsigned char some[64 * PLAN_BLOCK];
  size_t most = sizeof some / size;
  const unsigned char *at = item;
  for (size_t i = 0; i < count; i += most) {
    size_t own = count - i < most ? count - i : most;
    memcpy(some, at + i * size, own * size);
    swap_numbers(some, own, size);
    write_blocks(bytes, some, own * size);
  }
}

void plan_bytes_array(struct plan_bytes *bytes, void *item, size_t count,
                      size_t size) {
  uint64_t padded = plan_bytes_size(count, size);
  if (bytes->status != RECTO_OK || count == 0)
    return;
  if (bytes->stream != NULL && is_little_endian())
    write_blocks(bytes, item, count * size);
  else if (bytes->stream != NULL)
    write_swapped(bytes, item, count, size);
  else {
    bytes->status = file_reader_read(bytes->reader, bytes->place, item,
                                     (size_t)padded, bytes->error);
    if (bytes->status == RECTO_OK)
      plan_bytes_add(bytes, item, (size_t)padded / PLAN_BLOCK);
    if (bytes->status == RECTO_OK && !is_little_endian())
      swap_numbers(item, count, size);
  }
  bytes->place += padded;
}
