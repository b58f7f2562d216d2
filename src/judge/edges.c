/* edges.c - the scene's edges as the judge finds them.
 *
 * A side is a pair of points; two faces of one pair are neighbours.  Sides
 * that only one face has are compared once more by their positions, so that
 * meshes with seams are whole. */
#include "judge/edges.h"

#include <string.h>

#include "base/tolerance.h"
#include "judge/triangulation.h"

/* A face's side, its ends in a fixed order. */
struct face_side {
  uint32_t a, b, face;
};

struct face_sides {
  ARRAY(struct face_side) side;
};

/* What the judge needs of every face. */
struct facing {
  struct judge_point3 normal; /* unit */
  bool flat;                  /* no area */
  bool thin; /* on the page no thicker than contact: rounding may decide */
  bool open; /* not planar, and it is not known how it is cut */
};

/* A side with the places of its ends. */
struct placed_side {
  uint32_t low, high;
  struct face_side side;
};

struct edge_finder {
  struct judge_edges *edges;
  const struct judge_triangles *all;
  const struct scene *scene;
  const struct judge_camera *camera;
  const struct judge_options *options;
  struct facing *facing;
  uint32_t *page_point;       /* point -> the first point at its position */
  struct placed_side *single; /* sides alone between two points, by places */
  size_t singles;
};

/* ---- Points at one place ------------------------------------------------- */

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

/* Returns NULL when memory ran out. */
static uint32_t *find_places(const struct scene *scene) {
  size_t count = scene->point.count;
  uint32_t *page_point = mem_alloc(count, sizeof *page_point);
  const struct scene_point **order = mem_alloc(count, sizeof *order);
  if (page_point == NULL || order == NULL) {
    mem_free(page_point);
    mem_free(order);
    return NULL;
  }
  for (size_t i = 0; i < count; i++)
    order[i] = &scene->point.item[i];
  judge_sort(order, count, sizeof *order, compare_positions);
  for (size_t i = 0; i < count; i++) {
    uint32_t here = (uint32_t)(order[i] - scene->point.item);
    bool same = i > 0 && order[i]->x == order[i - 1]->x &&
                order[i]->y == order[i - 1]->y &&
                order[i]->z == order[i - 1]->z;
    page_point[here] =
        same ? page_point[order[i - 1] - scene->point.item] : here;
  }
  mem_free(order);
  return page_point;
}

/* ---- Natures ------------------------------------------------------------- */

/* The corner of a face whose image is farthest from a place. */
static struct judge_point2 farthest_image(const struct edge_finder *finder,
                                          uint32_t start, uint32_t count,
                                          struct judge_point2 from) {
  struct judge_point2 best = from;
  double most = 0;
  for (uint32_t c = start; c < start + count; c++) {
    struct judge_point2 at = judge_project(
        finder->camera,
        judge_point3_at(finder->scene, finder->scene->corner.item[c]));
    double away = hypot(at.x - from.x, at.y - from.y);
    if (away > most) {
      most = away;
      best = at;
    }
  }
  return best;
}

/* How far from a line a place may be that contact and rounding moved, mm. */
static double thickness_at(const struct edge_finder *finder, double contact,
                           struct judge_point3 at) {
  struct judge_point3 aside = judge_shift(finder->camera, at, 1, 0);
  double unit = point3_length(point3_sub(aside, at)); /* a mm there */
  return finder->options->hair_mm + 2 * contact / unit;
}

/* Whether all corners of a face lie about on one line on the page. */
static bool is_thin(const struct edge_finder *finder, uint32_t face,
                    double contact) {
  const struct scene *scene = finder->scene;
  const struct judge_camera *camera = finder->camera;
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  for (uint32_t c = start; c < start + count; c++)
    if (!(judge_ahead(camera, judge_point3_at(scene, scene->corner.item[c])) >
          judge_near(camera)))
      return false;
  struct judge_point2 first =
      judge_project(camera, judge_point3_at(scene, scene->corner.item[start]));
  struct judge_point2 a = farthest_image(finder, start, count, first);
  struct judge_point2 b = farthest_image(finder, start, count, a);
  double length = hypot(b.x - a.x, b.y - a.y);
  for (uint32_t c = start; c < start + count; c++) {
    struct judge_point3 position =
        judge_point3_at(scene, scene->corner.item[c]);
    struct judge_point2 p = judge_project(camera, position);
    double off = fabs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
    if (off > length * thickness_at(finder, contact, position))
      return false;
  }
  return true;
}

