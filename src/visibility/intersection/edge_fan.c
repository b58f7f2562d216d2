/* edge_fan.c - the triangles about an edge, and whether the surfaces of two
 * coincident edges cross there. */
#include "visibility/intersection/edge_fan.h"

#include <stdlib.h>

#include "base/number_filter.h"
#include "base/sort.h"

int surface_edge_compare(struct surface_edge a, struct surface_edge b) {
  if (a.j != b.j)
    return a.j < b.j ? -1 : 1;
  if (a.i != b.i)
    return a.i < b.i ? -1 : 1;
  return (a.face > b.face) - (a.face < b.face);
}

bool edge_is_upright(struct geom_point a, struct geom_point b) {
  return llabs((int64_t)b.y - a.y) > llabs((int64_t)b.x - a.x);
}

int edge_compare_along(bool upright, struct geom_point a, struct geom_point b) {
  if (upright && a.y != b.y)
    return a.y < b.y ? -1 : 1;
  return geom_compare_points(a, b);
}

struct surface_edge surface_edge_of(const struct sheet *sheet,
                                    uint32_t triangle, int k) {
  const struct sheet_triangle *t = &sheet->triangle.item[triangle];
  uint32_t i = t->point[k], j = t->point[geom_next_corner(k)];
  return (struct surface_edge){
      i < j ? i : j, i < j ? j : i,
      sheet_is_inner_side(sheet, triangle, k) ? t->face : SHEET_NONE};
}

/* ---- Incidence of edges and triangles ------------------------------------ */

static int compare_incidences(const void *a, const void *b, void *user) {
  const struct incidence *r = a, *s = b;
  int order = surface_edge_compare(r->edge, s->edge);
  (void)user;
  return order != 0 ? order
                    : (r->triangle > s->triangle) - (r->triangle < s->triangle);
}

const struct incidence *incidences_find(const struct incidences *incidences,
                                        struct surface_edge edge,
                                        const struct incidence **end) {
  const struct incidence *incidence = incidences->list.item;
  size_t first, past;
  LOWER_BOUND(first, 0, incidences->list.count,
              surface_edge_compare(incidence[first].edge, edge) < 0);
  for (past = first; past < incidences->list.count &&
                     surface_edge_compare(incidence[past].edge, edge) == 0;)
    past++;
  *end = incidence + past;
  return incidence + first;
}

struct marked_points {
  const struct sheet *sheet;
  const uint8_t *marked; /* one a point: 0 or 1 */
};

/* Keeps the triangles with two marked corners. */
static size_t triangles_of_range(const void *user, struct parallel_range range,
                                 uint32_t *kept) {
  const struct marked_points *points = user;
  const uint8_t *marked = points->marked;
  size_t count = 0;
  for (size_t t = range.begin; t < range.end; t++) {
    const uint32_t *p = points->sheet->triangle.item[t].point;
    if (marked[p[0]] + marked[p[1]] + marked[p[2]] >= 2)
      kept[count++] = (uint32_t)t;
  }
  return count;
}

/* Adds a triangle's edges between marked points. */
static bool add_incidences(struct incidences *incidences,
                           const struct marked_points *points,
                           uint32_t triangle) {
  for (int k = 0; k < 3; k++) {
    struct incidence incidence = {surface_edge_of(points->sheet, triangle, k),
                                  triangle};
    if (points->marked[incidence.edge.i] && points->marked[incidence.edge.j] &&
        !ARRAY_PUSH(&incidences->list, incidence))
      return false;
  }
  return true;
}

bool incidences_init(struct incidences *incidences, const struct sheet *sheet,
                     const uint8_t *marked) {
  struct marked_points points = {sheet, marked};
  size_t count = 0;
  uint32_t *triangle =
      number_filter(sheet->triangle.count, triangles_of_range, &points, &count);
  bool ok = triangle != NULL;
  for (size_t i = 0; ok && i < count; i++)
    ok = add_incidences(incidences, &points, triangle[i]);
  mem_free(triangle);
  return ok &&
         sort_stable(incidences->list.item, incidences->list.count,
                     sizeof *incidences->list.item, compare_incidences, NULL);
}

void incidences_fini(struct incidences *incidences) {
  ARRAY_FREE(&incidences->list);
}

/* ---- Fans ---------------------------------------------------------------- */

static struct side_triangle fan_triangle_of(const struct sheet *sheet,
                                            struct surface_edge edge,
                                            uint32_t triangle, bool reversed) {
  const struct geom_point *point = sheet->point.item;
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int k = 0;
  while (p[k] == edge.i || p[k] == edge.j)
    k++;
  return (struct side_triangle){point[reversed ? edge.j : edge.i],
                                point[reversed ? edge.i : edge.j], point[p[k]],
                                triangle};
}

/* The sense of the smaller angle from triangle a to triangle b about the edge,
 * as the sign of a volume; 0: they are coplanar.  Exact. */
