/* intersections.c - finds the lines along which triangles intersect. */
#include <string.h>

#include "judge/intersections.h"

#include "judge/camera.h"
#include "judge/sampler.h"

struct intersection_finder {
  struct judge_edges *edges;
  const struct judge_triangles *all;
  const struct judge_camera *camera;
  double hair_mm;
  uint32_t current; /* the triangle whose neighbours are looked up */
};

/* ---- On the page --------------------------------------------------------- */

/* A triangle clipped by five planes has at most eight corners. */
struct triangle_outline {
  struct judge_point3 p[8];
  unsigned count;
};

/* Clips a convex polygon by one plane (Sutherland-Hodgman).
 * where  signed distance of each corner, negative outside */
static struct triangle_outline
clip_by_plane(const struct triangle_outline *from, const double where[8]) {
  struct triangle_outline kept = {.count = 0};
  for (unsigned i = 0; i < from->count; i++) {
    unsigned k = i + 1 == from->count ? 0 : i + 1;
    if (where[i] >= 0)
      kept.p[kept.count++] = from->p[i];
    if ((where[i] >= 0) != (where[k] >= 0))
      kept.p[kept.count++] =
          point3_along(from->p[i], where[i] / (where[i] - where[k]),
                       point3_sub(from->p[k], from->p[i]));
  }
  return kept;
}

/* Clips a triangle to the page's margins and the near plane.  The homogeneous
 * coordinates, depth times page coordinates, are linear in space, so each
 * border is a plane. */
static struct triangle_outline clip_to_page(const struct judge_camera *camera,
                                            const struct judge_triangle *t) {
  struct triangle_outline outline = {{t->p[0], t->p[1], t->p[2]}, 3};
  double low = camera->margin_mm;
  double right = camera->width_mm - low, top = camera->height_mm - low;
  for (int side = 0; side < 5; side++) {
    double where[8];
    for (unsigned i = 0; i < outline.count; i++) {
      double depth = judge_depth(camera, outline.p[i]);
      struct judge_point2 at = judge_project(camera, outline.p[i]);
      const double inside[5] = {judge_ahead(camera, outline.p[i]) -
                                    judge_near(camera),
                                (at.x - low) * depth, (right - at.x) * depth,
                                (at.y - low) * depth, (top - at.y) * depth};
      where[i] = inside[side];
    }
    outline = clip_by_plane(&outline, where);
  }
  return outline;
}

/* How far the clipped triangle extends from a plane to either side; the lesser
 * of the two distances. */
static double least_overshoot(const struct judge_camera *camera,
                              const struct judge_triangle *t,
                              const struct judge_triangle *plane) {
  struct triangle_outline outline = clip_to_page(camera, t);
  double before = 0, behind = 0;
  for (unsigned i = 0; i < outline.count; i++) {
    double away =
        point3_dot(plane->normal, point3_sub(outline.p[i], plane->p[0]));
    before = fmax(before, away);
    behind = fmax(behind, -away);
  }
  return fmin(before, behind);
}

/* ---- In space ------------------------------------------------------------ */

/* The points in which a triangle's sides cross a plane: at most two. */
struct triangle_cut {
  struct judge_point3 end[2];
  unsigned count;
};

static struct triangle_cut cut_by_plane(const struct judge_triangle *t,
                                        const struct judge_triangle *plane) {
  struct triangle_cut cut = {.count = 0};
  double away[3];
  for (int k = 0; k < 3; k++)
    away[k] = point3_dot(plane->normal, point3_sub(t->p[k], plane->p[0]));
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3;
    if ((away[k] > 0) == (away[l] > 0) || cut.count == 2)
      continue;
    cut.end[cut.count++] = point3_along(t->p[k], away[k] / (away[k] - away[l]),
                                        point3_sub(t->p[l], t->p[k]));
  }
  return cut;
}

static bool is_same(struct judge_point3 a, struct judge_point3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The corners that two triangles share; returns their number. */
static unsigned shared_corners(const struct judge_triangle *s,
                               const struct judge_triangle *t,
                               struct judge_point3 corner[3]) {
  unsigned shared = 0;
  for (int i = 0; i < 3; i++) {
    int k = 0;
    while (k < 3 && !is_same(s->p[i], t->p[k]))
      k++;
    if (k < 3)
      corner[shared++] = s->p[i];
  }
  return shared;
}

/* If two triangles share a corner, their intersection ends there: makes its
 * nearer end equal to the corner in all bits. */
static void snap_to_corner(const struct judge_triangle *s,
                           const struct judge_triangle *t,
                           struct judge_point3 *a, struct judge_point3 *b) {
  struct judge_point3 corner[3];
  if (shared_corners(s, t, corner) == 0)
    return;
  bool is_first = point3_length(point3_sub(*a, corner[0])) <
                  point3_length(point3_sub(*b, corner[0]));
  *(is_first ? a : b) = corner[0];
}

/* Whether a face has a side between two corners. */
static bool has_side(const struct scene *scene, uint32_t face,
                     const struct judge_point3 end[2]) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  const uint32_t *corner = scene->corner.item + start;
  for (uint32_t i = 0; i < count; i++) {
    struct judge_point3 p = judge_point3_at(scene, corner[i]);
    struct judge_point3 q = judge_point3_at(scene, corner[(i + 1) % count]);
    if ((is_same(p, end[0]) && is_same(q, end[1])) ||
        (is_same(p, end[1]) && is_same(q, end[0])))
      return true;
  }
  return false;
}

