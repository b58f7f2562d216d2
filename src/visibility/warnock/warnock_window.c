/* warnock_window.c - the window that Warnock's subdivision starts from, and the
 * size at which it ends. */
#include "visibility/warnock/warnock_window.h"

#include "visibility/predicate/occlusion.h"

void warnock_window_lines(const struct box2 *window, struct geom_line line[4],
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

struct box2 warnock_page_window(const struct sheet *sheet) {
  int64_t x0 = SHEET_XY_MAX, y0 = x0, x1 = -x0, y1 = -x0, side;
  struct box2 window;
  for (size_t i = 0; i < sheet->point.count; i++) {
    struct geom_point p = sheet->point.item[i];
    if (p.x < x0)
      x0 = p.x;
    if (p.x > x1)
      x1 = p.x;
    if (p.y < y0)
      y0 = p.y;
    if (p.y > y1)
      y1 = p.y;
  }
  side = x1 - x0 > y1 - y0 ? x1 - x0 : y1 - y0;
  if (side < 2)
    side = 2;
  /* The square is moved where it would leave the grid's range. */
  if (x0 + side > SHEET_XY_MAX)
    x0 = SHEET_XY_MAX - side;
  if (y0 + side > SHEET_XY_MAX)
    y0 = SHEET_XY_MAX - side;
  if (x0 < -SHEET_XY_MAX)
    x0 = -SHEET_XY_MAX;
  if (y0 < -SHEET_XY_MAX)
    y0 = -SHEET_XY_MAX;
  window = (struct box2){(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                         (int32_t)(y0 + side)};
  return window;
}

int64_t warnock_edge_length(const struct sheet *sheet) {
  enum { SAMPLE = 4096 };
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1, count = 0;
  int64_t sum = 0;
  for (size_t t = 0; t < n; t += stride, count++) {
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    int64_t width = (int64_t)b.x1 - b.x0, height = (int64_t)b.y1 - b.y0;
    sum += width > height ? width : height;
  }
  return count == 0 ? 1 : sum / (int64_t)count / 2 + 1;
}
