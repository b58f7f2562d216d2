/* triangles.c - the judge's triangles and their bounding volume hierarchy.
 *
 * The tree is built top-down.  A node's triangles are split at the middle of
 * their centroids' longest extent, which suits meshes of even density, or by
 * number where that would leave less than an eighth on one side.
 *
 * Depth  A child has at most 7/8 of its parent's triangles, so a tree of 2^31
 *   triangles is less deep than log(2^31) / log(8/7) = 161. */
#include "judge/triangles.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "judge/ear_clipping.h"
#include "judge/triangulation.h"

enum { LEAF_SIZE = 4, MIN_SHARE = 8 };

/* ---- Boxes --------------------------------------------------------------- */

static struct judge_box empty_box(void) {
  struct judge_box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = INFINITY;
    box.high[k] = -INFINITY;
  }
  return box;
}

static void grow_box(struct judge_box *box, struct judge_point3 p) {
  const double at[3] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; k++) {
    box->low[k] = fmin(box->low[k], at[k]);
    box->high[k] = fmax(box->high[k], at[k]);
  }
}

struct judge_box judge_triangle_box(const struct judge_triangle *triangle) {
  struct judge_box box = empty_box();
  for (int k = 0; k < 3; k++)
    grow_box(&box, triangle->p[k]);
  return box;
}

static double centroid_3(const struct judge_triangle *t, int axis) {
  if (axis == 0)
    return t->p[0].x + t->p[1].x + t->p[2].x;
  if (axis == 1)
    return t->p[0].y + t->p[1].y + t->p[2].y;
  return t->p[0].z + t->p[1].z + t->p[2].z;
}

/* ---- The tree ------------------------------------------------------------ */

/* Splits triangles at the middle of their longest extent, or by number; returns
 * the number of the first part. */
static uint32_t split_triangles(struct judge_triangle *t, uint32_t count) {
  struct judge_box box = empty_box();
  for (uint32_t i = 0; i < count && poll_at(i + 1); i++)
    grow_box(&box, judge_point3_of(centroid_3(&t[i], 0), centroid_3(&t[i], 1),
                                   centroid_3(&t[i], 2)));
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis])
      axis = k;
  double middle = (box.low[axis] + box.high[axis]) / 2;
  uint32_t low = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (!poll_at(i + 1) || centroid_3(&t[i], axis) >= middle)
      continue;
    struct judge_triangle swap = t[i];
    t[i] = t[low];
    t[low++] = swap;
  }
  uint32_t fewest = count / MIN_SHARE;
  return low < fewest || count - low < fewest || low == 0 || low == count
             ? count / 2
             : low;
}

static bool build_tree(struct judge_triangles *all) {
  uint32_t total = (uint32_t)all->triangle.count;
  all->node = mem_alloc(2 * (size_t)total + 1, sizeof *all->node);
  if (all->node == NULL)
    return false;
  if (total == 0) /* count 0 would mean an inner node */
    return true;
  all->nodes = 1;
  all->node[0] = (struct judge_node){.first = 0, .count = total};
  /* Children come after their parent: one pass serves as the stack. */
  for (size_t i = 0, n = 0; i < all->nodes; i++) {
    struct judge_node *node = &all->node[i];
    struct judge_triangle *t = all->triangle.item + node->first;
    node->box = empty_box();
    node->face = t->face;
    for (uint32_t k = 0; k < node->count; k++) {
      if (!poll_at(n++))
        return false;
      for (int j = 0; j < 3; j++)
        grow_box(&node->box, t[k].p[j]);
      if (t[k].face != t->face)
        node->face = SCENE_NONE;
    }
    if (node->count <= LEAF_SIZE)
      continue;
    uint32_t low = split_triangles(t, node->count);
    struct judge_node left = {.first = node->first, .count = low};
    struct judge_node right = {.first = node->first + low,
                               .count = node->count - low};
    node->first = (uint32_t)all->nodes;
    node->count = 0;
    all->node[all->nodes++] = left;
    all->node[all->nodes++] = right;
  }
  return true;
}

/* ---- Triangles ----------------------------------------------------------- */

