/* surround.c - depths over a window that a triangle surrounds. */
#include "visibility/surround.h"

#include <math.h>

#include "visibility/hide.h"

/* A depth from a plane gathers a dozen roundings of its terms. */
#define SLACK (32 * 0x1p-53)

struct plane_depth {
  double z, error;
};

/* The depth of a plane at (x, y), and how far the doubles may be off. */
static struct plane_depth depth_at(const struct hider *h, int32_t x,
                                   int32_t y) {
  double dx = h->nx / h->nz * ((double)x - h->p[0].x),
         dy = h->ny / h->nz * ((double)y - h->p[0].y), z = (double)h->p[0].z;
  return (struct plane_depth){z - dx - dy,
                              SLACK * (fabs(z) + fabs(dx) + fabs(dy)) + 1};
}

static void corner_of(const struct window *window, int k, int32_t *x,
                      int32_t *y) {
  *x = k < 2 ? window->x0 : window->x1;
  *y = k == 1 || k == 2 ? window->y1 : window->y0;
}

void surround_depths_of(const struct sheet *sheet, uint32_t triangle,
                        const struct window *window,
                        struct surround_depths *depth) {
  struct hider h;
  double contact;
  hider_init(&h, sheet, triangle);
  /* The tolerance of hide.h in depth units, at its largest. */
  contact = (h.t0_near + h.t1_near * (double)SHEET_Z_MAX) / 0x1p16 / h.nz;
  depth->low = INFINITY;
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    struct plane_depth d;
    corner_of(window, k, &x, &y);
    d = depth_at(&h, x, y);
    depth->at[k] = d.z - d.error - contact * (1 + SLACK);
    if (depth->at[k] < depth->low) depth->low = depth->at[k];
  }
}

bool surround_hides(const struct sheet *sheet,
                    const struct surround_depths *front,
                    const struct window *window, uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  struct hider h;
  if ((double)triangle_nearest(sheet, triangle) < front->low) return true;
  for (int k = 0; k < 3; k++) h.p[k] = sheet->point.item[p[k]];
  h.plane = geom_plane_of(h.p[0], h.p[1], h.p[2]);
  h.nx = (double)h.plane.nx;
  h.ny = (double)h.plane.ny;
  h.nz = (double)h.plane.nz;
  for (int k = 0; k < 4; k++) {
    int32_t x, y;
    struct plane_depth d;
    corner_of(window, k, &x, &y);
    d = depth_at(&h, x, y);
    if (!(d.z + d.error < front->at[k])) return false;
  }
  return true;
}
