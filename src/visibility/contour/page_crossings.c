/* page_crossings.c - finds the crossings of curves on the page by a uniform
 * grid. */
#include "visibility/contour/page_crossings.h"

#include <math.h>

#include "base/poll.h"
#include "visibility/contour/segment_grid.h"

static bool add_segments(struct segment_grid *grid,
                         const struct contour_curves *curves) {
  for (uint32_t i = 0; i < curves->step.count; i++)
    if (curves->step.item[i].segment != SHEET_NONE &&
        !segment_grid_add(
            grid,
            (struct geom_segment){contour_curves_node(curves, i)->page,
                                  contour_curves_node(curves, i + 1)->page},
            i))
      return false;
  grid->contours = grid->segment.count;
  for (size_t i = 0; i < curves->set->border.count; i++)
    if (!segment_grid_add(grid, curves->set->border.item[i], SHEET_NONE))
      return false;
  return true;
}

/* Cuts a segment where the other one crosses it, if it is the farther one;
 * contours of the same depth are both cut, as where a surface passes through
 * another one just where both are seen edge-on. */
static bool cut_at_crossing(struct contour_curves *curves,
                            const struct page_segment *a,
                            const struct page_segment *b) {
  double s, t;
  if (!page_segments_cross(a, b, &s, &t))
    return true;
  double depth = page_segment_depth(b, t) - page_segment_depth(a, s);
  struct contour_cut of_a = {a->owner, fmin(s, 1 - 0x1p-30), true};
  struct contour_cut of_b = {b->owner, fmin(t, 1 - 0x1p-30), true};
  bool is_border = b->owner == SHEET_NONE;
  return (depth < 0 || (is_border && depth == 0) ||
          ARRAY_PUSH(&curves->cut, of_a)) &&
         (is_border || depth > 0 || ARRAY_PUSH(&curves->cut, of_b));
}

static bool cut_at_crossings(struct contour_curves *curves,
                             const struct segment_grid *grid) {
  const uint32_t *item = grid->cell.lists.item, *start = grid->cell.lists.start;
  const struct page_segment *all = grid->segment.item;
  size_t cells = triangle_grid_cell_count(&grid->cell);
  for (size_t cell = 0; cell < cells; cell++) {
    if (!poll_at(cell))
      return false;
    for (uint32_t i = start[cell]; i < start[cell + 1]; i++)
      for (uint32_t j = start[cell]; item[i] < grid->contours && j < i; j++)
        if (!cut_at_crossing(curves, &all[item[i]], &all[item[j]]))
          return false;
  }
  return true;
}

bool page_crossings_cut(struct contour_curves *curves) {
  struct segment_grid grid = {.contours = 0};
  bool ok = add_segments(&grid, curves) &&
            (grid.contours == 0 ||
             (segment_grid_make(&grid) && cut_at_crossings(curves, &grid)));
  segment_grid_fini(&grid);
  return ok;
}
