/* exact.c - signs of determinants of doubles.
 *
 * Phases
 *   1. In doubles, with a bound of the error.
 *   2. Where the bound leaves it open, as a sum of six products of two
 *      coordinates each, held in one fixed-point number that is wide enough
 *      for any of them.
 *
 * Robustness
 *   The bound.  Let u = 2^-53 and det = (bx - ax)(cy - ay) - (by - ay)(cx - ax)
 *   = l - r.  Each of l and r, as computed, is off by at most
 *   (1 + u)^3 - 1 < 3u + 4u^2 of the true one; the last difference adds u.
 *   So |error| < (4u + 8u^2)(|l| + |r|), and with the rounding of the bound
 *   itself it is below 5u (|l| + |r|).  A product below the normal range is
 *   off by less than DBL_MIN besides.  Overflow makes the bound infinite or
 *   not a number, and the comparison with it false.
 *
 *   The width.  A finite double is m 2^e, |m| < 2^53, -1126 <= e <= 971, so a
 *   product is an integer below 2^106 times 2^(-2252 ... 1942); six of them
 *   stay below 2^(1942 + 109).
 */
#include "scene/exact.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

__extension__ typedef unsigned __int128 uint128;

/* A number in two's complement, units of 2^-LOWEST, least limb first. */
enum { LOWEST = 2252, HIGHEST = 1942 + 112, LIMB_COUNT = 68 };
_Static_assert(64 * LIMB_COUNT >= LOWEST + HIGHEST, "too narrow");
struct exact_expansion {
  uint64_t limb[LIMB_COUNT];
};

/* *sum += x * y, or -= where `minus`. */
static void add_exact_product(struct exact_expansion *sum, double x, double y,
                              bool minus) {
  if (x == 0 || y == 0)
    return;
  int x_exponent, y_exponent;
  double x_part = frexp(fabs(x), &x_exponent);
  double y_part = frexp(fabs(y), &y_exponent);
  uint128 product =
      (uint128)(uint64_t)ldexp(x_part, 53) * (uint64_t)ldexp(y_part, 53);
  unsigned place = (unsigned)(x_exponent + y_exponent - 2 * 53 + LOWEST);
  unsigned shift = place % 64;
  /* Shifted by 0 to 63 the product takes up to three limbs. */
  uint64_t part[3] = {(uint64_t)product << shift, 0, 0};
  product = product >> (63 - shift) >> 1;
  part[1] = (uint64_t)product;
  part[2] = (uint64_t)(product >> 64);
  if (minus != (signbit(x) != signbit(y))) {
    uint64_t borrow = 0;
    for (size_t i = 0, to = place / 64; to < LIMB_COUNT; i++, to++) {
      uint128 less = (uint128)(i < 3 ? part[i] : 0) + borrow;
      borrow = sum->limb[to] < less;
      sum->limb[to] -= (uint64_t)less;
    }
  } else {
    uint64_t carry = 0;
    for (size_t i = 0, to = place / 64; to < LIMB_COUNT; i++, to++) {
      uint128 more = (uint128)sum->limb[to] + (i < 3 ? part[i] : 0) + carry;
      carry = (uint64_t)(more >> 64);
      sum->limb[to] = (uint64_t)more;
    }
  }
}

static int expansion_sign(const struct exact_expansion *number) {
  if (number->limb[LIMB_COUNT - 1] >> 63)
    return -1;
  for (size_t i = 0; i < LIMB_COUNT; i++)
    if (number->limb[i])
      return 1;
  return 0;
}

/* Multiplied out, ax ay cancels. */
static int turn_exactly(double ax, double ay, double bx, double by, double cx,
                        double cy) {
  struct exact_expansion sum = {{0}};
  add_exact_product(&sum, bx, cy, false);
  add_exact_product(&sum, bx, ay, true);
  add_exact_product(&sum, ax, cy, true);
  add_exact_product(&sum, by, cx, true);
  add_exact_product(&sum, by, ax, false);
  add_exact_product(&sum, ay, cx, false);
  return expansion_sign(&sum);
}

/* What is known of the sign without wide numbers. */
enum { UNKNOWN = 2 };

static inline int turn_filtered(double ax, double ay, double bx, double by,
                                double cx, double cy) {
  double left = (bx - ax) * (cy - ay);
  double right = (by - ay) * (cx - ax);
  double determinant = left - right;
  double bound = 2.5 * DBL_EPSILON * (fabs(left) + fabs(right)) + DBL_MIN;
  if (determinant > bound)
    return 1;
  if (determinant < -bound)
    return -1;
  /* Lines along an axis are common, and no rounding is in them; nor is in
   * sides that share a corner. */
  if ((bx == ax || cy == ay) && (by == ay || cx == ax))
    return 0;
  if (cx == bx && cy == by)
    return 0;
  return UNKNOWN;
}

int exact_orient2d(const double a[2], const double b[2], const double c[2]) {
  int sign = turn_filtered(a[0], a[1], b[0], b[1], c[0], c[1]);
  return sign == UNKNOWN ? turn_exactly(a[0], a[1], b[0], b[1], c[0], c[1])
                         : sign;
}

/* In space three points are on one line where they are on one line in all
 * three views along the axes; one view that is sure to say no is enough. */
bool exact_are_collinear(const struct scene_point *a,
                         const struct scene_point *b,
                         const struct scene_point *c) {
  int xy = turn_filtered(a->x, a->y, b->x, b->y, c->x, c->y);
  if (xy == 1 || xy == -1)
    return false;
  int yz = turn_filtered(a->y, a->z, b->y, b->z, c->y, c->z);
  if (yz == 1 || yz == -1)
    return false;
  int zx = turn_filtered(a->z, a->x, b->z, b->x, c->z, c->x);
  if (zx == 1 || zx == -1)
    return false;
  return (xy == 0 || turn_exactly(a->x, a->y, b->x, b->y, c->x, c->y) == 0) &&
         (yz == 0 || turn_exactly(a->y, a->z, b->y, b->z, c->y, c->z) == 0) &&
         (zx == 0 || turn_exactly(a->z, a->x, b->z, b->x, c->z, c->x) == 0);
}
