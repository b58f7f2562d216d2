/* dash_pattern.h - which lines are drawn as which dashes, by the options. */
#ifndef INK_DASH_PATTERN_H
#define INK_DASH_PATTERN_H

#include "drawing/drawing.h"
#include "recto.h"

/* A pattern of dashes: the lengths of a dash, a gap, a dash ..., which repeat.
 * It begins with a dash and ends with a gap. */
struct dash_pattern {
  double mm[RECTO_DASH_MAX]; /* above 0 */
  int count;                 /* even; 0: a line without gaps */
};

/* The pattern of a stroke of the drawing, without its points. */
struct dash_pattern dash_pattern_of(const recto_options *options,
                                    const struct drawing *drawing,
                                    const struct drawing_stroke *stroke);

/* The classes, a mask, whose visible lines are drawn as dashes. */
unsigned dash_pattern_classes(const recto_options *options);

/* Sets the lengths of a pattern to those of the line type of that name, in pen
 * widths.  Returns false where there is none. */
bool dash_pattern_named(const char *name, recto_dash *dash);

/* The name of the line type at `index`; NULL past the last. */
const char *dash_pattern_name(size_t index);

#endif
