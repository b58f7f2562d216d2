/* map_assembly.c - makes a visible map of results that are known already. */
#include "visibility/map_assembly.h"

#include "visibility/fragments/planar_subdivision.h"
#include "visibility/intersection/intersection.h"
#include "visibility/intersection/intersection_segment.h"
#include "visibility/predicate/edge_intervals.h"

int map_intersection_compare(const struct map_intersection *a,
                             const struct map_intersection *b) {
  int order = 0;
  for (int k = 0; k < 2; k++)
    if (a->triangle[k] != b->triangle[k])
      return a->triangle[k] < b->triangle[k] ? -1 : 1;
  for (int k = 0; k < 2 && order == 0; k++)
    order = geom_compare_points(a->end[k], b->end[k]);
  return order;
}

bool map_assembly_add_intersections(struct sheet *sheet,
                                    const struct map_intersection *line,
                                    size_t count) {
  struct intersection_segments segments = {.list = {.item = NULL}};
  bool ok = ARRAY_RESERVE(&segments.list, count);
  for (size_t i = 0; ok && i < count; i++)
    segments.list.item[segments.list.count++] = (struct intersection_segment){
        {line[i].triangle[0], line[i].triangle[1]},
        {line[i].end[0], line[i].end[1]}};
  ok = ok && intersection_add_edges(sheet, &segments);
  ARRAY_FREE(&segments.list);
  return ok;
}

bool map_assembly_open_edges(struct map *map, size_t edges) {
  return edge_intervals_open_map(map, edges);
}

bool map_assembly_link_sides(struct map *map, const struct sheet *sheet) {
  const side_lines lines = {.item = map->side_line.item,
                            .count = map->side_line.count,
                            .capacity = map->side_line.capacity};
  return planar_subdivision_store(&lines, sheet, map);
}
