/* window_grid.c - windows by the cells of a raster of the page. */
#include "parts/window_grid.h"

#include <string.h>

enum { GRID_SIDE = 64 }; /* cells */

struct grid_range {
  int low[2], high[2]; /* cells, both included */
};

static int grid_cell(const struct window_grid *grid, int32_t at, int axis) {
  double cell = (at - grid->low[axis]) * grid->inverse[axis];
  return cell <= 0 ? 0 : cell >= GRID_SIDE - 1 ? GRID_SIDE - 1 : (int)cell;
}

/* The cells of a box, even of an empty one: what extends over both of its
 * borders meets that, as part_window_meets has it. */
static struct grid_range range_of_box(const struct window_grid *grid,
                                      const struct part_window *box) {
  struct grid_range range;
  for (int k = 0; k < 2; k++) {
    int low = grid_cell(grid, box->low[k], k);
    int high = grid_cell(grid, box->high[k], k);
    range.low[k] = low < high ? low : high;
    range.high[k] = low < high ? high : low;
  }
  return range;
}

/* Lists each window in its cells, or with `listed` NULL only counts them, in
 * the starts of the cells after them. */
static void list_in_cells(struct window_grid *grid, uint16_t *listed) {
  for (uint32_t w = 0; w < grid->count; w++) {
    const struct grid_range range = range_of_box(grid, &grid->window[w]);
    for (int y = range.low[1]; y <= range.high[1]; y++)
      for (int x = range.low[0]; x <= range.high[0]; x++) {
        uint32_t *start = &grid->start[y * GRID_SIDE + x + 1];
        if (listed != NULL)
          listed[*start] = (uint16_t)w;
        ++*start;
      }
  }
}

bool window_grid_init(struct window_grid *grid,
                      const struct part_window *window, uint32_t count,
                      const struct part_window *extent) {
  enum { CELLS = GRID_SIDE * GRID_SIDE };
  *grid = (struct window_grid){.window = window, .count = count};
  for (int k = 0; k < 2; k++) {
    grid->low[k] = extent->low[k];
    grid->inverse[k] =
        GRID_SIDE / ((double)extent->high[k] - extent->low[k] + 1);
  }
  grid->met = mem_alloc(count, sizeof *grid->met);
  grid->seen = mem_calloc(count, sizeof *grid->seen);
  /* One more in front, where list_in_cells leaves the start of the first. */
  grid->start = mem_calloc(CELLS + 2, sizeof *grid->start);
  if (grid->met == NULL || grid->seen == NULL || grid->start == NULL)
    return false;
  list_in_cells(grid, NULL);
  uint32_t sum = 0;
  for (int c = 0; c <= CELLS; c++) {
    uint32_t own = grid->start[c + 1];
    grid->start[c + 1] = sum;
    sum += own;
  }
  grid->listed = mem_alloc(sum, sizeof *grid->listed);
  if (grid->listed != NULL)
    list_in_cells(grid, grid->listed);
  return grid->listed != NULL;
}

/* Notes that a window meets the box, if it does and was not looked at. */
static inline uint32_t meet_window(struct window_grid *grid,
                                   const struct part_window *box, uint32_t w,
                                   uint32_t met) {
  if (grid->seen[w] == grid->call)
    return met;
  grid->seen[w] = grid->call;
  grid->met[met] = (uint16_t)w;
  return met + part_window_meets(&grid->window[w], box->low, box->high);
}

uint32_t window_grid_meet(struct window_grid *grid,
                          const struct part_window *box) {
  const struct grid_range range = range_of_box(grid, box);
  uint32_t met = 0;
  if (++grid->call == 0) {
    memset(grid->seen, 0, grid->count * sizeof *grid->seen);
    grid->call = 1;
  }
  uint32_t cells = (uint32_t)((range.high[0] - range.low[0] + 1) *
                              (range.high[1] - range.low[1] + 1));
  for (uint32_t w = 0; cells >= grid->count && w < grid->count; w++)
    met = meet_window(grid, box, w, met);
  for (int y = range.low[1]; cells < grid->count && y <= range.high[1]; y++)
    for (int x = range.low[0]; x <= range.high[0]; x++) {
      int cell = y * GRID_SIDE + x;
      for (uint32_t i = grid->start[cell]; i < grid->start[cell + 1]; i++)
        met = meet_window(grid, box, grid->listed[i], met);
    }
  return met;
}

void window_grid_fini(struct window_grid *grid) {
  mem_free(grid->met);
  mem_free(grid->start);
  mem_free(grid->listed);
  mem_free(grid->seen);
  *grid = (struct window_grid){.window = NULL};
}
