/* edges.c - finds the edges of a scene by pairing the sides of its faces.
 *
 * A side is a pair of point indices; faces that have one pair are neighbours.
 * Sides that only one face has are paired once more by the positions of their
 * ends, so that meshes with duplicated points are joined.  Where other sides
 * have the same positions, no class of a pair is sure: which points are joined
 * depends on what else they belong to. */
#include "judge/edges.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "judge/collinear_cuts.h"
#include "judge/cut_edges.h"
#include "judge/edge_classes.h"
#include "judge/folds.h"
#include "judge/intersections.h"
#include "judge/open_surfaces.h"

struct side_list {
  ARRAY(struct judge_side) side;
};

/* The sides between two points, and the positions of these: indices of
 * first_at. */
struct located_group {
  uint32_t low, high;
  struct judge_side side; /* the first of them */
  size_t count;
};

struct edge_finder {
  struct judge_edges *edges;
  const struct scene *scene;
  const struct judge_camera *camera;
  struct judge_facings facings;
  uint32_t *first_at; /* point -> the first point at its position */
  uint8_t *shared;    /* of such a first point: there are others */
  /* Those of one side, and those between positions of several points; by
   * position. */
  ARRAY(struct located_group) group;
};

/* ---- Points at one position ---------------------------------------------- */

static int compare_point_positions(const void *a, const void *b, void *user) {
  (void)user;
  const struct scene_point *p = *(const struct scene_point *const *)a;
  const struct scene_point *q = *(const struct scene_point *const *)b;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  if (p->z != q->z)
    return p->z < q->z ? -1 : 1;
  return p < q ? -1 : p > q;
}

/* By the original points: where the scene's were translated, more of them may
 * coincide.  Returns NULL when memory ran out. */
static uint32_t *find_first_at(const struct scene_point *point, size_t count) {
  uint32_t *first_at = mem_alloc(count, sizeof *first_at);
  const struct scene_point **order = mem_alloc(count, sizeof *order);
  bool ok = first_at != NULL && order != NULL;
  for (size_t i = 0; ok && i < count; i++)
    order[i] = &point[i];
  if (!ok || !sort_stable(order, count, sizeof *order, compare_point_positions,
                          NULL)) {
    mem_free(first_at);
    mem_free(order);
    return NULL;
  }
  for (size_t i = 0; i < count; i++) {
    uint32_t here = (uint32_t)(order[i] - point);
    bool same = i > 0 && order[i]->x == order[i - 1]->x &&
                order[i]->y == order[i - 1]->y &&
                order[i]->z == order[i - 1]->z;
    first_at[here] = same ? first_at[order[i - 1] - point] : here;
  }
  mem_free(order);
  return first_at;
}

/* Sets `shared`.  Returns false when memory ran out. */
static bool mark_shared(struct edge_finder *finder) {
  size_t count = finder->scene->point.count;
  finder->shared = mem_calloc(count, 1);
  for (size_t p = 0; finder->shared != NULL && p < count; p++)
    if (finder->first_at[p] != p)
      finder->shared[finder->first_at[p]] = 1;
  return finder->shared != NULL;
}

/* ---- Adding edges -------------------------------------------------------- */

/* Whether other sides have their ends at the same positions.  If points at one
 * position are joined, they make more than two sides, a border, of what is a
 * pair by index. */
static bool has_others(const struct edge_finder *finder,
                       const struct judge_side *side) {
  uint32_t a = finder->first_at[side->a], b = finder->first_at[side->b];
  uint32_t low_end = a < b ? a : b, high_end = a < b ? b : a;
  const struct located_group *group = finder->group.item;
  size_t i, n = finder->group.count;
  LOWER_BOUND(i, 0, n,
              group[i].low < low_end ||
                  (group[i].low == low_end && group[i].high < high_end));
  while (i < n && group[i].low == low_end && group[i].high == high_end &&
         group[i].side.a == side->a && group[i].side.b == side->b)
    i++;
  return i < n && group[i].low == low_end && group[i].high == high_end;
}

/* Adds the edge of two sides.  For a spike, where both are of one face, no
 * class is sure.
 * alone  no other sides have the same positions */
