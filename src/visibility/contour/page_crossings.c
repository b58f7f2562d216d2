/* page_crossings.c - finds the crossings of segments on the page by a uniform
 * grid. */
#include "visibility/contour/page_crossings.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "visibility/index/triangle_grid.h"

struct page_segment {
  struct geom_point p, q;
  uint32_t step; /* of a curve; SHEET_NONE: a line that only cuts others */
  bool touches;  /* an intersection: it cuts what it crosses at its own depth */
};

struct crossings {
  struct contour_curves *curves;
  ARRAY(struct page_segment) segment; /* those of curves first */
  size_t of_curves;
  struct triangle_grid grid; /* its shape, and lists of segments */
};

/* ---- The segments -------------------------------------------------------- */

static bool add_page_segment(struct crossings *c, struct geom_segment s,
                             uint32_t step, bool touches) {
  struct page_segment made = {s.p, s.q, step, touches};
  return (s.p.x == s.q.x && s.p.y == s.q.y) || ARRAY_PUSH(&c->segment, made);
}

static bool add_page_segments(struct crossings *c, const struct sheet *sheet) {
  const struct contour_curves *curves = c->curves;
  for (uint32_t i = 0; i < curves->step.count; i++)
    if (curves->step.item[i].segment != SHEET_NONE &&
        !add_page_segment(
            c,
            (struct geom_segment){contour_curves_node(curves, i)->page,
                                  contour_curves_node(curves, i + 1)->page},
            i, false))
      return false;
  c->of_curves = c->segment.count;
  for (size_t i = 0; i < curves->set->border.count; i++)
    if (!add_page_segment(c, curves->set->border.item[i], SHEET_NONE, false))
      return false;
  for (size_t i = sheet->edge.count;
       i > 0 && sheet->edge.item[i - 1].edge_class == RECTO_EDGE_INTERSECTION;
       i--)
    if (!add_page_segment(c, sheet_ends(sheet, sheet->edge.item[i - 1].point),
                          SHEET_NONE, true))
      return false;
  return true;
}

/* ---- The grid ------------------------------------------------------------ */

static struct box2 box_of_segment(const struct page_segment *s) {
  return (struct box2){box2_min(s->p.x, s->q.x), box2_min(s->p.y, s->q.y),
                       box2_max(s->p.x, s->q.x), box2_max(s->p.y, s->q.y)};
}

/* Counts a segment in the lists of the cells that it meets, or stores it. */
static void list_segment(struct crossings *c, uint32_t segment, bool store) {
  struct triangle_grid *grid = &c->grid;
  const struct page_segment *s = &c->segment.item[segment];
  struct cell_range range = triangle_grid_cells(grid, box_of_segment(s));
  for (int y = range.y0; y <= range.y1; y++) {
    int x0, x1;
    triangle_grid_row(grid, s->p, s->q, range, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      uint32_t *end =
          &grid->start[(size_t)y * (size_t)grid->columns + (size_t)x];
      if (store)
        grid->item[--*end] = segment;
      else
        ++*end;
    }
  }
}

/* Chooses cells of which there are about as many as segments, in the box of the
 * curves, and lists the segments.  Returns false when memory ran out. */
static bool make_grid(struct crossings *c) {
  struct triangle_grid *grid = &c->grid;
  struct box2 all = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t i = 0; i < c->of_curves; i++) {
    struct box2 box = box_of_segment(&c->segment.item[i]);
    all = (struct box2){box2_min(all.x0, box.x0), box2_min(all.y0, box.y0),
                        box2_max(all.x1, box.x1), box2_max(all.y1, box.y1)};
  }
  grid->x0 = all.x0;
  grid->y0 = all.y0;
  do {
    grid->shift++;
    grid->columns = (int)(((int64_t)all.x1 - all.x0) >> grid->shift) + 1;
    grid->rows = (int)(((int64_t)all.y1 - all.y0) >> grid->shift) + 1;
  } while ((uint64_t)grid->columns * (uint64_t)grid->rows >
           2 * c->segment.count + 16);
  size_t cells = triangle_grid_cell_count(grid);
  grid->start = mem_calloc(cells + 1, sizeof *grid->start);
  if (grid->start == NULL)
    return false;
  for (uint32_t i = 0; i < c->segment.count; i++)
    list_segment(c, i, false);
  for (size_t i = 1; i <= cells; i++)
    grid->start[i] += grid->start[i - 1];
  grid->item = mem_alloc(grid->start[cells], sizeof *grid->item);
  if (grid->item == NULL)
    return false;
  for (uint32_t i = 0; i < c->segment.count; i++)
    list_segment(c, i, true);
  return true;
}

/* ---- Crossings ----------------------------------------------------------- */

static double depth_at(const struct page_segment *s, double t) {
  return (double)s->p.z + t * (double)(s->q.z - s->p.z);
}

static bool is_joined(const struct page_segment *a,
                      const struct page_segment *b) {
  return geom_same_point(a->p, b->p) || geom_same_point(a->p, b->q) ||
         geom_same_point(a->q, b->p) || geom_same_point(a->q, b->q);
}

/* Cuts a segment where the other one crosses it, if it is the farther one.  A
 * point on a line counts as left of it. */
static bool cut_at_crossing(struct crossings *c, const struct page_segment *a,
                            const struct page_segment *b) {
  int64_t bp = geom_orient2d(a->p, a->q, b->p),
          bq = geom_orient2d(a->p, a->q, b->q),
          ap = geom_orient2d(b->p, b->q, a->p),
          aq = geom_orient2d(b->p, b->q, a->q);
  if ((bp < 0) == (bq < 0) || (ap < 0) == (aq < 0) || is_joined(a, b))
    return true;
  double s = (double)ap / ((double)ap - (double)aq);
  double t = (double)bp / ((double)bp - (double)bq);
  double depth = depth_at(b, t) - depth_at(a, s);
  struct contour_cut of_a = {a->step, fmin(s, 1 - 0x1p-30), true};
  struct contour_cut of_b = {b->step, fmin(t, 1 - 0x1p-30), true};
  return (!(b->touches || depth > 0) || ARRAY_PUSH(&c->curves->cut, of_a)) &&
         (b->step == SHEET_NONE || depth >= 0 ||
          ARRAY_PUSH(&c->curves->cut, of_b));
}

static bool cut_at_crossings(struct crossings *c) {
  size_t cells = triangle_grid_cell_count(&c->grid);
  for (size_t cell = 0; cell < cells; cell++) {
    const uint32_t *item = c->grid.item;
    if (!poll_at(cell))
      return false;
    /* Lists descend: the segments of curves are at the end. */
    for (uint32_t i = c->grid.start[cell]; i < c->grid.start[cell + 1]; i++)
      for (uint32_t j = c->grid.start[cell]; item[i] < c->of_curves && j < i;
           j++)
        if (!cut_at_crossing(c, &c->segment.item[item[i]],
                             &c->segment.item[item[j]]))
          return false;
  }
  return true;
}

bool page_crossings_cut(struct contour_curves *curves,
                        const struct sheet *sheet) {
  struct crossings c = {.curves = curves};
  bool ok = add_page_segments(&c, sheet) &&
            (c.of_curves == 0 || (make_grid(&c) && cut_at_crossings(&c)));
  ARRAY_FREE(&c.segment);
  mem_free(c.grid.start);
  mem_free(c.grid.item);
  return ok;
}
