/* positions.h - points found again by their exact position, as files that
 * repeat each point in every face need it. */
#ifndef SCENE_READERS_POSITIONS_H
#define SCENE_READERS_POSITIONS_H

#include "scene/scene.h"

struct position_slot {
  uint32_t tag;   /* more bits of the hash than the slot's index holds */
  uint32_t point; /* scene point + 1; 0: free */
};

/* Points are numbered as they come; the order of the table is never seen. */
struct positions {
  struct position_slot *slot;
  int bits;     /* the table has 2^bits slots; 0: none yet */
  size_t first; /* points before this one are not in it */
};

/* An empty table for points that are yet to be added to the scene. */
void positions_init(struct positions *positions, const struct scene *scene);
void positions_fini(struct positions *positions);

/* Makes room for `more` further points, in the scene too.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_LIMIT (2^31 points). */
USE_RESULT recto_status positions_reserve(struct positions *positions,
                                          struct scene *scene, size_t more,
                                          recto_error *error);

/* A hash of finite coordinates, none of them -0. */
uint64_t positions_hash(const struct scene_point *point);

/* Prefetches the slot of that hash, for a position that is looked up soon. */
void positions_prefetch(const struct positions *positions, uint64_t hash);

/* The scene point at that position; SCENE_NONE: there is none. */
uint32_t positions_look_up(const struct positions *positions,
                           const struct scene *scene,
                           const struct scene_point *point, uint64_t hash);

/* The scene point at that position, added where it is new; room was made. */
uint32_t positions_find(struct positions *positions, struct scene *scene,
                        const struct scene_point *point, uint64_t hash);

#endif
