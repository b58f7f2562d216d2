/* folds.h - the diagonals along which faces that are not planar fold. */
#ifndef JUDGE_FOLDS_H
#define JUDGE_FOLDS_H

#include "judge/edge_classes.h"
#include "judge/edge_list.h"

/* Adds the diagonals of faces that are not planar whose two triangles lie, or
 * may lie, on one side of it on the page: these are silhouettes.
 * Returns false when memory ran out. */
USE_RESULT bool judge_edges_add_folds(struct judge_edges *edges,
                                      const struct judge_facings *facings);

#endif
