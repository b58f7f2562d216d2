/* side_provenance.h - what a fragment's side is: a question of the sheet alone. */
#ifndef VISIBILITY_FRAGMENTS_SIDE_PROVENANCE_H
#define VISIBILITY_FRAGMENTS_SIDE_PROVENANCE_H

#include "visibility/predicate/triangle_pair.h"
#include "visibility/map.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/fragments/line_index.h"

/* What is at hand while sides are labelled. */
struct side_provenance {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query *query;
  const struct line_index *sides; /* of all triangles that may be asked about;
                                   NULL: the grid is asked for them */
  /* The face at hand: its triangles that are seen, ascending. */
  const uint32_t *own;
  size_t own_count;
  side_list found; /* sides that may run along the stretch at hand */
  ARRAY(uint32_t) about, beside; /* the face's triangles there */
};

enum { SIDE_PROVENANCE_FEW = 8 }; /* triangles of a face, that need no index */

void side_provenance_fini(struct side_provenance *labels);

/* Labels the side of a fragment of the face at hand that runs on `line` from p
 * to q.
 * The first that holds of: an edge of the face itself lies along it; an edge
 * of a nearer face does; a face crosses this one's plane along it; any of
 * these of a later face in contact, whose pieces this one was given; a cut.
 * Of several the lowest number.  A face's triangles may each have a plane of
 * their own: those beside the stretch are asked.
 * side, id    as in struct map_corner
 * Returns false when memory ran out. */
USE_RESULT bool side_provenance_find(struct side_provenance *labels,
                                     const struct geom_line *line,
                                     const struct geom_corner *p,
                                     const struct geom_corner *q, uint8_t *side,
                                     uint32_t *id);

#endif
