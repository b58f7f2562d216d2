/* short_spurs.c - finds the short silhouettes within the picture that lead
 * nowhere; and smooth contours, and creases beside them, that are short and
 * touch nothing.
 *
 * Where a mesh is rough its surface folds over itself by next to nothing: each
 * fold is a silhouette, of which visibility leaves a tick beside the outline,
 * or a dash that touches nothing.  A spur is a chain of segments from a loose
 * end to where lines meet, or to another loose end.
 *
 * Phases
 *   1 walk from each loose end of a silhouette or a crease, and keep the short
 *     spurs
 *   2 look for nodes of other lines on them
 *   3 list the loose ends of the others in the cells of a uniform grid, and
 *     test each segment with those in its cells
 * Invariants  The outline of the picture is whole: along it lines go on from
 *   line to line.  So a spur with an end that no other line is near, and
 *   without a line that ends on it, is no part of the outline. */
#include "ink/lines/short_spurs.h"

#include <math.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/lines/loose_ends.h"
#include "ink/lines/nodes_near_segment.h"
#include "ink/lines/paths.h"
#include "ink/pens.h"

struct spur {
  uint32_t end[2]; /* its loose ends; SEGMENT_GRAPH_NONE: there is one */
  bool is_met;     /* another line ends on it */
  bool is_dash;    /* it is left out only if it touches nothing */
};

struct spur_search {
  const struct segment_graph *graph;
  const struct sheet *sheet;
  const struct pens *pens;
  double step; /* see segment_graph_find_short_spurs */
  bool smooth; /* the same */
  ARRAY(struct spur) spur;
  uint32_t *of_segment;    /* the spur of each, plus one; 0: it is of none */
  ARRAY(uint32_t) segment; /* those of spurs */
  struct loose_ends loose; /* end k of spur i is 2 i + k */
};

static uint32_t spur_node(const struct spur_search *s, uint32_t end) {
  return s->graph->segment.item[end >> 1].node[end & 1];
}

static uint32_t ends_at(const struct spur_search *s, uint32_t node) {
  return s->graph->ends.start[node + 1] - s->graph->ends.start[node];
}

/* The class of a visible segment of which a spur may be; 0: of none. */
static unsigned spur_class(const struct spur_search *s, uint32_t index) {
  const struct graph_segment *segment = &s->graph->segment.item[index];
  unsigned edge_class = segment->style_key & RECTO_EDGES_ALL;
  bool may_be = edge_class == RECTO_EDGE_SILHOUETTE ||
                (s->smooth && edge_class == RECTO_EDGE_CREASE);
  return may_be && !graph_segment_is_hidden(segment) ? edge_class : 0;
}

/* ---- 1 Spurs ------------------------------------------------------------- */

/* Whether a line goes on in the model beyond an end: the page, the near plane
 * or a cut ends it, or it is a contour of a smooth surface. */
static bool is_cut_off(const struct spur_search *s, uint32_t end) {
  const struct graph_segment *segment = &s->graph->segment.item[end >> 1];
  double near = s->step + 2 * TOLERANCE_COINCIDENT_UNITS;
  struct ink_point at = s->graph->node.item[spur_node(s, end)];
  const struct sheet_edge *edge = &s->sheet->edge.item[segment->edge];
  for (int k = 0; k < 2; k++) {
    const struct geom_point *p = &s->sheet->point.item[edge->point[k]];
    if (fabs((double)p->x - at.x) <= near && fabs((double)p->y - at.y) <= near)
      return edge->point[k] >= s->sheet->vertex_count;
  }
  return edge->source == SHEET_NONE;
}

/* Whether an end is that of a contour of a smooth surface, which may end within
 * it, in a cusp. */
static bool is_smooth_contour(const struct spur_search *s, uint32_t end) {
  const struct graph_segment *segment = &s->graph->segment.item[end >> 1];
  return s->smooth && spur_class(s, end >> 1) == RECTO_EDGE_SILHOUETTE &&
         s->sheet->edge.item[segment->edge].source == SHEET_NONE;
}

static double segment_mm(const struct spur_search *s, uint32_t segment) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  return hypot((double)p.x - q.x, (double)p.y - q.y) / SHEET_UNITS_PER_MM;
}

/* The end at which a line goes on beyond another end of it, with its class;
 * SEGMENT_GRAPH_NONE: other lines meet it there, or nothing does. */
static uint32_t next_end(const struct spur_search *s, uint32_t end) {
  const struct segment_graph *graph = s->graph;
  uint32_t node = spur_node(s, end);
  const uint32_t *two = graph->ends.item + graph->ends.start[node];
  if (ends_at(s, node) != 2)
    return SEGMENT_GRAPH_NONE;
  uint32_t next = two[two[0] == end];
  return spur_class(s, next >> 1) == spur_class(s, end >> 1)
             ? next
             : SEGMENT_GRAPH_NONE;
}

/* Walks from a loose end along what may be left out.  Returns the last end, or
 * SEGMENT_GRAPH_NONE: it is too long. */
