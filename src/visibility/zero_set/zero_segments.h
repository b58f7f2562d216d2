/* zero_segments.h - what the contour of a smooth surface consists of. */
#ifndef VISIBILITY_ZERO_SET_ZERO_SEGMENTS_H
#define VISIBILITY_ZERO_SET_ZERO_SEGMENTS_H

#include <math.h>

#include "base/sort.h"
#include "geom/vector.h"
#include "visibility/predicate/box2.h"
#include "visibility/zero_set/curvature_noise.h"

/* Where the contour crosses an edge or a diagonal, or meets a vertex. */
struct contour_node {
  double at[3];           /* on the curved surface, scene units */
  double flat[3];         /* on the mesh */
  struct geom_point page; /* the image of `at` */
  double normal[3];       /* of the surface, where it is smooth */
  uint32_t front, back;   /* the slots between which the sign changes;
                               SHEET_NONE: a vertex, or where clipping cut */
  uint32_t segment[2];    /* the first two that end here; SHEET_NONE */
  uint32_t degree;        /* how many do */
  uint32_t sheet_point;   /* SHEET_NONE: none yet */
  bool is_cut;            /* a loop of the curve was left out here */
};

struct contour_segment {
  uint32_t node[2];
  uint32_t face;
  double normal[3]; /* of the surface, unit length */
  double radial;    /* has the sign of the radial curvature: the derivative of
                          g along the view; negative where the surface's normal
                          curves into the line of sight */
  bool along_crease;
  bool in_network; /* a crease that is joined to none that ends freely */
  struct curvature_squares curvature; /* at the triangle's corners */
  double height; /* the triangle's least, scene units; of a crease, over that
                    or twice the least, whichever is less */
  double width;  /* how uneven the mesh is about it: by its height; nearly 0 at
                    a crease at which the faces themselves fold over */
};

/* The image of an edge at which the mesh itself folds over, with the surface on
 * its left. */
struct contour_outline {
  struct geom_segment image;
  uint32_t face;                      /* the one that faces the viewer */
  struct curvature_squares curvature; /* about it */
  bool is_contradicted; /* one of its faces is turned otherwise than the smooth
                           surface all about it */
};

struct zero_set {
  ARRAY(struct contour_node) node;
  ARRAY(struct contour_segment) segment;
  ARRAY(struct geom_segment) border;     /* images of edges at which the surface
                                        ends, and of coarse parts' contours */
  ARRAY(struct contour_outline) outline; /* of smooth parts */
};

/* The share of the picture's longer side from which on a line is long on the
 * page. */
#define CONTOUR_PICTURE_SHARE (1.0 / 14)

/* The length from which on a line is long on the page, grid units: outlines
 * extend as far as the picture does.  INFINITY: there are none. */
static inline double contour_outlines_long_on_page(const struct zero_set *set) {
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t i = 0; i < set->outline.count; i++) {
    const struct geom_segment *s = &set->outline.item[i].image;
    box = box2_union(box, box2_of_segment(s->p, s->q));
  }
  if (set->outline.count == 0)
    return INFINITY;
  return CONTOUR_PICTURE_SHARE *
         fmax((double)box.x1 - box.x0, (double)box.y1 - box.y0);
}

/* Adds a segment between two nodes that is a part of another one. */
USE_RESULT static inline bool zero_set_add_part(struct zero_set *set,
                                                uint32_t of, uint32_t from,
                                                uint32_t to,
                                                uint32_t *segment) {
  struct contour_segment part = set->segment.item[of];
  part.node[0] = from;
  part.node[1] = to;
  *segment = (uint32_t)set->segment.count;
  return ARRAY_PUSH(&set->segment, part);
}

/* The first of a face's triangles; SHEET_NONE: it has none. */
static inline uint32_t first_triangle_of_face(const struct sheet *sheet,
                                              uint32_t face) {
  const struct sheet_triangle *triangle = sheet->triangle.item;
  size_t t = 0;
  /* Most often all faces are triangles, and none is left out. */
  if (face < sheet->triangle.count && triangle[face].face == face &&
      (face == 0 || triangle[face - 1].face < face))
    return face;
  LOWER_BOUND(t, 0, sheet->triangle.count, triangle[t].face < face);
  return t < sheet->triangle.count && sheet->triangle.item[t].face == face
             ? (uint32_t)t
             : SHEET_NONE;
}

/* How far apart points of a face's image are, at most. */
static inline double extent_of_face(const struct sheet *sheet, uint32_t face) {
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t t = first_triangle_of_face(sheet, face);
       t < sheet->triangle.count && sheet->triangle.item[t].face == face; t++)
    for (int k = 0; k < 3; k++) {
      struct geom_point p = sheet_corners(sheet, t).p[k];
      box = (struct box2){box2_min(box.x0, p.x), box2_min(box.y0, p.y),
                          box2_max(box.x1, p.x), box2_max(box.y1, p.y)};
    }
  return box.x0 > box.x1
             ? 0
             : vector2_length((double)box.x1 - box.x0, (double)box.y1 - box.y0);
}

/* What was last found of a face of many corners, so that it is not found again
 * for each of its edges. */
struct large_face_size {
  double size;
  uint32_t face_after; /* that face and 1; 0: none yet */
};

/* How far apart points of a face's image are, at most.
 * last  of the faces before */
static inline double extent_of_face_by(struct large_face_size *last,
                                       const struct sheet *sheet,
                                       uint32_t face) {
  if (scene_face_corners(sheet->scene, face) <= SMALL_FACE_MAX)
    return extent_of_face(sheet, face);
  if (last->face_after != face + 1)
    *last = (struct large_face_size){extent_of_face(sheet, face), face + 1};
  return last->size;
}

#endif
