/* used.c - finds the points of a scene that a face or a polyline uses. */
#include "view/used.h"

#include "base/parallel.h"

struct used_marks {
  const uint32_t *corner, *weld;
  uint8_t *used;
};

/* Two threads may mark one point, with the same value. */
static inline void mark_used(uint8_t *used) {
  __atomic_store_n(used, 1, __ATOMIC_RELAXED);
}

static bool mark_corners_of_range(void *user, struct parallel_range range) {
  const struct used_marks marks = *(const struct used_marks *)user;
  if (marks.weld != NULL)
    for (size_t c = range.begin; c < range.end; c++)
      mark_used(&marks.used[marks.weld[marks.corner[c]]]);
  else
    for (size_t c = range.begin; c < range.end; c++)
      mark_used(&marks.used[marks.corner[c]]);
  return true;
}

/* Marks the points of corners; false where the caller cancelled. */
static bool mark_corners(const uint32_t *corner, size_t count,
                         const uint32_t *weld, uint8_t *used) {
  struct used_marks marks = {corner, weld, used};
  return parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, mark_corners_of_range, &marks);
}

uint8_t *used_points(const struct scene *scene, const uint32_t *weld) {
  uint8_t *used = mem_calloc(scene->point.count, sizeof *used);
  if (used != NULL &&
      (!mark_corners(scene->corner.item, scene->corner.count, weld, used) ||
       !mark_corners(scene->wire_corner.item, scene->wire_corner.count, weld,
                     used))) {
    mem_free(used);
    return NULL;
  }
  return used;
}
