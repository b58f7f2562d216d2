/* part.c - compares what parts consist of, and frees them. */
#include "parts/part.h"

#include "base/sort.h"

void part_common_fini(struct part_common *common) {
  mem_free(common->path);
  for (size_t g = 0; g < common->group.count; g++)
    mem_free(common->group.item[g].name);
  ARRAY_FREE(&common->group);
  ARRAY_FREE(&common->precision);
  *common = (struct part_common){0};
}

void part_fini(struct part *part) {
  part_common_fini(&part->common);
  ARRAY_FREE(&part->point);
  ARRAY_FREE(&part->face);
  ARRAY_FREE(&part->wire);
  ARRAY_FREE(&part->corner);
  ARRAY_FREE(&part->tone);
  ARRAY_FREE(&part->mark);
  ARRAY_FREE(&part->interval);
  ARRAY_FREE(&part->over_limit);
  ARRAY_FREE(&part->edge);
  ARRAY_FREE(&part->crossing);
  ARRAY_FREE(&part->fragment);
  ARRAY_FREE(&part->run);
  ARRAY_FREE(&part->loop);
  ARRAY_FREE(&part->fragment_corner);
  *part = (struct part){0};
}

int part_edge_key_compare(struct part_edge_key a, struct part_edge_key b) {
  uint64_t p = part_edge_key_number(a), q = part_edge_key_number(b);
  return (p > q) - (p < q);
}

int part_edge_run_compare(const struct part_edge_run *a,
                          const struct part_edge_run *b) {
  int order = compare_numbers(a->face, b->face);
  return order != 0 ? order : compare_numbers(a->place, b->place);
}

int part_triangle_compare(struct part_triangle a, struct part_triangle b) {
  int order = compare_numbers(a.face, b.face);
  return order != 0 ? order : compare_numbers(a.place, b.place);
}

int part_crossing_compare(const struct part_crossing *a,
                          const struct part_crossing *b) {
  int order = 0;
  for (int k = 0; order == 0 && k < 2; k++)
    order = part_triangle_compare(a->triangle[k], b->triangle[k]);
  for (int k = 0; order == 0 && k < 2; k++)
    order = geom_compare_points(a->end[k], b->end[k]);
  return order;
}

bool part_window_meets(const struct part_window *window, const int32_t low[2],
                       const int32_t high[2]) {
  for (int k = 0; k < 2; k++)
    if (high[k] < window->low[k] || low[k] > window->high[k])
      return false;
  return true;
}
