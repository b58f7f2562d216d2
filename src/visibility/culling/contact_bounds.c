/* contact_bounds.c - lowers the bounds of an occlusion buffer so far that
 * nothing behind them is in contact with what may be visible. */
#include "visibility/culling/contact_bounds.h"

#include <string.h>

#include "base/poll.h"
#include "visibility/predicate/coarse_plane.h"

enum {
  HEIGHT_MIN = 8,      /* of a triangle that is no needle, times the slope */
  TOLERANCES = 2,      /* by which bounds are lowered */
  VISITS_PER_CELL = 64 /* on average */
};

/* By how many steps a triangle lowers bounds. */
static int32_t steps_of(const struct occlusion_bound *all,
                        const struct geom_triangle *corners) {
  double nz, bound = occlusion_bound_of(all, corners, &nz), longest = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = corners->p[k], q = corners->p[geom_next_corner(k)];
    longest = fmax(longest, hypot((double)q.x - p.x, (double)q.y - p.y));
  }
  if (!(nz >= HEIGHT_MIN * all->slope * longest) || !(nz > 0))
    return INT32_MAX;
  return occlusion_steps_up(TOLERANCES * bound / nz);
}

/* Raises the steps of a range of cells to at least `least`. */
static void raise_steps(const struct triangle_grid *cells, struct cell_range r,
                        int32_t least, int32_t *steps) {
  for (int y = r.y0; y <= r.y1; y++) {
    int32_t *row = steps + triangle_grid_index(cells, 0, y);
    for (int x = r.x0; x <= r.x1; x++)
      row[x] = row[x] > least ? row[x] : least;
  }
}

/* Finds by how many steps to lower each bound.  Returns false when the caller
 * cancelled. */
static bool find_steps(const struct triangle_grid *cells,
                       const struct sheet *sheet, int32_t *steps) {
  struct occlusion_bound all = occlusion_tolerance_bound_all(sheet);
  size_t n = triangle_grid_cell_count(cells);
  int64_t visits = VISITS_PER_CELL * (int64_t)n;
  memset(steps, 0, n * sizeof *steps);
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    struct geom_triangle corners = sheet_corners(sheet, t);
    struct cell_range r =
        triangle_grid_cells(cells, box2_of_triangle(sheet, (uint32_t)t));
    if (!poll_at(t))
      return false;
    if (sheet_is_edge_on(sheet, t))
      continue; /* it is not filled */
    visits -= (int64_t)(r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1);
    if (visits < 0) {
      r = (struct cell_range){0, 0, cells->columns - 1, cells->rows - 1};
      raise_steps(cells, r, INT32_MAX, steps);
      return true;
    }
    raise_steps(cells, r, steps_of(&all, &corners), steps);
  }
  return true;
}

bool contact_bounds_lower(struct occlusion_buffer *buffer,
                          const struct sheet *sheet) {
  int32_t *steps =
      mem_alloc(triangle_grid_cell_count(&buffer->cells), sizeof *steps);
  bool ok = steps != NULL && find_steps(&buffer->cells, sheet, steps);
  for (int k = 0; ok && k < OCCLUSION_BANDS; k++) {
    struct occlusion_band band = occlusion_buffer_band(buffer, k);
    occlusion_buffer_lower(buffer, &band, steps);
  }
  mem_free(steps);
  return ok;
}
