/* contour_creases.h - creases of the mesh in whose place a smooth contour is
 * drawn. */
#ifndef VISIBILITY_CONTOUR_CONTOUR_CREASES_H
#define VISIBILITY_CONTOUR_CONTOUR_CREASES_H

#include "visibility/map.h"

/* Leaves out creases that are silhouettes of the mesh, and so sides of its
 * zigzag about a contour: those through one of whose two faces a visible
 * contour passes, with both ends within a quarter of their length of one, and
 * which no other line continues, neither at their own ends nor at those of the
 * creases of this kind that are joined to them.
 * first  of the sheet's edges: the first one of a contour
 * Cost   near linear in the edges
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool contour_creases_leave_out(struct sheet *sheet,
                                          const struct map *map,
                                          uint32_t first);

#endif
