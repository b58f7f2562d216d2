/* span_fill.c - depth-tested drawing of whole triangles into a pixel frame.
 *
 * Error bound.  A depth is computed from the plane's at frame (0, 0) by the
 * slopes per line and column; each product and sum is rounded to u of at most
 * FACET_DEPTH_CHANGE_MAX and the range of depths.  With the relative error
 * 4 u of the slopes that is less than the 20 u G that raster.c allows for. */
#include "visibility/raster/span_fill.h"

#include <math.h>

/* Sets the plane of a triangle of the sheet that is not edge-on. */
static void init_plane(struct span_fill_plane *plane,
                       const struct raster *raster, uint32_t triangle) {
  const struct scan_grid *grid = &raster->grid;
  uint32_t point = raster->sheet->triangle.item[triangle].point[0];
  const struct scan_point corner = raster_point(raster, point);
  double y =
      (double)(corner.y * grid->den - grid->y_first) / (double)grid->y_step;
  facet_slopes(raster->sheet, grid, triangle, &plane->per_column,
               &plane->per_line);
  plane->z = (double)raster->sheet->point.item[point].z -
             plane->per_column * corner.column - plane->per_line * y;
  plane->steep =
      facet_is_steep(&raster->grid, plane->per_column, plane->per_line);
}

bool span_fill_is_nearer(const struct raster *raster, uint32_t facet,
                         uint32_t there, int32_t column, int32_t line) {
  int order;
  if (there == SHEET_NONE)
    return true;
  order = raster_compare(raster, facet, there, column, line);
  return order > 0 || (order == 0 && facet < there);
}

void span_fill_compare_exactly(struct raster *raster, uint32_t facet,
                               int32_t line, int32_t first, int32_t past,
                               double z, double per_column) {
  size_t row = raster_row(raster, line);
  for (int32_t c = first; c < past; c++, z += per_column) {
    double *depth = &raster->depth[row + (size_t)c];
    uint32_t *seen = &raster->seen[row + (size_t)c];
    /* This depth may be rounded differently than in the first pass. */
    if (fabs(z - *depth) < 2 * raster->error_bound &&
        *seen != raster_seen(facet) &&
        span_fill_is_nearer(raster, facet, raster_facet(*seen), c, line)) {
      *depth = z;
      *seen = raster_seen(facet);
    }
  }
}

/* ---- Triangles ----------------------------------------------------------- */

enum { LINES = 32 }; /* processed at a time */

/* An edge that is followed from the top down. */
struct descending_edge {
  struct scan_edge edge;
  double x; /* on the current line */
};

static void find_columns_exactly(struct descending_edge *side,
                                 const struct scan_grid *grid, int32_t line,
                                 int32_t count, bool on, int32_t *column) {
  for (int32_t i = 0; i < count; i++, side->x += side->edge.dx)
    column[i] = scan_edge_column_at(&side->edge, grid, line - i, side->x, on);
}

/* scan_edge_column_at for `count` lines from `line` down, without branches
 * where doubles decide for all of them; moves the edge past them. */
static inline void find_columns(struct descending_edge *side,
                                const struct scan_grid *grid, int32_t line,
                                int32_t count, bool on, int32_t *column) {
  double x = side->x, dx = side->edge.dx, x_error = side->edge.x_error;
  double end = x + dx * count, most = grid->columns;
  bool inside = (x >= 0) & (end >= 0) & (x <= most) & (end <= most);
  bool close = !inside;
  for (int32_t i = 0; inside && i < count; i++, x += dx) {
    int32_t near = (int32_t)x;
    double past = x - 0.5 - near;
    close |= fabs(past) <= x_error;
    column[i] = near + (past > 0);
  }
  if (close)
    find_columns_exactly(side, grid, line, count, on, column);
  else
    side->x = x;
}

/* Fills `count` lines from `line` down between two edges, and moves both past
 * them.  Returns how many pixels they cover. */
static int64_t fill_half(struct raster *raster, uint32_t triangle,
                         const struct span_fill_plane *plane,
                         struct descending_edge *left,
                         struct descending_edge *right, int32_t line,
                         int32_t count) {
  const struct scan_grid *grid = &raster->grid;
  int64_t covered = 0;
  while (count > 0) {
    int32_t first[LINES], past[LINES], some = count < LINES ? count : LINES;
    find_columns(left, grid, line, some, true, first);
    find_columns(right, grid, line, some, false, past);
    for (int32_t i = 0; i < some; i++, line--) {
      double z = plane->z + plane->per_line * (line + 0.5) +
                 plane->per_column * (first[i] + 0.5);
      if (first[i] >= past[i])
        continue;
      span_fill_span(raster, triangle, line, first[i], past[i], z,
                     plane->per_column);
      covered += past[i] - first[i];
    }
    count -= some;
  }
  return covered;
}

static bool descending_edge_init(struct descending_edge *side,
                                 const struct scan_grid *grid,
                                 const struct scan_point *from,
                                 const struct scan_point *to) {
  if (!scan_edge_init(&side->edge, grid, from, to))
    return false;
  side->x = side->edge.x;
  return true;
}

bool span_fill_triangle(struct raster *raster, uint32_t triangle,
                        int64_t *covered) {
  const struct scan_grid *grid = &raster->grid;
  const uint32_t *corner = raster->sheet->triangle.item[triangle].point;
  const struct scan_point p[3] = {raster_point(raster, corner[0]),
                                  raster_point(raster, corner[1]),
                                  raster_point(raster, corner[2])};
  struct span_fill_plane plane;
  struct descending_edge longest, side;
  /* The highest corner, then counter-clockwise. */
  int top =
      p[0].y > p[1].y ? (p[0].y > p[2].y ? 0 : 2) : (p[1].y > p[2].y ? 1 : 2);
  const struct scan_point *high = &p[top], *next = &p[geom_next_corner(top)],
                          *last = &p[top == 0 ? 2 : top - 1];
  /* Counter-clockwise from the highest corner is down the left side. */
  bool left = next->y > last->y;
  const struct scan_point *middle = left ? next : last;
  const struct scan_point *low = left ? last : next;
  if (high->line == low->line)
    return true;
  init_plane(&plane, raster, triangle);
  if (plane.steep)
    return false;
  if (!descending_edge_init(&longest, grid, high, low))
    return true;
  if (descending_edge_init(&side, grid, high, middle))
    *covered += left ? fill_half(raster, triangle, &plane, &side, &longest,
                                 high->line - 1, high->line - middle->line)
                     : fill_half(raster, triangle, &plane, &longest, &side,
                                 high->line - 1, high->line - middle->line);
  if (descending_edge_init(&side, grid, middle, low))
    *covered += left ? fill_half(raster, triangle, &plane, &side, &longest,
                                 middle->line - 1, middle->line - low->line)
                     : fill_half(raster, triangle, &plane, &longest, &side,
                                 middle->line - 1, middle->line - low->line);
  return true;
}
