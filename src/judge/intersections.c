/* intersections.c - finds the lines along which triangles intersect. */
#include <string.h>

#include "judge/intersections.h"

#include "base/poll.h"
#include "base/tolerance.h"
#include "judge/camera.h"
#include "judge/face_sides.h"
#include "judge/grid.h"
#include "judge/near_polygon.h"
#include "judge/sampler.h"
#include "judge/traversal.h"

struct intersection_finder {
  struct judge_edges *edges;
  const struct judge_triangles *all;
  const struct judge_camera *camera;
  double ray_offset_mm;
  uint32_t current; /* the triangle whose neighbours are looked up */
  struct face_sides sides;
};

/* ---- On the page --------------------------------------------------------- */

/* How far the clipped triangle extends from a plane to either side. */
struct overshoot {
  double before, behind;
};

static struct overshoot overshoot_of(const struct judge_camera *camera,
                                     const struct judge_triangle *t,
                                     const struct judge_triangle *plane) {
  struct judge_clipped_triangle clipped = judge_clip_triangle(camera, t);
  struct overshoot most = {0, 0};
  for (unsigned i = 0; i < clipped.count; i++) {
    double away =
        point3_dot(plane->normal, point3_sub(clipped.p[i], plane->p[0]));
    most.before = fmax(most.before, away);
    most.behind = fmax(most.behind, -away);
  }
  return most;
}

static double least_overshoot(const struct judge_camera *camera,
                              const struct judge_triangle *t,
                              const struct judge_triangle *plane) {
  struct overshoot both = overshoot_of(camera, t, plane);
  return fmin(both.before, both.behind);
}

static double most_overshoot(const struct judge_camera *camera,
                             const struct judge_triangle *t,
                             const struct judge_triangle *plane) {
  struct overshoot both = overshoot_of(camera, t, plane);
  return fmax(both.before, both.behind);
}

/* ---- In space ------------------------------------------------------------ */

/* The points in which a triangle's sides cross a plane: at most two. */
struct triangle_cut {
  struct judge_point3 end[2];
  unsigned count;
};

/* Of a triangle that ends on the plane along a side, from either side of the
 * plane, that is the cut. */
static struct triangle_cut cut_by_plane(const struct judge_triangle *t,
                                        const struct judge_triangle *plane) {
  struct triangle_cut cut = {.count = 0};
  double away[3];
  bool before = false;
  for (int k = 0; k < 3; k++) {
    away[k] = point3_dot(plane->normal, point3_sub(t->p[k], plane->p[0]));
    before |= away[k] > 0;
  }
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3;
    bool crosses = before ? (away[k] > 0) != (away[l] > 0)
                          : (away[k] < 0) != (away[l] < 0);
    if (crosses && cut.count < 2)
      cut.end[cut.count++] = point3_along(
          t->p[k], away[k] / (away[k] - away[l]), point3_sub(t->p[l], t->p[k]));
  }
  return cut;
}

