/* kdop8.h - 8-DOPs relative to a grid cell, quantised to one 64-bit key; one
 * subtraction tests whether two of them may overlap.
 *
 * An 8-DOP bounds a set of points by its extents in x, y, x + y and x - y; here
 * its nearest depth is added.  A key has nine lanes, each of six bits and a
 * guard bit:
 *     lanes 0, 2, 4, 6   the upper ends of the extents, in 64ths of the cell
 *                        (of twice the cell for x + y and x - y)
 *     lanes 1, 3, 5, 7   63 less the lower ends
 *     lane 8             the nearest depth
 * A query has the opposite ends and the farthest depth in the same lanes.  Two
 * 8-DOPs overlap, and the key's is not behind all of the query's, where every
 * lane of the key is at least that of the query, so that subtracting them
 * borrows from no guard bit.  Extents are clamped to the cell, which keeps
 * their order, and rounded down in both: an answer "no" is certain.
 *
 * Source  [Klosowski1998] for k-DOPs.
 */
#ifndef VISIBILITY_INDEX_KDOP8_H
#define VISIBILITY_INDEX_KDOP8_H

#include "visibility/predicate/point_lanes.h"

/* The cell and the depth range to which keys are relative. */
struct kdop8_range {
  int32_t x0, y0;
  int shift;   /* the cell's side is 2^shift */
  int64_t z0;  /* the least depth */
  int z_shift; /* depths are quantised to steps of 2^z_shift */
  /* Coordinates differ from x0 and y0 by so little, and a step of x + y is so
   * large, that the four extents are found at once, in lanes of 32 bits. */
  bool fits_lanes;
};

/* Whether it does for a cell of that side, where coordinates differ from its
 * corner by less than `extent`; a few more are allowed for rounding. */
static inline bool kdop8_fits_lanes(int shift, int64_t extent) {
  return shift > 6 && extent <= INT64_C(1) << 29;
}

enum {
  KDOP8_LANE = 7, /* bits of a lane, guard bit included */
  KDOP8_MAX = 63  /* greatest value of a lane */
};
/* Unrolls the loop that follows: where the extent is known, half of the work
 * falls away. */
#define KDOP8_UNROLL _Pragma("GCC unroll 4")

/* The guard bits of all lanes. */
#define KDOP8_GUARDS UINT64_C(0x4081020408102040)

/* An 8-DOP with its range of depths, not quantised. */
struct kdop8 {
  int64_t least[4], most[4]; /* x, y, x + y, x - y */
  int64_t low, high;         /* depths: farthest, nearest */
};

/* Extends the 8-DOP to a point. */
static inline void kdop8_add(struct kdop8 *kdop, struct geom_point p) {
  const int64_t at[4] = {p.x, p.y, (int64_t)p.x + p.y, (int64_t)p.x - p.y};
  KDOP8_UNROLL
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
  int64_t clamped = value < 0 ? 0 : value > KDOP8_MAX ? KDOP8_MAX : value;
  return (uint64_t)clamped << (lane * KDOP8_LANE);
}

/* An extent from a to b, in the range's steps, as two lanes: of a key for
 * (b, a), of a query for (a, b). */
static inline uint64_t kdop8_lanes(int64_t first, int64_t complemented,
                                   int lane) {
  return kdop8_lane(first, lane) |
         kdop8_lane(KDOP8_MAX - complemented, lane + 1);
}

/* The least value of extent k in the cell. */
static inline int64_t kdop8_origin(const struct kdop8_range *f, int k) {
  int64_t x = f->x0, y = f->y0;
  return k == 0   ? x
         : k == 1 ? y
         : k == 2 ? x + y
                  : x - y - (INT64_C(1) << f->shift);
}

/* Binary logarithm of the step of extent k. */
static inline int kdop8_steps(const struct kdop8_range *f, int k) {
  int steps = f->shift - (k < 2 ? 6 : 5);
  return steps > 0 ? steps : 0;
}

/* The four extents of a point less their least values in the cell, x and y
 * doubled so that all have the same steps; in lanes. */
static inline point_lanes kdop8_extents(const struct kdop8_range *f, int32_t x,
                                        int32_t y) {
  x -= f->x0;
  y -= f->y0;
  return (point_lanes){2 * x, 2 * y, x + y, x - y + (1 << f->shift)};
}

