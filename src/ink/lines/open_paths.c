/* open_paths.c - follows the paths between ends that are joined to no other, by
 * all threads.
 *
 * A walk begins at each open end, so that there are two for each path.  Walks
 * claim segments, each of which is one walk's, and end where the next segment
 * is the other's: how far each comes depends on the threads, what both have
 * together does not.  A step is to a place in memory that only the one before
 * tells, so that each thread takes steps of several walks in turn, and fetches
 * what the next step of each reads.
 *
 * Phases
 *   1 list   the open ends
 *   2 walk   from them, by ranges
 *   3 unite  the two walks of each path.  At the last end of a walk its number
 *            takes the place of the mate, by which the other one finds it */
#include "ink/lines/open_paths.h"

#include <string.h>

#include "base/parallel.h"

enum { WALKS_IN_RANGE = PARALLEL_RANGE(128), LANES = 8 };

struct walking {
  struct open_paths *paths;
  uint32_t *mate;
  atomic_uchar *used;
  bool shared; /* several threads claim segments */
};

/* One of the walks that a thread follows in turn. */
struct walk_lane {
  struct open_walk *walk; /* NULL: none */
  uint32_t end;           /* the next one */
  ARRAY(uint32_t) passed;
};

/* ---- 1 List -------------------------------------------------------------- */

/* How many of the ends of a range are open; then how many before it are. */
struct open_end_list {
  struct open_paths *paths;
  const uint32_t *mate;
  size_t *open; /* one a range */
};

static bool count_open_ends(void *user, struct parallel_range range) {
  const struct open_end_list *list = user;
  size_t open = 0;
  for (size_t end = range.begin; end < range.end; end++)
    open += list->mate[end] == SEGMENT_GRAPH_NONE;
  list->open[range.begin / PARALLEL_ITEMS] = open;
  return true;
}

static bool store_open_ends(void *user, struct parallel_range range) {
  const struct open_end_list *list = user;
  struct open_walk *walk =
      ARRAY_AT(&list->paths->walk, list->open[range.begin / PARALLEL_ITEMS]);
  for (size_t end = range.begin; end < range.end; end++)
    if (list->mate[end] == SEGMENT_GRAPH_NONE)
      *walk++ = (struct open_walk){.open = (uint32_t)end};
  return true;
}

static bool list_open_ends(struct open_paths *paths, const uint32_t *mate,
                           size_t count) {
  size_t ends = 2 * count, sum = 0,
         ranges = parallel_range_count(ends, PARALLEL_ITEMS);
  int workers = parallel_workers(ends, PARALLEL_ITEMS);
  struct open_end_list list = {paths, mate,
                               mem_alloc(ranges, sizeof *list.open)};
  bool ok = list.open != NULL && parallel_ranges(workers, ends, PARALLEL_ITEMS,
                                                 count_open_ends, &list);
  for (size_t r = 0; ok && r < ranges; r++) {
    size_t open = list.open[r];
    list.open[r] = sum;
    sum += open;
  }
  ok = ok && ARRAY_RESERVE(&paths->walk, sum);
  if (ok)
    paths->walk.count = sum;
  ok = ok &&
       parallel_ranges(workers, ends, PARALLEL_ITEMS, store_open_ends, &list);
  mem_free(list.open);
  return ok;
}

/* ---- 2 Walk -------------------------------------------------------------- */

/* Whether the segment was no walk's, and is now the caller's. */
static bool claim_segment(const struct walking *w, uint32_t segment) {
  atomic_uchar *used = &w->used[segment];
  if (w->shared)
    return atomic_exchange_explicit(used, 1, memory_order_relaxed) == 0;
  bool is_free = atomic_load_explicit(used, memory_order_relaxed) == 0;
  atomic_store_explicit(used, 1, memory_order_relaxed);
  return is_free;
}

static void begin_walk(struct walk_lane *lane, struct open_walk *walk) {
  lane->walk = walk;
  lane->end = walk->open;
  lane->passed.count = 0;
}

/* Takes a step.  Returns false when memory ran out; *ended: there is none. */
static bool take_step(const struct walking *w, struct walk_lane *lane,
                      bool *ended) {
  uint32_t end = lane->end;
  *ended = end == SEGMENT_GRAPH_NONE || !claim_segment(w, end >> 1);
  if (*ended)
    return true;
  lane->end = w->mate[end ^ 1];
  if (lane->end != SEGMENT_GRAPH_NONE) {
    MEM_PREFETCH(&w->used[lane->end >> 1]);
    MEM_PREFETCH(&w->mate[lane->end]);
  }
  return ARRAY_PUSH(&lane->passed, end);
}

