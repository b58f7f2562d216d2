/* plane_cache.h - the planes of triangles that were used last, by one thread.
 *
 * Edges that follow one another are tested against the same triangles, and a
 * plane with its contact tolerance takes as long to compute as all other tests
 * of a pair together; but one for each triangle would be more memory than the
 * sheet.
 */
#ifndef VISIBILITY_PREDICATE_PLANE_CACHE_H
#define VISIBILITY_PREDICATE_PLANE_CACHE_H

#include "visibility/predicate/coarse_plane.h"
#include "visibility/predicate/plane_filter.h"

/* Direct-mapped: a triangle has one slot, which it shares with those whose
 * numbers are equal modulo the number of slots. */
struct plane_cache {
  const struct sheet *sheet; /* borrowed, not owned */
  struct cached_plane *slot;
  uint32_t mask; /* the number of slots, a power of two, less 1 */
  struct occlusion_bound all;
};

struct cached_plane {
  uint32_t number; /* that of the triangle, plus 1; 0: the slot is empty */
  struct plane_filter plane;
};

/* Returns false when memory ran out; end with plane_cache_fini either way. */
USE_RESULT bool plane_cache_init(struct plane_cache *cache,
                                 const struct sheet *sheet);
void plane_cache_fini(struct plane_cache *cache);

/* The plane of a triangle, which may be SHEET_EDGE_ON; valid until the next
 * call. */
static inline const struct plane_filter *
plane_cache_get(struct plane_cache *cache, uint32_t triangle) {
  struct cached_plane *slot = &cache->slot[triangle & cache->mask];
  if (slot->number != triangle + 1) {
    slot->number = triangle + 1;
    slot->plane = plane_filter_of(cache->sheet, triangle);
  }
  return &slot->plane;
}

#endif