static struct facing facing_of(const struct edge_finder *finder, uint32_t face,
                               double contact) {
  struct judge_point3 sum = judge_area(finder->scene, face);
  struct facing facing = {.flat = !(point3_length(sum) > 0)};
  if (!facing.flat)
    facing.normal = spot_unit(sum);
  const uint32_t *start = finder->scene->face_start.item + face;
  facing.open = start[1] - start[0] > JUDGE_TRIANGULATION_MOST &&
                judge_is_warped(finder->scene, face, finder->options->contact);
  if (finder->all->fan_triangle.count > 0)
    facing.thin = is_thin(finder, face, contact);
  return facing;
}

/* The sine of the angle between a plane and the view to one of its points. */
static double slope(const struct edge_finder *finder,
                    struct judge_point3 normal, struct judge_point3 at) {
  const struct judge_camera *camera = finder->camera;
  struct judge_point3 view = camera->perspective
                                 ? spot_unit(point3_sub(camera->eye, at))
                                 : camera->back;
  return point3_dot(normal, view);
}

/* Whether rounding does not turn a triangle over: its image is thicker. */
static bool is_thick(const struct edge_finder *finder,
                     const struct judge_triangle *t) {
  struct judge_point2 p[3];
  double longest = 0;
  for (int k = 0; k < 3; k++) {
    if (!(judge_ahead(finder->camera, t->p[k]) > judge_near(finder->camera)))
      return true;
    p[k] = judge_project(finder->camera, t->p[k]);
  }
  for (int k = 0; k < 3; k++)
    longest = fmax(longest,
                   hypot(p[(k + 1) % 3].x - p[k].x, p[(k + 1) % 3].y - p[k].y));
  return fabs((p[1].x - p[0].x) * (p[2].y - p[0].y) -
              (p[1].y - p[0].y) * (p[2].x - p[0].x)) >
         longest * finder->options->hair_mm;
}

static double fan_slope(const struct edge_finder *finder,
                        const struct judge_fan_triangle *fan_triangle,
                        struct judge_point3 at) {
  bool sure = !finder->facing[fan_triangle->face].thin &&
              is_thick(finder, &fan_triangle->triangle);
  return sure ? slope(finder, fan_triangle->triangle.normal, at) : 0;
}

/* How a face faces the view at a side of it, by the triangle that meets there
 * where it bends; 0 where that is not sure. */
static double slope_at_side(const struct edge_finder *finder,
                            const struct face_side *side) {
  struct judge_point3 at = judge_point3_at(finder->scene, side->a);
  const struct facing *facing = &finder->facing[side->face];
  size_t fan;
  const struct judge_fan_triangle *fan_triangle =
      judge_fan_along(finder->all, side->face, side->a, side->b, &fan);
  if (fan > 0)
    return fan == 1 ? fan_slope(finder, fan_triangle, at) : 0;
  return facing->flat || facing->open ? 0 : slope(finder, facing->normal, at);
}

static bool is_silhouette(double one, double two) {
  return (one > TOLERANCE_JUDGE_ANGLE && two < -TOLERANCE_JUDGE_ANGLE) ||
         (one < -TOLERANCE_JUDGE_ANGLE && two > TOLERANCE_JUDGE_ANGLE);
}

static bool is_sure(double one, double two) {
  return fabs(one) >= TOLERANCE_JUDGE_ANGLE &&
         fabs(two) >= TOLERANCE_JUDGE_ANGLE;
}

/* The natures of a side between two faces that run along it in the given
 * ways: against each other in a well-formed mesh. */
static unsigned natures_of_pair(const struct edge_finder *finder,
                                const struct face_side *s,
                                const struct face_side *t, bool against) {
  const struct facing *f = &finder->facing[s->face];
  const struct facing *g = &finder->facing[t->face];
  unsigned natures = 0;
  if (scene_groups_differ(finder->scene,
                          finder->scene->face_group.item[s->face],
                          finder->scene->face_group.item[t->face]))
    natures |= RECTO_EDGE_GROUP;
  double one = slope_at_side(finder, s), two = slope_at_side(finder, t);
  if (is_silhouette(one, against ? two : -two))
    natures |= RECTO_EDGE_SILHOUETTE;
  if (f->flat || g->flat)
    return natures;
  double cosine = point3_dot(f->normal, g->normal);
  cosine = against ? cosine : -cosine;
  double crease = cos(finder->options->crease_deg / 180 * acos(-1));
  if (cosine < crease - TOLERANCE_JUDGE_ANGLE)
    natures |= RECTO_EDGE_CREASE;
  if (natures == 0 && cosine > crease + TOLERANCE_JUDGE_ANGLE &&
      is_sure(one, two))
    natures = RECTO_EDGE_SMOOTH;
  return natures;
}

