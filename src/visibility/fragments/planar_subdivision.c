/* planar_subdivision.c - finds what lies beside each side of each fragment.
 *
 * Phases
 *   1 pair the sides that are a whole edge of both their faces, the usual case,
 *     which phase 2 has no part in; sort the others by the key of their line
 *   2 along each line sort the forward and the reversed sides by their low
 *     ends, and merge the two sequences: the stretches in common
 *   3 loop by loop divide the sides at the ends of their stretches */
#include "visibility/fragments/planar_subdivision.h"

#include <string.h>

#include "base/number_lists.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "geom/line_key.h"

/* In side_lines: the side lies on the line of its edge. */
#define OF_EDGE 0

/* What a forward and a reversed side have in common. */
struct side_stretch {
  uint32_t side[2];      /* the forward one and the reversed one */
  uint32_t corner[2];    /* at its low and at its high end */
  uint32_t half_edge[2]; /* of the two sides, when they are stored */
  bool upright;          /* places are y */
};

struct subdivision_work {
  const struct sheet *sheet;
  struct map *map;
  uint32_t *end; /* of each side: the corner where it ends */
  /* Of each side: that which is its reverse from end to end; SHEET_NONE: none.
   * Once half-edges are stored, its own one in place of that. */
  uint32_t *partner;
  ARRAY(struct side_stretch) stretch;
  struct number_lists along; /* the stretches of each side, in its direction */
  uint32_t *before; /* half-edges before those of each range of fragments */
};

bool side_lines_add_key(side_lines *lines, uint64_t key) {
  return ARRAY_PUSH(lines, key);
}

bool side_lines_add(side_lines *lines, const struct map_corner *corner,
                    const struct geom_line *line) {
  uint64_t key = OF_EDGE;
  if (corner->side != MAP_SIDE_EDGE && corner->side != MAP_SIDE_OCCLUDER)
    (void)geom_line_key(line, &key);
  return ARRAY_PUSH(lines, key);
}

/* ---- 1. Sides by line ---------------------------------------------------- */

static bool same_place(const struct map *map, uint32_t a, uint32_t b) {
  const struct map_corner *p = &map->corner.item[a], *q = &map->corner.item[b];
  return p->x == q->x && p->y == q->y;
}

/* Pairs the sides on one edge of which one is the reverse of the other. */
static bool pair_edges(struct subdivision_work *work) {
  const struct map *map = work->map;
  size_t edges = work->sheet->edge.count;
  uint32_t *partner = work->partner;
  uint32_t *first = mem_alloc(edges, sizeof *first); /* of each edge: a side */
  if (first == NULL)
    return false;
  memset(first, 0xff, edges * sizeof *first);
  for (uint32_t s = 0; s < map->corner.count; s++) {
    (void)poll_at(s);
    partner[s] = SHEET_NONE;
    if (map->corner.item[s].side != MAP_SIDE_EDGE ||
        map->corner.item[s].id >= edges)
      continue;
    uint32_t *other = &first[map->corner.item[s].id];
    if (*other == SHEET_NONE) {
      *other = s;
    } else if (partner[*other] == SHEET_NONE &&
               same_place(map, *other, work->end[s]) &&
               same_place(map, s, work->end[*other])) {
      partner[s] = *other;
      partner[*other] = s;
    }
  }
  mem_free(first);
  return true;
}

static uint64_t key_of_edge(const struct sheet *sheet, uint32_t edge) {
  const uint32_t *point = sheet->edge.item[edge].point;
  struct geom_line line;
  uint64_t key;
  geom_line_through(&line, sheet->point.item[point[0]],
                    sheet->point.item[point[1]]);
  (void)geom_line_key(&line, &key);
  return key;
}

/* ---- 2. Stretches in common ---------------------------------------------- */

static int64_t coordinate_along(const struct map *map, uint32_t corner,
                                bool upright) {
  const struct map_corner *c = &map->corner.item[corner];
  return (int64_t)((upright ? c->y : c->x) * MAP_CORNER_SCALE);
}

/* Whether the sides on a line extend farther in y than in x. */
static bool is_upright(const struct map *map, const struct sort_key *side,
                       size_t count) {
  double low[2], high[2];
  for (size_t i = 0; i < count; i++) {
    const struct map_corner *c = &map->corner.item[side[i].value];
    const double at[2] = {c->x, c->y};
    for (int k = 0; k < 2; k++) {
      low[k] = i == 0 || at[k] < low[k] ? at[k] : low[k];
      high[k] = i == 0 || at[k] > high[k] ? at[k] : high[k];
    }
  }
  return high[1] - low[1] > high[0] - low[0];
}

