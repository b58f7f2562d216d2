/* overlap_output.c - draws once the lines that the output's rounding makes one.
 *
 * Two segments overlap as far as they are parallel within that precision: each
 * end of the overlap is near (vertex_snapping.h) the other segment, in x and in
 * y no farther than rounding both to the output could bring together.
 *
 * Phases
 *   1 duplicates  segments with near ends at both ends (vertex_snapping.c)
 *   2 pairs       every segment searches along its line and records which
 *                 others overlap it
 *   3 subtract    in order of priority a segment loses its overlap
 *                 with the pieces that are kept; the rest ends at nodes of
 *                 theirs
 *   4 rebuild     and repeat if anything has moved, as it may have come near
 *                 something else: where segments have changed since their pairs
 *                 were searched for (changed_cells.h)
 * Invariants  What is removed is within an output step of what is kept, not
 *   of something that is removed in turn.  A node moves by at most a step in a
 *   round, and only where a line is removed or contracted. */
#include "base/parallel.h"
#include "ink/lines/segment_graph.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/lines/changed_cells.h"
#include "ink/lines/nodes_near_segment.h"
#include "ink/lines/overlap.h"
#include "ink/lines/overlap_cover.h"
#include "ink/lines/vertex_snapping.h"

enum { SEGMENTS_IN_RANGE = PARALLEL_RANGE(1 << 10) };

/* The remaining pieces: those of the segment at index i by priority are
 * piece[start[i]] up to piece[start[i + 1]]. */
struct output_overlaps {
  struct vertex_snapping snapping;
  ARRAY(struct sort_key) pair;   /* worse segment << 32 | better one */
  ARRAY(struct sort_key) member; /* priority, segment: all in pairs */
  ARRAY(uint32_t) start;
  ARRAY(struct graph_segment) piece;
  ARRAY(struct overlap_cover) cover; /* of the current segment */
  size_t cut; /* number of segments that lost something */
  /* Where this round searches, or NULL: everywhere; where the next one does. */
  struct changed_cells *here, *next;
};

/* ---- 2 Pairs ------------------------------------------------------------- */

static bool is_better(const struct segment_graph *graph, uint32_t a,
                      uint32_t b) {
  uint64_t of_a = overlap_priority(graph, a), of_b = overlap_priority(graph, b);
  return of_a < of_b || (of_a == of_b && a < b);
}

/* The search of one worker. */
struct pair_search {
  const struct vertex_snapping *snapping;
  const struct changed_cells *here;
  const struct node_rows *rows;
  ARRAY(struct sort_key) pair; /* see output_overlaps */
  char apart[PARALLEL_APART];
};

static bool record_pairs(void *user, uint32_t segment, uint32_t node) {
  struct pair_search *search = user;
  const struct vertex_snapping *snapping = search->snapping;
  const struct segment_graph *graph = snapping->graph;
  const struct graph_segment *s = graph->segment.item;
  struct overlap_cover cover;
  for (uint32_t i = graph->ends.start[node]; i < graph->ends.start[node + 1];
       i++) {
    uint32_t other = graph->ends.item[i] >> 1;
    if (snapping->gone[other] ||
        !overlap_cover_find(snapping, s[segment].node, s[other].node, &cover))
      continue;
    bool better = is_better(graph, segment, other);
    uint32_t best = better ? segment : other, worst = better ? other : segment;
    struct sort_key pair = {(uint64_t)worst << 32 | best, 0};
    if (!ARRAY_PUSH(&search->pair, pair))
      return false;
  }
  return true;
}

static bool find_pairs_of_range(void *user, struct parallel_range range) {
  struct pair_search *search = (struct pair_search *)user + range.worker;
  const struct vertex_snapping *snapping = search->snapping;
  const struct node_search nodes = {snapping->graph, search->rows,
                                    snapping->output_step, record_pairs,
                                    search};
  for (size_t i = range.begin; i < range.end; i++)
    if (!snapping->gone[i] &&
        (search->here == NULL ||
         changed_cells_have(search->here, snapping->graph,
                            &snapping->graph->segment.item[i])) &&
        !nodes_near_segment_visit(&nodes, (uint32_t)i))
      return false;
  return true;
}

