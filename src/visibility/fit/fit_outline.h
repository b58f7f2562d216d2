/* fit_outline.h - lets the outline of the visible fragments run along the lines
 * that are drawn there. */
#ifndef VISIBILITY_FIT_FIT_OUTLINE_H
#define VISIBILITY_FIT_FIT_OUTLINE_H

#include "visibility/fit/drawn_outlines.h"

/* Moves what is farther from the drawn outlines than TOLERANCE_FILL_UNITS to
 * the nearest point of one: corners, together with all that are at the same
 * place, and points of the sides beyond which no face is seen.  Where two
 * outlines meet it goes on from one to the other there.
 * Bound  nothing moves farther than its face is wide on the page
 * Cost   near linear in the sides
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fit_outline(struct map *map, const struct sheet *sheet,
                            const struct drawn_outlines *drawn);

#endif
