/* render.c - draws a view: runs and times the stages one after the other.
 *
 * Phases
 *   rescale a scene of extreme size, weld the corners of borders and find the
 *   edges, unless that was prepared (preparation.h);
 *   aim the camera; lay out the sheet; choose the method and solve;
 *   count the faces that hide each line, and add smooth contours, if requested;
 *   make the ink; verify, and keep results, if requested. */
#include <limits.h>
#include <math.h>

#include "api/captions.h"
#include "api/clip_warning.h"
#include "api/contour_fit.h"
#include "api/group_numbers.h"
#include "api/handle.h"
#include "api/method.h"
#include "api/output_format.h"
#include "api/render.h"
#include "api/render_contours.h"
#include "api/render_warnings.h"
#include "api/result.h"
#include "api/rounded_warning.h"
#include "api/shares.h"
#include "api/stats.h"
#include "api/visible_part.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "ink/cut_hatch.h"
#include "ink/ink.h"
#include "ink/pens.h"
#include "visibility/quantitative_invisibility.h"
#include "visibility/solver.h"

/* The results of the stages; zero-initialised is empty. */
struct render {
  const struct render_request *request;
  const recto_scene *model;
  const recto_options *options;
  struct preparation own;             /* empty where the scene has one */
  const struct preparation *prepared; /* that one, or its own */
  recto_options scaled;               /* its lengths as those of that scene */
  struct topology topology; /* owned unless the preparation is shared */
  struct camera camera;
  struct smooth_surface surface; /* where it is known before the contours */
  struct smooth_curves *curves;  /* of it; NULL: none are begun */
  struct visible_part visible;
  struct sheet sheet;
  struct face_sizes sizes; /* of the faces that were laid out */
  size_t triangles;        /* of the sheet, also once they are dropped */
  struct page_overflow overflow;
  struct map map;
  recto_drawing *made;
  struct drawing *drawing; /* in it */
  struct report *report;
};

/* ---- Stages -------------------------------------------------------------- */

static bool has_fills(const struct render *render) {
  return render->options->ink.fill != RECTO_FILL_NONE ||
         cut_hatch_is_drawn(render->options);
}

static bool needs_fragments(const struct render *render) {
  return has_fills(render) || (render->options->results & RECTO_RESULT_FACES);
}

static bool draws_smooth_contours(const struct render *render) {
  return contour_fit_has_contours(render->options);
}

/* Whether the scene's edges are used after the sheet was laid out. */
static bool uses_topology(const struct render *render) {
  return has_fills(render) || draws_smooth_contours(render) ||
         render->topology.crease_mark != NULL || render->options->ink.ids ||
         render->options->results != 0;
}

/* Whether the edges of sides are: of fills, by hatching. */
static bool uses_corners(const struct render *render) {
  return render->options->ink.fill == RECTO_FILL_HATCH ||
         cut_hatch_is_drawn(render->options) || draws_smooth_contours(render) ||
         render->options->results != 0;
}

static bool keeps_invisibility(const struct render *render) {
  return (render->options->results & RECTO_RESULT_INVISIBILITY) ==
         RECTO_RESULT_INVISIBILITY;
}

static bool is_shared(const struct render *render) {
  return render->prepared != &render->own;
}

static void drop_topology(struct render *render) {
  if (!is_shared(render))
    topology_fini(&render->topology);
}

static void report_preparation(const struct render *render) {
  const struct preparation *prepared = render->prepared;
  struct report *report = render->report;
  report_double(report, "scene", "weld",
                ldexp(prepared->welded.length, prepared->rescaled.exponent));
  report_count(report, "scene", "welded_points", prepared->welded.joined);
  report_count(report, "scene", "welded_faces", prepared->welded.lost);
  report_count(report, "scene", "edges", render->topology.edge.count);
  if (prepared->planes > 0) {
    report_count(report, "cut", "faces",
                 scene_face_count(prepared->scene) -
                     prepared->cut.made.first_face);
    report_count(report, "cut", "open_lines", prepared->cut.open);
  }
}

/* Takes what was prepared for the scene, where it serves, or prepares it.  The
 * topology is lent by a shared preparation, else taken, to be freed early. */
