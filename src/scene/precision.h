/* precision.h - how far rounding may have moved the coordinates of a scene,
 * known for each file that was read. */
#ifndef SCENE_PRECISION_H
#define SCENE_PRECISION_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* Rounding moved a coordinate x by at most max(absolute, relative * |x|).
 * {0, 0}  the coordinates are exact */
struct precision {
  double absolute; /* scene units */
  double relative;
};

/* Half a unit in the last place of a number of single or double precision, at
 * worst, as a share of the number. */
#define PRECISION_SINGLE 0x1p-24
#define PRECISION_DOUBLE 0x1p-53

static inline double precision_error(struct precision precision, double x) {
  double share = precision.relative * fabs(x);
  return share > precision.absolute ? share : precision.absolute;
}

/* The precision of numbers with so many significant bits, 1 to 53; 0: 24.
 * 53 bits count as exact: what doubles round is no matter of the input. */
struct precision precision_of_bits(int bits);

/* ---- The ranges of a scene ----------------------------------------------- */

/* The points from `first_point` to the next range, or to the end. */
struct precision_range {
  uint32_t first_point;
  bool stated; /* false: unknown, so the options decide */
  struct precision precision;
};

/* ---- The precision of a text --------------------------------------------- */

enum {
  PRECISION_DIGITS = 24,        /* significant digits are counted up to this */
  PRECISION_PLACE_LEAST = -400, /* decimal places: 10^least to 10^(least + */
  PRECISION_PLACES = 800        /* count - 1) */
};

/* What the literals looked like of those points of a file that were looked at.
 * Zero-initialised, nothing was looked at yet. */
struct precision_sample {
  size_t next;        /* point of the file to look at next */
  uint64_t weight;    /* how many points this one represents */
  uint64_t decimals;  /* literals with a point or an exponent, not zero */
  uint64_t long_ones; /* of these, with five digits or more */
  bool not_single;    /* one is far from any single-precision number */
  uint64_t digits[PRECISION_DIGITS + 1]; /* long ones by significant digits */
  uint64_t place[PRECISION_PLACES];      /* long ones by their last place */
};

/* The point of the file that is looked at after point `number`, counted from 0:
 * all of the first 64, and fewer and fewer after them, each of which represents
 * those up to the next, so that looking costs a hundredth of the reading: 470
 * points of 35,000, and 690 of a million. */
static inline size_t precision_sampled_after(size_t number) {
  enum { EACH_OF_FIRST = 64 };
  return number + 1 + number / EACH_OF_FIRST;
}

/* Whether point `number` should be looked at. */
static inline bool precision_is_sampled(struct precision_sample *sample,
                                        size_t number) {
  if (number < sample->next)
    return false;
  sample->next = precision_sampled_after(number);
  sample->weight = sample->next - number;
  return true;
}

/* Looks at one literal.
 * text   [+-]digits[.digits][e[+-]digits], up to `end`
 * value  the double nearest to it */
void precision_add_literal(struct precision_sample *sample, const char *text,
                           const char *end, double value);

/* What the literals say about the file's precision; see precision.c. */
struct precision precision_estimate(const struct precision_sample *sample);

#endif
