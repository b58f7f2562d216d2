/* overlap_collinear.c - finds collinear segments that overlap and resolves
 * them.
 *
 * Phases
 *   1 duplicates  of segments between the same two nodes, which are
 *                 consecutive, the best is kept
 *   2 search      if two segments overlap otherwise, an end of one is inside
 *                 the other, so each segment visits the nodes along it, row by
 *                 row, by ranges of segments; a segment that starts there and
 *                 overlaps it joins its cluster
 *   3 resolve     each cluster is replaced by disjoint pieces (overlap.c)
 *   4 rebuild     the segments
 * Cost  On a mesh without overlaps phase 2 takes nearly all of the time. */
#include "base/parallel.h"
#include "base/poll.h"
#include "ink/lines/segment_graph.h"

#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/lines/nodes_near_segment.h"
#include "ink/lines/overlap.h"

struct overlap_pair {
  uint32_t segment, other;
};

/* What a range of segments finds. */
struct overlap_search {
  const struct overlap_finder *finder;
  ARRAY(struct overlap_pair) pair; /* in order of the first */
};

struct overlap_finder {
  struct segment_graph *graph;
  const struct node_rows *rows;
  struct overlap_search *search; /* one a range */
  uint8_t *dropped;              /* one a segment: removed or replaced */
  size_t dropped_count;
  /* Union-find of clusters: the parent's number plus one; 0: a root.  So the
   * pages of segments without overlaps are never touched. */
  uint32_t *parent;
  ARRAY(uint32_t) member; /* segments of clusters, with repetitions */
};

/* ---- 1 Duplicates -------------------------------------------------------- */

static void drop_duplicate_runs(struct overlap_finder *w) {
  const struct graph_segment *s = w->graph->segment.item;
  uint32_t best = 0;
  for (uint32_t i = 1; i < w->graph->segment.count; i++) {
    bool same_nodes =
        s[i].node[0] == s[best].node[0] && s[i].node[1] == s[best].node[1];
    bool better = !same_nodes || overlap_priority(w->graph, i) <
                                     overlap_priority(w->graph, best);
    if (same_nodes) {
      w->dropped[better ? best : i] = 1;
      w->dropped_count++;
    }
    if (better)
      best = i;
  }
}

/* ---- 2 Search ------------------------------------------------------------ */

static uint32_t root_of(uint32_t *parent, uint32_t segment) {
  while (parent[segment]) {
    uint32_t up = parent[segment] - 1;
    if (parent[up])
      parent[segment] = parent[up];
    segment = up;
  }
  return segment;
}

static bool join_clusters(struct overlap_finder *w, uint32_t a, uint32_t b) {
  uint32_t ra = root_of(w->parent, a), rb = root_of(w->parent, b);
  if (ra == rb)
    return true;
  /* The lower root is kept, so that the root of a cluster is its first member.
   * */
  w->parent[ra < rb ? rb : ra] = (ra < rb ? ra : rb) + 1;
  return ARRAY_PUSH(&w->member, a) && ARRAY_PUSH(&w->member, b);
}

/* Node k is near the segment's line: finds the overlapping segments there. */
static bool test_overlap(void *user, uint32_t segment, uint32_t k) {
  struct overlap_search *search = user;
  const struct overlap_finder *w = search->finder;
  const struct segment_graph *graph = w->graph;
  for (uint32_t i = graph->ends.start[k]; i < graph->ends.start[k + 1]; i++) {
    struct overlap_pair pair = {segment, graph->ends.item[i] >> 1};
    if (!w->dropped[pair.other] &&
        overlap_is_along(graph, segment, pair.other) &&
        !ARRAY_PUSH(&search->pair, pair))
      return false;
  }
  return true;
}

/* Finds the pairs of a range of segments. */
static bool search_pairs_of_range(void *user, struct parallel_range range) {
  const struct overlap_finder *w = user;
  const struct segment_graph *graph = w->graph;
  struct overlap_search *own = &w->search[range.begin / PARALLEL_ITEMS];
  const struct node_search search = {graph, w->rows, TOLERANCE_COINCIDENT_UNITS,
                                     test_overlap, own};
  own->finder = w;
  for (size_t i = range.begin; i < range.end; i++)
    if (!w->dropped[i] && (graph->has_near == NULL || graph->has_near[i]) &&
        !nodes_near_segment_visit(&search, (uint32_t)i))
      return false;
  return true;
}

