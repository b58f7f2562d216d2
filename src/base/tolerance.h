/* tolerance.h - every tolerance of the house, in one place.
 *
 * None of these decides what is visible: they serve input that was rounded
 * before it came to us, and output.  Each says its unit, where it comes from,
 * who uses it, and what ten times as much would do.
 */
#ifndef BASE_TOLERANCE_H
#define BASE_TOLERANCE_H

/* Lines that are the same on the page count as one within this distance.
 * Unit        page grid units (2^-20 mm)
 * Derivation  an end point is rounded by at most 1/2 unit in x and in y, so by
 *             0.71 across any line; of two pieces of one line, each end lies
 *             within 2 * 0.71 = 1.41 of the other piece: rounded up.
 * Users       ink/nodes.c, ink/coincident.c
 * Ten times   lines 20 nm apart, such as two models side by side, become one:
 *             still far below what a pen can show. */
#define TOLERANCE_COINCIDENT_UNITS 2

/* A point this close to the straight line past it is no corner.
 * Unit        page grid units (2^-20 mm)
 * Derivation  the points of a subdivided straight edge are rounded like any
 *             other, 1.41 units as above; those that TOLERANCE_COINCIDENT_UNITS
 *             moved are off by as much again in either direction, rarely.
 * Users       ink/straighten.c
 * Ten times   a finely divided circle loses points where it bends by less
 *             than 20 nm: shorter files, no visible change. */
#define TOLERANCE_COLLINEAR_UNITS 2.0

#endif
