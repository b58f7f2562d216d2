/* edge_crossing.c - finds where surfaces pass through each other along an
 * edge. */
#include "visibility/intersection/edge_crossing.h"

#include <stdlib.h>

#include "base/sort.h"
#include "base/tolerance.h"

struct side_count side_count_of(const struct occluder *plane,
                                const struct geom_point p[3]) {
  struct side_count count = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    int side = occluder_side(plane, p[k]);
    count.behind += side < 0;
    count.in_front += side > 0;
    if (side != 0)
      count.off_plane = k;
  }
  return count;
}

/* ---- Candidates ---------------------------------------------------------- */

/* The side of a triangle that ends on a plane. */
static struct edge_crossing_side
edge_of(const struct sheet *sheet, uint32_t triangle, struct side_count count) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  uint32_t i = p[(count.off_plane + 1) % 3], j = p[(count.off_plane + 2) % 3];
  return (struct edge_crossing_side){i < j ? i : j, i < j ? j : i};
}

/* Edges by their ends, then triangles by index. */
static int compare_sides(struct edge_crossing_side a,
                         struct edge_crossing_side b) {
  if (a.j != b.j)
    return a.j < b.j ? -1 : 1;
  return (a.i > b.i) - (a.i < b.i);
}

bool edge_crossings_add(struct edge_crossings *crossings,
                        const struct sheet *sheet, uint32_t f,
                        struct side_count sf, uint32_t g,
                        struct side_count sg) {
  struct edge_crossing crossing = {{edge_of(sheet, f, sf), {g, SHEET_NONE}}};
  if (ends_on_plane(sg))
    crossing.side[1] = edge_of(sheet, g, sg);
  if (compare_sides(crossing.side[0], crossing.side[1]) > 0) {
    struct edge_crossing_side swap = crossing.side[0];
    crossing.side[0] = crossing.side[1];
    crossing.side[1] = swap;
  }
  return ARRAY_PUSH(&crossings->list, crossing);
}

bool edge_crossings_add_slanted(struct edge_crossings *crossings,
                                const struct sheet *sheet, uint32_t f,
                                uint32_t g, const struct occluder *plane) {
  const uint32_t *p = sheet->triangle.item[f].point;
  int side[3], sign[3];
  for (int k = 0; k < 3; k++) {
    struct geom_point corner = sheet->point.item[p[k]];
    side[k] = occluder_side(plane, corner);
    sign[k] = geom_sign128(geom_plane_value(&plane->plane, corner));
  }
  for (int k = 0; k < 3; k++) {
    int next = geom_next_corner(k);
    struct edge_crossing crossing = {
        {{p[k] < p[next] ? p[k] : p[next], p[k] < p[next] ? p[next] : p[k]},
         {g, SHEET_NONE}}};
    if ((side[k] == 0) != (side[next] == 0) && sign[k] * sign[next] < 0 &&
        !ARRAY_PUSH(&crossings->slanted, crossing))
      return false;
  }
  return true;
}

void edge_crossings_fini(struct edge_crossings *crossings) {
  ARRAY_FREE(&crossings->list);
  ARRAY_FREE(&crossings->slanted);
}

/* ---- Clipping ------------------------------------------------------------ */

/* Clips an edge to triangle g on the page.
 * end  gets the ends of the clipped edge, rounded to the grid
 * Returns false where nothing is left. */
static bool clip_to_triangle(const struct sheet *sheet,
                             struct edge_crossing_side edge, uint32_t g,
                             struct geom_point end[2]) {
  const struct geom_triangle corner = sheet_corners(sheet, g);
  const struct geom_point p = sheet->point.item[edge.i],
                          q = sheet->point.item[edge.j];
  struct occluded_interval part;
  if ((sheet->triangle_flags[g] & SHEET_FLAT) ||
      !occlude_by_outline(corner.p, p, q, &part))
    return false;
  for (int k = 0; k < 2; k++) {
    struct ratio t_k = k == 0 ? part.from : part.to;
    end[k] = (struct geom_point){(int32_t)ratio_lerp(t_k, p.x, q.x),
                                 (int32_t)ratio_lerp(t_k, p.y, q.y),
                                 ratio_lerp(t_k, p.z, q.z)};
  }
  return true;
}

