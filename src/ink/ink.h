/* ink.h - turns the visible map into a drawing of strokes and fills. */
#ifndef INK_INK_H
#define INK_INK_H

#include "drawing/drawing.h"
#include "visibility/map.h"

/* The greatest distance in mm between a drawn line and the edge that it shows,
 * as far as simplification and the output's step unit_mm cause it. */
double ink_deviation_mm(const recto_options *options);

/* Makes the drawing of a solved sheet.
 * Phases
 *   1 visible intervals, and hidden ones if requested, become segments
 *   2 of segments that coincide one is kept
 *   3 segments are chained into polylines as long as possible
 *   4 collinear points are removed, then the polylines are simplified
 *   5 polylines that are too short are dropped, others may be dashed
 *   6 strokes are sorted into layers, and fills are added
 * drawing  initialised, empty; its page, layers, strokes and fills are set */
USE_RESULT recto_status ink_draw(struct drawing *drawing,
                                 const struct sheet *sheet,
                                 const struct scene *scene,
                                 const struct map *map,
                                 const recto_options *options,
                                 recto_error *error);

#endif
