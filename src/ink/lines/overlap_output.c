/* overlap_output.c - lines that the output's rounding makes one are drawn once.
 *
 * Two segments are one, as far as they run along each other, where each end of
 * that run is near (vertex_snapping.h) the other segment: no farther in x and in y than
 * rounding both to the output could bring together.
 *
 * Phases
 *   1 twins    segments with near ends at both ends (vertex_snapping.c)
 *   2 pairs    every segment walks along its line and notes which others run
 *              along it
 *   3 settle   in order of rank, best first, a segment loses what runs along
 *              a piece that is kept.  What is left ends where that piece does,
 *              at its node
 *   4 rebuild  and once more where anything has moved, since what has moved
 *              may have come near something else
 * Invariants  What is lost is within a unit of what is kept, not of something
 *   that is lost in turn.  A node moves by a unit at most in a round, and only
 *   where a line is lost or shrinks. */
#include "ink/lines/segment_graph.h"

#include <math.h>
#include <stdlib.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/lines/vertex_snapping.h"
#include "ink/lines/overlap.h"
#include "ink/lines/nodes_near_segment.h"

/* A segment as numbers. */
struct repeat_run {
  struct ink_point from, to;
  int64_t dx, dy, reach; /* see nodes_near_segment.c */
  double length;
};

/* What a kept piece takes of a segment: from..to grid units along it; the
 * nodes where that is cut, SEGMENT_GRAPH_NONE at the segment's own ends. */
struct repeat_cover {
  double from, to;
  uint32_t node[2];
};

/* What segments keep: of the one at `place` in order of rank, the pieces
 * start[place] to start[place + 1]. */
struct repeats {
  struct vertex_snapping snapping;
  ARRAY(struct sort_key) pair;   /* worse segment << 32 | better one */
  ARRAY(struct sort_key) member; /* rank, segment: those of pairs */
  ARRAY(uint32_t) start;
  ARRAY(struct graph_segment) piece;
  ARRAY(struct repeat_cover) cover; /* of the segment at hand */
  size_t cut;                       /* segments that lost something */
};

/* ---- Two segments -------------------------------------------------------- */

static struct repeat_run run_of(const struct vertex_snapping *snapping,
                                const uint32_t node[2]) {
  struct repeat_run run = {.from = vertex_snapping_at(snapping, node[0]),
                           .to = vertex_snapping_at(snapping, node[1])};
  run.dx = (int64_t)run.to.x - run.from.x;
  run.dy = (int64_t)run.to.y - run.from.y;
  run.reach = snapping->unit * (llabs(run.dx) + llabs(run.dy));
  run.length = sqrt((double)(run.dx * run.dx + run.dy * run.dy));
  return run;
}

/* Whether the point is near the run; where along it, within the run. */
static bool is_on(const struct repeat_run *run, struct ink_point p,
                  double *along) {
  int64_t x = (int64_t)p.x - run->from.x, y = (int64_t)p.y - run->from.y;
  int64_t cross = run->dx * y - run->dy * x, dot = run->dx * x + run->dy * y;
  double at = (double)dot / run->length;
  *along = fmin(fmax(at, 0), run->length);
  return llabs(cross) <= run->reach && dot >= -run->reach &&
         at - run->length <= (double)run->reach / run->length;
}

static void widen(struct repeat_cover *cover, double along, uint32_t node) {
  if (along < cover->from ||
      (along == cover->from && node == SEGMENT_GRAPH_NONE)) {
    cover->from = along;
    cover->node[0] = node;
  }
  if (along > cover->to || (along == cover->to && node == SEGMENT_GRAPH_NONE)) {
    cover->to = along;
    cover->node[1] = node;
  }
}

/* Whether the segments run along each other, by more than a unit or, where one
 * is shorter than two, by half of it; what b takes of a then. */
