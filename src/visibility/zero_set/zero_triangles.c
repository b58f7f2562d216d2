/* zero_triangles.c - the contour across a triangle.
 *
 * The triangle is curved, and divided into four at the middles of its sides;
 * facing is linear over each of the four.  Each half of a side is crossed where
 * its ends have different signs, as its neighbour's is, so that curves are
 * closed.  A side whose ends have one sign is crossed twice if its middle has
 * the other one, and is free to: elsewhere its sign is that of the ends. */
#include "visibility/zero_set/zero_finder.h"

#include <float.h>
#include <string.h>

#include "base/tolerance.h"
#include "visibility/zero_set/curved_triangle.h"

/* The corners, then the middles of the sides that start there. */
enum { FIRST_MIDDLE = 3, PLACES = 6 };

/* As CURVATURE_NOISE_MAX, where the curvature may be smooth by weighted edges
 * alone: it is not between the ends of a long side if noise is more. */
#define RESOLVED_NOISE_MAX 0.2

struct zero_triangle {
  struct zero_finder *finder;
  uint32_t face;
  uint32_t corner[3], side[3];
  struct curved_triangle curved;
  double weight[PLACES][3];
  double at[PLACES][3]; /* on the curved triangle */
  double normal[PLACES][3];
  double facing[PLACES]; /* g */
  bool back[PLACES];
  bool measured[3];  /* the middles of sides */
  uint32_t inner[3]; /* the nodes between the middles of the sides at a corner,
                        from 1 on; 0: none yet */
  struct curvature_squares curvature; /* at its corners */
  double height;                      /* the mesh's triangle's least */
};

/* ---- The places ---------------------------------------------------------- */

static uint32_t edge_of_side(const struct zero_triangle *t, int k) {
  const struct scene *scene = t->finder->facing->scene;
  uint32_t start = scene_face_start(scene, t->face);
  return t->side[k] < scene_face_start(scene, t->face + 1) - start
             ? t->finder->facing->topology->corner_edge[start + t->side[k]]
             : SHEET_NONE;
}

/* How many corners of a face are turned one way. */
static int count_corners(const struct facing *f, uint32_t face, bool back) {
  int count = 0;
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++)
    count += facing_is_back(f, c) == back;
  return count;
}

/* Whether corners on both sides of a side, whose ends have one sign, have the
 * other one: as about a saddle, where the contour runs on both sides of it. */
static bool is_saddle(const struct zero_triangle *t, int k) {
  const struct facing *f = t->finder->facing;
  uint32_t edge = edge_of_side(t, k);
  bool other = !t->back[k];
  if (edge == SHEET_NONE)
    return count_corners(f, t->face, other) > 1;
  const struct topology_edge *e = &f->topology->edge.item[edge];
  return count_corners(f, e->first, other) > 0 &&
         count_corners(f, e->second, other) > 0;
}

/* Whether the mesh resolves the curvature from one end of a side to the other,
 * so that the curved triangle tells how the surface is turned between them. */
static bool is_resolved(const struct zero_triangle *t, int k) {
  const struct facing *f = t->finder->facing;
  const uint32_t point[2] = {facing_point(f, t->corner[k]),
                             facing_point(f, t->corner[geom_next_corner(k)])};
  struct curvature_squares sum =
      curvature_noise_sum(&t->finder->curvature, f, point, 2);
  return curvature_is_smooth(sum) &&
         sum.noise[0] < RESOLVED_NOISE_MAX * sum.curvature[0];
}

/* Whether the middle of a side, whose ends have one sign, may have the other
 * one.  All faces at the side are looked at if both signs are about an end. */
static bool is_middle_free(const struct zero_triangle *t, int k) {
  const struct facing *f = t->finder->facing;
  int next = geom_next_corner(k);
  return !t->curved.straight[k] &&
         facing_may_turn_between(f, t->corner[k], t->corner[next]) &&
         (facing_signs(f, facing_slot(f, t->corner[k])) |
          facing_signs(f, facing_slot(f, t->corner[next]))) == FACING_MIXED &&
         is_resolved(t, k) && !is_saddle(t, k);
}

