/* ink.h - from the visible map to a drawing: choose, join, dash, lay out. */
#ifndef INK_INK_H
#define INK_INK_H

#include "drawing/drawing.h"
#include "visibility/map.h"

/* How far a line may be drawn from what it is the line of, mm: by simplifying,
 * and for the sake of an output that knows no less than unit_mm. */
double ink_drift_mm(const recto_options *options);

/* Makes the drawing of a solved sheet.
 * Phases: visible (and, where asked, hidden) intervals become segments;
 * segments that coincide are kept once; the rest is chained into the longest
 * polylines, cleaned of collinear points, simplified, dashed, filtered by
 * length, and dealt to layers.
 * drawing  initialised, empty; its page, layers, strokes and fills are set */
USE_RESULT recto_status ink_draw(struct drawing *drawing,
                                 const struct sheet *sheet,
                                 const struct scene *scene,
                                 const struct map *map,
                                 const recto_options *options,
                                 recto_error *error);

#endif
