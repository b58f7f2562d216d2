/* edge_runs.h - how many edges begin at the faces that a window owns, so that
 * the runs of all parts number the edges of the model: decision 0069. */
#ifndef PARTS_EDGE_RUNS_H
#define PARTS_EDGE_RUNS_H

#include "parts/part_sources.h"

/* The side of its first face at which a topology edge begins. */
uint32_t edge_runs_first_side(const struct part_sources *from, uint32_t edge);

/* Sets the runs of a part, whose window is set.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool edge_runs_collect(struct part *part,
                                  const struct part_sources *from);

#endif