/* Finds the stretches that the sides on one line have in common.
 * side   their keys, overwritten
 * other  room for as many */
static bool match_sides(struct subdivision_work *work, struct sort_key *side,
                        struct sort_key *other, size_t count) {
  const struct map *map = work->map;
  size_t forwards = 0, reverses = 0, f = 0, r = 0;
  uint32_t past = SHEET_NONE; /* the high end of the last stretch */
  bool upright = is_upright(map, side, count);
  for (size_t i = 0; i < count; i++) {
    uint32_t s = side[i].value;
    int64_t from = coordinate_along(map, s, upright),
            to = coordinate_along(map, work->end[s], upright);
    bool reversed = to < from;
    struct sort_key key = {sort_key_of_int64(reversed ? to : from), s};
    other[reversed ? count - ++reverses : forwards++] = key;
  }
  sort_keys(other, side, forwards);
  sort_keys(other + forwards, side, reverses);
  while (f < forwards && r < reverses) {
    struct side_stretch next = {
        .side = {other[f].value, other[forwards + r].value},
        .upright = upright};
    uint32_t low[2] = {next.side[0], work->end[next.side[1]]};
    uint32_t high[2] = {work->end[next.side[0]], next.side[1]};
    bool later = coordinate_along(map, low[1], upright) >
                 coordinate_along(map, low[0], upright);
    bool sooner = coordinate_along(map, high[1], upright) <
                  coordinate_along(map, high[0], upright);
    int64_t from = coordinate_along(map, low[later], upright);
    next.corner[0] = low[later];
    next.corner[1] = high[sooner];
    if (past != SHEET_NONE && from < coordinate_along(map, past, upright)) {
      from = coordinate_along(map, past, upright); /* not in exact maps */
      next.corner[0] = past;
    }
    if (from < coordinate_along(map, next.corner[1], upright)) {
      past = next.corner[1];
      if (!ARRAY_PUSH(&work->stretch, next))
        return false;
    }
    if (sooner)
      r++;
    else
      f++;
  }
  return true;
}

/* The lines of the sides that are not paired. */
struct line_keys {
  const struct subdivision_work *work;
  const side_lines *lines;
  struct sort_key *key; /* one a side that is not paired */
  size_t *before;       /* one a range: how many there are before it */
};

static bool count_unpaired_sides(void *user, struct parallel_range range) {
  const struct line_keys *keys = user;
  size_t n = 0;
  for (size_t s = range.begin; s < range.end; s++)
    n += keys->work->partner[s] == SHEET_NONE;
  keys->before[range.begin / PARALLEL_ITEMS] = n;
  return true;
}

static bool key_sides_of_range(void *user, struct parallel_range range) {
  const struct line_keys *keys = user;
  const struct subdivision_work *work = keys->work;
  size_t n = keys->before[range.begin / PARALLEL_ITEMS];
  for (size_t s = range.begin; s < range.end; s++)
    if (work->partner[s] == SHEET_NONE)
      keys->key[n++] = (struct sort_key){
          keys->lines->item[s] != OF_EDGE
              ? keys->lines->item[s]
              : key_of_edge(work->sheet, work->map->corner.item[s].id),
          (uint32_t)s};
  return true;
}

/* Lists these sides with the keys of their lines, in order, and makes room for
 * as many; *count: how many.  Returns false when memory ran out or the caller
 * cancelled. */
static bool key_sides(struct line_keys *keys, size_t *count) {
  size_t sides = keys->work->map->corner.count,
         ranges = parallel_range_count(sides, PARALLEL_ITEMS);
  int workers = parallel_workers(sides, PARALLEL_ITEMS);
  keys->before = mem_alloc(ranges, sizeof *keys->before);
  bool ok =
      keys->before != NULL && parallel_ranges(workers, sides, PARALLEL_ITEMS,
                                              count_unpaired_sides, keys);
  for (size_t r = 0; ok && r < ranges; r++) {
    size_t own = keys->before[r];
    keys->before[r] = *count;
    *count += own;
  }
  keys->key = ok ? mem_alloc(*count, 2 * sizeof *keys->key) : NULL;
  ok = keys->key != NULL && parallel_ranges(workers, sides, PARALLEL_ITEMS,
                                            key_sides_of_range, keys);
  mem_free(keys->before);
  return ok;
}