static bool has_moved(const struct vertex_snapping *snapping,
                      const struct graph_segment *s) {
  return snapping->root[s->node[0]] != s->node[0] ||
         snapping->root[s->node[1]] != s->node[1];
}

static void mark_changed(const struct output_overlaps *r,
                         struct changed_cells *cells,
                         const struct graph_segment *s) {
  changed_cells_mark(cells, r->snapping.graph, s,
                     2 * (r->snapping.output_step + 1));
}

/* Marks where segments have moved since the round began. */
static void mark_moved(const struct output_overlaps *r) {
  const struct segment_graph *graph = r->snapping.graph;
  for (size_t i = 0; r->here != NULL && i < graph->segment.count; i++)
    if (has_moved(&r->snapping, &graph->segment.item[i]))
      mark_changed(r, r->here, &graph->segment.item[i]);
}

/* The order of the pairs does not matter, as they are sorted. */
static bool find_pairs(struct output_overlaps *r,
                       const struct node_rows *rows) {
  size_t count = r->snapping.graph->segment.count;
  int workers = parallel_workers(count, SEGMENTS_IN_RANGE);
  struct pair_search *search = mem_calloc((size_t)workers, sizeof *search);
  if (search == NULL)
    return false;
  for (int w = 0; w < workers; w++) {
    search[w].snapping = &r->snapping;
    search[w].here = r->here;
    search[w].rows = rows;
  }
  bool ok = parallel_ranges(workers, count, SEGMENTS_IN_RANGE,
                            find_pairs_of_range, search);
  for (int w = 0; w < workers; w++) {
    for (size_t i = 0; ok && i < search[w].pair.count; i++)
      ok = ARRAY_PUSH(&r->pair, search[w].pair.item[i]);
    ARRAY_FREE(&search[w].pair);
  }
  mem_free(search);
  return ok;
}

/* ---- 3 Subtract ---------------------------------------------------------- */

/* Marks a node whose lines have moved a little. */
static void mark_approximate(struct output_overlaps *r, uint32_t node) {
  r->snapping.graph->approximate[r->snapping.root[node]] = 1;
}

static bool keep_segment_piece(struct output_overlaps *r, uint32_t segment,
                               uint32_t from, uint32_t to) {
  struct graph_segment piece = r->snapping.graph->segment.item[segment];
  piece.node[0] = from;
  piece.node[1] = to;
  if (r->cover.count > 0) { /* the rest lies a little beside the segment */
    mark_approximate(r, from);
    mark_approximate(r, to);
  }
  return r->snapping.root[from] == r->snapping.root[to] ||
         ARRAY_PUSH(&r->piece, piece);
}

static int compare_covers(const void *first, const void *second, void *user) {
  const struct overlap_cover *a = first, *b = second;
  (void)user;
  return (a->from > b->from) - (a->from < b->from);
}

/* Records the overlap of the piece with the segment, and merges an end of the
 * segment into one of the piece that is near it. */
static bool record_cover(struct output_overlaps *r, uint32_t segment,
                         const struct graph_segment *piece) {
  const uint32_t *node = r->snapping.graph->segment.item[segment].node;
  struct overlap_cover cover;
  if (!overlap_cover_find(&r->snapping, node, piece->node, &cover))
    return true;
  for (int end = 0; end < 2; end++)
    for (int k = 0; cover.node[end] == SEGMENT_GRAPH_NONE && k < 2; k++)
      if (vertex_snapping_is_near(&r->snapping, node[end], piece->node[k]) &&
          vertex_snapping_unite(&r->snapping, node[end], piece->node[k])) {
        mark_approximate(r, piece->node[k]);
        break;
      }
  return ARRAY_PUSH(&r->cover, cover);
}

