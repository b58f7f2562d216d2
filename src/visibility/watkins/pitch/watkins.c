/* watkins.c - Watkins' scan-line method at a pitch.
 *
 * Phases   The facets' edges are sorted into S by their first line.  Line by
 *          line from the top they become active (A) and divide the line into
 *          sample intervals; in each the visible facet is decided
 *          (watkins_interval.c).  Visible facets make spans, and spans of
 *          neighbouring lines between the same edges make trapezoids
 *          (trapezoids.h).  The ends of sample intervals make the visible
 *          intervals of edges: an edge that is drawn on one line and on the
 *          next is drawn in between.
 * Edges    A line represents half a pitch up and down, and an edge that ends
 *          between two lines is drawn to its end.  Nearly horizontal edges,
 *          wires and intersections of faces are sampled on the lines above
 *          and below (edge_sampling.h).
 * Cost     Linear in the sum of the edges' lines and in the intervals; memory
 *          linear in the scene and the visible spans.
 *
 * Source   [Watkins1970]; [Romney1969] for coherence; [Archuleta1972] for
 *          edges from the ends of sample intervals; [Rogers1985] ch. 4.
 */
#include "visibility/intersection/intersection.h"
#include "visibility/watkins/pitch/watkins.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "visibility/watkins/watkins_solver.h"

#define OPEN_NONE (-1)

/* ---- Edges --------------------------------------------------------------- */

/* The current run of consecutive lines on which an edge of the sheet is drawn,
 * from the top: [last, first]. */
struct visible_run {
  int32_t first, last;   /* first OPEN_NONE: no run is open */
  bool from_end, to_end; /* includes the edge's own first, last line */
};

/* The spans of a line. */
struct span_row {
  const struct watkins *watkins;
  watkins_spans span;
};

struct pitch_scan {
  const struct solver_request *request;
  struct watkins watkins;
  struct edge_sampling sampling;
  struct trapezoids trapezoids;
  struct visible_run *run; /* one an edge of the sheet */
  struct span_row row, above;
};

/* The facet visible at x (edge_sampling_seen_fn). */
static uint32_t facet_at_x(const void *user, double x) {
  const struct span_row *row = user;
  const struct watkins_span *facet_span = row->span.item;
  size_t i;
  LOWER_BOUND(i, 0, row->span.count, !(facet_span[i].x1 > x));
  if (i == row->span.count || facet_span[i].x0 > x)
    return SHEET_NONE;
  return row->watkins->facet.item[facet_span[i].facet].triangle;
}

/* The parameter of height y on an edge from y0 to y1, in parts. */
static uint32_t cell_at(double y, double y0, double y1) {
  double parts = (y - y0) / (y1 - y0) * (1 << EDGE_SAMPLING_BITS_MAX);
  if (!(parts > 0))
    return 0;
  return parts < 1 << EDGE_SAMPLING_BITS_MAX
             ? (uint32_t)(parts + 0.5)
             : (uint32_t)1 << EDGE_SAMPLING_BITS_MAX;
}

static double height_of(const struct pitch_scan *scan, uint32_t point) {
  const struct scan_grid *grid = &scan->watkins.table.grid;
  int64_t y = scan->watkins.sheet->point.item[point].y;
  return (double)(y * grid->den - grid->y_first) / (double)grid->y_step;
}

/* Stores the open run of an edge of the sheet, if there is one. */
static bool close_open_run(struct pitch_scan *scan, uint32_t side) {
  struct visible_run *open = &scan->run[side];
  const uint32_t *point = scan->watkins.sheet->edge.item[side].point;
  double y0 = height_of(scan, point[0]), y1 = height_of(scan, point[1]);
  double top = open->first + 1, bottom = open->last;
  struct sampled_run run = {.edge = side};
  if (open->first == OPEN_NONE)
    return true;
  if (open->from_end)
    top = fmax(y0, y1);
  if (open->to_end)
    bottom = fmin(y0, y1);
  run.first = cell_at(y0 < y1 ? bottom : top, y0, y1);
  run.past = cell_at(y0 < y1 ? top : bottom, y0, y1);
  open->first = OPEN_NONE;
  return run.first >= run.past ||
         edge_sampling_add(&scan->sampling, run, EDGE_SAMPLING_BITS_MAX);
}

