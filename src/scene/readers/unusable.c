/* unusable.c - points of a file that have no position that can be used. */
#include "scene/readers/unusable.h"

#include "base/sort.h"

static bool has(const struct unusable *unusable, uint32_t point) {
  size_t i;
  LOWER_BOUND(i, 0, unusable->point.count, unusable->point.item[i] < point);
  return i < unusable->point.count && unusable->point.item[i] == point;
}

bool unusable_has_any(const struct unusable *unusable, const uint32_t *corner,
                      size_t count) {
  for (size_t i = 0; unusable->point.count > 0 && i < count; i++)
    if (has(unusable, corner[i]))
      return true;
  return false;
}

void unusable_replace(const struct unusable *unusable, struct scene *scene,
                      size_t first) {
  size_t good = first;
  for (size_t i = 0; i < unusable->point.count; i++)
    if (unusable->point.item[i] == good)
      good++;
  struct scene_point other = {0, 0, 0};
  if (good < scene->point.count)
    other = scene->point.item[good];
  else if (first > 0)
    other = scene->point.item[0];
  for (size_t i = 0; i < unusable->point.count; i++)
    scene->point.item[unusable->point.item[i]] = other;
}
