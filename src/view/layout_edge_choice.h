/* layout_edge_choice.h - chooses the edges that are made, and contours. */
#ifndef VIEW_LAYOUT_EDGE_CHOICE_H
#define VIEW_LAYOUT_EDGE_CHOICE_H

#include "base/parallel.h"
#include "view/layout_phases.h"

/* Edges that a thread takes at once: whole words of maps of a bit an edge. */
enum { LAYOUT_EDGES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

/* Sets the classes of edges in layout->class_masks, if any is requested, and
 * the bits in layout->ids of those that are to be made.
 * special  a bit an edge, all 0: set for contours, and for those that are to be
 *          made and leave the page
 * Returns false where the caller cancelled. */
USE_RESULT bool layout_choose_edges(struct layout *layout, uint64_t *special);

/* Whether an edge has not two faces, one on each side of it. */
bool layout_is_contour(const struct layout *layout, uint32_t edge);

/* Whether silhouettes are edges of the mesh at a point; else they are found
 * after it was solved (visibility/smooth_contours.h). */
bool layout_has_mesh_contours(const struct layout *layout, uint32_t point);

#endif
