/* zero_set.h - the contour of the smooth surface that a mesh samples: where its
 * facing g changes sign.
 *
 * Within a triangle g is linear, and its zero set is a segment between two
 * sides.  At a crease, where g jumps, the contour runs along the edge as far as
 * its two faces have different signs there.  So the segments join to closed
 * curves [HertzmannZorin2000], but for borders, the page's margins and the near
 * plane, where they end. */
#ifndef VISIBILITY_CONTOUR_ZERO_SET_H
#define VISIBILITY_CONTOUR_ZERO_SET_H

#include "visibility/contour/facing.h"

/* Where the contour crosses an edge or a diagonal, or meets a vertex. */
struct contour_node {
  double at[3];           /* scene units */
  struct geom_point page; /* its image */
  uint32_t front, back;   /* the slots between which the sign changes;
                               SHEET_NONE: a vertex, or where clipping cut */
  uint32_t segment[2];    /* the first two that end here; SHEET_NONE */
  uint32_t degree;        /* how many do */
  uint32_t sheet_point;   /* SHEET_NONE: none yet */
};

struct contour_segment {
  uint32_t node[2];
  uint32_t face;
  double normal[3]; /* of the surface, unit length */
  double radial;    /* has the sign of the radial curvature: the derivative of
                          g along the view; negative where the surface's normal
                          curves into the line of sight */
  bool along_crease;
  double width; /* the triangle's least height, scene units */
};

struct zero_set {
  ARRAY(struct contour_node) node;
  ARRAY(struct contour_segment) segment;
  ARRAY(struct geom_segment) border; /* images of edges at which the surface
                                        ends, and of coarse parts' contours */
};

/* Finds the contour.
 * set     zero-initialised; the caller frees it
 * Errors  RECTO_ERROR_MEMORY.
 * Cost    linear in the corners */
USE_RESULT recto_status zero_set_find(struct zero_set *set,
                                      const struct facing *facing,
                                      recto_error *error);
void zero_set_fini(struct zero_set *set);

#endif
