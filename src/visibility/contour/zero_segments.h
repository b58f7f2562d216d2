/* zero_segments.h - what the contour of a smooth surface consists of. */
#ifndef VISIBILITY_CONTOUR_ZERO_SEGMENTS_H
#define VISIBILITY_CONTOUR_ZERO_SEGMENTS_H

#include "base/sort.h"
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

/* The image of an edge at which the mesh itself folds over, with the surface on
 * its left. */
struct contour_outline {
  struct geom_segment image;
  uint32_t face; /* the one that faces the viewer */
};

struct zero_set {
  ARRAY(struct contour_node) node;
  ARRAY(struct contour_segment) segment;
  ARRAY(struct geom_segment) border;     /* images of edges at which the surface
                                        ends, and of coarse parts' contours */
  ARRAY(struct contour_outline) outline; /* of smooth parts */
};

/* The first of a face's triangles; SHEET_NONE: it has none. */
static inline uint32_t first_triangle_of_face(const struct sheet *sheet,
                                              uint32_t face) {
  size_t t = 0;
  LOWER_BOUND(t, 0, sheet->triangle.count, sheet->triangle.item[t].face < face);
  return t < sheet->triangle.count && sheet->triangle.item[t].face == face
             ? (uint32_t)t
             : SHEET_NONE;
}

#endif
