/* seams.c - where surfaces cross along an edge. */
#include "visibility/seams.h"

#include <stdlib.h>

#include "base/sort.h"
#include "base/tolerance.h"

struct stance stance_of(const struct hider *plane,
                        const struct geom_point p[3]) {
  struct stance stance = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    int side = hider_side(plane, p[k]);
    stance.behind += side < 0;
    stance.before += side > 0;
    if (side != 0)
      stance.apart = k;
  }
  return stance;
}

/* ---- Noting -------------------------------------------------------------- */

static struct seam_side edge_of(const struct sheet *sheet, uint32_t triangle,
                                struct stance stance) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  uint32_t i = p[(stance.apart + 1) % 3], j = p[(stance.apart + 2) % 3];
  return (struct seam_side){i < j ? i : j, i < j ? j : i};
}

static int compare_sides(struct seam_side a, struct seam_side b) {
  if (a.j != b.j)
    return a.j < b.j ? -1 : 1;
  return (a.i > b.i) - (a.i < b.i);
}

bool seams_note(struct seams *seams, const struct sheet *sheet, uint32_t f,
                struct stance sf, uint32_t g, struct stance sg) {
  struct seam seam = {{edge_of(sheet, f, sf), {g, SHEET_NONE}}};
  if (ends_there(sg))
    seam.side[1] = edge_of(sheet, g, sg);
  if (compare_sides(seam.side[0], seam.side[1]) > 0) {
    struct seam_side swap = seam.side[0];
    seam.side[0] = seam.side[1];
    seam.side[1] = swap;
  }
  return ARRAY_PUSH(&seams->list, seam);
}

/* ---- Which part of an edge ----------------------------------------------- */

