/* brute.h - what is visible of one triangle by plain subtraction: the oracle of
 * the tests for every other way to subtract occluders. */
#ifndef VISIBILITY_BRUTE_BRUTE_H
#define VISIBILITY_BRUTE_BRUTE_H

#include "geom/convex.h"
#include "visibility/progress.h"

/* Zero-initialised is empty. */
struct brute_pieces {
  geom_pieces left; /* disjoint */
  bool whole;       /* nothing was subtracted */
  geom_pieces scratch;
  struct arena arena;
};

void brute_pieces_fini(struct brute_pieces *pieces);

/* Subtracts from triangle f, which is not edge-on, every other one where it is
 * nearer.  Exact.
 * progress  may be NULL
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool brute_subtract_all(struct brute_pieces *pieces,
                                   const struct sheet *sheet, uint32_t f,
                                   struct progress *progress);

#endif