/* Does p lie on the line through a and b on the page, within
 * TOLERANCE_COINCIDENT_UNITS? */
static bool is_near_line(struct geom_point a, struct geom_point b,
                         struct geom_point p) {
  const int128 near = TOLERANCE_COINCIDENT_UNITS;
  int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y,
          off = geom_orient2d(a, b, p);
  return (int128)off * off <= near * near * ((int128)x * x + (int128)y * y);
}

/* Is a-b closer to the vertical than to the horizontal of the page? */
static bool is_steep(struct geom_point a, struct geom_point b) {
  return llabs((int64_t)b.y - a.y) > llabs((int64_t)b.x - a.x);
}

/* The order of two points along edges that are steep, by y, or are not, by x.
 * The other coordinate cannot serve: rounding turns an upright edge by a
 * unit. */
static int compare_along(bool steep, struct geom_point a, struct geom_point b) {
  if (steep && a.y != b.y)
    return a.y < b.y ? -1 : 1;
  return geom_compare_points(a, b);
}

static void sort_two(bool steep, struct geom_point *a, struct geom_point *b) {
  if (compare_along(steep, *a, *b) > 0) {
    struct geom_point swap = *a;
    *a = *b;
    *b = swap;
  }
}

/* The overlap of two edges: the middle two of their four ends, provided that
 * these lie on both lines.  That must be tested, since edges of nearly coplanar
 * faces touch each other's planes wherever they run.
 * Returns false where they do not overlap. */
static bool clip_to_edge(const struct sheet *sheet, struct edge_crossing_side e,
                         struct edge_crossing_side f,
                         struct geom_point end[2]) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool steep = is_steep(a, b);
  sort_two(steep, &a, &b);
  sort_two(steep, &c, &d);
  end[0] = compare_along(steep, a, c) > 0 ? a : c;
  end[1] = compare_along(steep, b, d) < 0 ? b : d;
  for (int k = 0; k < 2; k++)
    if (!is_near_line(a, b, end[k]) || !is_near_line(c, d, end[k]))
      return false;
  return compare_along(steep, end[0], end[1]) < 0;
}

/* ---- Incidence of edges and triangles ------------------------------------ */

/* A triangle and one of its edges. */
struct incidence {
  struct edge_crossing_side edge;
  uint32_t triangle;
};

struct incidences {
  ARRAY(struct incidence) list; /* by edge, then triangle */
};

static int compare_incidences(const void *a, const void *b, void *user) {
  const struct incidence *r = a, *s = b;
  int order = compare_sides(r->edge, s->edge);
  (void)user;
  return order != 0 ? order
                    : (r->triangle > s->triangle) - (r->triangle < s->triangle);
}

/* The incidences of an edge: from the result up to `end`. */
static const struct incidence *
incidences_find(const struct incidences *incidences,
                struct edge_crossing_side edge, const struct incidence **end) {
  const struct incidence *incidence = incidences->list.item;
  size_t first, past;
  LOWER_BOUND(first, 0, incidences->list.count,
              compare_sides(incidence[first].edge, edge) < 0);
  for (past = first; past < incidences->list.count &&
                     compare_sides(incidence[past].edge, edge) == 0;)
    past++;
  *end = incidence + past;
  return incidence + first;
}

/* Adds the sides of a triangle that run between marked points. */
static bool add_incidences(struct incidences *incidences,
                           const struct sheet *sheet, const uint8_t *marked,
                           uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    uint32_t i = p[k], j = p[geom_next_corner(k)];
    struct incidence incidence = {{i < j ? i : j, i < j ? j : i}, triangle};
    if (marked[i] && marked[j] && !ARRAY_PUSH(&incidences->list, incidence))
      return false;
  }
  return true;
}

/* Finds all triangles incident to the edges of the candidates, and maybe
 * others. */