/* Finds the clusters of segments that overlap. */
static bool find_clusters(struct overlap_finder *w) {
  size_t count = w->graph->segment.count,
         ranges = parallel_range_count(count, PARALLEL_ITEMS);
  w->search = mem_calloc(ranges, sizeof *w->search);
  bool ok = w->search != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, search_pairs_of_range, w);
  for (size_t r = 0; w->search != NULL && r < ranges; r++) {
    struct overlap_search *search = &w->search[r];
    for (size_t i = 0; ok && i < search->pair.count; i++)
      ok = join_clusters(w, search->pair.item[i].segment,
                         search->pair.item[i].other);
    ARRAY_FREE(&search->pair);
  }
  mem_free(w->search);
  return ok;
}

/* ---- 3 Resolve ----------------------------------------------------------- */

/* Sorts the members by cluster and removes repetitions. */
static bool gather_members(struct overlap_finder *w) {
  size_t count = w->member.count;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  for (size_t i = 0; key != NULL && i < count; i++) {
    uint32_t segment = w->member.item[i];
    uint64_t root = root_of(w->parent, segment);
    key[i] = (struct sort_key){root << 32 | segment, segment};
  }
  bool ok = key != NULL && sort_keys_unique(key, &count);
  for (size_t i = 0; ok && i < count; i++)
    w->member.item[i] = key[i].value;
  w->member.count = count;
  mem_free(key);
  return ok;
}

static bool resolve_clusters(struct overlap_finder *w,
                             struct overlap *overlap) {
  const uint32_t *member = w->member.item;
  for (size_t i = 0, end, n = 0; i < w->member.count; i = end, n++) {
    uint32_t root = root_of(w->parent, member[i]);
    for (end = i;
         end < w->member.count && root_of(w->parent, member[end]) == root;
         end++) {
      w->dropped[member[end]] = 1;
      w->dropped_count++;
    }
    if (!poll_at(n) || !overlap_resolve(overlap, w->graph, member + i, end - i))
      return false;
  }
  return true;
}

/* ---- 4 Rebuild ----------------------------------------------------------- */

static void remove_dropped(struct overlap_finder *w) {
  struct segment_graph *graph = w->graph;
  size_t kept = 0;
  for (size_t i = 0; i < graph->segment.count; i++)
    if (!w->dropped[i])
      graph->segment.item[kept++] = graph->segment.item[i];
  graph->segment.count = kept;
}

static bool add_pieces_of_segments(struct segment_graph *graph,
                                   const struct overlap *overlap) {
  for (size_t i = 0; i < overlap->piece.count; i++)
    if (!ARRAY_PUSH(&graph->segment, overlap->piece.item[i]))
      return false;
  return segment_graph_sort_segments(graph);
}

static bool replace_clusters(struct overlap_finder *w) {
  struct overlap overlap;
  bool ok = overlap_init(&overlap, w->member.count) && gather_members(w) &&
            resolve_clusters(w, &overlap);
  if (ok) {
    remove_dropped(w);
    ok = add_pieces_of_segments(w->graph, &overlap);
  }
  overlap_fini(&overlap);
  return ok;
}

recto_status segment_graph_drop_collinear(struct segment_graph *graph,
                                          const struct node_rows *rows,
                                          recto_error *error) {
  size_t count = graph->segment.count;
  struct overlap_finder w = {.graph = graph, .rows = rows};
  recto_status status = segment_graph_index_ends(graph, error);
  if (status != RECTO_OK)
    return status;
  w.dropped = mem_calloc(count, sizeof *w.dropped);
  w.parent = mem_calloc(count, sizeof *w.parent);
  bool ok = w.dropped != NULL && w.parent != NULL;
  if (ok)
    drop_duplicate_runs(&w);
  ok = ok && find_clusters(&w);
  if (ok && w.member.count)
    ok = replace_clusters(&w);
  else if (ok && w.dropped_count)
    remove_dropped(&w);
  graph->doubled += w.dropped_count;
  mem_free(graph->has_near);
  graph->has_near = NULL;
  mem_free(w.dropped);
  mem_free(w.parent);
  ARRAY_FREE(&w.member);
  if (!ok)
    return error_memory(error);
  return w.dropped_count ? segment_graph_index_ends(graph, error) : RECTO_OK;
}
