/* curve_ends.c - follows the edges of a curve back from its end. */
#include "visibility/contour/curve_ends.h"

#include <math.h>

static bool has_end(const struct sheet *sheet, uint32_t edge, uint32_t point) {
  const uint32_t *ends = sheet->edge.item[edge].point;
  return ends[0] == point || ends[1] == point;
}

uint32_t curve_next_edge(const struct sheet *sheet, uint32_t first,
                         uint32_t before, uint32_t edge, uint32_t point) {
  if (edge > first && edge - 1 != before && has_end(sheet, edge - 1, point))
    return edge - 1;
  if (edge + 1 < sheet->edge.count && edge + 1 != before &&
      has_end(sheet, edge + 1, point))
    return edge + 1;
  return SHEET_NONE;
}

struct geom_point curve_before_end(const struct sheet *sheet, uint32_t first,
                                   uint32_t edge, int k, double distance) {
  const uint32_t *ends = sheet->edge.item[edge].point;
  struct geom_point end = sheet->point.item[ends[k]];
  uint32_t point = ends[1 - k], before = SHEET_NONE;
  for (;;) {
    struct geom_point at = sheet->point.item[point];
    if (hypot((double)at.x - end.x, (double)at.y - end.y) >= distance)
      return at;
    uint32_t next = curve_next_edge(sheet, first, before, edge, point);
    if (next == SHEET_NONE)
      return at;
    before = edge;
    edge = next;
    ends = sheet->edge.item[edge].point;
    point = ends[ends[0] == point];
  }
}
