/* edges.c - see edges.h.
 *
 * A side is a pair of points; two faces of one pair are neighbours.  Sides
 * that only one face has are compared once more by their positions, so that
 * meshes with seams are whole. */
#include "tests/judge/edges.h"

#include <string.h>

/* A face's side, its ends in a fixed order. */
struct side {
  uint32_t a, b, face;
};

struct sides {
  ARRAY(struct side) side;
};

/* What the judge needs of every face. */
struct facing {
  struct judge_spot normal; /* unit */
  bool flat;                /* no area */
};

struct finder {
  struct judge_edges *edges;
  const struct scene *scene;
  const struct judge_camera *camera;
  const struct judge_options *options;
  struct facing *facing;
  uint32_t *place; /* point -> the first point at its position */
};

static struct judge_spot spot_at(const struct scene *scene, uint32_t point) {
  const struct scene_point *p = &scene->point.item[point];
  return judge_spot_of(p->x, p->y, p->z);
}

/* ---- Points at one place ---------------------------------------------------
 */

static int compare_positions(const void *a, const void *b) {
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

static uint32_t *find_places(const struct scene *scene) {
  size_t count = scene->point.count;
  uint32_t *place = mem_alloc(count, sizeof *place);
  const struct scene_point **order = mem_alloc(count, sizeof *order);
  judge_require(place != NULL && order != NULL);
  for (size_t i = 0; i < count; i++)
    order[i] = &scene->point.item[i];
  judge_sort(order, count, sizeof *order, compare_positions);
  for (size_t i = 0; i < count; i++) {
    uint32_t here = (uint32_t)(order[i] - scene->point.item);
    bool same = i > 0 && order[i]->x == order[i - 1]->x &&
                order[i]->y == order[i - 1]->y &&
                order[i]->z == order[i - 1]->z;
    place[here] = same ? place[order[i - 1] - scene->point.item] : here;
  }
  mem_free(order);
  return place;
}

/* ---- Natures
 * ------------------------------------------------------------------ */

static struct facing facing_of(const struct scene *scene, uint32_t face) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  struct judge_spot sum = {0, 0, 0};
  struct judge_spot first = spot_at(scene, scene->corner.item[start]);
  for (uint32_t i = 1; i + 1 < count; i++) {
    const uint32_t *corner = scene->corner.item + start + i;
    struct judge_spot u = spot_sub(spot_at(scene, corner[0]), first);
    struct judge_spot v = spot_sub(spot_at(scene, corner[1]), first);
    sum = spot_along(sum, 1, spot_cross(u, v));
  }
  struct facing facing = {.flat = !(spot_length(sum) > 0)};
  if (!facing.flat)
    facing.normal = spot_unit(sum);
  return facing;
}

/* The sine of the angle between a face and the view to one of its points. */
static double slope(const struct finder *finder, uint32_t face,
                    struct judge_spot at) {
  const struct judge_camera *camera = finder->camera;
  struct judge_spot view =
      camera->perspective ? spot_unit(spot_sub(camera->eye, at)) : camera->back;
  return spot_dot(finder->facing[face].normal, view);
}

/* Below this a face counts as seen edge-on, and an angle as undecided: well
 * above what the rounding of coordinates does, well below what shows. */
static const double undecided = 1e-5;

/* The natures of a side between two faces that run along it in the given
 * ways: against each other in a well-formed mesh. */
