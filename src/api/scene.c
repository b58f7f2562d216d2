/* scene.c - the functions of a scene's handle: building it, and reading files
 * into it. */
#include <math.h>
#include <string.h>

#include "api/handle.h"
#include "api/options.h"
#include "api/shares.h"
#include "base/clock.h"
#include "scene/limit.h"
#include "scene/read.h"
#include "scene/read_passes.h"

recto_status recto_scene_create(recto_scene **scene, recto_error *error) {
  if (scene == NULL)
    return error_null(error, "the scene");
  *scene = mem_calloc(1, sizeof **scene);
  if (*scene == NULL)
    return error_memory(error);
  scene_init(&(*scene)->scene);
  return RECTO_OK;
}

void recto_scene_destroy(recto_scene *scene) {
  if (scene == NULL)
    return;
  scene_drop_preparation(scene);
  scene_fini(&scene->scene);
  mem_free(scene->path);
  mem_free(scene->format);
  mem_free(scene);
}

/* ---- Preparation --------------------------------------------------------- */

void scene_drop_preparation(recto_scene *scene) {
  if (scene->prepared != NULL)
    preparation_fini(scene->prepared);
  mem_free(scene->prepared);
  scene->prepared = NULL;
}

recto_status recto_scene_prepare(recto_scene *scene,
                                 const recto_options *options,
                                 recto_error *error) {
  recto_options own;
  if (scene == NULL)
    return error_null(error, "the scene");
  recto_status status = options_copy_valid(&own, options, error);
  if (status != RECTO_OK)
    return status;
  scene_drop_preparation(scene);
  scene->prepared = mem_calloc(1, sizeof *scene->prepared);
  if (scene->prepared == NULL)
    return error_memory(error);
  struct poll poll;
  shares_open_poll(&poll, &own, SHARE_TOPOLOGY, "topology");
  own.camera.has_section = false; /* each view has its own */
  status = preparation_init(scene->prepared, &scene->scene, &own,
                            PREPARATION_FOR_VIEWS, error);
  poll_close(&poll);
  if (status != RECTO_OK)
    scene_drop_preparation(scene);
  return status;
}

/* ---- Adding -------------------------------------------------------------- */

void scene_add_faults(recto_scene *scene,
                      const struct diagnostics *diagnostics) {
  for (int i = 0; i < SCENE_FAULT_COUNT; i++)
    scene->fault[i] += diagnostics->count[i];
}

/* Keeps the path of the only file read, for warnings about the whole scene;
 * drops it where it is not the only one.  Owns the path from then on. */
static void keep_path(recto_scene *scene, char *path) {
  if (scene->read_before) {
    mem_free(scene->path);
    mem_free(path);
    path = NULL;
  }
  scene->read_before = true;
  scene->path = path;
}

/* Reads a file, or bytes from memory where they are not NULL. */
static recto_status read_model(recto_scene *scene, const void *bytes,
                               size_t count, const char *path,
                               const char *format, const recto_options *options,
                               recto_error *error) {
  recto_options own;
  recto_status status = options_copy(&own, options, error);
  if (status != RECTO_OK)
    return status;
  char *kept = mem_copy_text(path);
  if (kept == NULL)
    return error_memory(error);
  struct diagnostics diagnostics = {
      .file = path, .warning = own.warning, .user = own.user};
  const double *up = own.camera.up;
  scene->scene.needs_colours = own.ink.fill == RECTO_FILL_PAINT;
  scene->scene.needs_crease_marks =
      own.mesh.crease_marks != RECTO_CREASE_MARKS_NONE;
  scene->scene.keeps_unit = own.camera.unit_mm > 0;
  scene->scene.keeps_up = up[0] != 0 || up[1] != 0 || up[2] != 0;
  scene_drop_preparation(scene);
  double cpu = clock_cpu(), wall = clock_wall();
  struct poll poll;
  shares_open_poll(&poll, &own, SHARE_READ, "read");
  status = bytes == NULL
               ? scene_read(&scene->scene, path, format, &diagnostics, error)
               : scene_read_memory(&scene->scene, bytes, count, path, format,
                                   &diagnostics, error);
  poll_close(&poll);
  scene->read_cpu += clock_cpu() - cpu;
  scene->read_wall += clock_wall() - wall;
  if (status != RECTO_OK) {
    mem_free(kept);
    return status;
  }
  scene_add_faults(scene, &diagnostics);
  keep_path(scene, kept);
  return RECTO_OK;
}

