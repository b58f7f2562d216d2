/* outline_gaps.c - finds the parts of the outline that no contour draws.
 *
 * The mesh's outline is exact and closed; the contours are pieces of curves
 * whose visibility is decided for each as a whole.  Where the two disagree, as
 * about strips thinner than the triangles, the outline decides. */
#include "visibility/contour/outline_gaps.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "visibility/contour/segment_grid.h"

/* A place between an outline's samples and its ends, as a share of the distance
 * between two, and how far beside it nothing must be seen, in grid units. */
#define INSET (1 / 16.0)
#define BESIDE 8

/* How far about a sample drawn contours are looked for at first. */
#define FIRST_REACH (16.0 * TOLERANCE_OUTLINE_UNITS)

/* Contours that turn from an outline by more than 120 degrees are those of
 * another surface beside it. */
#define TURNED_COSINE (-0.5)

/* The mesh's outline passes between the flat contour and the curved one: so far
 * from where a contour ends, as a share of how far these are from each other,
 * it may be where the contour is. */
#define BULGE_SHARE 0.5

/* A sample of an outline. */
struct outline_sample {
  struct geom_point at; /* where the outline is drawn, if it is */
  uint32_t point;       /* the sheet's point there; SHEET_NONE: none */
  bool drawn;           /* a contour, or the edge itself, is */
  double sure;          /* grid units, about it, over which it surely is, too */
};

struct outline_part {
  struct outline_sample end[2];
  uint32_t face;
};

struct outline_gaps {
  const struct outline_gaps_input *in;
  struct segment_grid grid;
  uint8_t *ends; /* one a point of contours: of visible ones, at most 2 */
  ARRAY(struct outline_part) part;
};

/* ---- What is drawn ------------------------------------------------------- */

static bool list_drawn(struct outline_gaps *g) {
  const struct sheet *sheet = g->in->sheet;
  for (uint32_t i = 0; i < 2; i++)
    for (uint32_t e = i == 0 ? g->in->first : 0;
         e < (i == 0 ? sheet->edge.count : g->in->first); e++) {
      const uint32_t *point = sheet->edge.item[e].point;
      if (g->in->map->edge_state[e] == MAP_HIDDEN ||
          !sheet_edge_is_drawn(sheet, e))
        continue;
      if (!segment_grid_add(&g->grid, sheet_ends(sheet, point), e, false))
        return false;
      g->grid.contours = g->grid.segment.count;
      for (int k = 0; i == 0 && k < 2; k++) {
        uint8_t *ends = &g->ends[point[k] - g->in->first_point];
        *ends = (uint8_t)(*ends + (*ends < 2));
      }
    }
  return true;
}

/* ---- Samples ------------------------------------------------------------- */

/* The nearest drawn points to one: of all, and of loose ends. */
struct nearest_contour {
  double any, loose; /* distances */
  double end;        /* the square of that of a loose end, wherever it lies */
  struct geom_point at; /* of any */
  struct geom_point loose_at;
  uint32_t loose_point;
  double loose_bulge; /* of the contour that ends there */
  bool on_edge;       /* a line other than a contour runs there */
};

static double bulge_of(const struct outline_gaps *g, uint32_t edge) {
  uint32_t i = edge - g->in->first;
  return i < g->in->bulges ? (double)g->in->bulge[i] : 0;
}

/* Tries a segment, unless the surface lies on its other side.
 * along  the outline's direction, of unit length */
static void try_segment(const struct outline_gaps *g,
                        const struct page_segment *s, struct geom_point p,
                        const double along[2], struct nearest_contour *best) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = (double)p.x - s->p.x, py = (double)p.y - s->p.y;
  double square = x * x + y * y;
  double t = min_number(max_number((px * x + py * y) / square, 0), 1);
  double away_x = px - t * x, away_y = py - t * y;
  double distance = sqrt(away_x * away_x + away_y * away_y);
  if (s->owner < g->in->first) {
    unsigned edge_class = g->in->sheet->edge.item[s->owner].edge_class;
    best->on_edge =
        best->on_edge ||
        ((edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) == 0 &&
         distance <= TOLERANCE_COINCIDENT_UNITS);
    return;
  }
  if (x * along[0] + y * along[1] < TURNED_COSINE * sqrt(square))
    return;
  const uint32_t *ends = g->in->sheet->edge.item[s->owner].point;
  if (g->ends[ends[0] - g->in->first_point] < 2)
    best->end = min_number(best->end, px * px + py * py);
  if (g->ends[ends[1] - g->in->first_point] < 2)
    best->end =
        min_number(best->end, (px - x) * (px - x) + (py - y) * (py - y));
  uint32_t point = ends[t > 0];
  if ((t == 0 || t == 1) && g->ends[point - g->in->first_point] < 2) {
    if (distance < best->loose) {
      best->loose = distance;
      best->loose_at = t == 0 ? s->p : s->q;
      best->loose_point = point;
      best->loose_bulge = bulge_of(g, s->owner);
    }
  } else if (distance < best->any) {
    best->any = distance;
    best->at = (struct geom_point){
        (int32_t)lrint(s->p.x + t * x), (int32_t)lrint(s->p.y + t * y),
        s->p.z + (int64_t)(t * (double)(s->q.z - s->p.z))};
  }
}

