/* sweep_direction.h - a direction along which the triangles of a long list are
 * swept for pairs (candidate_pairs.h) where their depths tell too little: the
 * normal of one of them, to whose plane most others are nearly parallel.
 *
 * Near copies of a slanted face all overlap in depth; along their normal each
 * overlaps those alone that are within contact of it. */
#ifndef VISIBILITY_INTERSECTION_SWEEP_DIRECTION_H
#define VISIBILITY_INTERSECTION_SWEEP_DIRECTION_H

#include "visibility/intersection/pair_sweep.h"

/* Gives the list, which is sorted by depth, the keys and high ends of another
 * direction, where that leaves clearly fewer pairs; sets is_along_normal.
 * Where the ranges of two triangles do not overlap, all corners of one are
 * certainly on one side of the other's coarse plane, farther than the contact
 * tolerance.
 * Returns false when memory ran out. */
USE_RESULT bool sweep_direction_choose(struct pair_sweep *sweep);

#endif
