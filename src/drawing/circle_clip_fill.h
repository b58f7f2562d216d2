/* circle_clip_fill.h - what strokes and fills share that a circle clips. */
#ifndef DRAWING_CIRCLE_CLIP_FILL_H
#define DRAWING_CIRCLE_CLIP_FILL_H

#include "drawing/drawing.h"

struct circle_clip {
  const struct drawing *from;
  struct drawing to; /* its strokes, fills and what they have */
  struct drawing_circle circle;
  struct drawing_polyline flat; /* of the current curve */
};

static inline bool circle_contains(const struct drawing_circle *circle,
                                   struct drawing_point p) {
  double dx = p.x - circle->x, dy = p.y - circle->y;
  return dx * dx + dy * dy <= circle->radius * circle->radius;
}

/* The part of a segment in a circle, t from 0 to 1; false: there is none. */
bool circle_clip_segment(const struct drawing_circle *circle,
                         struct drawing_point a, struct drawing_point b,
                         double t[2]);

/* Adds what of a fill is in the circle.  Returns false when memory ran out. */
USE_RESULT bool circle_clip_add_fill(struct circle_clip *clip, size_t index);

#endif
