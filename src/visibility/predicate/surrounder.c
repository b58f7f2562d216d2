/* surrounder.c - certified depths of a triangle over a window. */
#include "visibility/predicate/surrounder.h"

#include <math.h>

#include "visibility/predicate/occlusion.h"

/* The depth of a plane at a point has a dozen roundings of its terms. */
#define SLACK (32 * 0x1p-53)

/* A depth and its error bound. */
struct plane_depth {
  double z, error;
};

/* The plane of an occluder, with no contact tolerance. */
static struct surrounder_plane plane_of(const struct occluder *h) {
  return (struct surrounder_plane){(double)h->p[0].x, (double)h->p[0].y,
                                   (double)h->p[0].z, h->nx / h->nz,
                                   h->ny / h->nz,     0};
}

struct surrounder_plane surrounder_plane_of(const struct sheet *sheet,
                                            uint32_t triangle) {
  struct surrounder_plane plane;
  struct occluder h;
  occluder_init(&h, sheet, triangle);
  plane = plane_of(&h);
  /* The contact tolerance of occlusion.h in depth units, at its largest. */
  plane.contact = (h.t0_near + h.t1_near * (double)SHEET_Z_MAX) / 0x1p16 /
                  h.nz * (1 + SLACK);
  return plane;
}

/* The depth of a plane at (x, y). */
static struct plane_depth depth_at(const struct surrounder_plane *p, int32_t x,
                                   int32_t y) {
  double dx = p->gx * ((double)x - p->x), dy = p->gy * ((double)y - p->y);
  return (struct plane_depth){p->z - dx - dy,
                              SLACK * (fabs(p->z) + fabs(dx) + fabs(dy)) + 1};
}

/* Corner k of a window, in the order of window_line_function. */
static void corner_of(const struct box2 *window, int k, int32_t *x,
                      int32_t *y) {
  *x = k < 2 ? window->x0 : window->x1;
  *y = k == 1 || k == 2 ? window->y1 : window->y0;
}

double surrounder_farthest_z(const struct surrounder_plane *plane,
                             const struct box2 *window) {
  struct plane_depth d =
      depth_at(plane, plane->gx > 0 ? window->x1 : window->x0,
               plane->gy > 0 ? window->y1 : window->y0);
  return d.z - d.error - plane->contact;
}

void surrounder_depths_of(const struct sheet *sheet, uint32_t triangle,
                          const struct box2 *window,
                          struct surrounder_depths *depth) {
  struct surrounder_plane plane = surrounder_plane_of(sheet, triangle);
  depth->low = INFINITY;
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    struct plane_depth d;
    corner_of(window, k, &x, &y);
    d = depth_at(&plane, x, y);
    depth->at[k] = d.z - d.error - plane.contact;
    if (depth->at[k] < depth->low)
      depth->low = depth->at[k];
  }
}

bool surrounder_hides(const struct sheet *sheet,
                      const struct surrounder_depths *front,
                      const struct box2 *window, uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  struct surrounder_plane plane;
  struct occluder h;
  if ((double)triangle_nearest_z(sheet, triangle) < front->low)
    return true;
  for (int k = 0; k < 3; k++)
    h.p[k] = sheet->point.item[p[k]];
  h.plane = geom_plane_of(h.p[0], h.p[1], h.p[2]);
  h.nx = (double)h.plane.nx;
  h.ny = (double)h.plane.ny;
  h.nz = (double)h.plane.nz;
  plane = plane_of(&h);
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    struct plane_depth d;
    corner_of(window, k, &x, &y);
    d = depth_at(&plane, x, y);
    if (!(d.z + d.error < front->at[k]))
      return false;
  }
  return true;
}
