/* layout_face_ranges.h - lays out faces none of which needs triangulation or
 * clipping, in parallel: first their orientations, and once the edges of the
 * sheet are there, their triangles.  So the edges of the scene
 * need not be kept beside the triangles. */
#ifndef VIEW_LAYOUT_FACE_RANGES_H
#define VIEW_LAYOUT_FACE_RANGES_H

#include "view/layout_phases.h"

/* Finds the orientations of all faces, where all are such but for those that
 * have two corners at one point; of these triangles are left out.  Then
 * layout.face_range is set, and layout.flags are by face until the triangles
 * are made; else nothing has changed.
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool layout_orient_all_faces(struct layout *layout);

/* Makes the triangles of these faces, links them to the edges of the sheet, and
 * frees what only that needed.  The edges of the topology are not used.
 * Returns false as above. */
USE_RESULT bool layout_make_all_triangles(struct layout *layout);

void layout_free_face_ranges(struct layout *layout);

#endif
