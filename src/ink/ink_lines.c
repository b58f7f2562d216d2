/* ink_lines.c - from the visible map to the strokes of lines, phase by phase.
 */
#include "ink/ink_lines.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/dash_pattern.h"
#include "ink/lines/crease_lines.h"
#include "ink/lines/paths.h"
#include "ink/lines/short_spurs.h"
#include "ink/lines/stroke.h"
#include "visibility/solver.h"

/* ---- Paths --------------------------------------------------------------- */

bool ink_is_tidied(const recto_options *options) {
  return !options->ink.exact && options->ink.min_stroke_mm != 0;
}

/* The output's step, in grid units. */
static double output_step(const recto_options *options) {
  return options->output.unit_mm * SHEET_UNITS_PER_MM;
}

/* The step up to which lines are one before any are left out. */
static double tidy_step(const recto_options *options) {
  return ink_is_tidied(options) ? TOLERANCE_TIDY_MM * SHEET_UNITS_PER_MM
                                : output_step(options);
}

/* Keeps one of the lines that are one up to a step. */
static recto_status drop_overlaps(struct segment_graph *graph,
                                  const struct node_rows *rows, double step,
                                  recto_error *error) {
  recto_status status =
      segment_graph_separate_isolated(graph, rows, step, error);
  if (status == RECTO_OK)
    status = segment_graph_drop_collinear(graph, rows, error);
  if (status == RECTO_OK)
    status = segment_graph_drop_output_overlaps(graph, rows, step, error);
  if (status == RECTO_OK)
    status = segment_graph_merge_isolated(graph, error);
  return status;
}

/* Builds the segment graph without overlaps, its ends indexed. */
static recto_status make_graph(struct ink *ink, struct segment_graph *graph,
                               struct node_rows *rows, recto_error *error) {
  struct drawing_counts *counts = &ink->drawing->counts;
  recto_status status = segment_graph_collect(graph, ink->sheet, ink->map,
                                              ink->pens, ink->options, error);
  counts->segments = graph->segment.count - graph->dots;
  if (status == RECTO_OK)
    status = segment_graph_unite(graph, rows, error);
  if (status == RECTO_OK)
    status = drop_overlaps(graph, rows, tidy_step(ink->options), error);
  if (status == RECTO_OK && ink_is_tidied(ink->options))
    status = segment_graph_close_gaps(graph, rows, ink->pens, error);
  counts->without_length = graph->dots;
  return status;
}

static struct crease_angles angles_of(const recto_options *options) {
  return (struct crease_angles){options->mesh.crease_deg,
                                pens_crease_start_deg(options),
                                pens_zigzag_start_deg(options)};
}

/* Joins the segments into cleaned polylines.
 * path_of_segment  see paths_chain */
static recto_status make_paths(struct ink *ink, struct ink_paths *paths,
                               uint32_t *path_of_segment,
                               const struct segment_graph *graph,
                               recto_error *error) {
  double step = fmax(output_step(ink->options), tidy_step(ink->options));
  recto_status status = paths_chain(paths, path_of_segment, graph, error);
  bool tidy = ink_is_tidied(ink->options);
  const struct crease_angles angles = angles_of(ink->options);
  if (status == RECTO_OK && tidy &&
      !(paths_find_free_ends(paths, graph, ink->sheet, ink->dropped, step) &&
        paths_find_weak(paths, graph, ink->creases, &angles)))
    status = error_memory(error);
  if (status != RECTO_OK)
    return status;
  if (tidy)
    paths_find_zigzags(paths, ink->sheet, ink->pens, &angles);
  paths_find_continued(paths, graph);
  paths_straighten(paths, step);
  if (ink->options->ink.simplify_mm > 0)
    status = paths_simplify(
        paths, ink->options->ink.simplify_mm * SHEET_UNITS_PER_MM, error);
  if (status == RECTO_OK && tidy &&
      !paths_find_covered(paths, ink->sheet, ink->pens))
    status = error_memory(error);
  return status;
}

/* ---- Strokes ------------------------------------------------------------- */

