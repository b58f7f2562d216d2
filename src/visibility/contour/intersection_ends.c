/* intersection_ends.c - lists the ends of visible parts of intersections, and
 * leaves out those that several parts share. */
#include "visibility/contour/intersection_ends.h"

#include "base/poll.h"
#include "base/sort.h"
#include "view/project.h"

static bool is_intersection_edge(const struct sheet *sheet, uint32_t edge) {
  return sheet->edge.item[edge].edge_class == RECTO_EDGE_INTERSECTION;
}

static bool add_ends(struct intersection_ends *ends, const struct sheet *sheet,
                     uint32_t edge, double t0, double t1) {
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[edge].point);
  const double t[2] = {t0, t1};
  for (int k = 0; k < 2; k++) {
    struct intersection_end end = {
        {(int32_t)snap(s.p.x + t[k] * ((double)s.q.x - s.p.x)),
         (int32_t)snap(s.p.y + t[k] * ((double)s.q.y - s.p.y)),
         s.p.z + (int64_t)(t[k] * (double)(s.q.z - s.p.z))},
        edge};
    if (t[k] == 0 || t[k] == 1)
      end.at = t[k] == 0 ? s.p : s.q;
    if (!ARRAY_PUSH(ends, end))
      return false;
  }
  return true;
}

static bool list_visible_ends(struct intersection_ends *ends,
                              const struct sheet *sheet, const struct map *map,
                              uint32_t edges) {
  for (uint32_t i = edges; i > 0 && is_intersection_edge(sheet, i - 1); i--)
    if (!poll_at(i) || (map->edge_state[i - 1] == MAP_VISIBLE &&
                        !add_ends(ends, sheet, i - 1, 0, 1)))
      return false;
  for (size_t m = 0; m < map->mixed.count; m++) {
    const struct map_mixed *mixed = &map->mixed.item[m];
    for (uint32_t i = 0;
         i < mixed->count && is_intersection_edge(sheet, mixed->edge); i++) {
      const struct map_interval *t = &map->interval.item[mixed->interval + i];
      if (!add_ends(ends, sheet, mixed->edge, ratio_to_double(t->t0),
                    ratio_to_double(t->t1)))
        return false;
    }
  }
  return true;
}

static int compare_intersection_ends(const void *a, const void *b, void *user) {
  const struct intersection_end *p = a, *q = b;
  (void)user;
  if (p->at.x != q->at.x)
    return p->at.x < q->at.x ? -1 : 1;
  if (p->at.y != q->at.y)
    return p->at.y < q->at.y ? -1 : 1;
  return (p->at.z > q->at.z) - (p->at.z < q->at.z);
}

/* Removes the ends that are those of several parts. */
static bool keep_loose_ends(struct intersection_ends *ends) {
  struct intersection_end *end = ends->item;
  size_t count = ends->count, kept = 0;
  if (!sort_stable(end, count, sizeof *end, compare_intersection_ends, NULL))
    return false;
  for (size_t i = 0, j; i < count; i = j) {
    for (j = i + 1;
         j < count && compare_intersection_ends(&end[i], &end[j], NULL) == 0;)
      j++;
    if (j == i + 1)
      end[kept++] = end[i];
  }
  ends->count = kept;
  return true;
}

bool intersection_ends_list(struct intersection_ends *ends,
                            const struct sheet *sheet, const struct map *map,
                            uint32_t edges) {
  return list_visible_ends(ends, sheet, map, edges) && keep_loose_ends(ends);
}
