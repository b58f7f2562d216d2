/* zero_set.c - finds where the facing of a smooth surface changes sign. */
#include "visibility/contour/zero_set.h"

#include <string.h>

#include "base/poll.h"
#include "visibility/contour/zero_finder.h"
#include "view/clip.h"
#include "scene/triangulate.h"

void zero_set_fini(struct zero_set *set) {
  ARRAY_FREE(&set->node);
  ARRAY_FREE(&set->segment);
  ARRAY_FREE(&set->border);
  ARRAY_FREE(&set->outline);
}

/* ---- Nodes and segments -------------------------------------------------- */

bool zero_finder_add_node(struct zero_finder *z, const double at[3],
                          uint32_t front, uint32_t back, uint32_t *node) {
  struct contour_node made = {.at = {at[0], at[1], at[2]},
                              .front = front,
                              .back = back,
                              .segment = {SHEET_NONE, SHEET_NONE},
                              .sheet_point = SHEET_NONE};
  *node = (uint32_t)z->set->node.count;
  return ARRAY_PUSH(&z->set->node, made);
}

static double facing_of_slot(const struct facing *f, uint32_t slot) {
  return f->value[f->place[slot]];
}

/* Adds the node between two corners whose slots have different signs.  It is
 * computed from the lower to the upper point, so that it is the same for both
 * faces of an edge. */
static bool add_crossing(struct zero_finder *z, uint32_t c, uint32_t d,
                         uint32_t *node) {
  const struct facing *f = z->facing;
  uint32_t from = facing_point(f, c) < facing_point(f, d) ? c : d;
  uint32_t to = from == c ? d : c;
  uint32_t a = facing_slot(f, from), b = facing_slot(f, to);
  double p[3], q[3], at[3];
  double t =
      facing_of_slot(f, a) / (facing_of_slot(f, a) - facing_of_slot(f, b));
  facing_position(f, facing_point(f, from), p);
  facing_position(f, facing_point(f, to), q);
  for (int k = 0; k < 3; k++)
    at[k] = p[k] + t * (q[k] - p[k]);
  bool a_is_back = facing_is_back(f, a);
  return zero_finder_add_node(z, at, a_is_back ? b : a, a_is_back ? a : b,
                              node);
}

bool zero_finder_add_segment(struct zero_finder *z, struct contour_segment s) {
  double at[2][3];
  struct view_point end[2];
  bool outside = false, moved[2] = {false, false};
  for (int k = 0; k < 2; k++) {
    memcpy(at[k], z->set->node.item[s.node[k]].at, sizeof at[k]);
    end[k] = zero_finder_view(z, at[k]);
    outside = outside || clip_outcode(&z->projection, end[k]) != 0;
  }
  if (outside && !clip_segment(&z->projection, end, moved))
    return true;
  for (int k = 0; k < 2; k++)
    if (moved[k]) {
      const struct camera *camera = z->facing->camera;
      for (int i = 0; i < 3; i++)
        at[k][i] = camera->eye[i] + end[k].x * camera->right[i] +
                   end[k].y * camera->up[i] - end[k].d * camera->back[i];
      if (!zero_finder_add_node(z, at[k], SHEET_NONE, SHEET_NONE, &s.node[k]))
        return false;
    }
  for (int k = 0; k < 2; k++) {
    struct contour_node *node = &z->set->node.item[s.node[k]];
    if (node->degree < 2)
      node->segment[node->degree] = (uint32_t)z->set->segment.count;
    node->degree++;
    node->page = project_point(&z->projection, end[k]);
  }
  return ARRAY_PUSH(&z->set->segment, s);
}

/* ---- Triangles ----------------------------------------------------------- */

/* Where the node of a face's side is kept; NULL: it is shared with no face. */
static uint32_t *place_of_side(struct zero_finder *z, uint32_t face,
                               uint32_t edge) {
  const struct topology_edge *e = &z->facing->topology->edge.item[edge];
  if (e->uses > 2 || e->first == e->second)
    return NULL;
  bool second = face != e->first && facing_is_split(z->facing, edge);
  return &z->edge_node[2 * (size_t)edge + second];
}

/* The node on the side of a triangle of a face, between corners c and d.
 * side  as in triangulation.h */
static bool node_of_side(struct zero_finder *z, uint32_t face, uint32_t side,
                         uint32_t c, uint32_t d, uint32_t *node) {
  uint32_t start = scene_face_start(z->facing->scene, face);
  uint32_t count = scene_face_start(z->facing->scene, face + 1) - start;
  uint32_t *place =
      side < count
          ? place_of_side(z, face,
                          z->facing->topology->corner_edge[start + side])
          : &z->diagonal_node.item[side - count];
  if (place != NULL && *place != SHEET_NONE) {
    *node = *place;
    return true;
  }
  if (!add_crossing(z, c, d, node))
    return false;
  if (place != NULL)
    *place = *node;
  return true;
}

/* Sets what a segment takes from its triangle. */
static void describe(const struct facing *f, const uint32_t corner[3],
                     struct contour_segment *s) {
  double p[3][3], e[3][3], n[3], to_view[2][3], v[3], g[3], longest = 0;
  for (int k = 0; k < 3; k++) {
    facing_position(f, facing_point(f, corner[k]), p[k]);
    g[k] = facing_of_slot(f, facing_slot(f, corner[k]));
  }
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 3; i++)
      e[k][i] = p[(k + 1) % 3][i] - p[k][i];
    longest = fmax(longest, vector_dot(e[k], e[k]));
  }
  vector_cross(e[0], e[1], n);
  s->width = s->height = sqrt(vector_dot(n, n) / longest);
  /* The gradient of g, times the square of n's length, is
   * (g1 - g0) (p2 - p0) x n + (g2 - g0) n x (p1 - p0). */
  vector_cross(n, e[2], to_view[0]);
  vector_cross(n, e[0], to_view[1]);
  facing_view(f->camera, p[0], v);
  s->radial = (g[1] - g[0]) * vector_dot(to_view[0], v) +
              (g[2] - g[0]) * vector_dot(to_view[1], v);
}

