/* hash.h - hashes of numbers, by multiplication and folding, and of texts. */
#ifndef BASE_HASH_H
#define BASE_HASH_H

#include <stdint.h>
#include <string.h>

/* 2^64 divided by the golden ratio, an odd number [Knuth1998, 6.4]. */
#define HASH_GOLDEN UINT64_C(0x9e3779b97f4a7c15)

/* Adds a number to a hash, which starts as 0.  The product spreads the number's
 * bits upwards, the shift brings them down again.  Where only the upper bits of
 * a hash are used, it should be multiplied by HASH_GOLDEN once more. */
static inline uint64_t hash_add(uint64_t hash, uint64_t number) {
  hash = (hash ^ number) * HASH_GOLDEN;
  return hash ^ hash >> 32;
}

/* The same for a double; 0 and -0 differ. */
static inline uint64_t hash_add_double(uint64_t hash, double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return hash_add(hash, bits);
}

/* The hash of a text: FNV-1a, folded.  It is the same everywhere. */
static inline uint64_t hash_text(const char *text, size_t length) {
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  for (size_t i = 0; i < length; i++)
    hash = (hash ^ (unsigned char)text[i]) * UINT64_C(0x100000001b3);
  return hash ^ hash >> 32;
}

#endif
