/* topology.c - finds the edges of a scene and the faces that meet there.
 *
 * Phases
 *   find  the faces are divided into ranges, one a thread, the edges of each
 *         are found alone (edge_range.c), and joined (edge_join.c): those that
 *         several ranges have belong to the first of these.
 *   weld  where points of border edges coincide (weld_equal.h), all is done
 *         again with those points made one.
 * Invariants  Edges stand in the order in which the file first uses them.
 * Memory      beside the result, 4 bytes a point and 4 an edge: sorting all
 *             sides took 8 a side more, and most of its time to touch them.
 *             Each range but the first takes 4 bytes a point more, a bit an
 *             edge, and 4 bytes for each that an earlier one has, too.
 */
#include "scene/topology/topology.h"

#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "scene/topology/edge_join.h"
#include "scene/topology/edge_range.h"
#include "scene/topology/repeated_part.h"
#include "scene/topology/weld_equal.h"

/* Finds the edges with the points as they are welded, in place of those that
 * are there, by so many workers; the borders are no more than it says.
 * with_hubs  whether points of many sides are looked for first, by one worker
 * overfull   gets whether there are too many edges at a point */
static bool find_edges(struct topology *topology, const struct scene *scene,
                       int workers, bool with_hubs, bool *overfull) {
  struct edge_range all = {.scene = scene,
                           .weld = topology->weld,
                           .corner_edge = topology->corner_edge,
                           .end_face = scene_face_count(scene),
                           .puts_corners_off = topology->puts_corners_off};
  ARRAY_FREE(&topology->edge);
  ARRAY_FREE(&topology->corner_copy);
  bool ok = workers > 1 ? edge_join_find(&all, workers)
                        : edge_range_find(&all, with_hubs) && !all.overfull;
  memcpy(&topology->edge, &all.edge, sizeof topology->edge);
  memset(&all.edge, 0, sizeof all.edge);
  memcpy(&topology->corner_copy, &all.corner_copy,
         sizeof topology->corner_copy);
  memset(&all.corner_copy, 0, sizeof all.corner_copy);
  topology->borders = topology->edge.count - all.shared;
  *overfull = all.overfull;
  edge_range_fini(&all);
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
  return (find_edges(topology, scene, workers, false, &overfull) ||
          (overfull && reserve_corners(topology, scene) &&
           find_edges(topology, scene, 1, true, &overfull))) &&
         find_borders(topology);
}

/* The points of border edges, as each worker has found them. */
struct border_marks {
  const struct topology *topology;
  size_t words;
  uint64_t *marked; /* a bit a point, for each worker */
};

/* Sets a bit for each point of a border edge. */
static bool mark_border_points(void *user, struct parallel_range edges) {
  const struct border_marks *points = user;
  const struct topology_edge *edge = points->topology->edge.item;
  uint64_t *marked = points->marked + (size_t)edges.worker * points->words;
  for (size_t w = edges.begin / 64; 64 * w < edges.end; w++)
    for (uint64_t left = points->topology->border[w]; left; left &= left - 1)
      for (int k = 0; k < 2; k++) {
        uint32_t p = edge[64 * w + (size_t)__builtin_ctzll(left)].point[k];
        marked[p / 64] |= UINT64_C(1) << p % 64;
      }
  return true;
}

/* Lists the points that are marked.  Returns false when memory ran out. */
static bool list_marked(const uint64_t *marked, size_t words, uint32_t **point,
                        size_t *count) {
  size_t listed = 0;
  *count = count_bits(marked, words);
  *point = mem_alloc(*count, sizeof **point);
  for (size_t w = 0; *point != NULL && w < words; w++)
    for (uint64_t left = marked[w]; left; left &= left - 1)
      (*point)[listed++] = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
  return *point != NULL;
}

bool topology_border_points(const struct topology *topology, size_t points,
                            uint32_t **point, size_t *count) {
  size_t words = points / 64 + 1;
  int workers = parallel_workers(topology->borders, EDGES_IN_RANGE);
  struct border_marks border = {
      topology, words,
      mem_calloc((size_t)workers * words, sizeof *border.marked)};
  *point = NULL;
  bool ok = border.marked != NULL &&
            parallel_ranges(workers, topology->edge.count, EDGES_IN_RANGE,
                            mark_border_points, &border);
  for (size_t w = words; ok && w < (size_t)workers * words; w++)
    border.marked[w % words] |= border.marked[w];
  ok = ok && list_marked(border.marked, words, point, count);
  mem_free(border.marked);
  return ok;
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
  mem_free(topology->features);
  mem_free(topology->coarse);
  mem_free(topology->crease_mark);
  mem_free(topology->direction);
  mem_free(topology->used);
  memset(topology, 0, sizeof *topology);
}
