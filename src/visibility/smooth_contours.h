/* smooth_contours.h - draws the contours of the smooth surface that a mesh
 * samples in place of the mesh's own. */
#ifndef VISIBILITY_SMOOTH_CONTOURS_H
#define VISIBILITY_SMOOTH_CONTOURS_H

#include "visibility/map.h"
#include "visibility/smooth_curves.h"

/* What is known of the contours, for --stats. */
struct smooth_contours_counts {
  uint64_t segments, curves, pieces;
  uint64_t compared; /* what is near with what: the work of some searches */
};

struct smooth_contours_options {
  int hidden_max;     /* hidden pieces that more triangles hide are left out; 0:
                        none are */
  bool intersections; /* they are drawn; else their class becomes 0 */
};

/* Adds the smooth contours to a solved sheet as edges of the class silhouette,
 * each visible or hidden from end to end.
 *
 * A curve is divided where its visibility may change: at its cusps, where lines
 * pass in front of it, and where it passes through faces (contour_cusps.h,
 * page_crossings.h, intersection_cuts.h).  Each piece
 * is visible or hidden as a whole, as most of its samples are.  These lie a
 * little off the surface, so that the triangles about them do not decide.
 * Visible fragments are made to end at the visible pieces (fit_fragments.h).
 * map     of the sheet; its edges are known
 * curves  as of smooth_curves_find
 * input   of the curves: the sheet, its surface and more
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED.
 * Cost    linear in the mesh; near linear in the contours
 * Source  doc/decisions/0039 */
USE_RESULT recto_status
smooth_contours_add(struct map *map, struct smooth_curves **curves,
                    const struct smooth_curves_input *input,
                    struct smooth_contours_options options,
                    struct smooth_contours_counts *counts, recto_error *error);

#endif
