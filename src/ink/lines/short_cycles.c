/* short_cycles.c - finds the creases that close short cycles in networks that
 * end free.
 *
 * Where a scan folds, rows of its triangles bend sharply to and fro, and all of
 * their sides are creases: a ladder along the fold.  What a draughtsman draws
 * is one line.  So creases are taken in the order of their sharpness, as by
 * Kruskal's algorithm, and one that closes a short cycle is left out. */
#include "ink/lines/segment_graph.h"

#include <math.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "ink/lines/crease_lines.h"
#include "ink/pens.h"

/* The nodes that a search for a cycle reaches, at most, and the segments at one
 * that it tries. */
enum { PLACES_MAX = 32, ENDS_MAX = 32 };

struct cycle_candidate {
  uint32_t segment;
  double cosine, length, longest; /* grid units; of the cycle */
};

struct cycle_search {
  const struct segment_graph *graph;
  uint8_t *is_absent; /* one a segment: dropped, or not yet taken */
  ARRAY(struct cycle_candidate) candidate;
};

/* ---- Candidates ---------------------------------------------------------- */

/* Whether an edge is a crease that ends free at its end k: at a vertex where no
 * other edge is drawable. */
static bool ends_free(const struct crease_lines *creases, size_t i, int k) {
  const struct sheet_edge *edge = &creases->sheet->edge.item[creases->edge[i]];
  return edge->edge_class == RECTO_EDGE_CREASE &&
         edge->point[k] < creases->sheet->vertex_count &&
         creases->at[edge->point[k]] == CREASE_END_ALONE;
}

static bool has_free_ends(const struct crease_lines *creases) {
  for (size_t i = 0; i < creases->count; i++)
    if (ends_free(creases, i, 0) || ends_free(creases, i, 1))
      return true;
  return false;
}

/* One a line, by its number: whether a crease ends free there.  Returns NULL
 * when memory ran out. */
static uint8_t *find_free_lines(const struct crease_lines *creases) {
  uint8_t *is_free = mem_calloc(creases->line_count + 1, 1);
  for (size_t i = 0; is_free != NULL && i < creases->count; i++) {
    (void)poll_at(i);
    for (int k = 0; k < 2; k++)
      if (ends_free(creases, i, k))
        is_free[creases->number[creases->end[2 * i + (size_t)k]]] = 1;
  }
  return is_free;
}

static double length_of_segment(const struct segment_graph *graph,
                                uint32_t segment) {
  const struct graph_segment *s = &graph->segment.item[segment];
  struct ink_point p = graph->node.item[s->node[0]];
  struct ink_point q = graph->node.item[s->node[1]];
  return hypot((double)q.x - p.x, (double)q.y - p.y);
}

/* Whether a segment is a visible crease, and so short that it may be left
 * out. */
static bool is_short_crease(const struct segment_graph *graph,
                            const struct sheet *sheet, const struct pens *pens,
                            uint32_t segment) {
  const struct graph_segment *s = &graph->segment.item[segment];
  if (graph_segment_is_hidden(s) ||
      (s->style_key & RECTO_EDGES_ALL) != RECTO_EDGE_CREASE)
    return false;
  const struct sheet_edge *edge = &sheet->edge.item[s->edge];
  uint32_t pen =
      pens_of_line(pens, edge->edge_class, sheet_edge_group(sheet, edge));
  return length_of_segment(graph, segment) <
         pens_shortest_crease_mm(pens, pen) * SHEET_UNITS_PER_MM;
}

/* Lists the short creases of lines of which some end is free, as is_absent. */
static bool list_creases_of_lines(struct cycle_search *c,
                                  const struct crease_lines *creases,
                                  const struct pens *pens,
                                  const uint8_t *is_free) {
  const struct sheet *sheet = creases->sheet;
  const struct segment_graph *graph = c->graph;
  struct large_face_normals normals = large_face_normals_start();
  for (uint32_t i = 0; i < graph->segment.count; i++) {
    const struct sheet_edge *edge =
        &sheet->edge.item[graph->segment.item[i].edge];
    if (!is_short_crease(graph, sheet, pens, i) ||
        !is_free[crease_line_of_point(creases, edge->point[0])])
      continue;
    uint32_t pen =
        pens_of_line(pens, edge->edge_class, sheet_edge_group(sheet, edge));
    struct cycle_candidate made = {
        i, crease_cosine(sheet, edge, &normals), length_of_segment(graph, i),
        pens_short_cycle_mm(pens, pen) * SHEET_UNITS_PER_MM};
    c->is_absent[i] = 1;
    if (!ARRAY_PUSH(&c->candidate, made))
      return false;
  }
  return true;
}

