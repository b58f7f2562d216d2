/* cut_lines.h - which lines of a section are closed, and of which group
 * what they enclose is. */
#ifndef CUT_CUT_LINES_H
#define CUT_CUT_LINES_H

#include "cut/cut_points.h"

/* A line in which a face meets a plane, with the inside on its left as seen
 * from beyond the plane. */
struct cut_line {
  uint32_t from, to; /* points of the cut */
  uint32_t group;    /* of its face; then of its curve */
  uint8_t plane;
  bool open; /* it encloses nothing */
};

struct cut_lines {
  ARRAY(struct cut_line) line;
};

/* Joins the lines to curves by their ends, and gives each curve the group of
 * most of its length.  What all planes remove is convex, and a curve runs on
 * its surface, from plane to plane.
 * A curve is closed where as many of its lines end as begin at each point.  One
 * that is not loses its duplicate lines, and lines to points that have no
 * other; if then an even number of lines is left at each point, they are turned
 * to run around.  What remains is open.
 * open     is increased by the number of open curves
 * open_at  set to a point of the first of them, if it is SCENE_NONE
 * Returns false when memory ran out.
 * Cost     n log n */
USE_RESULT bool cut_lines_close(struct cut_lines *lines,
                                const struct cut_points *points, size_t *open,
                                uint32_t *open_at);

#endif
