/* short_spurs.c - finds the short silhouettes within the picture that lead
 * nowhere.
 *
 * Where a mesh is rough its surface folds over itself by next to nothing: each
 * fold is a silhouette, of which visibility leaves a tick beside the outline,
 * or a dash that touches nothing.  A spur is a chain of segments from a loose
 * end to where lines meet, or to another loose end.
 *
 * Phases
 *   1 walk from each loose end of a silhouette, and keep the short spurs
 *   2 list, in the cells of a uniform grid about their loose ends, the segments
 *     there, and look for one that passes by
 *   3 look for nodes of other lines on them
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

enum { NO_SPUR = UINT32_MAX };

/* The cells of the grid along each side of the page, at most. */
enum { GRID_MAX = 1 << 10 };

/* A loose end of a spur is in the cell; or in one beside it or across a corner,
 * at least. */
enum cell_mark { HAS_END = 2, IS_BESIDE_END = 1 };

struct spur {
  uint32_t end[2];   /* its loose ends; SEGMENT_GRAPH_NONE: there is one */
  bool is_passed[2]; /* another line is near that end, or there is none */
  bool is_met;       /* another line ends on it */
  bool is_long;      /* too long, unless it touches nothing */
};

struct spur_search {
  const struct segment_graph *graph;
  const struct sheet *sheet;
  const struct pens *pens;
  double step; /* see segment_graph_find_short_spurs */
  ARRAY(struct spur) spur;
  uint32_t *of_segment;        /* the spur of each, or NO_SPUR */
  double near;                 /* half of the widest pen, grid units */
  double cell, low[2];         /* of the uniform grid, grid units */
  double per_unit;             /* cells */
  int count[2];                /* of its cells, in x and in y */
  uint8_t *mark;               /* one a cell, of cell_mark */
  uint8_t *is_near;            /* one a segment: it may be near a marked cell */
  struct number_lists in_cell; /* the segments near each marked cell */
};

static uint32_t spur_node(const struct spur_search *s, uint32_t end) {
  return s->graph->segment.item[end >> 1].node[end & 1];
}

static uint32_t ends_at(const struct spur_search *s, uint32_t node) {
  return s->graph->ends.start[node + 1] - s->graph->ends.start[node];
}

static bool is_silhouette_segment(const struct graph_segment *segment) {
  return !graph_segment_is_hidden(segment) &&
         (segment->style_key & RECTO_EDGES_ALL) == RECTO_EDGE_SILHOUETTE;
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

/* The end at which a silhouette goes on beyond another end of it;
 * SEGMENT_GRAPH_NONE: other lines meet it there, or nothing does. */
static uint32_t next_end(const struct spur_search *s, uint32_t end) {
  const struct segment_graph *graph = s->graph;
  uint32_t node = spur_node(s, end);
  const uint32_t *two = graph->ends.item + graph->ends.start[node];
  if (ends_at(s, node) != 2)
    return SEGMENT_GRAPH_NONE;
  uint32_t next = two[two[0] == end];
  return is_silhouette_segment(&graph->segment.item[next >> 1])
             ? next
             : SEGMENT_GRAPH_NONE;
}

/* Walks from a loose end, marking segments as those of a spur, as long as it
 * may be left out.  Returns the last end, or SEGMENT_GRAPH_NONE: it is too
 * long. */
static uint32_t walk(const struct spur_search *s, uint32_t end, uint32_t spur,
                     bool *is_long) {
  const struct graph_segment *first = &s->graph->segment.item[end >> 1];
  uint32_t group = s->sheet->edge.item[first->edge].group;
  uint32_t pen = pens_of_line(s->pens, RECTO_EDGE_SILHOUETTE, group);
  double length = 0;
  for (uint32_t next = end; next != SEGMENT_GRAPH_NONE;
       next = next_end(s, end)) {
    length += segment_mm(s, next >> 1);
    if (length >= pens_shortest_isolated_mm(s->pens, pen))
      return SEGMENT_GRAPH_NONE;
    if (spur != NO_SPUR)
      s->of_segment[next >> 1] = spur;
    end = next ^ 1;
  }
  *is_long = length >= pens_shortest_crease_mm(s->pens, pen);
  return end;
}

static bool add_spur(struct spur_search *s, uint32_t end) {
  bool is_long = false;
  uint32_t last = walk(s, end, NO_SPUR, &is_long);
  if (last == SEGMENT_GRAPH_NONE || is_cut_off(s, end))
    return true;
  bool both = ends_at(s, spur_node(s, last)) == 1;
  if (both && (last < end || is_cut_off(s, last)))
    return true; /* found from there, or cut off */
  struct spur spur = {.end = {end, both ? last : SEGMENT_GRAPH_NONE},
                      .is_long = is_long};
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
    if (is_silhouette_segment(&graph->segment.item[end >> 1]) &&
        !add_spur(s, end))
      return false;
  }
  return true;
}