static recto_status find_topology(struct render *render, recto_error *error) {
  const recto_options *o = render->options;
  const struct preparation *shared = render->request->prepared;
  bool uses_sides = needs_fragments(render) || draws_smooth_contours(render);
  recto_status status = RECTO_OK;
  if (shared != NULL && preparation_is_valid_for(shared, o)) {
    render->prepared = shared;
    render->topology = shared->topology;
  } else {
    status = preparation_init(
        &render->own, &render->model->scene, o,
        uses_sides ? PREPARATION_FOR_VIEW : PREPARATION_FOR_LINES, error);
    render->topology = render->own.topology;
    render->own.topology = (struct topology){.corner_edge = NULL};
  }
  render->scaled = *o;
  if (status == RECTO_OK)
    status = preparation_rescale(render->prepared, &render->scaled, error);
  if (status != RECTO_OK)
    return status;
  report_preparation(render);
  warn_of_borders(o, render->model->path, render->prepared, &render->topology);
  warn_of_open_cut(o, render->model->path, render->prepared);
  if (render->prepared->welded.lost > 0 &&
      scene_face_count(render->prepared->scene) == 0 &&
      scene_wire_count(render->prepared->scene) == 0)
    return error_set(error, RECTO_ERROR_EMPTY, NULL, 0,
                     "there is nothing to draw: the weld length is larger than "
                     "all faces");
  render->topology.drop_sides = !needs_fragments(render);
  render->topology.drop_corners = !uses_sides && !is_shared(render);
  render->topology.drop_edges = !uses_topology(render) && !is_shared(render) &&
                                scene_wire_count(render->prepared->scene) == 0;
  return status;
}

static recto_status aim(struct render *render, recto_error *error) {
  recto_status status =
      contour_fit_aim(&render->camera, &render->surface, render->prepared,
                      &render->topology, &render->scaled, error);
  if (status != RECTO_OK)
    return status;
  for (int k = 0; k < 2; k++)
    render->camera.middle_mm[k] += render->request->shift_mm[k];
  drawing_store_projection(render->made, &render->camera,
                           &render->prepared->rescaled);
  report_doubles(render->report, "camera", "model_to_page_mm",
                 render->made->matrix, 12);
  report_double(
      render->report, "camera", "contact_max",
      ldexp(render->camera.contact_most, render->prepared->rescaled.exponent));
  return RECTO_OK;
}

static recto_status project_scene(struct render *render, recto_error *error) {
  recto_status status = visible_part_layout(
      &render->visible, &render->sheet, render->prepared->scene,
      &render->topology, &render->camera, &render->scaled,
      needs_fragments(render), render->report, error);
  if (status == RECTO_OK && (render->sheet.clipped_page > 0 ||
                             scene_wire_count(render->prepared->scene) > 0))
    status = page_overflow_measure(&render->overflow, render->prepared->scene,
                                   &render->topology, &render->camera,
                                   &render->scaled, error);
  render->triangles = render->sheet.triangle.count;
  /* Only cut faces are filled. */
  if (render->options->ink.fill == RECTO_FILL_NONE &&
      !(render->options->results & RECTO_RESULT_FACES) &&
      render->prepared->scene->cut != NULL)
    render->sheet.first_filled = render->prepared->scene->cut->first_face;
  if (!render->visible.is_part)
    render->sizes = render->topology.face_sizes;
  if (!uses_topology(render)) {
    render->sheet.topology = NULL;
    drop_topology(render);
  } else if (!uses_corners(render) && !is_shared(render)) {
    topology_drop_corners(&render->topology);
  }
  return status;
}

static struct smooth_curves_input curves_input(struct render *render) {
  return render_contours_input(&render->sheet, &render->surface,
                               &render->topology, render->options);
}

static recto_status solve_visibility(struct render *render,
                                     recto_error *error) {
  const recto_options *options = render->options;
  const struct smooth_curves_input curves = curves_input(render);
  if (draws_smooth_contours(render))
    render->curves = smooth_curves_begin(&curves);
  struct solver_request request = solver_request_to_draw(options);
  request.fragments = needs_fragments(render);
  request.threads = parallel_threads();
  return solver_run(method_choose(options->solver.method, &render->sheet,
                                  &request, render->report),
                    &render->sheet, &request, &render->map, render->report,
                    error);
}

static recto_status find_invisibility(struct render *render,
                                      recto_error *error) {
  const recto_options *options = render->options;
  bool has_limit = options->ink.hidden != RECTO_HIDDEN_NONE &&
                   options->ink.hidden_by_max > 0;
  if (!has_limit && !keeps_invisibility(render))
    return RECTO_OK;
  return quantitative_invisibility_find(
      &render->map, &render->sheet,
      has_limit ? options->ink.hidden_by_max : INT_MAX,
      keeps_invisibility(render), render->report, error);
}

