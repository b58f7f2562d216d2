/* bowtie.h - whether the sides of a polygon cross each other. */
#ifndef SCENE_BOWTIE_H
#define SCENE_BOWTIE_H

#include "scene/scene.h"

/* Whether two sides cross properly (not at a corner of either), seen along the
 * axis that shows most of the polygon.
 * corner  of `count` >= 3, indices of points, no two neighbouring ones equal in
 *         position
 * Exact: a crossing that is told is one.  One may be missed where memory ran
 *        out or a polygon is made to be slow: it serves a warning.
 * Cost: of an ordinary polygon, that of sorting its sides. */
bool bowtie_has_crossing(const struct scene *scene, const uint32_t *corner,
                         size_t count);

#endif
