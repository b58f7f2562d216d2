/* segment_grid.c - lists segments of the page by the cells that they meet. */
#include "visibility/contour/segment_grid.h"

#include "base/poll.h"
#include "base/sort.h"

bool segment_grid_add(struct segment_grid *grid, struct geom_segment segment,
                      uint32_t owner) {
  enum { AT_FIRST = 4096 }; /* fewer are copied often as their array grows */
  struct page_segment made = {segment.p, segment.q, owner};
  if (grid->segment.item == NULL && !ARRAY_RESERVE(&grid->segment, AT_FIRST))
    return false;
  return (made.p.x == made.q.x && made.p.y == made.q.y) ||
         ARRAY_PUSH(&grid->segment, made);
}

static int compare_nearest(const void *a, const void *b, void *user) {
  (void)user;
  int64_t p = page_segment_nearest(a), q = page_segment_nearest(b);
  return (p > q) - (p < q);
}

bool segment_grid_sort(struct segment_grid *grid) {
  return sort_stable(grid->segment.item, grid->segment.count,
                     sizeof *grid->segment.item, compare_nearest, NULL);
}

/* The segments in the cells that they meet. */
struct met_cell {
  uint32_t cell, segment;
};
struct met_cells {
  struct met_cell *item;
  size_t count, capacity;
};

static inline bool add_met_cell(struct segment_grid *grid,
                                struct met_cells *cells, size_t cell,
                                uint32_t segment) {
  number_lists_put(&grid->cell.lists, cell, segment); /* it is counted */
  return ARRAY_PUSH(cells, ((struct met_cell){(uint32_t)cell, segment}));
}

/* Lists the cells that a segment meets. */
static inline bool list_segment(struct segment_grid *grid,
                                struct met_cells *cells, uint32_t segment) {
  const struct triangle_grid *cell = &grid->cell;
  const struct page_segment *s = &grid->segment.item[segment];
  struct cell_range range =
      triangle_grid_cells(cell, box2_of_segment(s->p, s->q));
  if (range.x0 == range.x1 && range.y0 == range.y1)
    return add_met_cell(grid, cells,
                        triangle_grid_index(cell, range.x0, range.y0), segment);
  bool is_wide = range.x0 < range.x1 && range.y0 < range.y1, ok = true;
  for (int y = range.y0; y <= range.y1; y++) {
    int x0 = range.x0, x1 = range.x1;
    if (is_wide)
      triangle_grid_row(cell, s->p, s->q, range, y, &x0, &x1);
    for (int x = x0; ok && x <= x1; x++)
      ok = add_met_cell(grid, cells, triangle_grid_index(cell, x, y), segment);
  }
  return ok;
}

/* Lists the segments by the cells that they meet. */
static bool list_segments_by_cells(struct segment_grid *grid) {
  struct met_cells cells = {.item = NULL};
  struct number_lists *lists = &grid->cell.lists;
  size_t count = triangle_grid_cell_count(&grid->cell);
  bool ok = number_lists_init(lists, count) &&
            ARRAY_RESERVE(&cells, 2 * grid->segment.count);
  for (uint32_t i = 0; ok && i < grid->segment.count; i++)
    ok = list_segment(grid, &cells, i);
  ok = ok && number_lists_allocate(lists, count);
  for (size_t i = 0; ok && i < cells.count; i++)
    number_lists_put(lists, cells.item[i].cell, cells.item[i].segment);
  ARRAY_FREE(&cells);
  return ok;
}

bool segment_grid_make(struct segment_grid *grid) {
  struct triangle_grid *cell = &grid->cell;
  struct box2 all = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t i = 0; i < grid->contours; i++) {
    const struct page_segment *s = &grid->segment.item[i];
    all = box2_union(all, box2_of_segment(s->p, s->q));
  }
  cell->x0 = all.x0;
  cell->y0 = all.y0;
  do {
    cell->shift++;
    cell->columns = (int)(((int64_t)all.x1 - all.x0) >> cell->shift) + 1;
    cell->rows = (int)(((int64_t)all.y1 - all.y0) >> cell->shift) + 1;
  } while ((uint64_t)cell->columns * (uint64_t)cell->rows >
           4 * grid->segment.count + 16);
  return list_segments_by_cells(grid);
}

void segment_grid_fini(struct segment_grid *grid) {
  ARRAY_FREE(&grid->segment);
  number_lists_fini(&grid->cell.lists);
}

bool segment_grid_meet(const struct segment_grid *grid, meet_segments *meet,
                       void *user) {
  const uint32_t *item = grid->cell.lists.item, *start = grid->cell.lists.start;
  const struct page_segment *all = grid->segment.item;
  size_t cells = triangle_grid_cell_count(&grid->cell);
  for (size_t cell = 0; cell < cells; cell++) {
    if (!poll_at(cell))
      return false;
    /* Lists descend: the contours are at the end. */
    for (uint32_t i = start[cell + 1];
         i-- > start[cell] && item[i] < grid->contours;)
      for (uint32_t j = start[cell]; item[j] >= grid->contours; j++)
        if (!meet(user, &all[item[i]], &all[item[j]]))
          return false;
  }
  return true;
}

static bool is_joined(const struct page_segment *a,
                      const struct page_segment *b) {
  return geom_same_point(a->p, b->p) || geom_same_point(a->p, b->q) ||
         geom_same_point(a->q, b->p) || geom_same_point(a->q, b->q);
}

bool page_segments_cross(const struct page_segment *a,
                         const struct page_segment *b, double *s, double *t) {
  int64_t bp = geom_orient2d(a->p, a->q, b->p),
          bq = geom_orient2d(a->p, a->q, b->q);
  if ((bp < 0) == (bq < 0))
    return false;
  int64_t ap = geom_orient2d(b->p, b->q, a->p),
          aq = geom_orient2d(b->p, b->q, a->q);
  if ((ap < 0) == (aq < 0) || is_joined(a, b))
    return false;
  *s = (double)ap / ((double)ap - (double)aq);
  *t = (double)bp / ((double)bp - (double)bq);
  return true;
}
