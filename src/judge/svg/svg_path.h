/* svg_path.h - converts SVG path data and arcs to line segments. */
#ifndef JUDGE_SVG_SVG_PATH_H
#define JUDGE_SVG_SVG_PATH_H

#include "judge/svg/svg_pen.h"

/* Adds an elliptical arc, with the parameters of SVG; angle in degrees. */
void svg_pen_arc(struct svg_pen *pen, double rx, double ry, double angle_deg,
                 bool large, bool sweep, struct judge_point2 to);

/* Adds the strokes of path data.  Returns NULL, or a description of the
 * error. */
const char *svg_path(struct svg_pen *pen, struct svg_text data);

#endif
