/* grid.c - segments on the page, found by place. */
#include "judge/grid.h"

#include <string.h>

static uint32_t cell_of(double mm, double cell_mm, uint32_t count) {
  double cell = floor(mm / cell_mm);
  return cell < 0 ? 0 : cell >= count ? count - 1 : (uint32_t)cell;
}

/* Cuts the segment to the strip low <= y <= high; its extent in x there. */
static bool cut_to_row(const struct judge_segment *s, double low, double high,
                       double *x0, double *x1) {
  double t0 = 0, t1 = 1, dy = s->b.y - s->a.y;
  if (dy == 0) {
    if (s->a.y < low || s->a.y > high)
      return false;
  } else {
    double a = (low - s->a.y) / dy, b = (high - s->a.y) / dy;
    t0 = fmax(t0, fmin(a, b));
    t1 = fmin(t1, fmax(a, b));
    if (t0 > t1)
      return false;
  }
  double dx = s->b.x - s->a.x;
  *x0 = fmin(s->a.x + t0 * dx, s->a.x + t1 * dx);
  *x1 = fmax(s->a.x + t0 * dx, s->a.x + t1 * dx);
  return true;
}

/* Visits the cells within reach of segment i: counts them where `item` is
 * not there yet, else enters the segment. */
static void enter(struct judge_grid *grid, uint32_t i, uint32_t *fill) {
  const struct judge_segment *s = &grid->segment[i];
  double reach = grid->reach_mm, cell = grid->cell_mm;
  double low = fmin(s->a.y, s->b.y) - reach;
  double high = fmax(s->a.y, s->b.y) + reach;
  double height = grid->rows * cell, width = grid->columns * cell;
  if (!(low <= height && high >= 0))
    return;
  uint32_t last = cell_of(high, cell, grid->rows);
  for (uint32_t row = cell_of(low, cell, grid->rows); row <= last; row++) {
    double x0, x1;
    if (!cut_to_row(s, row * cell - reach, (row + 1) * cell + reach, &x0,
                    &x1) ||
        x1 + reach < 0 || x0 - reach > width)
      continue;
    uint32_t end = cell_of(x1 + reach, cell, grid->columns);
    for (uint32_t column = cell_of(x0 - reach, cell, grid->columns);
         column <= end; column++) {
      uint32_t *place = &fill[row * grid->columns + column];
      if (grid->item != NULL)
        grid->item[*place] = i;
      ++*place;
    }
  }
}

bool judge_grid_init(struct judge_grid *grid,
                     const struct judge_segment *segment, uint32_t count,
                     double width_mm, double height_mm, double cell_mm,
                     double reach_mm) {
  cell_mm = fmax(cell_mm, reach_mm);
  *grid = (struct judge_grid){.segment = segment,
                              .cell_mm = cell_mm,
                              .reach_mm = reach_mm,
                              .columns = (uint32_t)ceil(width_mm / cell_mm) + 1,
                              .rows = (uint32_t)ceil(height_mm / cell_mm) + 1};
  size_t cells = (size_t)grid->columns * grid->rows;
  grid->start = mem_calloc(cells + 1, sizeof *grid->start);
  uint32_t *fill = mem_calloc(cells + 1, sizeof *fill);
  if (grid->start == NULL || fill == NULL)
    goto end;
  for (uint32_t i = 0; i < count; i++)
    enter(grid, i, fill);
  for (size_t i = 0; i < cells; i++)
    grid->start[i + 1] = grid->start[i] + fill[i];
  grid->item = mem_alloc(grid->start[cells], sizeof *grid->item);
  if (grid->item == NULL)
    goto end;
  memcpy(fill, grid->start, cells * sizeof *fill);
  for (uint32_t i = 0; i < count; i++)
    enter(grid, i, fill);
end:
  mem_free(fill);
  if (grid->item == NULL)
    judge_grid_fini(grid);
  return grid->item != NULL;
}

void judge_grid_fini(struct judge_grid *grid) {
  mem_free(grid->start);
  mem_free(grid->item);
  grid->start = grid->item = NULL;
}

const uint32_t *judge_grid_near(const struct judge_grid *grid,
                                struct judge_place at, uint32_t *count) {
  uint32_t column = cell_of(at.x, grid->cell_mm, grid->columns);
  uint32_t row = cell_of(at.y, grid->cell_mm, grid->rows);
  size_t cell = (size_t)row * grid->columns + column;
  *count = grid->start[cell + 1] - grid->start[cell];
  return grid->item + grid->start[cell];
}

double judge_distance(const struct judge_segment *segment,
                      struct judge_place at, double *t) {
  double dx = segment->b.x - segment->a.x, dy = segment->b.y - segment->a.y;
  double square = dx * dx + dy * dy;
  double px = at.x - segment->a.x, py = at.y - segment->a.y;
  *t = square > 0 ? (px * dx + py * dy) / square : 0;
  *t = fmin(fmax(*t, 0), 1);
  return hypot(px - *t * dx, py - *t * dy);
}
