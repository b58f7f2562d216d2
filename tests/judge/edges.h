/* edges.h - the scene's edges as the judge finds them, on the page. */
#ifndef JUDGE_EDGES_H
#define JUDGE_EDGES_H

#include "tests/judge/judge.h"

struct judge_edge {
  struct judge_spot p[2];   /* cut off before the eye */
  struct judge_place at[2]; /* their images */
  double depth[2];
  unsigned natures; /* mask of recto_edge_class that it surely has */
  bool exists;      /* surely there, whatever its natures */
};

struct judge_edges {
  ARRAY(struct judge_edge) edge;
};

/* Finds the sides of faces, the wires, and the lines where faces pierce each
 * other.  A nature is left out where doubles cannot be sure of it. */
void judge_edges_init(struct judge_edges *edges, const struct scene *scene,
                      const struct judge_triangles *all,
                      const struct judge_camera *camera,
                      const struct judge_options *options);
void judge_edges_fini(struct judge_edges *edges);

/* Adds an edge between two spots, or the part of it before the eye. */
void judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_spot a,
                     struct judge_spot b, unsigned natures, bool exists);

/* Adds the lines where triangles pierce each other (pierced.c). */
void judge_edges_pierced(struct judge_edges *edges,
                         const struct judge_triangles *all,
                         const struct judge_camera *camera, double contact);

/* ---- Projection (camera.c)
 * --------------------------------------------------- */

/* Depth before the eye; 1 in an orthographic view. */
double judge_depth(const struct judge_camera *camera, struct judge_spot p);
/* The near distance, less what rounding does: what stands on it is drawn. */
double judge_near(const struct judge_camera *camera);
struct judge_place judge_project(const struct judge_camera *camera,
                                 struct judge_spot p);
/* The spot of the same depth whose image is (dx, dy) mm away. */
struct judge_spot judge_shift(const struct judge_camera *camera,
                              struct judge_spot p, double dx, double dy);

#endif
