/* thin_faces.c - finds triangles whose height is no more than what rounding of
 * their corners explains.
 *
 * Those that have sides in common are looked at as one: a fan of them may be a
 * curve, though each of its triangles is thin.
 *
 * Nearly every face is settled by a first test: it is not narrow
 * (face_normal.h). */
#include "scene/weld/thin_faces.h"

#include <math.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "base/union_find.h"
#include "geom/vector.h"
#include "scene/face_normal.h"

double thin_faces_length(const struct scene *scene, uint32_t point, double side,
                         struct precision unstated) {
  const double certain = 4; /* 2 sqrt(3), rounded up: two roundings */
  const struct scene_point *p = &scene->point.item[point];
  double largest = max_number(fabs(p->x), max_number(fabs(p->y), fabs(p->z)));
  double error =
      precision_error(scene_point_precision(scene, point, unstated), largest);
  return fmin(certain * error, TOLERANCE_WELD_FACE_SHARE * side);
}

struct thin_search {
  const struct scene *scene;
  const struct topology *topology;
  struct precision unstated;
  uint64_t *thin;
};

static void difference(const struct scene_point *from,
                       const struct scene_point *to, double d[3]) {
  d[0] = to->x - from->x;
  d[1] = to->y - from->y;
  d[2] = to->z - from->z;
}

/* Whether the corner opposite a triangle's longest side is on that side but for
 * rounding, and away from its ends.
 * side    its vector, and what leads from its first end to the corner
 * corner  the point there */
static bool is_within_rounding(const struct thin_search *search,
                               const double side[3], const double to[3],
                               uint32_t corner) {
  double cross[3];
  vector_cross(side, to, cross);
  double length = vector_length(side);
  double most =
      thin_faces_length(search->scene, corner, length, search->unstated);
  double along = vector_dot(side, to) / length;
  return most > 0 && along > most && along < length - most &&
         vector_length(cross) <= most * length;
}

/* Whether a triangle is such a one, whatever is beside it. */
static bool is_thin_triangle(const struct thin_search *search,
                             const uint32_t *corner) {
  const struct scene_point *point = search->scene->point.item;
  double side[3][3], square[3], to[3];
  for (int k = 0; k < 3; k++) {
    difference(&point[corner[k]], &point[corner[(k + 1) % 3]], side[k]);
    square[k] = vector_dot(side[k], side[k]);
  }
  int k = square[0] >= square[1] ? 0 : 1;
  k = square[k] >= square[2] ? k : 2;
  difference(&point[corner[k]], &point[corner[(k + 2) % 3]], to);
  return is_within_rounding(search, side[k], to, corner[(k + 2) % 3]);
}

/* Faces that a thread takes at once: whole words of the map. */
enum { FACES_IN_RANGE = 64 * PARALLEL_RANGE(POLL_ITEMS / 64) };

static bool map_narrow(void *user, struct parallel_range faces) {
  const struct thin_search *search = user;
  const struct scene *scene = search->scene;
  for (size_t f = faces.begin; f < faces.end; f++)
    if (scene_face_corners(scene, (uint32_t)f) == 3 &&
        face_is_narrow_triangle(scene, (uint32_t)f))
      search->thin[f / 64] |= UINT64_C(1) << f % 64;
  return true;
}

/* Finds the narrow triangles.  Where all faces are triangles, the directions of
 * normals, which the classes of edges need, are found in the same pass.
 * Returns false when memory ran out, or the caller cancelled. */
static bool find_narrow(struct thin_search *search, struct topology *topology) {
  size_t faces = scene_face_count(search->scene);
  if (search->scene->face_start.count > 0)
    return parallel_ranges(parallel_workers(faces, FACES_IN_RANGE), faces,
                           FACES_IN_RANGE, map_narrow, search);
  topology_drop_directions(topology);
  topology->direction =
      face_directions_find(search->scene, search->thin, &topology->face_sizes);
  return topology->direction != NULL;
}

/* Leaves of the narrow triangles the thin ones; returns whether there are
 * any. */
static bool keep_thin(const struct thin_search *search, size_t words) {
  bool any = false;
  for (size_t w = 0; w < words; w++)
    for (uint64_t left = search->thin[w]; left != 0; left &= left - 1) {
      uint32_t face = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left);
      if (is_thin_triangle(search, search->scene->corner.item +
                                       scene_face_start(search->scene, face)))
        any = true;
      else
        search->thin[w] &= ~(left & -left);
    }
  return any;
}

/* Whether each side of a triangle has one other face. */
static bool is_between_faces(const struct topology *topology, uint32_t start) {
  for (uint32_t c = start; c < start + 3; c++)
    if (topology->edge.item[topology->corner_edge[c]].uses != 2)
      return false;
  return true;
}

/* Leaves of the triangles those that are between faces; counts them. */
static size_t keep_between_faces(const struct thin_search *search,
                                 size_t words) {
  size_t count = 0;
  for (size_t w = 0; w < words; w++)
    for (uint64_t left = search->thin[w]; left != 0; left &= left - 1) {
      uint32_t face = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(left),
               start = scene_face_start(search->scene, face);
      if (is_between_faces(search->topology, start))
        count++;
      else
        search->thin[w] &= ~(left & -left);
    }
  return count;
}

