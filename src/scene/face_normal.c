/* face_normal.c - normals of faces.
 *
 * Robustness  Normals are summed from differences to the face's first corner,
 * so that a model far from the origin keeps its digits, and a face too small
 * or too large for its squares is scaled by a power of two first. */
#include "scene/face_normal.h"

#include <float.h>
#include <math.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/tolerance.h"

static inline struct face_normal
scaled_difference(const struct scene_point *from, const struct scene_point *to,
                  double scale) {
  return (struct face_normal){.x = to->x * scale - from->x * scale,
                              .y = to->y * scale - from->y * scale,
                              .z = to->z * scale - from->z * scale};
}

static inline void add_product(struct face_normal *sum,
                               const struct face_normal *a,
                               const struct face_normal *b) {
  sum->x += a->y * b->z - a->z * b->y;
  sum->y += a->z * b->x - a->x * b->z;
  sum->z += a->x * b->y - a->y * b->x;
}

/* Twice the area vector of a face whose coordinates are scaled. */
static struct face_normal sum_area(const struct scene *scene, uint32_t face,
                                   double scale) {
  const struct scene_point *point = scene->point.item;
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  uint32_t count =
      scene_face_start(scene, face + 1) - scene_face_start(scene, face);
  struct face_normal sum = {0, 0, 0, 0};
  struct face_normal a =
      scaled_difference(&point[corner[0]], &point[corner[1]], scale);
  for (uint32_t c = 2; c < count; c++) {
    struct face_normal b =
        scaled_difference(&point[corner[0]], &point[corner[c]], scale);
    add_product(&sum, &a, &b);
    a = b;
  }
  sum.square = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
  return sum;
}