/* Keeps what a walk has passed. */
static bool end_walk(struct walk_lane *lane, struct open_ends *ends,
                     uint32_t worker) {
  struct open_walk *walk = lane->walk;
  walk->worker = worker;
  walk->first = (uint32_t)ends->end.count;
  walk->count = (uint32_t)lane->passed.count;
  walk->next = lane->end;
  lane->walk = NULL;
  if (!ARRAY_RESERVE(&ends->end, walk->count))
    return false;
  if (walk->count > 0)
    memcpy(ends->end.item + walk->first, lane->passed.item,
           walk->count * sizeof *ends->end.item);
  ends->end.count += walk->count;
  return true;
}

static bool walk_range(void *user, struct parallel_range range) {
  const struct walking *w = user;
  struct open_ends *ends = &w->paths->worker[range.worker];
  struct walk_lane lane[LANES] = {{.walk = NULL}};
  size_t begun = range.begin, steps = 1;
  bool ok = true;
  for (bool active = true; ok && active;) {
    active = false;
    for (int i = 0; ok && i < LANES; i++) {
      bool ended = false;
      if (lane[i].walk == NULL && begun < range.end)
        begin_walk(&lane[i], &w->paths->walk.item[begun++]);
      if (lane[i].walk == NULL)
        continue;
      active = true;
      ok = poll_at(steps++) && take_step(w, &lane[i], &ended);
      if (ok && ended)
        ok = end_walk(&lane[i], ends, (uint32_t)range.worker);
    }
  }
  for (int i = 0; i < LANES; i++)
    ARRAY_FREE(&lane[i].passed);
  return ok;
}

/* ---- 3 Unite ------------------------------------------------------------- */

static const uint32_t *ends_of_walk(const struct open_paths *paths,
                                    const struct open_walk *walk) {
  return paths->worker[walk->worker].end.item + walk->first;
}

static uint32_t last_end(const struct open_paths *paths,
                         const struct open_walk *walk) {
  return ends_of_walk(paths, walk)[walk->count - 1];
}

/* The walk from the other open end, where this one has met it, or where one of
 * the two has passed all. */
static const struct open_walk *find_other(const struct open_paths *paths,
                                          const uint32_t *mate,
                                          const struct open_walk *walk) {
  if (walk->count == 0)
    return &paths->walk.item[mate[walk->open]];
  return walk->next != SEGMENT_GRAPH_NONE
             ? &paths->walk.item[mate[walk->next ^ 1]]
             : NULL;
}

static bool unite_walks(struct open_paths *paths, uint32_t *mate) {
  size_t count = paths->walk.count;
  const struct open_walk *walk = paths->walk.item;
  for (uint32_t i = 0; i < count; i++) {
    if (!poll_at(i))
      return false;
    if (walk[i].count > 0) {
      uint32_t last = last_end(paths, &walk[i]);
      mate[walk[i].next == SEGMENT_GRAPH_NONE ? last ^ 1 : last] = i;
    }
  }
  if (!ARRAY_RESERVE(&paths->path, count / 2))
    return false;
  for (uint32_t i = 0; i < count; i++) {
    const struct open_walk *one = &walk[i],
                           *other = find_other(paths, mate, one);
    uint32_t far = other != NULL ? other->open : last_end(paths, one) ^ 1;
    struct open_path path = {one, other, one->count + 1};
    if (other != NULL)
      path.count += other->count;
    if (one->open < far && !ARRAY_PUSH(&paths->path, path))
      return false;
  }
  return true;
}

/* ---- All ----------------------------------------------------------------- */

bool open_paths_follow(struct open_paths *paths, uint32_t *mate,
                       atomic_uchar *used, size_t count) {
  if (!list_open_ends(paths, mate, count))
    return false;
  paths->workers = parallel_workers(paths->walk.count, WALKS_IN_RANGE);
  paths->worker = mem_calloc((size_t)paths->workers, sizeof *paths->worker);
  struct walking walking = {paths, mate, used, paths->workers > 1};
  bool ok = paths->worker != NULL &&
            parallel_ranges(paths->workers, paths->walk.count, WALKS_IN_RANGE,
                            walk_range, &walking);
  for (int i = 0; ok && i < paths->workers; i++)
    ARRAY_TRIM(&paths->worker[i].end);
  return ok && unite_walks(paths, mate);
}

void open_paths_store(const struct open_paths *paths,
                      const struct open_path *path, uint32_t *end) {
  const struct open_walk *walk = path->walk, *other = path->other;
  if (walk->count > 0) {
    memcpy(end, ends_of_walk(paths, walk), walk->count * sizeof *end);
    end += walk->count;
    *end = end[-1] ^ 1;
  }
  if (other == NULL || other->count == 0)
    return;
  const uint32_t *passed = ends_of_walk(paths, other);
  for (uint32_t i = other->count; i-- > 0;)
    *end++ = passed[i] ^ 1;
  *end = passed[0];
}

void open_paths_fini(struct open_paths *paths) {
  for (int i = 0; paths->worker != NULL && i < paths->workers; i++)
    ARRAY_FREE(&paths->worker[i].end);
  mem_free(paths->worker);
  ARRAY_FREE(&paths->walk);
  ARRAY_FREE(&paths->path);
}