/* Finds the nearest drawn points not farther than a radius. */
static void find_nearest(const struct outline_gaps *g, struct geom_point p,
                         const double along[2], double radius,
                         struct nearest_contour *best) {
  double reach = fmin(FIRST_REACH, radius);
  *best = (struct nearest_contour){
      .any = INFINITY, .loose = INFINITY, .end = INFINITY};
  for (; g->grid.contours > 0; reach *= 2) {
    int32_t by = (int32_t)fmin(reach, radius);
    struct cell_range range = triangle_grid_cells(
        &g->grid.cell, (struct box2){p.x - by, p.y - by, p.x + by, p.y + by});
    for (int y = range.y0; y <= range.y1; y++)
      for (int x = range.x0; x <= range.x1; x++) {
        size_t cell = triangle_grid_index(&g->grid.cell, x, y);
        for (uint32_t i = g->grid.cell.lists.start[cell];
             i < g->grid.cell.lists.start[cell + 1]; i++)
          try_segment(g, &g->grid.segment.item[g->grid.cell.lists.item[i]], p,
                      along, best);
      }
    if (reach >= radius || fmin(best->any, best->loose) <= reach)
      return;
  }
}

/* Whether a triangle lies over a point of the page; *ok is false when memory
 * ran out. */
static bool is_covered(struct outline_gaps *g, struct geom_point p, bool *ok) {
  *ok =
      *ok && triangle_grid_find(g->in->grid, (struct box2){p.x, p.y, p.x, p.y},
                                g->in->query);
  for (size_t i = 0; *ok && i < g->in->query->found.count; i++) {
    uint32_t t = g->in->query->found.item[i];
    struct geom_triangle of = sheet_corners(g->in->sheet, t);
    bool inside = (g->in->sheet->triangle_flags[t] & SHEET_EDGE_ON) == 0;
    for (int k = 0; inside && k < 3; k++)
      inside = geom_orient2d(of.p[k], of.p[geom_next_corner(k)], p) >= 0;
    if (inside)
      return true;
  }
  return false;
}

/* Whether nothing is seen to the right of an outline at a point of it. */
static bool is_at_background(struct outline_gaps *g, struct geom_segment s,
                             struct geom_point p, bool *ok) {
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double by = BESIDE / hypot(x, y);
  struct geom_point right = {p.x + (int32_t)lrint(by * y),
                             p.y - (int32_t)lrint(by * x), p.z};
  return !is_covered(g, right, ok) && *ok;
}

static struct geom_point point_of_outline(struct geom_segment s, double t) {
  return (struct geom_point){
      (int32_t)lrint(s.p.x + t * ((double)s.q.x - s.p.x)),
      (int32_t)lrint(s.p.y + t * ((double)s.q.y - s.p.y)),
      s.p.z + (int64_t)(t * (double)(s.q.z - s.p.z))};
}

