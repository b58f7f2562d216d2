/* map.c - initialises and frees the visible map. */
#include "visibility/map.h"

#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"

void map_init(struct map *map) { memset(map, 0, sizeof *map); }

void map_fini(struct map *map) {
  mem_free(map->edge_state);
  ARRAY_FREE(&map->mixed);
  ARRAY_FREE(&map->interval);
  ARRAY_FREE(&map->over_limit);
  ARRAY_FREE(&map->over_limit_interval);
  ARRAY_FREE(&map->invisible);
  ARRAY_FREE(&map->invisible_interval);
  ARRAY_FREE(&map->fragment);
  ARRAY_FREE(&map->loop);
  ARRAY_FREE(&map->corner);
  ARRAY_FREE(&map->half_edge);
  ARRAY_FREE(&map->side_line);
  mem_free(map->corner_tone);
  mem_free(map->face_uniform);
  map_init(map);
}

/* ---- The order of edges -------------------------------------------------- */

struct mixed_order {
  const struct map *map;
  const struct sort_key *key; /* the edges, and their places in `mixed` */
  struct map_mixed *mixed;    /* sorted, as the intervals are to be */
  struct map_interval *interval;
  size_t intervals;
};

/* Moves the intervals of a range of the edges. */
static bool move_intervals(void *user, struct parallel_range range) {
  const struct mixed_order *order = user;
  for (size_t m = range.begin; m < range.end; m++) {
    const struct map_mixed *from = &order->map->mixed.item[order->key[m].value];
    memcpy(order->interval + order->mixed[m].interval,
           order->map->interval.item + from->interval,
           from->count * sizeof *order->interval);
  }
  return true;
}

/* Makes what is sorted of the edges that are in the order of the keys. */
static bool move_mixed(struct mixed_order *order) {
  size_t count = order->map->mixed.count;
  for (size_t m = 0; m < count; m++) {
    struct map_mixed *to = &order->mixed[m];
    (void)poll_at(m);
    *to = order->map->mixed.item[order->key[m].value];
    to->interval = (uint32_t)order->intervals;
    order->intervals += to->count;
  }
  return parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, move_intervals, order);
}

bool map_sort_mixed(struct map *map) {
  size_t count = map->mixed.count;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct mixed_order order = {
      .map = map,
      .key = key,
      .mixed = mem_alloc(count, sizeof *order.mixed),
      .interval = mem_alloc(map->interval.count, sizeof *order.interval)};
  bool ok = key != NULL && order.mixed != NULL && order.interval != NULL;
  for (size_t m = 0; ok && m < count; m++)
    key[m] = (struct sort_key){map->mixed.item[m].edge, (uint32_t)m};
  ok = ok && sort_keys_alone(key, count) && move_mixed(&order);
  if (ok && count > 0) {
    memcpy(map->mixed.item, order.mixed, count * sizeof *order.mixed);
    mem_free(map->interval.item);
    map->interval.item = order.interval;
    map->interval.capacity = map->interval.count;
    map->interval.count = order.intervals;
    order.interval = NULL;
  }
  mem_free(key);
  mem_free(order.mixed);
  mem_free(order.interval);
  return ok;
}
