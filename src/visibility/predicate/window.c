/* window.c - classifies polygons against a window of the page. */
#include "visibility/predicate/window.h"

enum window_class window_box_test(const struct box2 *window,
                                  const struct geom_point *corner, int count) {
  struct box2 box = box2_of_segment(corner[0], corner[count - 1]);
  for (int k = 1; k < count - 1; k++)
    box = box2_union(box, box2_of_segment(corner[k], corner[k]));
  if (box2_disjoint(box, *window))
    return WINDOW_DISJOINT;
  if (box.x0 >= window->x0 && box.x1 <= window->x1 && box.y0 >= window->y0 &&
      box.y1 <= window->y1)
    return WINDOW_CONTAINED;
  return WINDOW_INTERSECTING;
}

void window_line_function(const struct box2 *window, struct geom_point p,
                          struct geom_point q, int64_t value[4]) {
  const struct geom_point at[4] = {{window->x0, window->y0, 0},
                                   {window->x0, window->y1, 0},
                                   {window->x1, window->y1, 0},
                                   {window->x1, window->y0, 0}};
  for (int k = 0; k < 4; k++)
    value[k] = geom_orient2d(p, q, at[k]);
}

bool window_meets_edge(const struct box2 *window, struct geom_point p,
                       struct geom_point q) {
  const struct geom_point edge[2] = {p, q};
  int64_t value[4];
  bool left = false, right = false;
  if (window_box_test(window, edge, 2) == WINDOW_DISJOINT)
    return false;
  window_line_function(window, p, q, value);
  for (int k = 0; k < 4; k++) {
    left |= value[k] >= 0;
    right |= value[k] <= 0;
  }
  return left && right;
}

int window_octant(const struct box2 *window, int64_t x, int64_t y, int bits) {
  static const int octant[3][3] = {{5, 6, 7}, {4, -1, 0}, {3, 2, 1}};
  int64_t scale = INT64_C(1) << bits;
  int column = x < window->x0 * scale ? 0 : x > window->x1 * scale ? 2 : 1;
  int row = y < window->y0 * scale ? 0 : y > window->y1 * scale ? 2 : 1;
  return octant[row][column];
}

/* A difference of octants, reduced modulo 8 to -4 .. 4. */
static int wrap_octants(int difference) {
  if (difference > 4)
    return difference - 8;
  return difference < -4 ? difference + 8 : difference;
}

static bool is_ambiguous(int difference) {
  return difference == 4 || difference == -4;
}

/* The octants passed from p to q, which does not meet the window.  The edge is
 * bisected where the difference is 4; each time the coordinates are doubled, so
 * that the midpoint stays an integer.  A half that still spans opposite octants
 * is longer than the window's side, which is a unit at least: 31 bisections are
 * enough. */
static int count_octants(const struct box2 *window, struct geom_point p,
                         struct geom_point q) {
  int64_t px = p.x, py = p.y, qx = q.x, qy = q.y;
  int sum = 0, bits = 0;
  for (;; bits++) {
    int a = window_octant(window, px, py, bits),
        b = window_octant(window, qx, qy, bits), d = wrap_octants(b - a), m;
    int64_t mx = px + qx, my = py + qy;
    if (!is_ambiguous(d) || bits == 31)
      return sum + d;
    m = window_octant(window, mx, my, bits + 1);
    if (is_ambiguous(wrap_octants(m - a))) { /* continue with the first half */
      sum += wrap_octants(b - m);
      px *= 2;
      py *= 2;
      qx = mx;
      qy = my;
    } else {
      sum += wrap_octants(m - a);
      px = mx;
      py = my;
      qx *= 2;
      qy *= 2;
    }
  }
}

int window_angle_count(const struct box2 *window,
                       const struct geom_point *corner, int count) {
  int sum = 0;
  for (int k = 0; k < count; k++)
    sum += count_octants(window, corner[k], corner[k + 1 == count ? 0 : k + 1]);
  return sum;
}

enum window_class window_classify(const struct box2 *window,
                                  const struct geom_point *corner, int count,
                                  struct window_counts *counts) {
  enum window_class class = window_box_test(window, corner, count);
  if (class != WINDOW_INTERSECTING) {
    counts->box++;
    return class;
  }
  for (int k = 0; k < count; k++)
    if (window_meets_edge(window, corner[k],
                          corner[k + 1 == count ? 0 : k + 1])) {
      counts->sign++;
      return WINDOW_INTERSECTING;
    }
  counts->angle++;
  return window_angle_count(window, corner, count) == 0 ? WINDOW_DISJOINT
                                                        : WINDOW_SURROUNDING;
}

/* Clips [from, to] to the parameters t where s + t (e - s) >= 0.  Returns false
 * where nothing is left. */
static bool clip_above(int64_t s, int64_t e, struct ratio *from,
                       struct ratio *to) {
  if (s >= 0 && e >= 0)
    return true;
  if (s < 0 && e < 0)
    return false;
  if (s < 0) {
    struct ratio t = ratio_of(-s, e - s);
    if (ratio_compare(*from, t) < 0)
      *from = t;
  } else {
    struct ratio t = ratio_of(s, s - e);
    if (ratio_compare(t, *to) < 0)
      *to = t;
  }
  return ratio_compare(*from, *to) <= 0;
}

bool window_clip(const struct box2 *window, struct geom_point p,
                 struct geom_point q, struct ratio *from, struct ratio *to) {
  *from = ratio_of(0, 1);
  *to = ratio_of(1, 1);
  return clip_above((int64_t)p.x - window->x0, (int64_t)q.x - window->x0, from,
                    to) &&
         clip_above((int64_t)window->x1 - p.x, (int64_t)window->x1 - q.x, from,
                    to) &&
         clip_above((int64_t)p.y - window->y0, (int64_t)q.y - window->y0, from,
                    to) &&
         clip_above((int64_t)window->y1 - p.y, (int64_t)window->y1 - q.y, from,
                    to);
}

/* Where many sides nearly coincide, splitting at each would make one sliver
 * after another: hence the quarter. */
int32_t window_split(int32_t from, int32_t to, int32_t low, int32_t high) {
  int64_t sum = (int64_t)from + to, width = (int64_t)to - from;
  int64_t off_low = 2 * (int64_t)low - sum, off_high = 2 * (int64_t)high - sum;
  if (off_low < 0)
    off_low = -off_low;
  if (off_high < 0)
    off_high = -off_high;
  if (2 * off_low > width && 2 * off_high > width)
    return (int32_t)(sum / 2);
  return off_low <= off_high ? low : high;
}