/* Keeps the parts of the segment outside the recorded overlaps. */
static bool keep_rest(struct output_overlaps *r, uint32_t segment) {
  const uint32_t *node = r->snapping.graph->segment.item[segment].node;
  size_t count = r->cover.count;
  if (count == 0)
    return keep_segment_piece(r, segment, node[0], node[1]);
  r->cut++;
  if (!sort_stable(r->cover.item, count, sizeof *r->cover.item, compare_covers,
                   NULL))
    return false;
  double reached = 0;
  uint32_t last =
      node[0]; /* start of the next piece; SEGMENT_GRAPH_NONE: none */
  for (size_t i = 0; i < count; i++) {
    const struct overlap_cover *cover = &r->cover.item[i];
    if (cover->from > reached && cover->node[0] != SEGMENT_GRAPH_NONE &&
        last != SEGMENT_GRAPH_NONE &&
        !keep_segment_piece(r, segment, last, cover->node[0]))
      return false;
    if (cover->to >= reached) {
      reached = cover->to;
      last = cover->node[1];
    }
  }
  return last == SEGMENT_GRAPH_NONE ||
         keep_segment_piece(r, segment, last, node[1]);
}

/* The index of a segment among the members. */
static uint32_t find_member(const struct output_overlaps *r, uint32_t segment) {
  uint64_t key = overlap_priority(r->snapping.graph, segment);
  const struct sort_key *m = r->member.item;
  size_t i;
  LOWER_BOUND(i, 0, r->member.count,
              m[i].key < key || (m[i].key == key && m[i].value < segment));
  return (uint32_t)i;
}

/* The first pair in which the segment is the worse one. */
static size_t find_pair(const struct output_overlaps *r, uint32_t segment) {
  size_t i;
  LOWER_BOUND(i, 0, r->pair.count, r->pair.item[i].key >> 32 < segment);
  return i;
}

static bool subtract_kept(struct output_overlaps *r, uint32_t segment) {
  r->cover.count = 0;
  for (size_t i = find_pair(r, segment);
       i < r->pair.count && r->pair.item[i].key >> 32 == segment; i++) {
    uint32_t position = find_member(r, (uint32_t)r->pair.item[i].key);
    uint32_t end = r->start.item[position + 1];
    for (uint32_t k = r->start.item[position]; k < end; k++)
      if (!record_cover(r, segment, &r->piece.item[k]))
        return false;
  }
  return keep_rest(r, segment);
}

/* The segments that occur in pairs, by priority, then by number. */
static bool list_members(struct output_overlaps *r) {
  const struct segment_graph *graph = r->snapping.graph;
  for (size_t i = 0; i < r->pair.count; i++) {
    uint64_t pair = r->pair.item[i].key;
    uint32_t worse = (uint32_t)(pair >> 32), better = (uint32_t)pair;
    struct sort_key a = {worse, 0}, b = {better, 0};
    if (!ARRAY_PUSH(&r->member, a) || !ARRAY_PUSH(&r->member, b))
      return false;
  }
  if (!sort_keys_unique(r->member.item, &r->member.count))
    return false;
  for (size_t i = 0; i < r->member.count; i++) {
    uint32_t segment = (uint32_t)r->member.item[i].key;
    r->member.item[i] =
        (struct sort_key){overlap_priority(graph, segment), segment};
  }
  return sort_keys_unique(r->member.item, &r->member.count);
}

static bool resolve_members(struct output_overlaps *r) {
  if (!sort_keys_unique(r->pair.item, &r->pair.count) || !list_members(r))
    return false;
  for (size_t i = 0; i < r->member.count; i++)
    if (!poll_at(i) || !ARRAY_PUSH(&r->start, (uint32_t)r->piece.count) ||
        !subtract_kept(r, r->member.item[i].value))
      return false;
  for (size_t i = 0; i < r->member.count; i++)
    r->snapping.gone[r->member.item[i].value] = 1;
  return true;
}

/* ---- 4 Rebuild ----------------------------------------------------------- */

/* Adds a segment between the nodes that its own were merged into.
 * rows  to search around it, where it is not what it was before; else NULL */
static bool add_snapped_segment(struct output_overlaps *r,
                                const struct node_rows *rows,
                                struct graph_segment s) {
  const struct vertex_snapping *snapping = &r->snapping;
  struct segment_graph *graph = snapping->graph;
  uint32_t a = snapping->root[s.node[0]], b = snapping->root[s.node[1]];
  /* Moving an end turns the whole line a little. */
  if (a != s.node[0])
    graph->approximate[b] = 1;
  if (b != s.node[1])
    graph->approximate[a] = 1;
  if (a == b)
    return true;
  s.node[0] = a;
  s.node[1] = b;
  uint32_t last = (uint32_t)graph->segment.count;
  if (!ARRAY_PUSH(&graph->segment, graph_segment_sorted(s)))
    return false;
  if (rows != NULL) {
    segment_graph_mark_near_nodes(graph, rows, snapping->output_step, last);
    mark_changed(r, r->next, &graph->segment.item[last]);
  }
  return true;
}