/* Lists none, and saves finding the lines, where no crease is short or none
 * ends free. */
static bool list_cycle_candidates(struct cycle_search *c,
                                  struct crease_lines *creases,
                                  const struct pens *pens, double crease_deg) {
  uint32_t first = 0, count = (uint32_t)c->graph->segment.count;
  while (first < count &&
         !is_short_crease(c->graph, creases->sheet, pens, first))
    first++;
  if (first == count)
    return true;
  if (!crease_lines_find_ends(creases))
    return false;
  if (!has_free_ends(creases))
    return true;
  uint8_t *is_free =
      crease_lines_join(creases, crease_deg) ? find_free_lines(creases) : NULL;
  bool ok = is_free != NULL && list_creases_of_lines(c, creases, pens, is_free);
  mem_free(is_free);
  return ok;
}

/* ---- Cycles -------------------------------------------------------------- */

/* A node that a search reached, and how far it is by way of segments. */
struct cycle_place {
  uint32_t node;
  double distance;
  bool done;
};

struct cycle_places {
  struct cycle_place item[PLACES_MAX];
  int count;
};

static double distance_of_nodes(const struct segment_graph *graph, uint32_t a,
                                uint32_t b) {
  struct ink_point p = graph->node.item[a], q = graph->node.item[b];
  return hypot((double)q.x - p.x, (double)q.y - p.y);
}

static void reach_node(struct cycle_places *places, uint32_t node,
                       double distance) {
  int i = 0;
  while (i < places->count && places->item[i].node != node)
    i++;
  if (i == PLACES_MAX)
    return;
  if (i == places->count)
    places->item[places->count++] = (struct cycle_place){node, distance, false};
  else
    places->item[i].distance = fmin(places->item[i].distance, distance);
}

/* Whether segments that are present lead from one end of a candidate to the
 * other, so that the cycle is short: Dijkstra's algorithm among few nodes. */
static bool closes_cycle(const struct cycle_search *c,
                         const struct cycle_candidate *candidate) {
  const struct segment_graph *graph = c->graph;
  const uint32_t *ends = graph->segment.item[candidate->segment].node;
  double most = candidate->longest - candidate->length;
  struct cycle_places places = {.count = 0};
  reach_node(&places, ends[0], 0);
  for (;;) {
    struct cycle_place *at = NULL;
    for (int i = 0; i < places.count; i++)
      if (!places.item[i].done &&
          (at == NULL || places.item[i].distance < at->distance))
        at = &places.item[i];
    if (at == NULL)
      return false;
    if (at->node == ends[1])
      return true;
    at->done = true;
    uint32_t first = graph->ends.start[at->node];
    uint32_t count = graph->ends.start[at->node + 1] - first;
    for (uint32_t i = first; i < first + count && i < first + ENDS_MAX; i++) {
      uint32_t segment = graph->ends.item[i] >> 1;
      const struct graph_segment *s = &graph->segment.item[segment];
      if (c->is_absent[segment] || (s->pen_key & 1))
        continue;
      uint32_t node = s->node[(graph->ends.item[i] & 1) ^ 1];
      double distance = at->distance + length_of_segment(graph, segment);
      if (distance + distance_of_nodes(graph, node, ends[1]) <= most)
        reach_node(&places, node, distance);
    }
  }
}

static int compare_sharpness(const void *a, const void *b, void *user) {
  const struct cycle_candidate *p = a, *q = b;
  (void)user;
  return (p->cosine > q->cosine) - (p->cosine < q->cosine);
}

bool segment_graph_find_short_cycles(const struct segment_graph *graph,
                                     struct crease_lines *creases,
                                     const struct pens *pens,
                                     const struct crease_angles *angles,
                                     uint8_t *drop) {
  struct cycle_search c = {.graph = graph, .is_absent = drop};
  bool ok = list_cycle_candidates(&c, creases, pens, angles->crease_deg) &&
            sort_stable(c.candidate.item, c.candidate.count,
                        sizeof *c.candidate.item, compare_sharpness, NULL);
  for (size_t i = 0; ok && i < c.candidate.count; i++) {
    (void)poll_at(i);
    drop[c.candidate.item[i].segment] = closes_cycle(&c, &c.candidate.item[i]);
  }
  ARRAY_FREE(&c.candidate);
  return ok;
}
