/* digits.h - runs of decimal digits, eight at a time. */
#ifndef BASE_DIGITS_H
#define BASE_DIGITS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static inline bool digits_is_one(char c) { return c >= '0' && c <= '9'; }

#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define DIGITS_CHUNKS 1 /* eight bytes can be loaded as one number */

/* Sets *chunk to the eight bytes at `text` with each digit as its value, and
 * returns how many of them, from the first one on, are digits.
 *
 * A byte b is a digit where b ^ '0' <= 9; adding 0x76 then carries into its
 * top bit if it is not.  One beyond 0x89 carries into the byte after it, too;
 * but it has its own top bit, and only bytes before it matter. */
static inline int digits_count(const char *text, uint64_t *chunk) {
  memcpy(chunk, text, 8);
  *chunk ^= UINT64_C(0x3030303030303030);
  uint64_t other = (*chunk + UINT64_C(0x7676767676767676)) | *chunk;
  other &= UINT64_C(0x8080808080808080);
  return other ? __builtin_ctzll(other) / 8 : 8;
}

/* The number that the first `count` > 0 digits of a chunk make: shifted to
 * its end, zeros before them, they are added up in pairs, then fours, then
 * all eight. */
static inline uint64_t digits_sum(uint64_t chunk, int count) {
  chunk <<= 64 - 8 * count;
  chunk = chunk * 10 + (chunk >> 8);
  uint64_t first = chunk & UINT64_C(0x000000ff000000ff);
  uint64_t second = (chunk >> 16) & UINT64_C(0x000000ff000000ff);
  chunk = first * (UINT64_C(1000000) << 32 | 100) +
          second * (UINT64_C(10000) << 32 | 1);
  return chunk >> 32;
}
/* Reads a number of one to seven digits at `text`; returns where it ends, or
 * NULL where there are none or more.
 * Numbers that follow one another mostly have as many digits: where they are
 * many, the branch for their count is foreseen, and the next number is begun
 * before these are counted. */
static inline const char *digits_read_few(const char *text, uint64_t *sum) {
  uint64_t chunk;
  int count = digits_count(text, &chunk);
  if (__builtin_expect(count == 6, 1)) {
    *sum = digits_sum(chunk, 6);
    return text + 6;
  }
  if (__builtin_expect(count == 5, 1)) {
    *sum = digits_sum(chunk, 5);
    return text + 5;
  }
  if (__builtin_expect(count == 7, 1)) {
    *sum = digits_sum(chunk, 7);
    return text + 7;
  }
  if (count == 0 || count == 8)
    return NULL;
  *sum = digits_sum(chunk, count);
  return text + count;
}
#else
#define DIGITS_CHUNKS 0
#endif

/* Appends the digits at `text` to *w, modulo 2^64, and returns where they end.
 * Fastest where they are few. */
static inline const char *digits_gather_singly(const char *text,
                                               const char *end, uint64_t *w) {
  for (; text < end && digits_is_one(*text); text++)
    *w = *w * 10 + (uint64_t)(*text - '0');
  return text;
}

/* The same, without a branch that depends on how many there are up to
 * eight. */
static inline const char *digits_gather(const char *text, const char *end,
                                        uint64_t *w) {
#if DIGITS_CHUNKS
  static const uint64_t scale[9] = {1,      10,      100,      1000,     10000,
                                    100000, 1000000, 10000000, 100000000};
  while (end - text >= 8) {
    uint64_t chunk;
    int count = digits_count(text, &chunk);
    if (count == 0)
      return text;
    *w = *w * scale[count] + digits_sum(chunk, count);
    text += count;
    if (count < 8)
      return text;
  }
#endif
  return digits_gather_singly(text, end, w);
}

#endif
