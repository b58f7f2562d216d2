/* place_set.h - a set of positions in the scene, for tests whether a point is
 * at one. */
#ifndef PARTS_PLACE_SET_H
#define PARTS_PLACE_SET_H

#include "scene/scene.h"

/* A table of point numbers + 1, by linear probing.  Zero-initialised is
 * closed. */
struct place_set {
  const struct scene_point *point;
  uint32_t *slot;
  size_t mask;
};

/* Makes the set of the positions of some points.
 * point  must outlive the set
 * is_in  one a point
 * Returns false when memory ran out. */
USE_RESULT bool place_set_init(struct place_set *set,
                               const struct scene_point *point,
                               const uint8_t *is_in, size_t count);
bool place_set_has(const struct place_set *set,
                   const struct scene_point *point);
/* The first point of the set at the position of this one; SCENE_NONE: there is
 * none. */
uint32_t place_set_find(const struct place_set *set,
                        const struct scene_point *point);
void place_set_fini(struct place_set *set);

#endif
