/* edge_intervals.c - unites the occluded intervals of an edge, and stores the
 * complement. */
#include "visibility/predicate/edge_intervals.h"

#include <string.h>

static const struct ratio ZERO = {0, 1}, ONE = {1, 1};

void edge_intervals_fini(struct edge_intervals *intervals) {
  ARRAY_FREE(&intervals->merged);
  ARRAY_FREE(&intervals->unmerged);
  ARRAY_FREE(&intervals->left);
  ARRAY_FREE(&intervals->right);
  ARRAY_FREE(&intervals->order);
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

/* ---- The union ----------------------------------------------------------- */

/* Keys that differ by no more may stand for starts in any order: a start's
 * double is off by two units in the last place at most. */
enum { KEY_NEAR = 4 };

/* Interval i of those that are merged, followed by the others. */
static const struct occluded_interval *
nth_interval(const struct edge_intervals *intervals, size_t i) {
  size_t merged = intervals->merged.count;
  return i < merged ? &intervals->merged.item[i]
                    : &intervals->unmerged.item[i - merged];
}

/* The bits of the start's double, which is not negative: they order as doubles
 * do. */
static uint64_t key_of_start(const struct occluded_interval *interval) {
  double start = ratio_to_double(interval->from);
  uint64_t key;
  memcpy(&key, &start, sizeof key);
  return key;
}

/* Compares two keys by the starts of their intervals, then by number. */
static int compare_starts(const void *a, const void *b, void *user) {
  const struct sort_key *p = a, *q = b;
  int order = ratio_compare(nth_interval(user, p->value)->from,
                            nth_interval(user, q->value)->from);
  return order != 0 ? order : compare_numbers(p->value, q->value);
}

/* Orders the intervals with `side` occluded by their starts.  Returns false
 * when memory ran out. */
static bool order_intervals(struct edge_intervals *intervals, int side) {
  size_t n = intervals->merged.count + intervals->unmerged.count, count = 0;
  intervals->order.count = 0;
  if (!ARRAY_RESERVE(&intervals->order, 2 * n))
    return false;
  struct sort_key *order = intervals->order.item;
  for (size_t i = 0; i < n; i++) {
    const struct occluded_interval *interval = nth_interval(intervals, i);
    if (interval->sides & side)
      order[count++] = (struct sort_key){key_of_start(interval), (uint32_t)i};
  }
  sort_keys(order, order + count, count);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1;
         end < count && order[end].key - order[end - 1].key <= KEY_NEAR;)
      end++;
    if (!sort_stable(order + i, end - i, sizeof *order, compare_starts,
                     intervals))
      return false;
  }
  intervals->order.count = count;
  return true;
}

/* The union of the intervals with `side` occluded, ascending and disjoint.
 * Returns false when memory ran out. */
static bool unite_intervals(struct edge_intervals *intervals, int side,
                            occluded_intervals *united) {
  united->count = 0;
  if (!order_intervals(intervals, side))
    return false;
  for (size_t i = 0; i < intervals->order.count; i++) {
    const struct occluded_interval *q =
        nth_interval(intervals, intervals->order.item[i].value);
    struct occluded_interval *p =
        united->count > 0 ? &united->item[united->count - 1] : NULL;
    if (p == NULL || ratio_compare(q->from, p->to) > 0) {
      if (!ARRAY_PUSH(united, *q))
        return false;
    } else if (ratio_compare(p->to, q->to) < 0) {
      p->to = q->to;
    }
  }
  return true;
}

/* Whether each interval has both sides occluded. */
static bool are_all_two_sided(const struct edge_intervals *intervals) {
  int sides = OCCLUDED_BOTH;
  for (size_t i = 0; i < intervals->unmerged.count; i++)
    sides &= intervals->unmerged.item[i].sides;
  return sides == OCCLUDED_BOTH;
}

const occluded_intervals *
edge_intervals_unite(struct edge_intervals *intervals) {
  occluded_intervals *left = &intervals->left, *right = &intervals->right;
  if (intervals->unmerged.count == 0)
    return &intervals->merged;
  bool two_sided = are_all_two_sided(intervals);
  if (!unite_intervals(intervals, OCCLUDED_LEFT, left))
    return NULL;
  for (size_t i = 0; i < left->count; i++)
    left->item[i].sides = two_sided ? OCCLUDED_BOTH : OCCLUDED_LEFT;
  if (two_sided)
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
  occluded_intervals *left = &intervals->left, *right = &intervals->right;
  const occluded_intervals *hidden = &intervals->merged;
  map->edge_state[edge] = MAP_HIDDEN;
  if (intervals->occluded)
    return true;
  if (intervals->unmerged.count > 0) {
    bool two_sided = are_all_two_sided(intervals);
    if (!unite_intervals(intervals, OCCLUDED_LEFT, left) ||
        (!two_sided && !unite_intervals(intervals, OCCLUDED_RIGHT, right)) ||
        !intersect(left, two_sided ? left : right, &intervals->unmerged))
      return false;
    hidden = &intervals->unmerged;
  }
  if (hidden->count == 0) {
    map->edge_state[edge] = MAP_VISIBLE;
    return true;
  }
  return store_visible(hidden, edge, map);
}
