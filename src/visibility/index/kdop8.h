/* kdop8.h - about where in a cell of the page something is, in one word: one
 * subtraction tells of two words whether they may meet.
 *
 * A word has nine lanes of six bits and a guard bit: the extents in x, y,
 * x + y and x - y in 64ths of the cell (and of twice the cell), the least ones
 * turned round, and the nearest depth.  What meets has every lane of its word
 * at or above the lane of the other's question, so that subtracting borrows no
 * guard bit.  Extents are clamped to the cell, which keeps their order: a no
 * is certain.
 */
#ifndef VISIBILITY_INDEX_KDOP8_H
#define VISIBILITY_INDEX_KDOP8_H

#include "geom/predicate.h"

/* The cell that words are relative to. */
struct kdop8_frame {
  int32_t x0, y0;
  int shift;   /* its side is 2^shift */
  int64_t z0;  /* depths from here on ... */
  int z_shift; /* ... are told in steps of 2^z_shift */
};

enum { KDOP8_LANE = 7, KDOP8_MOST = 63 };
#define KDOP8_GUARDS UINT64_C(0x4081020408102040)

struct kdop8 {
  int64_t least[4], most[4]; /* x, y, x + y, x - y */
  int64_t low, high;         /* depths */
};

static inline void kdop8_add(struct kdop8 *kdop, struct geom_point p) {
  const int64_t at[4] = {p.x, p.y, (int64_t)p.x + p.y, (int64_t)p.x - p.y};
  for (int k = 0; k < 4; k++) {
    kdop->least[k] = at[k] < kdop->least[k] ? at[k] : kdop->least[k];
    kdop->most[k] = at[k] > kdop->most[k] ? at[k] : kdop->most[k];
  }
  kdop->low = p.z < kdop->low ? p.z : kdop->low;
  kdop->high = p.z > kdop->high ? p.z : kdop->high;
}

static inline struct kdop8 kdop8_of_point(struct geom_point p) {
  int64_t u = (int64_t)p.x + p.y, v = (int64_t)p.x - p.y;
  return (struct kdop8){{p.x, p.y, u, v}, {p.x, p.y, u, v}, p.z, p.z};
}

static inline uint64_t kdop8_lane(int64_t value, int lane) {
  int64_t clamped = value < 0 ? 0 : value > KDOP8_MOST ? KDOP8_MOST : value;
  return (uint64_t)clamped << (lane * KDOP8_LANE);
}

/* An extent from a to b in a frame's steps as the two lanes of the word
 * (`first` = b) or of the question (`first` = a). */
static inline uint64_t kdop8_lanes(int64_t first, int64_t turned, int lane) {
  return kdop8_lane(first, lane) | kdop8_lane(KDOP8_MOST - turned, lane + 1);
}

static inline int64_t kdop8_origin(const struct kdop8_frame *f, int k) {
  int64_t x = f->x0, y = f->y0;
  return k == 0   ? x
         : k == 1 ? y
         : k == 2 ? x + y
                  : x - y - (INT64_C(1) << f->shift);
}

static inline int kdop8_steps(const struct kdop8_frame *f, int k) {
  int steps = f->shift - (k < 2 ? 6 : 5);
  return steps > 0 ? steps : 0;
}

/* What something is, for others to ask. */
static inline uint64_t kdop8_key(const struct kdop8_frame *f,
                                 const struct kdop8 *o) {
  uint64_t word = kdop8_lane((o->high - f->z0) >> f->z_shift, 8);
  for (int k = 0; k < 4; k++) {
    int64_t origin = kdop8_origin(f, k);
    int steps = kdop8_steps(f, k);
    word |= kdop8_lanes((o->most[k] - origin) >> steps,
                        (o->least[k] - origin) >> steps, 2 * k);
  }
  return word;
}

/* The question whether something that is not behind all of `o` meets it. */
static inline uint64_t kdop8_query(const struct kdop8_frame *f,
                                   const struct kdop8 *o) {
  uint64_t word = kdop8_lane((o->low - f->z0) >> f->z_shift, 8);
  for (int k = 0; k < 4; k++) {
    int64_t origin = kdop8_origin(f, k);
    int steps = kdop8_steps(f, k);
    word |= kdop8_lanes((o->least[k] - origin) >> steps,
                        (o->most[k] - origin) >> steps, 2 * k);
  }
  return word;
}

/* The nearest depth of a word, in steps. */
static inline int kdop8_nearest(uint64_t word) {
  return (int)(word >> (8 * KDOP8_LANE)) & KDOP8_MOST;
}

static inline bool kdop8_overlaps(uint64_t word, uint64_t question) {
  return (((word | KDOP8_GUARDS) - question) & KDOP8_GUARDS) == KDOP8_GUARDS;
}

#endif
