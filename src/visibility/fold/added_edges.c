/* added_edges.c - adds silhouettes to a sheet and its map. */
#include "visibility/fold/added_edges.h"

#include "visibility/zero_set/zero_segments.h"

bool added_edges_reserve(struct map *map, size_t count) {
  uint8_t *state = mem_resize(map->edge_state, map->edge_count + count, 1);
  if (state != NULL)
    map->edge_state = state;
  return state != NULL;
}

bool added_edges_push(struct sheet *sheet, struct map *map, uint32_t face,
                      const uint32_t point[2]) {
  struct sheet_edge edge = {
      .point = {point[0], point[1]},
      .triangle = {first_triangle_of_face(sheet, face), SHEET_NONE},
      .source = SHEET_NONE,
      .edge_class = RECTO_EDGE_SILHOUETTE};
  if (!ARRAY_PUSH(&sheet->edge, edge))
    return false;
  map->edge_state[map->edge_count++] = MAP_VISIBLE;
  return true;
}

bool added_edges_point(struct sheet *sheet, struct geom_point at,
                       uint32_t *point) {
  *point = (uint32_t)sheet->point.count;
  return ARRAY_PUSH(&sheet->point, at);
}
