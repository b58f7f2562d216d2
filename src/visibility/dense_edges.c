/* dense_edges.c - closes short gaps of edges that are visible in very many
 * parts. */
#include "visibility/dense_edges.h"

#include <math.h>

void dense_edges_close(struct map *map, struct map_mixed *mixed,
                       const struct sheet *sheet, double gap) {
  if (!(gap > 0) || mixed->count <= DENSE_EDGES_PARTS)
    return;
  struct geom_segment s =
      sheet_ends(sheet, sheet->edge.item[mixed->edge].point);
  double length = hypot((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
  struct map_interval *first = map->interval.item + mixed->interval,
                      *last = first;
  for (const struct map_interval *next = first + 1; next < first + mixed->count;
       next++) {
    double hidden = ratio_to_double(next->t0) - ratio_to_double(last->t1);
    if (hidden * length <= gap)
      last->t1 = next->t1;
    else
      *++last = *next;
  }
  mixed->count = (uint32_t)(last - first) + 1;
}

void dense_edges_close_all(struct map *map, const struct sheet *sheet,
                           double gap) {
  for (size_t i = 0; i < map->mixed.count; i++)
    dense_edges_close(map, &map->mixed.item[i], sheet, gap);
}
