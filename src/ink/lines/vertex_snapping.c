/* vertex_snapping.c - merges nodes that the output cannot distinguish.
 *
 * Phases
 *   1 cluster     in reading order, every node collects the nodes near it that
 *                 belong to no other: its cluster.  Nothing moves
 *   2 contract    the segments inside one large cluster whose ends are near
 *   3 duplicates  segments between the same two clusters are consecutive, best
 *                 first; one whose ends are near those of a better one is
 *                 removed
 * In parallel  the search for nodes that later ones are near, as only these
 *   begin clusters, and for the segments of which both ends are in clusters.
 * Invariant  A merge target never moves and a moved node is never a target, so
 *   each node moves at most once, and by at most one output step.
 * Cost  The segments kept between two clusters differ by at least a step at one
 *   end or the other, and a cluster is two steps wide, so they are few.
 *   Without this phase a thousand nested rings would be a million pairs for the
 *   next. */
#include "ink/lines/vertex_snapping.h"

#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
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

/* Visits the nodes near node i in [k, end), a range of one row in order of x.
 * add  adds those that are in no other cluster to that of node i; else returns
 *      whether there are any */
static bool visit_near_nodes(struct node_clusters *clusters, uint32_t i,
                             uint32_t k, uint32_t end, bool add) {
  const struct ink_point *at = clusters->graph->node.item;
  int32_t step = clusters->step;
  int64_t x_max = (int64_t)at[i].x + step;
  for (; k < end && at[k].x <= x_max; k++) {
    if (llabs((int64_t)at[k].y - at[i].y) > step)
      continue;
    if (!add)
      return true;
    if (clusters->of_node[k] != k)
      continue;
    clusters->of_node[k] = i;
    if (clusters->others[i] < LARGE_CLUSTER_MIN)
      clusters->others[i]++;
    clusters->moved++;
  }
  return false;
}

/* The same of all nodes after node i, which is in row r. */
static bool visit_later_nodes(struct node_clusters *clusters, uint32_t r,
                              uint32_t i, bool add) {
  const struct node_rows *rows = clusters->rows;
  const struct ink_point *at = clusters->graph->node.item;
  int32_t step = clusters->step;
  if (visit_near_nodes(clusters, i, i + 1, rows->start[r + 1], add))
    return true;
  for (uint32_t q = r + 1; at[i].y + step >= rows->low[q]; q++) {
    uint32_t last = rows->start[q + 1];
    size_t k;
    LOWER_BOUND(k, rows->start[q], last, at[k].x < at[i].x - step);
    if (visit_near_nodes(clusters, i, (uint32_t)k, last, add))
      return true;
  }
  return false;
}

/* Sets others[i] of the nodes that later ones are near. */
static bool find_near_of_range(void *user, struct parallel_range range) {
  struct node_clusters *clusters = user;
  for (uint32_t i = (uint32_t)range.begin; i < range.end; i++) {
    clusters->of_node[i] = i;
    clusters->others[i] =
        visit_later_nodes(clusters, clusters->rows->row[i], i, false);
  }
  return true;
}

/* Returns false when the caller cancelled. */
static bool gather_clusters(struct node_clusters *clusters) {
  size_t count = clusters->graph->node.count;
  if (!parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, find_near_of_range, clusters))
    return false;
  for (uint32_t i = 0; i < count; i++) {
    bool may_begin = clusters->others[i] != 0;
    clusters->others[i] = 0;
    if (may_begin && clusters->of_node[i] == i)
      (void)visit_later_nodes(clusters, clusters->rows->row[i], i, true);
  }
  return true;
}

bool node_clusters_init(struct node_clusters *clusters,
                        const struct segment_graph *graph,
                        const struct node_rows *rows, int32_t step) {
  size_t nodes = graph->node.count;
  *clusters =
      (struct node_clusters){.graph = graph, .rows = rows, .step = step};
  clusters->of_node = mem_alloc(nodes, sizeof *clusters->of_node);
  clusters->others = mem_calloc(nodes, sizeof *clusters->others);
  return clusters->of_node != NULL && clusters->others != NULL &&
         (nodes == 0 || gather_clusters(clusters));
}

