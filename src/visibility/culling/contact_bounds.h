/* contact_bounds.h - lowers the bounds of an occlusion buffer so far that
 * nothing behind them is in contact with what may be visible.
 *
 * A fragment of a visible triangle V belongs to an earlier triangle T that
 * overlaps it and touches it: all corners of one are in contact with the plane
 * of the other.  What hides T decides about T's own fragments, but not about
 * these.
 *
 * Claim.  Let D be an upper bound of V's contact tolerance as a depth, and let
 * V be no needle: its least height on the page is at least 8 times `slope`
 * (coarse_plane.h).  If T touches V, then where both are they are less than
 * 2 D apart in depth, however steep T is.
 *
 * Proof.  If the corners of T are in contact with V's plane, T is within D of
 * it.  Otherwise those of V are within E of T's plane, where E is T's tolerance
 * as a depth.  With s and t the sums of the magnitudes of the two slopes of V
 * and of T,
 *     D = 1 + level + slope s,  E <= 1 + level + slope t.
 * The difference in depth of the two planes is linear on the page, and at most
 * E at the corners of V.  So its gradient is at most 2 E / height, and t <= s +
 * sqrt(2) 2 E / height <= s + E / (2.8 slope), from which E <= D + E / 2.8 and
 * so E < 2 D.
 *
 * Where V is visible, it is no farther than O, which raised the bound there by
 * less than its depth.  So with the bounds of all cells that V meets lowered by
 * 2 D, or to nothing where V is a needle, what is behind them does not touch V.
 */
#ifndef VISIBILITY_CULLING_CONTACT_BOUNDS_H
#define VISIBILITY_CULLING_CONTACT_BOUNDS_H

#include "view/sheet.h"
#include "visibility/culling/occlusion_buffer.h"

/* Lowers the bounds by the triangles of a sheet, among which are all that may
 * be visible; to nothing where these cover too many cells.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool contact_bounds_lower(struct occlusion_buffer *buffer,
                                     const struct sheet *sheet);

#endif
