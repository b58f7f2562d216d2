/* stroke_shape.h - the corners and straight sides of a stroke. */
#ifndef INK_CURVE_STROKE_SHAPE_H
#define INK_CURVE_STROKE_SHAPE_H

#include "drawing/drawing.h"

/* What a vertex of the stroke is. */
struct stroke_vertex {
  struct drawing_point at;
  double along;  /* mm from the first vertex */
  size_t point;  /* of the stroke */
  bool corner;   /* the direction changes here */
  bool straight; /* the side from here to the next vertex stays a line */
};

/* A stroke's vertices in order; a closed one begins at a corner or a straight
 * side, if it has any, and ends at its first vertex again. */
struct stroke_shape {
  ARRAY(struct stroke_vertex) vertex;
  double length; /* mm */
  double start;  /* of the first vertex, mm from the stroke's first point */
  bool closed;
  bool ring; /* closed, without corners and straight sides */
};

/* tolerance  mm; what is smaller is noise
 * Returns false when memory ran out; to be freed in either case. */
USE_RESULT bool stroke_shape_find(struct stroke_shape *shape,
                                  const struct drawing_point *point,
                                  size_t count, bool closed, double tolerance);
void stroke_shape_fini(struct stroke_shape *shape);

/* The direction of the side that begins at that vertex, a unit vector. */
struct drawing_point stroke_shape_side(const struct stroke_shape *shape,
                                       size_t vertex);

#endif
