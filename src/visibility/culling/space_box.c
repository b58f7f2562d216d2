/* space_box.c - where a box in space lies on the page, and how near it is.
 *
 * With p the point less the eye, r, u and b the camera's axes, and X, Y and d
 * the view coordinates, for each axis k of space
 *     p[k] = X r[k] + Y u[k] - d b[k].
 * Orthographic: a side at p[k] = h bounds d by
 *     (X r[k] + Y u[k] - h) / b[k],
 * from below, as the viewer is in front of it, for the upper side where
 * b[k] > 0 and for the lower one where b[k] < 0; from above for the other one.
 * Perspective, with x = X / d, y = Y / d and g = b[k] - x r[k] - y u[k], which
 * is -p[k] / d: a side at h bounds 1 / d by
 *     g / -h,
 * from above where the eye is in front of it: h < 0 for the upper side, h > 0
 * for the lower one; else from below.
 *
 * Robustness  The box on the page and `nearest` are exact bounds, as each
 * operation of the projection is monotonic, rounded or not.  The planes of the
 * sides are moved towards the viewer by a bound of all rounding errors, of the
 * points' own view coordinates too.
 */
#include "visibility/culling/space_box.h"

#include <math.h>

#include "geom/vector.h"

/* Rounding errors are below this share of the magnitudes: some twenty
 * operations with an error of 2^-53 each. */
#define ROUNDING 0x1p-48

struct interval {
  double low, high;
};

/* The view coordinates of what is in the box. */
struct view_box {
  struct interval x, y, d;
};

static void grow_interval(struct interval *interval, double value) {
  interval->low = min_number(interval->low, value);
  interval->high = max_number(interval->high, value);
}

static struct view_box view_box_of(const struct camera *camera,
                                   const double low[3], const double high[3]) {
  const struct interval none = {INFINITY, -INFINITY};
  struct view_box box = {none, none, none};
  for (int k = 0; k < 8; k++) {
    const struct scene_point corner = {k & 1 ? high[0] : low[0],
                                       k & 2 ? high[1] : low[1],
                                       k & 4 ? high[2] : low[2]};
    struct view_point at = camera_view(camera, &corner);
    grow_interval(&box.x, at.x);
    grow_interval(&box.y, at.y);
    grow_interval(&box.d, at.d);
  }
  return box;
}

/* A coordinate on the page is the farther from the view axis the nearer the
 * point is. */
static struct box2 page_box_of(const struct projection *projection,
                               const struct view_box *box) {
  double low = box->d.low, high = box->d.high;
  const struct view_point corner[4] = {
      {box->x.low, 0, box->x.low < 0 ? low : high},
      {0, box->y.low, box->y.low < 0 ? low : high},
      {box->x.high, 0, box->x.high < 0 ? high : low},
      {0, box->y.high, box->y.high < 0 ? high : low}};
  return (struct box2){project_point(projection, corner[0]).x,
                       project_point(projection, corner[1]).y,
                       project_point(projection, corner[2]).x,
                       project_point(projection, corner[3]).y};
}

/* Adds the bound at + x per_x + y per_y of z, from above in front, else from
 * below; with x and y at the unit of X in an orthographic view and of X / d in
 * perspective, relative to the view axis.
 * error  of z, depth units */
static void add_bound(struct space_box *box,
                      const struct projection *projection, bool in_front,
                      double at, double per_x, double per_y, double error) {
  double x = per_x / projection->units, y = per_y / projection->units,
         x_offset = projection->offset[0], y_offset = projection->offset[1];
  error += ROUNDING * (fabs(at) + fabs(x) * (SHEET_XY_MAX + fabs(x_offset)) +
                       fabs(y) * (SHEET_XY_MAX + fabs(y_offset)));
  struct depth_bound bound = {
      at - x * x_offset - y * y_offset + (in_front ? error : -error), x, y};
  if (!isfinite(bound.at) || !isfinite(x) || !isfinite(y))
    return;
  if (in_front)
    box->front[box->fronts++] = bound;
  else
    box->back[box->backs++] = bound;
}

/* Adds the bound of a side across axis k.
 * h         its p[k]
 * is_upper  whether it is the upper one
 * most      the largest magnitude of p in the box */
static void add_side_bound(struct space_box *box, const struct camera *camera,
                           const struct projection *projection, int k, double h,
                           bool is_upper, double most) {
  double r = camera->right[k], u = camera->up[k], b = camera->back[k],
         z = projection->z_scale;
  if (!camera->perspective) {
    double slope = z / b;
    if (b != 0)
      add_bound(box, projection, is_upper == (b > 0),
                z * projection->d_max + h * slope, -slope * r, -slope * u,
                ROUNDING * most * fabs(slope));
    return;
  }
  double slope = z / -h;
  double x = (SHEET_XY_MAX + fabs(projection->offset[0])) / projection->units,
         y = (SHEET_XY_MAX + fabs(projection->offset[1])) / projection->units;
  if (h != 0)
    add_bound(box, projection, is_upper == (h < 0),
              slope * b - z / projection->d_max, -slope * r, -slope * u,
              ROUNDING * fabs(slope) * (1 + x + y) * (1 + most / fabs(h)));
}

bool space_box_project(struct space_box *box, const struct camera *camera,
                       const struct projection *projection, const double low[3],
                       const double high[3]) {
  struct view_box view = view_box_of(camera, low, high);
  const struct view_point nearest = {0, 0, view.d.low};
  double most = 0;
  if (camera->perspective && !(view.d.low >= camera->near_d))
    return false;
  *box = (struct space_box){.page = page_box_of(projection, &view),
                            .nearest =
                                (double)project_point(projection, nearest).z};
  for (int k = 0; k < 3; k++)
    most = max_number(most, max_number(fabs(low[k] - camera->eye[k]),
                                       fabs(high[k] - camera->eye[k])));
  for (int k = 0; k < 3; k++)
    for (int upper = 0; upper <= 1; upper++)
      add_side_bound(box, camera, projection, k,
                     (upper ? high[k] : low[k]) - camera->eye[k], upper, most);
  return true;
}
