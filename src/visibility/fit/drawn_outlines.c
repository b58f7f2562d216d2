/* drawn_outlines.c - finds the nearest of the outlines that are drawn. */
#include "visibility/fit/drawn_outlines.h"

#include <math.h>

#include "base/tolerance.h"

/* Contours that turn from a side by more than 120 degrees are probably those of
 * another surface beside it, and count as so many times as far. */
#define TURNED_COSINE (-0.5)
#define TURNED_WEIGHT 4

bool drawn_outlines_list(struct drawn_outlines *d) {
  const struct sheet *sheet = d->sheet;
  const unsigned features =
      RECTO_EDGE_CREASE | RECTO_EDGE_GROUP | RECTO_EDGE_SMOOTH;
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (d->map->edge_state[e] == MAP_HIDDEN || !sheet_edge_is_drawn(sheet, e) ||
        (e < d->first && (edge->edge_class & features) != 0))
      continue;
    if (!segment_grid_add(&d->grid, sheet_ends(sheet, edge->point), e))
      return false;
  }
  d->grid.contours = d->grid.segment.count;
  return d->grid.contours == 0 || segment_grid_make(&d->grid);
}

void drawn_outlines_fini(struct drawn_outlines *d) {
  segment_grid_fini(&d->grid);
}

/* Tries a segment; a contour has its surface on its left, as a side has. */
static void try_drawn(const struct drawn_outlines *d,
                      const struct page_segment *s, const double p[2],
                      const double along[2], struct drawn_place *best) {
  struct box2 box = box2_of_segment(s->p, s->q);
  /* Distances are computed to far less than a unit. */
  double least = best->distance + 1;
  if (box.x0 - p[0] > least || p[0] - box.x1 > least || box.y0 - p[1] > least ||
      p[1] - box.y1 > least)
    return;
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = p[0] - s->p.x, py = p[1] - s->p.y;
  double t = fmin(fmax((px * x + py * y) / (x * x + y * y), 0), 1);
  double distance = hypot(px - t * x, py - t * y);
  if (distance >= best->distance)
    return;
  if (s->owner >= d->first &&
      x * along[0] + y * along[1] <
          TURNED_COSINE * hypot(x, y) * hypot(along[0], along[1]))
    distance *= TURNED_WEIGHT;
  if (distance >= best->distance)
    return;
  best->distance = distance;
  best->edge = s->owner;
  best->at[0] = s->p.x + t * x;
  best->at[1] = s->p.y + t * y;
}

static void try_cells(const struct drawn_outlines *d, const double p[2],
                      double by, const double along[2],
                      struct drawn_place *best) {
  struct segment_walk walk = segment_grid_near(&d->grid, p[0], p[1], by);
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL)
    try_drawn(d, s, p, along, best);
}

struct drawn_place drawn_outlines_find(const struct drawn_outlines *d,
                                       const double p[2], const double along[2],
                                       double radius) {
  struct drawn_place best = {.distance = INFINITY, .edge = SHEET_NONE};
  if (d->grid.contours == 0)
    return best;
  for (double by = TOLERANCE_FILL_UNITS;; by = fmin(4 * by, radius)) {
    try_cells(d, p, by, along, &best);
    if (best.distance <= by || by >= radius)
      break;
  }
  if (best.distance > radius)
    best.distance = INFINITY;
  return best;
}
