/* section_phases.h - the phases of section_solve, and what they share. */
#ifndef CUT_SECTION_PHASES_H
#define CUT_SECTION_PHASES_H

#include "cut/section.h"
#include "geom/int128.h"

/* Positive where c is left of the line from a to b; exact. */
static inline int section_side(const struct section_node *a,
                               const struct section_node *b,
                               const struct section_node *c) {
  int128 left = (int128)(b->u - a->u) * (c->v - a->v);
  int128 right = (int128)(b->v - a->v) * (c->u - a->u);
  return (left > right) - (left < right);
}

/* Splits the segments where they cross or touch: sets the paths.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_LIMIT */
USE_RESULT recto_status section_snap(struct section *section,
                                     recto_error *error);

/* Sweeps over the edges, which are sorted by a and then upwards.
 * helper  NULL: sets the labels beside each edge.  Else sweeps over boundaries
 *         alone, and gets for each node the node to its left that a bridge
 *         joins it to, where it is the first one of a boundary within a place
 *         that is inside; SECTION_NONE for the others
 * planar  set to whether no edges cross or touch but at nodes; where they do
 *         the labels are not all set
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_LIMIT
 * Cost    n log n, and the edges that the sweep meets at once for each node */
USE_RESULT recto_status section_sweep(struct section *section, uint32_t *helper,
                                      bool *planar, recto_error *error);

/* Traces the boundaries along the edges between places of different labels. */
USE_RESULT bool section_trace(struct section *section, const uint32_t *helper);

#endif
