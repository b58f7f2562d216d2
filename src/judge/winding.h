/* winding.h - whether a point is inside solids: by counting the surfaces that
 * rays leave and enter.
 *
 * The number is the same for all rays from a point where the surfaces are
 * closed.  Rays in several directions are cast; where they disagree, meet a
 * face with a border, or pass so close to a side that doubles cannot decide,
 * it is undecided. */
#ifndef JUDGE_WINDING_H
#define JUDGE_WINDING_H

#include "judge/triangles.h"

enum judge_inside { JUDGE_OUTSIDE, JUDGE_PERHAPS_INSIDE, JUDGE_INSIDE };

enum judge_inside judge_is_inside(const struct judge_triangles *all,
                                  struct judge_point3 p);

#endif
