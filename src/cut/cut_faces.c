/* cut_faces.c - splits the faces that planes meet.
 *
 * A face is split by one plane after the other: what is below a plane stays,
 * what is beyond it goes on to the next.  A polygon whose boundary meets a
 * plane twice is split as it is; one that meets it more often, or is not
 * planar, triangle by triangle. */
#include <string.h>

#include "base/poll.h"
#include "cut/cut_phases.h"
#include "geom/predicate.h"
#include "geom/vector.h"

struct cut_loop {
  uint32_t face;
  bool is_convex; /* of a triangle */
  ARRAY(struct cut_corner) corner;
};

static size_t next_in_loop(const struct cut_loop *loop, size_t i) {
  return i + 1 < loop->corner.count ? i + 1 : 0;
}

/* Adds a corner, unless it is the point of the last one. */
static bool add_corner(struct cut_loop *loop, uint32_t point, uint8_t plane) {
  const struct cut_corner corner = {point, plane};
  size_t count = loop->corner.count;
  if (count > 0 && loop->corner.item[count - 1].point == point) {
    loop->corner.item[count - 1].plane = plane;
    return true;
  }
  return ARRAY_PUSH(&loop->corner, corner);
}

/* Ends the corners of a loop: the last is not the first one again. */
static void end_loop(struct cut_loop *loop) {
  while (loop->corner.count > 1 &&
         loop->corner.item[loop->corner.count - 1].point ==
             loop->corner.item[0].point)
    loop->corner.count--;
}

static bool store_part(struct cutter *cutter, const struct cut_loop *loop,
                       bool united) {
  const struct cut_part part = {loop->face, (uint32_t)cutter->corner.count,
                                (uint32_t)loop->corner.count, united};
  for (size_t i = 0; i < loop->corner.count; i++)
    if (!ARRAY_PUSH(&cutter->corner, loop->corner.item[i]))
      return false;
  return ARRAY_PUSH(&cutter->part, part);
}

/* Stores the sides in the planes of a part that goes. */
static bool store_lines(struct cutter *cutter, const struct cut_loop *loop) {
  uint32_t group = scene_face_group(cutter->scene, loop->face);
  for (size_t i = 0; i < loop->corner.count; i++) {
    const struct cut_corner *corner = &loop->corner.item[i];
    const struct cut_line line = {
        corner->point, loop->corner.item[next_in_loop(loop, i)].point, group,
        corner->plane, false};
    if (corner->plane != CUT_NO_PLANE && line.from != line.to &&
        !ARRAY_PUSH(&cutter->lines.line, line))
      return false;
  }
  return true;
}

/* Splits a loop that meets a plane twice into what is below and beyond it. */
static bool split_loop(struct cutter *cutter, const struct cut_loop *loop,
                       unsigned plane, struct cut_loop *below,
                       struct cut_loop *beyond) {
  bool ok = true;
  for (size_t i = 0; ok && i < loop->corner.count; i++) {
    const struct cut_corner *a = &loop->corner.item[i];
    const struct cut_corner *b = &loop->corner.item[next_in_loop(loop, i)];
    bool from = cut_is_beyond(&cutter->points, a->point, plane);
    bool to = cut_is_beyond(&cutter->points, b->point, plane);
    struct cut_loop *here = from ? beyond : below;
    ok = add_corner(here, a->point, a->plane);
    if (from == to)
      continue;
    uint32_t meet = cut_points_meet(&cutter->points, a->point, b->point, plane);
    ok = ok && meet != SCENE_NONE && add_corner(here, meet, (uint8_t)plane) &&
         add_corner(from ? below : beyond, meet, a->plane);
  }
  end_loop(below);
  end_loop(beyond);
  return ok;
}

static bool cut_loop(struct cutter *cutter, const struct cut_loop *loop,
                     unsigned plane);

static struct scene_point point_position(const struct cutter *cutter,
                                         uint32_t p) {
  return p < cutter->points.first
             ? cutter->scene->point.item[p]
             : cut_points_position(&cutter->points,
                                   cut_point_of(&cutter->points, p)->at);
}

static struct scene_point corner_position(const struct cutter *cutter,
                                          const struct cut_loop *loop,
                                          size_t i) {
  return point_position(cutter, loop->corner.item[i].point);
}

/* Whether two corners of a loop are at one place; they may be a point of the
 * scene and the one that a plane makes of it. */
