/* curve_ends.h - how contours lead to where they end. */
#ifndef VISIBILITY_CONTOUR_CURVE_ENDS_H
#define VISIBILITY_CONTOUR_CURVE_ENDS_H

#include "view/sheet.h"

/* The edge of a contour's curve that goes on from another one at one of its
 * points, as they follow each other in the sheet; SHEET_NONE: there is none.
 * first   of the sheet's edges: the first one of a contour
 * before  the edge that led to that one; it is not the next one, also where the
 *         curve returns to where it begins after two; SHEET_NONE: none did */
uint32_t curve_next_edge(const struct sheet *sheet, uint32_t first,
                         uint32_t before, uint32_t edge, uint32_t point);

/* The first point back along a curve that is at least so far on the page from
 * where it ends: its last segments may turn back.
 * edge  of the sheet: the curve's last one, and k its point there */
struct geom_point curve_before_end(const struct sheet *sheet, uint32_t first,
                                   uint32_t edge, int k, double distance);

#endif
