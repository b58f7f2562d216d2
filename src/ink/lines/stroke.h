/* stroke.h - adds polylines to a drawing. */
#ifndef INK_LINES_STROKE_H
#define INK_LINES_STROKE_H

#include "drawing/drawing.h"
#include "ink/dash_pattern.h"

/* A polyline before it is added to the drawing, page mm. */
struct stroke_line {
  ARRAY(struct drawing_point) point;
  bool closed;
  bool is_continued[2]; /* an open one at its ends: by a line without gaps */
};

/* Whether a line turns by more than 30 degrees at its middle point: a box has
 * such corners, a circle of 16 sides has none. */
bool stroke_turns_sharply(struct drawing_point p, struct drawing_point q,
                          struct drawing_point r);

/* Length in mm, including the closing side. */
static inline double stroke_line_length(const struct stroke_line *line) {
  return drawing_polyline_mm(line->point.item, line->point.count, line->closed);
}

/* Appends the line; all attributes except its points are those of `like`. */
USE_RESULT bool stroke_add(struct drawing *drawing,
                           const struct drawing_stroke *like,
                           const struct drawing_point *point, size_t count,
                           bool closed);

/* Moves the strokes of another drawing, which has nothing else, to the end of
 * those of this one. */
USE_RESULT bool stroke_move_all(struct drawing *drawing, struct drawing *from);

/* Appends the line as dashes.  They begin and end at the ends of the line and
 * at every corner, with the first dash of the pattern; around a loop without
 * corners they are spread evenly.  At an end where the line is continued a gap
 * comes first, the last of the pattern.
 * pattern  of at least a dash and a gap: gaps and short dashes are exact, the
 *          longest ones are fitted to the length; where a gap is wider than all
 *          dashes, all lengths are
 * A line too short for dashes as long as the widest gap is drawn solid.  The
 * gaps of visible lines are added to the lines that were dropped. */
USE_RESULT bool stroke_add_dashed(struct drawing *drawing,
                                  const struct drawing_stroke *like,
                                  const struct stroke_line *line,
                                  const struct dash_pattern *pattern);

/* Appends a line to those of the drawing that were dropped. */
USE_RESULT bool stroke_add_dropped(struct drawing *drawing,
                                   const struct drawing_stroke *like,
                                   const struct drawing_point *point,
                                   size_t count, bool closed);

#endif