static struct judge_triangle triangle_of(const struct scene *scene,
                                         const uint32_t *corner,
                                         const uint32_t ear[3], uint32_t face,
                                         double off_plane) {
  struct judge_triangle t = {.face = face, .off_plane = off_plane};
  for (int k = 0; k < 3; k++) {
    t.point[k] = corner[ear[k]];
    t.p[k] = judge_point3_at(scene, t.point[k]);
  }
  struct judge_point3 normal =
      point3_cross(point3_sub(t.p[1], t.p[0]), point3_sub(t.p[2], t.p[0]));
  if (point3_length(normal) > 0)
    t.normal = point3_unit(normal);
  return t;
}

struct judge_point3 judge_area(const struct scene *scene, uint32_t face) {
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_start(scene, face + 1) - start;
  struct judge_point3 sum = {0, 0, 0};
  struct judge_point3 first = judge_point3_at(scene, scene->corner.item[start]);
  for (uint32_t i = 1; i + 1 < count; i++) {
    const uint32_t *corner = scene->corner.item + start + i;
    struct judge_point3 u =
        point3_sub(judge_point3_at(scene, corner[0]), first);
    struct judge_point3 v =
        point3_sub(judge_point3_at(scene, corner[1]), first);
    sum = point3_along(sum, 1, point3_cross(u, v));
  }
  return sum;
}

/* The distance of the corner of a face that is farthest from the plane through
 * its first corner; 0 for a triangle and where the face has no area.
 * extent  set to the distance of the corner farthest from the first one */
static double off_plane_of(const struct scene *scene, uint32_t face,
                           double *extent) {
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_start(scene, face + 1) - start;
  struct judge_point3 normal = judge_area(scene, face);
  double off = 0;
  *extent = 0;
  if (count == 3 || !(point3_length(normal) > 0))
    return 0;
  normal = point3_unit(normal);
  struct judge_point3 first = judge_point3_at(scene, scene->corner.item[start]);
  for (uint32_t i = 1; i < count; i++) {
    struct judge_point3 p =
        judge_point3_at(scene, scene->corner.item[start + i]);
    struct judge_point3 away = point3_sub(p, first);
    off = fmax(off, fabs(point3_dot(normal, away)));
    *extent = fmax(*extent, point3_length(away));
  }
  return off;
}

bool judge_is_warped(const struct scene *scene, uint32_t face, double contact) {
  double extent, off = off_plane_of(scene, face, &extent);
  double flat = extent * TOLERANCE_WARP_SHARE;
  if (contact >= 0)
    flat = fmin(flat, contact / 4);
  return off > fmax(flat, extent * TOLERANCE_EXTENT_SHARE);
}

/* ---- Faces --------------------------------------------------------------- */

/* The inputs, and work space kept from face to face. */
struct face_adder {
  struct judge_triangles *all;
  const struct scene *scene;
  const struct scene_point *given;
  double contact;
  struct judge_triangulation triangulation;
  struct judge_ears ears;
};

/* Whether a triangle of the face, from `first` on, has the opposite orientation
 * to the face. */
static bool is_folded(const struct face_adder *adder, uint32_t face,
                      size_t first) {
  const struct judge_triangles *all = adder->all;
  struct judge_point3 normal = judge_area(adder->scene, face);
  for (size_t t = first; t < all->triangle.count; t++)
    if (!(point3_dot(all->triangle.item[t].normal, normal) > 0))
      return true;
  return false;
}

static bool add_face_fan(struct judge_triangles *all, size_t first) {
  for (size_t t = first; t < all->triangle.count; t++) {
    struct judge_triangle *triangle = &all->triangle.item[t];
    triangle->bent = true;
    for (int k = 0; k < 3; k++) {
      uint32_t a = triangle->point[k], b = triangle->point[(k + 1) % 3];
      struct judge_side_triangle side_triangle = {triangle->face, a < b ? a : b,
                                                  a < b ? b : a, *triangle};
      if (!ARRAY_PUSH(&all->side_triangle, side_triangle))
        return false;
    }
  }
  return true;
}

/* Adds a face of more than JUDGE_TRIANGULATION_MAX corners. */
static bool add_large_face(struct face_adder *adder, uint32_t face,
                           const uint32_t *corner, uint32_t count) {
  struct judge_triangles *all = adder->all;
  bool open = judge_is_warped(adder->scene, face, adder->contact);
  double extent, off_plane = off_plane_of(adder->scene, face, &extent);
  if (!judge_clip_ears(&adder->ears, adder->scene, corner, count))
    return false;
  for (size_t k = 0; k < adder->ears.ear.count; k++) {
    struct judge_triangle t = triangle_of(
        adder->scene, corner, adder->ears.ear.item[k].corner, face, off_plane);
    t.open = open;
    if (!ARRAY_PUSH(&all->triangle, t))
      return false;
  }
  return true;
}

