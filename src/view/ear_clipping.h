/* ear_clipping.h - triangulates a polygon by ear clipping. */
#ifndef VIEW_EAR_CLIPPING_H
#define VIEW_EAR_CLIPPING_H

#include "scene/exact.h"
#include "view/polygon.h"
#include "view/triangulate.h"

static inline int triangulation_turn(const struct triangulation_corner *corner,
                                     uint32_t a, uint32_t b, uint32_t c) {
  return exact_turn(corner[a].at, corner[b].at, corner[c].at);
}

static inline void triangulation_add(struct triangulation *triangulation,
                                     uint32_t a, uint32_t b, uint32_t c,
                                     uint32_t ab, uint32_t bc, uint32_t ca) {
  triangulation->triangle.item[triangulation->triangle.count++] =
      (struct triangulation_triangle){{a, b, c}, {ab, bc, ca}};
}

/* Adds the triangles of a polygon whose corners have been projected; there is
 * room for them.  Returns false when memory ran out. */
USE_RESULT bool ear_clipping(struct triangulation *triangulation,
                             const struct polygon *polygon);

#endif
