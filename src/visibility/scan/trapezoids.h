/* trapezoids.h - visible spans, line by line from the top, as the map's fragments.
 *
 * A span stands for the band of its line, half a line up and half a line down.
 * Spans of neighbouring lines over the same face, with the same left and the
 * same right edge, are joined to one trapezoid.  Upper and lower sides are the
 * scan's own cuts.
 *
 * Spans of a line that meet share the border between them, and borders that
 * would cross within the band (edges that cross or end there) meet in their
 * middle instead: so fragments are disjoint.
 */
#ifndef VISIBILITY_SCAN_TRAPEZOIDS_H
#define VISIBILITY_SCAN_TRAPEZOIDS_H

#include "geom/scanfill.h"
#include "visibility/map.h"

#define SPAN_ALONE UINT32_MAX

struct span_side {
  double x;            /* on the line; of spans that meet the same */
  double upper, lower; /* at the upper and lower border of the band, plane
                          units */
  bool straight;       /* all three are on one line, that of the key */
  uint32_t key;        /* what it runs along: equal for the same edge on the
                          next line; SPAN_ALONE: never the same */
  uint32_t id;         /* as in struct map_corner */
  uint8_t side;        /* enum map_side */
};

struct span {
  uint32_t face; /* scene face */
  struct span_side left, right;
};

/* Spans that were joined, from the upper border of the first line to the lower
 * border of the last. */
struct trapezoid {
  struct span span;
  int32_t first, last;
};

struct trapezoids {
  struct scan_grid grid;
  double x_low, x_high, y_low, y_high; /* the page, plane units */
  ARRAY(struct span) row;              /* of the line at hand */
  int32_t line;
  ARRAY(double) border; /* room for x of the row's borders, left to right */
  ARRAY(struct span_side *)
  side; /* two a border: that of the span before it
           and of the one after; NULL: none */
  ARRAY(struct trapezoid) trapezoid;
  uint32_t *at; /* for each key of a left side, the last trapezoid on it */
  size_t keys;
  int64_t count; /* spans taken */
};

/* keys  of left sides, below it */
USE_RESULT bool trapezoids_init(struct trapezoids *trapezoids,
                                const struct sheet *sheet,
                                const struct scan_grid *grid, size_t keys);
void trapezoids_fini(struct trapezoids *trapezoids);

/* Adds a span of a line; lines come in falling order. */
USE_RESULT bool trapezoids_add(struct trapezoids *trapezoids, int32_t line,
                               const struct span *span);

/* Writes all trapezoids to the map, ordered by face, then from the top. */
USE_RESULT bool trapezoids_finish(struct trapezoids *trapezoids,
                                  struct map *map);

#endif
