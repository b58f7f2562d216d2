/* bowtie.h - tests whether the sides of a polygon cross each other. */
#ifndef SCENE_BOWTIE_H
#define SCENE_BOWTIE_H

#include "scene/scene.h"

/* Whether two sides cross properly (not at a corner of either), projected along
 * the axis of largest projected area.
 * corner  of `count` >= 3, indices of points, no two neighbouring ones equal in
 *         position
 * Exact: a reported crossing is one.  A crossing may be missed where memory ran
 *        out or the polygon is adversarial, as the result serves a warning
 *        only.
 * Cost: for an ordinary polygon, that of sorting its sides. */
bool bowtie_has_crossing(const struct scene *scene, const uint32_t *corner,
                         size_t count);

#endif
