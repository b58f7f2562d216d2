/* cut_edges.c - intersects triangles with the planes of a cut, and these with
 * each other. */
#include "judge/cut_edges.h"

#include "base/poll.h"
#include "base/tolerance.h"
#include "judge/winding.h"

/* ---- The edges ----------------------------------------------------------- */

struct cut_edge_finder {
  struct judge_edges *edges;
  const struct judge_triangles *all;
  const struct judge_camera *camera;
};

/* Adds the part of a segment in plane k that is beyond the others. */
static bool add_cut_edge(const struct cut_edge_finder *finder, int k,
                         struct judge_point3 a, struct judge_point3 b,
                         const struct judge_source *source) {
  double t0, t1;
  struct judge_point3 along = point3_sub(b, a);
  return !judge_removed_part(&finder->all->removed, -finder->all->removed.near,
                             k, a, b, &t0, &t1) ||
         judge_edges_add_whole(finder->edges, finder->camera,
                               point3_along(a, t0, along),
                               point3_along(a, t1, along), source);
}

/* Adds the segment in which a triangle meets a plane. */
static bool add_triangle_cut(const struct cut_edge_finder *finder, int k,
                             const struct judge_triangle *t) {
  const struct judge_removed *removed = &finder->all->removed;
  struct judge_point3 end[3];
  int ends = 0;
  for (int i = 0; i < 3; i++) {
    struct judge_point3 a = t->p[i], b = t->p[(i + 1) % 3];
    double from = judge_plane_height(&removed->plane[k], a);
    double to = judge_plane_height(&removed->plane[k], b);
    if ((from < -removed->near) != (to < -removed->near))
      end[ends++] = point3_along(a, fmin(fmax(from / (from - to), 0), 1),
                                 point3_sub(b, a));
  }
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {t->face, SCENE_NONE},
                                      RECTO_EDGE_SECTION,
                                      false,
                                      0,
                                      JUDGE_CUT_OF_FACE,
                                      k};
  return ends != 2 || add_cut_edge(finder, k, end[0], end[1], &source);
}

/* Finds the line that planes j and k have in common, as far as the scene
 * reaches; false: it does not pass the scene. */
static bool find_common_line(const struct judge_triangles *all, int j, int k,
                             struct judge_point3 *from,
                             struct judge_point3 *to) {
  const struct judge_removed *removed = &all->removed;
  const struct judge_box *box = &all->node[0].box;
  struct judge_point3 middle = {(box->low[0] + box->high[0]) / 2,
                                (box->low[1] + box->high[1]) / 2,
                                (box->low[2] + box->high[2]) / 2};
  struct judge_point3 n = removed->plane[j].normal,
                      m = removed->plane[k].normal;
  struct judge_point3 along = point3_cross(n, m);
  double square = point3_dot(along, along);
  if (square < TOLERANCE_JUDGE_ANGLE * TOLERANCE_JUDGE_ANGLE)
    return false;
  /* From the middle of the box to the line, in the plane of both normals. */
  double down = -judge_plane_height(&removed->plane[j], middle);
  double over = -judge_plane_height(&removed->plane[k], middle);
  double cosine = point3_dot(n, m);
  struct judge_point3 at =
      point3_along(middle, (down - over * cosine) / square, n);
  at = point3_along(at, (over - down * cosine) / square, m);
  double reach = all->size / sqrt(square);
  *from = point3_along(at, -reach, along);
  *to = point3_along(at, reach, along);
  return point3_length(point3_sub(at, middle)) <= all->size;
}

/* Adds the line that two planes have in common.  Both planes have it: it is
 * beyond the third one, or that is one of them again. */
static bool add_common_line(const struct cut_edge_finder *finder, int j,
                            int k) {
  const struct judge_removed *removed = &finder->all->removed;
  struct judge_point3 from, to;
  double t0 = 0, t1 = 1;
  if (!find_common_line(finder->all, j, k, &from, &to))
    return true;
  for (int other = 0; other < removed->planes; other++) {
    double a = judge_plane_height(&removed->plane[other], from) + removed->near;
    double b = judge_plane_height(&removed->plane[other], to) + removed->near;
    if (other == j || other == k)
      continue;
    if (a < 0 && b < 0)
      return true;
    t0 = a < 0 ? fmax(t0, a / (a - b)) : t0;
    t1 = b < 0 ? fmin(t1, a / (a - b)) : t1;
  }
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {SCENE_NONE, SCENE_NONE},
                                      RECTO_EDGE_SECTION,
                                      false,
                                      0,
                                      JUDGE_CUT_OF_PLANES,
                                      k};
  struct judge_point3 along = point3_sub(to, from);
  return t0 >= t1 ||
         judge_edges_add_whole(finder->edges, finder->camera,
                               point3_along(from, t0, along),
                               point3_along(from, t1, along), &source);
}

bool judge_edges_add_cuts(struct judge_edges *edges,
                          const struct judge_triangles *all,
                          const struct judge_camera *camera) {
  const struct cut_edge_finder finder = {edges, all, camera};
  bool ok = true;
  for (int k = 0; ok && all->nodes > 0 && k < all->removed.planes; k++) {
    for (size_t t = 0; ok && t < all->triangle.count; t++)
      ok = poll_at(t) && add_triangle_cut(&finder, k, &all->triangle.item[t]);
    for (int j = 0; ok && j < k; j++)
      ok = add_common_line(&finder, j, k);
  }
  return ok;
}

