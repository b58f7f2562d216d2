/* zero_creases.c - the contour along creases. */
#include "visibility/zero_set/zero_finder.h"

#include <math.h>
#include <string.h>

/* A share of a triangle's height that is nearly nothing. */
#define CREASE_SHARE 0x1p-10

/* The height over a crease, at most, as a multiple of the triangles' least: a
 * long face that ends at its short side is no coarser than it is wide. */
#define CREASE_HEIGHTS 2

/* ---- Creases ------------------------------------------------------------- */

static bool node_of_vertex(struct zero_finder *z, uint32_t point,
                           uint32_t *node) {
  double at[3];
  if (z->point_node == NULL) {
    size_t size = z->facing->scene->point.count * sizeof *z->point_node;
    z->point_node =
        mem_alloc(z->facing->scene->point.count, sizeof *z->point_node);
    if (z->point_node == NULL)
      return false;
    memset(z->point_node, 0xff, size);
  }
  *node = z->point_node[point];
  if (*node != SHEET_NONE)
    return true;
  facing_position(z->facing, point, at);
  if (!zero_finder_add_node(z, at, at, SHEET_NONE, SHEET_NONE, node))
    return false;
  z->point_node[point] = *node;
  return true;
}

/* The height of a face over its longest side.
 * normal  twice its area in length */
static double least_height(const struct facing *f, uint32_t face,
                           const double normal[3]) {
  double longest = 0;
  for (uint32_t c = scene_face_start(f->scene, face);
       c < scene_face_start(f->scene, face + 1); c++) {
    double at[3], side[3];
    facing_position(f, facing_point(f, c), at);
    facing_position(f, facing_point(f, scene_next_corner(f->scene, face, c)),
                    side);
    for (int k = 0; k < 3; k++)
      side[k] -= at[k];
    longest = fmax(longest, vector_dot(side, side));
  }
  return longest > 0 ? sqrt(vector_dot(normal, normal) / longest) : 0;
}

/* Sets how uneven the mesh is about a segment along a crease.
 * along          the crease
 * first, second  the normals of its faces, twice their areas in length */
static void measure_crease(const struct facing *f,
                           const struct topology_edge *e, const double along[3],
                           const double first[3], const double second[3],
                           struct contour_segment *s) {
  double least = fmin(vector_dot(first, first), vector_dot(second, second));
  s->width = fmin(least_height(f, e->first, first),
                  least_height(f, e->second, second));
  s->height =
      fmin(sqrt(least / vector_dot(along, along)), CREASE_HEIGHTS * s->width);
  /* Where the faces themselves fold over, the mesh about it is not uneven. */
  if (zero_finder_folds_over(f, e))
    s->width *= CREASE_SHARE;
}

/* The segment along a crease from one node to another. */
static bool add_along_crease(struct zero_finder *z, uint32_t edge,
                             const uint32_t node[2]) {
  const struct facing *f = z->facing;
  const struct topology_edge *e = &f->topology->edge.item[edge];
  struct contour_segment s = {
      .node = {node[0], node[1]},
      .face = e->first,
      .along_crease = true,
      .in_network = (f->point_flags[e->point[0]] & FACING_NETWORK) != 0};
  double first[3], second[3], at[3], beyond[3], along[3];
  uint32_t c = facing_corner_of_edge(f, e->second, edge);
  facing_face_normal(f, e->first, first);
  facing_face_normal(f, e->second, second);
  facing_position(f, e->point[0], at);
  facing_position(f, e->point[1], along);
  for (int k = 0; k < 3; k++)
    along[k] -= at[k];
  measure_crease(f, e, along, first, second, &s);
  (void)vector_normalise(first);
  (void)vector_normalise(second);
  /* Convex where the other face lies behind this one. */
  facing_position(
      f,
      facing_point(
          f, scene_next_corner(f->scene, e->second,
                               scene_next_corner(f->scene, e->second, c))),
      beyond);
  for (int k = 0; k < 3; k++) {
    s.normal[k] = first[k] + (e->same_way ? -second[k] : second[k]);
    beyond[k] -= at[k];
  }
  (void)vector_normalise(s.normal);
  s.radial = -vector_dot(beyond, first);
  return zero_finder_add_segment(z, s);
}

bool zero_finder_cross_crease(struct zero_finder *z, uint32_t edge) {
  const struct facing *f = z->facing;
  const struct topology_edge *e = &f->topology->edge.item[edge];
  const uint32_t face[2] = {e->first, e->second};
  bool differ = e->same_way;
  uint32_t stop[4]; /* nodes from end to end */
  int count = 1;
  for (int k = 0; k < 2; k++) {
    uint32_t c = facing_corner_of_edge(f, face[k], edge);
    if (c == SHEET_NONE)
      return true;
    if (facing_point(f, c) != e->point[0])
      c = scene_next_corner(f->scene, face[k], c);
    differ = differ != facing_is_back(f, c);
    uint32_t node = zero_finder_edge_node(z, edge, k);
    if (node != 0)
      stop[count++] = node - 1;
  }
  if (!differ && count == 1)
    return true;
  if (!node_of_vertex(z, e->point[0], &stop[0]) ||
      !node_of_vertex(z, e->point[1], &stop[count]))
    return false;
  if (count == 3) { /* in order along the edge */
    double away[2];
    for (int k = 0; k < 2; k++) {
      double d[3];
      for (int i = 0; i < 3; i++)
        d[i] = z->set->node.item[stop[k + 1]].at[i] -
               z->set->node.item[stop[0]].at[i];
      away[k] = vector_dot(d, d);
    }
    if (away[1] < away[0]) {
      uint32_t swap = stop[1];
      stop[1] = stop[2];
      stop[2] = swap;
    }
  }
  for (int k = 0; k < count; k++, differ = !differ)
    if (differ && !add_along_crease(z, edge, &stop[k]))
      return false;
  return true;
}