/* Finds the middle of a side but for its sign.  Its facing is the same, to the
 * bit, for both triangles at the side. */
static void measure_middle(struct zero_triangle *t, int k) {
  int next = geom_next_corner(k), m = FIRST_MIDDLE + k;
  double v[3];
  t->measured[k] = true;
  t->weight[m][k] = t->weight[m][next] = 0.5;
  curved_triangle_side_normal(&t->curved, k, t->normal[m]);
  curved_triangle_side_middle(&t->curved, k, t->at[m]);
  facing_view(t->finder->facing->camera, t->at[m], v);
  t->facing[m] = facing_of_normal(t->normal[m], v);
}

/* Finds the sign of the middle of a side, by those of its ends. */
static void find_middle(struct zero_triangle *t, int k) {
  int m = FIRST_MIDDLE + k;
  t->back[m] = t->back[k];
  if (t->back[k] == t->back[geom_next_corner(k)] && !is_middle_free(t, k))
    return;
  measure_middle(t, k);
  t->back[m] = t->facing[m] >= 0;
}

/* Makes sure that the middle of a side is known; its sign is. */
static void need_middle(struct zero_triangle *t, int k) {
  int m = FIRST_MIDDLE + k;
  if (t->measured[k])
    return;
  measure_middle(t, k);
  t->facing[m] =
      t->back[m] ? fmax(t->facing[m], 0) : fmin(t->facing[m], -DBL_MIN);
}

static void find_height(struct zero_triangle *t) {
  double e[3][3], n[3], longest = 0;
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 3; i++)
      e[k][i] = t->curved.point[geom_next_corner(k)][i] - t->curved.point[k][i];
    longest = fmax(longest, vector_dot(e[k], e[k]));
  }
  vector_cross(e[0], e[1], n);
  t->height = sqrt(vector_dot(n, n) / longest);
}

static void place_corners(struct zero_triangle *t) {
  const struct facing *f = t->finder->facing;
  for (int k = 0; k < 3; k++) {
    uint32_t slot = facing_slot(f, t->corner[k]), edge = edge_of_side(t, k);
    t->weight[k][k] = 1;
    facing_position(f, facing_point(f, t->corner[k]), t->curved.point[k]);
    memcpy(t->at[k], t->curved.point[k], sizeof t->at[k]);
    memcpy(t->normal[k], f->normal[facing_place(f, slot)], sizeof t->normal[k]);
    memcpy(t->curved.normal[k], t->normal[k], sizeof t->normal[k]);
    t->facing[k] = f->value[facing_place(f, slot)];
    t->curved.straight[k] = edge != SHEET_NONE && facing_is_feature(f, edge);
  }
}

/* Finds what all segments of the triangle share. */
static void measure_triangle(struct zero_triangle *t) {
  const struct facing *f = t->finder->facing;
  const uint32_t point[3] = {facing_point(f, t->corner[0]),
                             facing_point(f, t->corner[1]),
                             facing_point(f, t->corner[2])};
  t->curvature = curvature_noise_sum(&t->finder->curvature, f, point, 3);
  if (!curvature_has_noise(t->curvature))
    curved_triangle_bend_as_long_sides(&t->curved);
  find_height(t);
}

/* ---- Nodes --------------------------------------------------------------- */

/* Adds the node between two places of different signs. */
static bool add_crossing(struct zero_triangle *t, int i, int j,
                         const uint32_t slot[2], uint32_t *node) {
  double s = t->facing[i] / (t->facing[i] - t->facing[j]);
  double weight[3], at[3], flat[3];
  for (int k = 0; k < 3; k++)
    weight[k] = t->weight[i][k] + s * (t->weight[j][k] - t->weight[i][k]);
  curved_triangle_point(&t->curved, weight, at);
  curved_triangle_flat_point(&t->curved, weight, flat);
  if (!zero_finder_add_node(t->finder, at, flat, slot[0], slot[1], node))
    return false;
  double *normal = t->finder->set->node.item[*node].normal;
  for (int k = 0; k < 3; k++)
    normal[k] = t->normal[i][k] + s * (t->normal[j][k] - t->normal[i][k]);
  return true;
}

