/* vector.h - vectors of three doubles; sums are evaluated in one fixed order.
 */
#ifndef GEOM_VECTOR_H
#define GEOM_VECTOR_H

#include <math.h>
#include <stdbool.h>

/* Like fmin and fmax, but inline: a NaN value does not change the bound. */
static inline double min_number(double bound, double value) {
  return value < bound ? value : bound;
}
static inline double max_number(double bound, double value) {
  return value > bound ? value : bound;
}

/* Orders points of a plane by x, then by y. */
static inline bool vector2_is_before(const double a[2], const double b[2]) {
  return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* The length of a vector of the page, grid units: its squares neither overflow
 * nor underflow to matter, so that it takes a fraction of the time of hypot. */
static inline double vector2_length(double x, double y) {
  return sqrt(x * x + y * y);
}

static inline double vector_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vector_cross(const double a[3], const double b[3],
                                double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline bool vector_is_finite(const double a[3]) {
  return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

/* Whether a square of a length is neither so small nor so large that scaling
 * the vector by a power of two would change a digit of it. */
static inline bool vector_is_ordinary(double square) {
  return square > 0x1p-800 && square < 0x1p800;
}

/* The length, computed without overflow or underflow: where squares might,
 * coordinates are first divided by a power of two close to the largest.  For a
 * vector along an axis the result is exact. */
static inline double vector_length(const double a[3]) {
  double square = vector_dot(a, a);
  if (vector_is_ordinary(square))
    return sqrt(square);
  double largest = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
  if (largest == 0 || !isfinite(largest))
    return largest;
  int exponent;
  frexp(largest, &exponent);
  double b[3];
  for (int k = 0; k < 3; k++)
    b[k] = ldexp(a[k], -exponent);
  return ldexp(sqrt(vector_dot(b, b)), exponent);
}

/* Normalises a vector of any length, with no -0; false where its length is 0 or
 * not finite. */
static inline bool vector_normalise(double a[3]) {
  double square = vector_dot(a, a);
  if (vector_is_ordinary(square)) {
    double length = sqrt(square);
    for (int k = 0; k < 3; k++)
      a[k] = a[k] / length + 0.0;
    return true;
  }
  double largest = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
  if (largest == 0 || !vector_is_finite(a))
    return false;
  int exponent;
  frexp(largest, &exponent);
  for (int k = 0; k < 3; k++)
    a[k] = ldexp(a[k], -exponent);
  double length = sqrt(vector_dot(a, a));
  for (int k = 0; k < 3; k++)
    a[k] = a[k] / length + 0.0;
  return true;
}

#endif
