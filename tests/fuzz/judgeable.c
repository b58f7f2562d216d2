/* judgeable.c - see judgeable.h. */
#include "tests/fuzz/judgeable.h"

#include <math.h>
#include <stdlib.h>

#include "api/handle.h"
#include "scene/triangulation/self_intersection.h"
#include "scene/triangulation/triangulate.h"
#include "tests/scenes/box.h"

/* Corners of a face at one position have one index. */
static bool has_corner_twice(const uint32_t *corner, size_t count) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < i; j++)
      if (corner[i] == corner[j])
        return true;
  return false;
}

static bool are_polygons_simple(const struct scene *scene) {
  struct triangulation triangulation = {0};
  bool simple = true;
  for (uint32_t f = 0; simple && f < scene_face_count(scene); f++) {
    const uint32_t *corner = scene->corner.item + scene_face_start(scene, f);
    size_t count = scene_face_start(scene, f + 1) - scene_face_start(scene, f);
    if (count == 3)
      continue;
    if (!triangulate(&triangulation, scene->point.item, corner, count))
      abort();
    simple = !triangulation.warped && !has_corner_twice(corner, count) &&
             !polygon_intersects_itself(scene, corner, count);
  }
  triangulation_fini(&triangulation);
  return simple;
}

/* What is nearer to a plane than this share of the diagonal, nearly lies in
 * it. */
static const double NEAR_SHARE = 1e-5;
/* What a plane leaves reaches farther than this share, or is drawn so large
 * that the grid of the cut shows. */
static const double LEFT_SHARE = 1e-3;
/* The scenes are some units large, but for single points far away. */
static const double CONTACT_MAX = 0.01;

/* How far a point is beyond a plane. */
static double beyond(const recto_plane *plane, const struct scene_point *p) {
  const double *n = plane->normal;
  double length = hypot(hypot(n[0], n[1]), n[2]);
  return (n[0] * p->x + n[1] * p->y + n[2] * p->z - plane->offset) / length;
}

/* Whether all corners of a face are near a plane and not all in it. */
static bool is_face_near(const struct scene *scene, uint32_t face,
                         const recto_plane *plane, double near) {
  bool all_in = true;
  for (uint32_t i = scene_face_start(scene, face);
       i < scene_face_start(scene, face + 1); i++) {
    const struct scene_point *p = &scene->point.item[scene->corner.item[i]];
    double by = beyond(plane, p);
    all_in = all_in && by == 0;
    if (fabs(by) > near)
      return false;
  }
  return !all_in;
}

static bool is_plane_clear(const struct scene *scene, const recto_plane *plane,
                           double diagonal) {
  double left = 0;
  for (uint32_t f = 0; f < scene_face_count(scene); f++)
    if (is_face_near(scene, f, plane, NEAR_SHARE * diagonal))
      return false;
  for (size_t i = 0; i < scene->point.count; i++)
    left = fmax(left, -beyond(plane, &scene->point.item[i]));
  return left > LEFT_SHARE * diagonal;
}

/* Whether an eye is so far from what it looks at that the grid of the cut does
 * not show. */
static bool is_eye_clear(const recto_camera_options *camera, double diagonal) {
  double distance = 0;
  if (camera->kind != RECTO_CAMERA_EYE || !camera->has_target)
    return true;
  for (int k = 0; k < 3; k++)
    distance = hypot(distance, camera->target[k] - camera->eye[k]);
  return distance > LEFT_SHARE * diagonal;
}

bool is_judgeable(const recto_scene *scene, const recto_options *options) {
  if (options->mesh.cut_count == 0 && !options->camera.has_section)
    return true;
  double middle[3], diagonal = 2 * box_measure(&scene->scene, middle);
  for (size_t i = 0; i < options->mesh.cut_count; i++)
    if (!is_plane_clear(&scene->scene, &options->mesh.cut[i], diagonal))
      return false;
  return options->solver.contact <= CONTACT_MAX &&
         is_eye_clear(&options->camera, diagonal) &&
         are_polygons_simple(&scene->scene);
}
