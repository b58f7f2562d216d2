/* triangles.c - the judge's triangles and their tree of boxes.
 *
 * The tree is built from the top: a node's triangles are parted at the middle
 * of their centroids' longest extent, which suits meshes of even density, or
 * where that leaves less than an eighth on one side, by number.  So a child
 * has at most 7/8 of its parent, and 2^31 triangles make a tree less deep than
 * log(2^31) / log(8/7) = 161. */
#include "judge/triangles.h"

#include <stdlib.h>
#include <string.h>

#include "base/tolerance.h"
#include "judge/ears.h"

enum { LEAF_SIZE = 4, FEWEST_SHARE = 8 };

void judge_sort(void *item, size_t count, size_t size,
                int (*compare)(const void *, const void *)) {
  if (count > 1)
    qsort(item, count, size, compare);
}

/* ---- Boxes -----------------------------------------------------------------
 */

static struct judge_box empty_box(void) {
  struct judge_box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = INFINITY;
    box.high[k] = -INFINITY;
  }
  return box;
}

static void grow_box(struct judge_box *box, struct judge_spot p) {
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

/* ---- The tree
 * ---------------------------------------------------------------- */

/* Parts triangles by the middle of their longest extent, or by number; returns
 * how many come first. */
static uint32_t part_triangles(struct judge_triangle *t, uint32_t count) {
  struct judge_box box = empty_box();
  for (uint32_t i = 0; i < count; i++)
    grow_box(&box, judge_spot_of(centroid_3(&t[i], 0), centroid_3(&t[i], 1),
                                 centroid_3(&t[i], 2)));
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis])
      axis = k;
  double middle = (box.low[axis] + box.high[axis]) / 2;
  uint32_t low = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (centroid_3(&t[i], axis) >= middle)
      continue;
    struct judge_triangle swap = t[i];
    t[i] = t[low];
    t[low++] = swap;
  }
  uint32_t fewest = count / FEWEST_SHARE;
  return low < fewest || count - low < fewest || low == 0 || low == count
             ? count / 2
             : low;
}

static bool build_tree(struct judge_triangles *all) {
  uint32_t total = (uint32_t)all->triangle.count;
  all->node = mem_alloc(2 * (size_t)total + 1, sizeof *all->node);
  if (all->node == NULL)
    return false;
  if (total == 0) /* a node without triangles would be one with children */
    return true;
  all->nodes = 1;
  all->node[0] = (struct judge_node){.first = 0, .count = total};
  /* Children come after their parent: one pass serves as the stack. */
  for (size_t i = 0; i < all->nodes; i++) {
    struct judge_node *node = &all->node[i];
    struct judge_triangle *t = all->triangle.item + node->first;
    node->box = empty_box();
    node->face = t->face;
    for (uint32_t k = 0; k < node->count; k++) {
      for (int j = 0; j < 3; j++)
        grow_box(&node->box, t[k].p[j]);
      if (t[k].face != t->face)
        node->face = SCENE_NONE;
    }
    if (node->count <= LEAF_SIZE)
      continue;
    uint32_t low = part_triangles(t, node->count);
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

/* ---- Triangles
 * ----------------------------------------------------------------- */

static bool add_triangle(struct judge_triangles *all, const struct scene *scene,
                         const uint32_t *corner, const uint32_t ear[3],
                         uint32_t face, enum judge_cut cut) {
  struct judge_triangle t = {.face = face, .cut = cut};
  for (int k = 0; k < 3; k++) {
    t.point[k] = corner[ear[k]];
    t.p[k] = judge_spot_at(scene, t.point[k]);
  }
  struct judge_spot normal =
      spot_cross(spot_sub(t.p[1], t.p[0]), spot_sub(t.p[2], t.p[0]));
  if (spot_length(normal) > 0)
    t.normal = spot_unit(normal);
  return ARRAY_PUSH(&all->triangle, t);
}

struct judge_spot judge_area(const struct scene *scene, uint32_t face) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  struct judge_spot sum = {0, 0, 0};
  struct judge_spot first = judge_spot_at(scene, scene->corner.item[start]);
  for (uint32_t i = 1; i + 1 < count; i++) {
    const uint32_t *corner = scene->corner.item + start + i;
    struct judge_spot u = spot_sub(judge_spot_at(scene, corner[0]), first);
    struct judge_spot v = spot_sub(judge_spot_at(scene, corner[1]), first);
    sum = spot_along(sum, 1, spot_cross(u, v));
  }
  return sum;
}

bool judge_is_warped(const struct scene *scene, uint32_t face, double contact) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  struct judge_spot normal = judge_area(scene, face);
  if (count == 3 || !(spot_length(normal) > 0))
    return false;
  normal = spot_unit(normal);
  struct judge_spot first = judge_spot_at(scene, scene->corner.item[start]);
  double off = 0, extent = 0;
  for (uint32_t i = 1; i < count; i++) {
    struct judge_spot p = judge_spot_at(scene, scene->corner.item[start + i]);
    struct judge_spot away = spot_sub(p, first);
    off = fmax(off, fabs(spot_dot(normal, away)));
    extent = fmax(extent, spot_length(away));
  }
  double flat = contact < 0 ? extent * TOLERANCE_WARP_SHARE : contact / 4;
  return off > fmax(flat, extent * TOLERANCE_EXTENT_SHARE);
}

