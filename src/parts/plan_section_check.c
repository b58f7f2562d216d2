/* plan_section_check.c - whether the section of a plan that was read holds a
 * scene: plans come from files, which may be damaged on purpose. */
#include <math.h>

#include "parts/plan_section.h"
#include "scene/edges/crease_marks.h"
#include "scene/exact.h"
#include "scene/limit.h"

/* Whether numbers ascend, and are such as elements have. */
static bool ascends(const uint32_t *number, size_t count) {
  bool ok = count == 0 || number[count - 1] < SCENE_LIMIT;
  for (size_t i = 1; i < count; i++)
    ok &= number[i - 1] < number[i];
  return ok;
}

static bool are_below(const uint32_t *number, size_t count, size_t past) {
  bool ok = true;
  for (size_t i = 0; i < count; i++)
    ok &= number[i] < past;
  return ok;
}

/* Whether starts begin at 0, have as much between them as each element needs,
 * and end where the corners do. */
static bool are_starts(const uint32_t *start, size_t count, size_t corners,
                       uint32_t least) {
  if (count == 0)
    return corners == 0;
  bool ok = start[0] == 0 && start[count - 1] == corners;
  for (size_t i = 1; i < count && ok; i++)
    ok = start[i] >= start[i - 1] && start[i] - start[i - 1] >= least;
  return ok;
}

static bool points_are_valid(const struct scene *scene) {
  bool ok = true;
  for (size_t p = 0; p < scene->point.count; p++) {
    const struct scene_point *at = &scene->point.item[p];
    ok &= isfinite(at->x) && isfinite(at->y) && isfinite(at->z);
  }
  for (size_t r = 0; r < scene->precision.count; r++) {
    const struct precision_range *range = &scene->precision.item[r];
    ok &= (r == 0 || range->first_point > range[-1].first_point) &&
          isfinite(range->precision.absolute) &&
          range->precision.absolute >= 0 &&
          isfinite(range->precision.relative) && range->precision.relative >= 0;
  }
  return ok;
}

/* ---- Faces and polylines ------------------------------------------------- */

static bool surely_is_a_triangle(const struct scene *scene,
                                 const uint32_t *corner) {
  const struct scene_point *point = scene->point.item;
  const struct scene_point *a = &point[corner[0]], *b = &point[corner[1]],
                           *c = &point[corner[2]];
  return exact_surely_not_collinear(a->x, a->y, b->x, b->y, c->x, c->y) ||
         exact_surely_not_collinear(a->y, a->z, b->y, b->z, c->y, c->z);
}

/* Whether an element would be added to a scene as it is.
 * probe  a scene with the same points, which stays empty
 * Errors  RECTO_ERROR_FORMAT: it would not; RECTO_ERROR_MEMORY */
static recto_status check_element(struct scene *probe, const uint32_t *corner,
                                  uint32_t count, bool is_face) {
  struct scene_snapshot before;
  scene_snapshot(probe, &before);
  recto_status status =
      is_face ? scene_add_face(probe, corner, count, 0, NULL, NULL)
              : scene_add_wire(probe, corner, count, 0, NULL, NULL);
  size_t added = is_face ? probe->corner.count : probe->wire_corner.count;
  scene_restore(probe, &before);
  return status == RECTO_OK && added != count ? RECTO_ERROR_FORMAT : status;
}

static recto_status check_faces(const struct scene *scene,
                                struct scene *probe) {
  recto_status status = RECTO_OK;
  for (uint32_t f = 0; f < scene_face_count(scene) && status == RECTO_OK; f++) {
    uint32_t count = scene_face_corners(scene, f);
    const uint32_t *corner = scene->corner.item + scene_face_start(scene, f);
    if (count != 3 || !surely_is_a_triangle(scene, corner))
      status = check_element(probe, corner, count, true);
  }
  return status;
}

static recto_status check_wires(const struct scene *scene,
                                struct scene *probe) {
  recto_status status = RECTO_OK;
  for (uint32_t w = 0; w < scene_wire_count(scene) && status == RECTO_OK; w++) {
    uint32_t start = scene->wire_start.item[w];
    status = check_element(probe, scene->wire_corner.item + start,
                           scene->wire_start.item[w + 1] - start, false);
  }
  return status;
}

static recto_status check_section_elements(const struct scene *scene) {
  struct scene probe;
  scene_init(&probe);
  probe.point.item = scene->point.item;
  probe.point.count = scene->point.count;
  recto_status status = check_faces(scene, &probe);
  if (status == RECTO_OK)
    status = check_wires(scene, &probe);
  probe.point.item = NULL;
  probe.point.count = 0;
  scene_fini(&probe);
  return status;
}

/* ---- All ----------------------------------------------------------------- */

static bool tones_are_valid(const struct plan_section *section) {
  const struct scene *scene = &section->part.scene;
  bool ok = true;
  for (size_t c = 0; c < scene->corner.count; c++)
    ok &= section->tone[c] >= 0 && section->tone[c] <= 1;
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    ok &= section->uniform[f] <= 1;
  return ok;
}

static bool marks_are_valid(const struct part_scene *part) {
  bool ok = true;
  for (size_t c = 0; c < part->scene.corner.count; c++)
    ok &= part->crease_mark[c] <= CREASE_MARK_SOFT;
  return ok;
}

static bool lists_are_valid(const struct plan_section *section,
                            const struct plan_section_form *form) {
  const struct part_scene *part = &section->part;
  const struct scene *scene = &part->scene;
  uint32_t faces = scene_face_count(scene), wires = scene_wire_count(scene);
  bool ok = true;
  for (uint32_t f = 0; f < faces; f++)
    ok &= part->is_kept[f] <= 1;
  return ok && ascends(part->point_number, scene->point.count) &&
         ascends(part->face_number, faces) &&
         ascends(part->wire_number, wires) && points_are_valid(scene) &&
         (scene->face_start.count > 0
              ? are_starts(scene->face_start.item, scene->face_start.count,
                           scene->corner.count, 3)
              : scene->corner.count == 3 * (size_t)faces) &&
         are_starts(scene->wire_start.item, scene->wire_start.count,
                    scene->wire_corner.count, 2) &&
         are_below(scene->corner.item, scene->corner.count,
                   scene->point.count) &&
         are_below(scene->wire_corner.item, scene->wire_corner.count,
                   scene->point.count) &&
         are_below(scene->wire_group.item, wires, form->groups) &&
         (!form->has_tones || tones_are_valid(section)) &&
         (!form->has_marks || marks_are_valid(part));
}

recto_status plan_section_check(const struct plan_section *section,
                                const struct plan_section_form *form) {
  return lists_are_valid(section, form)
             ? check_section_elements(&section->part.scene)
             : RECTO_ERROR_FORMAT;
}
