/* edge_crossing.c - where surfaces cross along an edge. */
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
    count.before += side > 0;
    if (side != 0)
      count.apart = k;
  }
  return count;
}

/* ---- Noting -------------------------------------------------------------- */

static struct edge_crossing_side
edge_of(const struct sheet *sheet, uint32_t triangle, struct side_count count) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  uint32_t i = p[(count.apart + 1) % 3], j = p[(count.apart + 2) % 3];
  return (struct edge_crossing_side){i < j ? i : j, i < j ? j : i};
}

static int compare_sides(struct edge_crossing_side a,
                         struct edge_crossing_side b) {
  if (a.j != b.j)
    return a.j < b.j ? -1 : 1;
  return (a.i > b.i) - (a.i < b.i);
}

bool edge_crossings_note(struct edge_crossings *crossings,
                         const struct sheet *sheet, uint32_t f,
                         struct side_count sf, uint32_t g,
                         struct side_count sg) {
  struct edge_crossing crossing = {{edge_of(sheet, f, sf), {g, SHEET_NONE}}};
  if (ends_there(sg))
    crossing.side[1] = edge_of(sheet, g, sg);
  if (compare_sides(crossing.side[0], crossing.side[1]) > 0) {
    struct edge_crossing_side swap = crossing.side[0];
    crossing.side[0] = crossing.side[1];
    crossing.side[1] = swap;
  }
  return ARRAY_PUSH(&crossings->list, crossing);
}

bool edge_crossings_note_slanted(struct edge_crossings *crossings,
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
    int next = k == 2 ? 0 : k + 1;
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

/* ---- Which part of an edge ----------------------------------------------- */

/* The part of an edge that triangle g covers on the page. */
static bool clip_to_triangle(const struct sheet *sheet,
                             struct edge_crossing_side edge, uint32_t g,
                             struct geom_point end[2]) {
  const uint32_t *t = sheet->triangle.item[g].point;
  const struct geom_point corner[3] = {sheet->point.item[t[0]],
                                       sheet->point.item[t[1]],
                                       sheet->point.item[t[2]]},
                          p = sheet->point.item[edge.i],
                          q = sheet->point.item[edge.j];
  struct occluded_interval part;
  if ((sheet->triangle_flags[g] & SHEET_FLAT) ||
      !occlude_by_outline(corner, p, q, &part))
    return false;
  for (int k = 0; k < 2; k++) {
    struct ratio t_k = k == 0 ? part.from : part.to;
    end[k] = (struct geom_point){(int32_t)ratio_lerp(t_k, p.x, q.x),
                                 (int32_t)ratio_lerp(t_k, p.y, q.y),
                                 ratio_lerp(t_k, p.z, q.z)};
  }
  return true;
}

/* Does p lie on the line through a and b on the page, but for rounding? */
static bool is_near_line(struct geom_point a, struct geom_point b,
                         struct geom_point p) {
  const int128 near = TOLERANCE_COINCIDENT_UNITS;
  int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y,
          off = geom_orient2d(a, b, p);
  return (int128)off * off <= near * near * ((int128)x * x + (int128)y * y);
}

static bool is_steep(struct geom_point a, struct geom_point b) {
  return llabs((int64_t)b.y - a.y) > llabs((int64_t)b.x - a.x);
}

/* An order along edges that are steep, or are not.  Their other coordinate may
 * run either way: rounding turns an upright edge by a unit. */
static int compare_along(bool steep, struct geom_point a, struct geom_point b) {
  if (steep && a.y != b.y)
    return a.y < b.y ? -1 : 1;
  return geom_compare_points(a, b);
}

static void put_in_order(bool steep, struct geom_point *a,
                         struct geom_point *b) {
  if (compare_along(steep, *a, *b) > 0) {
    struct geom_point swap = *a;
    *a = *b;
    *b = swap;
  }
}

/* What two edges share: the middle two of their ends, where these lie on both.
 * Edges of faces that are all but in one plane touch each other's planes
 * wherever they run. */
static bool clip_to_edge(const struct sheet *sheet, struct edge_crossing_side e,
                         struct edge_crossing_side f,
                         struct geom_point end[2]) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool steep = is_steep(a, b);
  put_in_order(steep, &a, &b);
  put_in_order(steep, &c, &d);
  end[0] = compare_along(steep, a, c) > 0 ? a : c;
  end[1] = compare_along(steep, b, d) < 0 ? b : d;
  for (int k = 0; k < 2; k++)
    if (!is_near_line(a, b, end[k]) || !is_near_line(c, d, end[k]))
      return false;
  return compare_along(steep, end[0], end[1]) < 0;
}

/* ---- The triangles of the edges ------------------------------------------ */

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

