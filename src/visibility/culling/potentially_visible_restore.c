/* potentially_visible_restore.c - brings what was found of a part back to the
 * whole sheet. */
#include <string.h>

#include "visibility/culling/potentially_visible.h"

/* Appends the edges of intersections, and their points, to the whole sheet. */
static bool append_intersections(const struct potentially_visible *part,
                                 struct sheet *whole) {
  const struct sheet *sheet = &part->sheet;
  size_t points = sheet->point.count - part->points,
         edges = sheet->edge.count - part->edges;
  uint32_t past = (uint32_t)(whole->point.count - part->points);
  if (edges == 0)
    return true;
  if (!ARRAY_RESERVE(&whole->point, points) ||
      !ARRAY_RESERVE(&whole->edge, edges))
    return false;
  memcpy(whole->point.item + whole->point.count,
         sheet->point.item + part->points, points * sizeof *sheet->point.item);
  whole->point.count += points;
  for (size_t e = part->edges; e < sheet->edge.count; e++) {
    struct sheet_edge edge = sheet->edge.item[e];
    for (int k = 0; k < 2; k++) {
      edge.point[k] += past; /* both were added */
      edge.triangle[k] = part->triangle[edge.triangle[k]];
    }
    whole->edge.item[whole->edge.count++] = edge;
  }
  return true;
}

/* The whole sheet's number of an edge of the part.
 * past  what the intersections' numbers are greater by */
static uint32_t whole_edge_number(const struct potentially_visible *part,
                                  uint32_t edge, uint32_t past) {
  return edge < part->edges ? part->edge[edge] : edge + past;
}

bool potentially_visible_restore(struct potentially_visible *part,
                                 struct sheet *whole, struct map *map) {
  uint32_t past = (uint32_t)(whole->edge.count - part->edges);
  if (!append_intersections(part, whole))
    return false;
  if (map->edge_state != NULL) {
    uint8_t *state = mem_calloc(whole->edge.count, 1);
    if (state == NULL)
      return false;
    for (uint32_t e = 0; e < map->edge_count; e++)
      state[whole_edge_number(part, e, past)] = map->edge_state[e];
    mem_free(map->edge_state);
    map->edge_state = state;
    map->edge_count = whole->edge.count;
  }
  for (size_t i = 0; i < map->mixed.count; i++)
    map->mixed.item[i].edge =
        whole_edge_number(part, map->mixed.item[i].edge, past);
  for (size_t i = 0; i < map->corner.count; i++) {
    struct map_corner *corner = &map->corner.item[i];
    if (corner->side == MAP_SIDE_EDGE || corner->side == MAP_SIDE_OCCLUDER)
      corner->id = whole_edge_number(part, corner->id, past);
  }
  return true;
}
