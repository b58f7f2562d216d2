/* layout_unclipped.h - makes the sheet's triangles of faces that need neither
 * triangulation nor clipping.  Nearly all faces of a mesh are such. */
#ifndef VIEW_LAYOUT_UNCLIPPED_H
#define VIEW_LAYOUT_UNCLIPPED_H

#include "view/layout_phases.h"

/* The welded corners of a triangular face.  Returns false where two are one.
 * corner  gets them
 * own     as the scene has them
 * weld    NULL: none is welded */
static inline bool layout_welded_corners(uint32_t corner[3],
                                         const uint32_t *own,
                                         const uint32_t *weld) {
  for (int k = 0; k < 3; k++)
    corner[k] = weld != NULL ? weld[own[k]] : own[k];
  return corner[0] != corner[1] && corner[1] != corner[2] &&
         corner[2] != corner[0];
}

/* Adds faces from `face` on, up to `end` or to the first that is no triangle,
 * has a corner outside or two that are one, or for which no room was reserved.
 * Returns that face. */
uint32_t layout_unclipped_faces(struct layout *layout, uint32_t face,
                                uint32_t end);

#endif
