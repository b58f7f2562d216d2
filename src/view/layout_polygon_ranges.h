/* layout_polygon_ranges.h - lays out ranges of faces, of which some need
 * triangulation but none clipping. */
#ifndef VIEW_LAYOUT_POLYGON_RANGES_H
#define VIEW_LAYOUT_POLYGON_RANGES_H

#include "view/layout_phases.h"

/* Phase triangles, where no face is clipped.  There is room for the triangles:
 * two fewer than corners of each face. */
USE_RESULT recto_status layout_polygon_ranges(struct layout *layout);

#endif
