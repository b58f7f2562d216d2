/* grid.h - segments on the page, found by place. */
#ifndef JUDGE_GRID_H
#define JUDGE_GRID_H

#include "judge/point.h"

struct judge_segment {
  struct judge_point2 a, b;
};

struct judge_grid {
  const struct judge_segment *segment; /* lent */
  double cell_mm, reach_mm;
  uint32_t columns, rows;
  uint32_t *start, *item; /* cell -> numbers of segments */
};

/* Sorts segments into the cells of a page that are within reach of them.
 * cell_mm  the side of a cell, no less than the reach: else each segment were
 *          in all the cells of a wide neighbourhood
 * What lies beyond the page is left out.
 * Returns false when memory ran out. */
USE_RESULT bool judge_grid_init(struct judge_grid *grid,
                                const struct judge_segment *segment,
                                uint32_t count, double width_mm,
                                double height_mm, double cell_mm,
                                double reach_mm);
void judge_grid_fini(struct judge_grid *grid);

/* The segments that may be within reach of a place; *count of them. */
const uint32_t *judge_grid_near(const struct judge_grid *grid,
                                struct judge_point2 at, uint32_t *count);

/* The distance from a place to a segment; where along it, 0 to 1, in *t. */
double judge_distance(const struct judge_segment *segment,
                      struct judge_point2 at, double *t);

/* Whether that distance is at most `reach`. */
bool judge_is_within(const struct judge_segment *segment,
                     struct judge_point2 at, double reach);

#endif