/* The stroke of a path, without its points. */
static struct drawing_stroke stroke_like(const struct ink *ink,
                                         const struct ink_path *path) {
  const struct sheet_edge *edge = &ink->sheet->edge.item[path->edge];
  uint32_t group = sheet_edge_group(ink->sheet, edge);
  uint32_t layer =
      path->hidden
          ? pens_of_hidden(ink->pens, ink->options, edge->edge_class, group)
          : pens_of_line(ink->pens, edge->edge_class, group);
  return (struct drawing_stroke){.layer = layer,
                                 .face = sheet_edge_face(ink->sheet, edge),
                                 .edge = edge->source,
                                 .group = group,
                                 .edge_class = edge->edge_class,
                                 .hidden = path->hidden};
}

static struct drawing_point point_mm(const struct ink *ink,
                                     struct ink_point p) {
  return (struct drawing_point){sheet_x_mm(ink->sheet, p.x),
                                sheet_y_mm(ink->sheet, p.y)};
}

static bool copy_points(const struct ink *ink, const struct ink_paths *paths,
                        const struct ink_path *path, struct stroke_line *line) {
  line->closed = path->closed;
  memcpy(line->is_continued, path->is_continued, sizeof line->is_continued);
  line->point.count = 0;
  if (!ARRAY_RESERVE(&line->point, path->count))
    return false;
  for (uint32_t i = 0; i < path->count; i++) {
    struct ink_point p = paths->point.item[path->point + i];
    line->point.item[line->point.count++] = point_mm(ink, p);
  }
  return true;
}

static bool is_too_short(const struct ink *ink, const struct ink_path *path,
                         const struct stroke_line *line) {
  uint32_t layer = stroke_like(ink, path).layer;
  double length = stroke_line_length(line);
  return path->is_covered || length < pens_shortest_line_mm(ink->pens, layer) ||
         path->is_weak ||
         (path->is_free && length < pens_shortest_crease_mm(ink->pens, layer));
}

static bool add_drawn_path(struct ink *ink, const struct ink_path *path,
                           const struct stroke_line *line) {
  struct drawing_stroke like = stroke_like(ink, path);
  struct dash_pattern pattern =
      dash_pattern_of(ink->options, ink->drawing, &like);
  if (pattern.count > 0)
    return stroke_add_dashed(ink->drawing, &like, line, &pattern);
  return stroke_add(ink->drawing, &like, line->point.item, line->point.count,
                    line->closed);
}

/* Counts a path that is too short or covered, and keeps it if it is visible. */
static bool drop_path(struct ink *ink, const struct ink_path *path,
                      const struct stroke_line *line) {
  struct drawing *drawing = ink->drawing;
  struct drawing_stroke stroke = stroke_like(ink, path);
  ++*(path->is_covered ? &drawing->counts.covered : &drawing->counts.too_short);
  if (path->hidden)
    return true;
  return stroke_add_dropped(drawing, &stroke, line->point.item,
                            line->point.count, line->closed);
}

/* Which paths are too short. */
struct short_search {
  const struct ink *ink;
  const struct ink_paths *paths;
  uint8_t *is_short; /* one a path */
};

static bool find_short_range(void *user, struct parallel_range range) {
  const struct short_search *search = user;
  struct stroke_line line = {0};
  bool ok = true;
  for (size_t i = range.begin; ok && i < range.end; i++) {
    const struct ink_path *path = &search->paths->path.item[i];
    ok = copy_points(search->ink, search->paths, path, &line);
    search->is_short[i] = ok && is_too_short(search->ink, path, &line);
  }
  ARRAY_FREE(&line.point);
  return ok;
}

/* One byte a path; NULL when memory ran out or the caller cancelled. */
static uint8_t *find_short_paths(const struct ink *ink,
                                 const struct ink_paths *paths) {
  size_t count = paths->path.count;
  struct short_search search = {ink, paths, mem_alloc(count, 1)};
  if (search.is_short == NULL ||
      parallel_ranges(parallel_workers(count, PATHS_IN_RANGE), count,
                      PATHS_IN_RANGE, find_short_range, &search))
    return search.is_short;
  mem_free(search.is_short);
  return NULL;
}

/* Adds the paths as strokes; with `filter` those that are too short are left
 * out. */
static bool add_paths(struct ink *ink, const struct ink_paths *paths,
                      bool filter) {
  struct stroke_line line = {0};
  uint8_t *is_short = filter ? find_short_paths(ink, paths) : NULL;
  bool ok = (!filter || is_short != NULL) &&
            ARRAY_RESERVE(&ink->drawing->point, paths->point.count) &&
            ARRAY_RESERVE(&ink->drawing->stroke, paths->path.count);
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    const struct ink_path *path = &paths->path.item[i];
    ok = poll_at(i) && copy_points(ink, paths, path, &line);
    ok = ok &&
         (filter && is_short[i] ? drop_path : add_drawn_path)(ink, path, &line);
  }
  ARRAY_FREE(&line.point);
  mem_free(is_short);
  return ok;
}

