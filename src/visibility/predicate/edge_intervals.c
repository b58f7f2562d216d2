/* edge_intervals.c - unites the occluded intervals of an edge, and stores the
 * complement. */
#include "visibility/predicate/edge_intervals.h"

#include <string.h>

#include "base/sort.h"

static const struct ratio ZERO = {0, 1}, ONE = {1, 1};

void edge_intervals_fini(struct edge_intervals *intervals) {
  ARRAY_FREE(&intervals->merged);
  ARRAY_FREE(&intervals->unmerged);
  ARRAY_FREE(&intervals->left);
  ARRAY_FREE(&intervals->right);
}

/* How many intervals are kept merged as they are added: enough to see early
 * that an edge is occluded from end to end, few enough for a linear search. */
enum { MERGED_MAX = 32 };

/* Inserts an interval among ascending disjoint ones, uniting it with those that
 * it meets.  There must be room for one more. */
static void insert(occluded_intervals *united,
                   struct occluded_interval interval) {
  struct occluded_interval *item = united->item;
  size_t first = 0, past;
  while (first < united->count &&
         ratio_compare(item[first].to, interval.from) < 0)
    first++;
  for (past = first;
       past < united->count && ratio_compare(item[past].from, interval.to) <= 0;
       past++) {
    if (ratio_compare(item[past].from, interval.from) < 0)
      interval.from = item[past].from;
    if (ratio_compare(interval.to, item[past].to) < 0)
      interval.to = item[past].to;
  }
  if (past != first + 1 && past < united->count)
    memmove(item + first + 1, item + past,
            (united->count - past) * sizeof *item);
  united->count += first + 1 - past;
  item[first] = interval;
}

bool edge_intervals_occlude(struct edge_intervals *intervals,
                            struct occluded_interval interval) {
  occluded_intervals *merged = &intervals->merged;
  if (interval.sides != OCCLUDED_BOTH || merged->count == MERGED_MAX)
    return ARRAY_PUSH(&intervals->unmerged, interval);
  if (!ARRAY_RESERVE(merged, 1))
    return false;
  if (merged->count == 0)
    merged->item[merged->count++] = interval;
  else
    insert(merged, interval);
  intervals->occluded = merged->count == 1 && merged->item[0].from.num == 0 &&
                        merged->item[0].to.num == merged->item[0].to.den;
  return true;
}

struct occluded_interval
edge_intervals_remaining(const struct edge_intervals *intervals) {
  const occluded_intervals *merged = &intervals->merged;
  struct occluded_interval rest = {ZERO, ONE, OCCLUDED_BOTH};
  if (merged->count > 0 && merged->item[0].from.num == 0)
    rest.from = merged->item[0].to;
  if (merged->count > 0 && merged->item[merged->count - 1].to.num ==
                               merged->item[merged->count - 1].to.den)
    rest.to = merged->item[merged->count - 1].from;
  return rest;
}

bool edge_intervals_open_map(struct map *map, size_t edge_count) {
  uint8_t *state = mem_resize(map->edge_state, edge_count, 1);
  if (state == NULL)
    return false;
  memset(state + map->edge_count, MAP_HIDDEN, edge_count - map->edge_count);
  map->edge_state = state;
  map->edge_count = edge_count;
  return true;
}

static int compare_interval_starts(const void *a, const void *b, void *user) {
  const struct occluded_interval *p = a, *q = b;
  (void)user;
  return ratio_compare(p->from, q->from);
}

/* The union of the intervals with `side` occluded, ascending and disjoint.
 * Returns false when memory ran out. */
static bool unite_intervals(const struct edge_intervals *intervals, int side,
                            occluded_intervals *united) {
  const occluded_intervals *merged = &intervals->merged,
                           *unmerged = &intervals->unmerged;
  size_t last = 0;
  united->count = 0;
  for (size_t i = 0; i < merged->count; i++)
    if (!ARRAY_PUSH(united, merged->item[i]))
      return false;
  for (size_t i = 0; i < unmerged->count; i++)
    if ((unmerged->item[i].sides & side) &&
        !ARRAY_PUSH(united, unmerged->item[i]))
      return false;
  if (united->count == 0)
    return true;
  if (!sort_stable(united->item, united->count, sizeof *united->item,
                   compare_interval_starts, NULL))
    return false;
  for (size_t i = 1; i < united->count; i++) {
    struct occluded_interval *p = &united->item[last];
    const struct occluded_interval *q = &united->item[i];
    if (ratio_compare(q->from, p->to) > 0)
      united->item[++last] = *q;
    else if (ratio_compare(p->to, q->to) < 0)
      p->to = q->to;
  }
  united->count = last + 1;
  return true;
}