static recto_status add_smooth_contours(struct render *render,
                                        recto_error *error) {
  const struct smooth_curves_input input = curves_input(render);
  return draws_smooth_contours(render)
             ? render_contours_add(&render->map, &render->curves, &input,
                                   render->options, render->report, error)
             : RECTO_OK;
}

static recto_status ink(struct render *render, recto_error *error) {
  if (!needs_fragments(render) && render->options->verify == 0 &&
      !sheet_drop_triangles(&render->sheet))
    return error_memory(error);
  output_adapt_drawing(render->drawing, render->options);
  return ink_draw(render->drawing, &render->sheet, render->prepared->scene,
                  &render->map, render->options, error);
}

static recto_status verify(struct render *render, recto_error *error) {
  if (render->options->verify == 0)
    return RECTO_OK;
  const struct preparation *prepared = render->prepared;
  const struct verify what = {.scene = prepared->scene,
                              .exponent = prepared->rescaled.exponent,
                              .prepared =
                                  prepared->planes > 0 ? prepared : NULL,
                              .camera = &render->camera,
                              .sheet = &render->sheet,
                              .map = &render->map,
                              .drawing = render->drawing,
                              .options = &render->scaled};
  recto_status status =
      verify_drawing(&what, render->report, &render->made->verified, error);
  if (status == RECTO_OK)
    verify_summarise(render->made->verdict, &render->made->verified);
  return status;
}

static recto_status keep_results(struct render *render, recto_error *error) {
  unsigned results = render->options->results;
  const struct result_sources sources = {
      .sheet = &render->sheet,
      .map = &render->map,
      .topology = &render->topology,
      .scene = render->prepared->scene,
      .exponent = render->prepared->rescaled.exponent,
      .options = &render->scaled,
      .crease_deg = render->options->mesh.crease_deg,
      .with_counts = keeps_invisibility(render)};
  recto_status status = RECTO_OK;
  if (results & RECTO_RESULT_EDGES && render->map.edge_state != NULL)
    status = drawing_store_edges(render->made, &sources, error);
  if (status == RECTO_OK && results & RECTO_RESULT_FACES)
    status = drawing_store_faces(render->made, &sources, error);
  return status;
}

static const struct stage {
  const char *name;
  const char *cpu, *wall; /* names in the report */
  enum share_stage stage;
  recto_status (*run)(struct render *render, recto_error *error);
} stages[] = {
    {"topology", "topology_cpu_s", "topology_wall_s", SHARE_TOPOLOGY,
     find_topology},
    {"camera", "camera_cpu_s", "camera_wall_s", SHARE_CAMERA, aim},
    {"sheet", "sheet_cpu_s", "sheet_wall_s", SHARE_SHEET, project_scene},
    {"solve", "solve_cpu_s", "solve_wall_s", SHARE_SOLVE, solve_visibility},
    {"invisibility", "invisibility_cpu_s", "invisibility_wall_s",
     SHARE_INVISIBILITY, find_invisibility},
    {"contours", "contours_cpu_s", "contours_wall_s", SHARE_CONTOURS,
     add_smooth_contours},
    {"ink", "ink_cpu_s", "ink_wall_s", SHARE_INK, ink},
    {"verify", "verify_cpu_s", "verify_wall_s", SHARE_VERIFY, verify},
    {"results", "results_cpu_s", "results_wall_s", SHARE_RESULTS, keep_results},
};

