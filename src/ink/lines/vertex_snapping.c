/* vertex_snapping.c - merges nodes that the output cannot distinguish.
 *
 * Phases
 *   1 cluster     in reading order, every node collects the nodes near it that
 *                 belong to no other: its cluster.  Nothing moves
 *   2 contract    the segments inside one large cluster whose ends are near
 *   3 duplicates  segments between the same two clusters are consecutive, best
 *                 first; one whose ends are near those of a better one is
 *                 removed
 * Invariant  A merge target never moves and a moved node is never a target, so
 *   each node moves at most once, and by at most one output step.
 * Cost  The segments kept between two clusters differ by at least a step at one
 *   end or the other, and a cluster is two steps wide, so they are few.
 *   Without this phase a thousand nested rings would be a million pairs for the
 *   next. */
#include "ink/lines/vertex_snapping.h"

#include <stdlib.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "ink/lines/overlap.h"

/* A cluster with this many further nodes or more is large: without contraction
 * the later search for overlaps would test a number of pairs that is quadratic
 * in the size of the cluster. */
enum { LARGE_CLUSTER_MIN = 16 };

bool vertex_snapping_init(struct vertex_snapping *snapping,
                          struct segment_graph *graph, int32_t output_step) {
  size_t nodes = graph->node.count;
  *snapping =
      (struct vertex_snapping){.graph = graph, .output_step = output_step};
  snapping->root = mem_alloc(nodes, sizeof *snapping->root);
  snapping->anchor = mem_calloc(nodes, sizeof *snapping->anchor);
  snapping->gone = mem_calloc(graph->segment.count, sizeof *snapping->gone);
  if (snapping->root == NULL || snapping->anchor == NULL ||
      snapping->gone == NULL)
    return false;
  for (uint32_t i = 0; i < nodes; i++)
    snapping->root[i] = i;
  return true;
}

void vertex_snapping_fini(struct vertex_snapping *snapping) {
  mem_free(snapping->root);
  mem_free(snapping->anchor);
  mem_free(snapping->gone);
}

bool vertex_snapping_is_near(const struct vertex_snapping *snapping, uint32_t a,
                             uint32_t b) {
  struct ink_point p = vertex_snapping_at(snapping, a),
                   q = vertex_snapping_at(snapping, b);
  return llabs((int64_t)p.x - q.x) <= snapping->output_step &&
         llabs((int64_t)p.y - q.y) <= snapping->output_step;
}

bool vertex_snapping_unite(struct vertex_snapping *snapping, uint32_t from,
                           uint32_t to) {
  uint32_t a = snapping->root[from], b = snapping->root[to];
  if (a == b)
    return true;
  if ((snapping->anchor[a] && snapping->anchor[b]) ||
      !vertex_snapping_is_near(snapping, a, b))
    return false;
  uint32_t moves = snapping->anchor[a] ? b : a,
           stays = snapping->anchor[a] ? a : b;
  snapping->root[moves] = stays;
  snapping->anchor[stays] = 1;
  return true;
}

/* ---- 1. Clusters --------------------------------------------------------- */

/* Adds to the cluster of node i the nodes near it in [k, end), a range of one
 * row in order of x, that are in no other cluster. */
static void add_near_nodes(const struct vertex_snapping *snapping,
                           uint32_t *cluster, uint32_t i, uint32_t k,
                           uint32_t end) {
  const struct ink_point *at = snapping->graph->node.item;
  int64_t x_max = (int64_t)at[i].x + snapping->output_step;
  for (; k < end && at[k].x <= x_max; k++)
    if (cluster[k] == k &&
        llabs((int64_t)at[k].y - at[i].y) <= snapping->output_step)
      cluster[k] = i;
}

/* Sets cluster[i] of every node to the node whose cluster it is in, which is i
 * itself for the first node of a cluster and for a node with none near. */
static void gather_clusters(const struct vertex_snapping *snapping,
                            uint32_t *cluster, const struct node_rows *rows) {
  const struct ink_point *at = snapping->graph->node.item;
  for (uint32_t i = 0; i < snapping->graph->node.count; i++)
    cluster[i] = i;
  for (uint32_t r = 0; r < rows->count; r++) {
    uint32_t end = rows->start[r + 1];
    for (uint32_t i = rows->start[r]; i < end; i++) {
      (void)poll_at(i);
      if (cluster[i] != i)
        continue;
      add_near_nodes(snapping, cluster, i, i + 1, end);
      for (uint32_t q = r + 1; at[i].y + snapping->output_step >= rows->low[q];
           q++) {
        uint32_t last = rows->start[q + 1];
        size_t k;
        LOWER_BOUND(k, rows->start[q], last,
                    at[k].x < at[i].x - snapping->output_step);
        add_near_nodes(snapping, cluster, i, (uint32_t)k, last);
      }
    }
  }
}

/* ---- 2. and 3. Contraction, duplicates ----------------------------------- */

static void remove_segment(struct vertex_snapping *snapping, uint32_t segment) {
  snapping->gone[segment] = 1;
  snapping->gone_count++;
}

/* Merges the ends of the worse segment into those of the better one, in
 * whichever orientation they are near.  Returns false if they are not near, or
 * if an end cannot be merged. */
