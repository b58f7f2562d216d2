/* near_polygon.c - the part of a triangle that is near another one. */
#include "judge/near_polygon.h"

#include <string.h>

/* Keeps what is at most `most` before a plane. */
static void clip_near(struct near_polygon *polygon, struct judge_point3 normal,
                      struct judge_point3 at, double most) {
  struct near_polygon kept = {.count = 0};
  for (unsigned i = 0; i < polygon->count; i++) {
    struct judge_point3 a = polygon->p[i],
                        b = polygon->p[(i + 1) % polygon->count];
    double da = point3_dot(normal, point3_sub(a, at)) - most,
           db = point3_dot(normal, point3_sub(b, at)) - most;
    if (da <= 0 && kept.count < NEAR_POLYGON_CORNERS)
      kept.p[kept.count++] = a;
    if ((da <= 0) != (db <= 0) && kept.count < NEAR_POLYGON_CORNERS)
      kept.p[kept.count++] = point3_along(a, da / (da - db), point3_sub(b, a));
  }
  *polygon = kept;
}

struct near_polygon near_polygon_of(const struct judge_clipped_triangle *drawn,
                                    const struct judge_triangle *t, double by) {
  struct near_polygon part = {.count = drawn->count};
  memcpy(part.p, drawn->p, sizeof drawn->p);
  struct judge_point3 n = t->normal, back = {-n.x, -n.y, -n.z};
  clip_near(&part, n, t->p[0], by);
  clip_near(&part, back, t->p[0], by);
  for (int k = 0; k < 3; k++)
    clip_near(&part, point3_cross(point3_sub(t->p[(k + 1) % 3], t->p[k]), n),
              t->p[k], 0);
  return part;
}
