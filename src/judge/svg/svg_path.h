/* svg_path.h - the outlines of an SVG file's elements, as straight strokes. */
#ifndef JUDGE_SVG_SVG_PATH_H
#define JUDGE_SVG_SVG_PATH_H

#include "judge/svg/svg_pen.h"

/* An arc of an ellipse as SVG has it; angle in degrees. */
void svg_pen_arc(struct svg_pen *pen, double rx, double ry, double angle_deg,
                 bool large, bool sweep, struct judge_point2 to);

/* Draws what a path's data say.  Returns NULL, or what is wrong with them. */
const char *svg_path(struct svg_pen *pen, struct svg_text data);

#endif
