/* page_cover.c - finds the triangles over points of the page, each by the one
 * before it. */
#include "visibility/contour/page_cover.h"

#include <math.h>

/* Whether a triangle lies over a point. */
static inline bool is_over(const struct sheet *sheet, uint32_t t,
                           struct geom_point p) {
  const uint32_t *corner = sheet->triangle.item[t].point;
  const struct geom_point *a = &sheet->point.item[corner[0]];
  const struct geom_point *b = &sheet->point.item[corner[1]];
  const struct geom_point *c = &sheet->point.item[corner[2]];
  return geom_orient2d(*a, *b, p) >= 0 && geom_orient2d(*b, *c, p) >= 0 &&
         geom_orient2d(*c, *a, p) >= 0 && !sheet_is_edge_on(sheet, t);
}

bool page_cover_is_over(struct page_cover *c, struct geom_point p, bool *ok) {
  struct triangle_span found;
  if (c->last != SHEET_NONE && is_over(c->sheet, c->last, p))
    return true;
  *ok = *ok && triangle_grid_find_at(c->grid, p, c->query, &found);
  for (size_t i = 0; *ok && i < found.count; i++)
    if (is_over(c->sheet, found.item[i], p)) {
      c->last = found.item[i];
      return true;
    }
  return false;
}

double page_cover_reach(const struct page_cover *c, struct geom_point p,
                        struct geom_point q) {
  struct geom_triangle of = sheet_corners(c->sheet, c->last);
  double reach = 1;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = of.p[k], b = of.p[geom_next_corner(k)];
    /* A point that is moved by a unit is nearer to the side by no more than
     * this; so much again is for rounding. */
    double most = 2 * (fabs((double)b.x - a.x) + fabs((double)b.y - a.y));
    double from = (double)geom_orient2d(a, b, p) - most;
    double to = (double)geom_orient2d(a, b, q) - most;
    if (to < 0)
      reach = fmin(reach, from > 0 ? from / (from - to) : 0);
  }
  return reach;
}