static bool add_edge_of_sides(struct edge_finder *finder,
                              const struct judge_side *side,
                              const struct judge_side *other, bool against,
                              bool alone) {
  bool spike = side->face == other->face;
  const struct judge_source source = {
      {side->a, side->b},
      {side->face, other->face},
      spike || !alone
          ? 0
          : judge_class_mask_of_pair(&finder->facings, side, other, against),
      !spike,
      0,
      JUDGE_CUT_NONE,
      0};
  return judge_edges_add(finder->edges, finder->camera,
                         judge_point3_at(finder->scene, side->a),
                         judge_point3_at(finder->scene, side->b), &source);
}

/* Adds the edge of one side, or of more than two. */
static bool add_border(struct edge_finder *finder,
                       const struct judge_side *side) {
  uint8_t *border = &finder->edges->border[side->face];
  struct judge_point3 a = judge_point3_at(finder->scene, side->a),
                      b = judge_point3_at(finder->scene, side->b);
  uint8_t is = judge_is_cut_between(finder->edges->removed, a, b)
                   ? JUDGE_BORDER_CUT
                   : JUDGE_BORDER;
  *border = is > *border ? is : *border;
  const struct judge_source source = {{side->a, side->b},
                                      {side->face, SCENE_NONE},
                                      RECTO_EDGE_BORDER,
                                      true,
                                      0,
                                      JUDGE_CUT_NONE,
                                      0};
  return judge_edges_add(finder->edges, finder->camera, a, b, &source);
}

/* Whether the face runs along the side from a, and not towards it.
 * first_at  as in edge_finder, where a is a position; NULL: a is a point */
static bool runs_from(const struct judge_side *side, uint32_t a,
                      const uint32_t *first_at) {
  uint32_t from = side->backward ? side->b : side->a;
  return (first_at == NULL ? from : first_at[from]) == a;
}

/* ---- Pairing ------------------------------------------------------------- */

static int compare_judge_sides(const void *a, const void *b, void *user) {
  const struct judge_side *s = a, *t = b;
  (void)user;
  if (s->a != t->a)
    return s->a < t->a ? -1 : 1;
  if (s->b != t->b)
    return s->b < t->b ? -1 : 1;
  return s->face < t->face ? -1 : s->face > t->face;
}

static bool list_scene_sides(const struct scene *scene,
                             struct side_list *sides) {
  if (!ARRAY_RESERVE(&sides->side, scene->corner.count))
    return false;
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene_face_start(scene, i);
    uint32_t count = scene_face_start(scene, i + 1) - start;
    if (!poll_at(i))
      return false;
    for (uint32_t k = 0; k < count; k++) {
      uint32_t p = scene->corner.item[start + k];
      uint32_t q = scene->corner.item[start + (k + 1) % count];
      struct judge_side side = {p < q ? p : q, p < q ? q : p, i, p > q};
      if (p != q && !ARRAY_PUSH(&sides->side, side))
        return false;
    }
  }
  return sort_stable(sides->side.item, sides->side.count,
                     sizeof *sides->side.item, compare_judge_sides, NULL);
}

/* Adds the edge of two or more sides between the same two points. */
static bool pair_group(struct edge_finder *finder,
                       const struct judge_side *side, size_t count) {
  if (count == 2)
    return add_edge_of_sides(finder, &side[0], &side[1],
                             runs_from(&side[0], side->a, NULL) !=
                                 runs_from(&side[1], side->a, NULL),
                             !has_others(finder, side));
  return add_border(finder, side);
}

static int compare_located(const void *a, const void *b, void *user) {
  const struct located_group *s = a, *t = b;
  if (s->low != t->low)
    return s->low < t->low ? -1 : 1;
  if (s->high != t->high)
    return s->high < t->high ? -1 : 1;
  return compare_judge_sides(&s->side, &t->side, user);
}

/* Adds the sides between two points to the groups, if they may have to do with
 * others. */
static bool locate_group(struct edge_finder *finder,
                         const struct judge_side *side, size_t count) {
  uint32_t a = finder->first_at[side->a], b = finder->first_at[side->b];
  struct located_group group = {a < b ? a : b, a < b ? b : a, *side, count};
  bool alone = !finder->shared[a] && !finder->shared[b];
  return (count > 1 && alone) || ARRAY_PUSH(&finder->group, group);
}

/* Adds the edges of the sides that are alone between their points, `count`
 * groups of one position. */