static bool merge_duplicate(struct vertex_snapping *snapping, uint32_t better,
                            uint32_t worse) {
  const uint32_t *a = snapping->graph->segment.item[better].node;
  const uint32_t *b = snapping->graph->segment.item[worse].node;
  for (int reversed = 0; reversed < 2; reversed++) {
    uint32_t to[2] = {a[reversed], a[!reversed]};
    if (!vertex_snapping_is_near(snapping, b[0], to[0]) ||
        !vertex_snapping_is_near(snapping, b[1], to[1]))
      continue;
    snapping->graph->approximate[snapping->root[to[0]]] = 1;
    snapping->graph->approximate[snapping->root[to[1]]] = 1;
    return vertex_snapping_unite(snapping, b[0], to[0]) &&
           vertex_snapping_unite(snapping, b[1], to[1]);
  }
  return false;
}

/* Of segments between the same two clusters, best first, removes those that
 * duplicate a better one.
 * kept  scratch, one element a segment */
static void drop_duplicate_segments(struct vertex_snapping *snapping,
                                    const struct sort_key *pair, size_t count,
                                    uint32_t *kept) {
  size_t kept_count = 0;
  for (size_t i = 0; i < count; i++) {
    bool is_unique = true;
    for (size_t k = 0; is_unique && k < kept_count; k++)
      is_unique = !merge_duplicate(snapping, kept[k], pair[i].value);
    if (is_unique)
      kept[kept_count++] = pair[i].value;
    else
      remove_segment(snapping, pair[i].value);
  }
}

/* Contracts the segments inside large clusters, and lists the other segments
 * of which both ends are in clusters of two or more nodes, since only those can
 * have duplicates.  Returns how many it listed.
 * others  of each node that begins a cluster: how many further nodes the
 *         cluster has, at most LARGE_CLUSTER_MIN
 * pair    the list: the keys are the two clusters, the values segments */
static size_t list_possible_duplicates(struct vertex_snapping *snapping,
                                       const uint32_t *cluster,
                                       const uint8_t *others,
                                       struct sort_key *pair) {
  const struct segment_graph *graph = snapping->graph;
  size_t count = 0;
  for (uint32_t i = 0; i < graph->segment.count; i++) {
    const uint32_t *node = graph->segment.item[i].node;
    uint32_t a = cluster[node[0]], b = cluster[node[1]];
    (void)poll_at(i);
    if (!others[a] || !others[b])
      continue;
    bool is_large = others[a] == LARGE_CLUSTER_MIN;
    if (a == b && is_large &&
        vertex_snapping_is_near(snapping, node[0], node[1]) &&
        vertex_snapping_unite(snapping, node[1], node[0]))
      remove_segment(snapping, i);
    else if (a != b || is_large) /* a segment inside a small cluster is left to
                                    the search for overlaps */
      pair[count++] = (struct sort_key){sort_pair_key(a, b), i};
  }
  return count;
}

/* Sorts the list by the two clusters, and each group of equal keys by priority,
 * and removes the duplicates of each group. */
static void drop_all_duplicates(struct vertex_snapping *snapping,
                                struct sort_key *pair, struct sort_key *scratch,
                                size_t count, uint32_t *kept) {
  sort_keys(pair, scratch, count);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && pair[end].key == pair[i].key; end++)
      continue;
    if (end == i + 1)
      continue;
    for (size_t k = i; k < end; k++)
      pair[k].key = overlap_priority(snapping->graph, pair[k].value);
    sort_keys(pair + i, scratch + i, end - i);
    drop_duplicate_segments(snapping, pair + i, end - i, kept);
  }
}

bool vertex_snapping_drop_duplicates(struct vertex_snapping *snapping,
                                     const struct node_rows *rows) {
  size_t nodes = snapping->graph->node.count, count = 0;
  uint32_t *cluster = mem_alloc(nodes, sizeof *cluster);
  uint8_t *others = mem_calloc(nodes, sizeof *others);
  struct sort_key *pair = NULL, *scratch = NULL;
  uint32_t *kept = NULL;
  bool ok = cluster != NULL && others != NULL;
  if (ok && nodes > 0) {
    gather_clusters(snapping, cluster, rows);
    for (uint32_t i = 0; i < nodes; i++)
      if (cluster[i] != i) {
        others[cluster[i]] =
            (uint8_t)(others[cluster[i]] +
                      (others[cluster[i]] < LARGE_CLUSTER_MIN));
        count++;
      }
  }
  if (ok && count > 0) {
    count = snapping->graph->segment.count;
    pair = mem_alloc(count, sizeof *pair);
    scratch = mem_alloc(count, sizeof *scratch);
    kept = mem_alloc(count, sizeof *kept);
    ok = pair != NULL && scratch != NULL && kept != NULL;
  }
  if (ok && count > 0) {
    count = list_possible_duplicates(snapping, cluster, others, pair);
    drop_all_duplicates(snapping, pair, scratch, count, kept);
  }
  mem_free(cluster);
  mem_free(others);
  mem_free(pair);
  mem_free(scratch);
  mem_free(kept);
  return ok;
}
