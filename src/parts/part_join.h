/* part_join.h - the sheet and the visible map of a whole drawing, made of its
 * parts: what ink reads. */
#ifndef PARTS_PART_JOIN_H
#define PARTS_PART_JOIN_H

#include "parts/part_merge.h"
#include "scene/topology/topology.h"

/* How much the parts say. */
struct part_join_counts {
  size_t faces, edges, intersections, fragments;
};

struct part_join {
  struct part all; /* the parts, merged; part_join_make leaves what numbers
                      faces, polylines and edges */
  struct part_join_counts counts;
  struct scene scene; /* the faces that ink needs, and their points */
  struct topology topology;
  struct sheet sheet;
  struct map map;
};

/* Makes the scene of all faces that the parts have, lays it out with their
 * camera, and gives its edges the classes and the visibility that the parts
 * say, and its faces the fragments.  The elements are in the order of the
 * model, so that ink does what it does with the whole.
 * join    `all` is set, the rest empty
 * Errors  RECTO_ERROR_FORMAT: what the parts say does not fit together;
 *         RECTO_ERROR_MEMORY, _LIMIT, _CANCELLED; end with part_join_fini
 *         either way */
USE_RESULT recto_status part_join_make(struct part_join *join,
                                       const recto_options *options,
                                       recto_error *error);
/* The number of each topology edge within its group, of those that the parts
 * list, which have ids; SCENE_NONE for the others.
 * Returns an allocated array; NULL when memory ran out. */
uint32_t *part_join_edge_numbers(const struct part_join *join);

void part_join_fini(struct part_join *join);

#endif