/* Whether two neighbouring corners of a face are these. */
static bool is_side(const struct scene *scene, uint32_t face, uint32_t a,
                    uint32_t b) {
  uint32_t start = scene->face_start.item[face];
  uint32_t count = scene->face_start.item[face + 1] - start;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t p = scene->corner.item[start + i];
    uint32_t q = scene->corner.item[start + (i + 1) % count];
    if ((p == a && q == b) || (p == b && q == a))
      return true;
  }
  return false;
}

/* Whether a side lies in the near plane, but for rounding: what the plane leaves
 * of the triangles beside it is then a sliver that may lie either way. */
static bool is_in_near_plane(const struct edge_finder *finder,
                             const struct judge_fan_triangle *fan_triangle) {
  const struct judge_camera *camera = finder->camera;
  double slack = judge_near_slack(camera);
  const uint32_t end[2] = {fan_triangle->low, fan_triangle->high};
  for (int k = 0; k < 2; k++)
    if (!(fabs(judge_ahead(camera, judge_point3_at(finder->scene, end[k])) -
               camera->near_d) <= slack))
      return false;
  return true;
}

/* Adds the diagonal of a face that bends, where its two triangles lie on one
 * side of it on the page, or may.  Where more of them meet between the same two
 * points, or a side of the face runs there too, it is not sure which belong
 * together. */
static bool add_fold(struct edge_finder *finder,
                     const struct judge_fan_triangle *fan_triangle,
                     size_t count) {
  struct judge_point3 at = judge_point3_at(finder->scene, fan_triangle->low);
  bool alone = count == 2 && !is_side(finder->scene, fan_triangle->face,
                                      fan_triangle->low, fan_triangle->high);
  double one = alone ? fan_slope(finder, &fan_triangle[0], at) : 0;
  double two = alone ? fan_slope(finder, &fan_triangle[1], at) : 0;
  bool silhouette = is_silhouette(one, two);
  if (!silhouette && is_sure(one, two) &&
      !is_in_near_plane(finder, fan_triangle))
    return true;
  const struct judge_source source = {{fan_triangle->low, fan_triangle->high},
                                      {fan_triangle->face, fan_triangle->face},
                                      silhouette ? RECTO_EDGE_SILHOUETTE : 0,
                                      false};
  return judge_edges_add(finder->edges, finder->camera, at,
                         judge_point3_at(finder->scene, fan_triangle->high),
                         &source);
}

static bool add_folds(struct edge_finder *finder) {
  const struct judge_fan_triangle *fan_triangle =
      finder->all->fan_triangle.item;
  size_t count = finder->all->fan_triangle.count;
  for (size_t i = 0, next; i < count; i = next) {
    for (next = i + 1; next < count &&
                       fan_triangle[next].face == fan_triangle[i].face &&
                       fan_triangle[next].low == fan_triangle[i].low &&
                       fan_triangle[next].high == fan_triangle[i].high;)
      next++;
    if (next > i + 1 && !add_fold(finder, &fan_triangle[i], next - i))
      return false;
  }
  return true;
}

/* Whether a side that is alone between its points lies there too.  Where points
 * at one place are joined it makes a border of what was a pair. */
static bool has_single(const struct edge_finder *finder,
                       const struct face_side *side) {
  uint32_t a = finder->page_point[side->a], b = finder->page_point[side->b];
  uint32_t low_end = a < b ? a : b, high_end = a < b ? b : a;
  const struct placed_side *single = finder->single;
  size_t low = 0, high = finder->singles;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (single[middle].low < low_end ||
        (single[middle].low == low_end && single[middle].high < high_end))
      low = middle + 1;
    else
      high = middle;
  }
  return low < finder->singles && single[low].low == low_end &&
         single[low].high == high_end;
}

/* Adds the edge of two sides; of a spike of one face, which goes out and comes
 * back, nothing is sure.
 * alone  no other sides lie there */
