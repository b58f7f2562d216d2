/* duplicate_triangles.h - triangles of which others are exact copies, so that these may be
 * asked in their stead.
 *
 * Two triangles are copies where their corners are at the same three places,
 * in the same order, and what they share their sides with are copies again.
 * Copies hide the same, touch the same and are pierced along the same lines.
 * Of all copies the first two stand for the rest: what is never hidden by one
 * triangle, because it is that one's own, may still be hidden by the other; and
 * they are of two faces where any two of the copies are, since a face is not
 * asked about itself.
 *   A copy that is left out is behind the first in the file, so nothing of it
 * is seen; whoever leaves it out as a hider must not ask what hides it.
 */
#ifndef VISIBILITY_INDEX_DUPLICATE_TRIANGLES_H
#define VISIBILITY_INDEX_DUPLICATE_TRIANGLES_H

#include "view/sheet.h"

/* May the list hold so many copies that it is worth while to look for them? */
USE_RESULT bool duplicate_triangles_abound(const struct sheet *sheet,
                                           const uint32_t *triangle,
                                           size_t count, bool *abound);

/* Finds the triangles of the sheet that others stand for.
 * left_out  gets one byte a triangle, not 0 where it is such a one; the caller
 *           frees it
 * Returns false when memory ran out.
 * Cost      as that of sorting the triangles */
USE_RESULT bool duplicate_triangles_find(const struct sheet *sheet,
                                         uint8_t **left_out);

#endif
