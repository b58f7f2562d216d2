/* sweep_events.c - exact predicates on the events of the sweep, and the heap of
 * crossings.
 *
 * Ranges.  With directions r, s < 2^31 in each coordinate, edges p + t r and
 * q + u s cross at
 *     t = num / den = ((q - p) x s) / (r x s),
 * numerator and denominator below 2^63.  So
 *     x den = p.x den + num r.x
 * is a sum of terms below 2^94; as x lies on the page, x den is below 2^93
 * itself.  On which side of an edge the event lies is the sign of
 *     r x (event den - p den),
 * a difference of two products below 2^125.
 */
#include "visibility/watkins/exact/sweep.h"

#include <math.h>

struct sweep_event sweep_event_at(int32_t x, int32_t y) {
  return (struct sweep_event){x, y, 1, x, y};
}

static int compare_coordinate(int128 a, int64_t a_den, double a_near, int128 b,
                              int64_t b_den, double b_near) {
  double apart = a_near - b_near;
  if (fabs(apart) > 2 * SWEEP_NEAR)
    return apart < 0 ? -1 : 1;
  return ratio_compare((struct ratio){a, a_den}, (struct ratio){b, b_den});
}

int sweep_event_compare(const struct sweep_event *p,
                        const struct sweep_event *q) {
  int order =
      -compare_coordinate(p->y, p->den, p->y_near, q->y, q->den, q->y_near);
  return order != 0 ? order
                    : compare_coordinate(p->x, p->den, p->x_near, q->x, q->den,
                                         q->x_near);
}

int sweep_side(const struct sweep_edge *edge, const struct sweep_event *event) {
  int64_t dx = (int64_t)edge->x1 - edge->x0, dy = (int64_t)edge->y1 - edge->y0;
  double a, b, bound;
  if (event->den == 1)
    return geom_sign64(dx * ((int64_t)event->y - edge->y0) -
                       dy * ((int64_t)event->x - edge->x0));
  a = (double)dx * (event->y_near - edge->y0);
  b = (double)dy * (event->x_near - edge->x0);
  /* One factor of each product is off by less than SWEEP_NEAR; each product and
   * their difference take four roundings. */
  bound = (fabs((double)dx) + fabs((double)dy)) * (2 * SWEEP_NEAR) +
          (fabs(a) + fabs(b)) * 0x1p-50;
  if (fabs(a - b) > bound)
    return a > b ? 1 : -1;
  return geom_sign128(dx * (event->y - (int128)edge->y0 * event->den) -
                      dy * (event->x - (int128)edge->x0 * event->den));
}

int sweep_turn(const struct sweep_edge *a, const struct sweep_edge *b) {
  return geom_sign64(((int64_t)a->x1 - a->x0) * ((int64_t)b->y1 - b->y0) -
                     ((int64_t)a->y1 - a->y0) * ((int64_t)b->x1 - b->x0));
}

bool sweep_crossing(const struct sweep_edge *a, const struct sweep_edge *b,
                    struct sweep_event *event) {
  struct geom_point a0 = {a->x0, a->y0, 0}, a1 = {a->x1, a->y1, 0};
  struct geom_point b0 = {b->x0, b->y0, 0}, b1 = {b->x1, b->y1, 0};
  int64_t dx = (int64_t)a->x1 - a->x0, dy = (int64_t)a->y1 - a->y0;
  int64_t ex = (int64_t)b->x1 - b->x0, ey = (int64_t)b->y1 - b->y0;
  int64_t num, den;
  if (sweep_turn(a, b) >= 0 ||
      geom_sign64(geom_orient2d(a0, a1, b0)) *
              geom_sign64(geom_orient2d(a0, a1, b1)) >=
          0 ||
      geom_sign64(geom_orient2d(b0, b1, a0)) *
              geom_sign64(geom_orient2d(b0, b1, a1)) >=
          0)
    return false;
  num = ((int64_t)b->x0 - a->x0) * ey - ((int64_t)b->y0 - a->y0) * ex;
  den = dx * ey - dy * ex;
  if (den < 0) {
    den = -den;
    num = -num;
  }
  event->x = (int128)a->x0 * den + (int128)num * dx;
  event->y = (int128)a->y0 * den + (int128)num * dy;
  event->den = den;
  event->x_near = (double)event->x / (double)den;
  event->y_near = (double)event->y / (double)den;
  return true;
}

/* ---- The heap of crossings ----------------------------------------------- */

bool sweep_add_crossing(struct sweep *sweep, const struct sweep_event *event) {
  size_t at = sweep->crossing.count;
  struct sweep_event *heap;
  if (!ARRAY_PUSH(&sweep->crossing, *event))
    return false;
  heap = sweep->crossing.item;
  while (at > 0 && sweep_event_compare(event, &heap[(at - 1) / 2]) < 0) {
    heap[at] = heap[(at - 1) / 2];
    at = (at - 1) / 2;
  }
  heap[at] = *event;
  return true;
}

void sweep_drop_crossing(struct sweep *sweep) {
  struct sweep_event *heap = sweep->crossing.item;
  size_t count = --sweep->crossing.count, at = 0;
  const struct sweep_event last = heap[count];
  for (;;) {
    size_t child = 2 * at + 1;
    if (child >= count)
      break;
    if (child + 1 < count &&
        sweep_event_compare(&heap[child + 1], &heap[child]) < 0)
      child++;
    if (sweep_event_compare(&last, &heap[child]) <= 0)
      break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = last;
}
