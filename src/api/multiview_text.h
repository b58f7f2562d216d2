/* multiview_text.h - the title of a sheet, and the names of its views and
 * details. */
#ifndef API_MULTIVIEW_TEXT_H
#define API_MULTIVIEW_TEXT_H

#include "api/multiview_layout.h"
#include "drawing/drawing.h"

/* The width of the pen that draws text, and the circles about details. */
double multiview_text_pen_mm(const recto_options *options);

/* Draws the title at the foot of the page, and below each view its name, with
 * its scale if that is a true one and not the sheet's; for each detail a circle
 * about what it shows and one about it, with its letter: strokes of pen 1, on a
 * layer of their own.
 * Returns false when memory ran out. */
USE_RESULT bool multiview_text_add(struct drawing *drawing,
                                   const struct multiview *views,
                                   const recto_options *options);

#endif