recto_status recto_scene_read(recto_scene *scene, const char *path,
                              const char *format, const recto_options *options,
                              recto_error *error) {
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  return read_model(scene, NULL, 0, path, format, options, error);
}

recto_status recto_scene_read_for_parts(recto_scene *scene, const char *path,
                                        const char *format,
                                        const recto_options *options,
                                        recto_error *error) {
  struct read_passes *passes = NULL;
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  if (!scene->read_before && scene->scene.point.count == 0) {
    recto_status status = read_passes_open(&passes, path, format, 0, error);
    if (status != RECTO_OK)
      return status;
  }
  if (passes == NULL)
    return recto_scene_read(scene, path, format, options, error);
  char *kept = mem_copy_text(path);
  char *named = format != NULL ? mem_copy_text(format) : NULL;
  if (kept == NULL || (format != NULL && named == NULL) ||
      !ARRAY_PUSH(&scene->scene.file, read_passes_file(passes))) {
    read_passes_close(passes);
    mem_free(kept);
    mem_free(named);
    return error_memory(error);
  }
  read_passes_close(passes);
  scene_drop_preparation(scene);
  scene->is_deferred = true;
  scene->format = named;
  keep_path(scene, kept);
  return RECTO_OK;
}

recto_status recto_scene_read_memory(recto_scene *scene, const void *bytes,
                                     size_t count, const char *format,
                                     const char *name,
                                     const recto_options *options,
                                     recto_error *error) {
  if (scene == NULL || (bytes == NULL && count > 0))
    return error_null(error, scene == NULL ? "the scene" : "the bytes");
  if (name == NULL && format == NULL)
    return error_null(error, "the format");
  return read_model(scene, bytes != NULL ? bytes : "", count,
                    name != NULL ? name : "", format, options, error);
}

recto_status recto_scene_add_point(recto_scene *scene, const double xyz[3],
                                   uint32_t *index, recto_error *error) {
  if (scene == NULL || xyz == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the point");
  if (!isfinite(xyz[0]) || !isfinite(xyz[1]) || !isfinite(xyz[2]))
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a point is not finite");
  scene_drop_preparation(scene);
  if (scene->scene.point.count >= SCENE_LIMIT)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "the scene has more than 2^31 points");
  recto_status status =
      scene_leave_precision(&scene->scene, scene->scene.point.count, error);
  if (status != RECTO_OK)
    return status;
  struct scene_point point = {xyz[0], xyz[1], xyz[2]};
  if (!ARRAY_PUSH(&scene->scene.point, point))
    return error_memory(error);
  if (index != NULL)
    *index = (uint32_t)(scene->scene.point.count - 1);
  return RECTO_OK;
}

recto_status recto_scene_add_group(recto_scene *scene, const char *name,
                                   recto_error *error) {
  if (scene == NULL || name == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the name");
  scene_drop_preparation(scene);
  return scene_use_group(&scene->scene, name, strlen(name), error);
}

/* Checks corners given by the caller: an element that in a file would be
 * skipped with a warning is a wrong argument here. */
static recto_status check_corners(const recto_scene *scene,
                                  const uint32_t *corner, size_t count,
                                  size_t least, recto_error *error) {
  if (scene == NULL || corner == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the corners");
  if (count < least)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "too few corners: %zu of at least %zu", count, least);
  for (size_t i = 0; i < count; i++)
    if (corner[i] >= scene->scene.point.count)
      return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       "there is no point %lu", (unsigned long)corner[i]);
  return RECTO_OK;
}

recto_status recto_scene_add_face(recto_scene *scene, const uint32_t *corner,
                                  size_t count, recto_error *error) {
  struct diagnostics diagnostics = {.file = ""};
  recto_status status = check_corners(scene, corner, count, 3, error);
  if (status == RECTO_OK)
    scene_drop_preparation(scene);
  if (status == RECTO_OK)
    status =
        scene_add_face(&scene->scene, corner, count, 0, &diagnostics, error);
  if (status == RECTO_OK)
    scene_add_faults(scene, &diagnostics);
  return status;
}

recto_status recto_scene_add_polyline(recto_scene *scene,
                                      const uint32_t *corner, size_t count,
                                      recto_error *error) {
  struct diagnostics diagnostics = {.file = ""};
  recto_status status = check_corners(scene, corner, count, 2, error);
  if (status == RECTO_OK)
    scene_drop_preparation(scene);
  if (status == RECTO_OK)
    status =
        scene_add_wire(&scene->scene, corner, count, 0, &diagnostics, error);
  if (status == RECTO_OK)
    scene_add_faults(scene, &diagnostics);
  return status;
}
