/* grid.c - a uniform grid over segments of the page, for queries by position.
 */
#include "judge/grid.h"

#include "base/poll.h"

#include <string.h>

/* A segment across the page is in as many cells as a row and a column have.
 * While the total exceeds CELLS_PER_SEGMENT for each segment and 4 for each
 * cell, the cells are made twice as wide: so memory grows with the number of
 * segments, not with their length. */
enum { CELLS_PER_SEGMENT = 256, MIN_CELLS = 9 };

static uint32_t grid_cell_at(double mm, double cell_mm, uint32_t count) {
  double cell = floor(mm / cell_mm);
  return cell < 0 ? 0 : cell >= count ? count - 1 : (uint32_t)cell;
}

/* Clips the segment to the strip low <= y <= high and sets its range of x;
 * false where it is outside. */
static bool clip_to_row(const struct judge_segment *s, double low, double high,
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

/* Visits the cells near segment i (within the radius): counts it in each while
 * `item` is NULL, else enters it.
 * fill  one a cell: the count, or the next free index
 * Returns the number of cells. */
static size_t visit_cells(struct judge_grid *grid, uint32_t i, uint32_t *fill) {
  size_t visited = 0;
  const struct judge_segment *s = &grid->segment[i];
  double radius = grid->radius_mm, cell = grid->cell_mm;
  double low = fmin(s->a.y, s->b.y) - radius;
  double high = fmax(s->a.y, s->b.y) + radius;
  double height = grid->rows * cell, width = grid->columns * cell;
  if (!(low <= height && high >= 0))
    return 0;
  uint32_t last = grid_cell_at(high, cell, grid->rows);
  for (uint32_t row = grid_cell_at(low, cell, grid->rows); row <= last; row++) {
    double x0, x1;
    if (!clip_to_row(s, row * cell - radius, (row + 1) * cell + radius, &x0,
                     &x1) ||
        x1 + radius < 0 || x0 - radius > width)
      continue;
    uint32_t end = grid_cell_at(x1 + radius, cell, grid->columns);
    for (uint32_t column = grid_cell_at(x0 - radius, cell, grid->columns);
         column <= end; column++) {
      uint32_t *slot = &fill[row * grid->columns + column];
      if (grid->item != NULL)
        grid->item[*slot] = i;
      ++*slot;
      visited++;
    }
  }
  return visited;
}

/* Counts the segments of each cell; false where the total is over the limit. */
static bool count_items(struct judge_grid *grid, uint32_t count,
                        uint32_t *fill) {
  size_t cells = (size_t)grid->columns * grid->rows, items = 0;
  size_t most = (size_t)CELLS_PER_SEGMENT * count + 4 * cells;
  most = most < UINT32_MAX ? most : UINT32_MAX;
  memset(fill, 0, (cells + 1) * sizeof *fill);
  for (uint32_t i = 0; i < count && items <= most && poll_at(i); i++)
    items += visit_cells(grid, i, fill);
  return items <= most;
}

static void set_cells(struct judge_grid *grid, double width_mm,
                      double height_mm, double cell_mm) {
  grid->cell_mm = cell_mm;
  grid->columns = (uint32_t)ceil(width_mm / cell_mm) + 1;
  grid->rows = (uint32_t)ceil(height_mm / cell_mm) + 1;
}

bool judge_grid_init(struct judge_grid *grid,
                     const struct judge_segment *segment, uint32_t count,
                     double width_mm, double height_mm, double cell_mm,
                     double radius_mm) {
  *grid = (struct judge_grid){.segment = segment, .radius_mm = radius_mm};
  set_cells(grid, width_mm, height_mm, fmax(cell_mm, radius_mm));
  size_t cells = (size_t)grid->columns * grid->rows;
  grid->start = mem_calloc(cells + 1, sizeof *grid->start);
  uint32_t *fill = mem_calloc(cells + 1, sizeof *fill);
  if (grid->start == NULL || fill == NULL)
    goto end;
  while (!count_items(grid, count, fill) && cells > MIN_CELLS) {
    set_cells(grid, width_mm, height_mm, 2 * grid->cell_mm);
    cells = (size_t)grid->columns * grid->rows;
  }
  for (size_t i = 0; i < cells; i++)
    grid->start[i + 1] = grid->start[i] + fill[i];
  grid->item = mem_alloc(grid->start[cells], sizeof *grid->item);
  if (grid->item == NULL)
    goto end;
  memcpy(fill, grid->start, cells * sizeof *fill);
  for (uint32_t i = 0; i < count && poll_at(i); i++)
    (void)visit_cells(grid, i, fill);
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
                                struct judge_point2 at, uint32_t *count) {
  uint32_t column = grid_cell_at(at.x, grid->cell_mm, grid->columns);
  uint32_t row = grid_cell_at(at.y, grid->cell_mm, grid->rows);
  size_t cell = (size_t)row * grid->columns + column;
  *count = grid->start[cell + 1] - grid->start[cell];
  return grid->item + grid->start[cell];
}

double judge_distance(const struct judge_segment *segment,
                      struct judge_point2 at, double *t) {
  double dx = segment->b.x - segment->a.x, dy = segment->b.y - segment->a.y;
  double square = dx * dx + dy * dy;
  double px = at.x - segment->a.x, py = at.y - segment->a.y;
  *t = square > 0 ? (px * dx + py * dy) / square : 0;
  *t = fmin(fmax(*t, 0), 1);
  return hypot(px - *t * dx, py - *t * dy);
}

/* The distance to the line through the segment rejects most points, without a
 * division; the rounding error of its square is far below the factor 1.0001. */
bool judge_is_within(const struct judge_segment *segment,
                     struct judge_point2 at, double radius) {
  double dx = segment->b.x - segment->a.x, dy = segment->b.y - segment->a.y;
  double px = at.x - segment->a.x, py = at.y - segment->a.y;
  double area = dx * py - dy * px, t;
  double size = fabs(dx * py) + fabs(dy * px);
  double off = fabs(area) - 0x1p-50 * size;
  if (off > 0 && off * off > 1.0001 * radius * radius * (dx * dx + dy * dy))
    return false;
  return judge_distance(segment, at, &t) <= radius;
}
