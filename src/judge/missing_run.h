/* missing_run.h - decides whether a visible line without ink is long enough to
 * be missed. */
#ifndef JUDGE_MISSING_RUN_H
#define JUDGE_MISSING_RUN_H

#include "judge/grid.h"
#include "judge/sampler.h"

/* The inputs; all pointers are borrowed, not owned. */
struct judge_missing_run {
  const struct judge_sampler *sampler;
  const struct judge_edges *edges;
  const struct judge_grid *by_image; /* of the edges' images */
  double shortest_mm;                /* above 0 */
  bool (*is_requested)(const void *user, uint32_t edge);
  bool (*has_ink)(const void *user, struct judge_point2 at);
  const void *user;
};

/* Whether the visible line through a point of an edge without ink is at least
 * shortest_mm long.  The line continues over the ends of edges as strokes do:
 * where several edges of one class and group meet, the two with the least bend
 * are joined, then the two of the others.  It ends where it is not surely
 * visible, at the page's margin, and on another edge where there is ink.
 * t  parameter of the point on the edge's image, 0 to 1 */
bool judge_is_long_run(const struct judge_missing_run *run, uint32_t edge,
                       double t);

#endif