/* ---- Strokes of one source ----------------------------------------------- */

/* Sets drop[i] to 1 for each segment i of a path that is too short. */
static bool mark_short(struct ink *ink, const struct ink_paths *paths,
                       const uint32_t *path_of_segment, size_t segments,
                       uint8_t *drop) {
  struct stroke_line line = {0};
  uint8_t *is_short = find_short_paths(ink, paths);
  bool ok = is_short != NULL;
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    const struct ink_path *path = &paths->path.item[i];
    ok = poll_at(i) && (!is_short[i] || (copy_points(ink, paths, path, &line) &&
                                         drop_path(ink, path, &line)));
  }
  for (size_t i = 0; ok && i < segments; i++)
    drop[i] = is_short[path_of_segment[i]];
  mem_free(is_short);
  ARRAY_FREE(&line.point);
  return ok;
}

/* Drops the segments of lines that are too short.  With ids a stroke is a
 * piece of one source, and by groups one of a group: a long line may consist of
 * many short strokes.  So the length that counts is that of the line as it is
 * drawn without these. */
static recto_status drop_short_lines(struct ink *ink,
                                     struct segment_graph *graph,
                                     recto_error *error) {
  struct ink_paths whole = {0};
  size_t count = graph->segment.count;
  uint32_t *path_of_segment = mem_alloc(count, sizeof *path_of_segment);
  uint8_t *drop = mem_alloc(count, sizeof *drop);
  recto_status status =
      path_of_segment != NULL && drop != NULL ? RECTO_OK : error_memory(error);
  if (status == RECTO_OK)
    status = make_paths(ink, &whole, path_of_segment, graph, error);
  if (status == RECTO_OK &&
      !mark_short(ink, &whole, path_of_segment, count, drop))
    status = error_memory(error);
  if (status == RECTO_OK)
    status = segment_graph_drop_segments(graph, drop, error);
  paths_fini(&whole);
  mem_free(path_of_segment);
  mem_free(drop);
  return status;
}

/* Keeps a segment that was dropped with the drawing, if it is visible. */
static bool drop_segment(struct ink *ink, const struct segment_graph *graph,
                         const struct graph_segment *segment) {
  const struct ink_path path = {.edge = segment->edge};
  struct drawing_stroke stroke = stroke_like(ink, &path);
  const struct drawing_point end[2] = {
      point_mm(ink, graph->node.item[segment->node[0]]),
      point_mm(ink, graph->node.item[segment->node[1]])};
  ++ink->drawing->counts.too_short;
  if (stroke.edge_class == RECTO_EDGE_CREASE)
    ink->dropped[segment->edge] = 1;
  return graph_segment_is_hidden(segment) ||
         stroke_add_dropped(ink->drawing, &stroke, end, 2, false);
}

/* Drops the segments i with drop[i] != 0. */
static recto_status drop_marked(struct ink *ink, struct segment_graph *graph,
                                const uint8_t *drop, recto_error *error) {
  size_t count = graph->segment.count, drops = 0;
  for (size_t i = 0; i < count; i++)
    drops += drop[i];
  if (drops == 0)
    return RECTO_OK;
  if (ink->dropped == NULL)
    ink->dropped = mem_calloc(ink->sheet->edge.count, 1);
  bool ok = ink->dropped != NULL;
  for (size_t i = 0; ok && i < count; i++)
    ok = !drop[i] || drop_segment(ink, graph, &graph->segment.item[i]);
  return ok ? segment_graph_drop_segments(graph, drop, error)
            : error_memory(error);
}

/* Drops the segments of creases that a search finds. */
static recto_status drop_creases(
    struct ink *ink, struct segment_graph *graph,
    bool (*find)(const struct segment_graph *, struct crease_lines *,
                 const struct pens *, const struct crease_angles *, uint8_t *),
    recto_error *error) {
  const struct crease_angles angles = angles_of(ink->options);
  uint8_t *drop = mem_calloc(graph->segment.count, 1);
  bool ok = drop != NULL && find(graph, ink->creases, ink->pens, &angles, drop);
  recto_status status =
      ok ? drop_marked(ink, graph, drop, error) : error_memory(error);
  mem_free(drop);
  return status;
}