/* Where the node of a half of a side is kept; NULL: it is shared with no
 * triangle.
 * half  0: from corner k to the middle */
static uint32_t *place_of_half(struct zero_triangle *t, int k, int half) {
  struct zero_finder *z = t->finder;
  const struct facing *f = z->facing;
  uint32_t edge = edge_of_side(t, k);
  uint32_t corner = t->corner[k], next = t->corner[geom_next_corner(k)];
  if (edge == SHEET_NONE) {
    uint32_t start = scene_face_start(f->scene, t->face);
    uint32_t end = scene_face_start(f->scene, t->face + 1);
    return &z->diagonal_node
                .item[t->side[k] - (end - start)][half ^ (corner > next)];
  }
  const struct topology_edge *e = &f->topology->edge.item[edge];
  if (e->uses > 2 || e->first == e->second)
    return NULL;
  /* There is one node at most at a feature, on either side of it. */
  int second = facing_is_feature(f, edge)
                   ? t->face != e->first && facing_is_split(f, edge)
                   : half ^ (facing_point(f, corner) != e->point[0]);
  return &z->edge_node[ranked_set_rank(&z->near_edge, edge)][second];
}

/* What stands for the middle of a side among slots, where the ends have the
 * other sign: as a vertex beside the contour. */
static uint32_t slot_of_middle(const struct zero_triangle *t, int k) {
  uint32_t edge = edge_of_side(t, k);
  uint32_t edges = (uint32_t)t->finder->facing->topology->edge.count;
  return SHEET_NONE - 1 - (edge != SHEET_NONE ? edge : edges + t->side[k]);
}

/* Finds the slots at a node beside a corner: on the other side of the contour
 * there is the middle of side k, which runs to the corner `far`. */
static void find_slots(const struct zero_triangle *t, int corner, int k,
                       int far, uint32_t slot[2]) {
  const struct facing *f = t->finder->facing;
  bool back = t->back[corner];
  slot[back] = facing_slot(f, t->corner[corner]);
  slot[!back] = t->back[far] != back ? facing_slot(f, t->corner[far])
                                     : slot_of_middle(t, k);
}

/* The node on a half of side k, whose ends have different signs. */
static bool node_of_half(struct zero_triangle *t, int k, int half,
                         uint32_t *node) {
  uint32_t *place = place_of_half(t, k, half);
  int next = geom_next_corner(k), middle = FIRST_MIDDLE + k;
  int end = half ? next : k, other = half ? k : next;
  if (place != NULL && *place != 0) {
    *node = *place - 1;
    return true;
  }
  uint32_t slot[2];
  find_slots(t, end, k, other, slot);
  if (!add_crossing(t, t->back[middle] ? end : middle,
                    t->back[middle] ? middle : end, slot, node))
    return false;
  if (place != NULL)
    *place = *node + 1;
  return true;
}

/* ---- Segments ------------------------------------------------------------ */

/* Sets the radial curvature over one of the four triangles.
 * of  its places */
static void describe(const struct zero_triangle *t, const int of[3],
                     struct contour_segment *s) {
  const double *p[3] = {t->at[of[0]], t->at[of[1]], t->at[of[2]]};
  const double g[3] = {t->facing[of[0]], t->facing[of[1]], t->facing[of[2]]};
  double e[2][3], n[3], across[2][3], v[3];
  for (int i = 0; i < 3; i++) {
    e[0][i] = p[1][i] - p[0][i];
    e[1][i] = p[0][i] - p[2][i];
  }
  vector_cross(e[1], e[0], n);
  /* The gradient of g, times the square of n's length, is
   * (g1 - g0) (p2 - p0) x n + (g2 - g0) n x (p1 - p0). */
  vector_cross(n, e[1], across[0]);
  vector_cross(n, e[0], across[1]);
  facing_view(t->finder->facing->camera, p[0], v);
  s->radial = (g[1] - g[0]) * vector_dot(across[0], v) +
              (g[2] - g[0]) * vector_dot(across[1], v);
}

