/* edge_list.h - the edges of a scene, clipped and projected.
 */
#ifndef JUDGE_EDGE_LIST_H
#define JUDGE_EDGE_LIST_H

#include "judge/camera.h"

/* What an edge of the scene comes from. */
struct judge_source {
  uint32_t point[2];   /* scene points; SCENE_NONE: an intersection */
  uint32_t face[2];    /* two of its faces; SCENE_NONE */
  unsigned class_mask; /* mask of recto_edge_class that it surely has */
  bool exists;         /* surely there, whatever its classes */
  /* Not 0: within this of the edge two nearly parallel faces may intersect on
   * the page grid. */
  double near_mm;
};

struct judge_edge {
  struct judge_point3 p[2];  /* clipped, see below */
  struct judge_point2 at[2]; /* their images */
  double depth[2];
  struct judge_source source;
};

struct judge_edges {
  ARRAY(struct judge_edge) edge;
};

/* Adds an edge between two points, or the part of it in front of the near plane
 * and no farther from the page than doubles are accurate.  Returns false when
 * memory ran out. */
USE_RESULT bool judge_edges_add(struct judge_edges *edges,
                                const struct judge_camera *camera,
                                struct judge_point3 a, struct judge_point3 b,
                                const struct judge_source *source);

void judge_edges_fini(struct judge_edges *edges);

#endif
