/* svg_pen.h - adds lines and curves of an SVG file to a drawing, clipped to the
 * page. */
#ifndef JUDGE_SVG_SVG_PEN_H
#define JUDGE_SVG_SVG_PEN_H

#include "judge/drawing.h"
#include "judge/svg/svg_scan.h"

/* Adds strokes to a judge_drawing.  Positions are in the element's coordinates.
 *
 * Lines are clipped to the page and a margin around it, so that lines outside
 * the page do not count.  The margin is the distance within which ink is looked
 * for, a quarter of the widest pen. */
struct svg_pen {
  struct judge_drawing *drawing;
  struct svg_matrix to_page; /* mm, y up */
  enum judge_role role;
  struct judge_point2 start, here;
  struct judge_point2 last; /* `here`, on the page */
  bool down;                /* the next line starts at `last` */
  bool joined;              /* the drawing's last stroke ends there */
  size_t *pieces;           /* segments of curves that may still be stored */
  bool out_of_memory;
  const char *fault; /* NULL, or a description of the error */
};

void svg_pen_move(struct svg_pen *pen, double x, double y);
void svg_pen_line(struct svg_pen *pen, double x, double y);
/* Adds a cubic Bezier curve as line segments; on the page none is farther than
 * TOLERANCE_CURVE_MM from it. */
void svg_pen_curve(struct svg_pen *pen, struct judge_point2 b,
                   struct judge_point2 c, struct judge_point2 d);
void svg_pen_close(struct svg_pen *pen);

#endif
