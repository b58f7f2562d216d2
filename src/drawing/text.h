/* text.h - text as strokes of a pen, in Hershey's simplex Roman font. */
#ifndef DRAWING_TEXT_H
#define DRAWING_TEXT_H

#include "drawing/drawing.h"

/* A line of text, its height that of a capital. */
struct text_line {
  const char *text; /* UTF-8, valid by text_check */
  double height_mm;
};

/* Checks whether there is a glyph for every character: those of ASCII, the
 * letters of Latin-1 with accents, the sharp s and the degree sign.
 * what    "the title", for the message
 * Errors  RECTO_ERROR_ARGUMENT: there is none, or the text is no UTF-8 */
USE_RESULT recto_status text_check(const char *text, const char *what,
                                   recto_error *error);

/* The width in mm, the space before and behind letters included. */
double text_width_mm(const struct text_line *line);

/* Appends the strokes of a line to the drawing.
 * at  the left end of its baseline
 * Returns false when memory ran out. */
USE_RESULT bool text_add(struct drawing *drawing, uint32_t layer,
                         const struct text_line *line, struct drawing_point at);

#endif
