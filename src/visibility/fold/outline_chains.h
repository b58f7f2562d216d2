/* outline_chains.h - how the outlines of a mesh follow each other. */
#ifndef VISIBILITY_FOLD_OUTLINE_CHAINS_H
#define VISIBILITY_FOLD_OUTLINE_CHAINS_H

#include "visibility/zero_set/zero_segments.h"

struct outline_chains {
  uint32_t *next;     /* one an outline: the one that it leads to; SHEET_NONE */
  uint8_t *is_led_to; /* one an outline */
  uint64_t compared;  /* pairs of outlines: the work done */
};

/* Links each outline to one that begins where it ends.  Of several it is the
 * one to which it turns least, of those that no earlier outline leads to, and
 * of these the first; where very many begin, one of them.
 * Cost  n log n in the outlines
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool outline_chains_link(struct outline_chains *chains,
                                    const struct zero_set *set);
void outline_chains_fini(struct outline_chains *chains);

#endif
