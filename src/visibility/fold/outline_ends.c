/* outline_ends.c - finds the outlines on which intersections end by a grid of
 * their images. */
#include "visibility/fold/outline_ends.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/nearest.h"
#include "view/project.h"
#include "visibility/contour/intersection_ends.h"
#include "visibility/contour/segment_grid.h"

/* How far from an outline an intersection that ends on it may be on the page,
 * grid units, and in space, as a share of the outline's length. */
#define ON_OUTLINE_UNITS (RECTO_FINEST_MM * SHEET_UNITS_PER_MM)
#define ON_OUTLINE_SHARE (1 / 32.0)

static double length_in_view(const struct projection *projection,
                             struct geom_point p, struct geom_point q) {
  struct view_point a = unproject_point(projection, p);
  struct view_point b = unproject_point(projection, q);
  return hypot(hypot(a.x - b.x, a.y - b.y), a.d - b.d);
}

/* Whether an intersection ends on an outline, and at which parameter. */
static bool ends_on_outline(const struct projection *projection,
                            struct geom_segment s, struct geom_point end,
                            double *t) {
  double x = (double)s.q.x - s.p.x, y = (double)s.q.y - s.p.y;
  double px = (double)end.x - s.p.x, py = (double)end.y - s.p.y;
  *t = geom_nearest_parameter(x, y, px, py);
  struct geom_point at = {(int32_t)lrint(s.p.x + *t * x),
                          (int32_t)lrint(s.p.y + *t * y),
                          s.p.z + (int64_t)(*t * (double)(s.q.z - s.p.z))};
  return hypot(px - *t * x, py - *t * y) <= ON_OUTLINE_UNITS &&
         length_in_view(projection, at, end) <=
             ON_OUTLINE_SHARE * length_in_view(projection, s.p, s.q);
}

/* Adds an end of an intersection if it is on an outline. */
static bool add_outline_end(struct outline_ends *ends,
                            const struct projection *projection,
                            const struct segment_grid *outlines,
                            struct geom_point end) {
  struct segment_walk walk =
      segment_grid_near(outlines, end.x, end.y, ON_OUTLINE_UNITS);
  const struct page_segment *s;
  while ((s = segment_walk_next(&walk)) != NULL) {
    struct outline_end made = {.outline = s->owner, .at = end};
    if (ends_on_outline(projection, (struct geom_segment){s->p, s->q}, end,
                        &made.t))
      return ARRAY_PUSH(ends, made);
  }
  return true;
}

static int compare_outline_ends(const void *a, const void *b, void *user) {
  const struct outline_end *p = a, *q = b;
  (void)user;
  return p->outline != q->outline ? compare_numbers(p->outline, q->outline)
                                  : (p->t > q->t) - (p->t < q->t);
}

bool outline_ends_list(struct outline_ends *ends,
                       const struct outline_gaps_input *input) {
  const struct zero_set *set = input->set;
  const struct projection projection = projection_of(&input->sheet->camera);
  struct intersection_ends of = {.item = NULL};
  struct segment_grid outlines = {.contours = 0};
  bool ok = intersection_ends_list(&of, input->sheet, input->map, input->first);
  for (uint32_t i = 0; ok && of.count > 0 && i < set->outline.count; i++)
    ok = poll_at(i) &&
         segment_grid_add(&outlines, set->outline.item[i].image, i);
  outlines.contours = outlines.segment.count;
  if (ok && outlines.contours > 0) {
    ok = segment_grid_make(&outlines);
    for (size_t i = 0; ok && i < of.count; i++)
      ok = poll_at(i) &&
           add_outline_end(ends, &projection, &outlines, of.item[i].at);
  }
  segment_grid_fini(&outlines);
  ARRAY_FREE(&of);
  return ok && sort_stable(ends->item, ends->count, sizeof *ends->item,
                           compare_outline_ends, NULL);
}

size_t outline_ends_between(const struct outline_ends *ends, uint32_t outline,
                            double from, double to, size_t but) {
  const struct outline_end *end = ends->item;
  double low = fmin(from, to), high = fmax(from, to);
  size_t i = 0, found = SIZE_MAX;
  LOWER_BOUND(i, 0, ends->count,
              end[i].outline < outline ||
                  (end[i].outline == outline && end[i].t < low));
  for (; i < ends->count && end[i].outline == outline && end[i].t <= high; i++)
    if (i != but && (found == SIZE_MAX || to < from))
      found = i;
  return found;
}