static bool mark_spurs(struct spur_search *s) {
  size_t segments = s->graph->segment.count;
  s->of_segment = mem_alloc(segments, sizeof *s->of_segment);
  for (size_t i = 0; s->of_segment != NULL && i < segments; i++)
    s->of_segment[i] = NO_SPUR;
  for (uint32_t i = 0; s->of_segment != NULL && i < s->spur.count; i++)
    (void)walk(s, s->spur.item[i].end[0], i, &s->spur.item[i].is_long);
  return s->of_segment != NULL;
}

/* ---- 2 What passes by ---------------------------------------------------- */

static int spur_cell(const struct spur_search *s, int axis, double at) {
  double cell = (at - s->low[axis]) * s->per_unit;
  int last = s->count[axis] - 1;
  return cell < 0 ? 0 : cell < last ? (int)cell : last;
}

static size_t spur_cell_at(const struct spur_search *s, struct ink_point at) {
  return (size_t)spur_cell(s, 1, at.y) * (size_t)s->count[0] +
         (size_t)spur_cell(s, 0, at.x);
}

/* Marks the cell of a loose end, and those about it. */
static void mark_spur_cells(struct spur_search *s, uint32_t end) {
  struct ink_point at = s->graph->node.item[spur_node(s, end)];
  int x = spur_cell(s, 0, at.x), y = spur_cell(s, 1, at.y);
  for (int row = y - (y > 0); row <= y + 1 && row < s->count[1]; row++)
    for (int i = x - (x > 0); i <= x + 1 && i < s->count[0]; i++)
      s->mark[row * s->count[0] + i] |= IS_BESIDE_END;
  s->mark[spur_cell_at(s, at)] |= HAS_END;
}

static bool make_spur_cells(struct spur_search *s) {
  const double *page_mm = s->sheet->camera.page_mm;
  double longest = fmax(page_mm[0], page_mm[1]) * SHEET_UNITS_PER_MM;
  s->cell = fmax(4 * s->near, longest / GRID_MAX);
  s->per_unit = 1 / s->cell;
  for (int axis = 0; axis < 2; axis++) {
    s->low[axis] = -page_mm[axis] / 2 * SHEET_UNITS_PER_MM;
    s->count[axis] = 1 - (int)floor(2 * s->low[axis] / s->cell);
  }
  s->mark = mem_calloc((size_t)s->count[0] * (size_t)s->count[1], 1);
  for (size_t i = 0; s->mark != NULL && i < s->spur.count; i++)
    for (int k = 0; k < 2; k++)
      if (s->spur.item[i].end[k] != SEGMENT_GRAPH_NONE)
        mark_spur_cells(s, s->spur.item[i].end[k]);
  return s->mark != NULL;
}

/* Whether a segment may be near a loose end: not if it is in one cell, or in
 * two that share a side, and none of them is beside that of a loose end. */
static bool may_be_near_end(const struct spur_search *s, uint32_t segment) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  int x = spur_cell(s, 0, p.x), y = spur_cell(s, 1, p.y);
  int dx = spur_cell(s, 0, q.x) - x, dy = spur_cell(s, 1, q.y) - y;
  const uint8_t *mark = &s->mark[y * s->count[0] + x];
  return abs(dx) + abs(dy) > 1 || *mark != 0 ||
         mark[dy * s->count[0] + dx] != 0;
}

static bool find_near_of_range(void *user, struct parallel_range range) {
  const struct spur_search *s = user;
  for (size_t i = range.begin; i < range.end; i++)
    s->is_near[i] = !graph_segment_is_hidden(&s->graph->segment.item[i]) &&
                    may_be_near_end(s, (uint32_t)i);
  return true;
}

/* Lists a segment in the marked cells that it is near, row by row. */
static void list_near_ends(struct spur_search *s, uint32_t segment) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  double low = fmin(p.y, q.y), high = fmax(p.y, q.y);
  double slope = high > low ? ((double)q.x - p.x) / ((double)q.y - p.y) : 0;
  for (int row = spur_cell(s, 1, low - s->near);
       row <= spur_cell(s, 1, high + s->near); row++) {
    double from = s->low[1] + row * s->cell;
    double y0 = fmin(fmax(from - s->near, low), high);
    double y1 = fmin(fmax(from + s->cell + s->near, low), high);
    double x0 = p.x + slope * (y0 - p.y), x1 = p.x + slope * (y1 - p.y);
    if (high == low) {
      x0 = p.x;
      x1 = q.x;
    }
    int last = spur_cell(s, 0, fmax(x0, x1) + s->near);
    for (int x = spur_cell(s, 0, fmin(x0, x1) - s->near); x <= last; x++) {
      uint32_t cell = (uint32_t)(row * s->count[0] + x);
      if (s->mark[cell] & HAS_END)
        number_lists_put(&s->in_cell, cell, segment);
    }
  }
}

