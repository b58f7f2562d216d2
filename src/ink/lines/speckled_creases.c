/* speckled_creases.c - finds the lines of creases that are noise by their
 * shape.
 *
 * Where a scan is rough, edges that bend by more than the crease angle by
 * chance touch each other, and form lines that branch, turn and end at every
 * few edges.  Each of their pieces alone would be left out as a short crease
 * that ends free.  Lines that are nowhere sharp have to be longer.
 *
 * Phases
 *   1 list what meets at the vertices
 *   2 join the edges of a line to pieces, which end where the line ends,
 *     branches or turns sharply
 *   3 sum up, for each line, how much of it is in short pieces
 * A line is what creases form on the mesh, whatever is seen of it, and a length
 * is one in space at the drawing's scale: the result hardly depends on the
 * view. */
#include "ink/lines/segment_graph.h"

#include <math.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/union_find.h"
#include "ink/lines/crease_lines.h"
#include "ink/pens.h"
#include "scene/angle.h"
#include "view/project.h"

/* A piece ends where its line turns by more than 45 degrees. */
#define PIECE_END_COSINE 0.70710678118654752

/* A line of more pieces for each of its free ends is a network: of a solid, for
 * instance, of which a crease fades out. */
enum { END_PIECES = 16 };

/* A line of fewer pieces may have few edges, as those of a roof have. */
enum { SHALLOW_PIECES = 4 };

/* What meets at an endpoint: edges by their places among those drawn as creases
 * or silhouettes (crease_lines.h). */
struct speckle_corner {
  uint32_t edge[2], creases; /* the first two, and how many there are */
};

struct speckle_line {
  double length, in_short; /* of all edges, of those in short pieces */
  double least;            /* the length of a line that is not sharp,
                                        at least; mm as those */
  double bend;             /* degrees, times mm */
  bool is_sharp;           /* an edge bends by more than a zigzag's */
  uint32_t edges, pieces, free_ends; /* how many there are */
};

struct speckle_search {
  const struct sheet *sheet;
  const struct crease_lines *creases;
  const struct pens *pens;
  struct projection projection;
  double crease, sharp; /* the cosines of the crease angle, that of zigzags */
  uint8_t *is_of_line;  /* one a listed edge */
  struct speckle_corner *corner; /* one an endpoint of these */
  uint32_t *piece;               /* a union-find of the listed edges */
  double *piece_mm;              /* one of these: of a piece's root */
  struct speckle_line *lines;    /* by number of the line; 0: none */
};

/* ---- Vertices ------------------------------------------------------------ */

static const struct sheet_edge *listed_edge(const struct speckle_search *s,
                                            size_t i) {
  return &s->sheet->edge.item[s->creases->edge[i]];
}

/* Finds which edges are of the line of a crease. */
static bool find_edges_of_range(void *user, struct parallel_range range) {
  const struct speckle_search *s = user;
  for (size_t i = range.begin; i < range.end; i++)
    s->is_of_line[i] =
        crease_is_joined(listed_edge(s, i), s->creases->cosine[i], s->crease);
  return true;
}

static bool is_vertex(const struct speckle_search *s, uint32_t endpoint) {
  return s->creases->point[endpoint] < s->sheet->vertex_count;
}

/* The endpoint at an end of a listed edge, of two each; SHEET_NONE: the edge is
 * of no line, or the end is no vertex. */
static uint32_t vertex_of_line(const struct speckle_search *s, size_t end) {
  uint32_t endpoint = s->creases->end[end];
  return s->is_of_line[end / 2] && is_vertex(s, endpoint) ? endpoint
                                                          : SHEET_NONE;
}

static void list_corners(const struct speckle_search *s) {
  for (size_t i = 0; i < 2 * s->creases->count; i++) {
    uint32_t vertex = vertex_of_line(s, i);
    (void)poll_at(i);
    if (vertex == SHEET_NONE)
      continue;
    struct speckle_corner *at = &s->corner[vertex];
    if (at->creases < 2)
      at->edge[at->creases] = (uint32_t)(i / 2);
    at->creases++;
  }
}

static bool find_line_corners(struct speckle_search *s) {
  size_t count = s->creases->count;
  s->is_of_line = mem_alloc(count, sizeof *s->is_of_line);
  s->corner = mem_calloc(s->creases->end_count, sizeof *s->corner);
  if (s->is_of_line == NULL || s->corner == NULL ||
      !parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, find_edges_of_range, s))
    return false;
  list_corners(s);
  return true;
}

/* Whether the end of a line is free at a vertex: no other edge is drawable
 * there. */