static uint32_t walk(const struct spur_search *s, uint32_t end, bool *is_long) {
  const struct graph_segment *first = &s->graph->segment.item[end >> 1];
  uint32_t group =
      sheet_edge_group(s->sheet, &s->sheet->edge.item[first->edge]);
  uint32_t pen = pens_of_line(s->pens, spur_class(s, end >> 1), group);
  double length = 0, limit = is_smooth_contour(s, end)
                                 ? pens_shortest_contour_mm(s->pens, pen)
                                 : pens_shortest_isolated_mm(s->pens, pen);
  for (uint32_t next = end; next != SEGMENT_GRAPH_NONE;
       next = next_end(s, end)) {
    length += segment_mm(s, next >> 1);
    if (length >= limit)
      return SEGMENT_GRAPH_NONE;
    end = next ^ 1;
  }
  *is_long = length >= pens_shortest_crease_mm(s->pens, pen);
  return end;
}

typedef ARRAY(struct spur) spur_array;

static bool add_spur(const struct spur_search *s, uint32_t end,
                     spur_array *spurs) {
  bool is_long = false;
  bool is_smooth = is_smooth_contour(s, end);
  uint32_t last = walk(s, end, &is_long);
  if (last == SEGMENT_GRAPH_NONE || (!is_smooth && is_cut_off(s, end)))
    return true;
  bool both = ends_at(s, spur_node(s, last)) == 1;
  if (both && (last < end || (!is_smooth && is_cut_off(s, last))))
    return true; /* found from there, or cut off */
  bool is_crease = spur_class(s, end >> 1) == RECTO_EDGE_CREASE;
  if ((is_crease && is_long) || ((is_crease || is_smooth) && !both))
    return true;
  struct spur spur = {.end = {end, both ? last : SEGMENT_GRAPH_NONE},
                      .is_dash = is_long || is_crease || is_smooth};
  return ARRAY_PUSH(spurs, spur);
}

/* What the ranges of nodes find. */
struct spur_finding {
  const struct spur_search *search;
  spur_array *found; /* one a range */
};

static bool find_spurs_of_range(void *user, struct parallel_range range) {
  const struct spur_finding *finding = user;
  const struct spur_search *s = finding->search;
  const struct number_lists *ends = &s->graph->ends;
  spur_array *found = &finding->found[range.begin / PARALLEL_ITEMS];
  for (size_t n = range.begin; n < range.end; n++) {
    if (!poll_at(n))
      return false;
    if (ends_at(s, (uint32_t)n) != 1) /* there are nodes without any */
      continue;
    uint32_t end = ends->item[ends->start[n]];
    if (spur_class(s, end >> 1) != 0 && !add_spur(s, end, found))
      return false;
  }
  return true;
}

/* The spurs of the ranges follow each other in order. */
static bool find_spurs(struct spur_search *s) {
  size_t nodes = s->graph->node.count,
         ranges = parallel_range_count(nodes, PARALLEL_ITEMS);
  struct spur_finding finding = {s, mem_calloc(ranges, sizeof *finding.found)};
  bool ok = finding.found != NULL &&
            parallel_ranges(parallel_workers(nodes, PARALLEL_ITEMS), nodes,
                            PARALLEL_ITEMS, find_spurs_of_range, &finding);
  for (size_t r = 0; finding.found != NULL && r < ranges; r++) {
    for (size_t i = 0; ok && i < finding.found[r].count; i++)
      ok = ARRAY_PUSH(&s->spur, finding.found[r].item[i]);
    ARRAY_FREE(&finding.found[r]);
  }
  mem_free(finding.found);
  return ok;
}

/* Lists the segments of a spur. */
static bool list_spur(struct spur_search *s, uint32_t spur) {
  for (uint32_t end = s->spur.item[spur].end[0]; end != SEGMENT_GRAPH_NONE;
       end = next_end(s, end ^ 1)) {
    s->of_segment[end >> 1] = spur + 1;
    if (!ARRAY_PUSH(&s->segment, end >> 1))
      return false;
  }
  return true;
}

static bool list_spurs(struct spur_search *s) {
  s->of_segment = mem_calloc(s->graph->segment.count, sizeof *s->of_segment);
  bool ok = s->of_segment != NULL;
  for (uint32_t i = 0; ok && i < s->spur.count; i++)
    ok = list_spur(s, i);
  return ok;
}

/* ---- 2 What ends on them ------------------------------------------------- */

/* Whether a node is one of a spur's, or of none. */
static bool is_of_spur(const struct spur_search *s, uint32_t node,
                       uint32_t spur) {
  const struct number_lists *ends = &s->graph->ends;
  for (uint32_t i = ends->start[node]; i < ends->start[node + 1]; i++)
    if (s->of_segment[ends->item[i] >> 1] == spur + 1)
      return true;
  return ends->start[node] == ends->start[node + 1];
}

