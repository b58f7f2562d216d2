/* quantitative_invisibility.c - how many faces hide each point of an edge.
 *
 * What each triangle hides of an edge is an open interval of exact parameters,
 * on the edge's left side, on its right side or on both.  A sweep along the
 * edge over the ends of these intervals keeps a count for either side; the
 * quantitative invisibility is the smaller of the two.
 *
 * Source  [Appel1967] */
#include "visibility/quantitative_invisibility.h"

#include "base/sort.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/progress.h"

/* A parameter at which the counts change. */
struct change {
  struct ratio at;
  int left, right; /* +1, 0 or -1 */
};

struct invisibility_sweep {
  const struct sheet *sheet;
  struct map *map;
  int limit;
  bool store_counts; /* whether to store map->invisible too */
  struct triangle_grid grid;
  struct triangle_grid_query query;
  struct occlusion_counts counts;
  ARRAY(struct change) change;
};

static int compare_changes(const void *first, const void *second, void *user) {
  const struct change *a = first, *b = second;
  (void)user;
  return ratio_compare(a->at, b->at);
}

static bool add_interval(struct invisibility_sweep *sweep,
                         const struct occluded_interval *interval) {
  int left = (interval->sides & OCCLUDED_LEFT) != 0;
  int right = (interval->sides & OCCLUDED_RIGHT) != 0;
  return ARRAY_PUSH(&sweep->change,
                    ((struct change){interval->from, left, right})) &&
         ARRAY_PUSH(&sweep->change,
                    ((struct change){interval->to, -left, -right}));
}

/* Collects and sorts the changes along an edge. */
static bool find_changes(struct invisibility_sweep *sweep,
                         const struct sheet_edge *edge) {
  const struct geom_point *point = sweep->sheet->point.item;
  struct geom_point p = point[edge->point[0]], q = point[edge->point[1]];
  struct box2 box = box2_of_segment(p, q);
  sweep->change.count = 0;
  if (!triangle_grid_find_along(&sweep->grid, p, q, &sweep->query))
    return false;
  for (size_t i = 0; i < sweep->query.found.count; i++) {
    uint32_t t = sweep->query.found.item[i];
    struct occluded_interval interval;
    if (occlusion_is_own(sweep->sheet, edge, t) ||
        !occlusion_is_possible(sweep->sheet, t, p, q, box))
      continue;
    if (occlude_edge_by_triangle(sweep->sheet, t, p, q, &interval,
                                 &sweep->counts) &&
        !add_interval(sweep, &interval))
      return false;
  }
  return sort_stable(sweep->change.item, sweep->change.count,
                     sizeof *sweep->change.item, compare_changes, NULL);
}

/* Adds the interval to those of the edge that are over the limit. */
static bool add_over_limit(struct map *map, struct map_interval interval,
                           struct map_mixed *edge) {
  edge->count++;
  return ARRAY_PUSH(&map->over_limit_interval, interval);
}

static bool add_invisible(struct map *map, struct map_interval interval,
                          int faces, struct map_mixed *edge) {
  const struct map_invisible_interval invisible = {interval, (uint32_t)faces};
  edge->count++;
  return ARRAY_PUSH(&map->invisible_interval, invisible);
}

/* Stores the intervals where both counts exceed the limit, and where requested
 * those where both exceed 0, with the smaller of the two. */
static bool store_intervals(struct invisibility_sweep *sweep, uint32_t edge) {
  struct map *map = sweep->map;
  struct map_mixed over_limit = {edge, (uint32_t)map->over_limit_interval.count,
                                 0};
  struct map_mixed invisible = {edge, (uint32_t)map->invisible_interval.count,
                                0};
  struct ratio over_from = ratio_of(0, 1), from = ratio_of(0, 1);
  int left = 0, right = 0, before = 0;
  for (size_t i = 0; i < sweep->change.count;) {
    struct ratio at = sweep->change.item[i].at;
    for (; i < sweep->change.count &&
           ratio_compare(sweep->change.item[i].at, at) == 0;
         i++) {
      left += sweep->change.item[i].left;
      right += sweep->change.item[i].right;
    }
    int faces = left < right ? left : right;
    bool over = faces > sweep->limit, was_over = before > sweep->limit;
    if (was_over && !over &&
        !add_over_limit(map, (struct map_interval){over_from, at}, &over_limit))
      return false;
    if (over && !was_over)
      over_from = at;
    if (faces == before)
      continue;
    if (sweep->store_counts && before > 0 &&
        !add_invisible(map, (struct map_interval){from, at}, before,
                       &invisible))
      return false;
    from = at;
    before = faces;
  }
  return (over_limit.count == 0 || ARRAY_PUSH(&map->over_limit, over_limit)) &&
         (invisible.count == 0 || ARRAY_PUSH(&map->invisible, invisible));
}

static recto_status find_all(struct invisibility_sweep *sweep,
                             recto_error *error) {
  struct progress progress = {.stage = "invisibility"};
  size_t edges = sweep->map->edge_count;
  for (size_t e = 0; e < edges; e++) {
    if (!progress_step_at(&progress, 1 + 4 * sweep->query.found.count, e,
                          edges))
      return error_memory(error);
    if (sweep->map->edge_state[e] != MAP_VISIBLE &&
        sheet_edge_is_drawn(sweep->sheet, e) &&
        !(find_changes(sweep, &sweep->sheet->edge.item[e]) &&
          store_intervals(sweep, (uint32_t)e)))
      return error_memory(error);
  }
  return RECTO_OK;
}

recto_status quantitative_invisibility_find(struct map *map,
                                            const struct sheet *sheet,
                                            int limit, bool counts,
                                            struct report *report,
                                            recto_error *error) {
  struct invisibility_sweep sweep = {
      .sheet = sheet, .map = map, .limit = limit, .store_counts = counts};
  if (map->edge_state == NULL)
    return RECTO_OK;
  if (!triangle_grid_init(&sweep.grid, sheet))
    return error_memory(error);
  recto_status status = RECTO_OK;
  if (triangle_grid_query_init(&sweep.query, &sweep.grid))
    status = find_all(&sweep, error);
  else
    status = error_memory(error);
  report_int(report, "quantitative_invisibility", "limit", limit);
  report_count(report, "quantitative_invisibility", "pairs",
               sweep.counts.pairs);
  report_count(report, "quantitative_invisibility", "intervals_over_limit",
               map->over_limit_interval.count);
  triangle_grid_query_fini(&sweep.query);
  triangle_grid_fini(&sweep.grid);
  ARRAY_FREE(&sweep.change);
  return status;
}
