/* ray.c - casts a ray from a point of an edge to the eye. */
#include "judge/ray.h"

#include "judge/camera.h"
#include "judge/traversal.h"

/* ---- Rays ---------------------------------------------------------------- */

/* Whether the ray's line meets the triangle: the signed volumes of the line
 * with its three sides have one sign (Pluecker test).  A line through a side
 * meets the triangle, so that no line passes between two neighbours. */
static bool line_meets_triangle(const struct judge_ray *ray,
                                const struct judge_triangle *t) {
  struct judge_point3 a = point3_sub(t->p[0], ray->from);
  struct judge_point3 b = point3_sub(t->p[1], ray->from);
  struct judge_point3 c = point3_sub(t->p[2], ray->from);
  double u = point3_dot(ray->towards, point3_cross(a, b));
  double v = point3_dot(ray->towards, point3_cross(b, c));
  double w = point3_dot(ray->towards, point3_cross(c, a));
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/* Whether the ray meets the triangle's plane before t_max. */
static enum judge_visibility ray_meets_plane(const struct judge_ray *ray,
                                             const struct judge_triangle *t) {
  double at = point3_dot(t->normal, point3_sub(t->p[0], ray->from)) /
              point3_dot(t->normal, ray->towards);
  if (!(at > 0 && at < ray->t_max))
    return JUDGE_CLEAR;
  return at < ray->sure ? JUDGE_BLOCKED : JUDGE_UNSURE;
}

/* ---- Planes -------------------------------------------------------------- */

static double triangle_distance(const struct judge_triangle *t,
                                struct judge_point3 from) {
  return fabs(point3_dot(t->normal, point3_sub(t->p[0], from)));
}

/* Decides by the distance of a triangle's plane whether it may hide a point:
 *   up to 0.5 contact + plane_error, but at most contact: clear
 *   up to 1.5 contact + 4 rounding: undecided
 *   above: blocked
 * The limit of clear keeps a plane beyond the contact tolerance from being
 * ignored where contact is 0, a case that the page grid decides. */
static enum judge_visibility
classify_distance(const struct judge_triangle *t, struct judge_point3 from,
                  const struct judge_error_bound *margin) {
  double away = triangle_distance(t, from);
  if (away <= fmin(0.5 * t->contact + margin->plane_error, t->contact))
    return JUDGE_CLEAR;
  return away <= 1.5 * t->contact + 4 * margin->rounding ? JUDGE_UNSURE
                                                         : JUDGE_BLOCKED;
}

/* Whether a point is a corner of a triangle. */
enum shared_end { SHARED_NO, SHARED_PERHAPS, SHARED };

static enum shared_end corner_is_at(struct judge_point3 corner,
                                    const struct judge_end *end) {
  struct judge_point3 away = point3_sub(corner, end->position);
  if (away.x == 0 && away.y == 0 && away.z == 0)
    return SHARED;
  return fabs(away.x) + fabs(away.y) + fabs(away.z) <= end->near
             ? SHARED_PERHAPS
             : SHARED_NO;
}

/* Whether the image of a face is wholly inside the margins. */
static bool is_whole(const struct scene *scene,
                     const struct judge_camera *camera, uint32_t start,
                     uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    struct judge_point3 at =
        judge_point3_at(scene, scene->corner.item[start + i]);
    if (!(judge_view_depth(camera, at) > camera->near_d))
      return false;
    struct judge_point2 on = judge_project(camera, at);
    double low = camera->margin_mm;
    if (!(on.x >= low && on.x <= camera->width_mm - low && on.y >= low &&
          on.y <= camera->height_mm - low))
      return false;
  }
  return true;
}

/* Whether a cut may have made an end of the edge a corner of the triangle: both
 * the triangle's plane and one of the cut contain it. */
static bool cut_may_share(const struct judge_triangles *all,
                          const struct judge_triangle *t,
                          const struct judge_end *end) {
  bool shares = false;
  for (int k = 0; k < all->removed.planes; k++)
    shares |= fabs(judge_plane_height(&all->removed.plane[k], end->position)) <=
              all->removed.near;
  return shares && triangle_distance(t, end->position) <=
                       all->removed.near + end->margin.plane_error;
}

