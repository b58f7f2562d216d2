/* fragments.h - turns the visible pieces that a solver finds into the map's
 * fragments.
 *
 * Definition.  The face seen at a point of the page is the nearest one there,
 * by exact depth; where depths are equal, the one of lower index.  If an
 * earlier face (one of lower index) is in contact with the nearest face at that
 * point, that earlier face is seen instead.  Two triangles are in contact if
 * all corners of one touch the plane of the other within the contact tolerance
 * (occlusion.h).  Every point belongs to exactly one face, so fragments tile
 * the page.
 *
 * Phases
 *   1 a solver adds, for each triangle, the pieces where it is the nearest;
 *     any decomposition into disjoint convex pieces will do
 *   2 pieces are passed on to earlier faces in contact
 *   3 the pieces of each face are united into connected fragments
 *   4 each side of a fragment is labelled with its provenance
 *     (side_provenance.h)
 *   5 sides that separate two fragments become twins (planar_subdivision.h)
 * Phases 2 to 5 depend on the sheet and on the union of the pieces alone, so
 * the fragments of all exact solvers are equal to the byte.
 */
#ifndef VISIBILITY_FRAGMENTS_FRAGMENTS_H
#define VISIBILITY_FRAGMENTS_FRAGMENTS_H

#include "base/report.h"
#include "geom/convex.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/map.h"
#include "visibility/progress.h"

struct fragment_piece {
  uint32_t face, triangle;   /* the scene face it belongs to, its triangle */
  struct geom_convex *piece; /* NULL: the whole triangle */
};

/* Counts for --stats. */
struct fragments_counts {
  uint64_t whole, cut;       /* triangles added whole, or in pieces */
  uint64_t contact_pairs;    /* a triangle and an earlier one, boxes overlap */
  uint64_t contact_exact;    /* of these, decided by exact arithmetic */
  uint64_t contacts;         /* of these, in contact */
  uint64_t outlines, united; /* faces stored by their outline, or united */
  uint64_t pieces;           /* pieces of the faces that were united */
  uint64_t side[MAP_SIDE_CLIP + 1]; /* sides labelled, by enum map_side */
};

struct fragments {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query query;
  bool contact;
  ARRAY(uint32_t) touching;  /* earlier triangles in contact with the current
                               one, ascending */
  struct progress *progress; /* borrowed, not owned; NULL, the initial value:
                                never polled */
  struct arena arena, scratch;
  ARRAY(struct fragment_piece) piece;
  struct fragments_counts counts;
  struct report *report; /* receives the counts; borrowed, not owned */
};

/* contact  whether pieces are passed on to earlier faces in contact
 * Returns false when memory ran out; end with fragments_fini either way. */
USE_RESULT bool fragments_init(struct fragments *fragments,
                               const struct sheet *sheet,
                               const struct triangle_grid *grid, bool contact);
void fragments_fini(struct fragments *fragments);

/* Makes a part of `whole`, to which another thread adds triangles, by
 * fragments_add_with_candidates alone. */
void fragments_init_part(struct fragments *part, const struct fragments *whole);

/* Moves pieces of a part to the whole.
 * begin, end  which ones, of part->piece
 * Returns false when memory ran out. */
USE_RESULT bool fragments_append(struct fragments *whole,
                                 const struct fragments *part, size_t begin,
                                 size_t end);

/* Adds the counts of a part, and owns the memory of its pieces from now on. */
void fragments_adopt(struct fragments *whole, struct fragments *part);

/* Adds a triangle that is the nearest over its whole outline.
 * Returns false when memory ran out, as all functions below. */
USE_RESULT bool fragments_add_whole(struct fragments *fragments,
                                    uint32_t triangle);

/* Adds a triangle that is the nearest over its whole outline and is in contact
 * with no earlier triangle there: the search for contacts is skipped. */
USE_RESULT bool fragments_add_without_contact(struct fragments *fragments,
                                              uint32_t triangle);

/* Adds the disjoint pieces over which a triangle is the nearest; they are
 * copied. */
USE_RESULT bool fragments_add(struct fragments *fragments, uint32_t triangle,
                              const struct geom_convex *piece, size_t count);

/* As fragments_add, with the candidates for contact given by the caller instead
 * of queried from the grid.
 * piece      NULL: the triangle is the nearest over its whole outline
 * candidate  triangles without duplicates, among them all that may overlap this
 *            one on the page */
USE_RESULT bool fragments_add_with_candidates(struct fragments *fragments,
                                              uint32_t triangle,
                                              const struct geom_convex *piece,
                                              size_t count,
                                              const uint32_t *candidate,
                                              size_t candidate_count);

/* Writes all fragments to the map, ordered by face, and the counts to the
 * report.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fragments_finish(struct fragments *fragments, struct map *map);

#endif
