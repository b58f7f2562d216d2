/* window_grid.h - finds which of many windows a box on the page meets. */
#ifndef PARTS_WINDOW_GRID_H
#define PARTS_WINDOW_GRID_H

#include "parts/page_windows.h"

/* Zero-initialised is empty. */
struct window_grid {
  const struct part_window *window;
  uint32_t count;
  uint16_t *met; /* what window_grid_meet found */
  /* private */
  double low[2], inverse[2]; /* cells begin at `low`; of a grid unit */
  uint32_t *start;           /* of each cell: in `listed` */
  uint16_t *listed;          /* the windows of all cells */
  uint32_t *seen;            /* of each window: the last call that looked */
  uint32_t call;
};

/* Lists windows by cells of the page.
 * window  at most PAGE_WINDOWS_MAX; outlives the grid
 * extent  about what lies on the page
 * Returns false when memory ran out; end with window_grid_fini either way. */
USE_RESULT bool window_grid_init(struct window_grid *grid,
                                 const struct part_window *window,
                                 uint32_t count,
                                 const struct part_window *extent);

/* Sets grid->met to the windows that meet a box, each once, in any order;
 * returns how many they are. */
uint32_t window_grid_meet(struct window_grid *grid,
                          const struct part_window *box);

void window_grid_fini(struct window_grid *grid);

#endif
