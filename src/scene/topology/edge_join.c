/* edge_join.c - finds the edges of ranges of faces at once, and joins them.
 *
 * Phases
 *   find    a thread finds the edges of a range alone (edge_range.c), in its
 *           part of an array of all.
 *   share   points that several ranges have edges at are looked for, and edges
 *           there in the earlier ranges, to which they belong: these get their
 *           faces.
 *   move    the other edges of a range are moved to those before, in order.
 * Memory  edges are moved within the array, by a little, so that little is
 *         written to that was not touched before.  Where a range has more than
 *         there is room for, the edges of all are copied to another array. */
#include "scene/topology/edge_join.h"

#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "scene/topology/edge_range.h"
#include "scene/topology/side_iterator.h"

/* Ranges are looked up in all those before them: more would cost more. */
enum { RANGES_MAX = 8 };

/* Points that are looked at together, so that their edges are fetched while
 * others are. */
enum { POINTS_AT_ONCE = 32 };

/* The edges of a range that earlier ones have too. */
struct shared_edges {
  uint32_t *edge; /* ascending; the second face of each, which is not needed
                     any more, was replaced by its number among all */
  size_t count;
  uint32_t first; /* the number among all of the first edge that no earlier
                     range has; the others of the range follow */
};

struct edge_join {
  struct edge_range *all;   /* its edges are the array of all ranges, */
  struct topology_edge *to; /* and become these */
  size_t ranges;
  struct edge_range range[RANGES_MAX];
  struct shared_edges shared[RANGES_MAX];
  size_t at;             /* the range that is joined to those before it */
  atomic_ullong *marked; /* a bit an edge of it: it is shared */
  atomic_size_t several; /* edges of all that more than one face has */
  size_t from;           /* the first edge of it that is not moved yet */
  uint32_t *number; /* one an edge of it: its number among all; only where sides
                       refer to edges */
};

/* ---- Ranges -------------------------------------------------------------- */

static bool find_edges_at(void *user, struct parallel_range at) {
  struct edge_join *join = user;
  struct edge_range *range = &join->range[at.begin];
  return edge_range_find(range, false) && !range->overfull;
}

static void set_ranges(struct edge_join *join) {
  const struct edge_range *all = join->all;
  for (size_t r = 0; r < join->ranges; r++)
    join->range[r] = (struct edge_range){
        .scene = all->scene,
        .weld = all->weld,
        .corner_edge = all->corner_edge,
        .face = (uint32_t)((uint64_t)all->end_face * r / join->ranges),
        .end_face =
            (uint32_t)((uint64_t)all->end_face * (r + 1) / join->ranges),
    };
}

/* Gives each range a part of one array, as only what gets edges is touched: for
 * half as many edges as corners, as closed surfaces have, for some more, and
 * for as many as are numbered at once.  Between two parts lies some more, which
 * none of them uses: so edges after a full part are moved too, and many in each
 * round (move_edges). */
static bool place_edge_ranges(struct edge_join *join) {
  struct edge_range *all = join->all;
  size_t room[RANGES_MAX], sum = 0;
  for (size_t r = 0; r < join->ranges; r++) {
    size_t corners = edge_range_corners(&join->range[r]);
    room[r] = corners / 2 + corners / 16 + POLL_ITEMS;
    sum += room[r] + POLL_ITEMS;
  }
  if (!ARRAY_RESERVE(&all->edge, sum))
    return false;
  for (size_t r = join->ranges; r-- > 0;) {
    struct edge_range *range = &join->range[r];
    sum -= room[r] + POLL_ITEMS;
    range->edge.item = all->edge.item + sum;
    range->edge.capacity = room[r];
    range->is_placed = true;
  }
  return true;
}

/* ---- Shared edges -------------------------------------------------------- */

/* How many of the shared edges of a range are before this one. */
static size_t shared_before(const struct shared_edges *shared, size_t edge) {
  size_t k;
  LOWER_BOUND(k, 0, shared->count, shared->edge[k] < edge);
  return k;
}

/* Whether the first face of an edge runs along it from its lower point to its
 * upper one, where it first does. */
