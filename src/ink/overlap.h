/* overlap.h - of segments that lie on one line, what each of them keeps. */
#ifndef INK_OVERLAP_H
#define INK_OVERLAP_H

#include "base/sort.h"
#include "ink/net.h"

/* Whether two segments run along each other for more than the tolerance. */
bool overlap_is_along(const struct net *net, uint32_t a, uint32_t b);

/* Which of two segments is drawn where both are: the lower value. */
static inline uint64_t overlap_rank(const struct net *net, uint32_t segment) {
  const struct net_segment *s = &net->segment.item[segment];
  uint64_t edge_class = s->kin & RECTO_EDGES_ALL;
  return (uint64_t)net_is_hidden(s) << 40 | edge_class << 32 | s->edge;
}

/* Work space for clusters of up to so many segments, and what they leave. */
struct overlap {
  struct sort_key *key, *scratch; /* two a segment */
  uint32_t *slot;                 /* two a segment */
  uint32_t *node, *owner, *next;  /* two a segment, and one */
  uint32_t *near, *rest;          /* one a segment */
  ARRAY(struct net_segment) piece;
};

USE_RESULT bool overlap_init(struct overlap *overlap, size_t segments);
void overlap_fini(struct overlap *overlap);

/* Replaces `count` segments that run along one another by pieces that do not.
 * member  their numbers; they are to be dropped from the net by the caller
 * Cost    count log count */
USE_RESULT bool overlap_resolve(struct overlap *overlap, const struct net *net,
                                const uint32_t *member, size_t count);

#endif
