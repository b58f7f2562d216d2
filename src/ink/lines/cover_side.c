/* cover_side.c - tells whether a side covers a piece of a hair. */
#include "ink/lines/cover_side.h"

#include "geom/nearest.h"

static bool is_near_side(const struct cover_side *side, double x, double y,
                         double near) {
  double dx = (double)side->b.x - side->a.x, dy = (double)side->b.y - side->a.y;
  double px = x - side->a.x, py = y - side->a.y;
  double t = geom_nearest_parameter(dx, dy, px, py);
  px -= t * dx;
  py -= t * dy;
  return px * px + py * py <= near * near;
}

/* One whose box is farther away by a grid unit, more than rounding can bring it
 * nearer, is not. */
bool cover_side_is_near(const struct cover_side *side, const double at[4],
                        double near) {
  const double a[2] = {side->a.x, side->a.y}, b[2] = {side->b.x, side->b.y};
  for (int k = 0; k < 2; k++) {
    double low = (a[k] < b[k] ? a[k] : b[k]) - near - 1;
    double high = (a[k] < b[k] ? b[k] : a[k]) + near + 1;
    if (at[k] < low || at[k + 2] < low || at[k] > high || at[k + 2] > high)
      return false;
  }
  return is_near_side(side, at[0], at[1], near) &&
         is_near_side(side, at[2], at[3], near);
}