const occluded_intervals *
edge_intervals_unite(struct edge_intervals *intervals) {
  occluded_intervals *left = &intervals->left, *right = &intervals->right;
  int both = OCCLUDED_BOTH;
  if (intervals->unmerged.count == 0)
    return &intervals->merged;
  for (size_t i = 0; i < intervals->unmerged.count; i++)
    both &= intervals->unmerged.item[i].sides;
  if (!unite_intervals(intervals, OCCLUDED_LEFT, left))
    return NULL;
  for (size_t i = 0; i < left->count; i++)
    left->item[i].sides = both == OCCLUDED_BOTH ? OCCLUDED_BOTH : OCCLUDED_LEFT;
  if (both == OCCLUDED_BOTH)
    return left;
  if (!unite_intervals(intervals, OCCLUDED_RIGHT, right))
    return NULL;
  for (size_t i = 0; i < right->count; i++) {
    right->item[i].sides = OCCLUDED_RIGHT;
    if (!ARRAY_PUSH(left, right->item[i]))
      return NULL;
  }
  return left;
}

/* common = the intersection of left and right; all three are ascending and
 * disjoint.  Returns false when memory ran out. */
static bool intersect(const occluded_intervals *left,
                      const occluded_intervals *right,
                      occluded_intervals *common) {
  size_t i = 0, j = 0;
  common->count = 0;
  while (i < left->count && j < right->count) {
    struct occluded_interval p = left->item[i], q = right->item[j];
    struct occluded_interval both = {
        ratio_compare(p.from, q.from) > 0 ? p.from : q.from,
        ratio_compare(p.to, q.to) < 0 ? p.to : q.to, OCCLUDED_BOTH};
    if (ratio_compare(both.from, both.to) < 0 && !ARRAY_PUSH(common, both))
      return false;
    if (ratio_compare(p.to, q.to) < 0)
      i++;
    else
      j++;
  }
  return true;
}

/* Stores the complement of the occluded intervals in [0, 1]. */
static bool store_visible(const occluded_intervals *hidden, uint32_t edge,
                          struct map *map) {
  struct map_mixed mixed = {edge, (uint32_t)map->interval.count, 0};
  struct ratio from = ZERO;
  for (size_t i = 0; i <= hidden->count; i++) {
    struct ratio to = i < hidden->count ? hidden->item[i].from : ONE;
    if (ratio_compare(from, to) < 0) {
      struct map_interval visible = {from, to};
      if (!ARRAY_PUSH(&map->interval, visible))
        return false;
      mixed.count++;
    }
    if (i < hidden->count)
      from = hidden->item[i].to;
  }
  map->edge_state[edge] = mixed.count > 0 ? MAP_MIXED : MAP_HIDDEN;
  return mixed.count == 0 || ARRAY_PUSH(&map->mixed, mixed);
}

bool edge_intervals_store(struct edge_intervals *intervals, uint32_t edge,
                          struct map *map) {
  const occluded_intervals *unmerged = &intervals->unmerged;
  const occluded_intervals *hidden = &intervals->merged;
  map->edge_state[edge] = MAP_HIDDEN;
  if (intervals->occluded)
    return true;
  if (unmerged->count > 0) {
    if (!unite_intervals(intervals, OCCLUDED_LEFT, &intervals->left) ||
        !unite_intervals(intervals, OCCLUDED_RIGHT, &intervals->right) ||
        !intersect(&intervals->left, &intervals->right, &intervals->unmerged))
      return false;
    hidden = &intervals->unmerged;
  }
  if (hidden->count == 0) {
    map->edge_state[edge] = MAP_VISIBLE;
    return true;
  }
  return store_visible(hidden, edge, map);
}