/* The rims of an edge, up to `end`. */
static const struct incidence *
incidences_find(const struct incidences *incidences,
                struct edge_crossing_side edge, const struct incidence **end) {
  const struct incidence *incidence = incidences->list.item;
  size_t low = 0, high = incidences->list.count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (compare_sides(incidence[middle].edge, edge) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  for (high = low; high < incidences->list.count &&
                   compare_sides(incidence[high].edge, edge) == 0;)
    high++;
  *end = incidence + high;
  return incidence + low;
}

/* Adds the sides of a triangle that run between marked points. */
static bool add_incidences(struct incidences *incidences,
                           const struct sheet *sheet, const uint8_t *marked,
                           uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    uint32_t i = p[k], j = p[k == 2 ? 0 : k + 1];
    struct incidence incidence = {{i < j ? i : j, i < j ? j : i}, triangle};
    if (marked[i] && marked[j] && !ARRAY_PUSH(&incidences->list, incidence))
      return false;
  }
  return true;
}

/* Finds all triangles of the edges that the seams name. */
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

/* ---- Round an edge ------------------------------------------------------- */

/* A triangle as seen along an edge: from the edge, the way of the other
 * triangles' edges, to its third corner. */
struct fan_triangle {
  struct geom_point from, to, apart;
  uint32_t triangle;
};

static struct fan_triangle fan_triangle_of(const struct sheet *sheet,
                                           struct edge_crossing_side edge,
                                           uint32_t triangle, bool turned) {
  const struct geom_point *point = sheet->point.item;
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int k = 0;
  while (p[k] == edge.i || p[k] == edge.j)
    k++;
  return (struct fan_triangle){point[turned ? edge.j : edge.i],
                               point[turned ? edge.i : edge.j], point[p[k]],
                               triangle};
}

/* Which way from wing a to wing b is the shorter: +1 or -1 as the sign of a
 * volume says; 0: they lie in one plane.  Exact. */
static int way_round(const struct fan_triangle *a,
                     const struct fan_triangle *b) {
  struct geom_plane plane = geom_plane_of(a->from, a->to, a->apart);
  return geom_sign128(geom_plane_value(&plane, b->apart));
}

/* Going round from wing a to wing b the positive way, does one meet c? */
static bool is_between(const struct fan_triangle *a,
                       const struct fan_triangle *b,
                       const struct fan_triangle *c) {
  if (way_round(a, b) > 0)
    return way_round(a, c) > 0 && way_round(c, b) > 0;
  return !(way_round(b, c) > 0 && way_round(c, a) > 0);
}

/* On which side of its edge a wing lies, seen along an axis of the sheet: the
 * page's own where it has an area there, else one across it. */
static int side_of_edge(const struct fan_triangle *w, bool across) {
  bool steep = is_steep(w->from, w->to);
  int64_t dx, dz, x, z;
  if (!across)
    return geom_sign64(geom_orient2d(w->from, w->to, w->apart));
  dx = steep ? (int64_t)w->to.y - w->from.y : (int64_t)w->to.x - w->from.x;
  x = steep ? (int64_t)w->apart.y - w->from.y : (int64_t)w->apart.x - w->from.x;
  dz = w->to.z - w->from.z;
  z = w->apart.z - w->from.z;
  return geom_sign128((int128)dx * z - (int128)dz * x);
}

/* Do two wings touch on the same side of their edge? */
static bool are_one(const struct sheet *sheet, const struct fan_triangle *a,
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
  return count[0].behind + count[0].before == 0 ||
         count[1].behind + count[1].before == 0;
}

struct fan {
  ARRAY(struct fan_triangle) list;
};

/* All wings of an edge; turned: seen from its other end. */
static bool gather_fan(struct fan *fan, const struct sheet *sheet,
                       const struct incidences *incidences,
                       struct edge_crossing_side edge, bool turned) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  fan->list.count = 0;
  for (; incidence < end; incidence++)
    if (!ARRAY_PUSH(&fan->list,
                    fan_triangle_of(sheet, edge, incidence->triangle, turned)))
      return false;
  return true;
}

/* Drops the wings that touch one of the others. */
static void drop_touching(const struct sheet *sheet, struct fan *fan,
                          const struct fan *others) {
  struct fan_triangle *w = fan->list.item;
  size_t kept = 0;
  for (size_t i = 0; i < fan->list.count; i++) {
    bool touches = false;
    for (size_t j = 0; j < others->list.count && !touches; j++)
      touches = are_one(sheet, &w[i], &others->list.item[j]);
    if (!touches)
      w[kept++] = w[i];
  }
  fan->list.count = kept;
}

/* Do the wings of b stand in more than one of the gaps between those of a?
 * Then some two of a part them, and of these one may be the first. */
static bool do_alternate(const struct fan *a, const struct fan *b) {
  const struct fan_triangle *u = a->list.item, *v = b->list.item;
  for (size_t i = 1; i < a->list.count; i++)
    for (size_t j = 1; j < b->list.count; j++)
      if (is_between(&u[0], &u[i], &v[j]) != is_between(&u[0], &u[i], &v[0]))
        return true;
  return false;
}

/* Does one edge run against the other? */
static bool run_against(const struct sheet *sheet, struct edge_crossing_side e,
                        struct edge_crossing_side f) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool steep = is_steep(a, b);
  return compare_along(steep, a, b) != compare_along(steep, c, d);
}

