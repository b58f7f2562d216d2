/* sampler.c - decides by rays whether a point of an edge is visible: sets up
 * the rays and the distance that a plane must have to hide it. */
#include "judge/sampler.h"

#include "judge/camera.h"
#include "judge/cut_edges.h"

#include "base/tolerance.h"

/* ---- On the page --------------------------------------------------------- */

bool judge_clip_to_page(const struct judge_camera *camera,
                        struct judge_point2 a, struct judge_point2 b,
                        double *t0, double *t1) {
  const double from[2] = {a.x, a.y}, to[2] = {b.x, b.y};
  const double low = camera->margin_mm;
  const double high[2] = {camera->width_mm - low, camera->height_mm - low};
  *t0 = 0;
  *t1 = 1;
  for (int k = 0; k < 2; k++) {
    double d = to[k] - from[k];
    if (d == 0 && (from[k] < low || from[k] > high[k]))
      return false;
    if (d == 0)
      continue;
    double in = (low - from[k]) / d, out = (high[k] - from[k]) / d;
    *t0 = fmax(*t0, fmin(in, out));
    *t1 = fmin(*t1, fmax(in, out));
  }
  return *t0 <= *t1;
}

bool judge_clip_to_circle(const struct judge_camera *camera,
                          struct judge_point2 a, struct judge_point2 b,
                          double *t0, double *t1) {
  const struct judge_circle *circle = &camera->circle;
  double ux = b.x - a.x, uy = b.y - a.y;
  double vx = a.x - circle->x_mm, vy = a.y - circle->y_mm;
  double uu = ux * ux + uy * uy, uv = ux * vx + uy * vy;
  double away = vx * vx + vy * vy - circle->radius_mm * circle->radius_mm;
  double root = uv * uv - uu * away;
  if (circle->radius_mm == 0)
    return true;
  if (!(uu > 0 && root > 0))
    return false;
  *t0 = fmax(*t0, (-uv - sqrt(root)) / uu);
  *t1 = fmin(*t1, (-uv + sqrt(root)) / uu);
  return *t0 <= *t1;
}

struct judge_point3 judge_point3_of_image(const struct judge_edge *edge,
                                          double t) {
  double one = (1 - t) * edge->depth[1], two = t * edge->depth[0];
  return point3_along(edge->p[0], two / (one + two),
                      point3_sub(edge->p[1], edge->p[0]));
}

/* ---- Margins ------------------------------------------------------------- */

double judge_rounding_at(const struct judge_camera *camera,
                         double ray_offset_mm, struct judge_point3 at) {
  double depth = judge_homogeneous_w(camera, at);
  double offset =
      point3_length(point3_sub(judge_shift(camera, at, ray_offset_mm, 0), at));
  return offset + camera->depth_contact * depth * depth;
}

static void find_sampled_ends(const struct judge_sampler *sampler,
                              const struct judge_edge *edge,
                              struct judge_end end[2]) {
  double t[2];
  bool seen = judge_clip_to_page(sampler->camera, edge->at[0], edge->at[1],
                                 &t[0], &t[1]);
  for (int k = 0; k < 2; k++) {
    end[k].position = end[k].cut = edge->p[k];
    end[k].is_cut = seen && t[k] != k;
    if (end[k].is_cut)
      end[k].cut = judge_point3_of_image(edge, t[k]);
    double rounding = judge_rounding_at(sampler->camera, sampler->ray_offset_mm,
                                        end[k].position);
    end[k].near = 4 * rounding;
    end[k].margin = (struct judge_error_bound){rounding, 2 * rounding};
    rounding =
        judge_rounding_at(sampler->camera, sampler->ray_offset_mm, end[k].cut);
    end[k].cut_margin = (struct judge_error_bound){rounding, 2 * rounding};
  }
}

/* Casts a ray from a point towards the eye.
 * aside  the point is ray_offset_mm off the edge, and so off the edge's own
 *        faces */
static enum judge_visibility cast_ray(const struct judge_sampler *sampler,
                                      const struct judge_edge *edge,
                                      const struct judge_end end[2],
                                      struct judge_point3 from, bool aside,
                                      uint32_t *blocker) {
  const struct judge_camera *camera = sampler->camera;
  double rounding = judge_rounding_at(camera, sampler->ray_offset_mm, from);
  double plane_error =
      aside ? 2 * rounding : sampler->all->size * TOLERANCE_EXTENT_SHARE;
  double tolerance = judge_near_tolerance(camera);
  double near = judge_near(camera), sure = camera->near_d + tolerance;
  struct judge_ray ray = {.camera = camera,
                          .from = from,
                          .margin = {rounding, plane_error},
                          .own = {edge->source.face[0], edge->source.face[1]},
                          .end = {end[0], end[1]}};
  if (camera->perspective) {
    ray.towards = point3_sub(camera->eye, from);
    ray.t_max = 1 - near / judge_homogeneous_w(camera, from);
    ray.sure = 1 - sure / judge_homogeneous_w(camera, from);
  } else {
    ray.towards = camera->back;
    ray.t_max = judge_view_depth(camera, from) - near;
    ray.sure = judge_view_depth(camera, from) - sure;
  }
  enum judge_visibility by_faces = judge_cast_ray(sampler->all, &ray, blocker);
  enum judge_visibility by_cut = by_faces == JUDGE_BLOCKED
                                     ? JUDGE_CLEAR
                                     : judge_cut_hides(sampler->all, &ray);
  return by_cut > by_faces ? by_cut : by_faces;
}

/* The visibility of a point of an edge, by the point and by those at
 * ray_offset_mm to either side: `expected` where all have it, else that of the
 * first that has another. */
enum judge_visibility judge_sample_around(const struct judge_sampler *sampler,
                                          const struct judge_edge *edge,
                                          struct judge_point3 from,
                                          enum judge_visibility expected,
                                          uint32_t *blocker) {
  double dx = edge->at[1].x - edge->at[0].x;
  double dy = edge->at[1].y - edge->at[0].y;
  double length = hypot(dx, dy), offset = sampler->ray_offset_mm;
  double x = length > 0 ? -dy / length * offset : offset;
  double y = length > 0 ? dx / length * offset : 0;
  struct judge_end end[2];
  find_sampled_ends(sampler, edge, end);
  enum judge_visibility visibility =
      cast_ray(sampler, edge, end, from, false, blocker);
  if (visibility != expected)
    return visibility;
  visibility =
      cast_ray(sampler, edge, end, judge_shift(sampler->camera, from, x, y),
               true, blocker);
  if (visibility != expected)
    return visibility;
  return cast_ray(sampler, edge, end,
                  judge_shift(sampler->camera, from, -x, -y), true, blocker);
}

enum judge_visibility judge_sample_point(const struct judge_sampler *sampler,
                                         const struct judge_edge *edge,
                                         struct judge_point3 from) {
  struct judge_end end[2];
  find_sampled_ends(sampler, edge, end);
  return cast_ray(sampler, edge, end, from, false, NULL);
}
