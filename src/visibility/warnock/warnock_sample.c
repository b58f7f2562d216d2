/* warnock_sample.c - point sampling of facets at the centres of sub-pixels.
 *
 * Ranges  In units of 1 / den <= 2^-1, den <= 2^17, a centre is below 2^48 and
 *   its distance from a corner below 2^49: exact in int64 and in a double.  An
 *   edge's line function there is below 2 * 2^31 * 2^49 = 2^81.
 */
#include "visibility/warnock/warnock_sample.h"

/* The plane of a facet, x and y in units of 1 / den. */
static struct depth_plane sample_plane(const struct sheet *sheet,
                                       const struct scan_grid *grid,
                                       uint32_t facet) {
  struct geom_plane exact = sheet_plane(sheet, facet);
  struct depth_plane plane = depth_plane_of(&exact);
  double den = (double)grid->den;
  return (struct depth_plane){plane.x * den, plane.y * den, plane.z,
                              plane.per_x / den, plane.per_y / den};
}

bool warnock_sample_init(struct warnock_sample *sample,
                         const struct sheet *sheet, const struct facets *facets,
                         const struct scan_grid *grid) {
  uint32_t count = (uint32_t)sheet->triangle.count;
  *sample = (struct warnock_sample){.facets = facets,
                                    .fine = {.sheet = sheet, .grid = *grid}};
  sample->plane = mem_alloc(count, sizeof *sample->plane);
  if (sample->plane == NULL)
    return false;
  for (uint32_t t = 0; t < count; t++)
    if (!sheet_is_edge_on(sheet, t) && facet_of(facets, t) == t)
      sample->plane[t] = sample_plane(sheet, grid, t);
  return true;
}

void warnock_sample_fini(struct warnock_sample *sample) {
  mem_free(sample->plane);
  sample->plane = NULL;
}

static int64_t centre_x(const struct scan_grid *grid, int32_t column) {
  return grid->x_first + column * grid->x_step + grid->x_step / 2;
}

struct sample_depth warnock_sample_depth(const struct warnock_sample *sample,
                                         uint32_t facet, int32_t column,
                                         int32_t line) {
  const struct scan_grid *grid = &sample->fine.grid;
  const struct depth_plane *plane = &sample->plane[facet];
  double x = (double)centre_x(grid, column),
         y = (double)scan_centre_y(grid, line);
  return (struct sample_depth){depth_plane_at(plane, x, y),
                               depth_plane_error(plane, x, y)};
}

bool warnock_sample_is_nearer(const struct warnock_sample *sample, uint32_t a,
                              uint32_t b, int32_t column, int32_t line) {
  struct sample_depth of_a = warnock_sample_depth(sample, a, column, line);
  struct sample_depth of_b = warnock_sample_depth(sample, b, column, line);
  double error_bound = of_a.error + of_b.error;
  int order;
  if (of_a.z > of_b.z + error_bound)
    return true;
  if (of_a.z < of_b.z - error_bound)
    return false;
  order = raster_compare(&sample->fine, a, b, column, line);
  return order > 0 || (order == 0 && a < b);
}

bool warnock_sample_covers(const struct warnock_sample *sample, uint32_t facet,
                           int32_t column, int32_t line) {
  const struct scan_grid *grid = &sample->fine.grid;
  const struct sheet *sheet = sample->fine.sheet;
  const uint32_t *corner, *side;
  uint32_t count = facet_outline(sample->facets, sheet, facet, &corner, &side);
  int64_t x = centre_x(grid, column), y = scan_centre_y(grid, line);
  bool above = false, below = false;
  for (uint32_t k = 0; k < count; k++) {
    struct geom_point p = sheet->point.item[corner[k]];
    struct geom_point q = sheet->point.item[corner[k + 1 == count ? 0 : k + 1]];
    int128 along = (int128)((int64_t)q.x - p.x) * (y - p.y * grid->den);
    int128 across = (int128)((int64_t)q.y - p.y) * (x - p.x * grid->den);
    if (along < across)
      return false;
    above |= p.y * grid->den > y;
    below |= p.y * grid->den <= y;
  }
  return above && below;
}

static int128 floor_divide_128(int128 num, int128 den) {
  int128 quotient = num / den;
  return num % den < 0 ? quotient - 1 : quotient;
}

bool warnock_sample_columns(const struct warnock_sample *sample, uint32_t facet,
                            int32_t line, int64_t *first, int64_t *past) {
  const struct scan_grid *grid = &sample->fine.grid;
  const struct sheet *sheet = sample->fine.sheet;
  const uint32_t *corner, *side;
  uint32_t count = facet_outline(sample->facets, sheet, facet, &corner, &side);
  int64_t y = scan_centre_y(grid, line), zero = centre_x(grid, 0);
  *first = *past = 0;
  for (uint32_t k = 0; k < count; k++) {
    struct geom_point p = sheet->point.item[corner[k]];
    struct geom_point q = sheet->point.item[corner[k + 1 == count ? 0 : k + 1]];
    int64_t dx = (int64_t)q.x - p.x, dy = (int64_t)q.y - p.y;
    bool p_below = p.y * grid->den <= y;
    int128 num;
    if (p_below == (q.y * grid->den <= y))
      continue;
    /* Corners run counter-clockwise: of the two sides that cross the line the
     * one that goes up is on the right. */
    num = (int128)(p.x * grid->den - zero) * dy +
          (int128)dx * (y - p.y * grid->den);
    if (p_below)
      *past = (int64_t)floor_divide_128(num, (int128)dy * grid->x_step) + 1;
    else
      *first = -(int64_t)floor_divide_128(num, -(int128)dy * grid->x_step);
  }
  return *first < *past;
}
