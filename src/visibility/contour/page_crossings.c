/* page_crossings.c - finds the crossings of curves on the page by a uniform
 * grid. */
#include "visibility/contour/page_crossings.h"

#include <math.h>

#include "base/poll.h"
#include "visibility/contour/segment_grid.h"

struct page_crossings {
  struct contour_curves *curves; /* borrowed, not owned */
  const struct camera *camera;   /* the same */
  struct projection projection;
  struct segment_grid grid;
};

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

/* Where the surface of a contour covers a line that passes behind it; see
 * contour_cut. */
static int8_t side_covered(const struct page_crossings *p,
                           const struct page_segment *line,
                           const struct page_segment *front) {
  if (front->owner == SHEET_NONE)
    return 0;
  int side =
      contour_curves_segment(p->curves, front->owner)->radial < 0 ? -1 : 1;
  bool is_left = contour_curves_surface_is_left(
      p->curves, p->camera, &p->projection, front->owner, side);
  return is_left == (geom_orient2d(front->p, front->q, line->q) > 0) ? 1 : -1;
}

/* Cuts a segment where one in front crosses it.
 * front  NULL: it is at the same depth */
static bool cut_behind(const struct page_crossings *p,
                       const struct page_segment *line, double t,
                       const struct page_segment *front) {
  struct contour_cut cut = {line->owner, fmin(t, 1 - 0x1p-30), true,
                            front != NULL ? side_covered(p, line, front) : 0};
  return line->owner == SHEET_NONE || ARRAY_PUSH(&p->curves->cut, cut);
}

/* Cuts a segment where the other one crosses it, if it is the farther one;
 * contours of the same depth are both cut, as where a surface passes through
 * another one just where both are seen edge-on. */
static bool cut_at_crossing(const struct page_crossings *p,
                            const struct page_segment *a,
                            const struct page_segment *b) {
  double s, t;
  if (!page_segments_cross(a, b, &s, &t))
    return true;
  double depth = page_segment_depth(b, t) - page_segment_depth(a, s);
  if (depth == 0)
    return b->owner == SHEET_NONE ||
           (cut_behind(p, a, s, NULL) && cut_behind(p, b, t, NULL));
  return depth > 0 ? cut_behind(p, a, s, b) : cut_behind(p, b, t, a);
}

static bool cut_at_crossings(const struct page_crossings *p) {
  const struct segment_grid *grid = &p->grid;
  const uint32_t *item = grid->cell.lists.item, *start = grid->cell.lists.start;
  const struct page_segment *all = grid->segment.item;
  size_t cells = triangle_grid_cell_count(&grid->cell);
  for (size_t cell = 0; cell < cells; cell++) {
    if (!poll_at(cell))
      return false;
    for (uint32_t i = start[cell]; i < start[cell + 1]; i++)
      for (uint32_t j = start[cell]; item[i] < grid->contours && j < i; j++)
        if (!cut_at_crossing(p, &all[item[i]], &all[item[j]]))
          return false;
  }
  return true;
}

bool page_crossings_cut(struct contour_curves *curves,
                        const struct camera *camera) {
  struct page_crossings p = {
      curves, camera, projection_of(camera), {.contours = 0}};
  bool ok = add_segments(&p.grid, curves) &&
            (p.grid.contours == 0 ||
             (segment_grid_make(&p.grid) && cut_at_crossings(&p)));
  segment_grid_fini(&p.grid);
  return ok;
}