/* The corners that two triangles share; returns their number. */
static unsigned find_shared_corners(const struct judge_triangle *s,
                                    const struct judge_triangle *t,
                                    struct judge_point3 corner[3]) {
  unsigned shared = 0;
  for (int i = 0; i < 3; i++) {
    int k = 0;
    while (k < 3 && !judge_point3_is_same(s->p[i], t->p[k]))
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
  if (find_shared_corners(s, t, corner) == 0)
    return;
  bool is_first = point3_length(point3_sub(*a, corner[0])) <
                  point3_length(point3_sub(*b, corner[0]));
  *(is_first ? a : b) = corner[0];
}

/* ---- Sides in common ----------------------------------------------------- */

/* The triangles of one surface at a side between two corners: those of one face
 * of which it is a diagonal, or those of all faces of which it is a side. */
struct side_surface {
  const struct intersection_finder *finder;
  const struct judge_point3 *corner; /* two */
  uint32_t face;                     /* SCENE_NONE: of all */
  uint32_t triangle[2];              /* the first two */
  unsigned count;
};

static bool add_to_surface(void *user, uint32_t i) {
  struct side_surface *surface = user;
  const struct judge_triangle *t = &surface->finder->all->triangle.item[i];
  unsigned shared = 0;
  for (int k = 0; k < 3; k++)
    shared += judge_point3_is_same(t->p[k], surface->corner[0]) ||
              judge_point3_is_same(t->p[k], surface->corner[1]);
  if (shared < 2 ||
      (surface->face == SCENE_NONE
           ? !face_has_side(&surface->finder->sides, t->face, surface->corner)
           : t->face != surface->face))
    return true;
  if (surface->count < 2)
    surface->triangle[surface->count] = i;
  surface->count++;
  return true;
}

/* The surface of a triangle at a side.
 * other  a face that does not belong to it */
static struct side_surface surface_at(const struct intersection_finder *finder,
                                      const struct judge_triangle *t,
                                      const struct judge_point3 corner[2],
                                      uint32_t other) {
  bool of_all = face_has_side(&finder->sides, t->face, corner);
  struct side_surface surface = {.finder = finder,
                                 .corner = corner,
                                 .face = of_all ? SCENE_NONE : t->face};
  struct judge_triangle line = {.p = {corner[0], corner[1], corner[1]}};
  struct judge_box box = judge_triangle_box(&line);
  (void)judge_triangles_near(finder->all, &box, other, add_to_surface,
                             &surface);
  return surface;
}

/* The direction in which a triangle extends from a side, perpendicular to
 * it. */
static struct judge_point3 direction_from(const struct judge_triangle *t,
                                          const struct judge_point3 corner[2]) {
  struct judge_point3 along = point3_unit(point3_sub(corner[1], corner[0]));
  struct judge_point3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = point3_along(sum, 1, point3_sub(t->p[k], corner[0]));
  sum = point3_along(sum, -point3_dot(sum, along), along);
  return point3_unit(sum);
}

static bool is_clipped(const struct judge_camera *camera,
                       const struct judge_triangle *t) {
  struct judge_clipped_triangle clipped = judge_clip_triangle(camera, t);
  for (unsigned i = 0; i < 3; i++)
    if (clipped.count != 3 || !judge_point3_is_same(clipped.p[i], t->p[i]))
      return true;
  return false;
}

/* Whether clipping leaves a triangle a corner beside a side, but nearer to it
 * than that distance.  The drawing's triangles of what is left may then all be
 * in contact with what touches the side. */
static bool is_cut_beside(const struct judge_camera *camera,
                          const struct judge_triangle *t,
                          const struct judge_point3 corner[2], double least) {
  struct judge_clipped_triangle clipped = judge_clip_triangle(camera, t);
  struct judge_point3 side = point3_sub(corner[1], corner[0]);
  double length = point3_length(side);
  for (unsigned i = 0; i < clipped.count; i++) {
    double twice =
        point3_length(point3_cross(side, point3_sub(clipped.p[i], corner[0])));
    if (twice > TOLERANCE_NO_AREA_SHARE * length * length &&
        twice < least * length)
      return true;
  }
  return false;
}

/* Whether two triangles with a common side surely diverge from it: each extends
 * from the other's plane by far more than contact and rounding, or they extend
 * to opposite sides. */
static bool do_diverge(const struct intersection_finder *finder,
                       const struct judge_triangle *s,
                       const struct judge_triangle *t,
                       const struct judge_point3 corner[2]) {
  const struct judge_camera *camera = finder->camera;
  double rounding =
      fmax(judge_rounding_at(camera, finder->ray_offset_mm, corner[0]),
           judge_rounding_at(camera, finder->ray_offset_mm, corner[1]));
  double least = 10 * fmax(fmax(s->contact, t->contact), rounding);
  if (is_cut_beside(camera, s, corner, least) ||
      is_cut_beside(camera, t, corner, least))
    return false;
  return point3_dot(direction_from(s, corner), direction_from(t, corner)) < 0 ||
         (most_overshoot(camera, s, t) > least &&
          most_overshoot(camera, t, s) > least);
}

/* The angle about a side from one triangle to another, 0 to 2 pi. */
static double angle_about(const struct judge_point3 corner[2],
                          const struct judge_triangle *from,
                          const struct judge_triangle *to) {
  struct judge_point3 along = point3_unit(point3_sub(corner[1], corner[0]));
  struct judge_point3 x = direction_from(from, corner),
                      d = direction_from(to, corner);
  double angle = atan2(point3_dot(point3_cross(along, x), d), point3_dot(x, d));
  return angle < 0 ? angle + 2 * acos(-1) : angle;
}

/* Whether two surfaces surely cross at a common side: of two triangles each,
 * which alternate in order of angle. */
static bool do_cross_at(const struct intersection_finder *finder,
                        const struct side_surface *s,
                        const struct side_surface *t) {
  const struct judge_triangle *triangle = finder->all->triangle.item;
  if (s->count != 2 || t->count != 2)
    return false;
  const struct judge_triangle *a[2] = {&triangle[s->triangle[0]],
                                       &triangle[s->triangle[1]]},
                              *b[2] = {&triangle[t->triangle[0]],
                                       &triangle[t->triangle[1]]};
  for (int i = 0; i < 4; i++)
    if (a[i / 2]->open || b[i % 2]->open ||
        !do_diverge(finder, a[i / 2], b[i % 2], s->corner))
      return false;
  double end = angle_about(s->corner, a[0], a[1]);
  return (angle_about(s->corner, a[0], b[0]) < end) !=
         (angle_about(s->corner, a[0], b[1]) < end);
}

/* Adds a side that the current triangle shares with another one, where it is a
 * diagonal of one face or of both and the surfaces cross there; where that is
 * not sure, only a diagonal of both.  Of the pairs of the two surfaces'
 * triangles, the first adds it. */
static bool add_shared(struct intersection_finder *finder, uint32_t other,
                       const struct judge_point3 corner[2]) {
  const struct judge_triangles *all = finder->all;
  const struct judge_triangle *s = &all->triangle.item[finder->current];
  const struct judge_triangle *t = &all->triangle.item[other];
  if (face_has_side(&finder->sides, s->face, corner) &&
      face_has_side(&finder->sides, t->face, corner))
    return true;
  struct side_surface one = surface_at(finder, s, corner, t->face),
                      two = surface_at(finder, t, corner, s->face);
  if (one.triangle[0] != finder->current || two.triangle[0] != other)
    return true;
  bool sure = do_cross_at(finder, &one, &two);
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {s->face, t->face},
                                      sure ? RECTO_EDGE_INTERSECTION : 0,
                                      false,
                                      0,
                                      JUDGE_CUT_NONE,
                                      0};
  bool is_diagonal = one.face != SCENE_NONE && two.face != SCENE_NONE;
  return (!sure && !is_diagonal) ||
         judge_edges_add(finder->edges, finder->camera, corner[0], corner[1],
                         &source);
}