static int turn_sign(const struct side_triangle *a,
                     const struct side_triangle *b) {
  struct geom_plane plane = geom_plane_of(a->from, a->to, a->third);
  return geom_sign128(geom_plane_value(&plane, b->third));
}

/* Is c between a and b in the positive sense about the edge?  Exact. */
static bool is_between(const struct side_triangle *a,
                       const struct side_triangle *b,
                       const struct side_triangle *c) {
  if (turn_sign(a, b) > 0)
    return turn_sign(a, c) > 0 && turn_sign(c, b) > 0;
  return !(turn_sign(b, c) > 0 && turn_sign(c, a) > 0);
}

/* On which side of its edge a triangle of a fan lies, by the sign of its
 * projected area: on the page, or (`across`) on the coordinate plane of depth
 * and the edge's longer page coordinate. */
static int side_of_edge(const struct side_triangle *w, bool across) {
  bool upright = edge_is_upright(w->from, w->to);
  int64_t dx, dz, x, z;
  if (!across)
    return geom_sign64(geom_orient2d(w->from, w->to, w->third));
  dx = upright ? (int64_t)w->to.y - w->from.y : (int64_t)w->to.x - w->from.x;
  x = upright ? (int64_t)w->third.y - w->from.y
              : (int64_t)w->third.x - w->from.x;
  dz = w->to.z - w->from.z;
  z = w->third.z - w->from.z;
  return geom_sign128((int128)dx * z - (int128)dz * x);
}

/* Are two triangles of fans about coincident edges in contact, on the same side
 * of the edge? */
static bool are_in_contact(const struct sheet *sheet,
                           const struct side_triangle *a,
                           const struct side_triangle *b) {
  bool across = side_of_edge(a, false) == 0 || side_of_edge(b, false) == 0;
  struct occluder plane[2];
  struct corner_counts count[2];
  int sign = side_of_edge(a, across) * side_of_edge(b, across);
  if (sign < 0)
    return false;
  occluder_init(&plane[0], sheet, a->triangle);
  occluder_init(&plane[1], sheet, b->triangle);
  for (int k = 0; k < 2; k++)
    count[k] = corner_counts_of(&plane[k], plane[1 - k].p);
  return count[0].behind + count[0].in_front == 0 ||
         count[1].behind + count[1].in_front == 0;
}

/* Collects the triangles incident to an edge; reversed: in its opposite
 * direction. */
static bool gather_fan(struct edge_fan *fan, const struct sheet *sheet,
                       const struct incidences *incidences,
                       struct surface_edge edge, bool reversed) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  fan->list.count = 0;
  for (; incidence < end; incidence++)
    if (!ARRAY_PUSH(&fan->list, fan_triangle_of(sheet, edge,
                                                incidence->triangle, reversed)))
      return false;
  return true;
}

/* Removes the triangles of a fan that are in contact with one of the others. */
static void drop_touching(const struct sheet *sheet, struct edge_fan *fan,
                          const struct edge_fan *others) {
  struct side_triangle *w = fan->list.item;
  size_t kept = 0;
  for (size_t i = 0; i < fan->list.count; i++) {
    bool touches = false;
    for (size_t j = 0; j < others->list.count && !touches; j++)
      touches = are_in_contact(sheet, &w[i], &others->list.item[j]);
    if (!touches)
      w[kept++] = w[i];
  }
  fan->list.count = kept;
}

/* Do the triangles of two fans alternate about the edge: are those of b in more
 * than one of the angles between those of a?  If so, the first of a and some
 * other of a separate the first of b from some other of b: these pairs
 * suffice. */
static bool do_alternate(const struct edge_fan *a, const struct edge_fan *b) {
  const struct side_triangle *u = a->list.item, *v = b->list.item;
  for (size_t i = 1; i < a->list.count; i++)
    for (size_t j = 1; j < b->list.count; j++)
      if (is_between(&u[0], &u[i], &v[j]) != is_between(&u[0], &u[i], &v[0]))
        return true;
  return false;
}

/* Do two overlapping edges have opposite directions? */
static bool are_opposite(const struct sheet *sheet, struct surface_edge e,
                         struct surface_edge f) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool upright = edge_is_upright(a, b);
  return edge_compare_along(upright, a, b) != edge_compare_along(upright, c, d);
}

bool edge_fans_cross(const struct sheet *sheet,
                     const struct incidences *incidences,
                     const struct surface_edge edge[2],
                     struct edge_fan scratch[3], bool *cross) {
  bool opposite = are_opposite(sheet, edge[0], edge[1]);
  if (!gather_fan(&scratch[0], sheet, incidences, edge[0], false) ||
      !gather_fan(&scratch[1], sheet, incidences, edge[1], opposite) ||
      !gather_fan(&scratch[2], sheet, incidences, edge[0], false))
    return false;
  drop_touching(sheet, &scratch[0], &scratch[1]);
  drop_touching(sheet, &scratch[1], &scratch[2]);
  *cross = do_alternate(&scratch[0], &scratch[1]);
  return true;
}