static bool is_free_corner(const struct speckle_search *s, uint32_t vertex) {
  return s->corner[vertex].creases == 1 &&
         s->creases->at[s->creases->point[vertex]] == CREASE_END_ALONE;
}

/* The other endpoint of a listed edge. */
static uint32_t other_endpoint(const struct speckle_search *s, uint32_t edge,
                               uint32_t from) {
  const uint32_t *end = &s->creases->end[2 * (size_t)edge];
  return end[0] == from ? end[1] : end[0];
}

/* The other one of the two creases that meet at the far end of a crease;
 * SHEET_NONE where there are not two. */
static uint32_t next_crease(const struct speckle_search *s, uint32_t edge,
                            uint32_t from) {
  uint32_t to = other_endpoint(s, edge, from);
  if (s->corner[to].creases != 2)
    return SHEET_NONE;
  return s->corner[to].edge[s->corner[to].edge[0] == edge];
}

/* Whether a vertex is on a line of three edges about a triangle. */
static bool is_on_triangle(const struct speckle_search *s, uint32_t vertex) {
  const struct speckle_corner *at = &s->corner[vertex];
  if (at->creases != 2)
    return false;
  uint32_t next = next_crease(s, at->edge[0], vertex);
  return next != SHEET_NONE && next == next_crease(s, at->edge[1], vertex);
}

/* Whether any line may be noise: none of a solid is. */
static bool has_candidates(const struct speckle_search *s) {
  for (size_t i = 0; i < 2 * s->creases->count; i++) {
    uint32_t vertex = vertex_of_line(s, i);
    if (vertex != SHEET_NONE &&
        (is_free_corner(s, vertex) || is_on_triangle(s, vertex)))
      return true;
  }
  return false;
}

/* ---- Pieces -------------------------------------------------------------- */

/* A vector in view space from one end of an edge to the other.
 * from  the endpoint where it starts */
static void edge_vector(const struct speckle_search *s, uint32_t edge,
                        uint32_t from, double vector[3]) {
  struct view_point p = s->creases->place[from],
                    q = s->creases->place[other_endpoint(s, edge, from)];
  vector[0] = q.x - p.x;
  vector[1] = q.y - p.y;
  vector[2] = q.d - p.d;
}