static bool add_pair(struct edge_finder *finder, const struct face_side *side,
                     const struct face_side *other, bool against, bool alone) {
  bool spike = side->face == other->face;
  const struct judge_source source = {
      {side->a, side->b},
      {side->face, other->face},
      spike || !alone ? 0 : natures_of_pair(finder, side, other, against),
      !spike};
  return judge_edges_add(finder->edges, finder->camera,
                         judge_point3_at(finder->scene, side->a),
                         judge_point3_at(finder->scene, side->b), &source);
}

/* Adds the edge of one side, or of more than two. */
static bool add_border(struct edge_finder *finder,
                       const struct face_side *side) {
  const struct judge_source source = {
      {side->a, side->b}, {side->face, SCENE_NONE}, RECTO_EDGE_BORDER, true};
  return judge_edges_add(finder->edges, finder->camera,
                         judge_point3_at(finder->scene, side->a),
                         judge_point3_at(finder->scene, side->b), &source);
}

/* Whether the face runs along the side from a to b. */
static bool runs_from(const struct edge_finder *finder,
                      const struct face_side *side, uint32_t a,
                      const uint32_t *page_point) {
  const struct scene *scene = finder->scene;
  uint32_t start = scene->face_start.item[side->face];
  uint32_t count = scene->face_start.item[side->face + 1] - start;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t p = scene->corner.item[start + i];
    uint32_t q = scene->corner.item[start + (i + 1) % count];
    bool forward = p == side->a && q == side->b;
    if (forward || (p == side->b && q == side->a))
      return (page_point == NULL ? p : page_point[p]) == a;
  }
  return false;
}

/* ---- Pairing ------------------------------------------------------------- */

static int compare_sides(const void *a, const void *b) {
  const struct face_side *s = a, *t = b;
  if (s->a != t->a)
    return s->a < t->a ? -1 : 1;
  if (s->b != t->b)
    return s->b < t->b ? -1 : 1;
  return s->face < t->face ? -1 : s->face > t->face;
}

static bool list_sides(const struct scene *scene, struct face_sides *sides) {
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene->face_start.item[i];
    uint32_t count = scene->face_start.item[i + 1] - start;
    for (uint32_t k = 0; k < count; k++) {
      uint32_t p = scene->corner.item[start + k];
      uint32_t q = scene->corner.item[start + (k + 1) % count];
      struct face_side side = {p < q ? p : q, p < q ? q : p, i};
      if (p != q && !ARRAY_PUSH(&sides->side, side))
        return false;
    }
  }
  judge_sort(sides->side.item, sides->side.count, sizeof *sides->side.item,
             compare_sides);
  return true;
}

/* Gives two sides or more of one pair of points their edge. */
static bool pair_group(struct edge_finder *finder, const struct face_side *side,
                       size_t count) {
  if (count == 2)
    return add_pair(finder, &side[0], &side[1],
                    runs_from(finder, &side[0], side->a, NULL) !=
                        runs_from(finder, &side[1], side->a, NULL),
                    !has_single(finder, side));
  return add_border(finder, side);
}

static int compare_placed(const void *a, const void *b) {
  const struct placed_side *s = a, *t = b;
  if (s->low != t->low)
    return s->low < t->low ? -1 : 1;
  if (s->high != t->high)
    return s->high < t->high ? -1 : 1;
  return compare_sides(&s->side, &t->side);
}

/* Gives single sides their places, in the order of these. */
static bool place_singles(struct edge_finder *finder,
                          const struct face_sides *single) {
  size_t count = single->side.count;
  const uint32_t *page_point = finder->page_point;
  struct placed_side *placed = mem_alloc(count, sizeof *placed);
  if (placed == NULL)
    return false;
  for (size_t i = 0; i < count; i++) {
    const struct face_side *side = &single->side.item[i];
    uint32_t a = page_point[side->a], b = page_point[side->b];
    placed[i] = (struct placed_side){a < b ? a : b, a < b ? b : a, *side};
  }
  judge_sort(placed, count, sizeof *placed, compare_placed);
  finder->single = placed;
  finder->singles = count;
  return true;
}

