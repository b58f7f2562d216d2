/* wide.h - 128-bit integers to and from GMP, for the rare wide path. */
#ifndef GEOM_WIDE_H
#define GEOM_WIDE_H

#include <gmp.h>
#include <stdbool.h>
#include <stdint.h>

#include "geom/ratio.h"

static inline void wide_set_int128(mpz_t to, int128 value) {
  bool negative = value < 0;
  uint128 magnitude = negative ? -(uint128)value : (uint128)value;
  uint64_t limb[2] = {(uint64_t)magnitude, (uint64_t)(magnitude >> 64)};
  mpz_import(to, 2, -1, sizeof limb[0], 0, 0, limb);
  if (negative) mpz_neg(to, to);
}

#endif