static unsigned natures_of_pair(const struct finder *finder,
                                const struct side *s, const struct side *t,
                                bool against) {
  const struct facing *f = &finder->facing[s->face];
  const struct facing *g = &finder->facing[t->face];
  struct judge_spot at = spot_at(finder->scene, s->a);
  unsigned natures = 0;
  if (finder->scene->face_group.item[s->face] !=
      finder->scene->face_group.item[t->face])
    natures |= RECTO_EDGE_GROUP;
  if (f->flat || g->flat)
    return natures;
  double cosine = spot_dot(f->normal, g->normal);
  cosine = against ? cosine : -cosine;
  double crease = cos(finder->options->crease_deg / 180 * acos(-1));
  if (cosine < crease - undecided)
    natures |= RECTO_EDGE_CREASE;
  double one = slope(finder, s->face, at), two = slope(finder, t->face, at);
  two = against ? two : -two;
  if ((one > undecided && two < -undecided) ||
      (one < -undecided && two > undecided))
    natures |= RECTO_EDGE_SILHOUETTE;
  bool folded = fabs(one) < undecided || fabs(two) < undecided;
  if (natures == 0 && cosine > crease + undecided && !folded)
    natures = RECTO_EDGE_SMOOTH;
  return natures;
}

/* Adds the edge of two sides; of a spike of one face, which goes out and comes
 * back, nothing is sure. */
static void add_pair(struct finder *finder, const struct side *side,
                     const struct side *other, bool against) {
  bool spike = side->face == other->face;
  judge_edges_add(
      finder->edges, finder->camera, spot_at(finder->scene, side->a),
      spot_at(finder->scene, side->b),
      spike ? 0 : natures_of_pair(finder, side, other, against), !spike);
}

/* Adds the edge of one side, or of more than two. */
static void add_border(struct finder *finder, const struct side *side) {
  judge_edges_add(finder->edges, finder->camera,
                  spot_at(finder->scene, side->a),
                  spot_at(finder->scene, side->b), RECTO_EDGE_BORDER, true);
}

/* Whether the face runs along the side from a to b. */
static bool runs_from(const struct finder *finder, const struct side *side,
                      uint32_t a, const uint32_t *place) {
  const struct scene *scene = finder->scene;
  uint32_t start = scene->face_start.item[side->face];
  uint32_t count = scene->face_start.item[side->face + 1] - start;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t p = scene->corner.item[start + i];
    uint32_t q = scene->corner.item[start + (i + 1) % count];
    bool forward = p == side->a && q == side->b;
    if (forward || (p == side->b && q == side->a))
      return (place == NULL ? p : place[p]) == a;
  }
  return false;
}

/* ---- Pairing
 * -------------------------------------------------------------------- */

static int compare_sides(const void *a, const void *b) {
  const struct side *s = a, *t = b;
  if (s->a != t->a)
    return s->a < t->a ? -1 : 1;
  if (s->b != t->b)
    return s->b < t->b ? -1 : 1;
  return s->face < t->face ? -1 : s->face > t->face;
}

static void list_sides(const struct scene *scene, struct sides *sides) {
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene->face_start.item[i];
    uint32_t count = scene->face_start.item[i + 1] - start;
    for (uint32_t k = 0; k < count; k++) {
      uint32_t p = scene->corner.item[start + k];
      uint32_t q = scene->corner.item[start + (k + 1) % count];
      struct side side = {p < q ? p : q, p < q ? q : p, i};
      if (p != q)
        judge_require(ARRAY_PUSH(&sides->side, side));
    }
  }
  judge_sort(sides->side.item, sides->side.count, sizeof *sides->side.item,
             compare_sides);
}

/* Gives the sides of one pair of points their edge; a single one is kept for
 * a second round by position. */
static void pair_group(struct finder *finder, const struct side *side,
                       size_t count, struct sides *single) {
  if (count == 1)
    judge_require(ARRAY_PUSH(&single->side, side[0]));
  else if (count == 2)
    add_pair(finder, &side[0], &side[1],
             runs_from(finder, &side[0], side->a, NULL) !=
                 runs_from(finder, &side[1], side->a, NULL));
  else
    add_border(finder, side);
}

/* A side with the places of its ends. */
struct placed_side {
  uint32_t low, high;
  struct side side;
};

static int compare_placed(const void *a, const void *b) {
  const struct placed_side *s = a, *t = b;
  if (s->low != t->low)
    return s->low < t->low ? -1 : 1;
  if (s->high != t->high)
    return s->high < t->high ? -1 : 1;
  return compare_sides(&s->side, &t->side);
}

