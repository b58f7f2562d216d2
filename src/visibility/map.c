/* map.c - initialises and frees the visible map. */
#include "visibility/map.h"

#include <string.h>

#include "base/sort.h"

void map_init(struct map *map) { memset(map, 0, sizeof *map); }

void map_fini(struct map *map) {
  mem_free(map->edge_state);
  ARRAY_FREE(&map->mixed);
  ARRAY_FREE(&map->interval);
  ARRAY_FREE(&map->over_limit);
  ARRAY_FREE(&map->over_limit_interval);
  ARRAY_FREE(&map->invisible);
  ARRAY_FREE(&map->invisible_interval);
  ARRAY_FREE(&map->fragment);
  ARRAY_FREE(&map->loop);
  ARRAY_FREE(&map->corner);
  ARRAY_FREE(&map->half_edge);
  ARRAY_FREE(&map->side_line);
  mem_free(map->corner_tone);
  mem_free(map->face_uniform);
  map_init(map);
}

static int compare_mixed(const void *a, const void *b, void *user) {
  const struct map_mixed *p = a, *q = b;
  (void)user;
  return compare_numbers(p->edge, q->edge);
}

bool map_sort_mixed(struct map *map) {
  struct map_interval *sorted = mem_alloc(map->interval.count, sizeof *sorted);
  size_t count = 0;
  bool ok = sorted != NULL &&
            sort_stable(map->mixed.item, map->mixed.count,
                        sizeof *map->mixed.item, compare_mixed, NULL);
  for (size_t m = 0; ok && m < map->mixed.count; m++) {
    struct map_mixed *mixed = &map->mixed.item[m];
    memcpy(sorted + count, map->interval.item + mixed->interval,
           mixed->count * sizeof *sorted);
    mixed->interval = (uint32_t)count;
    count += mixed->count;
  }
  if (ok && count > 0)
    memcpy(map->interval.item, sorted, count * sizeof *sorted);
  mem_free(sorted);
  return ok;
}