/* Adds the segments again that are left of those in `segment`, the pieces, and
 * the isolated ones that have something near them now. */
static bool rebuild(struct output_overlaps *r, const struct node_rows *rows) {
  struct segment_graph *graph = r->snapping.graph;
  const struct vertex_snapping *snapping = &r->snapping;
  size_t old = graph->segment.count;
  graph->segment.count = 0;
  for (size_t i = 0; i < old; i++) {
    const struct graph_segment *s = &graph->segment.item[i];
    if (!poll_at(i) ||
        (!snapping->gone[i] &&
         !add_snapped_segment(r, has_moved(snapping, s) ? rows : NULL, *s)))
      return false;
  }
  for (size_t i = 0; i < r->piece.count; i++)
    if (!add_snapped_segment(r, rows, r->piece.item[i]))
      return false;
  segment_graph_move_gaps(graph, snapping->root);
  size_t count = graph->segment.count;
  if (!segment_graph_take_isolated(graph, &graph->segment))
    return false;
  for (size_t i = count; i < graph->segment.count; i++)
    mark_changed(r, r->next, &graph->segment.item[i]);
  return segment_graph_sort_segments(graph);
}

/* One round; sets *changed if another round may find more.
 * here, next  as of output_overlaps */
static bool drop_once(struct segment_graph *graph,
                      const struct node_clusters *clusters,
                      struct changed_cells *here, struct changed_cells *next,
                      bool *changed) {
  const struct node_rows *rows = clusters->rows;
  struct output_overlaps r = {.here = here, .next = next};
  bool ok = vertex_snapping_init(&r.snapping, graph, clusters->step) &&
            vertex_snapping_drop_duplicates(&r.snapping, clusters);
  if (ok)
    mark_moved(&r);
  ok = ok && find_pairs(&r, rows);
  if (ok && r.pair.count > 0)
    ok = resolve_members(&r);
  *changed = r.cut > 0 || r.snapping.gone_count > 0;
  if (ok && *changed)
    ok = rebuild(&r, rows);
  graph->doubled += r.cut + r.snapping.gone_count;
  vertex_snapping_fini(&r.snapping);
  ARRAY_FREE(&r.pair);
  ARRAY_FREE(&r.member);
  ARRAY_FREE(&r.start);
  ARRAY_FREE(&r.piece);
  ARRAY_FREE(&r.cover);
  return ok;
}

recto_status segment_graph_drop_output_overlaps(struct segment_graph *graph,
                                                const struct node_rows *rows,
                                                double output_step,
                                                recto_error *error) {
  int32_t whole = (int32_t)ceil(output_step);
  if (whole <= TOLERANCE_COINCIDENT_UNITS)
    return RECTO_OK;
  if (graph->approximate == NULL)
    graph->approximate =
        mem_calloc(graph->node.count, sizeof *graph->approximate);
  if (graph->approximate == NULL)
    return error_memory(error);
  struct changed_cells *cells = mem_calloc(2, sizeof *cells);
  struct node_clusters clusters;
  bool ok = node_clusters_init(&clusters, graph, rows, whole) && cells != NULL,
       changed = true;
  recto_status status = RECTO_OK;
  for (int round = 0; ok && changed && round < SEGMENT_GRAPH_ROUNDS; round++) {
    struct changed_cells *next = &cells[round & 1];
    struct changed_cells *here = round > 0 ? &cells[!(round & 1)] : NULL;
    memset(next, 0, sizeof *next);
    ok = drop_once(graph, &clusters, here, next, &changed);
    if (ok && changed)
      status = segment_graph_index_ends(graph, error);
    ok = ok && status == RECTO_OK;
  }
  node_clusters_fini(&clusters);
  mem_free(cells);
  return ok || status != RECTO_OK ? status : error_memory(error);
}