/* The part of an edge that triangle g covers on the page. */
static bool clip_to_triangle(const struct sheet *sheet, struct seam_side edge,
                             uint32_t g, struct geom_point end[2]) {
  const uint32_t *t = sheet->triangle.item[g].point;
  const struct geom_point corner[3] = {sheet->point.item[t[0]],
                                       sheet->point.item[t[1]],
                                       sheet->point.item[t[2]]},
                          p = sheet->point.item[edge.i],
                          q = sheet->point.item[edge.j];
  struct hidden_part part;
  if ((sheet->triangle_flags[g] & SHEET_FLAT) ||
      !hide_by_outline(corner, p, q, &part))
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
static bool clip_to_edge(const struct sheet *sheet, struct seam_side e,
                         struct seam_side f, struct geom_point end[2]) {
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

struct rim {
  struct seam_side edge;
  uint32_t triangle;
};

struct rims {
  ARRAY(struct rim) list; /* by edge, then triangle */
};

static int compare_rims(const void *a, const void *b, void *user) {
  const struct rim *r = a, *s = b;
  int order = compare_sides(r->edge, s->edge);
  (void)user;
  return order != 0 ? order
                    : (r->triangle > s->triangle) - (r->triangle < s->triangle);
}

/* The rims of an edge, up to `end`. */
static const struct rim *rims_find(const struct rims *rims,
                                   struct seam_side edge,
                                   const struct rim **end) {
  const struct rim *rim = rims->list.item;
  size_t low = 0, high = rims->list.count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (compare_sides(rim[middle].edge, edge) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  for (high = low;
       high < rims->list.count && compare_sides(rim[high].edge, edge) == 0;)
    high++;
  *end = rim + high;
  return rim + low;
}

/* Adds the sides of a triangle that run between marked points. */
static bool add_rims(struct rims *rims, const struct sheet *sheet,
                     const uint8_t *marked, uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    uint32_t i = p[k], j = p[k == 2 ? 0 : k + 1];
    struct rim rim = {{i < j ? i : j, i < j ? j : i}, triangle};
    if (marked[i] && marked[j] && !ARRAY_PUSH(&rims->list, rim))
      return false;
  }
  return true;
}

/* Finds all triangles of the edges that the seams name. */
static bool rims_init(struct rims *rims, const struct sheet *sheet,
                      const struct seam *seam, size_t n) {
  uint8_t *marked = mem_calloc(sheet->point.count, sizeof *marked);
  bool ok = false;
  if (marked == NULL)
    return false;
  for (size_t s = 0; s < 2 * n; s++) {
    struct seam_side side = seam[s / 2].side[s % 2];
    if (side.j != SHEET_NONE)
      marked[side.i] = marked[side.j] = 1;
  }
  for (uint32_t t = 0; t < sheet->triangle.count; t++)
    if (!add_rims(rims, sheet, marked, t))
      goto end;
  ok = sort_stable(rims->list.item, rims->list.count, sizeof *rims->list.item,
                   compare_rims, NULL);
end:
  mem_free(marked);
  return ok;
}

static void rims_fini(struct rims *rims) { ARRAY_FREE(&rims->list); }

/* ---- Round an edge ------------------------------------------------------- */

/* A triangle as seen along an edge: from the edge, the way of the other
 * triangles' edges, to its third corner. */
struct wing {
  struct geom_point from, to, apart;
  uint32_t triangle;
};

static struct wing wing_of(const struct sheet *sheet, struct seam_side edge,
                           uint32_t triangle, bool turned) {
  const struct geom_point *point = sheet->point.item;
  const uint32_t *p = sheet->triangle.item[triangle].point;
  int k = 0;
  while (p[k] == edge.i || p[k] == edge.j)
    k++;
  return (struct wing){point[turned ? edge.j : edge.i],
                       point[turned ? edge.i : edge.j], point[p[k]], triangle};
}

/* Which way from wing a to wing b is the shorter: +1 or -1 as the sign of a
 * volume says; 0: they lie in one plane.  Exact. */
static int way_round(const struct wing *a, const struct wing *b) {
  struct geom_plane plane = geom_plane_of(a->from, a->to, a->apart);
  return geom_sign128(geom_plane_value(&plane, b->apart));
}

/* Going round from wing a to wing b the positive way, does one meet c? */
static bool is_between(const struct wing *a, const struct wing *b,
                       const struct wing *c) {
  if (way_round(a, b) > 0)
    return way_round(a, c) > 0 && way_round(c, b) > 0;
  return !(way_round(b, c) > 0 && way_round(c, a) > 0);
}

/* On which side of its edge a wing lies, seen along an axis of the sheet: the
 * page's own where it has an area there, else one across it. */
static int side_of_edge(const struct wing *w, bool across) {
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
static bool are_one(const struct sheet *sheet, const struct wing *a,
                    const struct wing *b) {
  bool across = side_of_edge(a, false) == 0 || side_of_edge(b, false) == 0;
  struct hider plane[2];
  struct stance stance[2];
  int sign = side_of_edge(a, across) * side_of_edge(b, across);
  if (sign < 0)
    return false;
  hider_init(&plane[0], sheet, a->triangle);
  hider_init(&plane[1], sheet, b->triangle);
  for (int k = 0; k < 2; k++)
    stance[k] = stance_of(&plane[k], plane[1 - k].p);
  return stance[0].behind + stance[0].before == 0 ||
         stance[1].behind + stance[1].before == 0;
}

struct wings {
  ARRAY(struct wing) list;
};

/* All wings of an edge; turned: seen from its other end. */
static bool gather_wings(struct wings *wings, const struct sheet *sheet,
                         const struct rims *rims, struct seam_side edge,
                         bool turned) {
  const struct rim *end, *rim = rims_find(rims, edge, &end);
  wings->list.count = 0;
  for (; rim < end; rim++)
    if (!ARRAY_PUSH(&wings->list, wing_of(sheet, edge, rim->triangle, turned)))
      return false;
  return true;
}

/* Drops the wings that touch one of the others. */
static void drop_touching(const struct sheet *sheet, struct wings *wings,
                          const struct wings *others) {
  struct wing *w = wings->list.item;
  size_t kept = 0;
  for (size_t i = 0; i < wings->list.count; i++) {
    bool touches = false;
    for (size_t j = 0; j < others->list.count && !touches; j++)
      touches = are_one(sheet, &w[i], &others->list.item[j]);
    if (!touches)
      w[kept++] = w[i];
  }
  wings->list.count = kept;
}

/* Do the wings of b stand in more than one of the gaps between those of a?
 * Then some two of a part them, and of these one may be the first. */
static bool do_alternate(const struct wings *a, const struct wings *b) {
  const struct wing *u = a->list.item, *v = b->list.item;
  for (size_t i = 1; i < a->list.count; i++)
    for (size_t j = 1; j < b->list.count; j++)
      if (is_between(&u[0], &u[i], &v[j]) != is_between(&u[0], &u[i], &v[0]))
        return true;
  return false;
}

/* Does one edge run against the other? */
static bool run_against(const struct sheet *sheet, struct seam_side e,
                        struct seam_side f) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool steep = is_steep(a, b);
  return compare_along(steep, a, b) != compare_along(steep, c, d);
}

/* Do the surfaces of two edges cross? */
static bool do_cross(const struct sheet *sheet, const struct rims *rims,
                     const struct seam *seam, struct wings scratch[3],
                     bool *cross) {
  bool against = run_against(sheet, seam->side[0], seam->side[1]);
  if (!gather_wings(&scratch[0], sheet, rims, seam->side[0], false) ||
      !gather_wings(&scratch[1], sheet, rims, seam->side[1], against) ||
      !gather_wings(&scratch[2], sheet, rims, seam->side[0], false))
    return false;
  drop_touching(sheet, &scratch[0], &scratch[1]);
  drop_touching(sheet, &scratch[1], &scratch[2]);
  *cross = do_alternate(&scratch[0], &scratch[1]);
  return true;
}

/* Does the surface of an edge that lies on triangle g go through it? */
static bool goes_through(const struct sheet *sheet, const struct rims *rims,
                         struct seam_side edge, uint32_t g) {
  const struct rim *end, *rim = rims_find(rims, edge, &end);
  bool behind = false, before = false;
  struct hider plane;
  hider_init(&plane, sheet, g);
  for (; rim < end; rim++) {
    const uint32_t *t = sheet->triangle.item[rim->triangle].point;
    const struct geom_point p[3] = {sheet->point.item[t[0]],
                                    sheet->point.item[t[1]],
                                    sheet->point.item[t[2]]};
    struct stance stance = stance_of(&plane, p);
    behind |= stance.before == 0 && stance.behind == 1;
    before |= stance.behind == 0 && stance.before == 1;
  }
  return behind && before;
}

/* Do the triangles that end along an edge meet triangle g along it?  Adds the
 * segments in which they meet it elsewhere.
 * Returns false when memory ran out. */
static bool meet_along(const struct sheet *sheet, const struct rims *rims,
                       struct seam_side edge, uint32_t g,
                       struct pierce_segments *segments, bool *along) {
  const struct rim *end, *rim = rims_find(rims, edge, &end);
  struct geom_point p = sheet->point.item[edge.i],
                    q = sheet->point.item[edge.j];
  struct hider hf, hg;
  hider_init(&hg, sheet, g);
  *along = false;
  for (; rim < end; rim++) {
    struct pierce_segment segment;
    hider_init(&hf, sheet, rim->triangle);
    if (!ends_there(stance_of(&hg, hf.p)) ||
        !pierce_segment_find(sheet, rim->triangle, g, &hf, &hg, &segment))
      continue;
    /* Of a triangle seen edge-on all is near the line on the page. */
    if (!(sheet->triangle_flags[rim->triangle] & SHEET_FLAT) &&
        is_near_line(p, q, segment.end[0]) &&
        is_near_line(p, q, segment.end[1]))
      *along = true;
    else if (!ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  return true;
}

/* ---- Joining ------------------------------------------------------------- */

static int compare_seams(const void *a, const void *b, void *user) {
  const struct seam *s = a, *t = b;
  int order = compare_sides(s->side[0], t->side[0]);
  (void)user;
  return order != 0 ? order : compare_sides(s->side[1], t->side[1]);
}

/* The first triangle of a side. */
static uint32_t first_triangle(const struct rims *rims, struct seam_side side) {
  const struct rim *end;
  return side.j == SHEET_NONE ? side.i : rims_find(rims, side, &end)->triangle;
}

/* Does a seam make a crossing, and where? */
static bool join(const struct sheet *sheet, const struct rims *rims,
                 const struct seam *seam, struct wings scratch[3],
                 struct pierce_segments *segments,
                 struct pierce_segment *segment, bool *cross) {
  const struct seam_side *side = seam->side;
  uint32_t first[2] = {first_triangle(rims, side[0]),
                       first_triangle(rims, side[1])};
  int g = side[0].j == SHEET_NONE ? 0 : 1; /* the triangle, if one is */
  *cross = false;
  if (side[g].j != SHEET_NONE) {
    if (!clip_to_edge(sheet, side[0], side[1], segment->end))
      return true;
    if (!do_cross(sheet, rims, seam, scratch, cross))
      return false;
  } else {
    if (goes_through(sheet, rims, side[1 - g], side[g].i) &&
        !meet_along(sheet, rims, side[1 - g], side[g].i, segments, cross))
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

bool seams_join(struct seams *seams, const struct sheet *sheet,
                struct pierce_segments *segments, uint64_t *count) {
  size_t n = seams->list.count;
  struct seam *seam = seams->list.item;
  struct wings scratch[3] = {0};
  struct rims rims = {0};
  bool ok = false;
  if (n == 0)
    return true;
  if (!sort_stable(seam, n, sizeof *seam, compare_seams, NULL) ||
      !rims_init(&rims, sheet, seam, n))
    goto end;
  for (size_t i = 0; i < n; i++) {
    struct pierce_segment segment;
    bool cross;
    if (i > 0 && compare_seams(&seam[i - 1], &seam[i], NULL) == 0)
      continue;
    if (!join(sheet, &rims, &seam[i], scratch, segments, &segment, &cross))
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
  rims_fini(&rims);
  return ok;
}
