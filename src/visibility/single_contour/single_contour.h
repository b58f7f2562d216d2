/* single_contour.h - sheets of which one outline tells that nothing asked for is
 * hidden.
 *
 * Away from the contours (sheet.h) the projected faces neither fold nor end:
 * over any two points of the page that no contour parts, equally many faces
 * lie.  So where all contours together are one simple loop, nothing lies
 * outside of it, and equally many faces over every point within.  Then
 *   - the loop itself is visible, whatever the depths: beyond it there is
 *     nothing, and what is covered on one side only is seen;
 *   - where the faces' areas add up to that of the loop, just one lies over
 *     every point: nothing hides anything, and nothing pierces.
 * Both are decided by integers, in a pass over the contours and, for the
 * second, one over the triangles.
 *
 * A convex body is of this kind, but two of its faces lie over every point, and
 * the page cannot tell which is in front: see doc/decisions/0018.
 */
#ifndef VISIBILITY_SINGLE_CONTOUR_SINGLE_CONTOUR_H
#define VISIBILITY_SINGLE_CONTOUR_SINGLE_CONTOUR_H

#include "visibility/solver.h"

/* Is all that is asked for visible, for certain?  No, too, when memory ran
 * out. */
bool single_contour_suffices(const struct sheet *sheet,
                             const struct solver_request *request);

/* Solves such a sheet. */
extern const struct solver solver_single_contour;

#endif