static bool first_goes_up(const struct edge_range *range,
                          const struct topology_edge *edge) {
  struct side_iterator it =
      iterate_sides(range->scene, range->weld, edge->first, edge->first + 1);
  while (next_side(&it) &&
         (lower_end(&it) != edge->point[0] || upper_end(&it) != edge->point[1]))
    ;
  return it.from < it.to;
}

/* Adds the faces of an edge to those of the same edge of an earlier range;
 * returns whether these were one. */
static bool add_uses(const struct edge_range *range,
                     const struct topology_edge *edge,
                     struct topology_edge *to) {
  bool forward = edge->uses == 1 ? edge->same_way : first_goes_up(range, edge);
  bool was_one = topology_use_edge(to, edge->first, forward);
  if (edge->uses > 1)
    to->uses = 3;
  return was_one;
}

/* Adds the faces of an edge to those of an earlier range that has it; returns
 * its number among all, SCENE_NONE: no range has it.
 * several  gets how many more edges several faces have, modulo 2^64 */
static uint32_t share_edge(const struct edge_join *join,
                           const struct topology_edge *edge, size_t *several) {
  for (size_t r = 0; r < join->at; r++) {
    const struct shared_edges *shared = &join->shared[r];
    uint32_t found = edge_range_look_up(&join->range[r], edge->point);
    if (found != SCENE_NONE) { /* no range before this one has it */
      *several += add_uses(&join->range[join->at], edge,
                           &join->range[r].edge.item[found]);
      *several -= edge->uses > 1;
      return shared->first + found - (uint32_t)shared_before(shared, found);
    }
  }
  return SCENE_NONE;
}

/* Marks which edges of the range at their lower point are shared, and adds
 * their faces to the earlier ones. */
static void mark_shared_at(const struct edge_join *join, uint32_t point,
                           size_t *several) {
  const struct edge_range *range = &join->range[join->at];
  for (uint32_t e = range->head[point]; e != SCENE_NONE; e = range->next[e]) {
    struct topology_edge *edge = &range->edge.item[e];
    uint32_t found = share_edge(join, edge, several);
    if (found == SCENE_NONE)
      continue;
    edge->second = found & TOPOLOGY_NONE;
    atomic_fetch_or_explicit(&join->marked[e / 64], 1ULL << e % 64,
                             memory_order_relaxed);
  }
}

/* Finds at which of some points both the range and an earlier one have edges,
 * in vectors where it is known how many points there are.  Numbers of edges
 * have 31 bits (limit.h), so that SCENE_NONE alone has the uppermost one.
 * absent  one a point: its uppermost bit tells that they have not
 * Returns whether there is any. */
static inline bool find_common_points(const struct edge_join *join,
                                      size_t first, size_t points,
                                      uint32_t *absent) {
  const uint32_t *head = join->range[0].head + first;
  uint32_t any = SCENE_NONE;
  for (size_t k = 0; k < points; k++)
    absent[k] = head[k];
  for (size_t r = 1; r < join->at; r++)
    for (size_t k = 0; k < points; k++)
      absent[k] &= join->range[r].head[first + k];
  head = join->range[join->at].head + first;
  for (size_t k = 0; k < points; k++) {
    absent[k] |= head[k];
    any &= absent[k];
  }
  return any >> 31 == 0;
}

/* Lists the points that both the range and an earlier one have edges at. */
static size_t list_common_points(const struct edge_join *join,
                                 struct parallel_range points,
                                 uint32_t *point) {
  uint32_t absent[POINTS_AT_ONCE];
  size_t count = 0;
  for (size_t p = points.begin; p < points.end; p += POINTS_AT_ONCE) {
    size_t left = points.end - p;
    bool any = left >= POINTS_AT_ONCE
                   ? find_common_points(join, p, POINTS_AT_ONCE, absent)
                   : find_common_points(join, p, left, absent);
    for (size_t k = 0; any && k < left && k < POINTS_AT_ONCE; k++) {
      point[count] = (uint32_t)(p + k);
      count += 1 - (absent[k] >> 31);
    }
  }
  return count;
}

/* Fetches all edges of some points, the next one of each once the one before it
 * is there. */