/* Whether an end of the edge is a corner of the triangle.  It is undecided for
 * faces of more corners and for those that the page, the near plane or a cut
 * clips: the judge does not know the drawing's triangles of these. */
static enum shared_end triangle_shares(const struct judge_ray *ray,
                                       const struct judge_triangles *all,
                                       const struct judge_triangle *t,
                                       const struct judge_end *end) {
  const struct scene *scene = all->scene;
  uint32_t start = scene_face_start(scene, t->face);
  uint32_t count = scene_face_start(scene, t->face + 1) - start;
  enum shared_end most = SHARED_NO;
  for (uint32_t i = 0; i < count && most != SHARED; i++) {
    enum shared_end here = corner_is_at(
        judge_point3_at(scene, scene->corner.item[start + i]), end);
    most = here > most ? here : most;
  }
  bool sure = most == SHARED && count == 3 && !end->is_cut &&
              is_whole(scene, ray->camera, start, count);
  if (most == SHARED_NO && cut_may_share(all, t, end))
    return SHARED_PERHAPS;
  return most == SHARED && !sure ? SHARED_PERHAPS : most;
}

/* The point in which the segment from a triangle's corner to a point leaves the
 * triangle's image, by crossing the plane through the opposite side and the
 * eye; the end of the segment where it does not. */
static struct judge_point3 exit_point(const struct judge_ray *ray,
                                      const struct judge_triangle *t,
                                      struct judge_point3 corner,
                                      struct judge_point3 to) {
  const struct judge_camera *camera = ray->camera;
  int k = 0;
  while (k < 3 && point3_length(point3_sub(t->p[k], corner)) > 0)
    k++;
  if (k == 3)
    return to;
  struct judge_point3 a = t->p[(k + 1) % 3], b = t->p[(k + 2) % 3];
  struct judge_point3 towards =
      camera->perspective ? point3_sub(camera->eye, a) : camera->back;
  struct judge_point3 normal = point3_cross(point3_sub(b, a), towards);
  double from = point3_dot(normal, point3_sub(corner, a));
  double past = point3_dot(normal, point3_sub(to, a));
  return (from > 0) == (past > 0) || from == 0
             ? to
             : point3_along(corner, from / (from - past),
                            point3_sub(to, corner));
}

/* Decides by the distance of the plane at the point where the edge, coming from
 * one end, ends or leaves the triangle. */
static enum judge_visibility classify_at_exit(const struct judge_ray *ray,
                                              const struct judge_triangle *t,
                                              struct judge_point3 corner,
                                              const struct judge_end *end) {
  enum judge_visibility visibility = classify_distance(
      t, exit_point(ray, t, corner, end->position), &end->margin);
  return visibility == classify_distance(t,
                                         exit_point(ray, t, corner, end->cut),
                                         &end->cut_margin)
             ? visibility
             : JUDGE_UNSURE;
}

/* Decides by the distance of the plane, measured as ray.h explains. */
static enum judge_visibility classify_plane(const struct judge_triangles *all,
                                            const struct judge_ray *ray,
                                            const struct judge_triangle *t) {
  enum judge_visibility here = classify_distance(t, ray->from, &ray->margin);
  enum judge_visibility there[2];
  enum shared_end shared[2];
  for (int k = 0; k < 2; k++) {
    there[k] = classify_at_exit(ray, t, ray->end[k].position, &ray->end[1 - k]);
    shared[k] = here == JUDGE_BLOCKED || there[k] == here
                    ? SHARED_NO
                    : triangle_shares(ray, all, t, &ray->end[k]);
  }
  /* If the triangle has both ends the edge lies in its plane: undecided, see
   * below. */
  if (shared[0] == SHARED_NO && shared[1] == SHARED_NO)
    return here;
  if (shared[0] == SHARED && shared[1] == SHARED_NO)
    return there[0];
  if (shared[1] == SHARED && shared[0] == SHARED_NO)
    return there[1];
  return JUDGE_UNSURE;
}

