/* plane_cache.c - the planes of triangles that were used last, by one
 * thread. */
#include "visibility/predicate/plane_cache.h"

enum { SLOTS_MAX = 1 << 12 }; /* half a megabyte, as much as a near cache has */

bool plane_cache_init(struct plane_cache *cache, const struct sheet *sheet) {
  uint32_t count = 1;
  while (count < SLOTS_MAX && count < sheet->triangle.count)
    count *= 2;
  *cache =
      (struct plane_cache){sheet, mem_calloc(count, sizeof *cache->slot),
                           count - 1, occlusion_tolerance_bound_all(sheet)};
  return cache->slot != NULL;
}

void plane_cache_fini(struct plane_cache *cache) {
  mem_free(cache->slot);
  cache->slot = NULL;
}
