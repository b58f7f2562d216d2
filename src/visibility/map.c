/* map.c - initialises and frees the visible map. */
#include "visibility/map.h"

#include <string.h>

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
  map_init(map);
}