static bool is_triangle_corner(const struct judge_triangle *t,
                               struct judge_point3 position) {
  for (int k = 0; k < 3; k++)
    if (t->p[k].x == position.x && t->p[k].y == position.y &&
        t->p[k].z == position.z)
      return true;
  return false;
}

/* Whether the edge lies in the triangle's plane because it belongs to the same
 * face; in a face that is not planar, because it is a side of the triangle. */
static bool is_own(const struct judge_ray *ray,
                   const struct judge_triangle *t) {
  return (t->face == ray->own[0] || t->face == ray->own[1]) &&
         triangle_distance(t, ray->from) <=
             0.5 * t->contact + ray->margin.plane_error &&
         (!t->bent || (is_triangle_corner(t, ray->end[0].position) &&
                       is_triangle_corner(t, ray->end[1].position)));
}

/* What a triangle may do to the edge: a planar face hides none of its own
 * edges, though the planes of its triangles may differ by more than contact. */
static enum judge_visibility most_hidden(const struct judge_ray *ray,
                                         const struct judge_triangle *t) {
  if ((t->face != ray->own[0] && t->face != ray->own[1]) ||
      t->off_plane > 1.5 * t->planar + ray->margin.plane_error)
    return JUDGE_BLOCKED;
  return t->off_plane <= 0.5 * t->planar ? JUDGE_CLEAR : JUDGE_UNSURE;
}

static enum judge_visibility
test_ray_triangle(const struct judge_triangles *all,
                  const struct judge_ray *ray, const struct judge_triangle *t) {
  if (!line_meets_triangle(ray, t) || is_own(ray, t))
    return JUDGE_CLEAR;
  enum judge_visibility visibility = classify_plane(all, ray, t);
  if (visibility == JUDGE_CLEAR)
    return visibility;
  if (triangle_distance(t, ray->from) <= ray->margin.plane_error)
    return JUDGE_UNSURE;
  enum judge_visibility met = ray_meets_plane(ray, t);
  enum judge_visibility most = most_hidden(ray, t);
  most = met < most ? met : most;
  return most < visibility ? most : visibility;
}

/* ---- All triangles ------------------------------------------------------- */

/* What has been found along a ray. */
struct ray_state {
  const struct judge_triangles *all;
  const struct judge_ray *ray;
  enum judge_visibility visibility;
  uint32_t *face;
};

/* Where the ray meets a triangle it may be removed. */
static enum judge_visibility most_after_cut(const struct judge_triangles *all,
                                            const struct judge_ray *ray,
                                            const struct judge_triangle *t) {
  double at = point3_dot(t->normal, point3_sub(t->p[0], ray->from)) /
              point3_dot(t->normal, ray->towards);
  double depth = judge_removed_depth(&all->removed,
                                     point3_along(ray->from, at, ray->towards));
  if (depth > all->removed.near)
    return JUDGE_CLEAR;
  return depth < -all->removed.near && !t->bent ? JUDGE_BLOCKED : JUDGE_UNSURE;
}

static bool look_at_triangle(void *user, uint32_t number) {
  struct ray_state *state = user;
  const struct judge_triangles *all = state->all;
  const struct judge_triangle *t = &all->triangle.item[number];
  enum judge_visibility seen = test_ray_triangle(all, state->ray, t);
  if (seen == JUDGE_BLOCKED && t->open)
    seen = JUDGE_UNSURE;
  if (seen != JUDGE_CLEAR && all->removed.planes > 0) {
    enum judge_visibility most = most_after_cut(all, state->ray, t);
    seen = most < seen ? most : seen;
  }
  if (seen > state->visibility)
    state->visibility = seen;
  if (seen == JUDGE_BLOCKED && state->face != NULL)
    *state->face = t->face;
  return seen != JUDGE_BLOCKED;
}

enum judge_visibility judge_cast_ray(const struct judge_triangles *all,
                                     const struct judge_ray *ray,
                                     uint32_t *face) {
  struct ray_state state = {all, ray, JUDGE_CLEAR, face};
  (void)judge_triangles_along(all, ray->from, ray->towards, ray->t_max,
                              look_at_triangle, &state);
  return state.visibility;
}
