/* stroke.h - putting polylines into a drawing. */
#ifndef INK_LINES_STROKE_H
#define INK_LINES_STROKE_H

#include "drawing/drawing.h"

/* A polyline on its way into the drawing, page mm. */
struct stroke_line {
  ARRAY(struct drawing_point) point;
  bool closed;
};

double stroke_distance(struct drawing_point a, struct drawing_point b);

/* Drawn length, the closing side included, mm. */
double stroke_line_length(const struct stroke_line *line);

/* Appends the line; everything but its points is taken from `like`. */
USE_RESULT bool stroke_add(struct drawing *drawing,
                           const struct drawing_stroke *like,
                           const struct drawing_point *point, size_t count,
                           bool closed);

/* Appends the line as dashes.  They begin and end with ink, at every corner
 * too; around a loop without any they are spread evenly.
 * dash, gap  mm, > 0: gaps are kept, dashes are fitted to the length
 * A line too short for two dashes as long as the gap is drawn whole. */
USE_RESULT bool stroke_add_dashed(struct drawing *drawing,
                                  const struct drawing_stroke *like,
                                  const struct stroke_line *line, double dash,
                                  double gap);

#endif