static bool match_lines(struct subdivision_work *work,
                        const side_lines *lines) {
  size_t count = 0;
  struct line_keys keys = {work, lines, NULL, NULL};
  bool ok = pair_edges(work) && key_sides(&keys, &count);
  struct sort_key *key = keys.key;
  if (ok)
    sort_keys(key, key + count, count);
  for (size_t i = 0, j, n = 0; ok && i < count; i = j, n++) {
    for (j = i + 1; j < count && key[j].key == key[i].key;)
      j++;
    ok = poll_at(n) &&
         (j - i == 1 || match_sides(work, &key[i], key + count, j - i));
  }
  mem_free(key);
  return ok;
}

/* Lists the stretches by side.  They are in ascending order along their
 * line. */
static bool list_by_side(struct subdivision_work *work) {
  const struct side_stretch *stretch = work->stretch.item;
  size_t sides = work->map->corner.count, count = work->stretch.count;
  if (!number_lists_init(&work->along, sides))
    return false;
  for (uint32_t i = 0; i < count; i++)
    for (int k = 0; k < 2; k++)
      number_lists_put(&work->along, stretch[i].side[k], i);
  if (!number_lists_allocate(&work->along, sides))
    return false;
  for (uint32_t i = 0; i < count; i++)
    number_lists_put(&work->along, stretch[i].side[1], i);
  for (uint32_t i = (uint32_t)count; i-- > 0;) {
    (void)poll_at(i);
    number_lists_put(&work->along, stretch[i].side[0], i);
  }
  return true;
}

/* ---- 3. Half-edges ------------------------------------------------------- */

/* Fragments that a thread takes at once. */
enum { FRAGMENTS_IN_RANGE = PARALLEL_RANGE(1 << 12) };

/* Where the next half-edge is stored. */
struct half_edge_end {
  struct map_half_edge *half_edge; /* of the map; NULL: they are only counted */
  uint32_t count;
};

static void push_half_edge(struct half_edge_end *end,
                           struct map_half_edge half) {
  half.next = end->count + 1;
  if (end->half_edge != NULL)
    end->half_edge[end->count] = half;
  end->count++;
}

/* Adds the half-edges of a side, which is divided at its T-junctions: where the
 * neighbour beside it changes.  A partner stands for the twin until all are
 * stored. */
static void divide_side(const struct subdivision_work *work, uint32_t fragment,
                        uint32_t side, struct half_edge_end *end) {
  const struct map *map = work->map;
  struct map_half_edge half = {fragment, side, side, work->partner[side], 0};
  if (half.twin != SHEET_NONE) {
    if (end->half_edge != NULL)
      work->partner[side] = end->count;
    push_half_edge(end, half);
    return;
  }
  bool ends = false; /* the last stretch ends where the side does */
  for (uint32_t i = work->along.start[side]; i < work->along.start[side + 1];
       i++) {
    struct side_stretch *stretch = &work->stretch.item[work->along.item[i]];
    bool upright = stretch->upright, reversed = stretch->side[1] == side;
    uint32_t from = stretch->corner[reversed], to = stretch->corner[!reversed];
    if (coordinate_along(map, from, upright) !=
        coordinate_along(map, half.origin, upright)) {
      push_half_edge(end, half);
      half.origin = from;
    }
    if (end->half_edge != NULL)
      stretch->half_edge[reversed] = end->count;
    push_half_edge(end, half);
    half.origin = to;
    ends = coordinate_along(map, to, upright) ==
           coordinate_along(map, work->end[side], upright);
  }
  if (!ends)
    push_half_edge(end, half);
}

/* Fetches the first stretch of a side that comes later: those of consecutive
 * fragments are. */
MEM_PREFETCH_INLINE void prefetch_stretch(const struct subdivision_work *work,
                                          uint32_t side) {
  uint32_t later = side + MEM_PREFETCH_AHEAD;
  if (later < work->map->corner.count &&
      work->along.start[later] < work->along.start[later + 1])
    MEM_PREFETCH(
        &work->stretch.item[work->along.item[work->along.start[later]]]);
}