/* Do the surfaces of two edges cross? */
static bool do_cross(const struct sheet *sheet,
                     const struct incidences *incidences,
                     const struct edge_crossing *crossing,
                     struct fan scratch[3], bool *cross) {
  bool against = run_against(sheet, crossing->side[0], crossing->side[1]);
  if (!gather_fan(&scratch[0], sheet, incidences, crossing->side[0], false) ||
      !gather_fan(&scratch[1], sheet, incidences, crossing->side[1], against) ||
      !gather_fan(&scratch[2], sheet, incidences, crossing->side[0], false))
    return false;
  drop_touching(sheet, &scratch[0], &scratch[1]);
  drop_touching(sheet, &scratch[1], &scratch[2]);
  *cross = do_alternate(&scratch[0], &scratch[1]);
  return true;
}

/* Does the surface of an edge that lies on triangle g go through it? */
static bool goes_through(const struct sheet *sheet,
                         const struct incidences *incidences,
                         struct edge_crossing_side edge, uint32_t g) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  bool behind = false, before = false;
  struct occluder plane;
  occluder_init(&plane, sheet, g);
  for (; incidence < end; incidence++) {
    const uint32_t *t = sheet->triangle.item[incidence->triangle].point;
    const struct geom_point p[3] = {sheet->point.item[t[0]],
                                    sheet->point.item[t[1]],
                                    sheet->point.item[t[2]]};
    struct side_count count = side_count_of(&plane, p);
    behind |= count.before == 0 && count.behind == 1;
    before |= count.behind == 0 && count.before == 1;
  }
  return behind && before;
}

/* Do the triangles that end along an edge meet triangle g along it?  Adds the
 * segments in which they meet it elsewhere.
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
    if (!ends_there(side_count_of(&hg, hf.p)) ||
        !intersection_segment_find(sheet, incidence->triangle, g, &hf, &hg,
                                   &segment))
      continue;
    /* Of a triangle seen edge-on all is near the line on the page. */
    if (!(sheet->triangle_flags[incidence->triangle] & SHEET_FLAT) &&
        is_near_line(p, q, segment.end[0]) &&
        is_near_line(p, q, segment.end[1]))
      *along = true;
    else if (!ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  return true;
}

/* ---- Joining ------------------------------------------------------------- */

static int compare_crossings(const void *a, const void *b, void *user) {
  const struct edge_crossing *s = a, *t = b;
  int order = compare_sides(s->side[0], t->side[0]);
  (void)user;
  return order != 0 ? order : compare_sides(s->side[1], t->side[1]);
}

/* The first triangle of a side. */
static uint32_t first_triangle(const struct incidences *incidences,
                               struct edge_crossing_side side) {
  const struct incidence *end;
  return side.j == SHEET_NONE
             ? side.i
             : incidences_find(incidences, side, &end)->triangle;
}

/* Does a seam make a crossing, and where? */
static bool join(const struct sheet *sheet, const struct incidences *incidences,
                 const struct edge_crossing *crossing, struct fan scratch[3],
                 struct intersection_segments *segments,
                 struct intersection_segment *segment, bool *cross) {
  const struct edge_crossing_side *side = crossing->side;
  uint32_t first[2] = {first_triangle(incidences, side[0]),
                       first_triangle(incidences, side[1])};
  int g = side[0].j == SHEET_NONE ? 0 : 1; /* the triangle, if one is */
  *cross = false;
  if (side[g].j != SHEET_NONE) {
    if (!clip_to_edge(sheet, side[0], side[1], segment->end))
      return true;
    if (!do_cross(sheet, incidences, crossing, scratch, cross))
      return false;
  } else {
    if (goes_through(sheet, incidences, side[1 - g], side[g].i) &&
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
 * beside its plane within contact (edge_crossings_note_slanted).
 * Returns false when memory ran out. */
static bool join_slanted(const struct sheet *sheet,
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
    if ((sf.behind > 0 && sf.before > 0) || ends_there(sf) ||
        !(sg.behind > 0 && sg.before > 0) ||
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

bool edge_crossings_join(struct edge_crossings *crossings,
                         const struct sheet *sheet,
                         struct intersection_segments *segments,
                         uint64_t *count) {
  size_t n = crossings->list.count;
  struct edge_crossing *crossing = crossings->list.item;
  struct fan scratch[3] = {0};
  struct incidences incidences = {0};
  bool ok = false;
  if (n == 0 && crossings->slanted.count == 0)
    return true;
  if (!sort_stable(crossing, n, sizeof *crossing, compare_crossings, NULL) ||
      !incidences_init(&incidences, sheet, crossings))
    goto end;
  for (size_t i = 0; i < crossings->slanted.count; i++)
    if (!join_slanted(sheet, &incidences, crossings->slanted.item[i].side[0],
                      crossings->slanted.item[i].side[1].i, segments))
      goto end;
  for (size_t i = 0; i < n; i++) {
    struct intersection_segment segment;
    bool cross;
    if (i > 0 && compare_crossings(&crossing[i - 1], &crossing[i], NULL) == 0)
      continue;
    if (!join(sheet, &incidences, &crossing[i], scratch, segments, &segment,
              &cross))
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
