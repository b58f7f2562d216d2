/* svg_path.h - the outlines of an SVG file's elements, as straight strokes. */
#ifndef JUDGE_SVG_PATH_H
#define JUDGE_SVG_PATH_H

#include "judge/judge.h"
#include "judge/svg_scan.h"

/* Draws into a judge_drawing.  Positions are the element's own. */
struct svg_pen {
  struct judge_drawing *drawing;
  struct svg_matrix to_page; /* mm, y up */
  enum judge_role role;
  struct judge_place start, here;
  bool down;    /* a stroke has begun */
  bool starved; /* memory ran out */
};

void svg_pen_move(struct svg_pen *pen, double x, double y);
void svg_pen_line(struct svg_pen *pen, double x, double y);
/* A cubic curve, as so many straight pieces that none is off by more than
 * TOLERANCE_CURVE_MM. */
void svg_pen_curve(struct svg_pen *pen, struct judge_place b,
                   struct judge_place c, struct judge_place d);
/* An arc of an ellipse as SVG has it; angle in degrees. */
void svg_pen_arc(struct svg_pen *pen, double rx, double ry, double angle_deg,
                 bool large, bool sweep, struct judge_place to);
void svg_pen_close(struct svg_pen *pen);

/* Draws what a path's data say.  Returns NULL, or what is wrong with them. */
const char *svg_path(struct svg_pen *pen, struct svg_text data);

#endif
