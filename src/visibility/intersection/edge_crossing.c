/* edge_crossing.c - finds where surfaces pass through each other along an
 * edge. */
#include "visibility/intersection/edge_crossing.h"

#include <stdlib.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "base/tolerance.h"

/* ---- Candidates ---------------------------------------------------------- */

bool edge_crossings_add(struct edge_crossings *crossings,
                        const struct sheet *sheet, uint32_t f,
                        struct corner_counts cf, uint32_t g,
                        struct corner_counts cg) {
  struct edge_crossing crossing = {
      {surface_edge_of(sheet, f, geom_next_corner(cf.off_plane)),
       {g, SHEET_NONE, SHEET_NONE}}};
  if (ends_on_plane(cg))
    crossing.side[1] =
        surface_edge_of(sheet, g, geom_next_corner(cg.off_plane));
  if (surface_edge_compare(crossing.side[0], crossing.side[1]) > 0) {
    struct surface_edge swap = crossing.side[0];
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
        {surface_edge_of(sheet, f, k), {g, SHEET_NONE, SHEET_NONE}}};
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

bool edge_crossings_unite(struct edge_crossings *crossings,
                          const struct edge_crossings *other) {
  if (!ARRAY_RESERVE(&crossings->list, other->list.count) ||
      !ARRAY_RESERVE(&crossings->slanted, other->slanted.count))
    return false;
  for (size_t i = 0; i < other->list.count; i++)
    crossings->list.item[crossings->list.count++] = other->list.item[i];
  for (size_t i = 0; i < other->slanted.count; i++)
    crossings->slanted.item[crossings->slanted.count++] =
        other->slanted.item[i];
  return true;
}

/* ---- Clipping ------------------------------------------------------------ */

/* Clips an edge to triangle g, which has an area, on the page.
 * end  gets the ends of the clipped edge, rounded to the grid
 * Returns false where nothing is left. */
static bool clip_to_triangle(const struct sheet *sheet,
                             struct surface_edge edge, uint32_t g,
                             struct geom_point end[2]) {
  const struct geom_triangle corner = sheet_corners(sheet, g);
  const struct geom_point p = sheet->point.item[edge.i],
                          q = sheet->point.item[edge.j];
  struct occluded_interval part;
  if (!occlude_by_projection(corner.p, p, q, &part))
    return false;
  for (int k = 0; k < 2; k++) {
    struct ratio t_k = k == 0 ? part.from : part.to;
    end[k] = (struct geom_point){(int32_t)ratio_lerp(t_k, p.x, q.x),
                                 (int32_t)ratio_lerp(t_k, p.y, q.y),
                                 ratio_lerp(t_k, p.z, q.z)};
  }
  return true;
}

/* Does p lie on the line through a and b on the page, within `near` units? */
static bool is_within(int128 near, struct geom_point a, struct geom_point b,
                      struct geom_point p) {
  int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y,
          off = geom_orient2d(a, b, p);
  return (int128)off * off <= near * near * ((int128)x * x + (int128)y * y);
}

static bool is_near_line(struct geom_point a, struct geom_point b,
                         struct geom_point p) {
  return is_within(TOLERANCE_COINCIDENT_UNITS, a, b, p);
}

/* Is a triangle seen edge-on, within the contact tolerance of the grid? */
static bool is_edge_on(const struct sheet *sheet, uint32_t triangle) {
  struct geom_triangle t = sheet_corners(sheet, triangle);
  for (int k = 0; k < 3; k++)
    if (is_within(TOLERANCE_CONTACT_GRID_UNITS, t.p[k],
                  t.p[geom_next_corner(k)], t.p[(k + 2) % 3]))
      return true;
  return false;
}

static void sort_two(bool upright, struct geom_point *a, struct geom_point *b) {
  if (edge_compare_along(upright, *a, *b) > 0) {
    struct geom_point swap = *a;
    *a = *b;
    *b = swap;
  }
}

/* The overlap of two edges: the middle two of their four ends, provided that
 * these lie on both lines.  That must be tested, since edges of nearly coplanar
 * faces touch each other's planes wherever they run.
 * Returns false where they do not overlap. */
static bool clip_to_edge(const struct sheet *sheet, struct surface_edge e,
                         struct surface_edge f, struct geom_point end[2]) {
  struct geom_point a = sheet->point.item[e.i], b = sheet->point.item[e.j],
                    c = sheet->point.item[f.i], d = sheet->point.item[f.j];
  bool upright = edge_is_upright(a, b);
  sort_two(upright, &a, &b);
  sort_two(upright, &c, &d);
  end[0] = edge_compare_along(upright, a, c) > 0 ? a : c;
  end[1] = edge_compare_along(upright, b, d) < 0 ? b : d;
  for (int k = 0; k < 2; k++)
    if (!is_near_line(a, b, end[k]) || !is_near_line(c, d, end[k]))
      return false;
  return edge_compare_along(upright, end[0], end[1]) < 0;
}

/* Is a segment so short on the page that rounding decides its direction? */
static bool is_point(const struct intersection_segment *segment) {
  const struct geom_point *end = segment->end;
  return llabs((int64_t)end[0].x - end[1].x) <= TOLERANCE_COINCIDENT_UNITS &&
         llabs((int64_t)end[0].y - end[1].y) <= TOLERANCE_COINCIDENT_UNITS;
}

/* Does the surface about an edge that lies on triangle g pass through it: has
 * it triangles that end on g from behind, and others from in front? */
static bool passes_through(const struct sheet *sheet,
                           const struct incidences *incidences,
                           struct surface_edge edge, uint32_t g) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  bool behind = false, in_front = false;
  struct occluder hf, hg;
  occluder_init(&hg, sheet, g);
  for (; incidence < end; incidence++) {
    if (sheet_is_one_face(sheet, incidence->triangle, g))
      continue;
    occluder_init(&hf, sheet, incidence->triangle);
    if (triangles_coplanar_within_rounding(sheet, incidence->triangle, g, &hf,
                                           &hg))
      continue;
    struct corner_counts count = corner_counts_of(&hg, hf.p);
    behind |= count.in_front == 0 && count.behind == 1;
    in_front |= count.behind == 0 && count.in_front == 1;
  }
  return behind && in_front;
}