/* Adds to a segment's normal that of the surface at a node. */
static void add_normal(const struct facing *f, const struct contour_node *node,
                       double n[3]) {
  double a = facing_of_slot(f, node->front), b = facing_of_slot(f, node->back);
  double t = a / (a - b);
  const double *p = f->normal[f->place[node->front]];
  const double *q = f->normal[f->place[node->back]];
  for (int k = 0; k < 3; k++)
    n[k] += p[k] + t * (q[k] - p[k]);
}

/* The segment across a triangle of a face, if there is one.
 * corner  its corners; side[k] runs from corner[k] to the next */
static bool cross_triangle(struct zero_finder *z, uint32_t face,
                           const uint32_t corner[3], const uint32_t side[3]) {
  const struct facing *f = z->facing;
  bool back[3];
  struct contour_segment s = {.face = face};
  int count = 0;
  for (int k = 0; k < 3; k++)
    back[k] = facing_is_back(f, facing_slot(f, corner[k]));
  if (back[0] == back[1] && back[1] == back[2])
    return true;
  for (int k = 0; k < 3; k++) {
    int next = geom_next_corner(k);
    if (back[k] != back[next] && !node_of_side(z, face, side[k], corner[k],
                                               corner[next], &s.node[count++]))
      return false;
  }
  describe(f, corner, &s);
  for (int k = 0; k < 2; k++)
    add_normal(f, &z->set->node.item[s.node[k]], s.normal);
  (void)vector_normalise(s.normal);
  return zero_finder_add_segment(z, s);
}

static bool cross_polygon(struct zero_finder *z, uint32_t face, uint32_t start,
                          uint32_t count) {
  struct triangulation *triangulation = &z->triangulation;
  z->corner.count = z->diagonal_node.count = 0;
  if (!ARRAY_RESERVE(&z->corner, count) ||
      !ARRAY_RESERVE(&z->diagonal_node, count))
    return false;
  for (uint32_t c = 0; c < count; c++) {
    z->corner.item[c] = facing_point(z->facing, start + c);
    z->diagonal_node.item[c] = SHEET_NONE;
  }
  if (!triangulate(triangulation, z->facing->scene->point.item, z->corner.item,
                   count))
    return false;
  for (size_t t = 0; t < triangulation->triangle.count; t++) {
    const struct triangulation_triangle *of = &triangulation->triangle.item[t];
    const uint32_t corner[3] = {start + of->corner[0], start + of->corner[1],
                                start + of->corner[2]};
    if (!cross_triangle(z, face, corner, of->side))
      return false;
  }
  return true;
}

static bool cross_face(struct zero_finder *z, uint32_t face) {
  const struct facing *f = z->facing;
  uint32_t start = scene_face_start(f->scene, face);
  uint32_t count = scene_face_start(f->scene, face + 1) - start;
  bool front = false, back = false;
  for (uint32_t c = start; c < start + count; c++) {
    bool is_back = facing_is_back(f, facing_slot(f, c));
    front = front || !is_back;
    back = back || is_back;
  }
  if (!front || !back)
    return true;
  if (count > 3)
    return cross_polygon(z, face, start, count);
  const uint32_t corner[3] = {start, start + 1, start + 2};
  const uint32_t side[3] = {0, 1, 2};
  uint32_t p = facing_point(f, start), q = facing_point(f, start + 1),
           r = facing_point(f, start + 2);
  return p == q || q == r || r == p || cross_triangle(z, face, corner, side);
}

/* ---- The whole ----------------------------------------------------------- */

static bool cross_all(struct zero_finder *z) {
  const struct facing *f = z->facing;
  size_t edges = f->topology->edge.count;
  z->edge_node = mem_alloc(edges, 2 * sizeof *z->edge_node);
  if (z->edge_node == NULL)
    return false;
  memset(z->edge_node, 0xff, edges * 2 * sizeof *z->edge_node);
  for (size_t i = 0; i < f->mixed.count; i++)
    if (!poll_at(i) || !cross_face(z, f->mixed.item[i]))
      return false;
  for (uint32_t e = 0; e < edges; e++) {
    const struct topology_edge *edge = &f->topology->edge.item[e];
    if (!poll_at(e) || !zero_finder_add_outline(z, e) ||
        !zero_finder_add_border(z, e))
      return false;
    if (f->split != NULL && edge->uses == 2 && edge->first != edge->second &&
        !f->coarse[edge->point[0]] && facing_is_split(f, e) &&
        !zero_finder_cross_crease(z, e))
      return false;
  }
  return true;
}

recto_status zero_set_find(struct zero_set *set, const struct facing *facing,
                           recto_error *error) {
  struct zero_finder z = {.set = set,
                          .facing = facing,
                          .projection = projection_of(facing->camera)};
  bool ok = cross_all(&z);
  mem_free(z.edge_node);
  mem_free(z.point_node);
  ARRAY_FREE(&z.diagonal_node);
  ARRAY_FREE(&z.corner);
  triangulation_fini(&z.triangulation);
  return ok ? RECTO_OK : error_memory(error);
}
