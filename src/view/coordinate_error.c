/* coordinate_error.c - bounds the distance that rounding of the input
 * coordinates may open between a face and a point that touches it. */
#include "view/coordinate_error.h"

#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "geom/vector.h"

/* Twice the rounding error of a coordinate: that of the plane and that of the
 * point. */
static double contact_along_axis(struct precision precision,
                                 double coordinate) {
  return 2 * TOLERANCE_ROUNDING_SHARE * precision_error(precision, coordinate);
}

/* Faces of more corners are measured once, not for each of their triangles. */
enum { CORNERS_MAX = 64 };

/* Whether all points have one precision, which is then stored. */
static bool has_one_precision(const struct scene *scene,
                              struct precision unstated,
                              struct precision *precision) {
  const struct precision_range *range = scene->precision.item;
  size_t count = scene->precision.count;
  *precision = count > 0 && range->stated ? range->precision : unstated;
  return count == 0 || (count == 1 && range->first_point == 0);
}

/* The errors of a face whose corners have one precision: no error of a
 * coordinate is larger than that of one of larger magnitude. */
static void measure_with(const struct scene *scene, uint32_t face,
                         struct precision precision, double error[3]) {
  double x = 0, y = 0, z = 0;
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    const struct scene_point *p = &scene->point.item[scene->corner.item[c]];
    x = max_number(x, fabs(p->x));
    y = max_number(y, fabs(p->y));
    z = max_number(z, fabs(p->z));
  }
  error[0] = contact_along_axis(precision, x);
  error[1] = contact_along_axis(precision, y);
  error[2] = contact_along_axis(precision, z);
}

static void measure(const struct sheet *sheet, uint32_t face, double error[3]) {
  const struct scene *scene = sheet->scene;
  struct precision precision;
  error[0] = error[1] = error[2] = 0;
  if (has_one_precision(scene, sheet->camera.unstated, &precision)) {
    measure_with(scene, face, precision, error);
    return;
  }
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    uint32_t point = scene->corner.item[c];
    const struct scene_point *p = &scene->point.item[point];
    precision = scene_point_precision(scene, point, sheet->camera.unstated);
    error[0] = max_number(error[0], contact_along_axis(precision, p->x));
    error[1] = max_number(error[1], contact_along_axis(precision, p->y));
    error[2] = max_number(error[2], contact_along_axis(precision, p->z));
  }
}

bool coordinate_error_store(struct sheet *sheet, uint32_t face) {
  struct sheet_face_error error = {.face = face};
  if (scene_face_corners(sheet->scene, face) <= CORNERS_MAX ||
      sheet->camera.error > 0)
    return true;
  measure(sheet, face, error.along);
  return ARRAY_PUSH(&sheet->face_error, error);
}

/* As coordinate_error_of_triangle, of a face. */
static void coordinate_error_of_face(const struct sheet *sheet, uint32_t face,
                                     double error[3]) {
  const struct sheet_face_error *stored = sheet->face_error.item;
  size_t i;
  if (sheet->scene == NULL || sheet->camera.error > 0) {
    error[0] = error[1] = error[2] =
        sheet->scene != NULL ? sheet->camera.error : 0;
    return;
  }
  LOWER_BOUND(i, 0, sheet->face_error.count, stored[i].face < face);
  if (i < sheet->face_error.count && stored[i].face == face)
    memcpy(error, stored[i].along, sizeof stored[i].along);
  else
    measure(sheet, face, error);
}

void coordinate_error_of_triangle(const struct sheet *sheet, uint32_t triangle,
                                  double error[3]) {
  if (sheet->triangle_error != NULL)
    memcpy(error, sheet->triangle_error[triangle],
           sizeof sheet->triangle_error[triangle]);
  else
    coordinate_error_of_face(sheet, sheet->triangle.item[triangle].face, error);
}

struct error_storing {
  const struct sheet *sheet;
  double (*error)[3]; /* one a triangle */
};

static bool store_errors_of_range(void *user, struct parallel_range range) {
  const struct error_storing *storing = user;
  for (uint32_t t = (uint32_t)range.begin; t < range.end; t++)
    coordinate_error_of_triangle(storing->sheet, t, storing->error[t]);
  return true;
}

bool coordinate_error_store_all(struct sheet *sheet) {
  size_t count = sheet->triangle.count;
  if (sheet->scene == NULL || sheet->camera.error > 0 ||
      sheet->camera.contact >= 0)
    return true;
  struct error_storing storing = {sheet,
                                  mem_alloc(count, sizeof *storing.error)};
  bool ok = storing.error != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, store_errors_of_range, &storing);
  sheet->triangle_error = storing.error;
  return ok;
}

double coordinate_error_contact(const struct sheet *sheet, uint32_t face) {
  if (sheet->camera.contact >= 0)
    return sheet->camera.contact;
  double error[3];
  coordinate_error_of_face(sheet, face, error);
  return vector_length(error);
}

double coordinate_error_most(const struct scene *scene,
                             struct precision unstated, const double low[3],
                             const double high[3]) {
  double most = 0;
  for (size_t i = 0; i <= scene->precision.count; i++) {
    struct precision precision =
        i < scene->precision.count && scene->precision.item[i].stated
            ? scene->precision.item[i].precision
            : unstated;
    double error[3];
    for (int k = 0; k < 3; k++)
      error[k] =
          contact_along_axis(precision, fmax(fabs(low[k]), fabs(high[k])));
    most = fmax(most, vector_length(error));
  }
  return most;
}

double coordinate_error_common(const struct scene *scene,
                               struct precision unstated, const double low[3],
                               const double high[3]) {
  const struct precision_range *range = scene->precision.item;
  struct precision precision = unstated;
  if (scene->precision.count > 1 ||
      (scene->precision.count == 1 && range->first_point > 0))
    return 0;
  if (scene->precision.count == 1 && range->stated)
    precision = range->precision;
  for (int k = 0; k < 3; k++)
    if (precision.relative * fmax(fabs(low[k]), fabs(high[k])) >
        precision.absolute)
      return 0;
  return contact_along_axis(precision, 0);
}