/* What kdop8_lanes makes of all extents, from such lanes. */
static inline uint64_t kdop8_all_lanes(const struct kdop8_range *f,
                                       point_lanes first,
                                       point_lanes complemented) {
  const point_lanes most = {KDOP8_MAX, KDOP8_MAX, KDOP8_MAX, KDOP8_MAX},
                    none = {0, 0, 0, 0};
  first = point_lanes_max(point_lanes_min(first >> (f->shift - 5), most), none);
  complemented = point_lanes_max(
      point_lanes_min(complemented >> (f->shift - 5), most), none);
  point_lanes both = first | (most - complemented) << KDOP8_LANE;
  return (uint64_t)both[0] | (uint64_t)both[1] << 2 * KDOP8_LANE |
         (uint64_t)both[2] << 4 * KDOP8_LANE |
         (uint64_t)both[3] << 6 * KDOP8_LANE;
}

/* The key of a triangle, as kdop8_key has it, where all fits into lanes. */
static inline uint64_t kdop8_key_of_triangle(const struct kdop8_range *f,
                                             const struct geom_point *a,
                                             const struct geom_point *b,
                                             const struct geom_point *c) {
  point_lanes p = kdop8_extents(f, a->x, a->y),
              q = kdop8_extents(f, b->x, b->y),
              r = kdop8_extents(f, c->x, c->y);
  int64_t high = a->z > b->z ? a->z : b->z;
  high = c->z > high ? c->z : high;
  return kdop8_lane((high - f->z0) >> f->z_shift, 8) |
         kdop8_all_lanes(f, point_lanes_max(point_lanes_max(p, q), r),
                         point_lanes_min(point_lanes_min(p, q), r));
}

/* The ends of an 8-DOP's extents, as kdop8_extents has those of a point. */
static inline point_lanes kdop8_extents_of_ends(const struct kdop8_range *f,
                                                const int64_t end[4]) {
  int64_t x = f->x0, y = f->y0;
  return (point_lanes){(int32_t)(2 * (end[0] - x)), (int32_t)(2 * (end[1] - y)),
                       (int32_t)(end[2] - x - y),
                       (int32_t)(end[3] - x + y + (1 << f->shift))};
}

/* The key of an 8-DOP that is stored in an index. */
static inline uint64_t kdop8_key(const struct kdop8_range *f,
                                 const struct kdop8 *o) {
  uint64_t key = kdop8_lane((o->high - f->z0) >> f->z_shift, 8);
  KDOP8_UNROLL
  for (int k = 0; k < 4; k++) {
    int64_t origin = kdop8_origin(f, k);
    int steps = kdop8_steps(f, k);
    key |= kdop8_lanes((o->most[k] - origin) >> steps,
                       (o->least[k] - origin) >> steps, 2 * k);
  }
  return key;
}

/* The query for the keys that may overlap an 8-DOP and are not behind all of
 * it. */
static inline uint64_t kdop8_query(const struct kdop8_range *f,
                                   const struct kdop8 *o) {
  uint64_t query = kdop8_lane((o->low - f->z0) >> f->z_shift, 8);
  if (f->fits_lanes)
    return query | kdop8_all_lanes(f, kdop8_extents_of_ends(f, o->least),
                                   kdop8_extents_of_ends(f, o->most));
  KDOP8_UNROLL
  for (int k = 0; k < 4; k++) {
    int64_t origin = kdop8_origin(f, k);
    int steps = kdop8_steps(f, k);
    query |= kdop8_lanes((o->least[k] - origin) >> steps,
                         (o->most[k] - origin) >> steps, 2 * k);
  }
  return query;
}

/* The nearest depth of a key, in steps of the range. */
static inline int kdop8_nearest(uint64_t key) {
  return (int)(key >> (8 * KDOP8_LANE)) & KDOP8_MAX;
}

/* The guard bits of the lanes in which a key is at least a query.  A key has
 * none, and in a sum of guards and query loops over keys add those once. */
static inline uint64_t kdop8_compare(uint64_t key, uint64_t query) {
  return (key + KDOP8_GUARDS - query) & KDOP8_GUARDS;
}

/* Is the 8-DOP of a key that was so compared behind all of the query's? */
static inline bool kdop8_is_behind(uint64_t lanes) {
  return lanes < UINT64_C(1) << (9 * KDOP8_LANE - 1);
}

/* What kdop8_compare gives of a key that is so and may overlap the query's
 * 8-DOP on the page. */
#define KDOP8_BEHIND (KDOP8_GUARDS ^ UINT64_C(1) << (9 * KDOP8_LANE - 1))

/* May the 8-DOP of a key overlap that of a query?  False is certain. */
static inline bool kdop8_overlaps(uint64_t key, uint64_t query) {
  return kdop8_compare(key, query) == KDOP8_GUARDS;
}

#endif