static bool find_cover(const struct vertex_snapping *snapping,
                       const uint32_t a[2], const uint32_t b[2],
                       struct repeat_cover *cover) {
  struct repeat_run of_a = run_of(snapping, a), of_b = run_of(snapping, b);
  *cover = (struct repeat_cover){
      INFINITY, -INFINITY, {SEGMENT_GRAPH_NONE, SEGMENT_GRAPH_NONE}};
  if (of_a.length == 0 || of_b.length == 0)
    return false;
  double along, place[2];
  for (int k = 0; k < 2; k++)
    if (is_on(&of_a, k ? of_b.to : of_b.from, &place[k]))
      widen(cover, place[k],
            place[k] > 0 && place[k] < of_a.length ? b[k] : SEGMENT_GRAPH_NONE);
  if (is_on(&of_b, of_a.from, &along))
    widen(cover, 0, SEGMENT_GRAPH_NONE);
  if (is_on(&of_b, of_a.to, &along))
    widen(cover, of_a.length, SEGMENT_GRAPH_NONE);
  /* Ends count as near a little beyond the other's; the run itself does not
   * begin there, or short sides of a curve would run along the next. */
  double shorter = fmin(of_a.length, of_b.length);
  double run = fmin(fabs(place[1] - place[0]), cover->to - cover->from);
  return run > fmin((double)snapping->unit, shorter / 2);
}

/* ---- 2 Pairs ------------------------------------------------------------- */

static bool is_better(const struct segment_graph *graph, uint32_t a,
                      uint32_t b) {
  uint64_t of_a = overlap_rank(graph, a), of_b = overlap_rank(graph, b);
  return of_a < of_b || (of_a == of_b && a < b);
}

static bool note_pairs(void *user, uint32_t segment, uint32_t node) {
  struct repeats *r = user;
  const struct segment_graph *graph = r->snapping.graph;
  const struct graph_segment *s = graph->segment.item;
  struct repeat_cover cover;
  for (uint32_t i = graph->end_start[node]; i < graph->end_start[node + 1];
       i++) {
    uint32_t other = graph->end[i] >> 1;
    if (r->snapping.gone[other] ||
        !find_cover(&r->snapping, s[segment].node, s[other].node, &cover))
      continue;
    bool better = is_better(graph, segment, other);
    uint32_t best = better ? segment : other, worst = better ? other : segment;
    struct sort_key pair = {(uint64_t)worst << 32 | best, 0};
    if (!ARRAY_PUSH(&r->pair, pair))
      return false;
  }
  return true;
}

static bool find_pairs(struct repeats *r, const struct node_rows *rows) {
  const struct segment_graph *graph = r->snapping.graph;
  const struct node_search search = {graph, rows, r->snapping.unit, note_pairs,
                                     r};
  for (uint32_t i = 0; i < graph->segment.count; i++)
    if (!r->snapping.gone[i] && !nodes_near_segment_visit(&search, i))
      return false;
  return true;
}

/* Sorts and drops what is there twice. */
static bool sort_unique(struct sort_key *item, size_t *count) {
  struct sort_key *scratch = mem_alloc(*count, sizeof *scratch);
  if (!scratch)
    return false;
  sort_keys(item, scratch, *count);
  size_t kept = 0;
  for (size_t i = 0; i < *count; i++)
    if (i == 0 || item[i].key != item[kept - 1].key ||
        item[i].value != item[kept - 1].value)
      item[kept++] = item[i];
  *count = kept;
  mem_free(scratch);
  return true;
}

/* ---- 3 Settle ------------------------------------------------------------ */

/* The lines at the node are no longer quite where they were. */
static void loosen(struct repeats *r, uint32_t node) {
  r->snapping.graph->approximate[r->snapping.root[node]] = 1;
}

static bool keep_piece(struct repeats *r, uint32_t segment, uint32_t from,
                       uint32_t to) {
  struct graph_segment piece = r->snapping.graph->segment.item[segment];
  piece.node[0] = from;
  piece.node[1] = to;
  if (r->cover.count > 0) { /* what is left is a little beside the segment */
    loosen(r, from);
    loosen(r, to);
  }
  return r->snapping.root[from] == r->snapping.root[to] ||
         ARRAY_PUSH(&r->piece, piece);
}

