/* ratio.c - comparing and applying exact rational parameters.
 *
 * Bit widths: num and den stay below 2^126 (occlusion.h derives the widest,
 * 2^125), so a cross product needs 252 bits: four 64-bit limbs.
 */
#include "geom/ratio.h"

#include "geom/wide.h"

/* An unsigned 256-bit product, most significant half first. */
struct product {
  uint128 high, low;
};

static struct product multiply_128(uint128 a, uint128 b) {
  uint64_t a0 = (uint64_t)a, a1 = (uint64_t)(a >> 64);
  uint64_t b0 = (uint64_t)b, b1 = (uint64_t)(b >> 64);
  uint128 p00 = (uint128)a0 * b0, p01 = (uint128)a0 * b1;
  uint128 p10 = (uint128)a1 * b0, p11 = (uint128)a1 * b1;
  uint128 middle = (p00 >> 64) + (uint64_t)p01 + (uint64_t)p10;
  struct product p;
  p.low = (middle << 64) | (uint64_t)p00;
  p.high = p11 + (p01 >> 64) + (p10 >> 64) + (middle >> 64);
  return p;
}

static int compare_products(struct product a, struct product b) {
  if (a.high != b.high)
    return a.high < b.high ? -1 : 1;
  if (a.low != b.low)
    return a.low < b.low ? -1 : 1;
  return 0;
}

static uint128 magnitude(int128 a) { return a < 0 ? -(uint128)a : (uint128)a; }

static int sign_of(int128 a) { return (a > 0) - (a < 0); }

int ratio_compare_wide(struct ratio a, struct ratio b) {
  int sa = sign_of(a.num), sb = sign_of(b.num), order;
  if (sa != sb)
    return sa < sb ? -1 : 1;
  if (sa == 0)
    return 0;
  order = compare_products(multiply_128(magnitude(a.num), (uint128)b.den),
                           multiply_128(magnitude(b.num), (uint128)a.den));
  return sa > 0 ? order : -order;
}

double ratio_to_double(struct ratio a) {
  return ratio_is_narrow(a) ? (double)(int64_t)a.num / (double)(int64_t)a.den
                            : (double)a.num / (double)a.den;
}

/* floor(num d / den + 1/2), the product of 169 bits. */
static int64_t round_wide(struct ratio t, int64_t d) {
  struct wide num = wide_of_int128(t.num), den = wide_of_int128(t.den);
  struct wide by = wide_of_int128(d), product;
  wide_multiply(&product, &num, &by);
  return wide_round_quotient(&product, &den, 0);
}

/* Doubles decide unless the sum is so near a whole number.  With u = 2^-53, the
 * product is off by at most 5u times 2^43, and its sum with 1/2 by u more. */
#define LERP_NEAR 0x1p-6

int64_t ratio_lerp(struct ratio t, int64_t p0, int64_t p1) {
  int64_t d = p1 - p0; /* at most 2^43 */
  double sum = ratio_to_double(t) * (double)d + 0.5;
  int64_t whole = (int64_t)sum - (sum < 0);
  double rest = sum - (double)whole; /* exact; below 0, 1 for a whole sum */
  if (rest > LERP_NEAR && rest < 1 - LERP_NEAR)
    return p0 + whole;
  const int128 narrow = (int128)1 << 81;
  if (-narrow < t.num && t.num < narrow && t.den < narrow) {
    int128 num = 2 * t.num * d + t.den, den = 2 * t.den;
    int128 q = num / den;
    if (num % den < 0)
      q--;
    return p0 + (int64_t)q;
  }
  return p0 + round_wide(t, d);
}