static void pair_singles(struct finder *finder, const struct sides *single) {
  size_t count = single->side.count;
  const uint32_t *place = finder->place;
  struct placed_side *placed = mem_alloc(count, sizeof *placed);
  judge_require(placed != NULL);
  for (size_t i = 0; i < count; i++) {
    const struct side *side = &single->side.item[i];
    uint32_t a = place[side->a], b = place[side->b];
    placed[i] = (struct placed_side){a < b ? a : b, a < b ? b : a, *side};
  }
  judge_sort(placed, count, sizeof *placed, compare_placed);
  for (size_t i = 0, next; i < count; i = next) {
    for (next = i + 1; next < count && placed[next].low == placed[i].low &&
                       placed[next].high == placed[i].high;)
      next++;
    const struct side *side = &placed[i].side;
    if (next == i + 2)
      add_pair(
          finder, side, &placed[i + 1].side,
          runs_from(finder, side, placed[i].low, place) !=
              runs_from(finder, &placed[i + 1].side, placed[i].low, place));
    else
      add_border(finder, side);
  }
  mem_free(placed);
}

static void add_wires(struct finder *finder) {
  const struct scene *scene = finder->scene;
  for (uint32_t i = 0; i < scene_wire_count(scene); i++)
    for (uint32_t k = scene->wire_start.item[i] + 1;
         k < scene->wire_start.item[i + 1]; k++)
      judge_edges_add(finder->edges, finder->camera,
                      spot_at(scene, scene->wire_corner.item[k - 1]),
                      spot_at(scene, scene->wire_corner.item[k]),
                      RECTO_EDGE_WIRE, true);
}

void judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_spot a,
                     struct judge_spot b, unsigned natures, bool exists) {
  double da = judge_depth(camera, a), db = judge_depth(camera, b);
  if (camera->perspective) {
    /* Behind the eye nothing has an image; just before it, no useful one. */
    double least = fmax(judge_near(camera), 1e-9 * (fabs(da) + fabs(db)));
    if (da <= least && db <= least)
      return;
    struct judge_spot cut =
        spot_along(a, (least - da) / (db - da), spot_sub(b, a));
    if (da < least)
      a = cut;
    if (db < least)
      b = cut;
  }
  struct judge_edge edge = {
      {a, b},
      {judge_project(camera, a), judge_project(camera, b)},
      {judge_depth(camera, a), judge_depth(camera, b)},
      natures,
      exists};
  judge_require(ARRAY_PUSH(&edges->edge, edge));
}

void judge_edges_init(struct judge_edges *edges, const struct scene *scene,
                      const struct judge_triangles *all,
                      const struct judge_camera *camera,
                      const struct judge_options *options) {
  struct finder finder = {edges, scene, camera, options, NULL, NULL};
  struct sides sides = {{0}}, single = {{0}};
  uint32_t faces = scene_face_count(scene);
  memset(edges, 0, sizeof *edges);
  finder.facing = mem_alloc(faces, sizeof *finder.facing);
  judge_require(finder.facing != NULL);
  for (uint32_t i = 0; i < faces; i++)
    finder.facing[i] = facing_of(scene, i);
  finder.place = find_places(scene);
  list_sides(scene, &sides);
  for (size_t i = 0, next; i < sides.side.count; i = next) {
    const struct side *side = sides.side.item + i;
    for (next = i + 1; next < sides.side.count &&
                       sides.side.item[next].a == side->a &&
                       sides.side.item[next].b == side->b;)
      next++;
    pair_group(&finder, side, next - i, &single);
  }
  pair_singles(&finder, &single);
  add_wires(&finder);
  judge_edges_pierced(edges, all, camera, options->contact);
  ARRAY_FREE(&sides.side);
  ARRAY_FREE(&single.side);
  mem_free(finder.facing);
  mem_free(finder.place);
}

void judge_edges_fini(struct judge_edges *edges) { ARRAY_FREE(&edges->edge); }
