/* crease_rounding.c - by how much rounding turns the faces of an edge. */
#include "scene/edges/crease_rounding.h"

#include <math.h>

#include "base/tolerance.h"
#include "scene/newell_normal.h"

/* By IEEE operations alone: what depends on it is the same on every machine. */
static double square_of(const double v[3]) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static double turn_of_face(const struct scene *scene, uint32_t face) {
  const struct scene_point *point = scene->point.item;
  uint32_t first = scene_face_start(scene, face);
  uint32_t end = scene_face_start(scene, face + 1);
  const struct precision exact = {0, 0};
  double normal[3], longest = 0, error = 0;
  for (uint32_t c = first; c < end; c++) {
    uint32_t at = scene->corner.item[c];
    const struct scene_point *p = &point[at];
    const struct scene_point *q =
        &point[scene->corner.item[c + 1 < end ? c + 1 : first]];
    const double side[3] = {q->x - p->x, q->y - p->y, q->z - p->z};
    longest = fmax(longest, square_of(side));
    error = fmax(
        error, precision_error(scene_point_precision(scene, at, exact),
                               fmax(fmax(fabs(p->x), fabs(p->y)), fabs(p->z))));
  }
  newell_normal(point, scene->corner.item + first, end - first, normal);
  double height = sqrt(square_of(normal) / longest);
  return height > 0 ? TOLERANCE_CREASE_ERRORS * error / height : 0;
}

double crease_rounding(const struct scene *scene, uint32_t first,
                       uint32_t second, double cosine) {
  double turn = turn_of_face(scene, first) + turn_of_face(scene, second);
  double sine = sqrt(fmax(0, 1 - cosine * cosine));
  /* cosine - cos(angle + turn), of a small turn */
  return fmin(turn * (sine + turn * cosine / 2), TOLERANCE_CREASE_ROUNDING);
}
