/* hatch_lines.h - the page ruled with parallel lines, and what of them lies in
 * fragments. */
#ifndef INK_HATCH_HATCH_LINES_H
#define INK_HATCH_HATCH_LINES_H

#include "geom/scanfill.h"
#include "drawing/drawing.h"
#include "visibility/map.h"

/* mm along the lines, mm across: the page turned so that they are level. */
struct hatch_point {
  double u, v;
};

struct hatch_side {
  struct hatch_point from, to;
  const struct map_corner *corner, *next; /* that it leaves, it leads to */
};

struct hatch_crossing {
  int64_t line;
  double u;
  uint32_t side;
};

/* Between two crossings of a line. */
struct hatch_span {
  struct hatch_crossing left, right;
  bool used; /* the caller's */
};

/* Line k is at v = (k + 1/2) pitch, wherever a fragment lies: over neighbours
 * the lines meet. */
struct hatch_lines {
  const struct sheet *sheet;
  double
      pitch; /* mm; may be changed between hatch_lines_clear and _find_spans */
  double cosine, sine;
  ARRAY(struct hatch_side) side; /* of the fragments at hand */
  ARRAY(struct hatch_span) span; /* by line, then from the left */
  struct scan_grid grid;
  int64_t first;                 /* the grid's line 0 */
  ARRAY(struct scan_span) found; /* on the line at hand */
};

/* angle_deg  of the lines from the x axis, counter-clockwise */
void hatch_lines_init(struct hatch_lines *lines, const struct sheet *sheet,
                      double pitch, double angle_deg);
void hatch_lines_fini(struct hatch_lines *lines);

double hatch_lines_height(const struct hatch_lines *lines, int64_t line);

struct hatch_point hatch_lines_turn(const struct hatch_lines *lines,
                                    struct drawing_point p);
/* Of a place of the sheet, grid units. */
struct hatch_point hatch_point_at(const struct hatch_lines *lines, double x,
                                  double y);
struct drawing_point hatch_lines_turn_back(const struct hatch_lines *lines,
                                           struct hatch_point p);

/* The lowest and the highest line at or above an end of the side: it crosses
 * the lines [low, high).  After hatch_lines_find_spans. */
void hatch_lines_find_lines(const struct hatch_lines *lines,
                            const struct hatch_side *side, int64_t *low,
                            int64_t *high);

/* Where a side that is not level is at height v. */
double hatch_lines_u_at(const struct hatch_side *side, double v);

/* From a place to the nearest one between two others. */
double hatch_lines_distance(struct hatch_point p, struct hatch_point a,
                            struct hatch_point b);

/* Forgets all sides; takes those of one more fragment; finds the spans, which
 * have a length each. */
void hatch_lines_clear(struct hatch_lines *lines);
USE_RESULT bool hatch_lines_take(struct hatch_lines *lines,
                                 const struct map *map,
                                 const struct map_fragment *fragment);
USE_RESULT bool hatch_lines_find_spans(struct hatch_lines *lines);

#endif
