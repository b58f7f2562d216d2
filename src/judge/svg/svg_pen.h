/* svg_pen.h - draws lines and curves of an SVG file, on the page alone. */
#ifndef JUDGE_SVG_SVG_PEN_H
#define JUDGE_SVG_SVG_PEN_H

#include "judge/judge.h"
#include "judge/svg/svg_scan.h"

/* Draws into a judge_drawing.  Positions are the element's own.
 *
 * What lies beyond the page and a margin round it is left out, so that no
 * length counts that nobody can see.  The margin is how far ink may be from
 * where it is looked for: a quarter of the widest pen. */
struct svg_pen {
  struct judge_drawing *drawing;
  struct svg_matrix to_page; /* mm, y up */
  enum judge_role role;
  struct judge_point2 start, here;
  struct judge_point2 last; /* `here`, on the page */
  bool down;                /* lines go on from `last` */
  bool joined;              /* the drawing's last stroke ends there */
  size_t *pieces;           /* of curves that may still be stored */
  bool starved;             /* memory ran out */
  const char *fault;        /* NULL, or what is wrong */
};

void svg_pen_move(struct svg_pen *pen, double x, double y);
void svg_pen_line(struct svg_pen *pen, double x, double y);
/* A cubic curve, as so many straight pieces that none on the page is off by
 * more than TOLERANCE_CURVE_MM. */
void svg_pen_curve(struct svg_pen *pen, struct judge_point2 b,
                   struct judge_point2 c, struct judge_point2 d);
void svg_pen_close(struct svg_pen *pen);

#endif
