/* topology.c - finds the edges of a scene and the faces that meet there.
 *
 * Phases
 *   find  the faces are divided into ranges, one a thread, and the edges of
 *         each are found alone (edge_range.c).
 *   join  edges that several ranges have are made one: they belong to the first
 *         of these.  The others are numbered range by range.
 *   weld  where points of border edges coincide (weld_equal.h), all is done
 *         again with those points made one.
 * Invariants  Edges stand in the order in which the file first uses them.
 * Memory      beside the result, 4 bytes a point and 4 an edge: sorting all
 *             sides took 8 a side more, and most of its time to touch them.
 *             Each range but the first takes 4 bytes a point more, its edges
 *             again, and 4 bytes for each that an earlier one has, too.
 */
#include "scene/topology.h"

#include <string.h>

#include "base/number_filter.h"
#include "base/sort.h"
#include "scene/edge_range.h"
#include "scene/repeated_part.h"
#include "scene/side_iterator.h"
#include "scene/weld_equal.h"

/* ---- The edges of several ranges ----------------------------------------- */

/* Ranges are looked up in all those before them: more would cost more. */
enum { RANGES_MAX = 8 };

/* The edges of a range that earlier ones have too. */
struct shared_edges {
  uint32_t *edge; /* ascending; the second face of each, which is not needed
                     any more, was replaced by its number among all */
  size_t count;
  uint32_t first; /* the number among all of the first edge that no earlier
                     range has; the others of the range follow */
};

struct edge_join {
  struct topology *topology;
  size_t ranges;
  struct edge_range range[RANGES_MAX];
  struct shared_edges shared[RANGES_MAX];
  bool with_hubs;
  size_t at;        /* the range that is joined to those before it */
  uint32_t *number; /* one an edge of it: its number among all; only where sides
                       refer to edges */
};

static bool find_edges(void *user, struct parallel_range at) {
  struct edge_join *join = user;
  struct edge_range *range = &join->range[at.begin];
  return edge_range_find(range, join->with_hubs) && !range->overfull;
}

/* How many of the shared edges of a range are before this one. */
static size_t shared_before(const struct shared_edges *shared, size_t edge) {
  size_t k;
  LOWER_BOUND(k, 0, shared->count, shared->edge[k] < edge);
  return k;
}

/* The number of an edge in the earlier ranges; SCENE_NONE: they do not have
 * it. */
static uint32_t find_earlier_edge(const struct edge_join *join,
                                  const struct topology_edge *edge) {
  for (size_t r = 0; r < join->at; r++) {
    const struct shared_edges *shared = &join->shared[r];
    uint32_t found = edge_range_look_up(&join->range[r], edge->point);
    if (found != SCENE_NONE) /* no range before this one has it */
      return shared->first + found - (uint32_t)shared_before(shared, found);
  }
  return SCENE_NONE;
}

