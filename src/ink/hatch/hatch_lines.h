/* hatch_lines.h - the hatch lines of a page and the spans of them that lie
 * inside fragments. */
#ifndef INK_HATCH_HATCH_LINES_H
#define INK_HATCH_HATCH_LINES_H

#include "drawing/drawing.h"
#include "geom/scanfill.h"
#include "visibility/map.h"

/* A point of the rotated page, on which the hatch lines are horizontal: u is
 * measured along the lines, v across them, both in mm. */
struct hatch_point {
  double u, v;
};

/* A side of a fragment. */
struct hatch_side {
  struct hatch_point from, to;
  const struct map_corner *corner; /* where the whole side starts; borrowed */
};

/* Where a hatch line crosses a side. */
struct hatch_crossing {
  int64_t line;
  double u;
  uint32_t side; /* its index in hatch_lines.side */
};

/* The part of a hatch line between two crossings, inside the fragments. */
struct hatch_span {
  struct hatch_crossing left, right;
  bool used; /* for the caller; false at first */
};

/* Line k is at v = (k + 1/2) pitch, wherever a fragment lies, so that lines
 * continue from a fragment to its neighbours. */
struct hatch_lines {
  const struct sheet *sheet;
  /* mm; may be changed between hatch_lines_clear and hatch_lines_find_spans */
  double pitch;
  double cosine, sine;           /* of the angle of the lines */
  ARRAY(struct hatch_side) side; /* of the fragments added */
  ARRAY(struct hatch_span) span; /* sorted by line, then from left to right */
  struct scan_grid grid;
  int64_t first;                 /* the number of the grid's line 0 */
  ARRAY(struct scan_span) found; /* on the current line */
};

/* Starts without sides.
 * pitch      mm
 * angle_deg  from the x axis to the lines, counter-clockwise */
void hatch_lines_init(struct hatch_lines *lines, const struct sheet *sheet,
                      double pitch, double angle_deg);
void hatch_lines_fini(struct hatch_lines *lines);

/* The v of a line, mm. */
double hatch_lines_height(const struct hatch_lines *lines, int64_t line);

/* From page to rotated page. */
struct hatch_point hatch_lines_rotate(const struct hatch_lines *lines,
                                      struct drawing_point p);
/* From rotated page to page. */
struct drawing_point hatch_lines_rotate_back(const struct hatch_lines *lines,
                                             struct hatch_point p);

/* The lines [*low, *high) that a side crosses: *low and *high are the lowest
 * lines at or above its lower and its upper end.  Only valid after
 * hatch_lines_find_spans. */
void hatch_lines_side_range(const struct hatch_lines *lines,
                            const struct hatch_side *side, int64_t *low,
                            int64_t *high);

/* The u at which a side that is not horizontal has the given v. */
double hatch_lines_u_at(const struct hatch_side *side, double v);

/* The distance from a point p to the line segment from a to b. */
double hatch_lines_distance(struct hatch_point p, struct hatch_point a,
                            struct hatch_point b);

/* Removes all sides. */
void hatch_lines_clear(struct hatch_lines *lines);

/* Adds the sides of a fragment, without their parts on the half-edges for which
 * `skip` is 1; NULL: all.  False when memory ran out. */
USE_RESULT bool hatch_lines_add_fragment(struct hatch_lines *lines,
                                         const struct map *map,
                                         const struct map_fragment *fragment,
                                         const uint8_t *skip);

/* Sets `span` to the spans inside the sides by the even-odd rule; each has a
 * positive length.  False when memory ran out. */
USE_RESULT bool hatch_lines_find_spans(struct hatch_lines *lines);

#endif
