/* outline_gaps.h - completes the outline of the picture where no smooth contour
 * is drawn. */
#ifndef VISIBILITY_CONTOUR_OUTLINE_GAPS_H
#define VISIBILITY_CONTOUR_OUTLINE_GAPS_H

#include "visibility/contour/zero_segments.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/map.h"

/* Adds visible edges of the class silhouette along those parts of the mesh's
 * outlines beside which nothing is seen and no visible contour is drawn.
 *
 * A point of an outline is drawn if the nearest point of the visible contours,
 * not farther than the outline's faces are wide, is not one at which a contour
 * ends.  Parts that are not are added; they start and end at the contours
 * beside them.
 * set          its outlines
 * first        of the sheet's edges: the first one of a contour
 * first_point  of the sheet's points: the same
 * grid         of the sheet's triangles
 * Cost   near linear in the outlines
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool outline_gaps_close(struct sheet *sheet, struct map *map,
                                   const struct zero_set *set, uint32_t first,
                                   uint32_t first_point,
                                   const struct triangle_grid *grid,
                                   struct triangle_grid_query *query);

#endif