/* Adds a side that two triangles share if it is a diagonal of both their faces:
 * the faces extend beyond it, and may intersect in it.  Undecided. */
static bool add_shared(struct intersection_finder *finder,
                       const struct judge_triangle *s,
                       const struct judge_triangle *t,
                       const struct judge_point3 corner[2]) {
  const struct scene *scene = finder->all->scene;
  const struct judge_source source = {
      {SCENE_NONE, SCENE_NONE}, {s->face, t->face}, 0, false};
  if (has_side(scene, s->face, corner) || has_side(scene, t->face, corner))
    return true;
  return judge_edges_add(finder->edges, finder->camera, corner[0], corner[1],
                         &source);
}

/* Adds the overlap of two triangles' cuts by each other's planes; both are on
 * the line in which the planes intersect. */
static bool add_common(struct intersection_finder *finder,
                       const struct triangle_cut *s,
                       const struct triangle_cut *t, struct judge_point3 along,
                       uint32_t other) {
  double s0 = point3_dot(along, s->end[0]), s1 = point3_dot(along, s->end[1]);
  double t0 = point3_dot(along, t->end[0]), t1 = point3_dot(along, t->end[1]);
  double low = fmax(fmin(s0, s1), fmin(t0, t1));
  double high = fmin(fmax(s0, s1), fmax(t0, t1));
  if (!(low < high))
    return true;
  struct judge_point3 a = point3_along(s->end[0], low - s0, along);
  struct judge_point3 b = point3_along(s->end[0], high - s0, along);
  const struct judge_triangle *one =
                                  &finder->all->triangle.item[finder->current],
                              *two = &finder->all->triangle.item[other];
  snap_to_corner(one, two, &a, &b);
  const struct judge_camera *camera = finder->camera;
  /* It is sure where both triangles extend to either side of the other's plane
   * by far more than contact and rounding, and both triangulations are
   * known. */
  double rounding = fmax(judge_rounding_at(camera, finder->hair_mm, a),
                         judge_rounding_at(camera, finder->hair_mm, b));
  bool sure =
      !one->open && !two->open &&
      least_overshoot(camera, one, two) > 10 * fmax(two->contact, rounding) &&
      least_overshoot(camera, two, one) > 10 * fmax(one->contact, rounding);
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {one->face, two->face},
                                      sure ? RECTO_EDGE_INTERSECTION : 0,
                                      false};
  return judge_edges_add(finder->edges, finder->camera, a, b, &source);
}

static bool intersect_with(void *user, uint32_t other) {
  struct intersection_finder *finder = user;
  if (other <= finder->current)
    return true;
  const struct judge_triangle *s = &finder->all->triangle.item[finder->current];
  const struct judge_triangle *t = &finder->all->triangle.item[other];
  struct judge_point3 along = point3_cross(s->normal, t->normal), corner[3];
  if (s->face == t->face || !(point3_length(along) > 0))
    return true;
  unsigned shared = shared_corners(s, t, corner);
  if (shared >= 2)
    return add_shared(finder, s, t, corner);
  struct triangle_cut cs = cut_by_plane(s, t), ct = cut_by_plane(t, s);
  return cs.count != 2 || ct.count != 2 ||
         add_common(finder, &cs, &ct, point3_unit(along), other);
}

bool judge_edges_intersections(struct judge_edges *edges,
                               const struct judge_triangles *all,
                               const struct judge_camera *camera,
                               double hair_mm) {
  struct intersection_finder finder = {edges, all, camera, hair_mm, 0};
  for (uint32_t i = 0; i < all->triangle.count; i++) {
    const struct judge_triangle *triangle = &all->triangle.item[i];
    struct judge_box box = judge_triangle_box(triangle);
    finder.current = i;
    if (!judge_triangles_near(all, &box, triangle->face, intersect_with,
                              &finder))
      return false;
  }
  return true;
}
