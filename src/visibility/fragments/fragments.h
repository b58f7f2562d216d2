/* fragments.h - from the pieces a solver finds visible to the map's fragments.
 *
 * The face seen at a point of the page is the nearest one there (exactly, the
 * earlier in the file where depths are equal); where an earlier face is in
 * contact with it at that point, that earlier face.  Two triangles are in
 * contact where all corners of one touch the plane of the other (occlusion.h).
 * Every point is given to just one face, so fragments tile the page.
 *
 * A solver hands in, for each triangle, the pieces where it is the nearest;
 * they may be cut up in any way.  This module passes pieces on to earlier
 * faces in contact, unites what belongs to one face, and says of each side
 * what it is.  All of that depends on the sheet and the pieces' union alone,
 * so solvers agree to the byte.
 */
#ifndef VISIBILITY_FRAGMENTS_FRAGMENTS_H
#define VISIBILITY_FRAGMENTS_FRAGMENTS_H

#include "base/report.h"
#include "geom/convex.h"
#include "visibility/map.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/progress.h"

struct fragment_piece {
  uint32_t face, triangle;   /* whose it is: scene face, its triangle */
  struct geom_convex *piece; /* NULL: the whole triangle */
};

/* Counts for --stats. */
struct fragments_counts {
  uint64_t whole, cut;       /* triangles handed in whole, or in pieces */
  uint64_t contact_pairs;    /* of a triangle and an earlier one, boxes meet */
  uint64_t contact_exact;    /* of these, asked of exact numbers */
  uint64_t contacts;         /* of these, in contact */
  uint64_t outlines, united; /* faces filed as they stand, or united */
  uint64_t pieces;           /* of the latter */
  uint64_t side[MAP_SIDE_CUT + 1]; /* labelled, by kind */
};

struct fragments {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query query;
  bool contact;
  ARRAY(uint32_t) touching;  /* earlier triangles in contact with the one at
                               hand, in order */
  struct progress *progress; /* lent; NULL, as at first: nobody is asked */
  struct arena arena, scratch;
  ARRAY(struct fragment_piece) piece;
  struct fragments_counts counts;
  struct report *report; /* lent, as the pulse is: where the counts go */
};

/* contact  pass pieces on to earlier faces in contact */
USE_RESULT bool fragments_init(struct fragments *fragments,
                               const struct sheet *sheet,
                               const struct triangle_grid *grid, bool contact);
void fragments_fini(struct fragments *fragments);

/* The triangle is the nearest over all of its outline. */
USE_RESULT bool fragments_add_whole(struct fragments *fragments,
                                    uint32_t triangle);

/* The same for a triangle that touches no other over its outline. */
USE_RESULT bool fragments_add_alone(struct fragments *fragments,
                                    uint32_t triangle);

/* The triangle is the nearest over these disjoint pieces; they are copied. */
USE_RESULT bool fragments_add(struct fragments *fragments, uint32_t triangle,
                              const struct geom_convex *piece, size_t count);

/* The same of what the grid need not be asked about.
 * piece  NULL: it is the nearest over all of its outline
 * about  triangles, each once: all among them that may overlap it */
USE_RESULT bool fragments_add_among(struct fragments *fragments,
                                    uint32_t triangle,
                                    const struct geom_convex *piece,
                                    size_t count, const uint32_t *about,
                                    size_t about_count);

/* Writes all fragments to the map, ordered by face, and the counts to the
 * report.
 * areas  the exact places of their corners too */
USE_RESULT bool fragments_finish(struct fragments *fragments, bool areas,
                                 struct map *map);

#endif
