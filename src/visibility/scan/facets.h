/* facets.h - the planar convex pieces of the sheet's faces.
 *
 * The sheet's triangles carry diagonals that were only added to cut a face up.
 * Methods that walk the page line by line would stop at each of them, so
 * triangles of one face are joined again across diagonals, where they lie in
 * one plane exactly and the union is convex.  A facet is known by its lowest
 * triangle, which also is its plane.
 */
#ifndef VISIBILITY_SCAN_FACETS_H
#define VISIBILITY_SCAN_FACETS_H

#include "geom/scanfill.h"
#include "view/sheet.h"

#define FACET_CORNERS_MAX 16

struct facet {
  uint32_t triangle; /* the lowest */
  uint32_t corner, count;
};

struct facets {
  ARRAY(struct facet) joined; /* of more than one triangle, ascending */
  ARRAY(uint32_t) corner;     /* sheet points, counter-clockwise */
  ARRAY(uint32_t)
  side;           /* side k, from corner k: a sheet edge or
                     SHEET_NONE */
  uint32_t *part; /* for each triangle its facet in `joined`, or SHEET_NONE;
                     NULL where nothing was joined */
};

/* Joins what can be joined.  Flat triangles stay alone. */
USE_RESULT bool facets_init(struct facets *facets, const struct sheet *sheet);
void facets_fini(struct facets *facets);

/* The triangle that the facet of `triangle` is known by. */
static inline uint32_t facet_of(const struct facets *facets,
                                uint32_t triangle) {
  if (facets->part == NULL || facets->part[triangle] == SHEET_NONE)
    return triangle;
  return facets->joined.item[facets->part[triangle]].triangle;
}

/* The corners (counter-clockwise) and sides of the facet that `triangle` is
 * the lowest of; returns how many.  Lends. */
uint32_t facet_outline(const struct facets *facets, const struct sheet *sheet,
                       uint32_t triangle, const uint32_t **corner,
                       const uint32_t **side);

/* The plane of a triangle of the sheet that is not flat. */
struct geom_plane facet_plane(const struct sheet *sheet, uint32_t facet);

/* The depth of the sheet's facet changes by this much from one column, line
 * to the next, to the right and up. */
void facet_slopes(const struct sheet *sheet, const struct scan_grid *grid,
                  uint32_t facet, double *per_column, double *per_line);

#endif