static bool pair_singles_at(struct edge_finder *finder,
                            const struct located_group *group, size_t count) {
  const struct judge_side *single[2] = {NULL, NULL};
  size_t singles = 0;
  for (size_t i = 0; i < count; i++)
    if (group[i].count == 1) {
      single[singles > 0] = &group[i].side;
      singles++;
    }
  if (singles == 2)
    return add_edge_of_sides(
        finder, single[0], single[1],
        runs_from(single[0], group->low, finder->first_at) !=
            runs_from(single[1], group->low, finder->first_at),
        count == 2);
  return singles == 0 || add_border(finder, single[0]);
}

static bool pair_singles(struct edge_finder *finder) {
  const struct located_group *group = finder->group.item;
  size_t count = finder->group.count;
  bool ok = true;
  for (size_t i = 0, next; ok && i < count; i = next) {
    for (next = i + 1; next < count && group[next].low == group[i].low &&
                       group[next].high == group[i].high;)
      next++;
    ok = pair_singles_at(finder, &group[i], next - i);
  }
  return ok;
}

static bool add_wires(struct edge_finder *finder) {
  const struct scene *scene = finder->scene;
  for (uint32_t i = 0; i < scene_wire_count(scene); i++)
    for (uint32_t k = scene->wire_start.item[i] + 1;
         k < scene->wire_start.item[i + 1]; k++) {
      const struct judge_source source = {
          {scene->wire_corner.item[k - 1], scene->wire_corner.item[k]},
          {SCENE_NONE, SCENE_NONE},
          RECTO_EDGE_WIRE,
          true,
          0,
          JUDGE_CUT_NONE,
          0};
      if (!judge_edges_add(finder->edges, finder->camera,
                           judge_point3_at(scene, source.point[0]),
                           judge_point3_at(scene, source.point[1]), &source))
        return false;
    }
  return true;
}

/* Goes through the groups of sides with the same two points: locates them, or
 * adds the edges of those of two and more. */
static bool visit_groups(struct edge_finder *finder,
                         const struct side_list *sides, bool locating) {
  bool ok = true;
  size_t count = sides->side.count;
  for (size_t i = 0, next, n = 0; ok && i < count; i = next, n++) {
    const struct judge_side *side = sides->side.item + i;
    if (!poll_at(n))
      return false;
    for (next = i + 1; next < count && sides->side.item[next].a == side->a &&
                       sides->side.item[next].b == side->b;)
      next++;
    if (locating)
      ok = locate_group(finder, side, next - i);
    else if (next > i + 1)
      ok = pair_group(finder, side, next - i);
  }
  return ok;
}

bool judge_edges_init(struct judge_edges *edges,
                      const struct judge_triangles *all,
                      const struct judge_camera *camera,
                      const struct judge_options *options) {
  struct edge_finder finder = {
      .edges = edges, .scene = all->scene, .camera = camera};
  struct side_list sides = {{0}};
  memset(edges, 0, sizeof *edges);
  edges->removed = &all->removed;
  finder.first_at = find_first_at(
      options->given != NULL ? options->given : all->scene->point.item,
      all->scene->point.count);
  edges->border = mem_calloc(scene_face_count(all->scene), 1);
  bool ok = edges->border != NULL &&
            judge_facings_init(&finder.facings, all, camera, options) &&
            finder.first_at != NULL && mark_shared(&finder) &&
            list_scene_sides(all->scene, &sides) &&
            visit_groups(&finder, &sides, true) &&
            sort_stable(finder.group.item, finder.group.count,
                        sizeof *finder.group.item, compare_located, NULL) &&
            visit_groups(&finder, &sides, false) && pair_singles(&finder) &&
            judge_doubt_collinear_cuts(edges, all, finder.first_at) &&
            judge_edges_add_folds(edges, &finder.facings) &&
            add_wires(&finder) &&
            judge_edges_add_intersections(edges, all, camera,
                                          options->ray_offset_mm) &&
            judge_edges_add_cuts(edges, all, camera);
  ARRAY_FREE(&sides.side);
  judge_facings_fini(&finder.facings);
  ARRAY_FREE(&finder.group);
  mem_free(finder.shared);
  mem_free(finder.first_at);
  if (!ok)
    judge_edges_fini(edges);
  return ok;
}
