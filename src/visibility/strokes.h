/* strokes.h - from what triangles hide of an edge to its visible intervals. */
#ifndef VISIBILITY_STROKES_H
#define VISIBILITY_STROKES_H

#include "visibility/hide.h"
#include "visibility/map.h"

typedef ARRAY(struct hidden_part) stroke_parts;

/* What is hidden of the edge at hand; one a thread, used edge by edge. */
struct strokes {
  stroke_parts both; /* parts with both sides covered: in order and apart, a
                        few at most */
  stroke_parts part; /* the others, as they came */
  stroke_parts left, right; /* scratch: united, by side */
  bool whole;               /* hidden from end to end: no more need be asked */
};

/* Zero-initialised is empty. */
void strokes_fini(struct strokes *strokes);

/* Forgets the last edge. */
static inline void strokes_start(struct strokes *strokes) {
  strokes->both.count = 0;
  strokes->part.count = 0;
  strokes->whole = false;
}

/* Adds a hidden part; false when memory ran out. */
USE_RESULT bool strokes_hide(struct strokes *strokes, struct hidden_part part);

/* The hidden parts united: those of one side in order and apart.  They are valid
 * until the next call.  Returns NULL when memory ran out. */
const stroke_parts *strokes_unite(struct strokes *strokes);

/* The stretch of the edge, from end to end, beyond which all is known to be
 * hidden. */
struct hidden_part strokes_rest(const struct strokes *strokes);

/* Room in the map for the edges of the sheet; those it had no room for yet
 * are hidden at first. */
USE_RESULT bool strokes_open_map(struct map *map, size_t edge_count);

/* Files the visible intervals of `edge` in the map.  Edges come in ascending
 * order.  An edge is hidden where both of its sides are covered; a visible
 * piece without length is none. */
USE_RESULT bool strokes_file(struct strokes *strokes, uint32_t edge,
                             struct map *map);

#endif