/* Decides whether the triangles that end on triangle g along an edge meet it
 * along that edge; else adds the segments in which they meet it.
 * along  gets the decision
 * end    gets the ends of such a segment along the edge
 * Returns false when memory ran out. */
static bool meet_along(const struct sheet *sheet,
                       const struct incidences *incidences,
                       struct surface_edge edge, uint32_t g,
                       struct intersection_segments *segments, bool *along,
                       struct geom_point end[2]) {
  const struct incidence *past,
      *incidence = incidences_find(incidences, edge, &past);
  struct geom_point p = sheet->point.item[edge.i],
                    q = sheet->point.item[edge.j];
  size_t first = segments->list.count;
  struct occluder hf, hg;
  bool found = false, beside = false;
  occluder_init(&hg, sheet, g);
  for (; incidence < past; incidence++) {
    struct intersection_segment segment;
    if (sheet_is_one_face(sheet, incidence->triangle, g))
      continue;
    occluder_init(&hf, sheet, incidence->triangle);
    if (!ends_on_plane(corner_counts_of(&hg, hf.p)) ||
        !intersection_segment_find(sheet, incidence->triangle, g, &hf, &hg,
                                   &segment))
      continue;
    /* All of a triangle seen edge-on is near the line on the page, which
     * says nothing then. */
    bool near = is_near_line(p, q, segment.end[0]) &&
                is_near_line(p, q, segment.end[1]);
    beside |= !near;
    found |= near && !sheet_is_edge_on(sheet, incidence->triangle);
    end[0] = segment.end[0];
    end[1] = segment.end[1];
    if (!ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  *along = found && !beside;
  if (*along)
    segments->list.count = first;
  return true;
}

/* Decides whether two faces that have a diagonal in one place meet along it.
 * Within contact their diagonals may be in one place on the page alone: then
 * the faces meet in the segments of their triangles, which are added.
 * along  gets the decision
 * Returns false when memory ran out. */
static bool diagonals_meet_along(const struct sheet *sheet,
                                 const struct incidences *incidences,
                                 const struct surface_edge side[2],
                                 struct intersection_segments *segments,
                                 bool *along) {
  const struct incidence *past[2],
      *f = incidences_find(incidences, side[0], &past[0]),
      *first = incidences_find(incidences, side[1], &past[1]);
  struct geom_point p = sheet->point.item[side[0].i],
                    q = sheet->point.item[side[0].j];
  size_t before = segments->list.count;
  bool beside = false;
  for (; f < past[0]; f++)
    for (const struct incidence *g = first; g < past[1]; g++) {
      struct intersection_segment segment;
      struct occluder hf, hg;
      occluder_init(&hf, sheet, f->triangle);
      occluder_init(&hg, sheet, g->triangle);
      if (sheet_is_one_face(sheet, f->triangle, g->triangle) ||
          !intersection_segment_find(sheet, f->triangle, g->triangle, &hf, &hg,
                                     &segment) ||
          is_point(&segment))
        continue;
      beside |= !is_near_line(p, q, segment.end[0]) ||
                !is_near_line(p, q, segment.end[1]);
      if ((ends_on_plane(corner_counts_of(&hg, hf.p)) ||
           ends_on_plane(corner_counts_of(&hf, hg.p))) &&
          !ARRAY_PUSH(&segments->list, segment)) /* others are there */
        return false;
    }
  *along = !beside;
  if (*along)
    segments->list.count = before;
  return true;
}

/* ---- Decisions ----------------------------------------------------------- */

static int compare_crossings(const void *a, const void *b, void *user) {
  const struct edge_crossing *s = a, *t = b;
  int order = surface_edge_compare(s->side[0], t->side[0]);
  (void)user;
  return order != 0 ? order : surface_edge_compare(s->side[1], t->side[1]);
}

/* The first triangle of a candidate's side. */
static uint32_t first_triangle(const struct incidences *incidences,
                               struct surface_edge side) {
  const struct incidence *end;
  return side.j == SHEET_NONE
             ? side.i
             : incidences_find(incidences, side, &end)->triangle;
}

/* Finds the triangles incident to the candidates' edges, and maybe others.
 * Returns false when memory ran out. */
static bool find_incidences(struct incidences *incidences,
                            const struct sheet *sheet,
                            const struct edge_crossings *crossings) {
  uint8_t *marked = mem_calloc(sheet->point.count, sizeof *marked);
  if (marked == NULL)
    return false;
  for (size_t s = 0; s < 2 * crossings->list.count; s++) {
    struct surface_edge side = crossings->list.item[s / 2].side[s % 2];
    if (side.j != SHEET_NONE)
      marked[side.i] = marked[side.j] = 1;
  }
  for (size_t s = 0; s < crossings->slanted.count; s++) {
    struct surface_edge side = crossings->slanted.item[s].side[0];
    marked[side.i] = marked[side.j] = 1;
  }
  bool ok = incidences_init(incidences, sheet, marked);
  mem_free(marked);
  return ok;
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
  const struct surface_edge *side = crossing->side;
  uint32_t first[2] = {first_triangle(incidences, side[0]),
                       first_triangle(incidences, side[1])};
  int g = side[0].j == SHEET_NONE ? 0 : 1; /* the side with the triangle, if
                                              there is one */
  *cross = false;
  if (side[g].j != SHEET_NONE) {
    if (!clip_to_edge(sheet, side[0], side[1], segment->end))
      return true;
    if (!edge_fans_cross(sheet, incidences, side, scratch, cross))
      return false;
    if (*cross && side[0].face != SHEET_NONE && side[1].face != SHEET_NONE &&
        !diagonals_meet_along(sheet, incidences, side, segments, cross))
      return false;
  } else {
    if (passes_through(sheet, incidences, side[1 - g], side[g].i) &&
        !meet_along(sheet, incidences, side[1 - g], side[g].i, segments, cross,
                    segment->end))
      return false;
    /* The edge itself is exact, but only space shows which part of it is in a
     * triangle that is seen edge-on. */
    if (!is_edge_on(sheet, side[g].i))
      *cross = *cross &&
               clip_to_triangle(sheet, side[1 - g], side[g].i, segment->end);
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
                                 struct surface_edge edge, uint32_t g,
                                 struct intersection_segments *segments) {
  const struct incidence *end,
      *incidence = incidences_find(incidences, edge, &end);
  struct occluder hf, hg;
  occluder_init(&hg, sheet, g);
  for (; incidence < end; incidence++) {
    uint32_t f = incidence->triangle;
    struct intersection_segment segment;
    struct corner_counts cf, cg;
    if (sheet_is_one_face(sheet, f, g))
      continue;
    occluder_init(&hf, sheet, f);
    cf = corner_counts_of(&hg, hf.p);
    cg = corner_counts_of(&hf, hg.p);
    if (straddles(cf) || ends_on_plane(cf) || !straddles(cg) ||
        !intersection_segment_find(sheet, f, g, &hf, &hg, &segment))
      continue;
    if (!is_point(&segment) && !ARRAY_PUSH(&segments->list, segment))
      return false;
  }
  return true;
}

/* What a range of candidates gives. */
struct resolved_range {
  struct intersection_segments segments;
  uint64_t count; /* of crossings */
  char apart[PARALLEL_APART];
};

struct resolving {
  const struct sheet *sheet;
  const struct incidences *incidences;
  const struct edge_crossing *crossing; /* sorted */
  struct resolved_range *range;
};

enum { CANDIDATES_IN_RANGE = PARALLEL_RANGE(256) };

static bool resolve_range(void *user, struct parallel_range candidates) {
  const struct resolving *r = user;
  const struct edge_crossing *crossing = r->crossing;
  struct resolved_range *own =
      &r->range[candidates.begin / CANDIDATES_IN_RANGE];
  struct edge_fan scratch[3] = {0};
  bool ok = true;
  for (size_t i = candidates.begin; ok && i < candidates.end; i++) {
    struct intersection_segment segment;
    bool cross;
    if (i > 0 && compare_crossings(&crossing[i - 1], &crossing[i], NULL) == 0)
      continue;
    ok = decide_crossing(r->sheet, r->incidences, &crossing[i], scratch,
                         &own->segments, &segment, &cross);
    if (!ok || !cross)
      continue;
    own->count++;
    ok = ARRAY_PUSH(&own->segments.list, segment);
  }
  for (int k = 0; k < 3; k++)
    ARRAY_FREE(&scratch[k].list);
  return ok;
}

/* Decides all candidates; their segments are added in their order. */
static bool resolve_all(struct resolving *resolving, size_t n,
                        struct intersection_segments *segments,
                        uint64_t *count) {
  size_t ranges = parallel_range_count(n, CANDIDATES_IN_RANGE);
  resolving->range = mem_calloc(ranges, sizeof *resolving->range);
  bool ok = resolving->range != NULL &&
            parallel_ranges(parallel_workers(n, CANDIDATES_IN_RANGE), n,
                            CANDIDATES_IN_RANGE, resolve_range, resolving);
  for (size_t r = 0; resolving->range != NULL && r < ranges; r++) {
    struct intersection_segments *own = &resolving->range[r].segments;
    *count += resolving->range[r].count;
    for (size_t i = 0; ok && i < own->list.count; i++)
      ok = ARRAY_PUSH(&segments->list, own->list.item[i]);
    ARRAY_FREE(&own->list);
  }
  mem_free(resolving->range);
  return ok;
}

bool edge_crossings_resolve(struct edge_crossings *crossings,
                            const struct sheet *sheet,
                            struct intersection_segments *segments,
                            uint64_t *count) {
  size_t n = crossings->list.count;
  struct edge_crossing *crossing = crossings->list.item;
  struct incidences incidences = {0};
  struct resolving resolving = {sheet, &incidences, crossing, NULL};
  if (n == 0 && crossings->slanted.count == 0)
    return true;
  bool ok =
      sort_stable(crossing, n, sizeof *crossing, compare_crossings, NULL) &&
      find_incidences(&incidences, sheet, crossings);
  for (size_t i = 0; ok && i < crossings->slanted.count; i++)
    ok = add_slanted_segments(sheet, &incidences,
                              crossings->slanted.item[i].side[0],
                              crossings->slanted.item[i].side[1].i, segments);
  ok = ok && resolve_all(&resolving, n, segments, count);
  incidences_fini(&incidences);
  return ok;
}
