/* segment_grid.h - segments of the page, listed by the cells of a uniform grid
 * that they may meet. */
#ifndef VISIBILITY_CONTOUR_SEGMENT_GRID_H
#define VISIBILITY_CONTOUR_SEGMENT_GRID_H

#include "geom/vector.h"
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

/* Sorts the segments, of contours alone, from far to near by their nearest
 * ends, so that lists of cells go from near to far.  Returns false when memory
 * ran out. */
USE_RESULT bool segment_grid_sort(struct segment_grid *grid);

/* Makes cells in the box of the contours, about as many as segments, and lists
 * the segments.  Where cell.shift is given, sides of cells are longer than
 * 2^cell.shift grid units.  Returns false when memory ran out. */
USE_RESULT bool segment_grid_make(struct segment_grid *grid);
void segment_grid_fini(struct segment_grid *grid);

typedef bool meet_segments(void *user, const struct page_segment *contour,
                           const struct page_segment *other);

/* Calls `meet` for each contour and each other segment in each cell that both
 * may meet: for the same two more than once where they have several.  Returns
 * false when the caller cancelled, or `meet` returned it. */
USE_RESULT bool segment_grid_meet(const struct segment_grid *grid,
                                  meet_segments *meet, void *user);

/* The segments of all cells that a box may meet, cell by cell from the lower
 * left, as their lists have them: one that may meet several of them comes up as
 * often. */
struct segment_walk {
  const struct segment_grid *grid;
  struct cell_range range;
  int x, y;         /* the next cell */
  uint32_t at, end; /* what is left of the list of this one */
};

/* Begins before the first of the segments of the cells about a place of the
 * page.  There may be none. */
static inline struct segment_walk
segment_grid_near(const struct segment_grid *grid, double x, double y,
                  double reach) {
  struct segment_walk walk = {.grid = grid, .y = 1};
  const double most = SHEET_XY_MAX;
  if (grid->contours == 0)
    return walk; /* there are no cells */
  reach += 1;    /* as conversions leave out what is less than a unit */
  walk.range = triangle_grid_cells(
      &grid->cell, (struct box2){(int32_t)max_number(x - reach, -most),
                                 (int32_t)max_number(y - reach, -most),
                                 (int32_t)min_number(x + reach, most),
                                 (int32_t)min_number(y + reach, most)});
  walk.x = walk.range.x0;
  walk.y = walk.range.y0;
  return walk;
}

/* The next segment; NULL: there is no more. */
static inline const struct page_segment *
segment_walk_next(struct segment_walk *walk) {
  const struct triangle_grid *cell = &walk->grid->cell;
  while (walk->at == walk->end) {
    if (walk->y > walk->range.y1)
      return NULL;
    size_t i = triangle_grid_index(cell, walk->x, walk->y);
    walk->at = cell->lists.start[i];
    walk->end = cell->lists.start[i + 1];
    if (walk->x++ < walk->range.x1)
      continue;
    walk->x = walk->range.x0;
    walk->y++;
  }
  return &walk->grid->segment.item[cell->lists.item[walk->at++]];
}

/* Goes on with the next cell. */
static inline void segment_walk_leave_cell(struct segment_walk *walk) {
  walk->at = walk->end;
}

/* Whether two segments cross, and at which parameters of each; exactly, but for
 * where.  A point on a line counts as left of it, and segments that share an
 * end do not cross. */
bool page_segments_cross(const struct page_segment *a,
                         const struct page_segment *b, double *s, double *t);

/* The depth of its nearer end. */
static inline int64_t page_segment_nearest(const struct page_segment *s) {
  return s->p.z > s->q.z ? s->p.z : s->q.z;
}

static inline double page_segment_depth(const struct page_segment *s,
                                        double t) {
  return (double)s->p.z + t * (double)(s->q.z - s->p.z);
}

/* Whether a segment's box is farther from a place than within reach. */
static inline bool page_segment_is_off(const struct page_segment *s, double x,
                                       double y, double reach) {
  struct box2 box = box2_of_segment(s->p, s->q);
  /* Distances are computed to far less than a unit. */
  reach += 1;
  return box.x0 > x + reach || box.x1 < x - reach || box.y0 > y + reach ||
         box.y1 < y - reach;
}

/* Whether the line along (x, y) is farther than within reach from a place,
 * which is at (px, py) from where it begins. */
static inline bool page_line_is_off(double x, double y, double px, double py,
                                    double reach) {
  double area = x * py - y * px;
  reach += 1; /* as above */
  return area * area > reach * reach * (x * x + y * y);
}

#endif
