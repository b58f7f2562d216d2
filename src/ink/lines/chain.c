/* chain.c - joins paired segments into polylines.
 *
 * Phases
 *   1 pair the ends at every node (pairing.c), which leaves simple paths and
 *          loops
 *   2 follow the paths between unpaired ends (open_paths.c)
 *   3 the segments not visited so far form loops
 *   4 orient every path, see paths_chain
 *   5 sort the paths by their first edges
 *   6 look up the points: not before, where every step would depend on a cache
 *     miss; independent look-ups overlap their misses */
#include "base/parallel.h"
#include "ink/lines/paths.h"

#include "base/sort.h"
#include "ink/lines/open_paths.h"
#include "ink/lines/pairing.h"

struct chain {
  const struct segment_graph *graph;
  struct ink_paths *paths;
  uint32_t *mate;
  atomic_uchar *used; /* one a segment */
  struct open_paths open;
  ARRAY(uint32_t) end; /* path by path, each point as one of the ends there */
  uint32_t *from;      /* one a path, sorted: the first of its ends */
  uint32_t *path_of_segment; /* the caller's, or NULL */
};

void paths_fini(struct ink_paths *paths) {
  ARRAY_FREE(&paths->point);
  ARRAY_FREE(&paths->path);
  mem_free(paths->approximate);
}

static uint32_t node_of_end(const struct chain *c, uint32_t end) {
  return c->graph->segment.item[end >> 1].node[end & 1];
}

static struct ink_point point_of_end(const struct chain *c, uint32_t end) {
  return c->graph->node.item[node_of_end(c, end)];
}

static bool is_lower(struct ink_point a, struct ink_point b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

static double squared_distance(struct ink_point a, struct ink_point b) {
  double dx = (double)a.x - b.x, dy = (double)a.y - b.y;
  return dx * dx + dy * dy;
}

static void reverse_ends(uint32_t *end, size_t count) {
  for (size_t i = 0; i < count / 2; i++) {
    uint32_t swap = end[i];
    end[i] = end[count - 1 - i];
    end[count - 1 - i] = swap;
  }
}

/* ---- Open paths ---------------------------------------------------------- */

/* Stores the ends of a range of open paths, which were added in their order, so
 * that each begins at the lower point. */
static bool store_range_of_paths(void *user, struct parallel_range range) {
  const struct chain *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &c->paths->path.item[i];
    uint32_t *end = c->end.item + path->point, last = path->count - 1;
    if (!poll_at(i))
      return false;
    open_paths_store(&c->open, &c->open.path.item[i], end);
    if (is_lower(point_of_end(c, end[last]), point_of_end(c, end[0])))
      reverse_ends(end, path->count);
    const struct graph_segment *s = &c->graph->segment.item[end[0] >> 1];
    path->edge = s->edge;
    path->hidden = graph_segment_is_hidden(s);
  }
  return true;
}

static bool follow_open_paths(struct chain *c) {
  if (!open_paths_follow(&c->open, c->mate, c->used, c->graph->segment.count))
    return false;
  size_t count = c->open.path.count, ends = 0;
  if (!ARRAY_RESERVE(&c->paths->path, count))
    return false;
  for (size_t i = 0; i < count; i++) {
    struct ink_path path = {.point = (uint32_t)ends,
                            .count = c->open.path.item[i].count};
    ends += path.count;
    c->paths->path.item[c->paths->path.count++] = path;
  }
  /* Loops have an end a segment, and paths one more. */
  if (!ARRAY_RESERVE(&c->end, c->graph->segment.count + count))
    return false;
  c->end.count = ends;
  bool ok = parallel_ranges(parallel_workers(count, PATHS_IN_RANGE), count,
                            PATHS_IN_RANGE, store_range_of_paths, c);
  open_paths_fini(&c->open);
  c->open = (struct open_paths){.worker = NULL};
  return ok;
}

/* ---- Loops --------------------------------------------------------------- */

