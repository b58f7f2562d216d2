/* used.c - finds the points of a scene that a face or a polyline uses. */
#include "view/used.h"

static void mark(const uint32_t *corner, size_t count, const uint32_t *weld,
                 uint8_t *used) {
  if (weld != NULL)
    for (size_t c = 0; c < count; c++)
      used[weld[corner[c]]] = 1;
  else
    for (size_t c = 0; c < count; c++)
      used[corner[c]] = 1;
}

uint8_t *used_points(const struct scene *scene, const uint32_t *weld) {
  uint8_t *used = mem_calloc(scene->point.count, sizeof *used);
  if (used != NULL) {
    mark(scene->corner.item, scene->corner.count, weld, used);
    mark(scene->wire_corner.item, scene->wire_corner.count, weld, used);
  }
  return used;
}