/* ---- Questions ----------------------------------------------------------- */

/* Whether just below all planes that it is in or beyond, a point is inside. */
static enum judge_inside is_inside_below(const struct judge_triangles *all,
                                         struct judge_point3 p, double depth) {
  for (int k = 0; k < all->removed.planes; k++) {
    const struct judge_plane *plane = &all->removed.plane[k];
    if (fabs(judge_plane_height(plane, p)) <= depth)
      p = point3_along(p, -depth, plane->normal);
  }
  return judge_is_inside(all, p);
}

/* Whether plane k has a cut face at a point that lies in it: what is beyond the
 * point is beyond the other planes too, and what is below it is inside. */
static enum judge_inside is_in_cut_face(const struct judge_triangles *all,
                                        int k, struct judge_point3 p,
                                        double depth) {
  const struct judge_removed *removed = &all->removed;
  for (int j = 0; j < removed->planes; j++)
    if (j != k && judge_plane_height(&removed->plane[j], p) < -depth)
      return JUDGE_OUTSIDE;
  return is_inside_below(all, p, depth);
}

/* Whether planes meet at a point in a line of the drawing: it is between two
 * cut faces. */
static enum judge_visibility
common_line_exists(const struct judge_triangles *all, struct judge_point3 at,
                   double depth, double beside) {
  const struct judge_removed *removed = &all->removed;
  int sides = 0, inside = 0, outside = 0;
  for (int i = 0; i < removed->planes; i++)
    for (int j = 0; j < removed->planes; j++) {
      const struct judge_plane *p = &removed->plane[i], *q = &removed->plane[j];
      struct judge_point3 along =
          point3_along(q->normal, -point3_dot(p->normal, q->normal), p->normal);
      if (i == j || point3_length(along) < TOLERANCE_JUDGE_ANGLE ||
          fabs(judge_plane_height(p, at)) > depth ||
          fabs(judge_plane_height(q, at)) > depth)
        continue;
      enum judge_inside here = is_in_cut_face(
          all, i, point3_along(at, beside, point3_unit(along)), depth);
      sides++;
      inside += here == JUDGE_INSIDE;
      outside += here == JUDGE_OUTSIDE;
    }
  return inside == sides    ? JUDGE_CLEAR
         : outside == sides ? JUDGE_BLOCKED
                            : JUDGE_UNSURE;
}

enum judge_visibility judge_cut_exists(const struct judge_triangles *all,
                                       const struct judge_edge *edge,
                                       struct judge_point3 at, double beside) {
  const struct judge_source *source = &edge->source;
  double depth = 2 * all->removed.near;
  beside = fmax(beside, 2 * depth);
  if (source->cut == JUDGE_CUT_NONE)
    return JUDGE_CLEAR;
  if (source->cut == JUDGE_CUT_BESIDE)
    return JUDGE_UNSURE;
  if (source->cut == JUDGE_CUT_OF_PLANES)
    return common_line_exists(all, at, depth, beside);
  struct judge_point3 across =
      point3_unit(point3_cross(all->removed.plane[source->plane].normal,
                               point3_sub(edge->p[1], edge->p[0])));
  enum judge_inside one = is_in_cut_face(
      all, source->plane, point3_along(at, beside, across), depth);
  enum judge_inside two = is_in_cut_face(
      all, source->plane, point3_along(at, -beside, across), depth);
  return one != two && one != JUDGE_PERHAPS_INSIDE &&
                 two != JUDGE_PERHAPS_INSIDE
             ? JUDGE_CLEAR
             : JUDGE_UNSURE;
}

enum judge_visibility judge_cut_hides(const struct judge_triangles *all,
                                      const struct judge_ray *ray) {
  const struct judge_removed *removed = &all->removed;
  enum judge_visibility most = JUDGE_CLEAR;
  for (int k = 0; k < removed->planes && most != JUDGE_BLOCKED; k++) {
    double height = judge_plane_height(&removed->plane[k], ray->from);
    double slope = point3_dot(removed->plane[k].normal, ray->towards);
    double t = -height / slope, depth = INFINITY;
    if (fabs(height) <= fmax(ray->margin.plane_error, removed->near) ||
        !(t > 0 && t < ray->t_max))
      continue;
    struct judge_point3 at = point3_along(ray->from, t, ray->towards);
    for (int j = 0; j < removed->planes; j++)
      if (j != k)
        depth = fmin(depth, judge_plane_height(&removed->plane[j], at));
    if (depth < -removed->near)
      continue;
    enum judge_inside inside = is_inside_below(all, at, 2 * removed->near);
    bool is_sure =
        inside == JUDGE_INSIDE && depth > removed->near && t < ray->sure &&
        fabs(height) > 1.5 * removed->contact + 4 * ray->margin.rounding;
    if (inside != JUDGE_OUTSIDE)
      most = is_sure ? JUDGE_BLOCKED : JUDGE_UNSURE;
  }
  return most;
}
