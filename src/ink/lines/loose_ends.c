/* loose_ends.c - lists loose ends of spurs in the cells of a uniform grid, and
 * tests segments with those in their cells. */
#include "ink/lines/loose_ends.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geom/nearest.h"

/* The cells of the grid along each side of the page, at most. */
enum { GRID_MAX = 1 << 10 };

bool loose_ends_init(struct loose_ends *ends, const struct segment_graph *graph,
                     const struct pens *pens, const double page_mm[2]) {
  double longest = fmax(page_mm[0], page_mm[1]) * SHEET_UNITS_PER_MM;
  memset(ends, 0, sizeof *ends);
  ends->graph = graph;
  for (uint32_t pen = 0; pen < pens->count; pen++)
    ends->near =
        fmax(ends->near, pens_width_mm(pens, pen) / 2 * SHEET_UNITS_PER_MM);
  ends->cell = fmax(4 * ends->near, longest / GRID_MAX);
  ends->per_unit = 1 / ends->cell;
  for (int axis = 0; axis < 2; axis++) {
    ends->low[axis] = -page_mm[axis] / 2 * SHEET_UNITS_PER_MM;
    ends->count[axis] = 1 - (int)floor(2 * ends->low[axis] / ends->cell);
  }
  size_t cells = (size_t)ends->count[0] * (size_t)ends->count[1];
  ends->first = mem_calloc(cells, sizeof *ends->first);
  ends->is_near = mem_calloc(cells, sizeof *ends->is_near);
  return ends->first != NULL && ends->is_near != NULL;
}

void loose_ends_fini(struct loose_ends *ends) {
  ARRAY_FREE(&ends->end);
  mem_free(ends->first);
  mem_free(ends->is_near);
  ARRAY_FREE(&ends->listed);
}

/* Lists an end in its cell and in those about it: what is near the end is in
 * one of them. */
static bool list_loose_end(struct loose_ends *ends, struct ink_point at,
                           uint32_t number) {
  int x = loose_ends_cell(ends, 0, at.x), y = loose_ends_cell(ends, 1, at.y);
  for (int row = y - 2; row <= y + 2; row++)
    for (int i = x - 2; i <= x + 2; i++) {
      if (row < 0 || row >= ends->count[1] || i < 0 || i >= ends->count[0])
        continue;
      int cell = row * ends->count[0] + i;
      ends->is_near[cell] = 1;
      if (abs(row - y) > 1 || abs(i - x) > 1)
        continue;
      struct listed_end listed = {number, ends->first[cell]};
      if (!ARRAY_PUSH(&ends->listed, listed))
        return false;
      ends->first[cell] = (uint32_t)ends->listed.count;
    }
  return true;
}

bool loose_ends_add(struct loose_ends *ends, struct loose_end end,
                    bool is_listed) {
  uint32_t number = (uint32_t)ends->end.count;
  return ARRAY_PUSH(&ends->end, end) &&
         (!is_listed || list_loose_end(ends, end.at, number));
}

/* ---- Segments ------------------------------------------------------------ */

struct segment_places {
  struct ink_point p, q;
};

static struct segment_places places_of(const struct loose_ends *ends,
                                       uint32_t segment) {
  const uint32_t *node = ends->graph->segment.item[segment].node;
  const struct ink_point *place = ends->graph->node.item;
  return (struct segment_places){place[node[0]], place[node[1]]};
}

/* Whether a number is within `near` of a range, given by its ends. */
static bool is_near_span(int32_t a, int32_t b, int32_t at, double near) {
  double low = a < b ? a : b, high = a < b ? b : a;
  return low - near <= at && at <= high + near;
}

/* Whether a segment is within half a pen of a place.  One whose box is farther
 * away by a grid unit, more than rounding can bring it nearer, is not. */
static bool is_near_place(const struct loose_ends *ends,
                          const struct segment_places *s, struct ink_point at) {
  if (!is_near_span(s->p.x, s->q.x, at.x, ends->near + 1) ||
      !is_near_span(s->p.y, s->q.y, at.y, ends->near + 1))
    return false;
  double x = (double)s->q.x - s->p.x, y = (double)s->q.y - s->p.y;
  double px = (double)at.x - s->p.x, py = (double)at.y - s->p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  return hypot(px - t * x, py - t * y) <= ends->near;
}

/* Tests a segment with the loose ends in a list.  Those that some segment is
 * near leave it, unless other threads read it. */
static void test_list(struct loose_ends *ends, uint32_t *link,
                      const struct segment_places *segment, uint32_t own) {
  while (*link != 0) {
    struct listed_end *listed = &ends->listed.item[*link - 1];
    struct loose_end *end = &ends->end.item[listed->end];
    bool is_passed = loose_ends_is_found(&end->is_passed);
    if (!is_passed && end->spur != own &&
        is_near_place(ends, segment, end->at)) {
      loose_ends_set_found(&end->is_passed);
      is_passed = true;
    }
    if (is_passed && !ends->is_shared)
      *link = listed->next;
    else
      link = &listed->next;
  }
}

/* Tests a segment with what is listed in all of its cells, row by row. */
static void test_rows(struct loose_ends *ends, const struct segment_places *s,
                      uint32_t own) {
  double low = fmin(s->p.y, s->q.y), high = fmax(s->p.y, s->q.y);
  double slope =
      high > low ? ((double)s->q.x - s->p.x) / ((double)s->q.y - s->p.y) : 0;
  for (int row = loose_ends_cell(ends, 1, low);
       row <= loose_ends_cell(ends, 1, high); row++) {
    double from = ends->low[1] + row * ends->cell - ends->near;
    double y0 = fmin(fmax(from, low), high);
    double y1 = fmin(fmax(from + ends->cell + 2 * ends->near, low), high);
    double x0 = s->p.x + slope * (y0 - s->p.y),
           x1 = s->p.x + slope * (y1 - s->p.y);
    if (high == low) {
      x0 = s->p.x;
      x1 = s->q.x;
    }
    int last = loose_ends_cell(ends, 0, fmax(x0, x1));
    for (int x = loose_ends_cell(ends, 0, fmin(x0, x1)); x <= last; x++)
      test_list(ends, &ends->first[row * ends->count[0] + x], s, own);
  }
}

/* A segment is in no other cells than those of its ends where these are one, or
 * two that share a side. */
void loose_ends_test(struct loose_ends *ends, uint32_t segment, uint32_t own) {
  const struct segment_places at = places_of(ends, segment);
  int x = loose_ends_cell(ends, 0, at.p.x),
      y = loose_ends_cell(ends, 1, at.p.y);
  int dx = loose_ends_cell(ends, 0, at.q.x) - x,
      dy = loose_ends_cell(ends, 1, at.q.y) - y;
  if (abs(dx) + abs(dy) > 1) {
    test_rows(ends, &at, own);
    return;
  }
  uint32_t *first = &ends->first[y * ends->count[0] + x];
  test_list(ends, first, &at, own);
  test_list(ends, first + dy * ends->count[0] + dx, &at, own);
}