/* Chooses the end at which a loop starts: see paths_chain. */
static size_t choose_path_start(const struct chain *c, const uint32_t *end,
                                size_t count) {
  struct ink_point lowest = point_of_end(c, end[0]);
  for (size_t i = 1; i < count; i++) {
    struct ink_point p = point_of_end(c, end[i]);
    if (is_lower(p, lowest))
      lowest = p;
  }
  size_t start = 0;
  struct ink_point best = lowest;
  double farthest = -1;
  for (size_t i = 0; i < count; i++) {
    struct ink_point p = point_of_end(c, end[i]);
    double d = squared_distance(p, lowest);
    if (d > farthest || (d == farthest && is_lower(p, best))) {
      farthest = d;
      best = p;
      start = i;
    }
  }
  return start;
}

/* Adds the loop of the ends from `from` on; its first segment is `first`. */
static bool add_loop_of_ends(struct chain *c, size_t from, uint32_t first) {
  const struct graph_segment *s = &c->graph->segment.item[first];
  struct ink_path path = {.point = (uint32_t)from,
                          .count = (uint32_t)(c->end.count - from),
                          .edge = s->edge,
                          .hidden = graph_segment_is_hidden(s),
                          .closed = true};
  return ARRAY_PUSH(&c->paths->path, path);
}

static bool follow_loop(struct chain *c, uint32_t end) {
  size_t from = c->end.count;
  uint32_t start = end;
  do {
    c->used[end >> 1] = 1;
    if (!ARRAY_PUSH(&c->end, end))
      return false;
    end = c->mate[end ^ 1];
  } while (end != start);
  uint32_t *loop = c->end.item + from;
  size_t count = c->end.count - from,
         corner = choose_path_start(c, loop, count);
  /* Rotates by three reversals: the loop begins at its corner. */
  reverse_ends(loop, corner);
  reverse_ends(loop + corner, count - corner);
  reverse_ends(loop, count);
  /* Towards the lower of the two neighbours.  Each end is the start of its
   * segment, so the first segment of the reversed loop is the last one's. */
  uint32_t first = loop[0] >> 1;
  if (is_lower(point_of_end(c, loop[count - 1]), point_of_end(c, loop[1]))) {
    first = loop[count - 1] >> 1;
    reverse_ends(loop + 1, count - 1);
  }
  return add_loop_of_ends(c, from, first);
}

static bool follow_all(struct chain *c) {
  size_t count = c->graph->segment.count;
  bool ok = follow_open_paths(c);
  for (size_t i = 0; ok && i < count; i++)
    ok = poll_at(i) && (c->used[i] != 0 || follow_loop(c, (uint32_t)(2 * i)));
  return ok;
}

/* ---- In order ------------------------------------------------------------ */

static bool sort_paths(struct ink_paths *paths) {
  size_t count = paths->path.count;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct ink_path *sorted = mem_alloc(count, sizeof *sorted);
  bool ok = key != NULL && sorted != NULL;
  for (size_t i = 0; ok && i < count; i++) {
    const struct ink_path *path = &paths->path.item[i];
    (void)poll_at(i);
    key[i].key = (uint64_t)path->hidden << 32 | path->edge;
    key[i].value = (uint32_t)i;
  }
  ok = ok && sort_keys_alone(key, count);
  if (ok) {
    for (size_t i = 0; i < count; i++) {
      (void)poll_at(i);
      sorted[i] = paths->path.item[key[i].value];
    }
    mem_free(paths->path.item);
    paths->path.item = sorted;
    paths->path.capacity = count;
    sorted = NULL;
  }
  mem_free(key);
  mem_free(sorted);
  return ok;
}

/* Fetches the ends of a path that comes later, and the first segment of one
 * that comes sooner. */
MEM_PREFETCH_INLINE void prefetch_path(const struct chain *c, size_t i) {
  enum { SOONER = MEM_PREFETCH_AHEAD / 2 };
  if (i + 2 * SOONER >= c->paths->path.count)
    return;
  MEM_PREFETCH(&c->end.item[c->from[i + 2 * SOONER]]);
  uint32_t end = c->end.item[c->from[i + SOONER]];
  MEM_PREFETCH(&c->graph->segment.item[end >> 1]);
}

