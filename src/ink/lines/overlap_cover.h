/* overlap_cover.h - the part of a segment that another one overlaps, at the
 * output's precision. */
#ifndef INK_LINES_OVERLAP_COVER_H
#define INK_LINES_OVERLAP_COVER_H

#include "ink/lines/vertex_snapping.h"

/* The part of a segment that a kept piece overlaps: from..to grid units along
 * it, and the nodes at which it is split there; SEGMENT_GRAPH_NONE at the
 * segment's own ends. */
struct overlap_cover {
  double from, to;
  uint32_t node[2];
};

/* Whether the segments overlap by more than the output step or, where one is
 * shorter than two steps, by half of it; if so, *cover is the part of a that b
 * overlaps. */
USE_RESULT bool overlap_cover_find(const struct vertex_snapping *snapping,
                                   const uint32_t a[2], const uint32_t b[2],
                                   struct overlap_cover *cover);

#endif
