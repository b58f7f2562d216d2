/* edges.h - the scene's edges as the judge finds them, on the page. */
#ifndef JUDGE_EDGES_H
#define JUDGE_EDGES_H

#include "judge/judge.h"

/* What an edge is of the scene. */
struct judge_source {
  uint32_t point[2]; /* scene points; SCENE_NONE: an intersection */
  uint32_t face[2];  /* two of its faces; SCENE_NONE */
  unsigned natures;  /* mask of recto_edge_class that it surely has */
  bool exists;       /* surely there, whatever its natures */
};

struct judge_edge {
  struct judge_point3 p[2];  /* cut off before the eye */
  struct judge_point2 at[2]; /* their images */
  double depth[2];
  struct judge_source source;
};

struct judge_edges {
  ARRAY(struct judge_edge) edge;
};

/* Finds the sides of faces, the wires, and the lines where faces pierce each
 * other.  A nature is left out where doubles cannot be sure of it. */
USE_RESULT bool judge_edges_init(struct judge_edges *edges,
                                 const struct scene *scene,
                                 const struct judge_triangles *all,
                                 const struct judge_camera *camera,
                                 const struct judge_options *options);
void judge_edges_fini(struct judge_edges *edges);

/* Adds an edge between two spots, or the part of it before the eye. */
USE_RESULT bool judge_edges_add(struct judge_edges *edges,
                                const struct judge_camera *camera,
                                struct judge_point3 a, struct judge_point3 b,
                                const struct judge_source *source);

/* Adds the lines where triangles pierce each other (intersections.c). */
USE_RESULT bool judge_edges_intersections(struct judge_edges *edges,
                                          const struct judge_triangles *all,
                                          const struct judge_camera *camera,
                                          double hair_mm);

/* ---- Projection (camera.c) ----------------------------------------------- */

/* How far a spot is ahead of the eye. */
double judge_ahead(const struct judge_camera *camera, struct judge_point3 p);
/* What the image is divided by: that in perspective; 1 in an orthographic
 * view. */
double judge_depth(const struct judge_camera *camera, struct judge_point3 p);
/* How far rounding may move what the near plane cuts; 0 where it cuts nothing.
 */
double judge_near_slack(const struct judge_camera *camera);
/* The near distance, less that: what stands on it is drawn. */
double judge_near(const struct judge_camera *camera);
struct judge_point2 judge_project(const struct judge_camera *camera,
                                  struct judge_point3 p);
/* The spot of the same depth whose image is (dx, dy) mm away. */
struct judge_point3 judge_shift(const struct judge_camera *camera,
                                struct judge_point3 p, double dx, double dy);

#endif
