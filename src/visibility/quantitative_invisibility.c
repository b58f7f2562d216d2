/* quantitative_invisibility.c - behind how many faces an edge runs.
 *
 * What each triangle covers of an edge, on its left and on its right, is an
 * open interval of exact parameters.  Where they begin and end the two counts
 * change; the edge is behind the smaller of them. */
#include "visibility/quantitative_invisibility.h"

#include "base/sort.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/progress.h"

/* A place where the counts change. */
struct change {
  struct ratio at;
  int left, right; /* +1, 0 or -1 */
};

struct depth_sweep {
  const struct sheet *sheet;
  struct map *map;
  int most;
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

static bool add_part(struct depth_sweep *d,
                     const struct occluded_interval *part) {
  int left = (part->sides & OCCLUDED_LEFT) != 0;
  int right = (part->sides & OCCLUDED_RIGHT) != 0;
  return ARRAY_PUSH(&d->change, ((struct change){part->from, left, right})) &&
         ARRAY_PUSH(&d->change, ((struct change){part->to, -left, -right}));
}

/* Gathers and sorts the changes along an edge. */
static bool find_changes(struct depth_sweep *d, const struct sheet_edge *edge) {
  const struct geom_point *point = d->sheet->point.item;
  struct geom_point p = point[edge->point[0]], q = point[edge->point[1]];
  struct box2 box = box2_of_segment(p, q);
  d->change.count = 0;
  if (!triangle_grid_find_along(&d->grid, p, q, &d->query))
    return false;
  for (size_t i = 0; i < d->query.found.count; i++) {
    uint32_t t = d->query.found.item[i];
    struct occluded_interval part;
    if (t == edge->triangle[0] || t == edge->triangle[1] ||
        !occlusion_is_possible(d->sheet, t, p, q, box))
      continue;
    if (occlude_edge_by_triangle(d->sheet, t, p, q, &part, &d->counts) &&
        !add_part(d, &part))
      return false;
  }
  return sort_stable(d->change.item, d->change.count, sizeof *d->change.item,
                     compare_changes, NULL);
}

/* Files the intervals where both counts are above `most`. */
static bool store_deep(struct depth_sweep *d, uint32_t edge) {
  struct map_mixed deep = {edge, (uint32_t)d->map->over_limit_interval.count,
                           0};
  struct ratio from = ratio_of(0, 1);
  bool inside = false;
  int left = 0, right = 0;
  for (size_t i = 0; i < d->change.count;) {
    struct ratio at = d->change.item[i].at;
    for (; i < d->change.count && ratio_compare(d->change.item[i].at, at) == 0;
         i++) {
      left += d->change.item[i].left;
      right += d->change.item[i].right;
    }
    bool now = left > d->most && right > d->most;
    if (now && !inside)
      from = at;
    if (inside && !now) {
      struct map_interval interval = {from, at};
      if (!ARRAY_PUSH(&d->map->over_limit_interval, interval))
        return false;
      deep.count++;
    }
    inside = now;
  }
  return deep.count == 0 || ARRAY_PUSH(&d->map->over_limit, deep);
}

static bool is_asked_for(const struct depth_sweep *d, size_t e) {
  const struct sheet_edge *edge = &d->sheet->edge.item[e];
  const struct geom_point *p = &d->sheet->point.item[edge->point[0]];
  const struct geom_point *q = &d->sheet->point.item[edge->point[1]];
  return edge->edge_class != 0 && d->map->edge_state[e] != MAP_VISIBLE &&
         (p->x != q->x || p->y != q->y);
}

static recto_status find_all(struct depth_sweep *d,
                             const struct solver_request *request,
                             recto_error *error) {
  struct progress progress = progress_of(request, "depths");
  size_t edges = d->map->edge_count;
  for (size_t e = 0; e < edges; e++) {
    if (!progress_step_at(&progress, 1 + d->query.found.count, e, edges))
      return progress_error(&progress, error);
    if (is_asked_for(d, e) && !(find_changes(d, &d->sheet->edge.item[e]) &&
                                store_deep(d, (uint32_t)e)))
      return error_memory(error);
  }
  return RECTO_OK;
}

recto_status
quantitative_invisibility_find(struct map *map, const struct sheet *sheet,
                               int most, const struct solver_request *request,
                               struct report *report, recto_error *error) {
  struct depth_sweep d = {.sheet = sheet, .map = map, .most = most};
  if (map->edge_state == NULL)
    return RECTO_OK;
  if (!triangle_grid_init(&d.grid, sheet))
    return error_memory(error);
  recto_status status = RECTO_OK;
  if (triangle_grid_query_init(&d.query, &d.grid))
    status = find_all(&d, request, error);
  else
    status = error_memory(error);
  report_int(report, "hidden", "most_layers", most);
  report_int(report, "hidden", "pairs_for_layers", (int64_t)d.counts.pairs);
  report_int(report, "hidden", "parts_too_deep",
             (int64_t)map->over_limit_interval.count);
  triangle_grid_query_fini(&d.query);
  triangle_grid_fini(&d.grid);
  ARRAY_FREE(&d.change);
  return status;
}
