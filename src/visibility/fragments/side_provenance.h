/* side_provenance.h - labels each side of a fragment with what it is part of.
 *
 * The label depends on the sheet alone, not on the solver.
 */
#ifndef VISIBILITY_FRAGMENTS_SIDE_PROVENANCE_H
#define VISIBILITY_FRAGMENTS_SIDE_PROVENANCE_H

#include "visibility/fragments/line_index.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/map.h"
#include "visibility/predicate/triangle_pair.h"

/* The indices, the current face and the scratch lists of a labelling. */
struct side_provenance {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query *query;
  const struct line_index *sides; /* of all triangles near the current face */
  /* The triangles of the current face that are visible, ascending. */
  const uint32_t *own;
  size_t own_count;
  side_list found; /* sides that may overlap the current boundary segment */
  ARRAY(uint32_t) nearby, beside; /* the face's triangles near the segment, and
                                     those that have area on its left */
};

void side_provenance_fini(struct side_provenance *provenance);

/* Labels the side of a fragment of the current face that runs on `line` from p
 * to q, with the first of these that applies:
 *   1 MAP_SIDE_EDGE          an edge of the face itself overlaps the side,
 *     whether or not the triangle that it belongs to is visible
 *   2 MAP_SIDE_OCCLUDER       an edge of a nearer face overlaps it
 *   3 MAP_SIDE_INTERSECTION  a face intersects this one's plane along it
 *   4 any of these three, for a later face in contact: its visible pieces were
 *     passed on to this face (fragments.h)
 *   5 MAP_SIDE_CLIP           otherwise
 * If several edges or faces qualify, the lowest number is returned.  The
 * triangles of a face that is not planar each have a plane of their own; the
 * ones beside the segment are those that count.
 * side, id    as in struct map_corner
 * Returns false when memory ran out. */
USE_RESULT bool side_provenance_find(struct side_provenance *provenance,
                                     const struct geom_line *line,
                                     const struct geom_corner *p,
                                     const struct geom_corner *q, uint8_t *side,
                                     uint32_t *id);

#endif
