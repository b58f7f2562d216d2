/* nearest_contours.h - where the visible contours are nearest to points of the
 * page. */
#ifndef VISIBILITY_FOLD_NEAREST_CONTOURS_H
#define VISIBILITY_FOLD_NEAREST_CONTOURS_H

#include "visibility/contour/segment_grid.h"
#include "visibility/map.h"

/* Zero-initialised but for what is borrowed. */
struct nearest_contours {
  const struct sheet *sheet; /* borrowed, not owned */
  const struct map *map;     /* the same */
  uint32_t first;            /* of the sheet's edges: of contours */
  uint32_t first_point;      /* of the sheet's points: the same */
  const float *bulge; /* how far the first so many contours bulge, grid units */
  uint32_t bulges;
  double bulge_most; /* of all contours */
  bool cusps;        /* contours end at cusps, too */
  struct segment_grid contour;
  struct segment_grid line;   /* other visible lines, but creases, as ink may
                                 leave them out */
  struct segment_grid crease; /* those */
  uint32_t *sum; /* entries of the lists of contours below and to the
                               left of each corner of a cell */
  uint8_t *ends; /* one a point of contours: of visible ones, at most 2; 1 at
                        a cusp that is an end */
  uint64_t compared; /* segments with points: the work done */
};

/* Lists what is visible.  Returns false when memory ran out. */
USE_RESULT bool nearest_contours_init(struct nearest_contours *nearest);
void nearest_contours_fini(struct nearest_contours *nearest);

/* The nearest points of contours to one: of all but loose ends, at which one
 * visible contour alone ends, or at a cusp, and of loose ends. */
struct nearest_contour {
  double any, loose;    /* distances; INFINITY: none was found */
  struct geom_point at; /* of any */
  struct geom_point loose_at;
  uint32_t loose_point;          /* of the sheet */
  uint32_t any_edge, loose_edge; /* the same */
  double end; /* the square of the distance of a loose end, wherever it lies */
  double reach; /* so far all contours were looked at */
};

/* Finds them, of contours that do not turn from a direction by more than 120
 * degrees, nor lie to its right by more than they bulge and half a millimetre:
 * those are of another surface.  The lesser of both distances is right
 * if it is at most the radius, and the other one is then right or too large.
 * Of several as near it is the one of the last contour.
 * along  the direction, of unit length */
struct nearest_contour nearest_contours_find(struct nearest_contours *nearest,
                                             struct geom_point p,
                                             const double along[2],
                                             double radius);

/* Whether a contour in front of a point, not farther than a radius, has its
 * smooth surface there, though the mesh is not: the point is hidden.
 * beside  so far from its surface the point may be, grid units */
bool nearest_contours_cover(struct nearest_contours *nearest,
                            struct geom_point p, double beside, double radius);

/* Whether a line other than a contour runs through a point. */
bool nearest_contours_has_line(struct nearest_contours *nearest,
                               struct geom_point p);

/* Whether one lies between two points. */
bool nearest_contours_has_line_between(struct nearest_contours *nearest,
                                       struct geom_point p,
                                       struct geom_point q);

/* Whether the nearest contour is another surface's than a line through a point,
 * as it is farther than a quarter of the radius, and a visible crease is
 * between.
 * near    any is at most the radius
 * radius  how large the faces of the line's surface are.  A crease farther than
 *         that behind the way to the contour is another surface's. */
bool nearest_contours_is_beyond_crease(struct nearest_contours *nearest,
                                       struct geom_point p,
                                       const struct nearest_contour *near,
                                       double radius);

#endif