/* Extends the runs of the edges drawn on the line, or opens them. */
static bool join_ends(struct pitch_scan *scan) {
  const struct watkins *watkins = &scan->watkins;
  int32_t line = watkins->table.line;
  for (size_t i = 0; i < watkins->shown.count; i++) {
    uint32_t e = watkins->shown.item[i];
    const struct watkins_edge *edge = &watkins->edge.item[e];
    int32_t left = watkins->table.edge.item[e].dy;
    struct visible_run *open = &scan->run[edge->side];
    if (open->first == OPEN_NONE || open->last > line + 1) {
      if (!close_open_run(scan, edge->side))
        return false;
      open->first = line;
      open->from_end = left == edge->lines;
    }
    open->last = line;
    open->to_end = left == 0;
  }
  return true;
}

static bool open_edges(struct pitch_scan *scan) {
  const struct watkins *watkins = &scan->watkins;
  size_t count = watkins->sheet->edge.count;
  uint8_t *followed = mem_calloc(count, 1);
  bool ok;
  scan->run = mem_alloc(count, sizeof *scan->run);
  ok = scan->run != NULL && followed != NULL;
  for (size_t e = 0; ok && e < count; e++)
    scan->run[e].first = OPEN_NONE;
  for (size_t e = 0; ok && e < watkins->edge.count; e++)
    if (watkins->edge.item[e].drawn)
      followed[watkins->edge.item[e].side] = 1;
  ok = ok && edge_sampling_init(&scan->sampling, watkins->sheet,
                                &watkins->table.grid, 0, 1, followed);
  mem_free(followed);
  return ok;
}

static bool finish_edges(struct pitch_scan *scan, struct map *map) {
  size_t count = scan->watkins.sheet->edge.count;
  for (size_t e = 0; e < count; e++)
    if (!close_open_run(scan, (uint32_t)e))
      return false;
  return edge_sampling_line(&scan->sampling, -1, facet_at_x, &scan->row,
                            NULL) &&
         edge_sampling_finish(&scan->sampling, map);
}

/* ---- Fragments ----------------------------------------------------------- */

static double between(double value, int64_t a, int64_t b) {
  double low = (double)(a < b ? a : b), high = (double)(a < b ? b : a);
  return value < low ? low : value > high ? high : value;
}

static bool has_face(const struct watkins *watkins,
                     const struct watkins_edge *edge, uint32_t face) {
  const struct watkins_facet *facet = watkins->facet.item;
  return facet[edge->facet[0]].face == face ||
         (edge->facet[1] != WATKINS_NONE && facet[edge->facet[1]].face == face);
}

/* The side of a span at x: along edge e of the table, or, WATKINS_NONE, along
 * the intersection of `face` with `other`. */
static struct span_side side_of_span(const struct watkins *watkins, uint32_t e,
                                     double x, uint32_t face, uint32_t other) {
  const struct scan_grid *grid = &watkins->table.grid;
  struct span_side side = {
      .key = SPAN_ALONE, .id = other, .side = MAP_SIDE_INTERSECTION};
  const struct watkins_edge *edge;
  const struct scan_edge *at;
  double upper, lower;
  side.x = side.upper = side.lower = scan_plane_x(grid, x);
  if (e == WATKINS_NONE)
    return side;
  edge = &watkins->edge.item[e];
  at = &watkins->table.edge.item[e];
  upper = scan_plane_x(grid, x - at->dx / 2);
  lower = scan_plane_x(grid, x + at->dx / 2);
  side.upper = between(upper, at->x0, at->x1);
  side.lower = between(lower, at->x0, at->x1);
  side.straight = side.upper == upper && side.lower == lower;
  side.key = e;
  side.id = edge->side;
  if (edge->side == SHEET_NONE)
    side.side = MAP_SIDE_CLIP;
  else if (has_face(watkins, edge, face))
    side.side = MAP_SIDE_EDGE;
  else
    side.side = MAP_SIDE_OCCLUDER;
  return side;
}

static uint32_t face_of(const struct watkins *watkins,
                        const struct watkins_span *facet_span) {
  return watkins->facet.item[facet_span->facet].face;
}

/* Makes one span of touching ones of facets of one face. */
static bool add_face_spans(struct pitch_scan *scan) {
  const struct watkins *watkins = &scan->watkins;
  const struct watkins_span *facet_span = watkins->span.item;
  size_t count = watkins->span.count;
  for (size_t i = 0, past; i < count; i = past) {
    uint32_t face = face_of(watkins, &facet_span[i]);
    struct span span = {.face = face};
    for (past = i + 1; past < count &&
                       facet_span[past].x0 == facet_span[past - 1].x1 &&
                       face_of(watkins, &facet_span[past]) == face;)
      past++;
    span.left =
        side_of_span(watkins, facet_span[i].left, facet_span[i].x0, face,
                     i > 0 ? face_of(watkins, &facet_span[i - 1]) : face);
    span.right = side_of_span(
        watkins, facet_span[past - 1].right, facet_span[past - 1].x1, face,
        past < count ? face_of(watkins, &facet_span[past]) : face);
    if (!trapezoids_add(&scan->trapezoids, watkins->table.line, &span))
      return false;
  }
  return true;
}

