/* ruling.h - the page ruled with parallel lines, and what of them lies in
 * fragments. */
#ifndef INK_RULING_H
#define INK_RULING_H

#include "geom/scanfill.h"
#include "ink/drawing.h"
#include "visibility/map.h"

/* mm along the lines, mm across: the page turned so that they are level. */
struct ruling_place {
  double u, v;
};

struct ruling_side {
  struct ruling_place from, to;
  const struct map_corner *corner, *next; /* that it leaves, it leads to */
};

struct ruling_crossing {
  int64_t line;
  double u;
  uint32_t side;
};

/* Between two crossings of a line. */
struct ruling_span {
  struct ruling_crossing left, right;
  bool used; /* the caller's */
};

/* Line k is at v = (k + 1/2) pitch, wherever a fragment lies: over neighbours
 * the lines meet. */
struct ruling {
  const struct sheet *sheet;
  double pitch; /* mm; may be changed between ruling_clear and _find_spans */
  double cosine, sine;
  ARRAY(struct ruling_side) side; /* of the fragments at hand */
  ARRAY(struct ruling_span) span; /* by line, then from the left */
  struct scan_grid grid;
  int64_t first;                 /* the grid's line 0 */
  ARRAY(struct scan_span) found; /* on the line at hand */
};

/* angle_deg  of the lines from the x axis, counter-clockwise */
void ruling_init(struct ruling *ruling, const struct sheet *sheet, double pitch,
                 double angle_deg);
void ruling_fini(struct ruling *ruling);

double ruling_height(const struct ruling *ruling, int64_t line);

struct ruling_place ruling_turn(const struct ruling *ruling,
                                struct drawing_point p);
/* Of a place of the sheet, grid units. */
struct ruling_place ruling_place_at(const struct ruling *ruling, double x,
                                    double y);
struct drawing_point ruling_turn_back(const struct ruling *ruling,
                                      struct ruling_place p);

/* The lowest and the highest line at or above an end of the side: it crosses
 * the lines [low, high).  After ruling_find_spans. */
void ruling_find_lines(const struct ruling *ruling,
                       const struct ruling_side *side, int64_t *low,
                       int64_t *high);

/* Where a side that is not level is at height v. */
double ruling_u_at(const struct ruling_side *side, double v);

/* From a place to the nearest one between two others. */
double ruling_distance(struct ruling_place p, struct ruling_place a,
                       struct ruling_place b);

/* Forgets all sides; takes those of one more fragment; finds the spans, which
 * have a length each. */
void ruling_clear(struct ruling *ruling);
USE_RESULT bool ruling_take(struct ruling *ruling, const struct map *map,
                            const struct map_fragment *fragment);
USE_RESULT bool ruling_find_spans(struct ruling *ruling);

#endif
