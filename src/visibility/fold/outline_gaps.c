/* outline_gaps.c - finds the parts of the outline that no contour draws.
 *
 * The mesh's outline is exact and closed; the contours are pieces of curves
 * whose visibility is decided for each as a whole.  Where the two disagree, as
 * about strips thinner than the triangles, the outline decides. */
#include "visibility/fold/outline_gaps.h"

#include <math.h>
#include <stdatomic.h>

#include "base/parallel.h"
#include "base/tolerance.h"
#include "geom/vector.h"
#include "visibility/contour/page_cover.h"
#include "visibility/fold/added_edges.h"
#include "visibility/fold/nearest_contours.h"

/* A place between an outline's samples and its ends, as a share of the distance
 * between two, and how far beside it nothing must be seen, in grid units. */
#define INSET (1 / 16.0)
#define BESIDE 8

/* The mesh's outline passes between the flat contour and the curved one: so far
 * from where a contour ends, as a share of how far these are from each other,
 * it may be where the contour is. */
#define BULGE_SHARE 0.5

/* A sample of an outline. */
struct outline_sample {
  struct geom_point at; /* where the outline is drawn, if it is */
  uint32_t point;       /* the sheet's point there; SHEET_NONE: none */
  bool drawn;           /* a contour, or the edge itself, is */
  uint32_t next;        /* the first sample after it that may not be as it is */
};

struct outline_part {
  struct outline_sample end[2];
  uint32_t face;
};

struct outline_parts {
  struct outline_part *item;
  size_t count, capacity;
};

struct outline_gaps {
  const struct outline_gaps_input *in;
  struct nearest_contours nearest;
  struct page_cover cover;
  struct large_face_size last;
  struct outline_parts part;
};

/* ---- Samples ------------------------------------------------------------- */

