/* doubled_cells.c - finds the cells of contours that nearer ones cover. */
#include "visibility/contour/doubled_cells.h"

#include "base/parallel.h"
#include "geom/nearest.h"
#include "geom/vector.h"

/* Over the surface of a nearer contour, so many of its triangles' heights. */
#define WITHIN_SHARE 0.1

/* Contours beside each other turn from each other by no more than 60 degrees,
 * but for edges that are shorter than what is between them may be. */
#define PARALLEL_COSINE 0.5

/* Parts of one curve are beside each other if they are farther apart along it,
 * as a multiple of the distance on the page that covers. */
#define APART_ALONG 8

/* A place in the middle of a cell. */
struct doubled_place {
  uint32_t edge;
  double x, y, z;
  double dx, dy; /* the edge's direction, of unit length */
  double along;
  double reach; /* what covers it is no farther away */
};

/* Whether a contour's segment covers a place. */
static bool covers(const struct doubled_contours *d,
                   const struct page_segment *s,
                   const struct doubled_place *at) {
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = at->x - s->p.x, py = at->y - s->p.y;
  double length = sqrt(x * x + y * y);
  if ((x * at->dx + y * at->dy < PARALLEL_COSINE * length &&
       doubled_length(d, at->edge) > d->beyond) ||
      page_line_is_off(x, y, px, py, at->reach) ||
      doubled_share_point(d, at->edge, s->owner))
    return false;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = vector2_length(px - t * x, py - t * y);
  double height = fmin((double)d->height[at->edge - d->first],
                       (double)d->height[s->owner - d->first]);
  double most =
      x * py - y * px > 0 ? fmax(d->beyond, WITHIN_SHARE * height) : d->beyond;
  double apart = d->along[s->owner - d->first] + t * length - at->along;
  return away <= most && fabs(apart) > APART_ALONG * most &&
         page_segment_depth(s, t) > at->z;
}

/* The nearest contour that covers a place; SHEET_NONE.  Lists go from near to
 * far, so what covers nothing is met only before what does. */
static uint32_t find_covering_contour(const struct doubled_contours *d,
                                      struct doubled_place at,
                                      uint64_t *compared) {
  struct segment_walk walk = segment_grid_near(&d->grid, at.x, at.y, at.reach);
  const struct page_segment *s;
  uint32_t best = SHEET_NONE;
  int64_t nearest = 0;
  while ((s = segment_walk_next(&walk)) != NULL) {
    int64_t z = page_segment_nearest(s);
    if ((double)z <= at.z || (best != SHEET_NONE && z <= nearest)) {
      segment_walk_leave_cell(&walk);
      continue;
    }
    if (page_segment_is_off(s, at.x, at.y, at.reach) || s->owner == at.edge)
      continue;
    ++*compared;
    if (!covers(d, s, &at))
      continue;
    best = s->owner;
    nearest = z;
  }
  return best;
}

/* How far from an edge what covers it is, at most. */
static double reach_of_cover(const struct doubled_contours *d, uint32_t edge) {
  return fmax(d->beyond, WITHIN_SHARE * (double)d->height[edge - d->first]);
}

static struct doubled_place place_of_cell(const struct doubled_contours *d,
                                          const struct doubled_cell *cell) {
  uint32_t index = cell->edge - d->first;
  const uint32_t *point = d->sheet->edge.item[cell->edge].point;
  struct geom_segment of = sheet_ends(d->sheet, point);
  const struct page_segment s = {of.p, of.q, cell->edge};
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double length = doubled_length(d, cell->edge);
  double t = (cell->number + 0.5) / doubled_cells_of(d, cell->edge);
  return (struct doubled_place){.edge = cell->edge,
                                .x = s.p.x + t * x,
                                .y = s.p.y + t * y,
                                .z = page_segment_depth(&s, t),
                                .dx = x / length,
                                .dy = y / length,
                                .along = d->along[index] + t * length,
                                .reach = reach_of_cover(d, cell->edge)};
}

/* Whether two edges are so near each other along a curve that no place of one
 * covers one of the other. */
static bool are_near_along(const struct doubled_contours *d, uint32_t e,
                           uint32_t f) {
  const double *p = &d->along[e - d->first], *q = &d->along[f - d->first];
  return fmax(p[1] - q[0], q[1] - p[0]) < APART_ALONG * d->beyond - 1;
}

/* A filter for edges: whether a contour may cover a place of one. */
static bool may_be_covered(const struct doubled_contours *d, uint32_t edge) {
  struct geom_segment of =
      sheet_ends(d->sheet, d->sheet->edge.item[edge].point);
  struct box2 box = box2_of_segment(of.p, of.q);
  double x = ((double)box.x0 + box.x1) / 2, y = ((double)box.y0 + box.y1) / 2;
  double reach = reach_of_cover(d, edge) + 1, wide = x - box.x0,
         high = y - box.y0;
  double farthest = fmin((double)of.p.z, (double)of.q.z);
  farthest -= 0x1p-50 * fabs(farthest); /* more than rounding */
  struct segment_walk walk =
      segment_grid_near(&d->grid, x, y, fmax(wide, high) + reach);
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL) {
    struct box2 b = box2_of_segment(s->p, s->q);
    if ((double)page_segment_nearest(s) < farthest) {
      segment_walk_leave_cell(&walk);
      continue;
    }
    if (b.x0 <= x + wide + reach && b.x1 >= x - wide - reach &&
        b.y0 <= y + high + reach && b.y1 >= y - high - reach &&
        !doubled_share_point(d, edge, s->owner) &&
        !are_near_along(d, edge, s->owner))
      return true;
  }
  return false;
}

static bool mark_cells_of_range(void *user, struct parallel_range range) {
  struct doubled_contours *d = user;
  uint64_t compared = 0;
  uint32_t last = SHEET_NONE;
  bool may_be = false;
  for (size_t i = range.begin; i < range.end; i++) {
    struct doubled_cell *cell = &d->cell.item[i];
    if (cell->edge != last)
      may_be = may_be_covered(d, cell->edge);
    last = cell->edge;
    if (may_be)
      cell->covering =
          find_covering_contour(d, place_of_cell(d, cell), &compared);
  }
  d->compared += compared;
  return true;
}

bool doubled_cells_mark(struct doubled_contours *d) {
  enum { CELLS_IN_RANGE = PARALLEL_RANGE(256) };
  size_t n = d->cell.count;
  bool ok = parallel_ranges(parallel_workers(n, CELLS_IN_RANGE), n,
                            CELLS_IN_RANGE, mark_cells_of_range, d);
  for (size_t i = 0; ok && i < n; i++)
    if (d->cell.item[i].covering != SHEET_NONE)
      d->is_covered[d->cell.item[i].edge - d->first] = 1;
  return ok;
}