static bool incidences_init(struct incidences *incidences,
                            const struct sheet *sheet,
                            const struct edge_crossings *crossings) {
  uint8_t *marked = mem_calloc(sheet->point.count, sizeof *marked);
  bool ok = false;
  if (marked == NULL)
    return false;
  for (size_t s = 0; s < 2 * crossings->list.count; s++) {
    struct edge_crossing_side side = crossings->list.item[s / 2].side[s % 2];
    if (side.j != SHEET_NONE)
      marked[side.i] = marked[side.j] = 1;
  }
  for (size_t s = 0; s < crossings->slanted.count; s++) {
    struct edge_crossing_side side = crossings->slanted.item[s].side[0];
    marked[side.i] = marked[side.j] = 1;
  }
  for (uint32_t t = 0; t < sheet->triangle.count; t++)
    if (!add_incidences(incidences, sheet, marked, t))
      goto end;
  ok = sort_stable(incidences->list.item, incidences->list.count,
                   sizeof *incidences->list.item, compare_incidences, NULL);
end:
  mem_free(marked);
  return ok;
}

static void incidences_fini(struct incidences *incidences) {
  ARRAY_FREE(&incidences->list);
}

/* ---- Fans ---------------------------------------------------------------- */

/* A triangle of the fan about an edge: the edge, in the direction that is
 * common to all, and the triangle's third corner. */
struct fan_triangle {
  struct geom_point from, to, third;
  uint32_t triangle;
};

static struct fan_triangle fan_triangle_of(const struct sheet *sheet,
                                           struct edge_crossing_side edge,
                                           uint32_t triangle, bool reversed) {
  const struct geom_point *point = sheet->point.item;
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int k = 0;
  while (p[k] == edge.i || p[k] == edge.j)
    k++;
  return (struct fan_triangle){point[reversed ? edge.j : edge.i],
                               point[reversed ? edge.i : edge.j], point[p[k]],
                               triangle};
}

/* The sense of the smaller angle from triangle a to triangle b about the edge,
 * as the sign of a volume; 0: they are coplanar.  Exact. */
static int turn_sign(const struct fan_triangle *a,
                     const struct fan_triangle *b) {
  struct geom_plane plane = geom_plane_of(a->from, a->to, a->third);
  return geom_sign128(geom_plane_value(&plane, b->third));
}

/* Is c between a and b in the positive sense about the edge?  Exact. */
static bool is_between(const struct fan_triangle *a,
                       const struct fan_triangle *b,
                       const struct fan_triangle *c) {
  if (turn_sign(a, b) > 0)
    return turn_sign(a, c) > 0 && turn_sign(c, b) > 0;
  return !(turn_sign(b, c) > 0 && turn_sign(c, a) > 0);
}

/* On which side of its edge a triangle of a fan lies, by the sign of its
 * projected area: on the page, or (`across`) on the coordinate plane of depth
 * and the edge's longer page coordinate. */
static int side_of_edge(const struct fan_triangle *w, bool across) {
  bool steep = is_steep(w->from, w->to);
  int64_t dx, dz, x, z;
  if (!across)
    return geom_sign64(geom_orient2d(w->from, w->to, w->third));
  dx = steep ? (int64_t)w->to.y - w->from.y : (int64_t)w->to.x - w->from.x;
  x = steep ? (int64_t)w->third.y - w->from.y : (int64_t)w->third.x - w->from.x;
  dz = w->to.z - w->from.z;
  z = w->third.z - w->from.z;
  return geom_sign128((int128)dx * z - (int128)dz * x);
}

/* Are two triangles of fans about coincident edges in contact, on the same side
 * of the edge? */
static bool are_in_contact(const struct sheet *sheet,
                           const struct fan_triangle *a,
                           const struct fan_triangle *b) {
  bool across = side_of_edge(a, false) == 0 || side_of_edge(b, false) == 0;
  struct occluder plane[2];
  struct side_count count[2];
  int sign = side_of_edge(a, across) * side_of_edge(b, across);
  if (sign < 0)
    return false;
  occluder_init(&plane[0], sheet, a->triangle);
  occluder_init(&plane[1], sheet, b->triangle);
  for (int k = 0; k < 2; k++)
    count[k] = side_count_of(&plane[k], plane[1 - k].p);
  return count[0].behind + count[0].in_front == 0 ||
         count[1].behind + count[1].in_front == 0;
}

/* The triangles about an edge. */
struct edge_fan {
  ARRAY(struct fan_triangle) list;
};

/* Collects the triangles incident to an edge; reversed: in its opposite
 * direction. */
