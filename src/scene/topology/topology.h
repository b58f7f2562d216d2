/* topology.h - which faces meet at which edge.
 *
 * An edge is an unordered pair of points.  Points of border edges that lie at
 * exactly the same position count as one (files with seams are stitched;
 * closed shells that only touch stay apart).
 */
#ifndef SCENE_TOPOLOGY_TOPOLOGY_H
#define SCENE_TOPOLOGY_TOPOLOGY_H

#include "scene/face_normal.h"
#include "scene/scene.h"
#include "scene/topology/topology_edge.h"

struct topology {
  ARRAY(struct topology_edge) edge; /* in order of first use by a face */
  uint32_t *corner_edge; /* for corner c of a face, the edge from it to the
                            face's next corner; one per scene corner; NULL:
                            left out, or given up */
  ARRAY(struct corner_copy) corner_copy; /* where it is not stored yet, until
                                            topology_find_corners */
  uint64_t *border;     /* a bit an edge: one face alone has it */
  size_t borders;       /* how many there are */
  uint8_t *class_masks; /* of all edges at the angle crease_deg, as of
                            topology_class_masks; NULL: not kept */
  uint64_t *features;   /* a bit an edge, with class_masks: it is a feature
                           (topology_is_feature); NULL: not kept */
  double crease_deg;
  uint8_t *coarse;      /* of all points, as of topology_coarse_parts with
                      class_masks; NULL: not kept */
  uint8_t *crease_mark; /* one an edge, enum crease_mark: what files say of it;
                           NULL: nothing */
  struct face_direction *direction; /* one a face of the scene (face_normal.h),
                                       where they were found before the classes
                                       of edges, which need them; or NULL */
  struct face_sizes face_sizes;     /* of the scene, where those were found */
  uint8_t *used; /* one a point: whether a face or a polyline uses it, owned;
                    NULL: not kept */
  bool puts_corners_off; /* as of topology_init_edges */
  /* What may be freed once it was laid out, as it is not used later: */
  bool drop_corners; /* corner_edge */
  bool drop_edges;   /* edge */
  bool drop_sides;   /* those of a sheet's triangles: sheet_find_sides */
  uint32_t *weld;    /* point -> the point it is welded to; NULL where
                            nothing was welded */
};

/* Builds the edges of the scene.  Cost: linear in the corners. */
USE_RESULT recto_status topology_init(struct topology *topology,
                                      const struct scene *scene,
                                      recto_error *error);
/* The same for a scene whose points are welded: those at one position that have
 * different numbers stay apart. */
USE_RESULT recto_status topology_init_welded(struct topology *topology,
                                             const struct scene *scene,
                                             recto_error *error);
/* The same as topology_init where nobody may ask for corner_edge: if no points
 * are welded it is left out, of triangles all of it and of polygons that of
 * repeated parts. */
USE_RESULT recto_status topology_init_edges(struct topology *topology,
                                            const struct scene *scene,
                                            recto_error *error);
void topology_fini(struct topology *topology);

/* Finds corner_edge where it was left out: of triangles, which takes about as
 * long as finding the edges, or of repeated parts.  False when memory ran out,
 * or the caller cancelled. */
USE_RESULT bool topology_find_corners(struct topology *topology,
                                      const struct scene *scene);

/* The first edge from `edge` on that one face alone has; the number of edges:
 * there is none.  Few edges of most meshes are such, all those of a soup. */
static inline uint32_t topology_next_border(const struct topology *topology,
                                            uint32_t edge) {
  size_t edges = topology->edge.count, w = edge / 64, words = (edges + 63) / 64;
  if (edge >= edges)
    return (uint32_t)edges;
  uint64_t word = topology->border[w] >> edge % 64;
  if (word & 1)
    return edge;
  if (word != 0)
    return edge + (uint32_t)__builtin_ctzll(word);
  while (++w < words)
    if (topology->border[w] != 0)
      return (uint32_t)(64 * w) +
             (uint32_t)__builtin_ctzll(topology->border[w]);
  return (uint32_t)edges;
}

/* Lists the points of these edges, ascending.
 * points  of the scene
 * point   set to a new array, which the caller owns, also on failure
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool topology_border_points(const struct topology *topology,
                                       size_t points, uint32_t **point,
                                       size_t *count);

/* Gives up corner_edge. */
void topology_drop_corners(struct topology *topology);

/* Gives up the directions of faces. */
void topology_drop_directions(struct topology *topology);

#endif
