/* self_intersection.c - crossing sides of a polygon, found by a sweep along x.
 *
 * Most polygons are convex, and one pass shows it: they turn one way only and
 * go round once.  Of the others, the sides are taken in the order of their left
 * ends.  Those that the sweep has not yet left behind are active, and each new
 * side is tested against them.  Long sides that stay active make this
 * quadratic; the number of tests is bounded, since all that hangs on the answer
 * is a warning.  Where very many sides start at one x, equal ones count once.
 */
#include "scene/triangulation/self_intersection.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "scene/exact.h"

struct polygon_side {
  double left[2], right[2]; /* left[0] <= right[0] */
};

enum { FEW_SIDES = 32, TESTS_PER_SIDE = 256 };

/* Room for the sweep, on the stack where the polygon is small. */
struct side_sweep {
  double (*projected)[2]; /* the corners, seen along the axis */
  struct polygon_side *side;
  struct sort_key *order, *scratch;
  uint32_t *active;
};

static double smaller(double a, double b) { return a < b ? a : b; }
static double larger(double a, double b) { return a > b ? a : b; }

/* ---- The view ------------------------------------------------------------ */

static int largest(const double part[3]) {
  int axis = part[1] > part[0] ? 1 : 0;
  return part[2] > part[axis] ? 2 : axis;
}

/* A power of two that brings the polygon's extent near 1, so that its areas
 * neither overflow nor vanish.  Coordinates are halved, for the difference of
 * two may be too large. */
static double choose_scale(const struct scene *scene, const uint32_t *corner,
                           size_t count) {
  enum { EXPONENT_MIN = -1000 };
  const struct scene_point *point = scene->point.item;
  const struct scene_point *a = &point[corner[0]];
  double extent = 0;
  for (size_t i = 1; i < count; i++) {
    const struct scene_point *b = &point[corner[i]];
    extent = larger(extent, fabs(b->x / 2 - a->x / 2));
    extent = larger(extent, fabs(b->y / 2 - a->y / 2));
    extent = larger(extent, fabs(b->z / 2 - a->z / 2));
  }
  int exponent;
  (void)frexp(extent, &exponent);
  return ldexp(1, exponent < EXPONENT_MIN ? -EXPONENT_MIN : -exponent);
}

static void subtract_halves(const struct scene_point *b,
                            const struct scene_point *a, double scale,
                            double to[3]) {
  to[0] = (b->x / 2 - a->x / 2) * scale;
  to[1] = (b->y / 2 - a->y / 2) * scale;
  to[2] = (b->z / 2 - a->z / 2) * scale;
}

/* The axis to look along: the one that shows most of the polygon's area.  The
 * lobes of a bow-tie may cancel; of the triangles from the first corner to
 * each side, the areas are then added up without their signs.  (Those alone
 * will not do, for they show a saddle from the side.) */
static int choose_view_axis(const struct scene *scene, const uint32_t *corner,
                            size_t count) {
  const struct scene_point *point = scene->point.item;
  double area[3] = {0, 0, 0}, sum[3] = {0, 0, 0};
  double scale = choose_scale(scene, corner, count);
  for (size_t i = 1; i + 1 < count; i++) {
    double u[3], v[3];
    subtract_halves(&point[corner[i]], &point[corner[0]], scale, u);
    subtract_halves(&point[corner[i + 1]], &point[corner[0]], scale, v);
    for (int k = 0; k < 3; k++) {
      int l = (k + 1) % 3, m = (k + 2) % 3;
      double part = u[l] * v[m] - u[m] * v[l];
      area[k] += part;
      sum[k] += fabs(part);
    }
  }
  for (int k = 0; k < 3; k++)
    area[k] = fabs(area[k]);
  int axis = largest(area);
  return area[axis] > 0 ? axis : largest(sum);
}

static void drop_axis(const struct scene_point *point, int axis, double to[2]) {
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

/* ---- Convex polygons ----------------------------------------------------- */

/* Whether the side from a to b runs to the right, or straight up. */
static bool runs_right(const double a[2], const double b[2]) {
  return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Whether all corners turn one way (or not at all) and the sides change
 * between right and left only twice, so that the turns add up to a full one:
 * then no side can meet another.
 * strictly  every corner is to turn: then no two corners are at one place */
static bool is_convex(const double (*projected)[2], size_t count,
                      bool strictly) {
  int way = 0, changes = 0;
  const double *a = projected[count - 2], *b = projected[count - 1];
  bool right = runs_right(a, b);
  for (size_t i = 0; i < count; i++) {
    const double *c = projected[i];
    int turn = exact_orient2d(a, b, c);
    if (turn * way < 0 || (strictly && turn == 0))
      return false;
    way = way ? way : turn;
    changes += runs_right(b, c) != right;
    right = runs_right(b, c);
    a = b;
    b = c;
  }
  return changes == 2;
}

/* ---- The sweep ----------------------------------------------------------- */

/* Compares sides, given by their keys, by the coordinates of their ends. */
static int compare_sides(const void *a, const void *b, void *user) {
  const struct sort_key *p = a, *q = b;
  const struct polygon_side *side = user;
  const struct polygon_side *s = &side[p->value], *t = &side[q->value];
  const double one[4] = {s->left[0], s->left[1], s->right[0], s->right[1]};
  const double two[4] = {t->left[0], t->left[1], t->right[0], t->right[1]};
  int k = 0;
  while (k < 3 && one[k] == two[k])
    k++;
  return (one[k] > two[k]) - (one[k] < two[k]);
}

/* Keeps one of equal sides in each run of many that start at one x; returns how
 * many sides are left.  All are kept where memory ran out. */
static size_t unite_equal_sides(const struct side_sweep *sweep, size_t count) {
  struct sort_key *order = sweep->order;
  size_t kept = 0;
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && order[end].key == order[i].key;)
      end++;
    bool unite =
        end - i > FEW_SIDES && sort_stable(order + i, end - i, sizeof *order,
                                           compare_sides, sweep->side);
    for (size_t k = i; k < end; k++)
      if (!unite || k == i ||
          compare_sides(&order[kept - 1], &order[k], sweep->side) != 0)
        order[kept++] = order[k];
  }
  return kept;
}

