/* unread_edges.h - the hidden edges that ink does not look at, which the join
 * does without. */
#ifndef PARTS_UNREAD_EDGES_H
#define PARTS_UNREAD_EDGES_H

#include "parts/part_sources.h"

/* Zero-initialised is none. */
struct unread_edges {
  const struct part *part;
  const struct part_sources *from;
  /* One a point of the sheet: an edge that is not smooth ends there; NULL: ink
   * may look at all edges. */
  uint8_t *has_line;
};

/* Finds where such edges may be: ink that draws no hidden lines and no faces
 * looks at smooth ones only where lines end.
 * part  its window and what all parts have in common are set; like the sources
 *       it outlives the edges
 * Returns false when memory ran out; end with unread_edges_fini either way. */
USE_RESULT bool unread_edges_find(struct unread_edges *unread,
                                  const struct part *part,
                                  const struct part_sources *from);
void unread_edges_fini(struct unread_edges *unread);

/* Whether the join does without an edge of the sheet: no other part lists it,
 * and it is one of those that ink does not look at. */
bool unread_edges_have(const struct unread_edges *unread, uint32_t edge);

#endif
