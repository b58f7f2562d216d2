/* surrounder.c - certified depths of a triangle over a window. */
#include "visibility/predicate/surrounder.h"

#include <math.h>

#include "visibility/predicate/plane_filter.h"

struct surrounder_plane surrounder_plane_of(const struct sheet *sheet,
                                            uint32_t triangle) {
  struct geom_plane plane = sheet_plane(sheet, triangle);
  struct plane_filter filter = plane_filter_of(sheet, triangle);
  return (struct surrounder_plane){depth_plane_of(&plane),
                                   plane_filter_thickness(&filter)};
}

/* A lower bound of the depth of a plane at a point, with the contact tolerance
 * subtracted. */
static double lowest_at(const struct surrounder_plane *p, int32_t x,
                        int32_t y) {
  return depth_plane_at(&p->depth, x, y) - depth_plane_error(&p->depth, x, y) -
         1 - p->contact;
}

/* Corner k of a window, in the order of window_line_function. */
static void window_corner(const struct box2 *window, int k, int32_t *x,
                          int32_t *y) {
  *x = k < 2 ? window->x0 : window->x1;
  *y = k == 1 || k == 2 ? window->y1 : window->y0;
}

double surrounder_farthest_z(const struct surrounder_plane *plane,
                             const struct box2 *window) {
  return lowest_at(plane, plane->depth.per_x < 0 ? window->x1 : window->x0,
                   plane->depth.per_y < 0 ? window->y1 : window->y0);
}

void surrounder_depths_of(const struct sheet *sheet, uint32_t triangle,
                          const struct box2 *window,
                          struct surrounder_depths *depth) {
  struct surrounder_plane plane = surrounder_plane_of(sheet, triangle);
  depth->low = INFINITY;
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    window_corner(window, k, &x, &y);
    depth->at[k] = lowest_at(&plane, x, y);
    if (depth->at[k] < depth->low)
      depth->low = depth->at[k];
  }
}

bool surrounder_hides(const struct sheet *sheet,
                      const struct surrounder_depths *front,
                      const struct box2 *window, uint32_t triangle) {
  if ((double)sheet_nearest_z(sheet, triangle) < front->low)
    return true;
  struct geom_plane exact = sheet_plane(sheet, triangle);
  struct depth_plane plane = depth_plane_of(&exact);
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    window_corner(window, k, &x, &y);
    if (!(depth_plane_at(&plane, x, y) + depth_plane_error(&plane, x, y) + 1 <
          front->at[k]))
      return false;
  }
  return true;
}
