/* pixels.c - from the finished lines of a pixel frame to the visible map.
 *
 * Fragments: neighbouring pixels of one scene face make a span; its sides are
 * borders of pixels, cuts of the method (MAP_SIDE_CLIP). */
#include "visibility/intersection/intersection.h"
#include "visibility/raster/pixels.h"

#include <math.h>
#include <string.h>

/* The topmost line that a facet covers, or -1 where it covers none. */
static int32_t top_line(const struct raster *raster,
                        const struct facets *facets, uint32_t facet) {
  const uint32_t *corner, *side;
  int32_t low = INT32_MAX, high = 0;
  uint32_t count = facet_outline(facets, raster->sheet, facet, &corner, &side);
  for (uint32_t k = 0; k < count; k++) {
    int32_t line = raster->pixel_of[corner[k]].line;
    if (line < low)
      low = line;
    if (line > high)
      high = line;
  }
  return low == high ? -1 : high - 1;
}

struct sort_key *pixels_buckets(const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request,
                                size_t *count) {
  const struct sheet *sheet = raster->sheet;
  uint32_t all = (uint32_t)sheet->triangle.count;
  int left_out = SHEET_EDGE_ON | (request->remove_backs ? SHEET_FLIPPED : 0);
  struct sort_key *key = mem_alloc(2 * (size_t)all, sizeof *key);
  *count = 0;
  if (key == NULL)
    return NULL;
  for (uint32_t t = 0; t < all; t++) {
    int32_t top;
    if ((sheet->triangle_flags[t] & left_out) || facet_of(facets, t) != t)
      continue;
    top = top_line(raster, facets, t);
    if (top >= 0)
      key[(*count)++] =
          (struct sort_key){(uint64_t)(raster->grid.lines - 1 - top), t};
  }
  sort_keys(key, key + *count, *count);
  return key;
}

/* One byte a sheet edge: 1 where all its faces are back faces and so removed,
 * the edge with them.  NULL when memory ran out. */
static uint8_t *find_backs(const struct sheet *sheet) {
  uint8_t *skip = mem_calloc(sheet->edge.count, 1);
  for (size_t e = 0; skip != NULL && e < sheet->edge.count; e++) {
    const uint32_t *triangle = sheet->edge.item[e].triangle;
    skip[e] = triangle[0] != SHEET_NONE &&
              (sheet->triangle_flags[triangle[0]] & SHEET_FLIPPED) &&
              (triangle[1] == SHEET_NONE ||
               (sheet->triangle_flags[triangle[1]] & SHEET_FLIPPED));
  }
  return skip;
}

static bool init_sampling(struct pixels *pixels) {
  const struct raster *raster = pixels->raster;
  double step = raster->depth_bits > 0 ? 1 / raster->level_scale : 1;
  uint8_t *skip = NULL;
  bool ok = true;
  if (pixels->request->remove_backs)
    ok = (skip = find_backs(raster->sheet)) != NULL;
  ok = ok && edge_sampling_init(&pixels->sampling, raster->sheet, &pixels->grid,
                                0.5, step, skip);
  mem_free(skip);
  return ok;
}

/* End with free_pixels either way. */
static recto_status init_pixels(struct pixels *pixels,
                                const struct raster *raster, int subpixels,
                                const struct solver_request *request,
                                recto_error *error) {
  const struct sheet *sheet = raster->sheet;
  memset(pixels, 0, sizeof *pixels);
  pixels->raster = raster;
  pixels->request = request;
  pixels->progress = progress_of(request, "visibility");
  pixels->grid = raster_grid(sheet, raster->grid.lines / subpixels);
  pixels->subpixels.k = subpixels;
  pixels->above =
      mem_alloc((size_t)pixels->grid.columns, sizeof *pixels->above);
  if (pixels->above == NULL ||
      (subpixels > 1 &&
       !subpixels_init(&pixels->subpixels, subpixels, raster->grid.columns,
                       pixels->grid.columns)) ||
      (request->edges && !init_sampling(pixels)) ||
      (request->fragments &&
       !trapezoids_init(&pixels->trapezoids, sheet, &pixels->grid,
                        (size_t)pixels->grid.columns)))
    return error_memory(error);
  return RECTO_OK;
}

static void free_pixels(struct pixels *pixels) {
  edge_sampling_fini(&pixels->sampling);
  trapezoids_fini(&pixels->trapezoids);
  subpixels_fini(&pixels->subpixels);
  mem_free(pixels->above);
}

struct pixel_row {
  const uint32_t *seen; /* as in a raster */
  int32_t columns;
};

static uint32_t facet_in_column(const void *user, double x) {
  const struct pixel_row *row = user;
  double column = floor(x);
  if (column < 0)
    column = 0;
  if (column > row->columns - 1)
    column = row->columns - 1;
  return raster_facet(row->seen[(int32_t)column]);
}

static struct span_side side_of_column(const struct scan_grid *grid,
                                       int32_t column) {
  double x = scan_plane_x(grid, column);
  return (struct span_side){
      x, x, x, true, (uint32_t)column, SHEET_NONE, MAP_SIDE_CLIP};
}

