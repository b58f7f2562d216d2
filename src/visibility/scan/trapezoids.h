/* trapezoids.h - trapezoids from visible spans, line by line from the top, as
 * fragments of the map.
 *
 * A span represents the band of its line, half a line up and half a line down.
 * Spans of neighbouring lines over the same face, between the same left and the
 * same right edge, are merged into one trapezoid.  Its upper and lower sides
 * are cuts of the method (MAP_SIDE_CLIP), never inked.
 *
 * Spans of a line that touch share the border between them.  Borders that would
 * cross within the band (since edges cross or end there) are moved to their
 * mean x: so fragments are disjoint.
 */
#ifndef VISIBILITY_SCAN_TRAPEZOIDS_H
#define VISIBILITY_SCAN_TRAPEZOIDS_H

#include "geom/scanfill.h"
#include "visibility/fragments/planar_subdivision.h"

#define SPAN_ALONE UINT32_MAX

struct span_side {
  double x;            /* on the line; equal for two spans that touch */
  double upper, lower; /* at the upper and lower border of the band, plane
                          units */
  bool straight;       /* all three lie on the line of the edge `key` */
  uint32_t key;        /* identifies the edge that it runs along from line to
                          line; SPAN_ALONE: none */
  uint32_t id;         /* as in struct map_corner */
  uint8_t side;        /* enum map_side */
};

struct span {
  uint32_t face; /* scene face */
  struct span_side left, right;
};

/* Merged spans, from the upper border of the first line to the lower border of
 * the last. */
struct trapezoid {
  struct span span;
  int32_t first, last;
};

struct trapezoids {
  const struct sheet *sheet;
  struct scan_grid grid;
  double x_low, x_high, y_low, y_high; /* the page, plane units */
  ARRAY(struct span) row;              /* of the current line */
  int32_t line;
  ARRAY(double) border; /* room for x of the row's borders, left to right */
  /* Two a border: that of the span before it and of the one after; NULL:
   * none. */
  ARRAY(struct span_side *) side;
  ARRAY(struct trapezoid) trapezoid;
  uint32_t *at;     /* for each key of a left side, the last trapezoid on it */
  int64_t count;    /* spans added */
  side_lines lines; /* of the sides stored */
};

/* keys  upper limit of the keys of left sides
 * Returns false when memory ran out. */
USE_RESULT bool trapezoids_init(struct trapezoids *trapezoids,
                                const struct sheet *sheet,
                                const struct scan_grid *grid, size_t keys);
void trapezoids_fini(struct trapezoids *trapezoids);

/* Adds a span; lines come in descending order, the spans of one from the left.
 * Returns false when memory ran out. */
USE_RESULT bool trapezoids_add(struct trapezoids *trapezoids, int32_t line,
                               const struct span *span);

/* Writes all trapezoids to the map, ordered by face, then from the top, with
 * their half-edges. */
USE_RESULT bool trapezoids_finish(struct trapezoids *trapezoids,
                                  struct map *map);

#endif
