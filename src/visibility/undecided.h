/* undecided.h - the edges and faces that a method leaves undecided, because its
 * own way with them would cost too much time or memory.
 *
 * Newell's splits, Warnock's windows and Watkins' trapezoids all grow with the
 * crossings of what is hidden, too.  Where they would grow out of bounds, each
 * method leaves the edge or the face to the lists of triangles by page tiles
 * (tilelist.h), where the tiles method solves what no tile decides: edges by
 * edge_query.h, faces by leftover.h.  The answer is the same, for it depends on
 * the sheet alone; memory is linear in the triangles.
 */
#ifndef VISIBILITY_UNDECIDED_H
#define VISIBILITY_UNDECIDED_H

#include "visibility/edge_query.h"
#include "visibility/leftover.h"
#include "visibility/pulse.h"

struct undecided {
  const struct sheet *sheet; /* lent */
  struct pulse *pulse;       /* lent */
  struct tilemap tiles;
  struct tilelist lists; /* of all tiles */
  uint8_t *wanted;       /* one a tile: all of them */
  struct edge_query edge;
  struct leftover leftover;
  uint8_t *state; /* one a triangle, as of leftover.h; NULL: lines only */
};

/* Lists the triangles; zero-initialised is empty, and undecided_fini is due
 * either way.
 * fragments  faces will be asked for, not only edges
 * Returns false when memory ran out. */
USE_RESULT bool undecided_init(struct undecided *undecided,
                               const struct sheet *sheet, bool fragments,
                               struct pulse *pulse);
void undecided_fini(struct undecided *undecided);

/* Finds what is hidden of an edge, which is not a point on the page.  Returns
 * NULL when memory ran out, or the caller wants no more. */
struct strokes *undecided_edge(struct undecided *undecided, uint32_t e);

/* Finds what is visible of these triangles, none of them flat, and hands it in;
 * puts them into another order.  Returns false when memory ran out, or the
 * caller wants no more. */
USE_RESULT bool undecided_faces(struct undecided *undecided, uint32_t *triangle,
                                size_t count, struct fragments *fragments);

#endif