/* Looks at sample k of n of an outline. */
static struct outline_sample look(struct outline_gaps *g,
                                  const struct contour_outline *outline,
                                  double radius, uint32_t k, uint32_t n,
                                  bool *ok) {
  double inset = k == 0 ? INSET : k == n ? -INSET : 0;
  struct geom_point p = point_of_outline(outline->image, (k + inset) / n);
  struct geom_segment s = outline->image;
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  const double along[2] = {x / hypot(x, y), y / hypot(x, y)};
  struct nearest_contour near;
  find_nearest(g, p, along, radius, &near);
  bool at_end =
      near.loose < near.any &&
      near.loose <= TOLERANCE_OUTLINE_UNITS + BULGE_SHARE * near.loose_bulge;
  if (near.on_edge || at_end ||
      (near.any <= radius &&
       near.any <= near.loose + TOLERANCE_COINCIDENT_UNITS) ||
      !is_at_background(g, outline->image, p, ok))
    return (struct outline_sample){
        .at = near.on_edge             ? p
              : at_end                 ? near.loose_at
              : near.any <= near.loose ? near.at
                                       : p,
        .point = at_end && !near.on_edge ? near.loose_point : SHEET_NONE,
        .drawn = true,
        /* Neither distance changes by more than the sample moves. */
        .sure = fmin(
            radius - near.any,
            (fmin(fmin(sqrt(near.end), FIRST_REACH), radius) - near.any) / 2)};
  return (struct outline_sample){
      .at = point_of_outline(outline->image, (double)k / n),
      .point = SHEET_NONE};
}

/* ---- Parts --------------------------------------------------------------- */

/* Adds the parts of an outline that are not drawn. */
static bool add_open_parts(struct outline_gaps *g,
                           const struct contour_outline *outline) {
  struct geom_segment s = outline->image;
  double length = hypot((double)s.q.x - s.p.x, (double)s.q.y - s.p.y);
  double radius =
      fmin(extent_of_face(g->in->sheet, outline->face), SHEET_XY_MAX);
  bool ok = true;
  if (length == 0 || radius == 0)
    return true;
  uint32_t n = (uint32_t)ceil(length / TOLERANCE_OUTLINE_UNITS);
  struct outline_sample from = look(g, outline, radius, 0, n, &ok);
  struct outline_sample before = from;
  for (uint32_t k = 1; ok && k <= n; k++) {
    if (before.drawn && before.sure > 2 * TOLERANCE_OUTLINE_UNITS)
      k += (uint32_t)(before.sure / TOLERANCE_OUTLINE_UNITS) - 2;
    k = k < n ? k : n;
    struct outline_sample now = look(g, outline, radius, k, n, &ok);
    if (before.drawn)
      from = before;
    bool ends = now.drawn ? !before.drawn : k == n;
    if (ends && !ARRAY_PUSH(&g->part, ((struct outline_part){{from, now},
                                                             outline->face})))
      return false;
    before = now;
  }
  return ok;
}

/* The sheet's point of a sample. */
static bool point_of(struct sheet *sheet, const struct outline_sample *sample,
                     uint32_t *point) {
  *point = sample->point;
  if (*point != SHEET_NONE)
    return true;
  *point = (uint32_t)sheet->point.count;
  return ARRAY_PUSH(&sheet->point, sample->at);
}

static bool add_part_edges(struct outline_gaps *g, struct map *map) {
  struct sheet *sheet = g->in->sheet;
  uint8_t *state =
      mem_resize(map->edge_state, sheet->edge.count + g->part.count, 1);
  if (state == NULL)
    return false;
  map->edge_state = state;
  for (size_t i = 0; i < g->part.count; i++) {
    const struct outline_part *part = &g->part.item[i];
    struct sheet_edge edge = {
        .triangle = {first_triangle_of_face(sheet, part->face), SHEET_NONE},
        .source = SHEET_NONE,
        .group = sheet_face_group(sheet, part->face),
        .edge_class = RECTO_EDGE_SILHOUETTE};
    if (!point_of(sheet, &part->end[0], &edge.point[0]) ||
        !point_of(sheet, &part->end[1], &edge.point[1]) ||
        !ARRAY_PUSH(&sheet->edge, edge))
      return false;
    map->edge_state[map->edge_count++] = MAP_VISIBLE;
  }
  return true;
}

static bool find_open_parts(struct outline_gaps *g,
                            const struct zero_set *set) {
  for (size_t i = 0; i < set->outline.count; i++)
    if (!poll_at(i) || !add_open_parts(g, &set->outline.item[i]))
      return false;
  return true;
}

bool outline_gaps_close(const struct outline_gaps_input *input) {
  struct outline_gaps g = {.in = input};
  g.ends = mem_calloc(input->sheet->point.count - input->first_point, 1);
  bool ok = g.ends != NULL && list_drawn(&g) &&
            (g.grid.contours == 0 || segment_grid_make(&g.grid)) &&
            find_open_parts(&g, input->set) && add_part_edges(&g, input->map);
  segment_grid_fini(&g.grid);
  mem_free(g.ends);
  ARRAY_FREE(&g.part);
  return ok;
}