static void fetch_edges(const struct edge_range *range, const uint32_t *point,
                        size_t points) {
  uint32_t edge[POINTS_AT_ONCE];
  size_t left = 0;
  for (size_t i = 0; i < points; i++) {
    edge[left] = range->head[point[i]];
    left += edge[left] != SCENE_NONE;
  }
  while (left > 0) {
    size_t listed = left;
    for (size_t i = 0; i < listed; i++) {
      MEM_PREFETCH(&range->edge.item[edge[i]]);
      MEM_PREFETCH(&range->next[edge[i]]);
    }
    left = 0;
    for (size_t i = 0; i < listed; i++) {
      edge[left] = range->next[edge[i]];
      left += edge[left] != SCENE_NONE;
    }
  }
}

static bool mark_shared_of_points(void *user, struct parallel_range points) {
  struct edge_join *join = user;
  uint32_t point[PARALLEL_ITEMS];
  size_t count = list_common_points(join, points, point), several = 0;
  for (size_t i = 0; i < count; i += POINTS_AT_ONCE) {
    size_t some = count - i < POINTS_AT_ONCE ? count - i : POINTS_AT_ONCE;
    for (size_t r = 0; r <= join->at; r++)
      fetch_edges(&join->range[r], point + i, some);
    for (size_t k = 0; k < some; k++)
      mark_shared_at(join, point[i + k], &several);
  }
  atomic_fetch_add(&join->several, several);
  return true;
}

/* Lists the edges that are marked. */
static bool list_shared_edges(const struct edge_join *join, size_t words,
                              struct shared_edges *shared) {
  size_t count = 0;
  for (size_t w = 0; w < words; w++)
    count += (size_t)__builtin_popcountll(join->marked[w]);
  shared->edge = mem_alloc(count, sizeof *shared->edge);
  for (size_t w = 0; shared->edge != NULL && w < words; w++)
    for (uint64_t left = join->marked[w]; left; left &= left - 1)
      shared->edge[shared->count++] =
          (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
  return shared->edge != NULL;
}

/* Finds the edges of the range that earlier ones have. */
static bool find_shared_of_range(struct edge_join *join, int workers) {
  const struct edge_range *range = &join->range[join->at];
  size_t words = range->edge.count / 64 + 1;
  join->marked = mem_calloc(words, sizeof *join->marked);
  bool ok = join->marked != NULL &&
            parallel_ranges(workers, range->scene->point.count, PARALLEL_ITEMS,
                            mark_shared_of_points, join) &&
            list_shared_edges(join, words, &join->shared[join->at]);
  mem_free((void *)join->marked);
  join->marked = NULL;
  return ok;
}

/* Finds those of all ranges, and how many edges there are. */
static bool find_shared(struct edge_join *join, int workers) {
  bool ok = true;
  size_t edges = join->range[0].edge.count;
  atomic_init(&join->several, join->range[0].shared);
  for (size_t r = 1; ok && r < join->ranges; r++) {
    join->at = r;
    join->shared[r].first = (uint32_t)edges;
    ok = find_shared_of_range(join, workers);
    edges += join->range[r].edge.count - join->shared[r].count;
    atomic_fetch_add(&join->several, join->range[r].shared);
  }
  for (size_t r = 0; r < join->ranges; r++)
    edge_range_drop_lists(&join->range[r]);
  join->all->edge.count = edges;
  join->all->shared = atomic_load(&join->several);
  return ok;
}

/* ---- Moving -------------------------------------------------------------- */

/* Moves edges that no earlier range has, from this one of the range to before
 * another, to those of the topology, as numbers from `to` on. */
static void move_own_edges(const struct edge_join *join, size_t from,
                           size_t end, uint32_t to) {
  const struct topology_edge *edge = join->range[join->at].edge.item;
  if (from < end)
    memmove(&join->to[to], &edge[from], (end - from) * sizeof *edge);
  for (size_t e = from; join->number != NULL && e < end; e++)
    join->number[e] = to++;
}

static bool move_edges_of_range(void *user, struct parallel_range edges) {
  const struct edge_join *join = user;
  const struct shared_edges *shared = &join->shared[join->at];
  size_t end = join->from + edges.end, e = join->from + edges.begin;
  for (size_t k = shared_before(shared, e); e < end;) {
    bool any = k < shared->count && shared->edge[k] < end;
    size_t stop = any ? shared->edge[k] : end;
    move_own_edges(join, e, stop, shared->first + (uint32_t)(e - k));
    if (any && join->number != NULL)
      join->number[stop] = join->range[join->at].edge.item[stop].second;
    k += any;
    e = stop + any;
  }
  return true;
}

/* Moves the edges of the range, within the array in rounds of no more than are
 * moved by, so that what a round writes to holds nothing that is not moved
 * yet. */
static bool move_edges(struct edge_join *join) {
  const struct edge_range *range = &join->range[join->at];
  size_t edges = range->edge.count, by = edges;
  bool ok = true;
  if (join->to == join->all->edge.item)
    by = (size_t)(range->edge.item - join->to) - join->shared[join->at].first;
  for (join->from = 0; ok && by > 0 && join->from < edges; join->from += by) {
    size_t left = edges - join->from, count = left < by ? left : by;
    ok = parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, move_edges_of_range, join);
  }
  return ok;
}