/* The power of two that brings a face's extent to about 1. */
static double scale_of_face(const struct scene *scene, uint32_t face) {
  const struct scene_point *point = scene->point.item;
  const uint32_t *corner = scene->corner.item;
  uint32_t first = scene_face_start(scene, face);
  double extent = 0;
  for (uint32_t c = first; c < scene_face_start(scene, face + 1); c++) {
    struct face_normal d =
        scaled_difference(&point[corner[first]], &point[corner[c]], 1);
    extent = fmax(extent, fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
  }
  if (!(extent > 0 && extent <= DBL_MAX))
    return extent > 0 ? DBL_MIN : 1;
  int exponent;
  frexp(extent, &exponent);
  return ldexp(1, exponent > DBL_MIN_EXP ? -exponent : DBL_MAX_EXP - 1);
}

/* Products of two squares must neither overflow nor lose digits. */
static bool is_in_range(double square) {
  return square >= 0x1p-400 && square <= 0x1p+400;
}

static struct face_normal normal_of_odd_face(const struct scene *scene,
                                             uint32_t face) {
  struct face_normal n = sum_area(scene, face, scale_of_face(scene, face));
  return is_in_range(n.square) ? n : (struct face_normal){0, 0, 0, 0};
}

/* What sum_area gives for three corners and a scale of 1, bit for bit. */
static inline struct face_normal area_of_triangle(const struct scene_point *p,
                                                  const struct scene_point *q,
                                                  const struct scene_point *r) {
  double ax = q->x - p->x, ay = q->y - p->y, az = q->z - p->z;
  double bx = r->x - p->x, by = r->y - p->y, bz = r->z - p->z;
  struct face_normal n = {ay * bz - az * by, az * bx - ax * bz,
                          ax * by - ay * bx, 0};
  n.square = n.x * n.x + n.y * n.y + n.z * n.z;
  return n;
}

static inline struct face_normal
area_of_corners(const struct scene_point *point, const uint32_t *corner) {
  return area_of_triangle(&point[corner[0]], &point[corner[1]],
                          &point[corner[2]]);
}

/* Twice the area vector of a face. */
static inline struct face_normal area_of_face(const struct scene *scene,
                                              uint32_t face) {
  uint32_t start = scene_face_start(scene, face);
  return scene_face_start(scene, face + 1) - start == 3
             ? area_of_corners(scene->point.item, scene->corner.item + start)
             : sum_area(scene, face, 1);
}

struct face_normal face_normal_of(const struct scene *scene, uint32_t face) {
  struct face_normal n = area_of_face(scene, face);
  return is_in_range(n.square) ? n : normal_of_odd_face(scene, face);
}

/* ---- Narrow triangles ---------------------------------------------------- */

/* Whether the corners of a triangle make a narrow one.  The square of the
 * longest side is at most twice the sum of the squares of the others.
 * square  of twice its area */
static inline bool are_narrow(const struct scene_point *point,
                              const uint32_t *corner, double square) {
  const double share =
      4 * TOLERANCE_WELD_FACE_SHARE * TOLERANCE_WELD_FACE_SHARE;
  const struct scene_point *p = &point[corner[0]], *q = &point[corner[1]],
                           *r = &point[corner[2]];
  double ax = q->x - p->x, ay = q->y - p->y, az = q->z - p->z;
  double bx = r->x - p->x, by = r->y - p->y, bz = r->z - p->z;
  double sides = ax * ax + ay * ay + az * az + bx * bx + by * by + bz * bz;
  return square <= share * sides * sides;
}

bool face_is_narrow_triangle(const struct scene *scene, uint32_t face) {
  const struct scene_point *point = scene->point.item;
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  return are_narrow(point, corner, area_of_corners(point, corner).square);
}

/* ---- Directions ---------------------------------------------------------- */

/* What the workers know that find the directions. */
struct direction_work {
  const struct scene *scene;
  struct face_direction *direction; /* one a face */
  uint64_t *narrow;                 /* as of face_directions_find */
  struct face_sizes *sizes;         /* one a range of faces */
};

/* Faces that a thread takes at once: whole words of that map. */
enum { FACES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

/* The nearest whole number; |value| <= FACE_DIRECTION_ONE, and a little
 * more. */
static inline int16_t round_direction(double value) {
  return (int16_t)((int)(value + (FACE_DIRECTION_ONE + 1.5)) -
                   (FACE_DIRECTION_ONE + 1));
}

static inline struct face_direction direction_of(struct face_normal n) {
  double scale = n.square > 0 ? FACE_DIRECTION_ONE / sqrt(n.square) : 0;
  return (struct face_direction){round_direction(n.x * scale),
                                 round_direction(n.y * scale),
                                 round_direction(n.z * scale)};
}

/* Fetches the points of the first three corners. */
MEM_PREFETCH_INLINE void prefetch_corners(const struct scene_point *point,
                                          const uint32_t *corner) {
  MEM_PREFETCH(&point[corner[0]]);
  MEM_PREFETCH(&point[corner[1]]);
  MEM_PREFETCH(&point[corner[2]]);
}

static inline void add_size(struct face_sizes *sizes, double square) {
  sizes->sum += sqrt(square);
  sizes->fourth += square * square;
}

static bool find_directions(void *user, struct parallel_range range) {
  const struct direction_work *work = user;
  const struct scene *scene = work->scene;
  struct face_sizes sizes = {0, 0};
  for (size_t f = range.begin; f < range.end; f++) {
    if (f + MEM_PREFETCH_AHEAD < range.end)
      prefetch_corners(
          scene->point.item,
          scene->corner.item +
              scene_face_start(scene, (uint32_t)f + MEM_PREFETCH_AHEAD));
    struct face_normal n = area_of_face(scene, (uint32_t)f);
    add_size(&sizes, n.square);
    if (!is_in_range(n.square))
      n = normal_of_odd_face(scene, (uint32_t)f);
    work->direction[f] = direction_of(n);
  }
  work->sizes[range.begin / FACES_IN_RANGE] = sizes;
  return true;
}

/* The same where all faces are triangles, without the tests that only others
 * need. */
static bool find_triangle_directions(void *user, struct parallel_range range) {
  const struct direction_work work = *(const struct direction_work *)user;
  const struct scene_point *point = work.scene->point.item;
  const uint32_t *corner = work.scene->corner.item + 3 * range.begin;
  struct face_sizes sizes = {0, 0};
  for (size_t f = range.begin; f < range.end; f++, corner += 3) {
    if (f + MEM_PREFETCH_AHEAD < range.end)
      prefetch_corners(point, corner + 3 * MEM_PREFETCH_AHEAD);
    struct face_normal n = area_of_corners(point, corner);
    add_size(&sizes, n.square);
    if (work.narrow != NULL && are_narrow(point, corner, n.square))
      work.narrow[f / 64] |= UINT64_C(1) << f % 64;
    if (!is_in_range(n.square))
      n = normal_of_odd_face(work.scene, (uint32_t)f);
    work.direction[f] = direction_of(n);
  }
  work.sizes[range.begin / FACES_IN_RANGE] = sizes;
  return true;
}

/* Sums up what ranges have. */
static struct face_sizes sum_sizes(const struct face_sizes *sizes,
                                   size_t ranges) {
  struct face_sizes sum = {0, 0};
  for (size_t r = 0; r < ranges; r++) {
    sum.sum += sizes[r].sum;
    sum.fourth += sizes[r].fourth;
  }
  return sum;
}

struct face_direction *face_directions_find(const struct scene *scene,
                                            uint64_t *narrow,
                                            struct face_sizes *sizes) {
  size_t faces = scene_face_count(scene),
         ranges = parallel_range_count(faces, FACES_IN_RANGE);
  struct direction_work work = {scene, mem_alloc(faces, sizeof *work.direction),
                                narrow, mem_alloc(ranges, sizeof *work.sizes)};
  bool ok = work.direction != NULL && work.sizes != NULL &&
            parallel_ranges(
                parallel_workers(faces, FACES_IN_RANGE), faces, FACES_IN_RANGE,
                scene->face_start.count == 0 ? find_triangle_directions
                                             : find_directions,
                &work);
  if (ok)
    *sizes = sum_sizes(work.sizes, ranges);
  else
    mem_free(work.direction);
  mem_free(work.sizes);
  return ok ? work.direction : NULL;
}

/* A face above the mean by that factor is smaller than its fourth power over
 * the cube of that limit.  Twice the sum of the powers covers all rounding,
 * where neither end of the range of doubles is near. */
bool face_sizes_are_even(const struct face_sizes *sizes, size_t faces,
                         double factor, double share) {
  double limit = factor * (sizes->sum / (double)faces),
         cube = limit * limit * limit;
  return cube > 0x1p-300 && sizes->sum < 0x1p+200 &&
         2 * sizes->fourth <= share * sizes->sum * cube;
}