static int compare_covers(const void *first, const void *second, void *user) {
  const struct repeat_cover *a = first, *b = second;
  (void)user;
  return (a->from > b->from) - (a->from < b->from);
}

/* Notes what the piece takes of the segment, an end of which becomes the
 * piece's where they are near. */
static bool take_cover(struct repeats *r, uint32_t segment,
                       const struct graph_segment *piece) {
  const uint32_t *node = r->snapping.graph->segment.item[segment].node;
  struct repeat_cover cover;
  if (!find_cover(&r->snapping, node, piece->node, &cover))
    return true;
  for (int end = 0; end < 2; end++)
    for (int k = 0; cover.node[end] == SEGMENT_GRAPH_NONE && k < 2; k++)
      if (vertex_snapping_is_near(&r->snapping, node[end], piece->node[k]) &&
          vertex_snapping_unite(&r->snapping, node[end], piece->node[k])) {
        loosen(r, piece->node[k]);
        break;
      }
  return ARRAY_PUSH(&r->cover, cover);
}

/* Keeps what the covers leave of the segment. */
static bool keep_rest(struct repeats *r, uint32_t segment) {
  const uint32_t *node = r->snapping.graph->segment.item[segment].node;
  size_t count = r->cover.count;
  if (count == 0)
    return keep_piece(r, segment, node[0], node[1]);
  r->cut++;
  if (!sort_stable(r->cover.item, count, sizeof *r->cover.item, compare_covers,
                   NULL))
    return false;
  double reached = 0;
  uint32_t last =
      node[0]; /* where the next piece begins; SEGMENT_GRAPH_NONE: nowhere */
  for (size_t i = 0; i < count; i++) {
    const struct repeat_cover *cover = &r->cover.item[i];
    if (cover->from > reached && cover->node[0] != SEGMENT_GRAPH_NONE &&
        last != SEGMENT_GRAPH_NONE &&
        !keep_piece(r, segment, last, cover->node[0]))
      return false;
    if (cover->to >= reached) {
      reached = cover->to;
      last = cover->node[1];
    }
  }
  return last == SEGMENT_GRAPH_NONE || keep_piece(r, segment, last, node[1]);
}

/* The place of a segment among the members. */
static uint32_t find_member(const struct repeats *r, uint32_t segment) {
  uint64_t rank = overlap_rank(r->snapping.graph, segment);
  size_t low = 0, high = r->member.count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    const struct sort_key *m = &r->member.item[middle];
    if (m->key < rank || (m->key == rank && m->value < segment))
      low = middle + 1;
    else
      high = middle;
  }
  return (uint32_t)low;
}

