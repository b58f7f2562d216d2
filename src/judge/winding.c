/* winding.c - counts signed crossings along rays. */
#include "judge/winding.h"

#include "base/tolerance.h"
#include "judge/traversal.h"

struct winding {
  const struct judge_triangles *all;
  struct judge_point3 from, towards; /* towards: unit */
  int number;
  bool is_sure;
};

/* Counts a triangle that the ray meets. */
static bool count_crossing(void *user, uint32_t number) {
  struct winding *winding = user;
  const struct judge_triangle *t = &winding->all->triangle.item[number];
  double away = winding->all->size * TOLERANCE_JUDGE_CUT_SHARE / 8;
  struct judge_point3 corner[3], side[3];
  double volume[3], facing = point3_dot(t->normal, winding->towards);
  bool plus = true, minus = true, close = false;
  for (int k = 0; k < 3; k++)
    corner[k] = point3_sub(t->p[k], winding->from);
  for (int k = 0; k < 3; k++) {
    side[k] = point3_cross(corner[k], corner[(k + 1) % 3]);
    volume[k] = point3_dot(winding->towards, side[k]);
    /* The distance of the ray from the side's line. */
    double length = point3_length(point3_cross(
        winding->towards, point3_sub(corner[(k + 1) % 3], corner[k])));
    close = close || fabs(volume[k]) <= away * length;
    plus = plus && volume[k] >= -away * length;
    minus = minus && volume[k] <= away * length;
  }
  double at = point3_dot(t->normal, corner[0]) / facing;
  if (!(plus || minus) || at < -away)
    return true;
  /* On a surface that is not closed, close to a side, or to the point where the
   * ray starts, or along the triangle. */
  if (t->has_border || close || !(at > away) ||
      fabs(facing) <= TOLERANCE_JUDGE_ANGLE)
    winding->is_sure = false;
  winding->number += facing > 0 ? 1 : -1;
  return winding->is_sure;
}

enum judge_inside judge_is_inside(const struct judge_triangles *all,
                                  struct judge_point3 p) {
  /* No direction is along an axis, or in a plane that models often have. */
  static const double direction[][3] = {
      {0.3713, 0.5437, 0.7531},   {-0.6329, 0.2897, 0.7187},
      {0.4721, -0.8101, 0.3467},  {-0.2239, -0.4391, 0.8707},
      {0.8513, 0.1931, -0.4877},  {-0.5171, 0.6917, -0.5039},
      {0.3307, -0.7559, -0.5651}, {-0.7793, -0.3571, -0.5147}};
  enum { DIRECTIONS = sizeof direction / sizeof direction[0], ENOUGH = 4 };
  int sure = 0, number = 0;
  for (int i = 0; i < DIRECTIONS; i++) {
    const double *d = direction[i];
    struct winding winding = {
        .all = all,
        .from = p,
        .towards = point3_unit(judge_point3_of(d[0], d[1], d[2])),
        .is_sure = true};
    (void)judge_triangles_along(all, p, winding.towards, INFINITY,
                                count_crossing, &winding);
    if (!winding.is_sure)
      continue;
    if (sure > 0 && winding.number != number)
      return JUDGE_PERHAPS_INSIDE;
    number = winding.number;
    sure++;
  }
  /* What planes cut of a surface that is not closed may be closed in them, also
   * where rays go past it. */
  if (sure < ENOUGH || (number == 0 && all->has_border))
    return JUDGE_PERHAPS_INSIDE;
  return number != 0 ? JUDGE_INSIDE : JUDGE_OUTSIDE;
}