static bool add_pixel_spans(struct pixels *pixels, int32_t line,
                            const struct pixel_row *row) {
  const struct scan_grid *grid = &pixels->grid;
  const struct sheet_triangle *triangle = pixels->raster->sheet->triangle.item;
  for (int32_t c = 0, past; c < row->columns; c = past) {
    struct span span;
    past = c + 1;
    if (row->seen[c] == 0)
      continue;
    span.face = triangle[raster_facet(row->seen[c])].face;
    while (past < row->columns && row->seen[past] != 0 &&
           triangle[raster_facet(row->seen[past])].face == span.face)
      past++;
    span.left = side_of_column(grid, c);
    span.right = side_of_column(grid, past);
    if (!trapezoids_add(&pixels->trapezoids, line, &span))
      return false;
  }
  return true;
}

/* Samples the edges between the line above, if there is one, and this one, if
 * there is one. */
static bool sample_edges(struct pixels *pixels, int32_t line,
                         const struct pixel_row *row) {
  const struct scan_grid *grid = &pixels->grid;
  const struct pixel_row above = {pixels->above, grid->columns};
  if (!edge_sampling_line(&pixels->sampling, line, facet_in_column,
                          line + 1 < grid->lines ? &above : NULL, row))
    return false;
  if (row != NULL)
    memcpy(pixels->above, row->seen, (size_t)grid->columns * sizeof *row->seen);
  return true;
}

recto_status pixels_line(struct pixels *pixels, int32_t line,
                         recto_error *error) {
  const struct raster *raster = pixels->raster;
  const struct solver_request *request = pixels->request;
  struct subpixels *subpixels = &pixels->subpixels;
  int32_t done = raster->grid.lines - line;
  struct pixel_row row = {raster->seen + raster_row(raster, line),
                          pixels->grid.columns};
  bool whole =
      subpixels->k == 1 || subpixels_add_line(subpixels, line, row.seen);
  if (subpixels->k > 1) {
    line /= subpixels->k;
    row.seen = subpixels->pixel;
  }
  if (whole && ((request->edges && !sample_edges(pixels, line, &row)) ||
                (request->fragments && !add_pixel_spans(pixels, line, &row))))
    return error_memory(error);
  return progress_step_at(&pixels->progress, PROGRESS_LINE, (size_t)done,
                          (size_t)raster->grid.lines)
             ? RECTO_OK
             : error_memory(error);
}

/* The share of the frame's sub-pixels that see a face. */
static double covered_share(const struct pixels *pixels) {
  const struct scan_grid *grid = &pixels->grid;
  double k = pixels->subpixels.k;
  return (double)pixels->subpixels.covered /
         (k * k * grid->columns * grid->lines);
}

/* Writes the map, and the frame's size to `section` of the report. */
static recto_status finish_pixels(struct pixels *pixels, struct map *map,
                                  struct report *report, const char *section,
                                  recto_error *error) {
  if ((pixels->request->edges &&
       (!sample_edges(pixels, -1, NULL) ||
        !edge_sampling_finish(&pixels->sampling, map))) ||
      (pixels->request->fragments &&
       !trapezoids_finish(&pixels->trapezoids, map)))
    return error_memory(error);
  report_int(report, section, "lines", pixels->grid.lines);
  report_int(report, section, "columns", pixels->grid.columns);
  if (pixels->subpixels.k > 1) {
    report_int(report, section, "subpixels", pixels->subpixels.k);
    report_double(report, section, "covered_share", covered_share(pixels));
  }
  return RECTO_OK;
}

recto_status pixels_store(const struct raster *raster, int subpixels,
                          const struct solver_request *request, struct map *map,
                          struct report *report, const char *section,
                          recto_error *error) {
  struct pixels pixels;
  recto_status status = init_pixels(&pixels, raster, subpixels, request, error);
  for (int32_t line = raster->grid.lines; line-- > 0 && status == RECTO_OK;)
    status = pixels_line(&pixels, line, error);
  if (status == RECTO_OK)
    status = finish_pixels(&pixels, map, report, section, error);
  free_pixels(&pixels);
  return status;
}

recto_status pixels_solve(struct sheet *sheet,
                          const struct solver_request *request, bool whole,
                          pixels_draw_fn *draw, const char *section,
                          struct map *map, struct report *report,
                          recto_error *error) {
  struct raster raster = {0};
  struct facets facets = {0};
  struct pixels pixels = {0};
  int64_t covered = 0;
  int lines;
  recto_status status =
      intersection_find_everywhere(sheet, request, report, error);
  if (status == RECTO_OK)
    status = subpixels_lines(request, &lines, error);
  if (status == RECTO_OK)
    status =
        raster_init(&raster, sheet, lines, request->depth_bits, whole, error);
  if (status == RECTO_OK && !facets_init(&facets, sheet))
    status = error_memory(error);
  if (status == RECTO_OK)
    status =
        init_pixels(&pixels, &raster, subpixels_of(request), request, error);
  if (status == RECTO_OK)
    status = draw(&raster, &facets, request, &pixels, &covered, error);
  if (status == RECTO_OK)
    status = finish_pixels(&pixels, map, report, section, error);
  if (status == RECTO_OK) {
    report_int(report, section, "depth_bits", request->depth_bits);
    report_int(report, section, "pixels_covered", covered);
  }
  free_pixels(&pixels);
  raster_fini(&raster);
  facets_fini(&facets);
  return status;
}
