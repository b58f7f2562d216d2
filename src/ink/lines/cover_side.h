/* cover_side.h - the sides of lines that may cover hairs. */
#ifndef INK_LINES_COVER_SIDE_H
#define INK_LINES_COVER_SIDE_H

#include "ink/lines/segment_graph.h"

/* A side of a path, which may cover a hair. */
struct cover_side {
  struct ink_point a, b;
  uint32_t rank, layer; /* of its path */
  float weight;
  bool is_hair;
};

/* A side in a cell. */
struct cover_listed {
  uint32_t cell, side;
};

/* What a range of paths lists, the shortest path's first. */
struct cover_lists {
  ARRAY(struct cover_side) side;
  ARRAY(struct cover_listed) listed; /* sides of this range */
  uint32_t before;                   /* sides of the ranges before */
};

/* Is the side within `near` of both ends of a piece of a hair, from at[0],
 * at[1] to at[2], at[3]? */
bool cover_side_is_near(const struct cover_side *side, const double at[4],
                        double near);

#endif