static bool pair_singles(struct edge_finder *finder) {
  const struct placed_side *placed = finder->single;
  const uint32_t *page_point = finder->page_point;
  bool ok = true;
  size_t count = finder->singles;
  for (size_t i = 0, next; ok && i < count; i = next) {
    for (next = i + 1; next < count && placed[next].low == placed[i].low &&
                       placed[next].high == placed[i].high;)
      next++;
    const struct face_side *side = &placed[i].side;
    if (next == i + 2)
      ok = add_pair(
          finder, side, &placed[i + 1].side,
          runs_from(finder, side, placed[i].low, page_point) !=
              runs_from(finder, &placed[i + 1].side, placed[i].low, page_point),
          true);
    else
      ok = add_border(finder, side);
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
          true};
      if (!judge_edges_add(finder->edges, finder->camera,
                           judge_point3_at(scene, source.point[0]),
                           judge_point3_at(scene, source.point[1]), &source))
        return false;
    }
  return true;
}

bool judge_edges_add(struct judge_edges *edges,
                     const struct judge_camera *camera, struct judge_point3 a,
                     struct judge_point3 b, const struct judge_source *source) {
  double da = judge_ahead(camera, a), db = judge_ahead(camera, b);
  double least = judge_near(camera);
  /* Behind the eye nothing has an image; just before it, no useful one. */
  if (camera->perspective)
    least = fmax(least, TOLERANCE_JUDGE_NEAR_SHARE * (fabs(da) + fabs(db)));
  if (da <= least && db <= least)
    return true;
  struct judge_point3 cut =
      spot_along(a, (least - da) / (db - da), point3_sub(b, a));
  if (da < least)
    a = cut;
  if (db < least)
    b = cut;
  struct judge_edge edge = {
      {a, b},
      {judge_project(camera, a), judge_project(camera, b)},
      {judge_depth(camera, a), judge_depth(camera, b)},
      *source};
  return ARRAY_PUSH(&edges->edge, edge);
}

/* Of each face the contact is the largest of its triangles. */
static bool find_facings(struct edge_finder *finder) {
  uint32_t faces = scene_face_count(finder->scene);
  finder->facing = mem_alloc(faces, sizeof *finder->facing);
  if (finder->facing == NULL)
    return false;
  double *contact = mem_calloc(faces, sizeof *contact);
  if (contact == NULL)
    return false;
  for (size_t t = 0; t < finder->all->triangle.count; t++) {
    const struct judge_triangle *triangle = &finder->all->triangle.item[t];
    contact[triangle->face] = fmax(contact[triangle->face], triangle->contact);
  }
  for (uint32_t i = 0; i < faces; i++)
    finder->facing[i] = facing_of(finder, i, contact[i]);
  mem_free(contact);
  return true;
}

/* Pairs the sides that have the same two points; those alone between theirs
 * are put aside.
 * single  where to; NULL: they are, and the others get their edges */
static bool pair_sides(struct edge_finder *finder,
                       const struct face_sides *sides,
                       struct face_sides *single) {
  bool ok = true;
  size_t count = sides->side.count;
  for (size_t i = 0, next; ok && i < count; i = next) {
    const struct face_side *side = sides->side.item + i;
    for (next = i + 1; next < count && sides->side.item[next].a == side->a &&
                       sides->side.item[next].b == side->b;)
      next++;
    if (next == i + 1 && single != NULL)
      ok = ARRAY_PUSH(&single->side, *side);
    else if (next > i + 1 && single == NULL)
      ok = pair_group(finder, side, next - i);
  }
  return ok;
}

bool judge_edges_init(struct judge_edges *edges, const struct scene *scene,
                      const struct judge_triangles *all,
                      const struct judge_camera *camera,
                      const struct judge_options *options) {
  struct edge_finder finder = {edges,  all,     scene,
                               camera, options, .facing = NULL};
  struct face_sides sides = {{0}}, single = {{0}};
  memset(edges, 0, sizeof *edges);
  finder.page_point = find_places(scene);
  bool ok = finder.page_point != NULL && find_facings(&finder) &&
            list_sides(scene, &sides) && pair_sides(&finder, &sides, &single) &&
            place_singles(&finder, &single) &&
            pair_sides(&finder, &sides, NULL) && pair_singles(&finder) &&
            add_folds(&finder) && add_wires(&finder) &&
            judge_edges_intersections(edges, all, camera, options->hair_mm);
  ARRAY_FREE(&sides.side);
  ARRAY_FREE(&single.side);
  mem_free(finder.facing);
  mem_free(finder.single);
  mem_free(finder.page_point);
  if (!ok)
    judge_edges_fini(edges);
  return ok;
}

void judge_edges_fini(struct judge_edges *edges) { ARRAY_FREE(&edges->edge); }
