/* layout_unclipped.h - makes the sheet's triangles of faces that need neither
 * triangulation nor clipping.  Nearly all faces of a mesh are such. */
#ifndef VIEW_LAYOUT_UNCLIPPED_H
#define VIEW_LAYOUT_UNCLIPPED_H

#include "view/layout_phases.h"

/* Adds faces from `face` on, up to `end` or to the first that is no triangle,
 * has a corner outside or two that are one, or for which no room was reserved.
 * Returns that face. */
uint32_t layout_unclipped_faces(struct layout *layout, uint32_t face,
                                uint32_t end);

/* Does the whole phase in parallel, where all faces are such but for those
 * that have two corners at one point.
 * done  false: they are not, and nothing was added
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool layout_all_unclipped(struct layout *layout, bool *done);

#endif