static bool gather_fan(struct edge_fan *fan, const struct sheet *sheet,
                       const struct incidences *incidences,
                       struct edge_crossing_side edge, bool reversed) {
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
  struct fan_triangle *w = fan->list.item;
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
  const struct fan_triangle *u = a->list.item, *v = b->list.item;
  for (size_t i = 1; i < a->list.count; i++)
    for (size_t j = 1; j < b->list.count; j++)
      if (is_between(&u[0], &u[i], &v[j]) != is_between(&u[0], &u[i], &v[0]))
        return true;
  return false;
}

/* Do two overlapping edges have opposite directions? */
static bool are_opposite(const struct sheet *sheet, struct edge_crossing_side e,
                         struct edge_crossing_side f) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool steep = is_steep(a, b);
  return compare_along(steep, a, b) != compare_along(steep, c, d);
}

/* Decides whether the surfaces of two overlapping edges cross.  Returns false
 * when memory ran out. */
static bool do_cross(const struct sheet *sheet,
                     const struct incidences *incidences,
                     const struct edge_crossing *crossing,
                     struct edge_fan scratch[3], bool *cross) {
  bool opposite = are_opposite(sheet, crossing->side[0], crossing->side[1]);
  if (!gather_fan(&scratch[0], sheet, incidences, crossing->side[0], false) ||
      !gather_fan(&scratch[1], sheet, incidences, crossing->side[1],
                  opposite) ||
      !gather_fan(&scratch[2], sheet, incidences, crossing->side[0], false))
    return false;
  drop_touching(sheet, &scratch[0], &scratch[1]);
  drop_touching(sheet, &scratch[1], &scratch[2]);
  *cross = do_alternate(&scratch[0], &scratch[1]);
  return true;
}

/* Does the surface about an edge that lies on triangle g pass through it: has
 * it triangles that end on g from behind, and others from in front? */
static bool passes_through(const struct sheet *sheet,
                           const struct incidences *incidences,
                           struct edge_crossing_side edge, uint32_t g) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  bool behind = false, in_front = false;
  struct occluder plane;
  occluder_init(&plane, sheet, g);
  for (; incidence < end; incidence++) {
    struct side_count count =
        side_count_of(&plane, sheet_corners(sheet, incidence->triangle).p);
    behind |= count.in_front == 0 && count.behind == 1;
    in_front |= count.behind == 0 && count.in_front == 1;
  }
  return behind && in_front;
}

/* Decides whether the triangles that end on triangle g along an edge meet it
 * along that edge, and adds the segments in which they meet it elsewhere.
 * along  gets the decision
 * Returns false when memory ran out. */