static bool list_segments(struct spur_search *s) {
  size_t cells = (size_t)s->count[0] * (size_t)s->count[1];
  size_t count = s->graph->segment.count;
  s->is_near = mem_alloc(count, 1);
  if (s->is_near == NULL || !number_lists_init(&s->in_cell, cells) ||
      !parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, find_near_of_range, s))
    return false;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t i = 0; i < count; i++) {
      if (!poll_at(i))
        return false;
      if (s->is_near[i])
        list_near_ends(s, i);
    }
    if (pass == 0 && !number_lists_allocate(&s->in_cell, cells))
      return false;
  }
  return true;
}

/* Whether a segment is within half a pen of a place. */
static bool is_near_place(const struct spur_search *s, uint32_t segment,
                          struct ink_point at) {
  const uint32_t *node = s->graph->segment.item[segment].node;
  struct ink_point p = s->graph->node.item[node[0]];
  struct ink_point q = s->graph->node.item[node[1]];
  double x = (double)q.x - p.x, y = (double)q.y - p.y;
  double px = (double)at.x - p.x, py = (double)at.y - p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  return hypot(px - t * x, py - t * y) <= s->near;
}

/* Whether another line passes by a loose end of a spur. */
static bool is_passed_by(const struct spur_search *s, uint32_t spur,
                         uint32_t end) {
  struct ink_point at = s->graph->node.item[spur_node(s, end)];
  const uint32_t *start = &s->in_cell.start[spur_cell_at(s, at)];
  for (uint32_t i = start[0]; i < start[1]; i++) {
    uint32_t segment = s->in_cell.item[i];
    if (s->of_segment[segment] != spur && is_near_place(s, segment, at))
      return true;
  }
  return false;
}

static bool find_passing(struct spur_search *s) {
  if (!make_spur_cells(s) || !list_segments(s))
    return false;
  for (uint32_t i = 0; i < s->spur.count; i++)
    for (int k = 0; k < 2 && poll_at(i); k++)
      s->spur.item[i].is_passed[k] =
          s->spur.item[i].end[k] == SEGMENT_GRAPH_NONE ||
          is_passed_by(s, i, s->spur.item[i].end[k]);
  return true;
}

/* ---- 3 What ends on them ------------------------------------------------- */

/* Whether a node is one of a spur's, or of none. */
static bool is_of_spur(const struct spur_search *s, uint32_t node,
                       uint32_t spur) {
  const struct number_lists *ends = &s->graph->ends;
  for (uint32_t i = ends->start[node]; i < ends->start[node + 1]; i++)
    if (s->of_segment[ends->item[i] >> 1] == spur)
      return true;
  return ends->start[node] == ends->start[node + 1];
}

/* Whether a node near a segment of a spur is its own. */
static bool is_own_node(void *user, uint32_t segment, uint32_t node) {
  const struct spur_search *s = user;
  uint32_t spur = s->of_segment[segment];
  return is_of_spur(s, node, spur);
}

static void find_met(struct spur_search *s, const struct node_rows *rows) {
  double near = s->step + 2 * TOLERANCE_COINCIDENT_UNITS;
  const struct node_search search = {s->graph, rows, (int32_t)ceil(near),
                                     is_own_node, s};
  for (uint32_t i = 0; i < s->graph->segment.count; i++)
    if (s->of_segment[i] != NO_SPUR && !nodes_near_segment_visit(&search, i))
      s->spur.item[s->of_segment[i]].is_met = true;
}

static bool leads_nowhere(const struct spur *spur) {
  return !spur->is_met &&
         (spur->is_long ? !spur->is_passed[0] && !spur->is_passed[1]
                        : !spur->is_passed[0] || !spur->is_passed[1]);
}

static void drop_spurs(const struct spur_search *s, uint8_t *drop) {
  for (size_t i = 0; i < s->graph->segment.count; i++)
    drop[i] = s->of_segment[i] != NO_SPUR &&
              leads_nowhere(&s->spur.item[s->of_segment[i]]);
}

bool segment_graph_find_short_spurs(const struct segment_graph *graph,
                                    const struct node_rows *rows,
                                    const struct sheet *sheet,
                                    const struct pens *pens, double step,
                                    uint8_t *drop) {
  struct spur_search s = {
      .graph = graph, .sheet = sheet, .pens = pens, .step = step};
  for (uint32_t pen = 0; pen < pens->count; pen++)
    s.near = fmax(s.near, pens_width_mm(pens, pen) / 2 * SHEET_UNITS_PER_MM);
  bool ok = find_spurs(&s);
  if (ok && s.spur.count > 0) {
    ok = mark_spurs(&s) && find_passing(&s);
    if (ok) {
      find_met(&s, rows);
      drop_spurs(&s, drop);
    }
  }
  ARRAY_FREE(&s.spur);
  mem_free(s.of_segment);
  mem_free(s.mark);
  mem_free(s.is_near);
  number_lists_fini(&s.in_cell);
  return ok;
}