/* Adds the half-edges of the fragments of a range. */
static void divide_fragments(const struct subdivision_work *work,
                             struct parallel_range range,
                             struct half_edge_end *end) {
  const struct map *map = work->map;
  for (size_t f = range.begin; f < range.end; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; l < fragment->loops; l++) {
      struct map_loop *loop = &map->loop.item[fragment->loop + l];
      uint32_t first = end->count;
      for (uint32_t s = loop->corner; s < loop->corner + loop->count; s++) {
        if (work->partner[s] == SHEET_NONE)
          prefetch_stretch(work, s);
        divide_side(work, (uint32_t)f, s, end);
      }
      if (end->half_edge == NULL)
        continue;
      loop->half_edge = first;
      end->half_edge[end->count - 1].next = first;
    }
  }
}

static bool count_half_edges(void *user, struct parallel_range range) {
  const struct subdivision_work *work = user;
  struct half_edge_end end = {0};
  divide_fragments(work, range, &end);
  work->before[range.begin / FRAGMENTS_IN_RANGE] = end.count;
  return true;
}

static bool store_half_edges(void *user, struct parallel_range range) {
  const struct subdivision_work *work = user;
  struct half_edge_end end = {work->map->half_edge.item,
                              work->before[range.begin / FRAGMENTS_IN_RANGE]};
  divide_fragments(work, range, &end);
  return true;
}

/* Replaces the sides that stand for the twins of a range of half-edges. */
static bool store_whole_twins(void *user, struct parallel_range range) {
  const struct subdivision_work *work = user;
  struct map_half_edge *half = work->map->half_edge.item;
  for (size_t i = range.begin; i < range.end; i++)
    if (half[i].twin != SHEET_NONE)
      half[i].twin = work->partner[half[i].twin];
  return true;
}

static bool store_twins(void *user, struct parallel_range range) {
  const struct subdivision_work *work = user;
  for (size_t i = range.begin; i < range.end; i++) {
    const uint32_t *half = work->stretch.item[i].half_edge;
    work->map->half_edge.item[half[0]].twin = half[1];
    work->map->half_edge.item[half[1]].twin = half[0];
  }
  return true;
}

/* Does a task for all items by the threads of the call. */
static bool for_all(struct subdivision_work *work, size_t count, size_t items,
                    parallel_task *task) {
  return parallel_ranges(parallel_workers(count, items), count, items, task,
                         work);
}

static bool divide_loops(struct subdivision_work *work) {
  struct map *map = work->map;
  size_t count = map->fragment.count, sum = 0;
  size_t ranges = parallel_range_count(count, FRAGMENTS_IN_RANGE);
  work->before = mem_alloc(ranges, sizeof *work->before);
  if (work->before == NULL ||
      !for_all(work, count, FRAGMENTS_IN_RANGE, count_half_edges))
    return false;
  for (size_t r = 0; r < ranges; r++) {
    uint32_t own = work->before[r];
    work->before[r] = (uint32_t)sum;
    sum += own;
  }
  if (!ARRAY_RESERVE(&map->half_edge, sum))
    return false;
  map->half_edge.count = sum;
  return for_all(work, count, FRAGMENTS_IN_RANGE, store_half_edges) &&
         for_all(work, sum, PARALLEL_ITEMS, store_whole_twins) &&
         for_all(work, work->stretch.count, PARALLEL_ITEMS, store_twins);
}

static bool find_ends_of_range(void *user, struct parallel_range range) {
  const struct subdivision_work *work = user;
  for (size_t l = range.begin; l < range.end; l++) {
    const struct map_loop *loop = &work->map->loop.item[l];
    for (uint32_t i = 0; i < loop->count; i++)
      work->end[loop->corner + i] =
          loop->corner + (i + 1 < loop->count ? i + 1 : 0);
  }
  return true;
}

bool planar_subdivision_store(const side_lines *lines,
                              const struct sheet *sheet, struct map *map) {
  size_t count = map->corner.count;
  struct subdivision_work work = {.sheet = sheet,
                                  .map = map,
                                  .end = mem_alloc(count, sizeof *work.end),
                                  .partner =
                                      mem_alloc(count, sizeof *work.partner)};
  bool ok =
      work.end != NULL && work.partner != NULL &&
      for_all(&work, map->loop.count, PARALLEL_ITEMS, find_ends_of_range) &&
      match_lines(&work, lines) && list_by_side(&work) && divide_loops(&work);
  mem_free(work.end);
  mem_free(work.partner);
  number_lists_fini(&work.along);
  mem_free(work.before);
  ARRAY_FREE(&work.stretch);
  return ok;
}