static bool meet_along(const struct sheet *sheet,
                       const struct incidences *incidences,
                       struct edge_crossing_side edge, uint32_t g,
                       struct intersection_segments *segments, bool *along) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  struct geom_point p = sheet->point.item[edge.i],
                    q = sheet->point.item[edge.j];
  struct occluder hf, hg;
  occluder_init(&hg, sheet, g);
  *along = false;
  for (; incidence < end; incidence++) {
    struct intersection_segment segment;
    occluder_init(&hf, sheet, incidence->triangle);
    if (!ends_on_plane(side_count_of(&hg, hf.p)) ||
        !intersection_segment_find(sheet, incidence->triangle, g, &hf, &hg,
                                   &segment))
      continue;
    /* All of a triangle seen edge-on is near the line on the page, which
     * says nothing then. */
    if (!(sheet->triangle_flags[incidence->triangle] & SHEET_FLAT) &&
        is_near_line(p, q, segment.end[0]) &&
        is_near_line(p, q, segment.end[1]))
      *along = true;
    else if (!ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  return true;
}

/* ---- Decisions ----------------------------------------------------------- */

static int compare_crossings(const void *a, const void *b, void *user) {
  const struct edge_crossing *s = a, *t = b;
  int order = compare_sides(s->side[0], t->side[0]);
  (void)user;
  return order != 0 ? order : compare_sides(s->side[1], t->side[1]);
}

/* The first triangle of a candidate's side. */
static uint32_t first_triangle(const struct incidences *incidences,
                               struct edge_crossing_side side) {
  const struct incidence *end;
  return side.j == SHEET_NONE
             ? side.i
             : incidences_find(incidences, side, &end)->triangle;
}

/* Decides whether a candidate is a crossing.
 * segment  gets the segment of the crossing
 * cross    gets the decision
 * Returns false when memory ran out. */
static bool decide_crossing(const struct sheet *sheet,
                            const struct incidences *incidences,
                            const struct edge_crossing *crossing,
                            struct edge_fan scratch[3],
                            struct intersection_segments *segments,
                            struct intersection_segment *segment, bool *cross) {
  const struct edge_crossing_side *side = crossing->side;
  uint32_t first[2] = {first_triangle(incidences, side[0]),
                       first_triangle(incidences, side[1])};
  int g = side[0].j == SHEET_NONE ? 0 : 1; /* the side with the triangle, if
                                              there is one */
  *cross = false;
  if (side[g].j != SHEET_NONE) {
    if (!clip_to_edge(sheet, side[0], side[1], segment->end))
      return true;
    if (!do_cross(sheet, incidences, crossing, scratch, cross))
      return false;
  } else {
    if (passes_through(sheet, incidences, side[1 - g], side[g].i) &&
        !meet_along(sheet, incidences, side[1 - g], side[g].i, segments, cross))
      return false;
    *cross =
        *cross && clip_to_triangle(sheet, side[1 - g], side[g].i, segment->end);
  }
  *cross = *cross && (segment->end[0].x != segment->end[1].x ||
                      segment->end[0].y != segment->end[1].y);
  segment->triangle[0] = first[0] < first[1] ? first[0] : first[1];
  segment->triangle[1] = first[0] < first[1] ? first[1] : first[0];
  return true;
}

/* Adds the segments in which triangle g meets triangles of an edge that end
 * beside its plane within contact (edge_crossings_add_slanted).
 * Returns false when memory ran out. */
static bool add_slanted_segments(const struct sheet *sheet,
                                 const struct incidences *incidences,
                                 struct edge_crossing_side edge, uint32_t g,
                                 struct intersection_segments *segments) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  struct occluder hf, hg;
  occluder_init(&hg, sheet, g);
  for (; incidence < end; incidence++) {
    uint32_t f = incidence->triangle;
    struct intersection_segment segment;
    struct side_count sf, sg;
    if (sheet->triangle.item[f].face == sheet->triangle.item[g].face)
      continue;
    occluder_init(&hf, sheet, f);
    sf = side_count_of(&hg, hf.p);
    sg = side_count_of(&hf, hg.p);
    if (straddles(sf) || ends_on_plane(sf) || !straddles(sg) ||
        !intersection_segment_find(sheet, f, g, &hf, &hg, &segment))
      continue;
    if ((llabs((int64_t)segment.end[0].x - segment.end[1].x) >
             TOLERANCE_COINCIDENT_UNITS ||
         llabs((int64_t)segment.end[0].y - segment.end[1].y) >
             TOLERANCE_COINCIDENT_UNITS) &&
        !ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  return true;
}

bool edge_crossings_resolve(struct edge_crossings *crossings,
                            const struct sheet *sheet,
                            struct intersection_segments *segments,
                            uint64_t *count) {
  size_t n = crossings->list.count;
  struct edge_crossing *crossing = crossings->list.item;
  struct edge_fan scratch[3] = {0};
  struct incidences incidences = {0};
  bool ok = false;
  if (n == 0 && crossings->slanted.count == 0)
    return true;
  if (!sort_stable(crossing, n, sizeof *crossing, compare_crossings, NULL) ||
      !incidences_init(&incidences, sheet, crossings))
    goto end;
  for (size_t i = 0; i < crossings->slanted.count; i++)
    if (!add_slanted_segments(sheet, &incidences,
                              crossings->slanted.item[i].side[0],
                              crossings->slanted.item[i].side[1].i, segments))
      goto end;
  for (size_t i = 0; i < n; i++) {
    struct intersection_segment segment;
    bool cross;
    if (i > 0 && compare_crossings(&crossing[i - 1], &crossing[i], NULL) == 0)
      continue;
    if (!decide_crossing(sheet, &incidences, &crossing[i], scratch, segments,
                         &segment, &cross))
      goto end;
    if (!cross)
      continue;
    ++*count;
    if (!ARRAY_PUSH(&segments->list, segment))
      goto end;
  }
  ok = true;
end:
  for (int k = 0; k < 3; k++)
    ARRAY_FREE(&scratch[k].list);
  incidences_fini(&incidences);
  return ok;
}
