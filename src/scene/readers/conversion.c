/* conversion.c - brings a model to the unit and the up axis of the scene. */
#include "scene/readers/conversion.h"

#include <math.h>
#include <string.h>

#include "scene/corner_normals.h"

/* ---- The up axis --------------------------------------------------------- */

/* Turns the points about X from +Y up to +Z up, or back: what the view from the
 * front shows stays the same. */
static void turn_points(struct scene *scene, size_t first, bool to_z) {
  for (size_t i = first; i < scene->point.count; i++) {
    struct scene_point *point = &scene->point.item[i];
    double y = point->y;
    /* 0 - z has no sign where z is 0. */
    point->y = to_z ? 0 - point->z : point->z;
    point->z = to_z ? y : 0 - y;
  }
}

static void convert_up(struct scene *scene, const struct scene_snapshot *before,
                       const struct model_coordinates *model,
                       struct diagnostics *diagnostics) {
  bool to_z = scene->up[2] > 0;
  if (scene->keeps_up || memcmp(model->up, scene->up, sizeof scene->up) == 0)
    return;
  if (!model->up_is_stated || !scene->up_is_stated)
    diagnostics_warn(diagnostics, model->path,
                     "turned, as up is taken for %s in it and for %s in the "
                     "first model; --up leaves all models as they are",
                     to_z ? "+Y" : "+Z", to_z ? "+Z" : "+Y");
  turn_points(scene, before->points, to_z);
  corner_normals_turn(scene, before->points, before->corners, to_z);
}

/* ---- The unit ------------------------------------------------------------ */

/* A coordinate that the product rounds is no longer exact. */
static void convert_precision(struct scene *scene, size_t first_range,
                              double factor) {
  int exponent;
  bool rounds = frexp(factor, &exponent) != 0.5;
  for (size_t i = first_range; i < scene->precision.count; i++) {
    struct precision *precision = &scene->precision.item[i].precision;
    precision->absolute *= factor;
    if (rounds)
      precision->relative = fmax(precision->relative, PRECISION_DOUBLE);
  }
}

static recto_status convert_points(struct scene *scene,
                                   const struct scene_snapshot *before,
                                   double factor, const char *path,
                                   recto_error *error) {
  if (factor == 1)
    return RECTO_OK;
  for (size_t i = before->points; i < scene->point.count; i++) {
    struct scene_point *p = &scene->point.item[i];
    *p = (struct scene_point){p->x * factor, p->y * factor, p->z * factor};
    if (!isfinite(p->x) || !isfinite(p->y) || !isfinite(p->z))
      return error_set(error, RECTO_ERROR_LIMIT, path, 0,
                       "too large in the unit of the first model");
  }
  convert_precision(scene, before->precisions, factor);
  return RECTO_OK;
}

static void warn_of_unit(struct diagnostics *diagnostics, const char *path) {
  diagnostics_warn(diagnostics, path,
                   "does not say its unit, as another model does: taken for "
                   "mm; --unit leaves all models as they are");
}

/* Those models are in millimetres from now on. */
static void warn_of_earlier(struct scene *scene,
                            struct diagnostics *diagnostics) {
  for (size_t i = 0; i < scene->without_unit.count; i++)
    warn_of_unit(diagnostics, scene->without_unit.item[i]);
  scene_clear_without_unit(scene);
}

static recto_status note_without_unit(struct scene *scene, const char *path,
                                      recto_error *error) {
  char *own = mem_copy_text(path);
  if (own != NULL && ARRAY_PUSH(&scene->without_unit, own))
    return RECTO_OK;
  mem_free(own);
  return error_memory(error);
}

static recto_status convert_unit(struct scene *scene,
                                 const struct scene_snapshot *before,
                                 const struct model_coordinates *model,
                                 struct diagnostics *diagnostics,
                                 recto_error *error) {
  bool is_first = before->points == 0;
  if (scene->keeps_unit) {
    bool differs = !is_first && scene->unit_mm != model->unit_mm;
    scene->unit_mm = differs ? 0 : model->unit_mm;
    return RECTO_OK;
  }
  if (model->unit_mm == 0 && scene->unit_mm == 0)
    return note_without_unit(scene, model->path, error);
  double own_mm = model->unit_mm > 0 ? model->unit_mm : 1;
  double scene_mm = scene->unit_mm > 0 ? scene->unit_mm : is_first ? own_mm : 1;
  recto_status status =
      convert_points(scene, before, own_mm / scene_mm, model->path, error);
  if (status != RECTO_OK)
    return status;
  scene->unit_mm = scene_mm;
  warn_of_earlier(scene, diagnostics);
  if (model->unit_mm == 0)
    warn_of_unit(diagnostics, model->path);
  return RECTO_OK;
}

recto_status conversion_apply(struct scene *scene,
                              const struct scene_snapshot *before,
                              const struct model_coordinates *model,
                              struct diagnostics *diagnostics,
                              recto_error *error) {
  if (scene->point.count == before->points)
    return RECTO_OK;
  recto_status status = convert_unit(scene, before, model, diagnostics, error);
  if (status != RECTO_OK)
    return status;
  if (before->points == 0) {
    memcpy(scene->up, model->up, sizeof scene->up);
    scene->up_is_stated = model->up_is_stated;
  }
  convert_up(scene, before, model, diagnostics);
  return RECTO_OK;
}
