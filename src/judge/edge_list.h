/* edge_list.h - the edges of a scene, clipped and projected.
 */
#ifndef JUDGE_EDGE_LIST_H
#define JUDGE_EDGE_LIST_H

#include "judge/camera.h"
#include "judge/removed.h"

/* What a cut has to do with an edge. */
enum judge_cut {
  JUDGE_CUT_NONE,
  JUDGE_CUT_BESIDE,   /* so close to it that it may be removed */
  JUDGE_CUT_OF_FACE,  /* a plane cuts a face there */
  JUDGE_CUT_OF_PLANES /* two planes meet there */
};

/* What an edge of the scene comes from. */
struct judge_source {
  uint32_t point[2];   /* scene points; SCENE_NONE: an intersection */
  uint32_t face[2];    /* two of its faces; SCENE_NONE */
  unsigned class_mask; /* mask of recto_edge_class that it surely has */
  bool exists;         /* surely there, whatever its classes */
  /* Not 0: within this of the edge two nearly parallel faces may intersect on
   * the page grid. */
  double near_mm;
  enum judge_cut cut;
  int plane; /* of the cut in which it lies */
};

struct judge_edge {
  struct judge_point3 p[2];  /* clipped, see below */
  struct judge_point2 at[2]; /* their images */
  double depth[2];
  struct judge_source source;
};

struct judge_edges {
  const struct judge_removed *removed; /* of edges that are added */
  uint8_t *border;                     /* of each face, an enum judge_border */
  ARRAY(struct judge_edge) edge;
};

/* Adds what a cut leaves of an edge between two points, by
 * judge_edges_add_whole. */
USE_RESULT bool judge_edges_add(struct judge_edges *edges,
                                const struct judge_camera *camera,
                                struct judge_point3 a, struct judge_point3 b,
                                const struct judge_source *source);

/* Adds an edge between two points, or the part of it in front of the near plane
 * and no farther from the page than doubles are accurate.  Returns false when
 * memory ran out. */
USE_RESULT bool judge_edges_add_whole(struct judge_edges *edges,
                                      const struct judge_camera *camera,
                                      struct judge_point3 a,
                                      struct judge_point3 b,
                                      const struct judge_source *source);

void judge_edges_fini(struct judge_edges *edges);

#endif
