/* zero_triangles.c - the contour across a triangle.
 *
 * The triangle is curved, and divided into four at the middles of its sides;
 * facing is linear over each of the four.  A side whose ends have one sign is
 * not crossed, so that there is one crossing on a side at most, as many as on
 * its neighbour's.  So one corner is alone with its sign, and the contour runs
 * from one of its sides to the other through one or three of the four. */
#include "visibility/zero_set/zero_finder.h"

#include <float.h>
#include <string.h>

#include "base/tolerance.h"
#include "visibility/zero_set/curved_triangle.h"

/* The corners, then the middles of the sides that start there. */
enum { FIRST_MIDDLE = 3, PLACES = 6 };

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

/* Finds the middle of a side; the signs of its ends are known. */
static void find_middle(struct zero_triangle *t, int k) {
  const struct camera *camera = t->finder->facing->camera;
  int next = geom_next_corner(k), m = FIRST_MIDDLE + k;
  double v[3];
  t->weight[m][k] = t->weight[m][next] = 0.5;
  curved_triangle_side_normal(&t->curved, k, t->normal[m]);
  curved_triangle_point(&t->curved, t->weight[m], t->at[m]);
  facing_view(camera, t->at[m], v);
  t->facing[m] = facing_of_normal(t->normal[m], v);
  if (t->back[k] && t->back[next])
    t->facing[m] = fmax(t->facing[m], 0);
  else if (!t->back[k] && !t->back[next])
    t->facing[m] = fmin(t->facing[m], -DBL_MIN);
  t->back[m] = t->facing[m] >= 0;
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
  const uint32_t point[3] = {facing_point(f, t->corner[0]),
                             facing_point(f, t->corner[1]),
                             facing_point(f, t->corner[2])};
  t->curvature = curvature_noise_sum(&t->finder->curvature, f, point, 3);
  curved_triangle_init(&t->curved);
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

/* Where the node of a side is kept; NULL: it is shared with no triangle. */
static uint32_t *place_of_side(struct zero_triangle *t, int k) {
  struct zero_finder *z = t->finder;
  uint32_t edge = edge_of_side(t, k);
  if (edge == SHEET_NONE) {
    uint32_t start = scene_face_start(z->facing->scene, t->face);
    uint32_t end = scene_face_start(z->facing->scene, t->face + 1);
    return &z->diagonal_node.item[t->side[k] - (end - start)];
  }
  const struct topology_edge *e = &z->facing->topology->edge.item[edge];
  if (e->uses > 2 || e->first == e->second)
    return NULL;
  bool second = t->face != e->first && facing_is_split(z->facing, edge);
  return &z->edge_node[ranked_set_rank(&z->near_edge, edge)][second];
}

/* The node on side k, whose ends have different signs. */
static bool node_of_side(struct zero_triangle *t, int k, uint32_t *node) {
  const struct facing *f = t->finder->facing;
  uint32_t *place = place_of_side(t, k);
  int next = geom_next_corner(k), middle = FIRST_MIDDLE + k;
  if (place != NULL && *place != 0) {
    *node = *place - 1;
    return true;
  }
  int front = t->back[k] ? next : k, back = t->back[k] ? k : next;
  const uint32_t slot[2] = {facing_slot(f, t->corner[front]),
                            facing_slot(f, t->corner[back])};
  if (!add_crossing(t, t->back[middle] ? front : middle,
                    t->back[middle] ? middle : back, slot, node))
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

/* The node on a side of the triangle in the middle. */
static bool add_inner_node(struct zero_triangle *t, int i, int j, uint32_t like,
                           uint32_t *node) {
  const uint32_t slot[2] = {t->finder->set->node.item[like].front,
                            t->finder->set->node.item[like].back};
  return add_crossing(t, t->back[i] ? j : i, t->back[i] ? i : j, slot, node);
}

/* The segments from side `alone` to the side before it, about that corner. */
static bool cross_about(struct zero_triangle *t, int alone) {
  int next = geom_next_corner(alone), last = geom_next_corner(next);
  int m = FIRST_MIDDLE + alone, far = FIRST_MIDDLE + next,
      n = FIRST_MIDDLE + last;
  find_middle(t, alone);
  find_middle(t, last);
  bool beyond[2] = {t->back[m] == t->back[alone], t->back[n] == t->back[alone]};
  uint32_t node[4];
  if (!node_of_side(t, alone, &node[0]) || !node_of_side(t, last, &node[3]))
    return false;
  const int at_alone[3] = {alone, m, n}, at_next[3] = {m, next, far},
            at_last[3] = {n, far, last}, in_middle[3] = {m, far, n};
  if (!beyond[0] && !beyond[1])
    return add_segment(t, at_alone, (const uint32_t[2]){node[0], node[3]});
  find_middle(t, next);
  return add_inner_node(t, m, beyond[0] ? far : n, node[0], &node[1]) &&
         add_inner_node(t, n, beyond[1] ? far : m, node[3], &node[2]) &&
         add_segment(t, beyond[0] ? at_next : at_alone, &node[0]) &&
         add_segment(t, in_middle, &node[1]) &&
         add_segment(t, beyond[1] ? at_last : at_alone, &node[2]);
}

bool zero_finder_cross_triangle(struct zero_finder *finder, uint32_t face,
                                const uint32_t corner[3],
                                const uint32_t side[3]) {
  const struct facing *f = finder->facing;
  struct zero_triangle t = {.finder = finder, .face = face};
  for (int k = 0; k < 3; k++)
    t.back[k] = facing_is_back(f, corner[k]);
  if (t.back[0] == t.back[1] && t.back[1] == t.back[2])
    return true;
  memcpy(t.corner, corner, sizeof t.corner);
  memcpy(t.side, side, sizeof t.side);
  place_corners(&t);
  for (int k = 0; k < 2; k++)
    if (t.back[k] != t.back[geom_next_corner(k)])
      return cross_about(
          &t, t.back[k] == t.back[geom_next_corner(geom_next_corner(k))]
                  ? geom_next_corner(k)
                  : k);
  return true;
}
