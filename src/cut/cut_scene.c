/* cut_scene.c - cuts a scene, phase by phase: cut_phases.h explains them. */
#include "cut/cut.h"

#include <string.h>

#include "cut/cut_phases.h"

static void cutter_fini(struct cutter *cutter) {
  cut_points_fini(&cutter->points);
  triangulation_fini(&cutter->triangulation);
  mem_free(cutter->fate);
  ARRAY_FREE(&cutter->corner);
  ARRAY_FREE(&cutter->part);
  mem_free(cutter->place);
  ARRAY_FREE(&cutter->lines.line);
  for (int k = 0; k < CUT_PLANES_MAX; k++)
    section_fini(&cutter->section[k]);
}

/* Borrows all of a scene but what a cut makes anew. */
static void borrow(struct scene *to, const struct scene *from) {
  *to = *from;
  memset(&to->point, 0, sizeof to->point);
  to->face_count = 0;
  memset(&to->face_start, 0, sizeof to->face_start);
  memset(&to->corner, 0, sizeof to->corner);
  memset(&to->face_group, 0, sizeof to->face_group);
  memset(&to->wire_start, 0, sizeof to->wire_start);
  memset(&to->wire_corner, 0, sizeof to->wire_corner);
  memset(&to->wire_group, 0, sizeof to->wire_group);
  memset(&to->precision, 0, sizeof to->precision);
  memset(&to->point_normal, 0, sizeof to->point_normal);
  memset(&to->corner_normal, 0, sizeof to->corner_normal);
  memset(&to->smoothing, 0, sizeof to->smoothing);
}

void cut_fini(struct cut *cut) {
  ARRAY_FREE(&cut->scene.point);
  ARRAY_FREE(&cut->scene.face_start);
  ARRAY_FREE(&cut->scene.corner);
  ARRAY_FREE(&cut->scene.face_group);
  ARRAY_FREE(&cut->scene.wire_start);
  ARRAY_FREE(&cut->scene.wire_corner);
  ARRAY_FREE(&cut->scene.wire_group);
  ARRAY_FREE(&cut->scene.precision);
  mem_free((void *)cut->made.planes);
  mem_free((void *)cut->made.edge);
  mem_free((void *)cut->made.inner);
  mem_free((void *)cut->made.face);
  mem_free((void *)cut->made.wire);
  memset(cut, 0, sizeof *cut);
}

recto_status cut_scene(struct cut *cut, const struct scene *scene,
                       const struct topology *topology,
                       struct precision unstated, const struct cut_plane *plane,
                       size_t planes, recto_error *error) {
  struct cutter cutter = {.cut = cut, .scene = scene, .weld = topology->weld};
  memset(cut, 0, sizeof *cut);
  borrow(&cut->scene, scene);
  recto_status status =
      cut_points_init(&cutter.points, scene, plane, planes, error);
  cut->unit = cutter.points.unit;
  bool has_room = status == RECTO_OK && cut_points_have_room(&cutter.points);
  if (status == RECTO_OK && has_room)
    status = cut_faces(&cutter, error);
  if (status == RECTO_OK && has_room)
    status = cut_sections(&cutter, error);
  if (status == RECTO_OK && has_room)
    status = cut_assemble(&cutter, unstated, error);
  if (status == RECTO_OK && !cutter.anything_goes)
    status = error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                       planes == 1 ? "the plane of the cut misses the model"
                                   : "nothing of the model is beyond all "
                                     "planes of the cut");
  cutter_fini(&cutter);
  return status;
}
