/* self_intersection.h - whether the sides of a polygon cross each other. */
#ifndef SCENE_TRIANGULATION_SELF_INTERSECTION_H
#define SCENE_TRIANGULATION_SELF_INTERSECTION_H

#include "scene/scene.h"

/* Whether two sides cross properly (not at a corner of either), projected along
 * the axis of largest projected area.
 * corner  of `count` >= 3, indices of points, no two neighbouring ones equal in
 *         position
 * Exact: a reported crossing is one.  A crossing may be missed where memory ran
 *        out or the polygon is adversarial, as the result serves a warning
 *        only.
 * Cost: for an ordinary polygon, that of sorting its sides. */
bool polygon_intersects_itself(const struct scene *scene,
                               const uint32_t *corner, size_t count);

/* Whether a polygon of few corners is seen to be strictly convex along the axis
 * that shows most of it: then no two of its corners are at one position, no
 * sides meet but at corners, and it has an area.  False also where that is not
 * asked, of many corners. */
bool polygon_is_strictly_convex(const struct scene *scene,
                                const uint32_t *corner, size_t count);

#endif
