/* edge_list.c - the edges of a scene, clipped and projected.
 */
#include "judge/edge_list.h"

#include "base/tolerance.h"
#include "judge/camera.h"

/* A segment by its end that is farther in front of the eye.  The image of that
 * end and the direction from there are accurate, so that the line that they
 * make is, however near to the eye it is clipped. */
struct ray_to_eye {
  struct judge_point3 origin, along; /* origin + t along, t 0 to 1 */
  struct judge_homogeneous from, by; /* their homogeneous coordinates */
};

static struct judge_point2 image_on(const struct ray_to_eye *ray, double t) {
  struct judge_point2 at = {ray->from.x / ray->from.w,
                            ray->from.y / ray->from.w};
  double part = t / (ray->from.w + t * ray->by.w);
  return (struct judge_point2){at.x + part * (ray->by.x - at.x * ray->by.w),
                               at.y + part * (ray->by.y - at.y * ray->by.w)};
}

/* Keeps of t[0] to t[1] where a function is not negative that is `value` at 0
 * and grows by `growth`. */
static void keep_positive(double value, double growth, double t[2]) {
  double root = -value / growth;
  if (growth > 0)
    t[0] = fmax(t[0], root);
  else if (growth < 0)
    t[1] = fmin(t[1], root);
  else if (value < 0)
    t[1] = -1;
}

/* Clips to what is `least` in front of the eye or farther, and whose image is
 * within TOLERANCE_JUDGE_IMAGE_MM of the page's origin.  Returns false where
 * nothing is left. */
static bool clip_ray(const struct ray_to_eye *ray, double depth, double slope,
                     double least, double t[2]) {
  const double limit = TOLERANCE_JUDGE_IMAGE_MM;
  const double from[2] = {ray->from.x, ray->from.y};
  const double by[2] = {ray->by.x, ray->by.y};
  t[0] = 0;
  t[1] = 1;
  if (isfinite(least))
    keep_positive(depth - least, slope, t);
  for (int k = 0; k < 2; k++)
    for (int sign = -1; sign <= 1; sign += 2)
      keep_positive(limit * ray->from.w + sign * from[k],
                    limit * ray->by.w + sign * by[k], t);
  return t[0] < t[1];
}

bool judge_edges_add_whole(struct judge_edges *edges,
                           const struct judge_camera *camera,
                           struct judge_point3 a, struct judge_point3 b,
                           const struct judge_source *source) {
  double da = judge_view_depth(camera, a), db = judge_view_depth(camera, b);
  double least = judge_near(camera), t[2];
  if (camera->perspective) /* where rounding may be all that there is */
    least = fmax(least, TOLERANCE_JUDGE_EYE_SHARE * (fabs(da) + fabs(db)));
  bool swap = db > da;
  struct ray_to_eye ray = {.origin = swap ? b : a,
                           .along = swap ? point3_sub(a, b) : point3_sub(b, a)};
  ray.from = judge_homogeneous_of(camera, ray.origin);
  ray.by = judge_homogeneous_along(camera, ray.along);
  if (fmax(da, db) <= least ||
      !clip_ray(&ray, fmax(da, db), fmin(da, db) - fmax(da, db), least, t))
    return true;
  struct judge_edge edge = {.source = *source};
  for (int k = 0; k < 2; k++) {
    double at = t[swap ? 1 - k : k];
    bool clipped = at > 0 && at < 1;
    edge.p[k] = clipped  ? point3_along(ray.origin, at, ray.along)
                : k == 0 ? a
                         : b;
    edge.at[k] =
        clipped ? image_on(&ray, at) : judge_project(camera, edge.p[k]);
    edge.depth[k] = clipped ? ray.from.w + at * ray.by.w
                            : judge_homogeneous_w(camera, edge.p[k]);
  }
  return ARRAY_PUSH(&edges->edge, edge);
}

/* Adds the part of an edge from t0 to t1. */
static bool add_stretch(struct judge_edges *edges,
                        const struct judge_camera *camera,
                        struct judge_point3 a, struct judge_point3 b, double t0,
                        double t1, const struct judge_source *source) {
  struct judge_point3 along = point3_sub(b, a);
  return t0 >= t1 ||
         judge_edges_add_whole(
             edges, camera, t0 <= 0 ? a : point3_along(a, t0, along),
             t1 >= 1 ? b : point3_along(a, t1, along), source);
}

/* Whether a segment lies in a plane of a cut, as far as doubles decide that. */
static bool lies_in_plane(const struct judge_removed *removed,
                          struct judge_point3 a, struct judge_point3 b) {
  for (int k = 0; k < removed->planes; k++)
    if (fabs(judge_plane_height(&removed->plane[k], a)) <= removed->near &&
        fabs(judge_plane_height(&removed->plane[k], b)) <= removed->near)
      return true;
  return false;
}

bool judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_point3 a,
                     struct judge_point3 b, const struct judge_source *source) {
  const struct judge_removed *removed = edges->removed;
  double from, to, surely_from = 1, surely_to = 1;
  struct judge_source beside = *source;
  beside.cut = JUDGE_CUT_BESIDE;
  /* Faces that intersect in a plane are divided there, at rounded points. */
  if (removed != NULL && source->point[0] == SCENE_NONE &&
      lies_in_plane(removed, a, b))
    return judge_edges_add_whole(edges, camera, a, b, &beside);
  if (removed == NULL ||
      !judge_removed_part(removed, -removed->near, -1, a, b, &from, &to))
    return judge_edges_add_whole(edges, camera, a, b, source);
  if (!judge_removed_part(removed, removed->near, -1, a, b, &surely_from,
                          &surely_to))
    surely_from = surely_to = to;
  return add_stretch(edges, camera, a, b, 0, from, source) &&
         add_stretch(edges, camera, a, b, from, surely_from, &beside) &&
         add_stretch(edges, camera, a, b, surely_to, to, &beside) &&
         add_stretch(edges, camera, a, b, to, 1, source);
}

void judge_edges_fini(struct judge_edges *edges) {
  ARRAY_FREE(&edges->edge);
  mem_free(edges->border);
  edges->border = NULL;
}