/* Drops short silhouettes that lead nowhere, if lines that they may lead to are
 * drawn, and are whole. */
static recto_status drop_short_spurs(struct ink *ink,
                                     struct segment_graph *graph,
                                     const struct node_rows *rows,
                                     recto_error *error) {
  if ((ink->options->ink.edges & RECTO_EDGES_DEFAULT) != RECTO_EDGES_DEFAULT ||
      !solver_is_exact(ink->options))
    return RECTO_OK;
  bool smooth = ink->options->ink.contours == RECTO_CONTOURS_SMOOTH;
  uint8_t *drop = mem_calloc(graph->segment.count, 1);
  bool ok = drop != NULL && segment_graph_find_short_spurs(
                                graph, rows, ink->sheet, ink->pens,
                                tidy_step(ink->options), smooth, drop);
  recto_status status =
      ok ? drop_marked(ink, graph, drop, error) : error_memory(error);
  mem_free(drop);
  return status;
}

static bool keep_gap_ends(struct ink *ink, const struct segment_graph *graph) {
  for (size_t i = 0; i < graph->gap_end.count; i++)
    if (!ARRAY_PUSH(&ink->drawing->gap_end,
                    point_mm(ink, graph->gap_end.item[i])))
      return false;
  return true;
}

/* Leaves out lines that a pen shows as noise. */
static recto_status tidy(struct ink *ink, struct segment_graph *graph,
                         const struct node_rows *rows, recto_error *error) {
  recto_status status =
      drop_creases(ink, graph, segment_graph_find_speckled, error);
  if (status == RECTO_OK)
    status = drop_creases(ink, graph, segment_graph_find_short_cycles, error);
  if (status == RECTO_OK)
    status = drop_short_spurs(ink, graph, rows, error);
  return status;
}

/* Drops overlaps again, at the output's step. */
static recto_status coarsen(struct segment_graph *graph,
                            const struct node_rows *rows, double step,
                            recto_error *error) {
  segment_graph_set_gaps_apart(graph);
  recto_status status = drop_overlaps(graph, rows, step, error);
  return status == RECTO_OK ? segment_graph_merge_gaps(graph, error) : status;
}

/* Makes the graph that is drawn, at the output's step.  What is left out of a
 * tidied drawing is decided at a step that is the same for all outputs. */
static recto_status prepare_graph(struct ink *ink, struct segment_graph *graph,
                                  recto_error *error) {
  struct node_rows rows = {0};
  double step = output_step(ink->options);
  recto_status status = make_graph(ink, graph, &rows, error);
  if (status == RECTO_OK && !keep_gap_ends(ink, graph))
    status = error_memory(error);
  if (status == RECTO_OK && ink_is_tidied(ink->options))
    status = tidy(ink, graph, &rows, error);
  if (status == RECTO_OK && step > tidy_step(ink->options))
    status = coarsen(graph, &rows, step, error);
  ink->drawing->counts.drawn_twice = graph->doubled;
  node_rows_fini(&rows);
  return status;
}

recto_status ink_lines_add(struct ink *ink, recto_error *error) {
  bool ids = ink->options->ink.ids;
  bool by_groups =
      ids || (ink->drawing->by_groups && ink->scene->group.count > 1);
  struct segment_graph graph;
  struct ink_paths paths = {0};
  struct crease_lines creases = {.sheet = ink->sheet};
  ink->creases = &creases;
  segment_graph_init(&graph);
  recto_status status = prepare_graph(ink, &graph, error);
  if (status == RECTO_OK && by_groups && ink->options->ink.min_stroke_mm != 0)
    status = drop_short_lines(ink, &graph, error);
  if (status == RECTO_OK && ids)
    status = segment_graph_key_by_source(&graph, ink->sheet, error);
  else if (status == RECTO_OK && by_groups)
    segment_graph_key_by_group(&graph, ink->sheet);
  if (status == RECTO_OK)
    status = make_paths(ink, &paths, NULL, &graph, error);
  crease_lines_fini(&creases);
  ink->creases = NULL;
  segment_graph_fini(&graph);
  if (status == RECTO_OK && !add_paths(ink, &paths, !by_groups))
    status = error_memory(error);
  paths_fini(&paths);
  return status;
}
