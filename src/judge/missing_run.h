/* missing_run.h - how long a visible line is that has no ink. */
#ifndef JUDGE_MISSING_RUN_H
#define JUDGE_MISSING_RUN_H

#include "judge/sampler.h"
#include "judge/grid.h"

/* What a run is measured by; all but the length is lent. */
struct judge_missing_run {
  const struct judge_sampler *sampler;
  const struct judge_edges *edges;
  const struct judge_grid *by_image; /* of the edges' images */
  double shortest_mm;                /* above 0 */
  bool (*is_asked_for)(const void *user, uint32_t edge);
  bool (*has_ink)(const void *user, struct judge_point2 at);
  const void *user;
};

/* Whether the visible line through a point of an edge that lacks its ink is at
 * least shortest_mm long.  The line goes on over the ends of edges as strokes
 * do: where several edges of one class and group meet, the straightest two are
 * one line, then the straightest two of the others.  It ends where it is not
 * surely visible, at the page's margin, and on another edge where there is
 * ink.
 * t  where on the edge's image, 0 to 1 */
bool judge_is_long_run(const struct judge_missing_run *run, uint32_t edge,
                       double t);

#endif
