/* edge_copies.h - the edges of faces that repeat a part of the scene. */
#ifndef SCENE_TOPOLOGY_EDGE_COPIES_H
#define SCENE_TOPOLOGY_EDGE_COPIES_H

#include "scene/topology/edge_lists.h"
#include "scene/topology/repeated_part.h"

/* Stores the edges of sides that are copies. */
void corner_copy_make(uint32_t *corner_edge, const struct corner_copy *copy);

/* What is known while the faces of a range are numbered; begins as zeros, and
 * ends with edge_copies_fini. */
struct edge_copies {
  struct repeated_part part; /* of 0 faces: none */
  size_t edge, edges;        /* of the part, in the range */
  size_t shared;             /* of these: as in the range */
  uint32_t stop;             /* numbering stops before this face */
  uint32_t wait, next_wait;  /* as many calls until a part is sought again */
  ARRAY(uint32_t) shift;     /* of the last copies, which have no lists yet:
                                what is added to their points */
};

/* To be called where faces are numbered up to one, and `stop` is not passed:
 * copies edges where the next faces repeat a part just before them, and sets
 * where numbering is to stop.  Points are those of the scene as they are, and
 * none has a table of its sides; no edge depends on whether it was copied.
 * face  the first face that is not numbered, before and after
 * Returns false when memory ran out, or where the caller cancelled. */
USE_RESULT bool edge_copies_add(struct edge_copies *copies,
                                struct edge_range *range, uint32_t *face);

void edge_copies_fini(struct edge_copies *copies);

#endif