static double dot_product(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Whether a line goes on at a vertex where just two of its edges meet. */
static bool goes_on(const struct speckle_search *s, uint32_t vertex) {
  const struct speckle_corner *at = &s->corner[vertex];
  double a[3], b[3];
  edge_vector(s, at->edge[0], vertex, a);
  edge_vector(s, at->edge[1], vertex, b);
  return -dot_product(a, b) >=
         PIECE_END_COSINE * sqrt(dot_product(a, a) * dot_product(b, b));
}

static void join_pieces(const struct speckle_search *s) {
  for (size_t i = 0; i < 2 * s->creases->count; i++) {
    uint32_t vertex = vertex_of_line(s, i);
    if (vertex == SHEET_NONE)
      continue;
    const struct speckle_corner *at = &s->corner[vertex];
    if (at->creases == 2 && at->edge[0] == i / 2 && goes_on(s, vertex))
      union_find_join(s->piece, at->edge[0], at->edge[1]);
  }
}

/* The length of an edge in space at the scale that it is drawn at. */
static double length_mm(const struct speckle_search *s, uint32_t edge) {
  const struct projection *projection = &s->projection;
  uint32_t from = s->creases->end[2 * (size_t)edge];
  double v[3], d = projection->perspective ? s->creases->place[from].d : 1;
  edge_vector(s, edge, from, v);
  return sqrt(dot_product(v, v)) * projection->units / (d * SHEET_UNITS_PER_MM);
}

/* ---- Lines --------------------------------------------------------------- */

static void measure_pieces(const struct speckle_search *s) {
  for (uint32_t e = 0; e < s->creases->count; e++)
    if (s->is_of_line[e])
      s->piece_mm[union_find_root(s->piece, e)] += length_mm(s, e);
}

static void measure_lines(const struct speckle_search *s) {
  double degree = acos(-1) / 180;
  for (uint32_t e = 0; e < s->creases->count; e++) {
    const struct sheet_edge *edge = listed_edge(s, e);
    (void)poll_at(e);
    if (!s->is_of_line[e])
      continue;
    double cosine = s->creases->cosine[e];
    uint32_t pen = pens_of_line(s->pens, RECTO_EDGE_CREASE,
                                sheet_edge_group(s->sheet, edge));
    uint32_t piece = union_find_root(s->piece, e);
    struct speckle_line *of =
        &s->lines[s->creases->number[s->creases->end[2 * (size_t)e]]];
    double length = length_mm(s, e);
    of->length += length;
    of->bend += length * acos(fmax(-1, fmin(1, cosine))) / degree;
    of->least = fmax(of->least, pens_short_cycle_mm(s->pens, pen));
    of->is_sharp = of->is_sharp || cosine < s->sharp;
    of->edges++;
    of->pieces += piece == e;
    if (s->piece_mm[piece] < pens_shortest_crease_mm(s->pens, pen))
      of->in_short += length;
  }
  for (size_t i = 0; i < 2 * s->creases->count; i++) {
    uint32_t vertex = vertex_of_line(s, i);
    if (vertex != SHEET_NONE && is_free_corner(s, vertex))
      s->lines[s->creases->number[vertex]].free_ends++;
  }
}

/* Whether a line is that of a solid rather than one that ends free, or goes
 * around a single triangle. */
static bool is_network(const struct speckle_line *line) {
  return line->free_ends > 0
             ? (uint64_t)END_PIECES * line->free_ends < line->pieces
             : line->edges != 3;
}

static bool is_speckled(const struct speckle_line *line, double sharp_deg) {
  bool is_ragged = 2 * line->in_short > line->length &&
                   line->bend <= sharp_deg * line->length;
  bool is_branched =
      line->pieces >= SHALLOW_PIECES && 2 * line->pieces > line->edges;
  bool is_shallow =
      !line->is_sharp && (line->length < line->least || is_branched);
  return !is_network(line) && (is_ragged || is_shallow);
}

static bool is_crease_segment(const struct graph_segment *segment) {
  return (segment->style_key & RECTO_EDGES_ALL) == RECTO_EDGE_CREASE;
}

static void mark_speckled(const struct speckle_search *s,
                          const struct segment_graph *graph, double sharp_deg,
                          uint8_t *drop) {
  for (size_t i = 0; i < graph->segment.count; i++) {
    const struct graph_segment *segment = &graph->segment.item[i];
    const struct sheet_edge *edge = &s->sheet->edge.item[segment->edge];
    if (is_crease_segment(segment))
      drop[i] = is_speckled(
          &s->lines[crease_line_of_point(s->creases, edge->point[0])],
          sharp_deg);
  }
}

static bool has_creases(const struct segment_graph *graph) {
  for (size_t i = 0; i < graph->segment.count; i++)
    if (is_crease_segment(&graph->segment.item[i]))
      return true;
  return false;
}

/* Finds the lines, where some may be noise, and marks those that are. */
static bool find_and_mark(struct speckle_search *s,
                          const struct segment_graph *graph,
                          struct crease_lines *creases,
                          const struct crease_angles *angles, uint8_t *drop) {
  if (!crease_lines_find_ends(creases) || !crease_lines_measure(creases) ||
      !crease_lines_number_ends(creases) || !find_line_corners(s))
    return false;
  if (!has_candidates(s))
    return true;
  if (!crease_lines_join(creases, angles->crease_deg) ||
      !crease_lines_place_ends(creases))
    return false;
  s->piece = union_find_create(creases->count);
  s->piece_mm = mem_calloc(creases->count, sizeof *s->piece_mm);
  s->lines = mem_calloc(creases->line_count + 1, sizeof *s->lines);
  if (s->piece == NULL || s->piece_mm == NULL || s->lines == NULL)
    return false;
  join_pieces(s);
  measure_pieces(s);
  measure_lines(s);
  mark_speckled(s, graph, angles->zigzag_deg, drop);
  return true;
}

bool segment_graph_find_speckled(const struct segment_graph *graph,
                                 struct crease_lines *creases,
                                 const struct pens *pens,
                                 const struct crease_angles *angles,
                                 uint8_t *drop) {
  const struct sheet *sheet = creases->sheet;
  if (angles->zigzag_deg == 0 || sheet->scene == NULL || !has_creases(graph))
    return true;
  struct speckle_search s = {
      .sheet = sheet,
      .creases = creases,
      .pens = pens,
      .projection = projection_of(&sheet->camera),
      .crease = angle_of_degrees(angles->crease_deg).cosine,
      .sharp = angle_of_degrees(angles->zigzag_deg).cosine};
  bool ok = find_and_mark(&s, graph, creases, angles, drop);
  mem_free(s.is_of_line);
  mem_free(s.corner);
  mem_free(s.piece);
  mem_free(s.piece_mm);
  mem_free(s.lines);
  return ok;
}
