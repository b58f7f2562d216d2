/* active_edge_pair.c - an active polygon of the z-buffers, line by line. */
#include "visibility/raster/active_edge_pair.h"

#include <math.h>

#include "visibility/raster/span_fill.h"

/* The depth on the left edge at the current line, computed from the corner at
 * which this edge ends. */
static double depth_on_left(const struct active_edge_pair *pair,
                            const struct raster *raster) {
  const struct scan_grid *grid = &raster->grid;
  const struct scan_edge *left = &pair->edges.left;
  uint32_t k = pair->edges.left_at;
  const struct scan_point corner = raster_point(raster, pair->corner[k]);
  int64_t y = grid->y_first + left->line * grid->y_step + grid->y_step / 2;
  double up = (double)(y - corner.y * grid->den) / (double)grid->y_step;
  return (double)raster->sheet->point.item[pair->corner[k]].z -
         pair->dz_x * (left->x - corner.column) - pair->dz_y * up;
}

static void set_points(const struct active_edge_pair *pair,
                       const struct raster *raster,
                       struct scan_point point[FACET_CORNERS_MAX]) {
  for (uint32_t k = 0; k < pair->count; k++)
    point[k] = raster_point(raster, pair->corner[k]);
}

bool active_edge_pair_start(struct active_edge_pair *pair,
                            const struct raster *raster,
                            const struct facets *facets, uint32_t facet) {
  const struct sheet *sheet = raster->sheet;
  const struct scan_grid *grid = &raster->grid;
  struct scan_point point[FACET_CORNERS_MAX];
  const uint32_t *side;
  double per_column, per_line;
  pair->count = facet_outline(facets, sheet, facet, &pair->corner, &side);
  set_points(pair, raster, point);
  if (!scan_convex_start(&pair->edges, grid, point, pair->count))
    return false;
  pair->facet = facet;
  facet_depth_range(sheet, pair->corner, pair->count, &pair->z_low,
                    &pair->z_high);
  facet_slopes(sheet, grid, facet, &per_column, &per_line);
  pair->dz_x = -per_column;
  pair->dz_y = -per_line;
  pair->steep = facet_is_steep(grid, per_column, per_line);
  pair->z_left = depth_on_left(pair, raster);
  return true;
}

bool active_edge_pair_next(struct active_edge_pair *pair,
                           const struct raster *raster) {
  double dx_left = pair->edges.left.dx;
  struct scan_point point[FACET_CORNERS_MAX], *needed = NULL;
  if (scan_convex_ends(&pair->edges))
    return false;
  if (pair->edges.left.dy == 0 || pair->edges.right.dy == 0)
    set_points(pair, raster, needed = point);
  if (!scan_convex_next(&pair->edges, &raster->grid, needed))
    return false;
  if (pair->edges.left_new)
    pair->z_left = depth_on_left(pair, raster);
  else
    pair->z_left += pair->dz_y - pair->dz_x * dx_left;
  return true;
}

/* Draws a facet that is too steep for incremental depths in doubles. */
static void draw_steep(const struct active_edge_pair *pair,
                       struct raster *raster, int32_t first, int32_t past) {
  int32_t line = pair->edges.left.line;
  size_t row = raster_row(raster, line);
  for (int32_t c = first; c < past; c++) {
    double *depth = &raster->depth[row + (size_t)c];
    uint32_t *seen = &raster->seen[row + (size_t)c];
    double z = raster_depth(raster, pair->facet, c, line);
    if (z <= *depth - raster->error_bound)
      continue;
    if (z < *depth + raster->error_bound &&
        !span_fill_is_nearer(raster, pair->facet, raster_facet(*seen), c, line))
      continue;
    *depth = z;
    *seen = raster_seen(pair->facet);
  }
}

/* Draws into a frame of integer depths.  The depths are clamped to those of the
 * facet's corners, for steep facets. */
static void draw_levels(const struct active_edge_pair *pair,
                        struct raster *raster, int32_t first, int32_t past) {
  size_t row = raster_row(raster, pair->edges.left.line);
  uint32_t *level = raster->level + row, *seen = raster->seen + row;
  double scale = raster->level_scale, low = pair->z_low, high = pair->z_high;
  double z = pair->z_left - pair->dz_x * (first + 0.5 - pair->edges.left.x);
  for (int32_t c = first; c < past; c++, z -= pair->dz_x) {
    double within = z < low ? low : z > high ? high : z;
    uint32_t here = (uint32_t)(within * scale) + 1;
    if (here < level[c] || (here == level[c] && seen[c] <= pair->facet))
      continue;
    level[c] = here;
    seen[c] = raster_seen(pair->facet);
  }
}

size_t active_edge_pair_draw(const struct active_edge_pair *pair,
                             struct raster *raster) {
  int32_t first = scan_edge_column(&pair->edges.left, &raster->grid);
  int32_t past = scan_edge_column_past(&pair->edges.right, &raster->grid);
  if (first >= past)
    return 0;
  if (raster->depth_bits > 0)
    draw_levels(pair, raster, first, past);
  else if (!pair->steep)
    span_fill_span(raster, pair->facet, pair->edges.left.line, first, past,
                   pair->z_left -
                       pair->dz_x * (first + 0.5 - pair->edges.left.x),
                   -pair->dz_x);
  else
    draw_steep(pair, raster, first, past);
  return (size_t)(past - first);
}