/* Lets the sides of a range refer to the edges of the topology. */
static bool renumber_sides(void *user, struct parallel_range corners) {
  struct edge_join *join = user;
  const struct edge_range *range = &join->range[join->at];
  uint32_t *edge =
      range->corner_edge + scene_face_start(range->scene, range->face);
  for (size_t c = corners.begin; c < corners.end; c++)
    edge[c] = join->number[edge[c]];
  return true;
}

/* Moves the edges of a range to those of the earlier ones. */
static bool join_range(struct edge_join *join, int workers) {
  const struct edge_range *range = &join->range[join->at];
  bool ok = true, sides = range->corner_edge != NULL && join->at > 0;
  if (sides)
    join->number = mem_alloc(range->edge.count, sizeof *join->number);
  ok = (!sides || join->number != NULL) && move_edges(join) &&
       (!sides || parallel_ranges(workers, edge_range_corners(range),
                                  PARALLEL_ITEMS, renumber_sides, join));
  mem_free(join->number);
  join->number = NULL;
  return ok;
}

/* Lets edges be moved within the array of all ranges where each has its edges
 * there, else to another one. */
static bool choose_array(struct edge_join *join) {
  struct edge_range *all = join->all;
  size_t placed = 0;
  for (size_t r = 0; r < join->ranges; r++)
    placed += join->range[r].is_placed;
  if (placed == 0) {
    mem_free(all->edge.item);
    all->edge.item = NULL;
  }
  join->to = placed == join->ranges
                 ? all->edge.item
                 : mem_alloc(all->edge.count, sizeof *join->to);
  return join->to != NULL;
}

/* Makes the edges of all ranges the topology's. */
static bool join_ranges(struct edge_join *join, int workers) {
  struct edge_range *all = join->all;
  bool ok = find_shared(join, workers) && choose_array(join);
  for (size_t r = 0; ok && r < join->ranges; r++) {
    join->at = r;
    ok = join_range(join, workers);
  }
  for (size_t r = 1; r < join->ranges; r++)
    mem_free(join->shared[r].edge);
  if (join->to != NULL && join->to != all->edge.item) {
    mem_free(all->edge.item);
    all->edge.item = join->to;
    all->edge.capacity = all->edge.count;
  }
  if (ok)
    ARRAY_TRIM(&all->edge);
  return ok;
}

/* ---- All ----------------------------------------------------------------- */

bool edge_join_find(struct edge_range *all, int workers) {
  struct edge_join join = {
      .all = all,
      .ranges = (size_t)(workers < RANGES_MAX ? workers : RANGES_MAX)};
  set_ranges(&join);
  bool ok = place_edge_ranges(&join) &&
            parallel_ranges(workers, join.ranges, 1, find_edges_at, &join) &&
            join_ranges(&join, workers);
  for (size_t r = 0; r < join.ranges; r++) {
    all->overfull |= join.range[r].overfull;
    edge_range_fini(&join.range[r]);
  }
  return ok;
}