/* Cuts one face in a way; `ears` is kept from face to face. */
static bool add_cut(struct judge_triangles *all, const struct scene *scene,
                    uint32_t face, struct judge_ears *ears,
                    enum judge_cut cut) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  const uint32_t *corner = scene->corner.item + start;
  if (!judge_cut_ears(ears, scene, corner, count, cut == JUDGE_OTHER_WAY))
    return false;
  for (size_t k = 0; k < ears->ear.count; k++)
    if (!add_triangle(all, scene, corner, ears->ear.item[k].corner, face, cut))
      return false;
  return true;
}

static bool add_face(struct judge_triangles *all, const struct scene *scene,
                     uint32_t face, double contact, struct judge_ears *ears) {
  uint32_t count =
      scene->face_start.item[face + 1] - scene->face_start.item[face];
  if (!judge_is_warped(scene, face, contact))
    return add_cut(all, scene, face, ears, JUDGE_PLANAR);
  if (count > 4)
    return add_cut(all, scene, face, ears, JUDGE_ANY_WAY);
  return add_cut(all, scene, face, ears, JUDGE_ONE_WAY) &&
         add_cut(all, scene, face, ears, JUDGE_OTHER_WAY);
}

static double measure(const struct scene *scene) {
  struct judge_box box = empty_box();
  for (size_t c = 0; c < scene->corner.count; c++)
    grow_box(&box, judge_spot_at(scene, scene->corner.item[c]));
  for (size_t c = 0; c < scene->wire_corner.count; c++)
    grow_box(&box, judge_spot_at(scene, scene->wire_corner.item[c]));
  return spot_length(judge_spot_of(box.high[0] - box.low[0],
                                   box.high[1] - box.low[1],
                                   box.high[2] - box.low[2]));
}

bool judge_triangles_init(struct judge_triangles *all,
                          const struct scene *scene, double contact) {
  struct judge_ears ears = {0};
  bool good = true;
  memset(all, 0, sizeof *all);
  all->scene = scene;
  all->size = measure(scene);
  for (uint32_t i = 0; good && i < scene_face_count(scene); i++)
    good = add_face(all, scene, i, contact, &ears);
  judge_ears_fini(&ears);
  if (good && build_tree(all))
    return true;
  judge_triangles_fini(all);
  return false;
}

void judge_triangles_fini(struct judge_triangles *all) {
  ARRAY_FREE(&all->triangle);
  mem_free(all->node);
  all->node = NULL;
  all->nodes = 0;
}

/* ---- Neighbours --------------------------------------------------------- */

static bool boxes_meet(const struct judge_box *a, const struct judge_box *b) {
  for (int k = 0; k < 3; k++)
    if (a->high[k] < b->low[k] || b->high[k] < a->low[k])
      return false;
  return true;
}

bool judge_triangles_near(const struct judge_triangles *all,
                          const struct judge_box *box, uint32_t but,
                          bool (*found)(void *user, uint32_t triangle),
                          void *user) {
  uint32_t stack[JUDGE_STACK_SIZE];
  unsigned depth = 0;
  if (all->nodes > 0)
    stack[depth++] = 0;
  while (depth > 0) {
    const struct judge_node *node = &all->node[stack[--depth]];
    if (node->face == but || !boxes_meet(&node->box, box))
      continue;
    if (node->count == 0) {
      stack[depth++] = node->first;
      stack[depth++] = node->first + 1;
      continue;
    }
    for (uint32_t i = 0; i < node->count; i++)
      if (!found(user, node->first + i))
        return false;
  }
  return true;
}