void node_clusters_fini(struct node_clusters *clusters) {
  mem_free(clusters->of_node);
  mem_free(clusters->others);
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

/* The segments of which both ends are in clusters of two or more nodes, since
 * only those can have duplicates. */
struct snapping_candidates {
  const struct node_clusters *clusters;
  struct sort_key *pair; /* one a segment: the values are segments */
  size_t *kept;          /* one a range */
};

static bool list_candidates_of_range(void *user, struct parallel_range range) {
  const struct snapping_candidates *candidates = user;
  const struct node_clusters *clusters = candidates->clusters;
  const struct graph_segment *s = clusters->graph->segment.item;
  size_t n = range.begin;
  for (size_t i = range.begin; i < range.end; i++)
    if (clusters->others[clusters->of_node[s[i].node[0]]] &&
        clusters->others[clusters->of_node[s[i].node[1]]])
      candidates->pair[n++].value = (uint32_t)i;
  candidates->kept[range.begin / PARALLEL_ITEMS] = n - range.begin;
  return true;
}

/* Lists these segments.  Returns false when memory ran out or the caller
 * cancelled. */
static bool list_snapping_candidates(const struct node_clusters *clusters,
                                     struct sort_key *pair, size_t *listed) {
  size_t count = clusters->graph->segment.count;
  struct snapping_candidates candidates = {
      clusters, pair,
      mem_calloc(parallel_range_count(count, PARALLEL_ITEMS),
                 sizeof *candidates.kept)};
  bool ok =
      candidates.kept != NULL &&
      parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                      PARALLEL_ITEMS, list_candidates_of_range, &candidates);
  if (ok)
    *listed = parallel_gather(pair, sizeof *pair, count, PARALLEL_ITEMS,
                              candidates.kept);
  mem_free(candidates.kept);
  return ok;
}

/* Of `count` segments that were listed, contracts those inside large clusters.
 * Returns how many others there are, first in the list.
 * pair  the list: the keys become the two clusters */
static size_t contract_clusters(struct vertex_snapping *snapping,
                                const struct node_clusters *clusters,
                                struct sort_key *pair, size_t count) {
  size_t kept = 0;
  for (size_t n = 0; n < count; n++) {
    uint32_t i = pair[n].value;
    const uint32_t *node = snapping->graph->segment.item[i].node;
    uint32_t a = clusters->of_node[node[0]], b = clusters->of_node[node[1]];
    (void)poll_at(n);
    bool is_large = clusters->others[a] == LARGE_CLUSTER_MIN;
    if (a == b && is_large &&
        vertex_snapping_is_near(snapping, node[0], node[1]) &&
        vertex_snapping_unite(snapping, node[1], node[0]))
      remove_segment(snapping, i);
    else if (a != b || is_large) /* a segment inside a small cluster is left to
                                    the search for overlaps */
      pair[kept++] = (struct sort_key){sort_pair_key(a, b), i};
  }
  return kept;
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
                                     const struct node_clusters *clusters) {
  size_t count = snapping->graph->segment.count;
  struct sort_key *pair = NULL, *scratch = NULL;
  uint32_t *kept = NULL;
  if (clusters->moved == 0)
    return true;
  pair = mem_alloc(count, sizeof *pair);
  bool ok = pair != NULL && list_snapping_candidates(clusters, pair, &count);
  if (ok && count > 0) {
    scratch = mem_alloc(count, sizeof *scratch);
    kept = mem_alloc(count, sizeof *kept);
    ok = scratch != NULL && kept != NULL;
  }
  if (ok && count > 0) {
    count = contract_clusters(snapping, clusters, pair, count);
    drop_all_duplicates(snapping, pair, scratch, count, kept);
  }
  mem_free(pair);
  mem_free(scratch);
  mem_free(kept);
  return ok;
}