static bool add_face_triangles(struct face_adder *adder, uint32_t face) {
  const struct scene *scene = adder->scene;
  struct judge_triangles *all = adder->all;
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_start(scene, face + 1) - start;
  const uint32_t *corner = scene->corner.item + start;
  size_t first = all->triangle.count;
  if (count > JUDGE_TRIANGULATION_MAX)
    return add_large_face(adder, face, corner, count);
  if (!judge_triangulation_make(&adder->triangulation, adder->given, corner,
                                count))
    return false;
  double extent, off_plane = off_plane_of(scene, face, &extent);
  for (size_t k = 0; k < adder->triangulation.triangle.count; k++)
    if (!ARRAY_PUSH(&all->triangle,
                    triangle_of(scene, corner,
                                adder->triangulation.triangle.item[k].corner,
                                face, off_plane)))
      return false;
  return count == 3 || (!judge_is_warped(scene, face, adder->contact) &&
                        !is_folded(adder, face, first))
             ? true
             : add_face_fan(all, first);
}

static int compare_fan_triangles(const void *a, const void *b, void *user) {
  const struct judge_side_triangle *s = a, *t = b;
  (void)user;
  if (s->face != t->face)
    return s->face < t->face ? -1 : 1;
  if (s->low != t->low)
    return s->low < t->low ? -1 : 1;
  return s->high < t->high ? -1 : s->high > t->high;
}

const struct judge_side_triangle *
judge_fan_along(const struct judge_triangles *all, uint32_t face, uint32_t a,
                uint32_t b, size_t *count) {
  const struct judge_side_triangle wanted = {
      .face = face, .low = a < b ? a : b, .high = a < b ? b : a};
  const struct judge_side_triangle *side_triangle = all->side_triangle.item;
  size_t low;
  LOWER_BOUND(low, 0, all->side_triangle.count,
              compare_fan_triangles(&side_triangle[low], &wanted, NULL) < 0);
  for (*count = 0;
       low + *count < all->side_triangle.count &&
       compare_fan_triangles(&side_triangle[low + *count], &wanted, NULL) == 0;)
    ++*count;
  return ARRAY_AT(&all->side_triangle, low);
}

static double scene_size(const struct scene *scene) {
  struct judge_box box = empty_box();
  for (size_t c = 0; c < scene->corner.count && poll_at(c); c++)
    grow_box(&box, judge_point3_at(scene, scene->corner.item[c]));
  for (size_t c = 0; c < scene->wire_corner.count; c++)
    grow_box(&box, judge_point3_at(scene, scene->wire_corner.item[c]));
  return point3_length(judge_point3_of(box.high[0] - box.low[0],
                                       box.high[1] - box.low[1],
                                       box.high[2] - box.low[2]));
}

bool judge_triangles_init(struct judge_triangles *all,
                          const struct scene *scene,
                          const struct scene_point *given, double contact) {
  memset(all, 0, sizeof *all);
  all->scene = scene;
  all->size = scene_size(scene);
  struct face_adder adder = {.all = all,
                             .scene = scene,
                             .given = given != NULL ? given : scene->point.item,
                             .contact = contact};
  bool ok = ARRAY_RESERVE(&all->triangle, scene->corner.count);
  for (uint32_t i = 0; ok && i < scene_face_count(scene); i++)
    ok = poll_at(i) && add_face_triangles(&adder, i);
  ok = ok && sort_stable(all->side_triangle.item, all->side_triangle.count,
                         sizeof *all->side_triangle.item, compare_fan_triangles,
                         NULL);
  judge_triangulation_fini(&adder.triangulation);
  judge_ears_fini(&adder.ears);
  if (ok && build_tree(all))
    return true;
  judge_triangles_fini(all);
  return false;
}

void judge_triangles_fini(struct judge_triangles *all) {
  ARRAY_FREE(&all->triangle);
  ARRAY_FREE(&all->side_triangle);
  mem_free(all->node);
  all->node = NULL;
  all->nodes = 0;
}
