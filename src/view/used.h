/* used.h - which points of a scene a face or a polyline uses. */
#ifndef VIEW_USED_H
#define VIEW_USED_H

#include "scene/scene.h"

/* One byte a point, 1 where it is used; the caller frees it.
 * weld  as in the topology: what stands for a point is used in its place;
 *       NULL: none
 * Returns NULL when memory ran out. */
uint8_t *used_points(const struct scene *scene, const uint32_t *weld);

#endif
