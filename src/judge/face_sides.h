/* face_sides.h - whether a face has a side between two points. */
#ifndef JUDGE_FACE_SIDES_H
#define JUDGE_FACE_SIDES_H

#include "base/memory.h"
#include "base/sort.h"
#include "judge/point.h"

struct face_sides {
  const struct scene *scene; /* borrowed, not owned */
  /* Of faces with many sides: their keys, in ascending order, and the corners
   * where they start. */
  ARRAY(struct sort_key) side;
};

/* Returns false when memory ran out; end with face_sides_fini either way. */
USE_RESULT bool face_sides_init(struct face_sides *sides,
                                const struct scene *scene);
void face_sides_fini(struct face_sides *sides);

/* Whether a side of the face has these ends, in either order.
 * Cost  logarithmic in the sides of all faces, but for faces of few sides */
bool face_has_side(const struct face_sides *sides, uint32_t face,
                   const struct judge_point3 end[2]);

#endif
