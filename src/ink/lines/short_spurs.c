/* short_spurs.c - finds the short silhouettes within the picture that lead
 * nowhere; and beside smooth contours short creases that touch nothing.
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
#include <stdlib.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/tolerance.h"
#include "geom/nearest.h"
#include "ink/lines/nodes_near_segment.h"
#include "ink/pens.h"

/* The cells of the grid along each side of the page, at most.  Blocks of them,
 * 2^BLOCK_SHIFT along each side, are looked at first. */
enum { GRID_MAX = 1 << 10, BLOCK_SHIFT = 3 };

struct spur {
  uint32_t end[2];   /* its loose ends; SEGMENT_GRAPH_NONE: there is one */
  bool is_passed[2]; /* another line is near that end, or there is none */
  bool is_met;       /* another line ends on it */
  bool is_dash;      /* it is left out only if it touches nothing */
};

/* A loose end in the list of a cell: end k of spur `end` >> 1, k = `end` & 1.
 * next  one in the list, plus one; 0: none */
struct listed_end {
  uint32_t end, next;
};

struct spur_search {
  const struct segment_graph *graph;
  const struct sheet *sheet;
  const struct pens *pens;
  double step;  /* see segment_graph_find_short_spurs */
  bool creases; /* the same */
  ARRAY(struct spur) spur;
  uint32_t *of_segment;    /* the spur of each, plus one; 0: it is of none */
  ARRAY(uint32_t) segment; /* those of spurs */
  double near;             /* half of the widest pen, grid units */
  double cell, low[2];     /* of the uniform grid, grid units */
  double per_unit;         /* cells */
  int count[2];            /* of cells, in x and in y */
  /* One a cell: the first of the loose ends in it and in those about it, as in
   * listed_end. */
  uint32_t *first;
  ARRAY(struct listed_end) listed;
  uint8_t *has_ends; /* one a block: some cell of it has a list */
  size_t blocks;     /* in a row of these */
  uint8_t *is_near;  /* one a segment: some may be near it */
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
                (s->creases && edge_class == RECTO_EDGE_CREASE);
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
  uint32_t group = s->sheet->edge.item[first->edge].group;
  uint32_t pen = pens_of_line(s->pens, spur_class(s, end >> 1), group);
  double length = 0;
  for (uint32_t next = end; next != SEGMENT_GRAPH_NONE;
       next = next_end(s, end)) {
    length += segment_mm(s, next >> 1);
    if (length >= pens_shortest_isolated_mm(s->pens, pen))
      return SEGMENT_GRAPH_NONE;
    end = next ^ 1;
  }
  *is_long = length >= pens_shortest_crease_mm(s->pens, pen);
  return end;
}

static bool add_spur(struct spur_search *s, uint32_t end) {
  bool is_long = false;
  uint32_t last = walk(s, end, &is_long);
  if (last == SEGMENT_GRAPH_NONE || is_cut_off(s, end))
    return true;
  bool both = ends_at(s, spur_node(s, last)) == 1;
  if (both && (last < end || is_cut_off(s, last)))
    return true; /* found from there, or cut off */
  bool is_crease = spur_class(s, end >> 1) == RECTO_EDGE_CREASE;
  if (is_crease && (is_long || !both))
    return true;
  struct spur spur = {.end = {end, both ? last : SEGMENT_GRAPH_NONE},
                      .is_dash = is_long || is_crease};
  return ARRAY_PUSH(&s->spur, spur);
}

