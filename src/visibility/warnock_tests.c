/* warnock_tests.c - depths over a window: which faces a surrounder hides. */
#include "visibility/warnock_tests.h"

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

void warnock_corner_depths(const struct sheet *sheet, uint32_t triangle,
                           const struct window *window,
                           struct warnock_corners *depth) {
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

int64_t warnock_nearest(const struct sheet *sheet, uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int64_t z = sheet->point.item[p[0]].z;
  for (int k = 1; k < 3; k++)
    if (sheet->point.item[p[k]].z > z) z = sheet->point.item[p[k]].z;
  return z;
}

bool warnock_is_behind(const struct sheet *sheet, uint32_t triangle,
                       const struct window *window,
                       const struct warnock_corners *front,
                       struct warnock_depth_counts *counts) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  struct hider h;
  if ((double)warnock_nearest(sheet, triangle) < front->low) {
    counts->corners++;
    return true;
  }
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
  counts->corners++;
  return true;
}

void warnock_window_lines(const struct window *window, struct geom_line line[4],
                          struct geom_line back[4]) {
  const struct geom_point at[4] = {{window->x0, window->y0, 0},
                                   {window->x1, window->y0, 0},
                                   {window->x1, window->y1, 0},
                                   {window->x0, window->y1, 0}};
  for (int k = 0; k < 4; k++) {
    geom_line_through(&line[k], at[k], at[(k + 1) % 4]);
    back[k] = line[k];
    geom_line_reverse(&back[k]);
  }
}

struct window warnock_page_window(const struct sheet *sheet) {
  int64_t x0 = SHEET_XY_MAX, y0 = x0, x1 = -x0, y1 = -x0, side;
  struct window window;
  for (size_t i = 0; i < sheet->point.count; i++) {
    struct geom_point p = sheet->point.item[i];
    if (p.x < x0) x0 = p.x;
    if (p.x > x1) x1 = p.x;
    if (p.y < y0) y0 = p.y;
    if (p.y > y1) y1 = p.y;
  }
  side = x1 - x0 > y1 - y0 ? x1 - x0 : y1 - y0;
  if (side < 2) side = 2;
  /* A square about the scene, one that does not leave the grid's range. */
  if (x0 + side > SHEET_XY_MAX) x0 = SHEET_XY_MAX - side;
  if (y0 + side > SHEET_XY_MAX) y0 = SHEET_XY_MAX - side;
  if (x0 < -SHEET_XY_MAX) x0 = -SHEET_XY_MAX;
  if (y0 < -SHEET_XY_MAX) y0 = -SHEET_XY_MAX;
  window = (struct window){(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                           (int32_t)(y0 + side)};
  return window;
}

int64_t warnock_edge_length(const struct sheet *sheet) {
  enum { SAMPLE = 4096 };
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1, count = 0;
  int64_t sum = 0;
  for (size_t t = 0; t < n; t += stride, count++) {
    struct page_box b = page_box_of_triangle(sheet, (uint32_t)t);
    int64_t width = (int64_t)b.x1 - b.x0, height = (int64_t)b.y1 - b.y0;
    sum += width > height ? width : height;
  }
  return count == 0 ? 1 : sum / (int64_t)count / 2 + 1;
}