/* Whether a node near a segment of a spur is its own. */
static bool is_own_node(void *user, uint32_t segment, uint32_t node) {
  const struct spur_search *s = user;
  return is_of_spur(s, node, s->of_segment[segment] - 1);
}

struct met_search {
  const struct spur_search *spurs;
  struct node_search nodes;
};

static bool find_met_of_range(void *user, struct parallel_range range) {
  const struct met_search *met = user;
  const struct spur_search *s = met->spurs;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t segment = s->segment.item[i];
    struct spur *spur = &s->spur.item[s->of_segment[segment] - 1];
    if (!loose_ends_is_found(&spur->is_met) &&
        !nodes_near_segment_visit(&met->nodes, segment))
      loose_ends_set_found(&spur->is_met);
  }
  return true;
}

static bool find_met(struct spur_search *s, const struct node_rows *rows) {
  double near = s->step + 2 * TOLERANCE_COINCIDENT_UNITS;
  struct met_search met = {
      s, {s->graph, rows, (int32_t)ceil(near), is_own_node, s}};
  return parallel_ranges(parallel_workers(s->segment.count, PATHS_IN_RANGE),
                         s->segment.count, PATHS_IN_RANGE, find_met_of_range,
                         &met);
}

/* ---- 3 What passes by ---------------------------------------------------- */

static bool list_loose_ends(struct spur_search *s) {
  bool ok =
      loose_ends_init(&s->loose, s->graph, s->pens, s->sheet->camera.page_mm);
  for (uint32_t i = 0; ok && i < s->spur.count; i++)
    for (int k = 0; ok && k < 2; k++) {
      const struct spur *spur = &s->spur.item[i];
      uint32_t end = spur->end[k];
      struct loose_end loose = {.spur = i,
                                .is_passed = end == SEGMENT_GRAPH_NONE};
      if (!loose.is_passed)
        loose.at = s->graph->node.item[spur_node(s, end)];
      ok = loose_ends_add(&s->loose, loose, !loose.is_passed && !spur->is_met);
    }
  return ok;
}

static void test_segment(struct spur_search *s, uint32_t segment) {
  loose_ends_test(&s->loose, segment, s->of_segment[segment] - 1);
}

/* Segments that begin at one node follow each other. */
static bool test_range(void *user, struct parallel_range range) {
  struct spur_search *s = user;
  const struct ink_point *at = s->graph->node.item;
  const struct graph_segment *segment = s->graph->segment.item;
  uint32_t node = SEGMENT_GRAPH_NONE;
  bool near = false;
  for (size_t i = range.begin; i < range.end; i++) {
    if (segment[i].node[0] != node) {
      node = segment[i].node[0];
      near = loose_ends_are_near(&s->loose, at[node]);
    }
    if ((near ||
         loose_ends_is_long(&s->loose, at[node], at[segment[i].node[1]])) &&
        !graph_segment_is_hidden(&segment[i]))
      test_segment(s, (uint32_t)i);
  }
  return true;
}

/* Segments of spurs come first: of ends that are close together all but a few
 * leave the lists with these. */
static bool find_passing(struct spur_search *s) {
  size_t count = s->graph->segment.count;
  if (!list_loose_ends(s))
    return false;
  for (size_t i = 0; i < s->segment.count; i++) {
    if (!poll_at(i))
      return false;
    test_segment(s, s->segment.item[i]);
  }
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  s->loose.is_shared = workers > 1;
  return parallel_ranges(workers, count, PARALLEL_ITEMS, test_range, s);
}

/* ---- All ----------------------------------------------------------------- */

static bool leads_nowhere(const struct spur_search *s, uint32_t spur) {
  const struct loose_end *end = &s->loose.end.item[2 * (size_t)spur];
  if (s->spur.item[spur].is_met)
    return false;
  return s->spur.item[spur].is_dash ? !end[0].is_passed && !end[1].is_passed
                                    : !end[0].is_passed || !end[1].is_passed;
}

static void drop_spurs(const struct spur_search *s, uint8_t *drop) {
  for (size_t i = 0; i < s->segment.count; i++) {
    uint32_t segment = s->segment.item[i];
    drop[segment] = leads_nowhere(s, s->of_segment[segment] - 1);
  }
}

bool segment_graph_find_short_spurs(const struct segment_graph *graph,
                                    const struct node_rows *rows,
                                    const struct sheet *sheet,
                                    const struct pens *pens, double step,
                                    bool smooth, uint8_t *drop) {
  struct spur_search s = {.graph = graph,
                          .sheet = sheet,
                          .pens = pens,
                          .step = step,
                          .smooth = smooth};
  bool ok = find_spurs(&s);
  if (ok && s.spur.count > 0) {
    ok = list_spurs(&s) && find_met(&s, rows) && find_passing(&s);
    if (ok)
      drop_spurs(&s, drop);
  }
  ARRAY_FREE(&s.spur);
  mem_free(s.of_segment);
  ARRAY_FREE(&s.segment);
  loose_ends_fini(&s.loose);
  return ok;
}