static size_t shared_of_range(const void *user, struct parallel_range edges,
                              uint32_t *kept) {
  const struct edge_join *join = user;
  struct topology_edge *edge = join->range[join->at].edge.item;
  size_t count = 0;
  for (size_t e = edges.begin; e < edges.end; e++) {
    uint32_t found = find_earlier_edge(join, &edge[e]);
    if (found == SCENE_NONE)
      continue;
    edge[e].second = found & TOPOLOGY_NONE;
    kept[count++] = (uint32_t)e;
  }
  return count;
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

/* Adds edges that no earlier range has, from this one of the range to before
 * another, to those of the topology, as numbers from `to` on. */
static void add_own_edges(const struct edge_join *join, size_t from, size_t end,
                          uint32_t to) {
  const struct topology_edge *edge = join->range[join->at].edge.item;
  if (from < end)
    memcpy(&join->topology->edge.item[to], &edge[from],
           (end - from) * sizeof *edge);
  for (size_t e = from; join->number != NULL && e < end; e++)
    join->number[e] = to++;
}

/* Adds the uses of an edge to those that it has in the topology. */
static void add_uses(const struct edge_join *join, size_t e) {
  const struct edge_range *range = &join->range[join->at];
  const struct topology_edge *edge = &range->edge.item[e];
  struct topology_edge *to = &join->topology->edge.item[edge->second];
  (void)topology_use_edge(to, edge->first, first_goes_up(range, edge));
  if (edge->uses > 1)
    to->uses = 3;
  if (join->number != NULL)
    join->number[e] = edge->second;
}

static bool add_joined_edges(void *user, struct parallel_range edges) {
  const struct edge_join *join = user;
  const struct shared_edges *shared = &join->shared[join->at];
  size_t k = shared_before(shared, edges.begin);
  for (size_t e = edges.begin; e < edges.end; e++) {
    bool any = k < shared->count && shared->edge[k] < edges.end;
    size_t stop = any ? shared->edge[k] : edges.end;
    add_own_edges(join, e, stop, shared->first + (uint32_t)(e - k));
    if (any)
      add_uses(join, shared->edge[k++]);
    e = stop;
  }
  return true;
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

/* Adds the edges of a range, whose shared ones are known, to the topology. */
static bool add_edges_of_range(struct edge_join *join, int workers) {
  const struct edge_range *range = &join->range[join->at];
  bool sides = range->corner_edge != NULL;
  size_t edges = range->edge.count, corners = edge_range_corners(range);
  if (sides) {
    join->number = mem_alloc(edges, sizeof *join->number);
    if (join->number == NULL)
      return false;
  }
  return parallel_ranges(workers, edges, PARALLEL_ITEMS, add_joined_edges,
                         join) &&
         (!sides || parallel_ranges(workers, corners, PARALLEL_ITEMS,
                                    renumber_sides, join));
}

/* Joins a range to the earlier ones. */
static bool join_range(struct edge_join *join, size_t at, int workers) {
  struct topology *topology = join->topology;
  struct shared_edges *shared = &join->shared[at];
  join->at = at;
  shared->edge = number_filter(join->range[at].edge.count, shared_of_range,
                               join, &shared->count);
  bool ok = shared->edge != NULL;
  /* Nothing is looked up after the last range was. */
  for (size_t r = 0; at + 1 == join->ranges && r < at; r++)
    edge_range_drop_lists(&join->range[r]);
  if (ok) {
    shared->first = (uint32_t)topology->edge.count;
    topology->edge.count += join->range[at].edge.count - shared->count;
    ok = add_edges_of_range(join, workers);
  }
  mem_free(join->number);
  join->number = NULL;
  return ok;
}

/* Makes the edges of all ranges the topology's. */
static bool join_ranges(struct edge_join *join, int workers) {
  struct topology *topology = join->topology;
  size_t more = 0;
  for (size_t r = 1; r < join->ranges; r++)
    more += join->range[r].edge.count;
  if (!ARRAY_RESERVE(&join->range[0].edge, more))
    return false;
  topology->edge.item = join->range[0].edge.item;
  topology->edge.count = join->range[0].edge.count;
  topology->edge.capacity = join->range[0].edge.capacity;
  edge_range_drop_lists(&join->range[join->ranges - 1]);
  bool ok = true;
  for (size_t r = 1; ok && r < join->ranges; r++)
    ok = join_range(join, r, workers);
  for (size_t r = 1; r < join->ranges; r++)
    mem_free(join->shared[r].edge);
  join->range[0].edge.item = NULL;
  return ok;
}

/* Takes over from the ranges what is not in the topology yet. */
static void finish_ranges(struct edge_join *join, bool *overfull) {
  struct topology *topology = join->topology;
  struct edge_range *first = &join->range[0];
  topology->borders = topology->edge.count - first->shared;
  if (join->ranges > 1)
    topology->borders = topology->edge.count;
  ARRAY_FREE(&topology->corner_copy); /* of ranges that were overfull */
  memcpy(&topology->corner_copy, &first->corner_copy,
         sizeof topology->corner_copy);
  memset(&first->corner_copy, 0, sizeof first->corner_copy);
  *overfull = false;
  for (size_t r = 0; r < join->ranges; r++) {
    *overfull |= join->range[r].overfull;
    edge_range_fini(&join->range[r]);
  }
}

/* Divides the faces into ranges, and finds the edges of each; the borders are
 * no more than it says.
 * overfull  gets whether one of them has too many at a point */
static bool find_in_ranges(struct topology *topology, const struct scene *scene,
                           int workers, bool with_hubs, bool *overfull) {
  struct edge_join join = {.topology = topology, .with_hubs = with_hubs};
  uint32_t faces = scene_face_count(scene);
  size_t ranges = (size_t)(workers < RANGES_MAX ? workers : RANGES_MAX);
  for (size_t r = 0; r < ranges; r++)
    join.range[r] = (struct edge_range){
        .scene = scene,
        .weld = topology->weld,
        .corner_edge = topology->corner_edge,
        .face = (uint32_t)((uint64_t)faces * r / ranges),
        .end_face = (uint32_t)((uint64_t)faces * (r + 1) / ranges),
        .puts_corners_off = topology->puts_corners_off && ranges == 1,
    };
  join.ranges = ranges;
  bool ok = parallel_ranges(workers, ranges, 1, find_edges, &join) &&
            join_ranges(&join, workers);
  finish_ranges(&join, overfull);
  return ok;
}

/* ---- Borders ------------------------------------------------------------- */

/* Edges that a thread takes at once: whole words of the map. */
enum { EDGES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

static bool map_borders(void *user, struct parallel_range edges) {
  struct topology *topology = user;
  const struct topology_edge *edge = topology->edge.item;
  for (size_t e = edges.begin; e < edges.end; e += 64) {
    size_t bits = edges.end - e < 64 ? edges.end - e : 64;
    uint64_t word = 0;
    unsigned all = 2; /* which is in 2 and 3 uses */
    for (size_t k = 0; k < bits; k++)
      all &= edge[e + k].uses;
    for (size_t k = 0; all == 0 && k < bits; k++)
      word |= (uint64_t)(edge[e + k].uses == 1) << k;
    topology->border[e / 64] = word;
  }
  return true;
}

static size_t count_bits(const uint64_t *word, size_t words) {
  size_t count = 0;
  for (size_t w = 0; w < words; w++)
    count += (size_t)__builtin_popcountll(word[w]);
  return count;
}

/* Finds the edges of one face in one pass, as several steps look at them; most
 * scenes are known to have none.  topology->borders is at least how many there
 * are, and then exactly that. */
static bool find_borders(struct topology *topology) {
  size_t edges = topology->edge.count, words = edges / 64 + 1;
  mem_free(topology->border);
  topology->border = mem_calloc(words, sizeof *topology->border);
  if (topology->border != NULL && topology->borders == 0)
    return true;
  if (topology->border == NULL ||
      !parallel_ranges(parallel_workers(edges, EDGES_IN_RANGE), edges,
                       EDGES_IN_RANGE, map_borders, topology))
    return false;
  topology->borders = count_bits(topology->border, words);
  return true;
}

uint32_t topology_next_border(const struct topology *topology, uint32_t edge) {
  size_t edges = topology->edge.count;
  if (edge >= edges)
    return (uint32_t)edges;
  size_t w = edge / 64, last = (edges - 1) / 64;
  uint64_t word = topology->border[w] & ~UINT64_C(0) << edge % 64;
  while (word == 0 && w < last)
    word = topology->border[++w];
  return word != 0 ? (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(word)
                   : (uint32_t)edges;
}

/* Makes room for corner_edge where there is none; false when memory ran out. */
static bool reserve_corners(struct topology *topology,
                            const struct scene *scene) {
  if (topology->corner_edge == NULL)
    topology->corner_edge =
        mem_alloc(scene->corner.count, sizeof *topology->corner_edge);
  return topology->corner_edge != NULL;
}

/* Builds the edges with the points as they are welded, and corner_edge where
 * there is room for it, or hubs need it. */
static bool build_edges(struct topology *topology, const struct scene *scene) {
  int workers = parallel_workers(scene_face_count(scene), PARALLEL_ITEMS);
  bool overfull;
  if (workers > 1 && topology->weld == NULL &&
      repeated_parts_fill(scene, workers))
    workers = 1;
  ARRAY_FREE(&topology->edge);
  ARRAY_FREE(&topology->corner_copy);
  return (find_in_ranges(topology, scene, workers, false, &overfull) ||
          (overfull && reserve_corners(topology, scene) &&
           find_in_ranges(topology, scene, 1, true, &overfull))) &&
         find_borders(topology);
}

/* Sets a bit for each point of a border edge. */
static void mark_border_points(const struct topology *topology,
                               uint64_t *marked) {
  const struct topology_edge *edge = topology->edge.item;
  for (size_t w = 0; 64 * w < topology->edge.count; w++)
    for (uint64_t left = topology->border[w]; left; left &= left - 1)
      for (int k = 0; k < 2; k++) {
        uint32_t p = edge[64 * w + (size_t)__builtin_ctzll(left)].point[k];
        marked[p / 64] |= UINT64_C(1) << p % 64;
      }
}

bool topology_border_points(const struct topology *topology, size_t points,
                            uint32_t **point, size_t *count) {
  size_t words = points / 64 + 1, listed = 0;
  uint64_t *marked = mem_calloc(words, sizeof *marked);
  *point = NULL;
  if (marked == NULL)
    return false;
  mark_border_points(topology, marked);
  *count = count_bits(marked, words);
  *point = mem_alloc(*count, sizeof **point);
  for (size_t w = 0; *point != NULL && w < words; w++)
    for (uint64_t left = marked[w]; left; left &= left - 1)
      (*point)[listed++] = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
  mem_free(marked);
  return *point != NULL;
}

/* Welds the points of border edges that coincide. */
static bool weld_border(struct topology *topology, const struct scene *scene) {
  uint32_t *point;
  size_t count;
  if (topology->borders == 0)
    return true;
  bool ok =
      topology_border_points(topology, scene->point.count, &point, &count) &&
      weld_equal(scene, point, count, &topology->weld);
  mem_free(point);
  return ok;
}

/* As topology_init_welded.
 * corners  whether corner_edge is wanted also where it can be left out */
static recto_status init_edges(struct topology *topology,
                               const struct scene *scene, bool corners,
                               recto_error *error) {
  bool leaves_out = !corners && scene->face_start.count == 0;
  memset(topology, 0, sizeof *topology);
  topology->puts_corners_off = !corners;
  if ((leaves_out || reserve_corners(topology, scene)) &&
      build_edges(topology, scene))
    return RECTO_OK;
  topology_fini(topology);
  return error_memory(error);
}

/* Welds the border of a scene whose edges were found, and finds them anew if
 * that changed them. */
static recto_status weld_edges(struct topology *topology,
                               const struct scene *scene, recto_error *error) {
  if (weld_border(topology, scene) &&
      (topology->weld == NULL ||
       (reserve_corners(topology, scene) && build_edges(topology, scene))))
    return RECTO_OK;
  topology_fini(topology);
  return error_memory(error);
}

recto_status topology_init_welded(struct topology *topology,
                                  const struct scene *scene,
                                  recto_error *error) {
  return init_edges(topology, scene, true, error);
}

recto_status topology_init(struct topology *topology, const struct scene *scene,
                           recto_error *error) {
  recto_status status = init_edges(topology, scene, true, error);
  return status == RECTO_OK ? weld_edges(topology, scene, error) : status;
}

recto_status topology_init_edges(struct topology *topology,
                                 const struct scene *scene,
                                 recto_error *error) {
  recto_status status = init_edges(topology, scene, false, error);
  return status == RECTO_OK ? weld_edges(topology, scene, error) : status;
}

void topology_drop_corners(struct topology *topology) {
  mem_free(topology->corner_edge);
  topology->corner_edge = NULL;
  ARRAY_FREE(&topology->corner_copy);
}

void topology_drop_directions(struct topology *topology) {
  mem_free(topology->direction);
  topology->direction = NULL;
}

void topology_fini(struct topology *topology) {
  ARRAY_FREE(&topology->edge);
  ARRAY_FREE(&topology->corner_copy);
  mem_free(topology->corner_edge);
  mem_free(topology->weld);
  mem_free(topology->border);
  mem_free(topology->class_masks);
  mem_free(topology->coarse);
  mem_free(topology->crease_mark);
  mem_free(topology->direction);
  mem_free(topology->used);
  memset(topology, 0, sizeof *topology);
}