static recto_status run_stages(struct render *render, recto_error *error) {
  double begin[SHARE_STAGES + 1]; /* shares of the work: see shares.h */
  shares_plan(begin, render->options);
  for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
    const struct stage *stage = &stages[i];
    double from = begin[stage->stage], to = begin[stage->stage + 1];
    if (to > from && !poll_stage(from, to, stage->name))
      return error_cancelled(error);
    double cpu = clock_cpu(), wall = clock_wall();
    recto_status status = stage->run(render, error);
    stats_add_seconds(render->report, stage->cpu, clock_cpu() - cpu);
    stats_add_seconds(render->report, stage->wall, clock_wall() - wall);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

/* ---- The whole render ---------------------------------------------------- */

/* Reports errors in the lists of pens, and warns of unused ones. */
static recto_status check_pens(const struct render *render,
                               recto_error *error) {
  struct pens pens;
  recto_status status =
      pens_init(&pens, &render->model->scene, render->options, error);
  recto_options given = *render->options;
  if (render->request->others_hide && given.ink.hidden == RECTO_HIDDEN_NONE)
    given.ink.hidden = RECTO_HIDDEN_DASHED;
  if (status == RECTO_OK)
    pens_warn_unused(&pens, &given);
  if (status == RECTO_OK)
    status = cut_hatch_check(&render->model->scene, render->options, error);
  pens_fini(&pens);
  return status;
}

/* Warns of what is seldom intended, and reports what was drawn. */
static void warn_and_report(const struct render *render) {
  bool is_outside = render->triangles == 0 && render->sheet.edge.count == 0;
  if (!render->request->may_be_empty) {
    warn_of_empty_page(render->options, render->drawing, is_outside);
    warn_of_tiny_drawing(render->options, render->drawing);
    pens_warn_absent(&render->sheet, render->options);
  }
  warn_of_near_plane(
      render->options, (unsigned long)render->sheet.cut_near,
      ldexp(render->camera.near_d, render->prepared->rescaled.exponent));
  clipped_report(&render->overflow, render->report);
  if (!is_outside)
    clipped_warn(&render->overflow,
                 has_fills(render) ? render->sheet.clipped_page : 0,
                 render->camera.margin_mm, render->options);
  stats_add_sheet(render->report, &render->sheet, render->triangles);
  stats_add_work(render->report, &render->sheet, &render->map,
                 render->triangles);
  stats_add_drawing(render->report, render->drawing, render->options);
  report_count(render->report, "memory", "peak_bytes", mem_peak_bytes());
}

static recto_status run_and_report(struct render *render, recto_error *error) {
  recto_status status = method_check(render->options, error);
  if (status == RECTO_OK)
    status = check_pens(render, error);
  if (status != RECTO_OK)
    return status;
  stats_add_scene(render->report, render->model);
  double cpu = clock_cpu(), wall = clock_wall();
  map_init(&render->map);
  render->prepared = &render->own;
  status = run_stages(render, error);
  if (status == RECTO_OK) {
    const struct scene *scene = render->prepared->scene;
    if (!captions_set(render->drawing, render->model->path, render->options) ||
        (render->drawing->ids &&
         !group_numbers_set(render->drawing, scene,
                            &render->prepared->welded.scene,
                            render->sheet.topology)) ||
        !rounded_warn(render->drawing,
                      visible_part_scene(&render->visible, scene),
                      &render->sizes, render->options))
      status = error_memory(error);
    source_numbers_set(render->drawing, scene);
    stats_add_seconds(render->report, "render_cpu_s", clock_cpu() - cpu);
    stats_add_seconds(render->report, "render_wall_s", clock_wall() - wall);
    warn_and_report(render);
  }
  smooth_curves_end(render->curves);
  map_fini(&render->map);
  (void)poll_now();
  sheet_fini(&render->sheet);
  smooth_surface_fini(&render->surface);
  visible_part_fini(&render->visible);
  drop_topology(render);
  (void)poll_now();
  preparation_fini(&render->own);
  return poll_is_cancelled() ? error_cancelled(error) : status;
}

/* Keeps the identities of the files that the drawing must not replace. */
static bool keep_files(recto_drawing *drawing, const struct scene *scene) {
  for (size_t i = 0; i < scene->file.count; i++)
    if (!ARRAY_PUSH(&drawing->file, scene->file.item[i]))
      return false;
  return true;
}

recto_status render_view(recto_drawing **drawing,
                         const struct render_request *request,
                         recto_error *error) {
  *drawing = NULL;
  recto_drawing *made = mem_calloc(1, sizeof *made);
  if (made == NULL)
    return error_memory(error);
  drawing_init(&made->drawing);
  made->report = report_create();
  struct render render = {.request = request,
                          .model = request->scene,
                          .options = request->options,
                          .made = made,
                          .drawing = &made->drawing,
                          .report = made->report};
  struct poll poll;
  poll_open(&poll, request->options);
  recto_status status = run_and_report(&render, error);
  poll_close(&poll);
  if (status == RECTO_OK && !keep_files(made, &request->scene->scene))
    status = error_memory(error);
  if (status != RECTO_OK) {
    recto_drawing_destroy(made);
    return status;
  }
  *drawing = made;
  return RECTO_OK;
}