/* Fetches the segment of an end that comes later, and the node of one that
 * comes sooner.
 * left  how many ends there are from this one on */
MEM_PREFETCH_INLINE void prefetch_node(const struct segment_graph *graph,
                                       const uint32_t *end, uint32_t left) {
  const struct graph_segment *segment = graph->segment.item;
  if (left > 2 * MEM_PREFETCH_AHEAD)
    MEM_PREFETCH(&segment[end[2 * MEM_PREFETCH_AHEAD] >> 1]);
  if (left <= MEM_PREFETCH_AHEAD)
    return;
  uint32_t later = end[MEM_PREFETCH_AHEAD];
  MEM_PREFETCH(&graph->node.item[segment[later >> 1].node[later & 1]]);
}

/* Gives the points of a path their positions, by the segments, which are
 * anywhere in memory. */
static void place_points_of_path(const struct chain *c, struct ink_path *path,
                                 const uint32_t *end) {
  const struct segment_graph graph = *c->graph;
  uint32_t count = path->count;
  struct ink_point *point = c->paths->point.item + path->point;
  uint8_t *approximate = c->paths->approximate;
  unsigned classes = 0;
  for (uint32_t k = 0; k < count; k++) {
    prefetch_node(&graph, end + k, count - k);
    const struct graph_segment *s = &graph.segment.item[end[k] >> 1];
    uint32_t node = s->node[end[k] & 1];
    point[k] = graph.node.item[node];
    classes |= s->style_key;
    if (approximate != NULL)
      approximate[path->point + k] = graph.approximate[node];
  }
  path->classes = (uint8_t)(classes & RECTO_EDGES_ALL);
  path->end[0] = end[0];
  path->end[1] = end[count - 1];
}

static bool place_points_of_range(void *user, struct parallel_range range) {
  const struct chain *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &c->paths->path.item[i];
    const uint32_t *end = c->end.item + c->from[i];
    if (!poll_at(i))
      return false;
    prefetch_path(c, i);
    place_points_of_path(c, path, end);
    for (uint32_t k = 0; c->path_of_segment != NULL && k < path->count; k++)
      c->path_of_segment[end[k] >> 1] = (uint32_t)i;
  }
  return true;
}

static bool place_points(struct chain *c) {
  struct ink_paths *paths = c->paths;
  size_t count = paths->path.count;
  c->from = mem_alloc(count, sizeof *c->from);
  if (c->from == NULL || !ARRAY_RESERVE(&paths->point, c->end.count))
    return false;
  if (c->graph->approximate != NULL) {
    paths->approximate = mem_alloc(c->end.count, sizeof *paths->approximate);
    if (paths->approximate == NULL)
      return false;
  }
  for (size_t i = 0; i < count; i++) {
    struct ink_path *path = &paths->path.item[i];
    c->from[i] = path->point;
    path->point = (uint32_t)paths->point.count;
    paths->point.count += path->count;
  }
  return parallel_ranges(parallel_workers(count, PATHS_IN_RANGE), count,
                         PATHS_IN_RANGE, place_points_of_range, c);
}

recto_status paths_chain(struct ink_paths *paths, uint32_t *path_of_segment,
                         const struct segment_graph *graph,
                         recto_error *error) {
  size_t count = graph->segment.count;
  struct chain c = {
      .graph = graph, .paths = paths, .path_of_segment = path_of_segment};
  c.mate = mem_alloc(count, 2 * sizeof *c.mate);
  c.used = mem_calloc(count, sizeof *c.used);
  bool ok = c.mate != NULL && c.used != NULL && pairing_find(c.mate, graph) &&
            follow_all(&c) && sort_paths(paths);
  /* Points need most of the memory here, and none of this. */
  mem_free(c.mate);
  mem_free(c.used);
  open_paths_fini(&c.open);
  ok = ok && place_points(&c);
  mem_free(c.from);
  ARRAY_FREE(&c.end);
  return ok ? RECTO_OK : error_memory(error);
}