static bool rounds_nothing(struct precision precision) {
  return precision.absolute == 0 && precision.relative == 0;
}

/* Whether rounding moved no point of the scene. */
static bool has_exact_points(const struct scene *scene,
                             struct precision unstated) {
  const struct precision_range *range = scene->precision.item;
  bool exact = true,
       is_stated = scene->precision.count > 0 && range[0].first_point == 0;
  for (size_t r = 0; r < scene->precision.count; r++) {
    is_stated = is_stated && range[r].stated;
    exact = exact && (!range[r].stated || rounds_nothing(range[r].precision));
  }
  return exact && (is_stated || rounds_nothing(unstated));
}

/* ---- Connected ones ------------------------------------------------------ */

static bool is_marked(const struct thin_search *search, uint32_t face) {
  return search->thin[face / 64] >> face % 64 & 1;
}

/* Joins thin faces that have a side in common, and lists all by the first of
 * those that are joined. */
static void join_thin(const struct thin_search *search, uint32_t *root,
                      struct sort_key *list) {
  const struct topology *topology = search->topology;
  uint32_t faces = scene_face_count(search->scene);
  size_t count = 0;
  for (uint32_t f = 0; f < faces; f++) {
    uint32_t start = scene_face_start(search->scene, f);
    for (uint32_t c = start; is_marked(search, f) && c < start + 3; c++) {
      const struct topology_edge *edge =
          &topology->edge.item[topology->corner_edge[c]];
      uint32_t other = edge->first == f ? edge->second : edge->first;
      if (is_marked(search, other))
        union_find_join(root, f, other);
    }
  }
  for (uint32_t f = 0; f < faces; f++)
    if (is_marked(search, f))
      list[count++] = (struct sort_key){union_find_root(root, f), f};
}

/* The corner of some faces that is farthest from a point. */
static uint32_t farthest_corner_of(const struct scene *scene,
                                   const struct sort_key *face, size_t count,
                                   uint32_t from) {
  const struct scene_point *point = scene->point.item;
  uint32_t farthest = from;
  double most = 0, d[3];
  for (size_t i = 0; i < 3 * count; i++) {
    uint32_t corner =
        scene->corner.item[scene_face_start(scene, face[i / 3].value) + i % 3];
    difference(&point[from], &point[corner], d);
    if (vector_dot(d, d) > most) {
      most = vector_dot(d, d);
      farthest = corner;
    }
  }
  return farthest;
}

/* Whether the corners of faces lie on one line but for rounding. */
static bool are_straight(const struct thin_search *search,
                         const struct sort_key *face, size_t count) {
  const struct scene *scene = search->scene;
  const struct scene_point *point = scene->point.item;
  uint32_t first = scene->corner.item[scene_face_start(scene, face[0].value)];
  uint32_t a = farthest_corner_of(scene, face, count, first);
  uint32_t b = farthest_corner_of(scene, face, count, a);
  double side[3], to[3], cross[3];
  difference(&point[a], &point[b], side);
  double length = vector_length(side);
  for (size_t i = 0; i < 3 * count; i++) {
    uint32_t corner =
        scene->corner.item[scene_face_start(scene, face[i / 3].value) + i % 3];
    difference(&point[a], &point[corner], to);
    vector_cross(side, to, cross);
    if (vector_length(cross) >
        length * thin_faces_length(scene, corner, length, search->unstated))
      return false;
  }
  return true;
}

/* Keeps those of the thin faces that are straight together.  Returns false when
 * memory ran out. */
static bool keep_straight(const struct thin_search *search, size_t *count) {
  uint32_t *root = union_find_create(scene_face_count(search->scene));
  struct sort_key *list = mem_alloc(*count, sizeof *list);
  bool ok = root != NULL && list != NULL;
  size_t listed = *count;
  if (ok) {
    join_thin(search, root, list);
    ok = sort_keys_alone(list, listed);
  }
  for (size_t i = 0, past; ok && i < listed; i = past) {
    for (past = i + 1; past < listed && list[past].key == list[i].key;)
      past++;
    if (are_straight(search, list + i, past - i))
      continue;
    for (size_t k = i; k < past; k++)
      search->thin[list[k].value / 64] &= ~(UINT64_C(1) << list[k].value % 64);
    *count -= past - i;
  }
  mem_free(root);
  mem_free(list);
  return ok;
}

bool thin_faces_find(const struct scene *scene, struct topology *topology,
                     struct precision unstated, uint64_t **thin,
                     size_t *count) {
  size_t words = scene_face_count(scene) / 64 + 1;
  struct thin_search search = {scene, topology, unstated,
                               mem_calloc(words, sizeof *search.thin)};
  *thin = search.thin;
  *count = 0;
  if (search.thin != NULL && has_exact_points(scene, unstated))
    return true;
  if (search.thin == NULL || !find_narrow(&search, topology))
    return false;
  if (!keep_thin(&search, words))
    return true;
  if (!topology_find_corners(topology, scene))
    return false;
  *count = keep_between_faces(&search, words);
  return *count == 0 || keep_straight(&search, count);
}
