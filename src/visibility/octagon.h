/* octagon.h - about where in a cell of the page something is, in one word: one
 * subtraction tells of two words whether they may meet.
 *
 * A word has nine lanes of six bits and a guard bit: the extents in x, y,
 * x + y and x - y in 64ths of the cell (and of twice the cell), the least ones
 * turned round, and the nearest depth.  What meets has every lane of its word
 * at or above the lane of the other's question, so that subtracting borrows no
 * guard bit.  Extents are clamped to the cell, which keeps their order: a no
 * is certain.
 */
#ifndef VISIBILITY_OCTAGON_H
#define VISIBILITY_OCTAGON_H

#include "geom/predicate.h"

/* The cell that words are relative to. */
struct octagon_frame {
  int32_t x0, y0;
  int shift;   /* its side is 2^shift */
  int64_t z0;  /* depths from here on ... */
  int z_shift; /* ... are told in steps of 2^z_shift */
};

enum { OCTAGON_LANE = 7, OCTAGON_MOST = 63 };
#define OCTAGON_GUARDS UINT64_C(0x4081020408102040)

struct octagon {
  int64_t least[4], most[4]; /* x, y, x + y, x - y */
  int64_t low, high;         /* depths */
};

static inline void octagon_add(struct octagon *octagon, struct geom_point p) {
  const int64_t at[4] = {p.x, p.y, (int64_t)p.x + p.y, (int64_t)p.x - p.y};
  for (int k = 0; k < 4; k++) {
    octagon->least[k] = at[k] < octagon->least[k] ? at[k] : octagon->least[k];
    octagon->most[k] = at[k] > octagon->most[k] ? at[k] : octagon->most[k];
  }
  octagon->low = p.z < octagon->low ? p.z : octagon->low;
  octagon->high = p.z > octagon->high ? p.z : octagon->high;
}

static inline struct octagon octagon_of_point(struct geom_point p) {
  int64_t u = (int64_t)p.x + p.y, v = (int64_t)p.x - p.y;
  return (struct octagon){{p.x, p.y, u, v}, {p.x, p.y, u, v}, p.z, p.z};
}

static inline uint64_t octagon_lane(int64_t value, int lane) {
  int64_t clamped = value < 0 ? 0 : value > OCTAGON_MOST ? OCTAGON_MOST : value;
  return (uint64_t)clamped << (lane * OCTAGON_LANE);
}

/* An extent from a to b in a frame's steps as the two lanes of the word
 * (`first` = b) or of the question (`first` = a). */
static inline uint64_t octagon_lanes(int64_t first, int64_t turned, int lane) {
  return octagon_lane(first, lane) |
         octagon_lane(OCTAGON_MOST - turned, lane + 1);
}

static inline int64_t octagon_origin(const struct octagon_frame *f, int k) {
  int64_t x = f->x0, y = f->y0;
  return k == 0   ? x
         : k == 1 ? y
         : k == 2 ? x + y
                  : x - y - (INT64_C(1) << f->shift);
}

static inline int octagon_steps(const struct octagon_frame *f, int k) {
  int steps = f->shift - (k < 2 ? 6 : 5);
  return steps > 0 ? steps : 0;
}

/* What something is, for others to ask. */
static inline uint64_t octagon_word(const struct octagon_frame *f,
                                    const struct octagon *o) {
  uint64_t word = octagon_lane((o->high - f->z0) >> f->z_shift, 8);
  for (int k = 0; k < 4; k++) {
    int64_t origin = octagon_origin(f, k);
    int steps = octagon_steps(f, k);
    word |= octagon_lanes((o->most[k] - origin) >> steps,
                          (o->least[k] - origin) >> steps, 2 * k);
  }
  return word;
}

/* The question whether something that is not behind all of `o` meets it. */
static inline uint64_t octagon_question(const struct octagon_frame *f,
                                        const struct octagon *o) {
  uint64_t word = octagon_lane((o->low - f->z0) >> f->z_shift, 8);
  for (int k = 0; k < 4; k++) {
    int64_t origin = octagon_origin(f, k);
    int steps = octagon_steps(f, k);
    word |= octagon_lanes((o->least[k] - origin) >> steps,
                          (o->most[k] - origin) >> steps, 2 * k);
  }
  return word;
}

/* The nearest depth of a word, in steps. */
static inline int octagon_nearest(uint64_t word) {
  return (int)(word >> (8 * OCTAGON_LANE)) & OCTAGON_MOST;
}

static inline bool octagon_meets(uint64_t word, uint64_t question) {
  return (((word | OCTAGON_GUARDS) - question) & OCTAGON_GUARDS) ==
         OCTAGON_GUARDS;
}

#endif
