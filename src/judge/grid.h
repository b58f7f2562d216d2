/* grid.h - a uniform grid over segments of the page, for queries by position.
 */
#ifndef JUDGE_GRID_H
#define JUDGE_GRID_H

#include <math.h>

#include "judge/point.h"

struct judge_segment {
  struct judge_point2 a, b;
};

static inline double judge_segment_mm(const struct judge_segment *s) {
  return hypot(s->b.x - s->a.x, s->b.y - s->a.y);
}

struct judge_grid {
  const struct judge_segment *segment; /* borrowed, not owned */
  double cell_mm, radius_mm;
  uint32_t columns, rows;
  uint32_t *start, *item; /* the segments of cell c are item[start[c]] to
                             item[start[c + 1] - 1] */
};

/* Enters segments into all cells of a page that are within the radius of them.
 * cell_mm  the side of a cell; raised to the radius where it is less, so that a
 *          segment is in few cells beside it
 * What is outside the page is ignored.
 * Returns false when memory ran out. */
USE_RESULT bool judge_grid_init(struct judge_grid *grid,
                                const struct judge_segment *segment,
                                uint32_t count, double width_mm,
                                double height_mm, double cell_mm,
                                double radius_mm);
void judge_grid_fini(struct judge_grid *grid);

/* The segments that may be within the radius of a point; *count of them. */
const uint32_t *judge_grid_near(const struct judge_grid *grid,
                                struct judge_point2 at, uint32_t *count);

/* The distance from a point to a segment.
 * t  set to the parameter of the segment's nearest point, 0 to 1 */
double judge_distance(const struct judge_segment *segment,
                      struct judge_point2 at, double *t);

/* Whether that distance is at most `radius`. */
bool judge_is_within(const struct judge_segment *segment,
                     struct judge_point2 at, double radius);

#endif
