/* page_windows.c - divides the page into windows, one for each part. */
#include "parts/page_windows.h"

#include "base/parallel.h"
#include "view/project.h"

enum { RASTER = 1024 }; /* cells a side */

/* ---- Places -------------------------------------------------------------- */

struct place_work {
  const struct camera *camera;
  const struct scene *scene;
  const uint8_t *used;
  struct page_place *place;
};

static bool place_range(void *user, struct parallel_range range) {
  const struct place_work *work = user;
  const struct projection projection = projection_of(work->camera);
  for (size_t p = range.begin; p < range.end; p++) {
    struct geom_point at = {0, 0, 0};
    if (work->used[p])
      at = project_point(
          &projection, camera_view(work->camera, &work->scene->point.item[p]));
    work->place[p] = (struct page_place){{at.x, at.y}};
  }
  return true;
}

struct page_place *page_places(const struct camera *camera,
                               const struct scene *scene, const uint8_t *used) {
  size_t count = scene->point.count;
  struct place_work work = {camera, scene, used,
                            mem_alloc(count, sizeof *work.place)};
  if (work.place != NULL &&
      !parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, place_range, &work)) {
    mem_free(work.place);
    work.place = NULL;
  }
  return work.place;
}

/* ---- Windows ------------------------------------------------------------- */

/* A rectangle of cells that becomes so many windows, from number `first` on. */
struct cell_block {
  int low[2], high[2]; /* from `low` to before `high` */
  uint32_t first, count;
};

struct window_work {
  uint32_t *weight;  /* of each cell, row by row */
  int64_t half[2];   /* the raster is from -half to half */
  double inverse[2]; /* cells of a grid unit */
  struct cell_block stack[PAGE_WINDOWS_MAX + 1];
};

static int cell_of(const struct window_work *work, int32_t at, int axis) {
  double cell = (at + (double)work->half[axis]) * work->inverse[axis];
  return cell <= 0 ? 0 : cell >= RASTER - 1 ? RASTER - 1 : (int)cell;
}

/* The coordinate of the lower border of a cell. */
static int32_t border_of(const struct window_work *work, int cell, int axis) {
  if (cell <= 0)
    return -SHEET_XY_MAX;
  if (cell >= RASTER)
    return SHEET_XY_MAX;
  return (int32_t)(2 * work->half[axis] * cell / RASTER - work->half[axis]);
}

static uint64_t weight_of_line(const struct window_work *work,
                               const struct cell_block *block, int axis,
                               int line) {
  uint64_t sum = 0;
  for (int i = block->low[!axis]; i < block->high[!axis]; i++)
    sum += axis ? work->weight[line * RASTER + i]
                : work->weight[i * RASTER + line];
  return sum;
}

/* Divides a block into two, with about as many points for each window.  Where
 * it is a single cell the second one is empty. */
static void divide_block(const struct window_work *work,
                         struct cell_block *block, struct cell_block *rest) {
  double size[2];
  for (int k = 0; k < 2; k++)
    size[k] = (double)(block->high[k] - block->low[k]) * (double)work->half[k];
  int axis = size[1] > size[0];
  if (block->high[axis] - block->low[axis] < 2)
    axis = !axis;
  uint32_t own = block->count / 2;
  uint64_t all = 0, sum = 0;
  for (int i = block->low[axis]; i < block->high[axis]; i++)
    all += weight_of_line(work, block, axis, i);
  int cut = block->low[axis];
  do
    sum += weight_of_line(work, block, axis, cut++);
  while (cut + 1 < block->high[axis] &&
         (double)sum * block->count < (double)all * own);
  *rest = *block;
  rest->first += own;
  rest->count -= own;
  rest->low[axis] = cut;
  block->count = own;
  block->high[axis] = cut;
}

static struct part_window window_of(const struct window_work *work,
                                    const struct cell_block *block) {
  struct part_window window;
  for (int k = 0; k < 2; k++) {
    bool empty = block->low[k] >= block->high[k];
    window.low[k] = empty ? 1 : border_of(work, block->low[k], k);
    window.high[k] = empty ? 0 : border_of(work, block->high[k], k);
  }
  return window;
}

static void divide_all(struct window_work *work, uint32_t count,
                       struct part_window *window) {
  size_t depth = 0;
  work->stack[depth++] =
      (struct cell_block){{0, 0}, {RASTER, RASTER}, 0, count};
  while (depth > 0) {
    struct cell_block block = work->stack[--depth];
    if (block.count == 1) {
      window[block.first] = window_of(work, &block);
      continue;
    }
    struct cell_block rest;
    divide_block(work, &block, &rest);
    work->stack[depth++] = rest;
    work->stack[depth++] = block;
  }
}

bool page_windows_make(const struct camera *camera,
                       const struct page_place *place, const uint8_t *used,
                       size_t points, uint32_t count,
                       struct part_window *window) {
  struct window_work *work = mem_calloc(1, sizeof *work);
  if (work == NULL)
    return false;
  const struct projection projection = projection_of(camera);
  for (int k = 0; k < 2; k++) {
    work->half[k] = (int64_t)projection.half[k];
    work->inverse[k] = RASTER / (2 * projection.half[k]);
  }
  work->weight = mem_calloc((size_t)RASTER * RASTER, sizeof *work->weight);
  bool ok = work->weight != NULL;
  for (size_t p = 0; ok && p < points; p++)
    if (used[p])
      work->weight[cell_of(work, place[p].at[1], 1) * RASTER +
                   cell_of(work, place[p].at[0], 0)]++;
  if (ok)
    divide_all(work, count, window);
  mem_free(work->weight);
  mem_free(work);
  return ok;
}

bool page_window_owns(const struct part_window *window, const int32_t at[2]) {
  for (int k = 0; k < 2; k++)
    if (at[k] < window->low[k] || at[k] >= window->high[k])
      return false;
  return true;
}
