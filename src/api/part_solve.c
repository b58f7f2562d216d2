/* part_solve.c - solves the scene of a part, and writes the part.
 *
 * Phases
 *   edges    of the scene; whether corners there might be welded
 *   solve    on the page grid of the whole
 *   collect  what lies in the window
 *   save     to a file */
#include "api/part_solve.h"

#include "api/part_check.h"
#include "base/parallel.h"
#include "base/stream.h"
#include "parts/part_collect.h"
#include "parts/part_common.h"
#include "parts/part_file.h"
#include "parts/side_marks.h"
#include "scene/weld/doubled_faces.h"
#include "scene/weld/slits.h"
#include "scene/weld/thin_faces.h"
#include "view/layout.h"
#include "visibility/quantitative_invisibility.h"
#include "visibility/solver.h"

/* Whether an undivided drawing would leave out faces of the part's scene as
 * they have no width, or close slits of it.  Returns false when memory ran
 * out. */
static bool find_slits(struct part_solve *work, bool *has_slits) {
  const struct scene *scene = &work->scene.scene;
  struct precision unstated = work->part.common.camera.unstated;
  uint64_t *thin;
  size_t faces;
  slit_points points = {.item = NULL};
  bool ok = thin_faces_find(scene, &work->topology, unstated, &thin, &faces) &&
            slits_find(scene, &work->topology, unstated, &points);
  *has_slits = faces > 0 || points.count > 0;
  mem_free(thin);
  ARRAY_FREE(&points);
  return ok;
}

/* Whether it would leave out faces that are listed twice. */
static bool find_doubled(struct part_solve *work, bool *has_doubled) {
  uint64_t *doubled;
  size_t count;
  bool ok =
      doubled_faces_find(&work->scene.scene, &work->topology, &doubled, &count);
  *has_doubled = count > 0;
  mem_free(doubled);
  return ok;
}

/* Refuses what parts cannot weld. */
static recto_status check_welding(struct part_solve *work, recto_error *error) {
  bool may_weld, has_slits = false, has_doubled = false;
  if (!part_scene_may_weld(&work->scene, &work->topology, work->weld,
                           &may_weld) ||
      (work->weld > 0 &&
       !(find_slits(work, &has_slits) && find_doubled(work, &has_doubled))))
    return error_memory(error);
  if (may_weld)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "corners of borders lie within %.3g of each other, which "
                     "parts cannot weld: make the parts, or their plan, with "
                     "--weld 0, which leaves them apart",
                     work->weld);
  if (has_slits)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "there are faces without width, or corners on sides of "
                     "other faces, whose slits parts cannot close: make the "
                     "parts, or their plan, with --weld 0, which leaves them "
                     "open");
  if (has_doubled)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "faces are listed twice, and parts cannot leave one of "
                     "them out: make the parts, or their plan, with --weld 0, "
                     "which draws all of their edges");
  return RECTO_OK;
}

/* Finds the edges. */
static recto_status find_part_edges(struct part_solve *work,
                                    recto_error *error) {
  recto_status status =
      topology_init(&work->topology, &work->scene.scene, error);
  if (status == RECTO_OK &&
      !side_marks_apply(work->scene.crease_mark, &work->topology,
                        &work->scene.scene))
    status = error_memory(error);
  return status == RECTO_OK ? check_welding(work, error) : status;
}

static recto_status solve_part_scene(struct part_solve *work,
                                     recto_error *error) {
  const recto_options *o = work->options;
  recto_options lower = *o; /* of two angles of creases: part_join_edges.c */
  lower.mesh.crease_start_deg = 0;
  lower.ink.edges = part_common_classes(&work->part.common);
  struct solver_request request = solver_request_of(&lower);
  const char *why;
  recto_status status =
      layout_sheet(&work->sheet, &work->scene.scene, &work->topology,
                   &work->part.common.camera, &lower,
                   work->part.common.has_fragments, error);
  if (status != RECTO_OK)
    return status;
  request.fragments = work->part.common.has_fragments;
  request.threads = parallel_threads();
  work->map.keeps_side_lines = true;
  const struct solver *solver =
      o->solver.method == RECTO_METHOD_AUTO
          ? solver_choose(&work->sheet, &request, &why)
          : solver_by_method(o->solver.method);
  struct report *report = report_create();
  status = solver->solve(&work->sheet, &request, &work->map, report, error);
  if (status == RECTO_OK && part_hidden_by_max(o) > 0 &&
      work->map.edge_state != NULL)
    status = quantitative_invisibility_find(
        &work->map, &work->sheet, o->ink.hidden_by_max, false, report, error);
  report_destroy(report);
  return status;
}

static recto_status collect_part(struct part_solve *work, recto_error *error) {
  const struct part_sources sources = {.scene = &work->scene,
                                       .topology = &work->topology,
                                       .sheet = &work->sheet,
                                       .map = &work->map,
                                       .tone = work->tones.corner,
                                       .uniform = work->tones.uniform};
  return part_collect(&work->part, &sources, error);
}

recto_status part_solve_run(struct part_solve *work, recto_error *error) {
  recto_status status = find_part_edges(work, error);
  if (status != RECTO_OK || scene_face_count(&work->scene.scene) +
                                    scene_wire_count(&work->scene.scene) ==
                                0)
    return status;
  status = solve_part_scene(work, error);
  return status == RECTO_OK ? collect_part(work, error) : status;
}

recto_status part_solve_save(struct part_solve *work, const char *path,
                             const struct file_identity *file, size_t files,
                             const char *what, recto_error *error) {
  struct byte_array bytes = {.item = NULL};
  struct stream *stream = NULL;
  recto_status status = part_file_make(&work->part, &bytes, error);
  if (status == RECTO_OK)
    status = stream_open(&stream, path, error);
  for (size_t i = 0; status == RECTO_OK && i < files; i++)
    if (stream_replaces(stream, file[i]))
      status = error_set(error, RECTO_ERROR_ARGUMENT, path, 0,
                         "the part would replace the %s", what);
  if (status == RECTO_OK) {
    stream_write(stream, bytes.item, bytes.count);
    status = stream_finish(stream, error);
  } else {
    stream_discard(stream);
  }
  ARRAY_FREE(&bytes);
  return status;
}

bool part_solve_find(const char *path, uint32_t index, uint64_t *id) {
  struct input input = {.bytes = NULL};
  struct part part;
  struct file_identity file;
  bool is_there = false;
  /* Reading a pipe would wait for its other end. */
  if (path_identity(path, &file) &&
      input_load(&input, path, NULL) == RECTO_OK &&
      part_file_parse(&part, input.bytes, input.count, path, NULL) ==
          RECTO_OK) {
    is_there = part.index == index;
    *id = part.common.id;
    part_fini(&part);
  }
  input_unload(&input);
  return is_there;
}

void part_solve_fini(struct part_solve *work) {
  map_fini(&work->map);
  sheet_fini(&work->sheet);
  topology_fini(&work->topology);
  part_scene_fini(&work->scene);
  part_tones_fini(&work->tones);
  part_fini(&work->part);
}