static bool are_together(const struct cutter *cutter,
                         const struct cut_loop *loop, size_t i, size_t j) {
  struct scene_point p = corner_position(cutter, loop, i);
  struct scene_point q = corner_position(cutter, loop, j);
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

/* Adds a corner of a triangle, and where its side is one of the loop's in a
 * plane, that side's own ends. */
static bool add_triangle_corner(const struct cutter *cutter,
                                const struct cut_loop *loop,
                                const struct triangulation_triangle *triangle,
                                int k, struct cut_loop *part) {
  const struct cut_corner *corner = loop->corner.item;
  uint32_t from = triangle->corner[k],
           to = triangle->corner[geom_next_corner(k)];
  uint32_t side = triangle->side[k];
  if (!add_corner(part, corner[from].point, CUT_NO_PLANE))
    return false;
  if (side >= loop->corner.count || corner[side].plane == CUT_NO_PLANE)
    return true;
  size_t next = next_in_loop(loop, side);
  return !are_together(cutter, loop, from, side) ||
         !are_together(cutter, loop, to, next) ||
         (add_corner(part, corner[side].point, corner[side].plane) &&
          add_corner(part, corner[next].point, CUT_NO_PLANE));
}

static bool cut_triangles(struct cutter *cutter, const struct cut_loop *loop,
                          unsigned plane) {
  const struct triangulation *triangulation = &cutter->triangulation;
  size_t count = triangulation->triangle.count;
  struct triangulation_triangle *triangle = mem_alloc(count, sizeof *triangle);
  struct cut_loop part = {.face = loop->face, .is_convex = true};
  bool ok = triangle != NULL;
  for (size_t t = 0; ok && t < count; t++)
    triangle[t] = triangulation->triangle.item[t];
  for (size_t t = 0; ok && t < count; t++) {
    part.corner.count = 0;
    for (int k = 0; ok && k < 3; k++)
      ok = add_triangle_corner(cutter, loop, &triangle[t], k, &part);
    end_loop(&part);
    ok = ok && cut_loop(cutter, &part, plane);
  }
  ARRAY_FREE(&part.corner);
  mem_free(triangle);
  return ok;
}

/* Triangulates a loop by the rule for all polygons. */
static bool triangulate_loop(struct cutter *cutter,
                             const struct cut_loop *loop) {
  size_t count = loop->corner.count;
  struct scene_point *point = mem_alloc(count, sizeof *point);
  uint32_t *corner = mem_alloc(count, sizeof *corner);
  bool ok = point != NULL && corner != NULL;
  for (uint32_t i = 0; ok && i < count; i++) {
    corner[i] = i;
    point[i] = corner_position(cutter, loop, i);
  }
  ok = ok && triangulate(&cutter->triangulation, point, corner, count);
  mem_free(point);
  mem_free(corner);
  return ok;
}

/* Stores a part that stays, if it has an area. */
static bool store_below(struct cutter *cutter, const struct cut_loop *loop) {
  return loop->corner.count < 3 || store_part(cutter, loop, false);
}

/* Splits what is beyond the planes before `plane`.  A loop of two corners is an
 * edge in one of these planes, whose face is below it: the edge is a line where
 * it goes. */
static bool cut_loop(struct cutter *cutter, const struct cut_loop *loop,
                     unsigned plane) {
  if (loop->corner.count < 2)
    return true;
  if (plane == cutter->points.planes) {
    cutter->anything_goes = true;
    cutter->edge_goes = cutter->edge_goes || loop->corner.count == 2;
    return store_lines(cutter, loop);
  }
  size_t count = loop->corner.count, beyonds = 0, changes = 0;
  for (size_t i = 0; i < count; i++) {
    bool here =
        cut_is_beyond(&cutter->points, loop->corner.item[i].point, plane);
    beyonds += here;
    changes +=
        here != cut_is_beyond(&cutter->points,
                              loop->corner.item[next_in_loop(loop, i)].point,
                              plane);
  }
  if (beyonds == 0)
    return store_below(cutter, loop);
  if (beyonds == count)
    return cut_loop(cutter, loop, plane + 1);
  if (count > 3 && !loop->is_convex) {
    if (!triangulate_loop(cutter, loop))
      return false;
    cutter->is_warped = cutter->is_warped || cutter->triangulation.warped;
    if (changes > 2 || cutter->triangulation.warped)
      return cut_triangles(cutter, loop, plane);
  }
  struct cut_loop below = {.face = loop->face, .is_convex = loop->is_convex};
  struct cut_loop beyond = below;
  bool ok = split_loop(cutter, loop, plane, &below, &beyond) &&
            store_below(cutter, &below) && cut_loop(cutter, &beyond, plane + 1);
  ARRAY_FREE(&below.corner);
  ARRAY_FREE(&beyond.corner);
  return ok;
}

/* ---- Parts of one face --------------------------------------------------- */

/* The sides of the parts of a face. */
struct part_sides {
  ARRAY(struct cut_line) side;
  ARRAY(struct sort_key) key; /* by their ends; then by where they begin */
};

/* Adds a side, in the pieces into which planes from `plane` on split it. */
static bool add_part_side(struct part_sides *sides,
                          const struct cut_points *points, uint32_t from,
                          uint32_t to, unsigned plane) {
  for (unsigned k = plane; k < points->planes; k++) {
    if (cut_is_beyond(points, from, k) == cut_is_beyond(points, to, k))
      continue;
    uint32_t meet = cut_points_find(points, from, to, k);
    if (meet != SCENE_NONE)
      return add_part_side(sides, points, from, meet, k + 1) &&
             add_part_side(sides, points, meet, to, k + 1);
  }
  const struct cut_line side = {from, to, 0, CUT_NO_PLANE, from == to};
  return ARRAY_PUSH(&sides->side, side);
}

static bool add_part_sides(struct part_sides *sides,
                           const struct cutter *cutter,
                           const struct cut_part *part) {
  const struct cut_corner *corner = cutter->corner.item + part->corner;
  for (uint32_t i = 0; i < part->count; i++)
    if (!add_part_side(sides, &cutter->points, corner[i].point,
                       corner[i + 1 < part->count ? i + 1 : 0].point,
                       corner[i].plane == CUT_NO_PLANE ? CUT_PLANES_MAX
                                                       : corner[i].plane + 1u))
      return false;
  return true;
}

/* Opens sides that two parts have in common, and sorts the others by where they
 * begin. */
static bool cancel_common_sides(struct part_sides *sides) {
  struct cut_line *side = sides->side.item;
  bool ok = true;
  sides->key.count = 0;
  for (uint32_t i = 0; ok && i < sides->side.count; i++)
    ok = ARRAY_PUSH(
        &sides->key,
        ((struct sort_key){sort_pair_key(side[i].from, side[i].to), i}));
  ok = ok && sort_keys_alone(sides->key.item, sides->key.count);
  for (size_t i = 1; ok && i < sides->key.count; i++) {
    struct cut_line *a = &side[sides->key.item[i - 1].value];
    struct cut_line *b = &side[sides->key.item[i].value];
    if (!a->open && !b->open && a->from == b->to && a->to == b->from)
      a->open = b->open = true;
  }
  sides->key.count = 0;
  for (uint32_t i = 0; ok && i < sides->side.count; i++)
    ok = side[i].open ||
         ARRAY_PUSH(&sides->key, ((struct sort_key){side[i].from, i}));
  return ok && sort_keys_alone(sides->key.item, sides->key.count);
}

/* Walks around from side `start`, and takes the sides on its way out of the
 * list. */
static bool walk_around(const struct part_sides *sides, size_t start,
                        struct cut_loop *polygon) {
  const struct sort_key *key = sides->key.item;
  size_t count = sides->key.count, at = start;
  polygon->corner.count = 0;
  do {
    struct cut_line *side = &sides->side.item[key[at].value];
    if ((at + 1 < count && key[at + 1].key == key[at].key) || side->open ||
        !add_corner(polygon, side->from, CUT_NO_PLANE))
      return false;
    side->open = true;
    LOWER_BOUND(at, 0, count, key[at].key < side->to);
    if (at == count || key[at].key != side->to)
      return false;
  } while (at != start);
  return polygon->corner.count >= 3;
}

/* Adds twice the area of a part, a vector, to a sum. */
static void add_part_area(const struct cutter *cutter, size_t part,
                          double sum[3]) {
  const struct cut_part *from = &cutter->part.item[part];
  const struct cut_corner *corner = cutter->corner.item + from->corner;
  struct scene_point p = point_position(cutter, corner[0].point);
  double last[3] = {0}, next[3], area[3];
  for (uint32_t i = 1; i < from->count; i++, memcpy(last, next, sizeof last)) {
    struct scene_point q = point_position(cutter, corner[i].point);
    next[0] = q.x - p.x;
    next[1] = q.y - p.y;
    next[2] = q.z - p.z;
    vector_cross(last, next, area);
    for (int k = 0; k < 3; k++)
      sum[k] += area[k];
  }
}

/* Whether all parts from `first` on are wound the same way: none is the rim of
 * a hole in another. */
static bool are_wound_alike(const struct cutter *cutter, size_t first) {
  double whole[3] = {0};
  size_t past = cutter->part.count;
  for (size_t p = first; p < past; p++)
    add_part_area(cutter, p, whole);
  for (size_t p = first; p < past; p++) {
    double area[3] = {0};
    add_part_area(cutter, p, area);
    if (!(vector_dot(area, whole) > 0))
      return false;
  }
  return true;
}

/* Stores the polygons that the sides left over are of, as parts from `first`
 * on.  Returns whether they are simple polygons, each in a place of its own. */
static bool store_polygons(struct cutter *cutter, size_t first,
                           const struct part_sides *sides,
                           struct cut_loop *polygon) {
  for (size_t at = 0; at < sides->key.count; at++)
    if (!sides->side.item[sides->key.item[at].value].open &&
        !(walk_around(sides, at, polygon) && store_part(cutter, polygon, true)))
      return false;
  return cutter->part.count == first + 1 || are_wound_alike(cutter, first);
}

/* Makes the parts of a face from `first` on as few as they can be, where they
 * are polygons without holes; else each gets the corners at which others of
 * them end.  Either way sides in a plane are divided where others meet them. */
static bool unite_parts(struct cutter *cutter, size_t first,
                        struct part_sides *sides, struct cut_loop *polygon) {
  size_t past = cutter->part.count, corners = cutter->corner.count;
  bool ok = true;
  sides->side.count = 0;
  for (size_t p = first; ok && p < past; p++)
    ok = add_part_sides(sides, cutter, &cutter->part.item[p]);
  ok = ok && cancel_common_sides(sides);
  if (ok && !cutter->is_warped &&
      store_polygons(cutter, past, sides, polygon)) {
    size_t count = cutter->part.count - past;
    struct cut_part *part = cutter->part.item;
    memmove(part + first, part + past, count * sizeof *part);
    cutter->part.count = first + count;
    return true;
  }
  cutter->part.count = past;
  cutter->corner.count = corners;
  for (size_t p = first; ok && p < past; p++) {
    struct cut_part *part = &cutter->part.item[p];
    sides->side.count = 0;
    ok = add_part_sides(sides, cutter, part);
    part->corner = (uint32_t)cutter->corner.count;
    part->count = (uint32_t)sides->side.count;
    for (size_t i = 0; ok && i < sides->side.count; i++)
      ok = ARRAY_PUSH(
          &cutter->corner,
          ((struct cut_corner){sides->side.item[i].from, CUT_NO_PLANE}));
  }
  return ok;
}

/* ---- Faces --------------------------------------------------------------- */

static enum cut_fate fate_of_face(const struct cutter *cutter, uint32_t face) {
  const struct scene *scene = cutter->scene;
  unsigned whole = (1u << cutter->points.planes) - 1, any = 0, all = whole;
  for (uint32_t c = scene_face_start(scene, face);
       c < scene_face_start(scene, face + 1); c++) {
    unsigned beyond =
        cutter->points.beyond[cut_weld(cutter, scene->corner.item[c])];
    any |= beyond;
    all &= beyond;
  }
  return any != whole ? CUT_STAYS : all == whole ? CUT_GOES : CUT_IS_SPLIT;
}

recto_status cut_faces(struct cutter *cutter, recto_error *error) {
  const struct scene *scene = cutter->scene;
  struct cut_loop loop = {.face = 0};
  struct part_sides sides = {{0}, {0}};
  cutter->fate = mem_alloc(scene_face_count(scene), sizeof *cutter->fate);
  bool ok = cutter->fate != NULL;
  for (uint32_t face = 0; ok && face < scene_face_count(scene); face++) {
    enum cut_fate fate = fate_of_face(cutter, face);
    cutter->fate[face] = (uint8_t)fate;
    cutter->anything_goes = cutter->anything_goes || fate == CUT_GOES;
    ok = poll_at(face);
    if (!ok || fate != CUT_IS_SPLIT)
      continue;
    loop.face = face;
    loop.corner.count = 0;
    for (uint32_t c = scene_face_start(scene, face);
         ok && c < scene_face_start(scene, face + 1); c++)
      ok = add_corner(&loop, cut_weld(cutter, scene->corner.item[c]),
                      CUT_NO_PLANE);
    end_loop(&loop);
    size_t first = cutter->part.count;
    cutter->is_warped = cutter->edge_goes = false;
    ok = ok && cut_loop(cutter, &loop, 0) &&
         (cutter->part.count <= first + !cutter->edge_goes ||
          unite_parts(cutter, first, &sides, &loop));
  }
  ARRAY_FREE(&loop.corner);
  ARRAY_FREE(&sides.side);
  ARRAY_FREE(&sides.key);
  return ok ? RECTO_OK : error_memory(error);
}