static double bulge_of(const struct outline_gaps *g, uint32_t edge) {
  uint32_t i = edge - g->in->first;
  return i < g->in->bulges ? (double)g->in->bulge[i] : 0;
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
static bool sample_outline(struct outline_gaps *g,
                           const struct contour_outline *outline,
                           struct sampled_outline *of) {
  struct geom_segment s = outline->image;
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double length = vector2_length(x, y);
  of->image = s;
  of->radius = fmin(extent_of_face_by(&g->last, g->in->sheet, outline->face),
                    SHEET_XY_MAX);
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

/* The first sample of which a triangle that lies beside an earlier one does not
 * say that something is seen there. */
static uint32_t first_beyond_cover(const struct outline_gaps *g,
                                   const struct sampled_outline *of,
                                   uint32_t k) {
  double reach = page_cover_reach(&g->cover, beside_sample(of, k),
                                  beside_sample(of, of->n));
  if (reach == 1)
    return of->n + 1;
  double from = share_of_sample(of, k);
  double to = from + reach * (share_of_sample(of, of->n) - from);
  uint32_t next = (uint32_t)(to * of->n) + 1;
  return next > k + 1 ? next : k + 1;
}

/* The first sample, from k on, to the right of which nothing is seen; one more
 * than there are: of none. */
static uint32_t first_uncovered(struct outline_gaps *g,
                                const struct sampled_outline *of, uint32_t k,
                                bool *ok) {
  while (*ok && k <= of->n &&
         page_cover_is_over(&g->cover, beside_sample(of, k), ok))
    k = first_beyond_cover(g, of, k);
  return k;
}

/* Whether a contour is drawn at a sample, and where, and up to which one it
 * surely is, too. */
static bool look_at_contours(struct outline_gaps *g,
                             const struct sampled_outline *of, uint32_t k,
                             struct outline_sample *made,
                             struct nearest_contour *found) {
  double radius = of->radius;
  struct nearest_contour near =
      nearest_contours_find(&g->nearest, made->at, of->along, radius);
  *found = near;
  bool at_end = near.loose < near.any &&
                near.loose <= TOLERANCE_OUTLINE_UNITS +
                                  BULGE_SHARE * bulge_of(g, near.loose_edge);
  if (!at_end && near.any <= fmin(near.loose, radius) &&
      nearest_contours_is_beyond_crease(&g->nearest, made->at, &near, radius))
    return false;
  /* Neither distance changes by more than the sample moves. */
  double sure =
      fmin(radius - near.any,
           (fmin(fmin(sqrt(near.end), near.reach), radius) - near.any) / 2);
  if (at_end) {
    made->at = near.loose_at;
    made->point = near.loose_point;
  } else if (near.any <= fmin(near.loose, radius) &&
             !nearest_contours_has_line_between(&g->nearest, made->at,
                                                near.at)) {
    made->at = near.at;
  }
  if (sure > 2 * TOLERANCE_OUTLINE_UNITS)
    made->next = k + (uint32_t)(sure / TOLERANCE_OUTLINE_UNITS);
  return at_end || (near.any <= radius &&
                    near.any <= near.loose + TOLERANCE_COINCIDENT_UNITS);
}

/* Whether a sample that no contour draws is hidden by the surface of another
 * contour all the same, which the mesh is within.
 * near  the contours about it.  From where one ends behind another, the mesh's
 *       outline goes on within what the farther one bulges, too */
static bool is_covered(struct outline_gaps *g, const struct sampled_outline *of,
                       struct geom_point at,
                       const struct nearest_contour *near) {
  double beside = 0;
  if (near->loose < near->any && near->loose <= of->radius &&
      nearest_contours_cover(&g->nearest, near->loose_at,
                             TOLERANCE_COINCIDENT_UNITS,
                             TOLERANCE_COINCIDENT_UNITS))
    beside = TOLERANCE_OUTLINE_UNITS + bulge_of(g, near->loose_edge);
  return nearest_contours_cover(&g->nearest, at, beside, of->radius);
}

/* Looks at sample k of an outline. */
static struct outline_sample look(struct outline_gaps *g,
                                  const struct sampled_outline *of, uint32_t k,
                                  bool *ok) {
  struct outline_sample made = {point_of_sample(of, k), SHEET_NONE, true,
                                k + 1};
  struct nearest_contour near;
  if (nearest_contours_has_line(&g->nearest, made.at) ||
      look_at_contours(g, of, k, &made, &near))
    return made;
  made.next = first_uncovered(g, of, k, ok);
  if (made.next > k)
    return made;
  made.next = k + 1;
  if (!is_covered(g, of, made.at, &near))
    made =
        (struct outline_sample){point_of_outline(of->image, (double)k / of->n),
                                SHEET_NONE, false, k + 1};
  return made;
}

/* ---- Parts --------------------------------------------------------------- */

/* Adds the parts of an outline that are not drawn. */
static bool add_open_parts(struct outline_gaps *g,
                           const struct contour_outline *outline) {
  struct sampled_outline of;
  bool ok = true;
  if (!sample_outline(g, outline, &of))
    return true;
  for (uint32_t k = first_uncovered(g, &of, 0, &ok); ok && k <= of.n;) {
    struct outline_sample to = look(g, &of, k, &ok);
    if (!to.drawn) {
      struct outline_sample from = k > 0 ? look(g, &of, k - 1, &ok) : to;
      while (ok && !to.drawn && k < of.n)
        to = look(g, &of, ++k, &ok);
      if (!ARRAY_PUSH(&g->part,
                      ((struct outline_part){{from, to}, outline->face})))
        return false;
    }
    k = to.next;
  }
  return ok;
}

/* The sheet's point of a sample. */
static bool point_of(struct sheet *sheet, const struct outline_sample *sample,
                     uint32_t *point) {
  *point = sample->point;
  return *point != SHEET_NONE || added_edges_point(sheet, sample->at, point);
}

static bool add_part_edges(struct outline_gaps *g, struct map *map) {
  struct sheet *sheet = g->in->sheet;
  if (!added_edges_reserve(map, g->part.count))
    return false;
  for (size_t i = 0; i < g->part.count; i++) {
    const struct outline_part *part = &g->part.item[i];
    uint32_t point[2];
    if (!point_of(sheet, &part->end[0], &point[0]) ||
        !point_of(sheet, &part->end[1], &point[1]) ||
        !added_edges_push(sheet, map, part->face, point))
      return false;
  }
  return true;
}

/* ---- By several threads -------------------------------------------------- */

enum { OUTLINES_IN_RANGE = PARALLEL_RANGE(128) };

struct gap_search {
  const struct outline_gaps *gaps;
  struct triangle_grid_query *query; /* one a worker */
  struct outline_parts *part;        /* one a range */
  _Atomic uint64_t compared;
};

static bool find_parts_of_range(void *user, struct parallel_range range) {
  struct gap_search *search = user;
  const struct zero_set *set = search->gaps->in->set;
  struct outline_gaps own = *search->gaps;
  bool ok = true;
  own.cover.query = &search->query[range.worker];
  own.nearest.compared = 0;
  for (size_t i = range.begin; ok && i < range.end; i++)
    ok = add_open_parts(&own, &set->outline.item[i]);
  search->part[range.begin / OUTLINES_IN_RANGE] = own.part;
  search->compared += own.nearest.compared;
  return ok;
}

static bool init_queries(const struct outline_gaps *g,
                         struct triangle_grid_query *query, int workers) {
  bool ok = query != NULL;
  for (int i = 0; ok && i < workers; i++)
    ok = triangle_grid_query_init(&query[i], g->in->grid);
  return ok;
}

/* Joins the parts that were found in ranges, in their order. */
static bool join_open_parts(struct outline_gaps *g,
                            const struct outline_parts *part, size_t ranges) {
  for (size_t r = 0; r < ranges; r++)
    for (size_t i = 0; i < part[r].count; i++)
      if (!ARRAY_PUSH(&g->part, part[r].item[i]))
        return false;
  return true;
}

static bool find_open_parts(struct outline_gaps *g) {
  size_t n = g->in->set->outline.count;
  size_t ranges = parallel_range_count(n, OUTLINES_IN_RANGE);
  int workers = parallel_workers(n, OUTLINES_IN_RANGE);
  struct gap_search search = {
      .gaps = g,
      .query = mem_calloc((size_t)workers, sizeof *search.query),
      .part = mem_calloc(ranges, sizeof *search.part)};
  bool ok = init_queries(g, search.query, workers) && search.part != NULL &&
            parallel_ranges(workers, n, OUTLINES_IN_RANGE, find_parts_of_range,
                            &search) &&
            join_open_parts(g, search.part, ranges);
  g->nearest.compared += search.compared;
  for (int i = 0; search.query != NULL && i < workers; i++)
    triangle_grid_query_fini(&search.query[i]);
  for (size_t r = 0; search.part != NULL && r < ranges; r++)
    ARRAY_FREE(&search.part[r]);
  mem_free(search.query);
  mem_free(search.part);
  return ok;
}

bool outline_gaps_close(const struct outline_gaps_input *input) {
  struct outline_gaps g = {
      .in = input,
      .nearest = {.sheet = input->sheet,
                  .map = input->map,
                  .first = input->first,
                  .first_point = input->first_point,
                  .bulge = input->bulge,
                  .bulges = input->bulges,
                  .cusps = !input->exact},
      .cover = {input->sheet, input->grid, NULL, SHEET_NONE}};
  bool ok = nearest_contours_init(&g.nearest) && find_open_parts(&g) &&
            add_part_edges(&g, input->map);
  *input->compared += g.nearest.compared;
  nearest_contours_fini(&g.nearest);
  ARRAY_FREE(&g.part);
  return ok;
}
