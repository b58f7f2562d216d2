/* layout_face_sign.h - the orientation of a face on the page, by those of its
 * triangles. */
#ifndef VIEW_LAYOUT_FACE_SIGN_H
#define VIEW_LAYOUT_FACE_SIGN_H

#include "view/layout_phases.h"

/* The orientation of a face on the page, whose triangles are the last ones,
 * from `first` on, and those of layout.whole.
 *   All triangles whose sign is sure have one sign: that is the face's.  A
 *     polygon of many corners has triangles that rounding turns, to the page
 *     grid or in its file, and with two signs their diagonals would be drawn as
 *     silhouettes.
 *   The signs differ: the face folds over, and each triangle has its own sign.
 *   The signs differ, but the face is seen edge-on within the contact
 *     tolerance: only rounding made them differ, and the sign is 0.
 * Returns false where each triangle has its own sign. */
bool layout_face_sign(const struct layout *layout, uint32_t face, size_t first,
                      int *sign);

/* The sign that all triangles from `first` on have whose sign is sure; 0 where
 * there is none, or they differ. */
int layout_sure_sign(const struct layout *layout, size_t first);

#endif
