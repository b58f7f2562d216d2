/* corner_normals.c - stores the normals that a file gives to the corners of
 * faces: one a point for as long as all faces there agree. */
#include "scene/corner_normals.h"

#include <math.h>

#include "base/tolerance.h"

uint32_t corner_normal_encode(double x, double y, double z) {
  enum { MIDDLE = 512, LONGEST = 511 };
  double most = fabs(x) > fabs(y) ? fabs(x) : fabs(y);
  most = most > fabs(z) ? most : fabs(z);
  if (!(most > 0 && isfinite(x) && isfinite(y) && isfinite(z)))
    return 0;
  x /= most;
  y /= most;
  z /= most;
  double scale = LONGEST / sqrt(x * x + y * y + z * z);
  const double rounded = MIDDLE + 0.5; /* sums of which are above 0 */
  return (uint32_t)(x * scale + rounded) << 20 |
         (uint32_t)(y * scale + rounded) << 10 |
         (uint32_t)(z * scale + rounded);
}

bool corner_normals_agree(uint32_t a, uint32_t b) {
  if (a == b || a == 0 || b == 0)
    return a == b;
  int u[3], v[3];
  corner_normal_decode(a, u);
  corner_normal_decode(b, v);
  double dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  double squares = (double)(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) *
                   (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return dot > 0 && dot * dot >= TOLERANCE_NORMAL_SQUARED_COSINE * squares;
}

/* Points that are new have none. */
bool corner_normals_begin_points(struct scene *scene) {
  size_t points = scene->point.count;
  if (!ARRAY_RESERVE(&scene->point_normal, points - scene->point_normal.count))
    return false;
  while (scene->point_normal.count < points)
    scene->point_normal.item[scene->point_normal.count++] = 0;
  return true;
}

/* Gives the points of the corners from `first` on their normals; returns
 * whether one has another already, or a corner has none. */
static bool take_point_normals(struct scene *scene, size_t first,
                               const uint32_t *normal) {
  for (size_t c = first; c < scene->corner.count; c++) {
    uint32_t *own = &scene->point_normal.item[scene->corner.item[c]];
    if (normal[c - first] == 0)
      return false;
    if (*own == 0)
      *own = normal[c - first];
    else if (*own != normal[c - first])
      return false;
  }
  return true;
}

/* Lists the normals of all corners before `first`. */
static bool list_corner_normals(struct scene *scene, size_t first) {
  size_t count = scene->corner_normal.count;
  if (!ARRAY_RESERVE(&scene->corner_normal, first + 1 - count))
    return false;
  for (size_t c = count; c < first; c++)
    scene->corner_normal.item[c] =
        scene->has_file_normals || c < scene->first_file_corner
            ? corner_normal_of(scene, (uint32_t)c)
            : 0;
  scene->corner_normal.count = first;
  scene->lists_normals = true;
  return true;
}

/* Notes whether a file that is read in passes, whose faces are not kept, gives
 * a point several normals. */
static bool note_several_normals(struct scene *scene, size_t first,
                                 const uint32_t *normal) {
  if (normal == NULL || scene->has_several_normals)
    return true;
  if (!corner_normals_begin_points(scene))
    return false;
  for (size_t c = first; c < scene->corner.count; c++) {
    uint32_t *own = &scene->point_normal.item[scene->corner.item[c]];
    *own = *own != 0 ? *own : normal[c - first];
    scene->has_several_normals =
        scene->has_several_normals ||
        (normal[c - first] != 0 && normal[c - first] != *own);
  }
  return true;
}

/* Begins with the normals of a file at its first face that has some. */
static bool begin_normals(struct scene *scene, size_t first) {
  bool ok = corner_normals_begin_points(scene);
  if (ok && first > scene->first_file_corner) /* faces before have none */
    ok = list_corner_normals(scene, first);
  scene->has_file_normals = ok;
  return ok;
}

bool corner_normals_add(struct scene *scene, size_t first,
                        const uint32_t *normal) {
  if (first == scene->corner.count)
    return true;
  if (scene->is_read_in_passes)
    return note_several_normals(scene, first, normal);
  if (!scene->has_file_normals &&
      (normal == NULL || !begin_normals(scene, first)))
    return normal == NULL;
  if (!scene->lists_normals) {
    /* Points may have come since the last face with normals. */
    if (normal != NULL && !corner_normals_begin_points(scene))
      return false;
    if (normal != NULL && take_point_normals(scene, first, normal))
      return true;
    if (!list_corner_normals(scene, first))
      return false;
  }
  if (!ARRAY_RESERVE(&scene->corner_normal, scene->corner.count - first))
    return false;
  for (size_t c = first; c < scene->corner.count; c++)
    scene->corner_normal.item[scene->corner_normal.count++] =
        normal != NULL ? normal[c - first] : 0;
  return true;
}

bool corner_normals_copy(struct scene *to, size_t first,
                         const struct scene *from, uint32_t face) {
  uint32_t start = scene_face_start(from, face);
  size_t count = to->corner.count - first;
  bool is_whole = count == scene_face_corners(from, face);
  if (!ARRAY_RESERVE(&to->corner_normal, count))
    return false;
  for (uint32_t c = 0; c < count; c++)
    to->corner_normal.item[to->corner_normal.count++] =
        is_whole ? corner_normal_of(from, start + c) : 0;
  return true;
}

static uint32_t turned_normal(uint32_t normal, bool to_z) {
  int d[3];
  if (normal == 0)
    return 0;
  corner_normal_decode(normal, d);
  return corner_normal_encode(d[0], to_z ? -d[2] : d[2], to_z ? d[1] : -d[1]);
}

void corner_normals_turn(struct scene *scene, size_t first_point,
                         size_t first_corner, bool to_z) {
  uint32_t *point = scene->point_normal.item;
  uint32_t *corner = scene->corner_normal.item;
  for (size_t p = first_point; p < scene->point_normal.count; p++)
    point[p] = turned_normal(point[p], to_z);
  for (size_t c = first_corner; c < scene->corner_normal.count; c++)
    corner[c] = turned_normal(corner[c], to_z);
}
