/* used.h - finds the points of a scene that a face or a polyline uses. */
#ifndef VIEW_USED_H
#define VIEW_USED_H

#include "scene/scene.h"

/* Returns one byte a point, 1 where it is used, which the caller frees.
 * weld  as in the topology: in place of a point, the one it is welded to is
 *       used; NULL: nothing is welded
 * Returns NULL when memory ran out, or the caller cancelled. */
uint8_t *used_points(const struct scene *scene, const uint32_t *weld);

#endif
