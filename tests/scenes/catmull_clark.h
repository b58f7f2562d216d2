/* catmull_clark.h - smooth meshes of quadrilaterals from coarse ones. */
#ifndef TESTS_SCENES_CATMULL_CLARK_H
#define TESTS_SCENES_CATMULL_CLARK_H

#include "scene/scene.h"

/* Adds to an initialised, empty scene what one step makes of another: each face
 * of n corners becomes n quadrilaterals, hardly any of them planar.  Edges of
 * one face or of more than two stay curves of their own.
 * Cost: linear in the corners.
 * Source: E. Catmull and J. Clark, Recursively Generated B-Spline Surfaces on
 * Arbitrary Topological Meshes, 1978. */
void scenes_catmull_clark(struct scene *to, const struct scene *from);

#endif
