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

static double contact_of(const struct judge_options *options,
                         const struct scene *scene,
                         const struct judge_triangle *t) {
  struct judge_point3 error = {0, 0, 0};
  for (uint32_t c = scene->face_start.item[t->face];
       c < scene->face_start.item[t->face + 1]; c++) {
    uint32_t point = scene->corner.item[c];
    struct judge_point3 at =
        point3_along(options->origin, 1, judge_point3_at(scene, point));
    error.x = fmax(error.x, error_of(options, scene, point, at.x));
    error.y = fmax(error.y, error_of(options, scene, point, at.y));
    error.z = fmax(error.z, error_of(options, scene, point, at.z));
  }
  return 2 * (fabs(t->normal.x) * error.x + fabs(t->normal.y) * error.y +
              fabs(t->normal.z) * error.z);
}

void judge_contact_set(struct judge_triangles *all,
                       const struct judge_options *options) {
  for (size_t i = 0; i < all->triangle.count && poll_at(i); i++) {
    struct judge_triangle *t = &all->triangle.item[i];
    t->contact = options->contact < 0 ? contact_of(options, all->scene, t)
                                      : options->contact;
  }
}