/* Whether rounding may move the line in which two triangles intersect by more
 * than the ray offset.  Where the eye is so near to the scene that few depths
 * are left for what is far from it, it does so at larger angles, too. */
static bool are_nearly_parallel(const struct intersection_finder *finder,
                                const struct judge_triangle *s,
                                const struct judge_triangle *t) {
  const struct judge_camera *camera = finder->camera;
  double sine = point3_length(point3_cross(s->normal, t->normal));
  bool nearly = sine < TOLERANCE_JUDGE_PARALLEL;
  for (int k = 0; camera->perspective && !nearly && k < 3; k++) {
    double depth = judge_homogeneous_w(camera, s->p[k]);
    double along = camera->depth_contact * depth * depth;
    double all = judge_rounding_at(camera, finder->ray_offset_mm, s->p[k]);
    nearly = depth > 0 && sine * (all - along) < along;
  }
  return nearly;
}

/* Whether a triangle may be seen edge-on, so that what rounding makes of it on
 * the page may have an area.
 * rounding  of the drawing, scene units */
static bool may_be_edge_on(const struct judge_camera *camera,
                           const struct judge_triangle *t, double rounding) {
  if (camera->perspective)
    return fabs(point3_dot(t->normal, point3_sub(camera->eye, t->p[0]))) <=
           rounding;
  double most = fmax(point3_length(point3_sub(t->p[1], t->p[0])),
                     point3_length(point3_sub(t->p[2], t->p[0])));
  return fabs(point3_dot(t->normal, camera->back)) * most <= rounding;
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
   * by far more than contact and rounding, which cannot move it either, and
   * both triangulations are known; but without contact a face that is seen
   * edge-on may hide its own line. */
  double rounding = fmax(judge_rounding_at(camera, finder->ray_offset_mm, a),
                         judge_rounding_at(camera, finder->ray_offset_mm, b));
  double contact = fmax(one->contact, two->contact);
  bool sure =
      !one->open && !two->open && !are_nearly_parallel(finder, one, two) &&
      (contact <= rounding
           ? !(may_be_edge_on(camera, one, rounding) ||
               may_be_edge_on(camera, two, rounding))
           : !(is_clipped(camera, one) || is_clipped(camera, two))) &&
      least_overshoot(camera, one, two) > 10 * fmax(two->contact, rounding) &&
      least_overshoot(camera, two, one) > 10 * fmax(one->contact, rounding);
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {one->face, two->face},
                                      sure ? RECTO_EDGE_INTERSECTION : 0,
                                      false,
                                      0,
                                      JUDGE_CUT_NONE,
                                      0};
  return judge_edges_add(finder->edges, finder->camera, a, b, &source);
}

