/* curves.h - cubic Bezier curves in place of smooth strokes. */
#ifndef INK_CURVE_CURVES_H
#define INK_CURVE_CURVES_H

#include "drawing/drawing.h"

/* Fits curves to the strokes of a drawing, which stay as they are.  A curve is
 * nowhere farther than `tolerance` mm from its stroke; it begins and ends where
 * the stroke does, passes every place where the stroke touches or crosses other
 * ink, and elsewhere is farther from the other ink than half of what the stroke
 * is: so no two curves cross that did not before.  Corners stay; sides too long
 * to be part of a curve within the tolerance stay lines, one for several where
 * it fits them, with ends of few decimals where no other ink is met.  Strokes
 * of which no side is saved get no curve.  Where there are fills or hatching,
 * which end at the polylines, no curve leaves them by more than two fifths of
 * its line's width.
 * tolerance  mm, > 0
 * Returns false when memory ran out. */
USE_RESULT bool curves_fit(struct drawing *drawing, double tolerance);

#endif
