/* outline_gaps.c - finds the parts of the outline that no contour draws.
 *
 * The mesh's outline is exact and closed; the contours are pieces of curves
 * whose visibility is decided for each as a whole.  Where the two disagree, as
 * about strips thinner than the triangles, the outline decides. */
#include "visibility/contour/outline_gaps.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "visibility/contour/page_cover.h"
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
  struct page_cover cover;
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
      if (!segment_grid_add(&g->grid, sheet_ends(sheet, point), e))
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

/* Whether a segment is surely no nearer than the nearest drawn points so far,
 * of all that it may change. */
static inline bool is_farther(const struct outline_gaps *g,
                              const struct page_segment *s, struct geom_point p,
                              const struct nearest_contour *best) {
  struct box2 box = box2_of_segment(s->p, s->q);
  double x = max_number(box.x0 - (double)p.x, p.x - (double)box.x1);
  double y = max_number(box.y0 - (double)p.y, p.y - (double)box.y1);
  /* Distances are computed to far less than a unit. */
  double least = max_number(x, y) - 1;
  if (s->owner < g->in->first)
    return least > TOLERANCE_COINCIDENT_UNITS;
  const uint32_t *ends = g->in->sheet->edge.item[s->owner].point;
  return least > best->any && g->ends[ends[0] - g->in->first_point] >= 2 &&
         g->ends[ends[1] - g->in->first_point] >= 2;
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
             i < g->grid.cell.lists.start[cell + 1]; i++) {
          const struct page_segment *s =
              &g->grid.segment.item[g->grid.cell.lists.item[i]];
          if (!is_farther(g, s, p, best))
            try_segment(g, s, p, along, best);
        }
      }
    if (reach >= radius || fmin(best->any, best->loose) <= reach)
      return;
  }
}

static struct geom_point point_of_outline(struct geom_segment s, double t) {
  return (struct geom_point){
      (int32_t)lrint(s.p.x + t * ((double)s.q.x - s.p.x)),
      (int32_t)lrint(s.p.y + t * ((double)s.q.y - s.p.y)),
      s.p.z + (int64_t)(t * (double)(s.q.z - s.p.z))};
}

/* An outline and its samples. */
struct sampled_outline {
  struct geom_segment image;
  double along[2];         /* its direction, of unit length */
  struct geom_point aside; /* from a sample to a place on its right */
  double radius;           /* how far contours are looked for */
  uint32_t n;              /* the last sample; the first is 0 */
};

/* Returns false for an outline that is a point. */
static bool sample_outline(const struct sheet *sheet,
                           const struct contour_outline *outline,
                           struct sampled_outline *of) {
  struct geom_segment s = outline->image;
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double length = hypot(x, y);
  of->image = s;
  of->radius = fmin(extent_of_face(sheet, outline->face), SHEET_XY_MAX);
  if (length == 0 || of->radius == 0)
    return false;
  double by = BESIDE / length;
  of->along[0] = x / length;
  of->along[1] = y / length;
  of->aside =
      (struct geom_point){(int32_t)lrint(by * y), -(int32_t)lrint(by * x), 0};
  of->n = (uint32_t)ceil(length / TOLERANCE_OUTLINE_UNITS);
  return true;
}

/* Where sample k is, as a share of the outline, and there. */
static double share_of_sample(const struct sampled_outline *of, uint32_t k) {
  double inset = k == 0 ? INSET : k == of->n ? -INSET : 0;
  return (k + inset) / of->n;
}

static struct geom_point point_of_sample(const struct sampled_outline *of,
                                         uint32_t k) {
  return point_of_outline(of->image, share_of_sample(of, k));
}

/* The place to the right of a sample. */
static struct geom_point beside_sample(const struct sampled_outline *of,
                                       uint32_t k) {
  struct geom_point p = point_of_sample(of, k);
  return (struct geom_point){p.x + of->aside.x, p.y + of->aside.y, p.z};
}

/* Whether something is seen to the right of all samples of an outline, triangle
 * by triangle. */
static bool is_covered_beside(struct outline_gaps *g,
                              const struct sampled_outline *of, bool *ok) {
  struct geom_point last = beside_sample(of, of->n);
  for (uint32_t k = 0; k <= of->n;) {
    struct geom_point p = beside_sample(of, k);
    if (!page_cover_is_over(&g->cover, p, ok))
      return false;
    double reach = page_cover_reach(&g->cover, p, last);
    if (reach == 1)
      return true;
    double from = share_of_sample(of, k);
    double to = from + reach * (share_of_sample(of, of->n) - from);
    uint32_t next = (uint32_t)(to * of->n) + 1;
    k = next > k + 1 ? next : k + 1;
  }
  return true;
}

/* Looks at sample k of an outline. */
static struct outline_sample look(struct outline_gaps *g,
                                  const struct sampled_outline *of, uint32_t k,
                                  bool *ok) {
  struct geom_point p = point_of_sample(of, k);
  double radius = of->radius;
  struct nearest_contour near;
  find_nearest(g, p, of->along, radius, &near);
  bool at_end =
      near.loose < near.any &&
      near.loose <= TOLERANCE_OUTLINE_UNITS + BULGE_SHARE * near.loose_bulge;
  if (near.on_edge || at_end ||
      (near.any <= radius &&
       near.any <= near.loose + TOLERANCE_COINCIDENT_UNITS) ||
      page_cover_is_over(&g->cover, beside_sample(of, k), ok))
    return (struct outline_sample){
        .at = near.on_edge                           ? p
              : at_end                               ? near.loose_at
              : near.any <= fmin(near.loose, radius) ? near.at
                                                     : p,
        .point = at_end && !near.on_edge ? near.loose_point : SHEET_NONE,
        .drawn = true,
        /* Neither distance changes by more than the sample moves. */
        .sure = fmin(
            radius - near.any,
            (fmin(fmin(sqrt(near.end), FIRST_REACH), radius) - near.any) / 2)};
  return (struct outline_sample){
      .at = point_of_outline(of->image, (double)k / of->n),
      .point = SHEET_NONE};
}

/* ---- Parts --------------------------------------------------------------- */

/* Adds the parts of an outline that are not drawn. */
static bool add_open_parts(struct outline_gaps *g,
                           const struct contour_outline *outline) {
  struct sampled_outline of;
  bool ok = true;
  if (!sample_outline(g->in->sheet, outline, &of) ||
      is_covered_beside(g, &of, &ok))
    return true;
  struct outline_sample from = look(g, &of, 0, &ok);
  struct outline_sample before = from;
  for (uint32_t k = 1; ok && k <= of.n; k++) {
    if (before.drawn && before.sure > 2 * TOLERANCE_OUTLINE_UNITS)
      k += (uint32_t)(before.sure / TOLERANCE_OUTLINE_UNITS) - 2;
    k = k < of.n ? k : of.n;
    struct outline_sample now = look(g, &of, k, &ok);
    if (before.drawn)
      from = before;
    bool ends = now.drawn ? !before.drawn : k == of.n;
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
  struct outline_gaps g = {
      .in = input,
      .cover = {input->sheet, input->grid, input->query, SHEET_NONE}};
  g.ends = mem_calloc(input->sheet->point.count - input->first_point, 1);
  bool ok = g.ends != NULL && list_drawn(&g) &&
            (g.grid.contours == 0 || segment_grid_make(&g.grid)) &&
            find_open_parts(&g, input->set) && add_part_edges(&g, input->map);
  segment_grid_fini(&g.grid);
  mem_free(g.ends);
  ARRAY_FREE(&g.part);
  return ok;
}
