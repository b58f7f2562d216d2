/* duplicate_triangles.h - finds triangles of which others are exact duplicates,
 * so that two representatives can stand for each class of them.
 *
 * Two triangles are duplicates where their corners have the same coordinates in
 * the same order, and the triangles across each of their sides are duplicates
 * too.  Duplicates hide the same, touch the same and are pierced along the same
 * lines.
 *
 * Two representatives are needed, not one:
 *   - an edge is never hidden by its own triangles (occlusion.h), but may be
 *     hidden by their duplicates;
 *   - triangles of one face are not tested against each other; the two
 *     representatives are of different faces where any two duplicates are.
 *
 * A triangle that is left out is behind the first of its class, since of
 * coplanar triangles the one with the lower index is nearer, so nothing of it
 * is visible.  A caller that leaves it out as an occluder must not compute its
 * own visibility.
 */
#ifndef VISIBILITY_INDEX_DUPLICATE_TRIANGLES_H
#define VISIBILITY_INDEX_DUPLICATE_TRIANGLES_H

#include "view/sheet.h"

/* Decides whether the list contains so many duplicates that
 * duplicate_triangles_find is worth while.
 * Returns false when memory ran out. */
USE_RESULT bool duplicate_triangles_are_many(const struct sheet *sheet,
                                             const uint32_t *triangle,
                                             size_t count, bool *many);

/* Finds the triangles of the sheet for which representatives stand.
 * left_out  gets one byte per triangle, not 0 where it is one of these; the
 *           caller frees it
 * Returns false when memory ran out.
 * Cost      as that of sorting the triangles */
USE_RESULT bool duplicate_triangles_find(const struct sheet *sheet,
                                         uint8_t **left_out);

#endif