/* The first pair of which the segment is the worse. */
static size_t find_pair(const struct repeats *r, uint32_t segment) {
  size_t low = 0, high = r->pair.count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (r->pair.item[middle].key >> 32 < segment)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static bool settle_segment(struct repeats *r, uint32_t segment) {
  r->cover.count = 0;
  for (size_t i = find_pair(r, segment);
       i < r->pair.count && r->pair.item[i].key >> 32 == segment; i++) {
    uint32_t place = find_member(r, (uint32_t)r->pair.item[i].key);
    uint32_t end = r->start.item[place + 1];
    for (uint32_t k = r->start.item[place]; k < end; k++)
      if (!take_cover(r, segment, &r->piece.item[k]))
        return false;
  }
  return keep_rest(r, segment);
}

/* Those of pairs, by rank, then by number. */
static bool list_members(struct repeats *r) {
  const struct segment_graph *graph = r->snapping.graph;
  for (size_t i = 0; i < r->pair.count; i++) {
    uint64_t pair = r->pair.item[i].key;
    uint32_t worse = (uint32_t)(pair >> 32), better = (uint32_t)pair;
    struct sort_key a = {worse, 0}, b = {better, 0};
    if (!ARRAY_PUSH(&r->member, a) || !ARRAY_PUSH(&r->member, b))
      return false;
  }
  if (!sort_unique(r->member.item, &r->member.count))
    return false;
  for (size_t i = 0; i < r->member.count; i++) {
    uint32_t segment = (uint32_t)r->member.item[i].key;
    r->member.item[i] =
        (struct sort_key){overlap_rank(graph, segment), segment};
  }
  return sort_unique(r->member.item, &r->member.count);
}

static bool settle_members(struct repeats *r) {
  if (!sort_unique(r->pair.item, &r->pair.count) || !list_members(r))
    return false;
  for (size_t i = 0; i < r->member.count; i++)
    if (!ARRAY_PUSH(&r->start, (uint32_t)r->piece.count) ||
        !settle_segment(r, r->member.item[i].value))
      return false;
  for (size_t i = 0; i < r->member.count; i++)
    r->snapping.gone[r->member.item[i].value] = 1;
  return true;
}

/* ---- 4 Rebuild ----------------------------------------------------------- */

static bool add_segment(struct segment_graph *graph,
                        const struct vertex_snapping *snapping,
                        struct graph_segment s, size_t *count) {
  uint32_t a = snapping->root[s.node[0]], b = snapping->root[s.node[1]];
  /* With its end the whole line has turned a little. */
  if (a != s.node[0])
    graph->approximate[b] = 1;
  if (b != s.node[1])
    graph->approximate[a] = 1;
  if (a == b)
    return true;
  s.node[0] = a < b ? a : b;
  s.node[1] = a < b ? b : a;
  if (*count < graph->segment.count) {
    graph->segment.item[(*count)++] = s;
    return true;
  }
  (*count)++;
  return ARRAY_PUSH(&graph->segment, s);
}

static bool rebuild(struct repeats *r) {
  struct segment_graph *graph = r->snapping.graph;
  size_t old = graph->segment.count, count = 0;
  for (size_t i = 0; i < old; i++)
    if (!r->snapping.gone[i] &&
        !add_segment(graph, &r->snapping, graph->segment.item[i], &count))
      return false;
  for (size_t i = 0; i < r->piece.count; i++)
    if (!add_segment(graph, &r->snapping, r->piece.item[i], &count))
      return false;
  graph->segment.count = count;
  return segment_graph_sort_segments(graph);
}

/* One round; *changed says whether there may be something left to do. */
static bool drop_once(struct segment_graph *graph, const struct node_rows *rows,
                      int32_t unit, bool *changed) {
  struct repeats r = {0};
  bool ok = vertex_snapping_init(&r.snapping, graph, unit) &&
            vertex_snapping_drop_twins(&r.snapping, rows) &&
            find_pairs(&r, rows);
  if (ok && r.pair.count > 0)
    ok = settle_members(&r);
  *changed = r.cut > 0 || r.snapping.gone_count > 0;
  if (ok && *changed)
    ok = rebuild(&r);
  graph->doubled += r.cut + r.snapping.gone_count;
  vertex_snapping_fini(&r.snapping);
  ARRAY_FREE(&r.pair);
  ARRAY_FREE(&r.member);
  ARRAY_FREE(&r.start);
  ARRAY_FREE(&r.piece);
  ARRAY_FREE(&r.cover);
  return ok;
}

recto_status segment_graph_drop_repeats(struct segment_graph *graph,
                                        const struct node_rows *rows,
                                        double unit, recto_error *error) {
  int32_t whole = (int32_t)ceil(unit);
  if (whole <= TOLERANCE_COINCIDENT_UNITS)
    return RECTO_OK;
  graph->approximate =
      mem_calloc(graph->node.count, sizeof *graph->approximate);
  if (!graph->approximate)
    return error_memory(error);
  bool changed = true;
  for (int round = 0; changed && round < SEGMENT_GRAPH_ROUNDS; round++) {
    if (!drop_once(graph, rows, whole, &changed))
      return error_memory(error);
    if (changed) {
      recto_status status = segment_graph_index_ends(graph, error);
      if (status)
        return status;
    }
  }
  return RECTO_OK;
}