static void make_sides(const struct side_sweep *sweep, size_t count) {
  for (size_t i = 0; i < count; i++) {
    struct polygon_side *side = &sweep->side[i];
    const double *from = sweep->projected[i];
    const double *to = sweep->projected[i + 1 < count ? i + 1 : 0];
    bool turned = to[0] < from[0];
    memcpy(side->left, turned ? to : from, sizeof side->left);
    memcpy(side->right, turned ? from : to, sizeof side->right);
    sweep->order[i].key = key_of_double(side->left[0]);
    sweep->order[i].value = (uint32_t)i;
  }
  sort_keys(sweep->order, sweep->scratch, count);
}

static bool sides_cross(const struct polygon_side *a,
                        const struct polygon_side *b) {
  return smaller(a->left[1], a->right[1]) <= larger(b->left[1], b->right[1]) &&
         smaller(b->left[1], b->right[1]) <= larger(a->left[1], a->right[1]) &&
         exact_orient2d(a->left, a->right, b->left) *
                 exact_orient2d(a->left, a->right, b->right) <
             0 &&
         exact_orient2d(b->left, b->right, a->left) *
                 exact_orient2d(b->left, b->right, a->right) <
             0;
}

static bool find_bowtie_crossing(const struct side_sweep *sweep, size_t count) {
  size_t active = 0, tests = 0;
  make_sides(sweep, count);
  size_t distinct = unite_equal_sides(sweep, count);
  for (size_t i = 0; i < distinct; i++) {
    const struct polygon_side *side = &sweep->side[sweep->order[i].value];
    size_t kept = 0;
    for (size_t k = 0; k < active; k++) {
      const struct polygon_side *other = &sweep->side[sweep->active[k]];
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

/* The corners as they are seen along the axis. */
static void project_corners(const struct scene *scene, const uint32_t *corner,
                            size_t count, double (*projected)[2]) {
  int axis = choose_view_axis(scene, corner, count);
  for (size_t i = 0; i < count; i++)
    drop_axis(&scene->point.item[corner[i]], axis, projected[i]);
}

bool polygon_is_strictly_convex(const struct scene *scene,
                                const uint32_t *corner, size_t count) {
  double projected[FEW_SIDES][2];
  if (count < 3 || count > FEW_SIDES)
    return false;
  project_corners(scene, corner, count, projected);
  return is_convex((const double(*)[2])projected, count, true);
}

static bool has_crossing(const struct scene *scene, const uint32_t *corner,
                         size_t count, const struct side_sweep *sweep) {
  project_corners(scene, corner, count, sweep->projected);
  return !is_convex((const double(*)[2])sweep->projected, count, false) &&
         find_bowtie_crossing(sweep, count);
}

bool polygon_intersects_itself(const struct scene *scene,
                               const uint32_t *corner, size_t count) {
  if (count <= FEW_SIDES) {
    double projected[FEW_SIDES][2];
    struct polygon_side side[FEW_SIDES];
    struct sort_key order[FEW_SIDES], scratch[FEW_SIDES];
    uint32_t active[FEW_SIDES];
    struct side_sweep sweep = {projected, side, order, scratch, active};
    return has_crossing(scene, corner, count, &sweep);
  }
  struct arena arena = {NULL, 0};
  struct side_sweep sweep = {
      arena_alloc(&arena, count, sizeof *sweep.projected),
      arena_alloc(&arena, count, sizeof *sweep.side),
      arena_alloc(&arena, count, sizeof *sweep.order),
      arena_alloc(&arena, count, sizeof *sweep.scratch),
      arena_alloc(&arena, count, sizeof *sweep.active)};
  bool crossing = false;
  if (sweep.projected != NULL && sweep.side != NULL && sweep.order != NULL &&
      sweep.scratch != NULL && sweep.active != NULL)
    crossing = has_crossing(scene, corner, count, &sweep);
  arena_fini(&arena);
  return crossing;
}