/* Adds the segment across one of the four triangles. */
static bool add_segment(struct zero_triangle *t, const int of[3],
                        const uint32_t node[2]) {
  struct contour_segment s = {.node = {node[0], node[1]},
                              .face = t->face,
                              .curvature = t->curvature,
                              .height = t->height,
                              .width = t->height};
  describe(t, of, &s);
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++)
      s.normal[k] += t->finder->set->node.item[node[i]].normal[k];
  (void)vector_normalise(s.normal);
  return zero_finder_add_segment(t->finder, s);
}

/* The node on a side of the triangle in the middle, which runs between the
 * middles of the sides at a corner. */
static bool inner_node(struct zero_triangle *t, int corner, uint32_t *node) {
  int last = geom_next_corner(geom_next_corner(corner));
  int i = FIRST_MIDDLE + corner, j = FIRST_MIDDLE + last;
  if (t->inner[corner] == 0) {
    uint32_t slot[2];
    need_middle(t, corner);
    need_middle(t, last);
    if (t->back[i] != t->back[corner])
      find_slots(t, corner, corner, geom_next_corner(corner), slot);
    else
      find_slots(t, corner, last, last, slot);
    if (!add_crossing(t, t->back[i] ? j : i, t->back[i] ? i : j, slot, node))
      return false;
    t->inner[corner] = *node + 1;
  }
  *node = t->inner[corner] - 1;
  return true;
}

/* Adds the segment across the triangle at a corner, if it is crossed. */
static bool cross_at_corner(struct zero_triangle *t, int corner) {
  int last = geom_next_corner(geom_next_corner(corner));
  const int of[3] = {corner, FIRST_MIDDLE + corner, FIRST_MIDDLE + last};
  bool crossed[2] = {t->back[of[0]] != t->back[of[1]],
                     t->back[of[0]] != t->back[of[2]]};
  uint32_t node[2];
  if (!crossed[0] && !crossed[1])
    return true;
  if (crossed[0] ? !node_of_half(t, corner, 0, &node[0])
                 : !inner_node(t, corner, &node[0]))
    return false;
  return (crossed[1] ? node_of_half(t, last, 1, &node[1])
                     : inner_node(t, corner, &node[1])) &&
         add_segment(t, of, node);
}

/* Adds the segment across the triangle in the middle, if it is crossed. */
static bool cross_in_middle(struct zero_triangle *t) {
  const int of[3] = {FIRST_MIDDLE, FIRST_MIDDLE + 1, FIRST_MIDDLE + 2};
  uint32_t node[2];
  int count = 0;
  for (int k = 0; k < 3; k++) {
    int last = geom_next_corner(geom_next_corner(k));
    if (t->back[FIRST_MIDDLE + k] != t->back[FIRST_MIDDLE + last] &&
        !inner_node(t, k, &node[count++]))
      return false;
  }
  return count == 0 || add_segment(t, of, node);
}

/* Finds the corners and the middles of sides; returns whether the contour
 * crosses the triangle. */
static bool find_middles(struct zero_triangle *t) {
  bool differ = t->back[0] != t->back[1] || t->back[1] != t->back[2];
  place_corners(t);
  if (!differ && !is_middle_free(t, 0) && !is_middle_free(t, 1) &&
      !is_middle_free(t, 2))
    return false;
  curved_triangle_init(&t->curved);
  for (int k = 0; k < 3; k++) {
    find_middle(t, k);
    differ = differ || t->back[FIRST_MIDDLE + k] != t->back[k];
  }
  return differ;
}

bool zero_finder_cross_triangle(struct zero_finder *finder, uint32_t face,
                                const uint32_t corner[3],
                                const uint32_t side[3]) {
  struct zero_triangle t = {.finder = finder, .face = face};
  memcpy(t.corner, corner, sizeof t.corner);
  memcpy(t.side, side, sizeof t.side);
  for (int k = 0; k < 3; k++)
    t.back[k] = facing_is_back(finder->facing, corner[k]);
  if (!find_middles(&t))
    return true;
  measure_triangle(&t);
  for (int k = 0; k < 3; k++)
    if (!cross_at_corner(&t, k))
      return false;
  return cross_in_middle(&t);
}
