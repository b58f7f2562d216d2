/* cover_side.c - tells whether a side covers a piece of a hair. */
#include "ink/lines/cover_side.h"

#include "geom/nearest.h"
#include "geom/vector.h"

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
 * nearer, is not; most are, and one jump tells. */
bool cover_side_is_near(const struct cover_side *side, const double at[4],
                        double near) {
  const int32_t a[2] = {side->a.x, side->a.y}, b[2] = {side->b.x, side->b.y};
  bool is_beside = false;
  for (int k = 0; k < 2; k++) {
    int32_t least = a[k] < b[k] ? a[k] : b[k], most = a[k] < b[k] ? b[k] : a[k];
    double low = least - near - 1, high = most + near + 1;
    is_beside |= (min_number(at[k], at[k + 2]) < low) |
                 (max_number(at[k], at[k + 2]) > high);
  }
  if (is_beside)
    return false;
  return is_near_side(side, at[0], at[1], near) &&
         is_near_side(side, at[2], at[3], near);
}
