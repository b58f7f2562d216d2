/* weld_equal.h - welds points at exactly the same position. */
#ifndef SCENE_TOPOLOGY_WELD_EQUAL_H
#define SCENE_TOPOLOGY_WELD_EQUAL_H

#include "scene/scene.h"

/* Compares some of the points of a scene.
 * point  `count` of them, ascending
 * weld   set to a new array, point of the scene -> the lowest of these points
 *        at its position, or itself; or to NULL where no two of them coincide;
 *        owned by the caller
 * Returns false when memory ran out.
 * Exact: coordinates are compared as they are; -0 and 0 are the same.
 * Cost: linear in the points, save where made to be slow: points that share a
 * fingerprint of 33 bits without coinciding are compared in pairs. */
USE_RESULT bool weld_equal(const struct scene *scene, const uint32_t *point,
                           size_t count, uint32_t **weld);

#endif
