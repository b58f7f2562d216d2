/* point_lanes.h - a point of the page grid as the four lanes of a vector: x, y
 * and the halves of its depth.  Bounds of several points are so found all at
 * once: of the depths, those of their upper halves, which the order of the
 * depths agrees with. */
#ifndef VISIBILITY_PREDICATE_POINT_LANES_H
#define VISIBILITY_PREDICATE_POINT_LANES_H

#include <string.h>

#include "geom/predicate.h"

typedef int32_t point_lanes __attribute__((vector_size(16)));

/* The lane of the depth's upper half, which has its bits from this one on. */
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
enum { POINT_LANE_DEPTH = 2, POINT_LANE_DEPTH_BIT = 32 };
#else
enum { POINT_LANE_DEPTH = 3, POINT_LANE_DEPTH_BIT = 32 };
#endif

static inline point_lanes point_lanes_of(const struct geom_point *p) {
  point_lanes lanes;
  _Static_assert(sizeof lanes == sizeof *p, "a lane for each 32 bits");
  memcpy(&lanes, p, sizeof lanes);
  return lanes;
}

static inline point_lanes point_lanes_min(point_lanes a, point_lanes b) {
  point_lanes less = a < b;
  return (a & less) | (b & ~less);
}

static inline point_lanes point_lanes_max(point_lanes a, point_lanes b) {
  point_lanes more = a > b;
  return (a & more) | (b & ~more);
}

#endif