static bool find_spurs(struct spur_search *s) {
  const struct segment_graph *graph = s->graph;
  for (size_t n = 0; n < graph->node.count; n++) {
    if (!poll_at(n))
      return false;
    if (ends_at(s, (uint32_t)n) != 1) /* there are nodes without any */
      continue;
    uint32_t end = graph->ends.item[graph->ends.start[n]];
    if (spur_class(s, end >> 1) != 0 && !add_spur(s, end))
      return false;
  }
  return true;
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

static void find_met(struct spur_search *s, const struct node_rows *rows) {
  double near = s->step + 2 * TOLERANCE_COINCIDENT_UNITS;
  const struct node_search search = {s->graph, rows, (int32_t)ceil(near),
                                     is_own_node, s};
  for (size_t i = 0; i < s->segment.count; i++) {
    uint32_t segment = s->segment.item[i];
    struct spur *spur = &s->spur.item[s->of_segment[segment] - 1];
    spur->is_met = spur->is_met || !nodes_near_segment_visit(&search, segment);
  }
}

/* ---- 3 What passes by ---------------------------------------------------- */

static int spur_cell(const struct spur_search *s, int axis, double at) {
  double cell = (at - s->low[axis]) * s->per_unit;
  int last = s->count[axis] - 1;
  return cell < 0 ? 0 : cell < last ? (int)cell : last;
}

/* Lists a loose end in its cell and in those about it: what is near the end is
 * in one of them. */
static bool list_loose_end(struct spur_search *s, uint32_t spur, uint32_t k) {
  struct ink_point at =
      s->graph->node.item[spur_node(s, s->spur.item[spur].end[k])];
  int x = spur_cell(s, 0, at.x), y = spur_cell(s, 1, at.y);
  for (int row = y - (y > 0); row <= y + 1 && row < s->count[1]; row++)
    for (int i = x - (x > 0); i <= x + 1 && i < s->count[0]; i++) {
      uint32_t *first = &s->first[row * s->count[0] + i];
      struct listed_end listed = {spur << 1 | k, *first};
      if (!ARRAY_PUSH(&s->listed, listed))
        return false;
      *first = (uint32_t)s->listed.count;
      s->has_ends[(size_t)(row >> BLOCK_SHIFT) * s->blocks +
                  (size_t)(i >> BLOCK_SHIFT)] = 1;
    }
  return true;
}

static bool list_loose_ends(struct spur_search *s) {
  const double *page_mm = s->sheet->camera.page_mm;
  double longest = fmax(page_mm[0], page_mm[1]) * SHEET_UNITS_PER_MM;
  s->cell = fmax(4 * s->near, longest / GRID_MAX);
  s->per_unit = 1 / s->cell;
  for (int axis = 0; axis < 2; axis++) {
    s->low[axis] = -page_mm[axis] / 2 * SHEET_UNITS_PER_MM;
    s->count[axis] = 1 - (int)floor(2 * s->low[axis] / s->cell);
  }
  s->first =
      mem_calloc((size_t)s->count[0] * (size_t)s->count[1], sizeof *s->first);
  s->blocks = ((size_t)s->count[0] >> BLOCK_SHIFT) + 1;
  s->has_ends = mem_calloc(s->blocks, ((size_t)s->count[1] >> BLOCK_SHIFT) + 1);
  bool ok = s->first != NULL && s->has_ends != NULL;
  for (uint32_t i = 0; ok && i < s->spur.count; i++) {
    struct spur *spur = &s->spur.item[i];
    for (uint32_t k = 0; ok && k < 2; k++) {
      spur->is_passed[k] = spur->end[k] == SEGMENT_GRAPH_NONE;
      ok = spur->is_passed[k] || spur->is_met || list_loose_end(s, i, k);
    }
  }
  return ok;
}

/* The lists of the cells of a segment's ends, if it is in no other cells: in
 * one, or in two that share a side.  Returns false if it may be. */
static bool find_cells(const struct spur_search *s, uint32_t segment,
                       uint32_t *first[2]) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  int x = spur_cell(s, 0, p.x), y = spur_cell(s, 1, p.y);
  int dx = spur_cell(s, 0, q.x) - x, dy = spur_cell(s, 1, q.y) - y;
  first[0] = &s->first[y * s->count[0] + x];
  first[1] = first[0] + dy * s->count[0] + dx;
  return abs(dx) + abs(dy) <= 1;
}

/* Whether loose ends may be listed in a cell of a segment: by the blocks of its
 * box, of which there are two by two at most where it is not long. */
static bool may_meet_ends(const struct spur_search *s, uint32_t segment) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  int x = spur_cell(s, 0, p.x) >> BLOCK_SHIFT,
      y = spur_cell(s, 1, p.y) >> BLOCK_SHIFT,
      to_x = spur_cell(s, 0, q.x) >> BLOCK_SHIFT,
      to_y = spur_cell(s, 1, q.y) >> BLOCK_SHIFT;
  const uint8_t *row = s->has_ends + (size_t)y * s->blocks,
                *to_row = s->has_ends + (size_t)to_y * s->blocks;
  return abs(to_x - x) > 1 || abs(to_y - y) > 1 ||
         (row[x] | row[to_x] | to_row[x] | to_row[to_x]) != 0;
}

static bool find_near_of_range(void *user, struct parallel_range range) {
  const struct spur_search *s = user;
  for (size_t i = range.begin; i < range.end; i++)
    s->is_near[i] = !graph_segment_is_hidden(&s->graph->segment.item[i]) &&
                    may_meet_ends(s, (uint32_t)i);
  return true;
}

/* Whether a number is within `near` of a range, given by its ends. */
static bool is_near_span(int32_t a, int32_t b, int32_t at, double near) {
  double low = a < b ? a : b, high = a < b ? b : a;
  return low - near <= at && at <= high + near;
}

/* Whether a segment is within half a pen of a place.  One whose box is farther
 * away by a grid unit, more than rounding can bring it nearer, is not. */
