/* append.h - puts several drawings of one scene on one page. */
#ifndef DRAWING_APPEND_H
#define DRAWING_APPEND_H

#include "drawing/drawing.h"

/* Appends the layers, strokes and fills of a drawing of the same page and scene
 * to another one, which may be empty; what that has for the judge is left out.
 * view  names the layers appended, a literal: the label "2 hidden" becomes
 *       "2 front hidden"
 * Errors  RECTO_ERROR_LIMIT: indices of 32 bits do not suffice;
 *         RECTO_ERROR_MEMORY */
USE_RESULT recto_status drawing_append(struct drawing *drawing,
                                       const struct drawing *other,
                                       const char *view, recto_error *error);

#endif
