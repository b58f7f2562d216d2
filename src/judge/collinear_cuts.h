/* collinear_cuts.h - edges of one end and direction that a cut gives the same
 * ends. */
#ifndef JUDGE_COLLINEAR_CUTS_H
#define JUDGE_COLLINEAR_CUTS_H

#include "judge/edge_list.h"
#include "judge/triangles.h"

/* Takes the classes from edges that a plane cuts and that leave one position in
 * one direction: of different lengths in the scene, they have the same ends
 * where they are cut, so that faces are neighbours which were not.  They still
 * exist.
 * first_at  point -> the first point at its position
 * Returns false when memory ran out. */
USE_RESULT bool judge_doubt_collinear_cuts(struct judge_edges *edges,
                                           const struct judge_triangles *all,
                                           const uint32_t *first_at);

#endif
