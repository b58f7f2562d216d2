/* positions.c - a table of points by position, open addressing, at most half
 * full.
 *
 * A point's slot comes from the high bits of its hash; the low bits are kept
 * as a tag, so that nearly all other points are rejected without being read.
 */
#include "scene/readers/positions.h"

#include <string.h>

#include "base/hash.h"
#include "scene/limit.h"

enum { FEWEST_BITS = 6 };

void positions_init(struct positions *positions, const struct scene *scene) {
  *positions = (struct positions){NULL, 0, scene->point.count};
}

void positions_fini(struct positions *positions) {
  mem_free(positions->slot);
  positions->slot = NULL;
  positions->bits = 0;
}

uint64_t positions_hash(const struct scene_point *point) {
  uint64_t hash = hash_add_double(0, point->x);
  hash = hash_add_double(hash, point->y);
  hash = hash_add_double(hash, point->z);
  return hash * HASH_GOLDEN;
}

static size_t first_slot(const struct positions *positions, uint64_t hash) {
  return (size_t)(hash >> (64 - positions->bits));
}

static size_t next_slot(const struct positions *positions, size_t slot) {
  return (slot + 1) & (((size_t)1 << positions->bits) - 1);
}

void positions_prefetch(const struct positions *positions, uint64_t hash) {
  __builtin_prefetch(&positions->slot[first_slot(positions, hash)]);
}

/* Enters all points anew; they are all different. */
static void enter_points(struct positions *positions,
                         const struct scene *scene) {
  for (size_t i = positions->first; i < scene->point.count; i++) {
    uint64_t hash = positions_hash(&scene->point.item[i]);
    size_t slot = first_slot(positions, hash);
    while (positions->slot[slot].point)
      slot = next_slot(positions, slot);
    positions->slot[slot].tag = (uint32_t)hash;
    positions->slot[slot].point = (uint32_t)i + 1;
  }
}

recto_status positions_reserve(struct positions *positions, struct scene *scene,
                               size_t more, recto_error *error) {
  if (more > SCENE_LIMIT - scene->point.count)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 points");
  if (!ARRAY_RESERVE(&scene->point, more))
    return error_memory(error);
  size_t wanted = scene->point.count - positions->first + more;
  int bits = positions->bits > FEWEST_BITS ? positions->bits : FEWEST_BITS;
  while (wanted > (size_t)1 << (bits - 1))
    bits++;
  if (bits == positions->bits)
    return RECTO_OK;
  struct position_slot *grown = mem_calloc((size_t)1 << bits, sizeof *grown);
  if (grown == NULL)
    return error_memory(error);
  mem_free(positions->slot);
  positions->slot = grown;
  positions->bits = bits;
  enter_points(positions, scene);
  return RECTO_OK;
}

/* The slot of a position, or the free one where it belongs; *point gets the
 * scene point, or SCENE_NONE. */
static size_t find_slot_of(const struct positions *positions,
                           const struct scene *scene,
                           const struct scene_point *at, uint64_t hash,
                           uint32_t *point) {
  uint32_t tag = (uint32_t)hash;
  size_t slot = first_slot(positions, hash);
  for (; positions->slot[slot].point; slot = next_slot(positions, slot)) {
    if (positions->slot[slot].tag != tag)
      continue;
    *point = positions->slot[slot].point - 1;
    const struct scene_point *other = &scene->point.item[*point];
    if (other->x == at->x && other->y == at->y && other->z == at->z)
      return slot;
  }
  *point = SCENE_NONE;
  return slot;
}

uint32_t positions_look_up(const struct positions *positions,
                           const struct scene *scene,
                           const struct scene_point *point, uint64_t hash) {
  uint32_t found;
  (void)find_slot_of(positions, scene, point, hash, &found);
  return found;
}

uint32_t positions_find(struct positions *positions, struct scene *scene,
                        const struct scene_point *point, uint64_t hash) {
  uint32_t found;
  size_t slot = find_slot_of(positions, scene, point, hash, &found);
  if (found != SCENE_NONE)
    return found;
  found = (uint32_t)scene->point.count;
  scene->point.item[scene->point.count++] = *point;
  positions->slot[slot].tag = (uint32_t)hash;
  positions->slot[slot].point = found + 1;
  return found;
}