/* ---- Lines --------------------------------------------------------------- */

/* Processes a line.
 * here  does any edge cross it? */
static bool process_line(struct pitch_scan *scan, int32_t line, bool here) {
  struct watkins *watkins = &scan->watkins;
  watkins_spans free_spans = scan->above.span;
  scan->above.span = scan->row.span;
  scan->row.span = free_spans;
  scan->row.span.count = 0;
  if (here) {
    watkins_spans now = watkins->span;
    if ((scan->request->fragments && !add_face_spans(scan)) ||
        (scan->request->edges && !join_ends(scan)))
      return false;
    watkins->span = scan->row.span;
    scan->row.span = now;
  }
  return !scan->request->edges ||
         edge_sampling_line(&scan->sampling, line, facet_at_x,
                            line + 1 < watkins->table.grid.lines ? &scan->above
                                                                 : NULL,
                            &scan->row);
}

static recto_status scan_watkins_lines(struct pitch_scan *scan,
                                       recto_error *error) {
  struct progress progress = progress_of(scan->request, "visibility");
  struct watkins *watkins = &scan->watkins;
  int32_t lines = watkins->table.grid.lines;
  bool more;
  watkins->progress = &progress;
  if (!watkins_next(watkins, &more))
    return error_memory(error);
  for (int32_t line = lines; line-- > 0;) {
    bool here = more && watkins->table.line == line;
    if (!process_line(scan, line, here) ||
        (here && !watkins_next(watkins, &more)))
      return error_memory(error);
    progress.share = 1 - (double)line / lines;
    if (!progress_step(&progress, PROGRESS_LINE))
      return error_memory(error);
  }
  return RECTO_OK;
}

static void report_scan(const struct pitch_scan *scan, struct report *report) {
  const struct watkins *watkins = &scan->watkins;
  report_int(report, "watkins", "lines", watkins->table.grid.lines);
  report_int(report, "watkins", "intervals", watkins->counts.intervals);
  report_int(report, "watkins", "kept_by_coherence", watkins->counts.coherent);
  report_int(report, "watkins", "depth_comparisons",
             watkins->counts.comparisons);
  report_int(report, "watkins", "splits_by_intersection",
             watkins->counts.splits);
  if (scan->request->fragments) {
    report_int(report, "watkins", "spans", scan->trapezoids.count);
    report_count(report, "watkins", "trapezoids",
                 scan->trapezoids.trapezoid.count);
  }
}

static recto_status run_scan(struct pitch_scan *scan, const struct sheet *sheet,
                             const struct facets *facets,
                             const struct scan_grid *grid, struct map *map,
                             struct report *report, recto_error *error) {
  const struct solver_request *request = scan->request;
  recto_status status;
  if (!watkins_init(&scan->watkins, sheet, facets, grid) ||
      (request->edges && !open_edges(scan)) ||
      (request->fragments && !trapezoids_init(&scan->trapezoids, sheet, grid,
                                              scan->watkins.edge.count)))
    return error_memory(error);
  scan->watkins.sides = request->fragments;
  scan->row.watkins = scan->above.watkins = &scan->watkins;
  status = scan_watkins_lines(scan, error);
  if (status != RECTO_OK)
    return status;
  if ((request->edges && !finish_edges(scan, map)) ||
      (request->fragments && !trapezoids_finish(&scan->trapezoids, map)))
    return error_memory(error);
  report_scan(scan, report);
  return RECTO_OK;
}

recto_status watkins_solve_at_pitch(struct sheet *sheet,
                                    const struct solver_request *request,
                                    struct map *map, struct report *report,
                                    recto_error *error) {
  struct pitch_scan scan;
  struct facets facets = {0};
  struct scan_grid grid;
  recto_status status =
      intersection_find_everywhere(sheet, request, report, error);
  if (status == RECTO_OK)
    status = watkins_grid(&grid, sheet, request->pitch_mm, error);
  if (status != RECTO_OK)
    return status;
  memset(&scan, 0, sizeof scan);
  scan.request = request;
  if (facets_init(&facets, sheet))
    status = run_scan(&scan, sheet, &facets, &grid, map, report, error);
  else
    status = error_memory(error);
  watkins_fini(&scan.watkins);
  edge_sampling_fini(&scan.sampling);
  trapezoids_fini(&scan.trapezoids);
  mem_free(scan.run);
  ARRAY_FREE(&scan.row.span);
  ARRAY_FREE(&scan.above.span);
  facets_fini(&facets);
  return status;
}
