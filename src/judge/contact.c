/* contact.c - the judge's contact tolerance of each triangle. */
#include "judge/contact.h"

#include "base/poll.h"
#include "base/tolerance.h"

/* Upper bound of the rounding error of a coordinate. */
static double error_of(const struct judge_options *options,
                       const struct scene *scene, uint32_t point, double x) {
  struct precision precision =
      scene_point_precision(scene, point, options->unstated);
  return TOLERANCE_ROUNDING_SHARE * precision_error(precision, x);
}

/* Upper bounds of the rounding errors of a face's coordinates. */
static struct judge_point3 error_of_face(const struct judge_options *options,
                                         const struct scene *scene,
                                         uint32_t face) {
  struct judge_point3 error = {0, 0, 0};
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    uint32_t point = scene->corner.item[c];
    struct judge_point3 at =
        point3_along(options->origin, 1, judge_point3_at(scene, point));
    error.x = fmax(error.x, error_of(options, scene, point, at.x));
    error.y = fmax(error.y, error_of(options, scene, point, at.y));
    error.z = fmax(error.z, error_of(options, scene, point, at.z));
  }
  return error;
}

bool judge_contact_set(struct judge_triangles *all,
                       const struct judge_options *options) {
  uint32_t faces = options->contact < 0 ? scene_face_count(all->scene) : 0;
  struct judge_point3 *error = mem_calloc(faces, sizeof *error);
  if (error == NULL)
    return false;
  for (uint32_t i = 0; i < faces && poll_at(i); i++)
    error[i] = error_of_face(options, all->scene, i);
  for (size_t i = 0; i < all->triangle.count && poll_at(i); i++) {
    struct judge_triangle *t = &all->triangle.item[i];
    t->contact = t->planar = options->contact;
    if (faces == 0)
      continue;
    struct judge_point3 e = error[t->face], n = t->normal;
    t->contact = 2 * (fabs(n.x) * e.x + fabs(n.y) * e.y + fabs(n.z) * e.z);
    t->planar = 2 * point3_length(e);
  }
  mem_free(error);
  return true;
}
