/* bowtie.c - crossing sides, found by a sweep along x.
 *
 * The sides are taken in the order of their left ends.  Those that the sweep
 * has not yet left behind are active, and each new side is tested against
 * them.  Long sides that stay active make this quadratic; the number of tests
 * is bounded, since all that hangs on the answer is a warning.
 */
#include "scene/bowtie.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "scene/exact.h"

struct side {
  double left[2], right[2]; /* left[0] <= right[0] */
};

enum { FEW_SIDES = 32, TESTS_PER_SIDE = 256 };

/* Room for the sweep, on the stack where the polygon is small. */
struct sweep {
  struct side *side;
  struct sort_key *order, *scratch;
  uint32_t *active;
};

static bool sides_cross(const struct side *a, const struct side *b) {
  return fmin(a->left[1], a->right[1]) <= fmax(b->left[1], b->right[1]) &&
         fmin(b->left[1], b->right[1]) <= fmax(a->left[1], a->right[1]) &&
         exact_turn(a->left, a->right, b->left) *
                 exact_turn(a->left, a->right, b->right) <
             0 &&
         exact_turn(b->left, b->right, a->left) *
                 exact_turn(b->left, b->right, a->right) <
             0;
}

/* The axis to look along: of the triangles from the first corner to each side,
 * the sums of their areas' components without their signs, for the lobes of a
 * bow-tie cancel. */
static int choose_axis(const struct scene *scene, const uint32_t *corner,
                       size_t count) {
  const struct scene_point *point = scene->point.item;
  const struct scene_point *a = &point[corner[0]];
  double sum[3] = {0, 0, 0};
  for (size_t i = 1; i + 1 < count; i++) {
    const struct scene_point *b = &point[corner[i]];
    const struct scene_point *c = &point[corner[i + 1]];
    double u[3] = {b->x - a->x, b->y - a->y, b->z - a->z};
    double v[3] = {c->x - a->x, c->y - a->y, c->z - a->z};
    for (int k = 0; k < 3; k++) {
      int l = (k + 1) % 3, m = (k + 2) % 3;
      sum[k] += fabs(u[l] * v[m] - u[m] * v[l]);
    }
  }
  int axis = sum[1] > sum[0] ? 1 : 0;
  return sum[2] > sum[axis] ? 2 : axis;
}

static void project(const struct scene_point *point, int axis, double to[2]) {
  to[0] = axis == 0 ? point->y : point->x;
  to[1] = axis == 2 ? point->y : point->z;
}

/* Unsigned keys in the order of the numbers. */
static uint64_t key_of_double(double value) {
  uint64_t bits;
  value += 0.0; /* -0 becomes 0 */
  memcpy(&bits, &value, sizeof bits);
  return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

static void make_sides(const struct scene *scene, const uint32_t *corner,
                       size_t count, struct sweep *sweep) {
  int axis = choose_axis(scene, corner, count);
  for (size_t i = 0; i < count; i++) {
    size_t next = i + 1 < count ? i + 1 : 0;
    struct side *side = &sweep->side[i];
    double from[2], to[2];
    project(&scene->point.item[corner[i]], axis, from);
    project(&scene->point.item[corner[next]], axis, to);
    bool turned = to[0] < from[0];
    memcpy(side->left, turned ? to : from, sizeof side->left);
    memcpy(side->right, turned ? from : to, sizeof side->right);
    sweep->order[i].key = key_of_double(side->left[0]);
    sweep->order[i].value = (uint32_t)i;
  }
  sort_keys(sweep->order, sweep->scratch, count);
}

static bool find_crossing(const struct sweep *sweep, size_t count) {
  size_t active = 0, tests = 0;
  for (size_t i = 0; i < count; i++) {
    const struct side *side = &sweep->side[sweep->order[i].value];
    size_t kept = 0;
    for (size_t k = 0; k < active; k++) {
      const struct side *other = &sweep->side[sweep->active[k]];
      if (other->right[0] < side->left[0])
        continue;
      if (sides_cross(side, other))
        return true;
      sweep->active[kept++] = sweep->active[k];
    }
    tests += active;
    if (tests / TESTS_PER_SIDE > count)
      return false;
    active = kept;
    sweep->active[active++] = sweep->order[i].value;
  }
  return false;
}

bool bowtie_has_crossing(const struct scene *scene, const uint32_t *corner,
                         size_t count) {
  if (count <= FEW_SIDES) {
    struct side side[FEW_SIDES];
    struct sort_key order[FEW_SIDES], scratch[FEW_SIDES];
    uint32_t active[FEW_SIDES];
    struct sweep sweep = {side, order, scratch, active};
    make_sides(scene, corner, count, &sweep);
    return find_crossing(&sweep, count);
  }
  struct arena arena = {NULL, 0};
  struct sweep sweep = {arena_alloc(&arena, count, sizeof *sweep.side),
                        arena_alloc(&arena, count, sizeof *sweep.order),
                        arena_alloc(&arena, count, sizeof *sweep.scratch),
                        arena_alloc(&arena, count, sizeof *sweep.active)};
  bool crossing = false;
  if (sweep.side && sweep.order && sweep.scratch && sweep.active) {
    make_sides(scene, corner, count, &sweep);
    crossing = find_crossing(&sweep, count);
  }
  arena_fini(&arena);
  return crossing;
}
