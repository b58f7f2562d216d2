/* fold_chains.h - the chains of a mesh's outlines along which lines may be
 * missing. */
#ifndef VISIBILITY_FOLD_FOLD_CHAINS_H
#define VISIBILITY_FOLD_FOLD_CHAINS_H

#include "visibility/fold/added_folds.h"
#include "visibility/fold/fold_joints.h"
#include "visibility/fold/outline_chains.h"

/* No line is of fewer heights of its triangles. */
#define FOLD_LEAST_HEIGHTS 0.5

struct fold_chain {
  uint32_t start, outlines; /* the first one, and how many follow each other */
  bool is_closed;
  bool is_ring;        /* no line is beside it, and nothing hides any of it */
  bool may_lack_lines; /* a sample is seen beside which no line is */
  struct fold_samples sample; /* if so */
};

struct fold_chains {
  const struct outline_gaps_input *in; /* borrowed, not owned */
  const struct fold_joints *joints;    /* listed; the same */
  double long_on_page;                 /* as of fold_run_is_long */
  const uint32_t *next;                /* as of outline_chains */
  struct outline_chains own;           /* where the input has none */
  struct fold_chain *item; /* open ones first; each by its first outline */
  size_t count, capacity;
};

/* Lists the chains.  Lines are added to none but those that may lack some
 * before any is: what is added leaves no more to be added elsewhere.
 * chains  zero-initialised but for what is borrowed; the caller frees it
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fold_chains_find(struct fold_chains *chains);
void fold_chains_fini(struct fold_chains *chains);

/* Samples a chain, and finds again what is known of it.  Those samples alone
 * count as having no line beside them that are of parts of which something is
 * seen.
 * added  lines that were added
 * Returns false when memory ran out. */
USE_RESULT bool fold_chains_sample(const struct fold_chains *chains,
                                   struct fold_chain *chain,
                                   const struct added_folds *added,
                                   struct triangle_grid_query *query,
                                   struct fold_samples *samples);

/* Finds what lines are beside a sample, nearer than a height, unless that was
 * done; some of them, where one leaves none missing. */
void fold_chains_look_beside(const struct fold_joints *joints,
                             struct fold_sample *sample);

/* Whether nothing hides the place just beside a sample, where its own surface
 * does not reach.
 * ok  false when memory ran out */
bool fold_chains_is_seen(const struct outline_gaps_input *input,
                         struct triangle_grid_query *query,
                         const struct fold_sample *sample, bool *ok);

#endif
