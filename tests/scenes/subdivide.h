/* subdivide.h - finer meshes from coarse ones: each triangle becomes four. */
#ifndef TESTS_SCENES_SUBDIVIDE_H
#define TESTS_SCENES_SUBDIVIDE_H

#include "scene/scene.h"

enum subdivide_rule {
  SUBDIVIDE_MIDPOINT, /* new points in the middle of edges: the same surface */
  SUBDIVIDE_LOOP      /* Loop's rule, with its border rule: smoother */
};

/* Adds to an initialised, empty scene what one step makes of another; larger
 * faces are cut into fans first.  Edges of one face or of more than two are
 * borders: they stay curves of their own, so that pieces which shared one
 * still do.  Points keep their numbers, new ones follow.
 * Cost: linear in the corners.
 * Source: C. Loop, Smooth Subdivision Surfaces Based on Triangles, 1987, with
 * the simpler weights that Warren gave later. */
void scenes_subdivide(struct scene *to, const struct scene *from,
                      enum subdivide_rule rule);

#endif
