/* added_folds.h - finds what was already added of lines along folds. */
#ifndef VISIBILITY_FOLD_ADDED_FOLDS_H
#define VISIBILITY_FOLD_ADDED_FOLDS_H

#include "visibility/fold/fold_samples.h"

enum { ADDED_FOLD_BUCKETS = 4096 };

/* The segments in a bucket follow each other. */
struct added_fold {
  struct geom_segment image;
  uint32_t next; /* from 1 on; 0: it is the last one */
};

/* A hash table of cells of the page, and the segments near them. */
struct added_folds {
  double cell;                        /* their side, grid units */
  uint32_t first[ADDED_FOLD_BUCKETS]; /* as next */
  ARRAY(struct added_fold) segment;
};

/* Adds a segment, which is beside samples no farther from it than `by`, grid
 * units.  Returns false when memory ran out. */
USE_RESULT bool added_folds_add(struct added_folds *folds,
                                struct geom_segment image, double by);

/* Whether a segment that was added runs beside a sample. */
bool added_folds_beside(const struct added_folds *folds,
                        const struct fold_sample *sample);

#endif
