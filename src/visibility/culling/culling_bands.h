/* culling_bands.h - candidates for culling tested in the bands of an occlusion
 * buffer, each by one thread.
 *
 * Each band tests all triangles that meet it, from near to far, and they raise
 * the bounds of its cells: a triangle is hidden if it is in each band that it
 * meets.  One that is hidden in a band raises no bounds there, so that bands
 * need not know of each other.
 */
#ifndef VISIBILITY_CULLING_CULLING_BANDS_H
#define VISIBILITY_CULLING_CULLING_BANDS_H

#include "view/sheet.h"
#include "visibility/culling/occlusion_buffer.h"
#include "visibility/predicate/occlusion.h"

/* A triangle to be tested: its cells, and its nearest depth with the margin, in
 * steps. */
struct culling_candidate {
  uint32_t triangle;
  int32_t nearest;
  uint16_t x0, y0, x1, y1;
};

/* What the phases of culling share. */
struct culling_work {
  const struct sheet *sheet;
  struct occlusion_buffer *buffer;
  uint8_t *culled;   /* one per triangle, not 0: it is hidden */
  size_t count;      /* of culled triangles */
  int64_t xy_margin; /* by how much edges may stray on the page */
  double margin;     /* the same in depth */
  bool fragments;
  struct occlusion_bound contact;
  struct culling_candidate *candidate; /* one per triangle, from near to far */
  _Atomic int64_t covered; /* cells in the boxes of triangles that may surround
                              one, which is their area with some excess */
  int workers;
  /* Of the bands: */
  uint64_t *visible;  /* for each band a bit per candidate: not hidden there */
  int32_t *thickness; /* one per cell, in steps: the contact tolerance */
  int32_t thickness_min;
};

/* An upper bound of a triangle's contact tolerance as a depth; INFINITY where
 * it is seen edge-on. */
static inline double culling_thickness(const struct occlusion_bound *contact,
                                       const struct geom_triangle *corners) {
  double nz, bound = occlusion_bound_of(contact, corners, &nz);
  return nz > 0 ? bound / nz : INFINITY;
}

/* Tests the candidates, which raise the bounds of the buffer: clears those of
 * `culled` that are not hidden, and subtracts them from its count.  Returns
 * false when memory ran out or the caller cancelled. */
USE_RESULT bool culling_bands_test(struct culling_work *work);

/* For fragments: lowers the bounds by the contact tolerances of the triangles
 * that are not culled, and tests the culled ones again.  Returns false when
 * memory ran out or the caller cancelled. */
USE_RESULT bool culling_bands_retest(struct culling_work *work);

#endif
