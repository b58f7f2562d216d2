/* place_set.c - positions in the scene, found by a hash of them. */
#include "parts/place_set.h"

#include "base/hash.h"

static uint64_t hash_of_position(const struct scene_point *p) {
  uint64_t hash = hash_add_double(0, p->x + 0.0); /* -0 becomes 0 */
  hash = hash_add_double(hash_add_double(hash, p->y + 0.0), p->z + 0.0);
  return hash * HASH_GOLDEN >> 20;
}

/* The slot of a position, or the free one where it belongs. */
static size_t find_position(const struct place_set *set,
                            const struct scene_point *p) {
  size_t k = (size_t)hash_of_position(p) & set->mask;
  for (; set->slot[k] != 0; k = (k + 1) & set->mask) {
    const struct scene_point *q = &set->point[set->slot[k] - 1];
    if (p->x == q->x && p->y == q->y && p->z == q->z)
      break;
  }
  return k;
}

bool place_set_init(struct place_set *set, const struct scene_point *point,
                    const uint8_t *is_in, size_t count) {
  size_t used = 0, slots = 16;
  for (size_t p = 0; p < count; p++)
    used += is_in[p];
  while (slots < 2 * used)
    slots *= 2;
  *set = (struct place_set){point, mem_calloc(slots, sizeof *set->slot),
                            slots - 1};
  for (size_t p = 0; set->slot != NULL && p < count; p++)
    if (is_in[p]) {
      size_t k = find_position(set, &point[p]);
      if (set->slot[k] == 0)
        set->slot[k] = (uint32_t)p + 1;
    }
  return set->slot != NULL;
}

bool place_set_has(const struct place_set *set,
                   const struct scene_point *point) {
  return set->slot[find_position(set, point)] != 0;
}

uint32_t place_set_find(const struct place_set *set,
                        const struct scene_point *point) {
  uint32_t slot = set->slot[find_position(set, point)];
  return slot != 0 ? slot - 1 : SCENE_NONE;
}

void place_set_fini(struct place_set *set) {
  mem_free(set->slot);
  *set = (struct place_set){.point = NULL};
}
