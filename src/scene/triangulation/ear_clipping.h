/* ear_clipping.h - triangulates a polygon by ear clipping. */
#ifndef SCENE_TRIANGULATION_EAR_CLIPPING_H
#define SCENE_TRIANGULATION_EAR_CLIPPING_H

#include "scene/triangulation/polygon.h"
#include "scene/triangulation/triangulation.h"

/* Adds the triangles of a polygon whose corners have been projected; there is
 * room for them.  Returns false when memory ran out. */
USE_RESULT bool ear_clipping(struct triangulation *triangulation,
                             const struct polygon *polygon);

#endif
