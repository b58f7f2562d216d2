/* page_cover.h - whether a triangle lies over a point of the page, for points
 * that follow each other. */
#ifndef VISIBILITY_CONTOUR_PAGE_COVER_H
#define VISIBILITY_CONTOUR_PAGE_COVER_H

#include "visibility/index/triangle_grid.h"

struct page_cover {
  const struct sheet *sheet;         /* borrowed, not owned */
  const struct triangle_grid *grid;  /* of its triangles; the same */
  struct triangle_grid_query *query; /* the same */
  uint32_t last; /* a triangle that lay over the last such point; SHEET_NONE */
};

/* Whether a triangle that is not edge-on lies over a point; its sides count.
 * Those at the last such point, and beside it, are tried first.
 * *ok  gets false when memory ran out */
bool page_cover_is_over(struct page_cover *cover, struct geom_point p,
                        bool *ok);

/* How far from p to q, as a share, the last triangle surely lies over all
 * points that are no more than a grid unit from the segment.
 * p  a point that it lies over */
double page_cover_reach(const struct page_cover *cover, struct geom_point p,
                        struct geom_point q);

#endif
