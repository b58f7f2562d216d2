/* layout_face_ranges.h - lays out faces none of which needs triangulation or
 * clipping, in parallel: first on which sides of the edges they lie, and once
 * the edges of the sheet are there, their triangles.  So the edges of the scene
 * need not be kept beside the triangles. */
#ifndef VIEW_LAYOUT_FACE_RANGES_H
#define VIEW_LAYOUT_FACE_RANGES_H

#include "view/layout_phases.h"

/* Finds the orientation of all faces, where all are such but for those that
 * have two corners at one point, and records the sides of the edges on which
 * they lie.  Then layout.face_range is set; else nothing has changed.
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool layout_record_all_sides(struct layout *layout);

/* Makes the triangles of these faces, links them to the edges of the sheet, and
 * frees what only that needed.  The edges of the topology are not used.
 * Returns false as above. */
USE_RESULT bool layout_make_all_triangles(struct layout *layout);

void layout_free_face_ranges(struct layout *layout);

#endif