/* ---- Nearly in one plane ------------------------------------------------- */

/* Adds where two nearly parallel triangles may intersect on the page grid,
 * wherever they do in the scene: as a segment, and how far from it.  The grid's
 * rounding of either is a tenth of the judge's. */
static bool add_near(struct intersection_finder *finder, uint32_t other) {
  const struct judge_triangle *s = &finder->all->triangle.item[finder->current],
                              *t = &finder->all->triangle.item[other];
  struct judge_clipped_triangle drawn = judge_clip_triangle(finder->camera, s);
  double rounding = 0;
  for (unsigned k = 0; k < drawn.count; k++)
    rounding =
        fmax(rounding, judge_rounding_at(finder->camera, finder->ray_offset_mm,
                                         drawn.p[k]));
  struct near_polygon part = near_polygon_of(&drawn, t, 0.2 * rounding);
  struct judge_point2 at[NEAR_POLYGON_CORNERS] = {{0, 0}};
  unsigned a = 0, b = 0;
  double longest = 0, moved = 0;
  for (unsigned i = 0; i < part.count; i++) {
    at[i] = judge_project(finder->camera, part.p[i]);
    for (unsigned k = 0; k < i; k++) {
      double length = hypot(at[i].x - at[k].x, at[i].y - at[k].y);
      if (length > longest) {
        longest = length;
        a = k, b = i;
      }
    }
  }
  const struct judge_segment image = {at[a], at[b]};
  for (unsigned i = 0; i < part.count; i++) {
    double unused;
    moved = fmax(moved, judge_distance(&image, at[i], &unused));
  }
  const struct judge_source source = {{SCENE_NONE, SCENE_NONE},
                                      {s->face, t->face},
                                      0,
                                      false,
                                      2 * moved,
                                      JUDGE_CUT_NONE,
                                      0};
  return moved < finder->ray_offset_mm ||
         judge_edges_add(finder->edges, finder->camera, part.p[a], part.p[b],
                         &source);
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
  unsigned shared = find_shared_corners(s, t, corner);
  if (shared >= 2)
    return add_shared(finder, other, corner);
  struct triangle_cut cs = cut_by_plane(s, t), ct = cut_by_plane(t, s);
  if (cs.count == 2 && ct.count == 2 &&
      !add_common(finder, &cs, &ct, point3_unit(along), other))
    return false;
  return !are_nearly_parallel(finder, s, t) || add_near(finder, other);
}

bool judge_edges_add_intersections(struct judge_edges *edges,
                                   const struct judge_triangles *all,
                                   const struct judge_camera *camera,
                                   double ray_offset_mm) {
  struct intersection_finder finder = {.edges = edges,
                                       .all = all,
                                       .camera = camera,
                                       .ray_offset_mm = ray_offset_mm};
  bool ok = face_sides_init(&finder.sides, all->scene);
  for (uint32_t i = 0; ok && i < all->triangle.count; i++) {
    const struct judge_triangle *triangle = &all->triangle.item[i];
    struct judge_box box = judge_triangle_box(triangle);
    finder.current = i;
    ok = poll_at(i) && judge_triangles_near(all, &box, triangle->face,
                                            intersect_with, &finder);
  }
  face_sides_fini(&finder.sides);
  return ok;
}
