/* added_edges.h - visible silhouettes that are added to a sheet. */
#ifndef VISIBILITY_FOLD_ADDED_EDGES_H
#define VISIBILITY_FOLD_ADDED_EDGES_H

#include "visibility/map.h"

/* Makes room for so many edges.  Returns false when memory ran out. */
USE_RESULT bool added_edges_reserve(struct map *map, size_t count);

/* Adds a visible edge of the class silhouette, for which there is room in the
 * map.  Returns false when memory ran out.
 * face   whose contour it is
 * point  of the sheet */
USE_RESULT bool added_edges_push(struct sheet *sheet, struct map *map,
                                 uint32_t face, const uint32_t point[2]);

/* Adds a point.  Returns false when memory ran out. */
USE_RESULT bool added_edges_point(struct sheet *sheet, struct geom_point at,
                                  uint32_t *point);

#endif