static bool is_near_place(const struct spur_search *s, uint32_t segment,
                          struct ink_point at) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  if (!is_near_span(p.x, q.x, at.x, s->near + 1) ||
      !is_near_span(p.y, q.y, at.y, s->near + 1))
    return false;
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  double px = (double)at.x - p.x, py = (double)at.y - p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  return hypot(px - t * x, py - t * y) <= s->near;
}

/* Tests a segment with the loose ends in a list, which those leave that some
 * segment is near. */
static void test_list(struct spur_search *s, uint32_t *link, uint32_t segment) {
  while (*link != 0) {
    struct listed_end *listed = &s->listed.item[*link - 1];
    uint32_t number = listed->end >> 1, k = listed->end & 1;
    struct spur *spur = &s->spur.item[number];
    spur->is_passed[k] =
        spur->is_passed[k] ||
        (s->of_segment[segment] != number + 1 &&
         is_near_place(s, segment,
                       s->graph->node.item[spur_node(s, spur->end[k])]));
    if (spur->is_passed[k])
      *link = listed->next;
    else
      link = &listed->next;
  }
}

/* Tests a segment with what is listed in all of its cells, row by row. */
static void test_rows(struct spur_search *s, uint32_t segment) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  double low = fmin(p.y, q.y), high = fmax(p.y, q.y);
  double slope = high > low ? ((double)q.x - p.x) / ((double)q.y - p.y) : 0;
  for (int row = spur_cell(s, 1, low); row <= spur_cell(s, 1, high); row++) {
    double from = s->low[1] + row * s->cell - s->near;
    double y0 = fmin(fmax(from, low), high);
    double y1 = fmin(fmax(from + s->cell + 2 * s->near, low), high);
    double x0 = p.x + slope * (y0 - p.y), x1 = p.x + slope * (y1 - p.y);
    if (high == low) {
      x0 = p.x;
      x1 = q.x;
    }
    int last = spur_cell(s, 0, fmax(x0, x1));
    for (int x = spur_cell(s, 0, fmin(x0, x1)); x <= last; x++)
      test_list(s, &s->first[row * s->count[0] + x], segment);
  }
}

static void test_segment(struct spur_search *s, uint32_t segment) {
  uint32_t *first[2];
  if (find_cells(s, segment, first)) {
    test_list(s, first[0], segment);
    test_list(s, first[1], segment);
  } else {
    test_rows(s, segment);
  }
}

/* Segments of spurs come first: of ends that are close together all but a few
 * leave the lists with these. */
static bool find_passing(struct spur_search *s) {
  size_t count = s->graph->segment.count;
  s->is_near = mem_alloc(count, 1);
  if (s->is_near == NULL || !list_loose_ends(s) ||
      !parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, find_near_of_range, s))
    return false;
  for (size_t i = 0; i < s->segment.count; i++) {
    if (!poll_at(i))
      return false;
    test_segment(s, s->segment.item[i]);
  }
  for (uint32_t i = 0; i < count; i++) {
    if (!poll_at(i))
      return false;
    if (s->is_near[i])
      test_segment(s, i);
  }
  return true;
}

/* ---- All ----------------------------------------------------------------- */

static bool leads_nowhere(const struct spur *spur) {
  return !spur->is_met &&
         (spur->is_dash ? !spur->is_passed[0] && !spur->is_passed[1]
                        : !spur->is_passed[0] || !spur->is_passed[1]);
}

static void drop_spurs(const struct spur_search *s, uint8_t *drop) {
  for (size_t i = 0; i < s->segment.count; i++) {
    uint32_t segment = s->segment.item[i];
    drop[segment] = leads_nowhere(&s->spur.item[s->of_segment[segment] - 1]);
  }
}

bool segment_graph_find_short_spurs(const struct segment_graph *graph,
                                    const struct node_rows *rows,
                                    const struct sheet *sheet,
                                    const struct pens *pens, double step,
                                    bool creases, uint8_t *drop) {
  struct spur_search s = {.graph = graph,
                          .sheet = sheet,
                          .pens = pens,
                          .step = step,
                          .creases = creases};
  for (uint32_t pen = 0; pen < pens->count; pen++)
    s.near = fmax(s.near, pens_width_mm(pens, pen) / 2 * SHEET_UNITS_PER_MM);
  bool ok = find_spurs(&s);
  if (ok && s.spur.count > 0) {
    ok = list_spurs(&s);
    if (ok)
      find_met(&s, rows);
    ok = ok && find_passing(&s);
    if (ok)
      drop_spurs(&s, drop);
  }
  ARRAY_FREE(&s.spur);
  mem_free(s.of_segment);
  ARRAY_FREE(&s.segment);
  mem_free(s.first);
  mem_free(s.has_ends);
  ARRAY_FREE(&s.listed);
  mem_free(s.is_near);
  return ok;
}
