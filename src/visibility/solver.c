/* solver.c - the table of visibility methods. */
#include "visibility/solver.h"

#include <math.h>

#include "visibility/dense_edges.h"

static const struct solver *const table[] = {
    &solver_newell,  &solver_warnock,
    &solver_watkins, &solver_tiles,
    &solver_zbuffer, &solver_scanline_zbuffer,
    &solver_painter, &solver_painter_given,
    &solver_brute,   NULL};

/* Whether the lines are needed in which faces pierce each other: to be drawn,
 * or since smooth contours end at them. */
static bool needs_intersections(const recto_options *options) {
  return (options->ink.edges & RECTO_EDGE_INTERSECTION) ||
         ((options->ink.edges & RECTO_EDGE_SILHOUETTE) &&
          options->ink.contours == RECTO_CONTOURS_SMOOTH);
}

struct solver_request solver_request_of(const recto_options *options) {
  return (struct solver_request){
      .edges = options->ink.edges != RECTO_EDGES_NONE,
      .fragments = options->ink.fill != RECTO_FILL_NONE,
      .hidden = options->ink.hidden != RECTO_HIDDEN_NONE,
      .intersections = needs_intersections(options),
      .threads = 1,
      .pitch_mm = options->solver.pitch_mm,
      .resolution = options->solver.resolution,
      .depth_bits = options->solver.depth_bits,
      .remove_backs = options->solver.remove_backs,
      .divide_by_box = options->solver.divide == RECTO_DIVIDE_BOX,
      .subpixels = options->solver.subpixels,
  };
}

/* Half the width of the finest pen: what ink closes between lines. */
static double short_gap_of(const recto_options *options) {
  double finest = options->ink.pen_mm;
  for (size_t i = 0; i < options->ink.pen_count; i++)
    if (options->ink.pen[i].width_mm > 0)
      finest = fmin(finest, options->ink.pen[i].width_mm);
  return finest / 2 * SHEET_UNITS_PER_MM;
}

struct solver_request solver_request_to_draw(const recto_options *options) {
  struct solver_request request = solver_request_of(options);
  request.hidden |= (options->results & RECTO_RESULT_EDGES) != 0;
  if (!options->ink.exact && options->ink.min_stroke_mm != 0 &&
      options->ink.hidden == RECTO_HIDDEN_NONE && options->results == 0 &&
      options->verify == 0)
    request.short_gap = short_gap_of(options);
  return request;
}

recto_status solver_run(const struct solver *solver, struct sheet *sheet,
                        const struct solver_request *request, struct map *map,
                        struct report *report, recto_error *error) {
  bool needs_sides = solver->method != RECTO_METHOD_TILES || request->fragments;
  if (needs_sides && !sheet_find_sides(sheet))
    return error_memory(error);
  recto_status status = solver->solve(sheet, request, map, report, error);
  if (status == RECTO_OK)
    dense_edges_close_all(map, sheet, request->short_gap);
  return status;
}

const struct solver *const *solvers(void) { return table; }

const struct solver *solver_by_method(recto_method method) {
  for (size_t i = 0; table[i] != NULL; i++)
    if (table[i]->method == method)
      return table[i];
  return NULL;
}

bool solver_is_exact(const recto_options *o) {
  switch (o->solver.method) {
  case RECTO_METHOD_AUTO:
  case RECTO_METHOD_TILES:
  case RECTO_METHOD_BRUTE:
  case RECTO_METHOD_NEWELL:
    return true;
  case RECTO_METHOD_WATKINS:
    return o->solver.pitch_mm == 0;
  case RECTO_METHOD_WARNOCK:
    return o->solver.resolution == 0;
  default:
    return false;
  }
}
