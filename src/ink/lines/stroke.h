/* stroke.h - adds polylines to a drawing. */
#ifndef INK_LINES_STROKE_H
#define INK_LINES_STROKE_H

#include "drawing/drawing.h"

/* A polyline before it is added to the drawing, page mm. */
struct stroke_line {
  ARRAY(struct drawing_point) point;
  bool closed;
};

/* Length in mm, including the closing side. */
static inline double stroke_line_length(const struct stroke_line *line) {
  return drawing_polyline_mm(line->point.item, line->point.count, line->closed);
}

/* Appends the line; all attributes except its points are those of `like`. */
USE_RESULT bool stroke_add(struct drawing *drawing,
                           const struct drawing_stroke *like,
                           const struct drawing_point *point, size_t count,
                           bool closed);

/* Appends the line as dashes.  Dashes begin and end at the ends of the line and
 * at every corner; around a loop without corners they are spread evenly.
 * dash, gap  mm, > 0: gaps are exact, dashes are fitted to the length
 * A line too short for two dashes as long as the gap is drawn solid. */
USE_RESULT bool stroke_add_dashed(struct drawing *drawing,
                                  const struct drawing_stroke *like,
                                  const struct stroke_line *line, double dash,
                                  double gap);

#endif
