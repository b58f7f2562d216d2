/* part_points.c - the points that a part takes of its model. */
#include "parts/part_points.h"

void part_points_mark(uint32_t *local, const uint32_t *corner, size_t count) {
  for (size_t c = 0; c < count; c++)
    local[corner[c]] = 1;
}

void part_points_renumber(const uint32_t *local, uint32_t *corner,
                          size_t count) {
  for (size_t c = 0; c < count; c++)
    corner[c] = local[corner[c]];
}

bool part_points_copy(struct scene *scene, uint32_t **number,
                      const struct scene *whole, uint32_t *local) {
  size_t count = 0, range = 0;
  for (size_t p = 0; p < whole->point.count; p++)
    count += local[p];
  *number = mem_alloc(count, sizeof **number);
  if (*number == NULL || !ARRAY_RESERVE(&scene->point, count))
    return false;
  for (size_t p = 0; p < whole->point.count; p++) {
    for (; range < whole->precision.count &&
           whole->precision.item[range].first_point <= p;
         range++) {
      struct precision_range own = whole->precision.item[range];
      own.first_point = (uint32_t)scene->point.count;
      size_t last = scene->precision.count;
      if (last > 0 &&
          scene->precision.item[last - 1].first_point == own.first_point)
        scene->precision.item[last - 1] = own;
      else if (!ARRAY_PUSH(&scene->precision, own))
        return false;
    }
    if (local[p] == 0)
      continue;
    local[p] = (uint32_t)scene->point.count;
    (*number)[scene->point.count] = (uint32_t)p;
    scene->point.item[scene->point.count++] = whole->point.item[p];
  }
  return true;
}

void part_points_trim(struct scene *scene, uint32_t *number,
                      struct page_place *place, const uint8_t *used,
                      uint32_t *local) {
  uint32_t kept = 0;
  size_t range = 0, ranges = 0, last = SCENE_NONE;
  for (uint32_t p = 0; p < scene->point.count; p++) {
    for (; range < scene->precision.count &&
           scene->precision.item[range].first_point <= p;
         range++) {
      if (ranges > 0 && last == kept)
        ranges--;
      last = kept;
      scene->precision.item[ranges] = scene->precision.item[range];
      scene->precision.item[ranges++].first_point = kept;
    }
    if (!used[p])
      continue;
    local[p] = kept;
    number[kept] = number[p];
    place[kept] = place[p];
    scene->point.item[kept++] = scene->point.item[p];
  }
  scene->point.count = kept;
  scene->precision.count = ranges;
  part_points_renumber(local, scene->corner.item, scene->corner.count);
  part_points_renumber(local, scene->wire_corner.item,
                       scene->wire_corner.count);
}
