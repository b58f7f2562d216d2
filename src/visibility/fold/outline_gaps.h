/* outline_gaps.h - completes the outline of the picture where no smooth contour
 * is drawn. */
#ifndef VISIBILITY_FOLD_OUTLINE_GAPS_H
#define VISIBILITY_FOLD_OUTLINE_GAPS_H

#include "visibility/index/triangle_grid.h"
#include "visibility/map.h"
#include "visibility/zero_set/zero_segments.h"

/* What is completed. */
struct outline_gaps_input {
  struct sheet *sheet;
  const struct outline_chains *chains; /* of the outlines; empty: not known */
  struct map *map;
  const struct zero_set *set; /* its outlines */
  uint32_t first;             /* of the sheet's edges: of contours */
  uint32_t first_point;       /* of the sheet's points: the same */
  uint32_t curve_points; /* so many are of curves; further ones are added */
  const float *bulge;    /* one a contour's edge: how far it is from the mesh on
                         the page, grid units */
  uint32_t bulges;       /* so many are known; of further ones it is 0 */
  const struct triangle_grid *grid; /* of the sheet's triangles, in the boxes
                                       of the outlines at least */
  struct triangle_grid_query *query;
  uint64_t *compared; /* what is near with what: gets the work done, too */
  bool exact; /* thin loops are not left out, and cusps are not only those of
                 the surface */
};

/* Adds visible edges of the class silhouette along those parts of the mesh's
 * outlines beside which nothing is seen and no visible contour is drawn.
 *
 * A point of an outline is drawn if the nearest point of the visible contours,
 * not farther than the outline's faces are wide, is not one at which a contour
 * ends, but for so far as the mesh may be from that end, nor lies beyond a
 * visible crease.  Parts that are not are added; they start and end at the
 * contours beside them.
 * Cost   near linear in the outlines
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool outline_gaps_close(const struct outline_gaps_input *input);

/* Where triangles are looked for about an outline. */
static inline struct box2
outline_gaps_box(const struct contour_outline *outline) {
  enum { AROUND = 16 }; /* grid units: points beside it are within ten */
  struct box2 box = box2_of_segment(outline->image.p, outline->image.q);
  return (struct box2){box.x0 - AROUND, box.y0 - AROUND, box.x1 + AROUND,
                       box.y1 + AROUND};
}

#endif
