/* facets.h - convex planar facets: unions of triangles of one face.
 *
 * Triangulation adds diagonals to the faces.  Scan-line methods would process
 * each of them as an edge, so triangles of one face are merged again across
 * diagonals where they are exactly coplanar and the union is convex.  A facet
 * is identified by its triangle of lowest index, which also defines its plane.
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
  ARRAY(struct facet) joined; /* those of more than one triangle, ascending */
  ARRAY(uint32_t) corner;     /* sheet points, counter-clockwise */
  /* Side k runs from corner k: a sheet edge or SHEET_NONE. */
  ARRAY(uint32_t) side;
  uint32_t *part; /* for each triangle its facet in `joined`, or SHEET_NONE;
                     NULL where nothing was merged */
};

/* Merges the triangles of each face greedily.  Triangles seen edge-on are not
 * merged.
 * Returns false when memory ran out. */
USE_RESULT bool facets_init(struct facets *facets, const struct sheet *sheet);
void facets_fini(struct facets *facets);

/* The triangle that identifies the facet of `triangle`. */
static inline uint32_t facet_of(const struct facets *facets,
                                uint32_t triangle) {
  if (facets->part == NULL || facets->part[triangle] == SHEET_NONE)
    return triangle;
  return facets->joined.item[facets->part[triangle]].triangle;
}

/* The corners (counter-clockwise) and sides of the facet that `triangle`
 * identifies; returns how many.
 * Owner  the arrays belong to `facets` or `sheet` */
static inline uint32_t facet_outline(const struct facets *facets,
                                     const struct sheet *sheet,
                                     uint32_t triangle, const uint32_t **corner,
                                     const uint32_t **side) {
  if (facets->part == NULL || facets->part[triangle] == SHEET_NONE) {
    *corner = sheet->triangle.item[triangle].point;
    *side = sheet_triangle_sides(sheet, triangle);
    return 3;
  }
  const struct facet *facet = &facets->joined.item[facets->part[triangle]];
  *corner = facets->corner.item + facet->corner;
  *side = facets->side.item + facet->corner;
  return facet->count;
}

/* The farthest and the nearest depth of a facet's corners. */
static inline void facet_depth_range(const struct sheet *sheet,
                                     const uint32_t *corner, uint32_t count,
                                     double *low, double *high) {
  *low = INFINITY;
  *high = -INFINITY;
  for (uint32_t k = 0; k < count; k++) {
    double z = (double)sheet->point.item[corner[k]].z;
    if (z < *low)
      *low = z;
    if (z > *high)
      *high = z;
  }
}

/* By how much the depth of a facet's plane changes from one column to the next
 * on the right, and from one line to the next above. */
void facet_slopes(const struct sheet *sheet, const struct scan_grid *grid,
                  uint32_t facet, double *per_column, double *per_line);

/* A facet is steep if its plane's depth changes by more than this over the
 * columns and lines of the frame: within one part in 256 of edge-on where the
 * scene is as deep as the page is high.  Its depths are computed exactly at
 * each sample, those of other facets incrementally in doubles. */
#define FACET_DEPTH_CHANGE_MAX 0x1p48

static inline bool facet_is_steep(const struct scan_grid *grid,
                                  double per_column, double per_line) {
  return !(fabs(per_column) * grid->columns + fabs(per_line) * grid->lines <=
           FACET_DEPTH_CHANGE_MAX);
}

#endif
