/* segment_grid.h - segments of the page, listed by the cells of a uniform grid
 * that they may meet. */
#ifndef VISIBILITY_CONTOUR_SEGMENT_GRID_H
#define VISIBILITY_CONTOUR_SEGMENT_GRID_H

#include "visibility/index/triangle_grid.h"

struct page_segment {
  struct geom_point p, q;
  uint32_t owner; /* the caller's number; SHEET_NONE: a border */
};

struct segment_grid {
  ARRAY(struct page_segment) segment; /* those of contours first */
  size_t contours;                    /* so many are */
  struct triangle_grid cell;          /* its shape, and lists of segments, which
                                         descend */
};

/* Adds a segment, unless it is a point on the page.  Returns false when memory
 * ran out. */
USE_RESULT bool segment_grid_add(struct segment_grid *grid,
                                 struct geom_segment segment, uint32_t owner);

/* Makes cells in the box of the contours, about as many as segments, and lists
 * the segments.  Returns false when memory ran out. */
USE_RESULT bool segment_grid_make(struct segment_grid *grid);
void segment_grid_fini(struct segment_grid *grid);

typedef bool meet_segments(void *user, const struct page_segment *contour,
                           const struct page_segment *other);

/* Calls `meet` for each contour and each other segment in each cell that both
 * may meet: for the same two more than once where they have several.  Returns
 * false when the caller cancelled, or `meet` returned it. */
USE_RESULT bool segment_grid_meet(const struct segment_grid *grid,
                                  meet_segments *meet, void *user);

/* Whether two segments cross, and at which parameters of each; exactly, but for
 * where.  A point on a line counts as left of it, and segments that share an
 * end do not cross. */
bool page_segments_cross(const struct page_segment *a,
                         const struct page_segment *b, double *s, double *t);

static inline double page_segment_depth(const struct page_segment *s,
                                        double t) {
  return (double)s->p.z + t * (double)(s->q.z - s->p.z);
}

#endif
