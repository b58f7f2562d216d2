/* line_key.c - hashes of lines, that are equal where lines are the same. */
#include "geom/line_key.h"

#include "base/hash.h"

static uint64_t common_divisor(uint64_t a, uint64_t b) {
  while (b != 0) {
    uint64_t rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

static uint64_t magnitude_64(int64_t a) {
  return a < 0 ? (uint64_t)-a : (uint64_t)a;
}

/* Mixes the coefficients, which have no common divisor, so that few lines share
 * a key that are different. */
static uint64_t hash_line(struct geom_line_integers l) {
  bool turned = l.a < 0 || (l.a == 0 && l.b < 0);
  const uint64_t part[3] = {(uint64_t)l.a, (uint64_t)l.b, (uint64_t)l.c};
  uint64_t sum = 0;
  for (int k = 0; k < 3; k++)
    sum = hash_add(sum, turned ? 0 - part[k] : part[k]);
  return sum;
}

/* The same integers for a plane intersection; false where they are too
 * large. */
static bool reduce_coefficients(const struct geom_line *line,
                                struct geom_line_integers *to) {
  struct wide exact[3];
  int64_t reduced[3];
  geom_line_exact(exact, line);
  if (!wide_reduce(exact, reduced))
    return false;
  *to = (struct geom_line_integers){reduced[0], reduced[1], reduced[2]};
  return true;
}

/* Residues are modulo the prime 2^61 - 1, so that 2^64 is 8. */
#define RESIDUE_PRIME ((UINT64_C(1) << 61) - 1)

static uint64_t multiply_residues(uint64_t a, uint64_t b) {
  return (uint64_t)((uint128)a * b % RESIDUE_PRIME);
}

/* The key of a plane intersection whose integers are too large to be reduced:
 * the residues of its coefficients, divided by the first that is not 0. */
static uint64_t key_of_residues(const struct geom_line *line) {
  uint64_t residue[3], inverse = 1, power;
  int first = 2;
  for (int k = 2; k >= 0; k--) {
    residue[k] = 0;
    for (int i = GEOM_LINE_LIMBS; i-- > 0;)
      residue[k] = (uint64_t)(((uint128)residue[k] * 8 + line->limb[k][i]) %
                              RESIDUE_PRIME);
    if (line->sign[k] < 0 && residue[k] != 0)
      residue[k] = RESIDUE_PRIME - residue[k];
    if (residue[k] != 0)
      first = k;
  }
  /* By Fermat's little theorem. */
  power = residue[first];
  for (uint64_t bits = RESIDUE_PRIME - 2; bits != 0; bits >>= 1) {
    if (bits & 1)
      inverse = multiply_residues(inverse, power);
    power = multiply_residues(power, power);
  }
  return hash_line((struct geom_line_integers){
      (int64_t)multiply_residues(residue[0], inverse),
      (int64_t)multiply_residues(residue[1], inverse),
      (int64_t)multiply_residues(residue[2], inverse)});
}

bool geom_line_key(const struct geom_line *line, uint64_t *key) {
  struct geom_line_integers reduced;
  if (line->is_grid_line) {
    int64_t divisor;
    reduced = geom_line_integers_of(line);
    /* It divides c too. */
    divisor = (int64_t)common_divisor(magnitude_64(reduced.a),
                                      magnitude_64(reduced.b));
    reduced.a /= divisor;
    reduced.b /= divisor;
    reduced.c /= divisor;
  } else if (!reduce_coefficients(line, &reduced)) {
    *key = key_of_residues(line);
    return false;
  }
  *key = hash_line(reduced);
  return true;
}
