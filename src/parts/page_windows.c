/* page_windows.c - divides the page into windows, one for each part. */
#include "parts/page_windows.h"

#include "base/parallel.h"
#include "view/project.h"

enum { RASTER = 512 }; /* cells a side */

/* ---- Places -------------------------------------------------------------- */

struct place_work {
  const struct camera *camera;
  const struct scene *scene;
  struct page_place *place;
};

static bool place_range(void *user, struct parallel_range range) {
  const struct place_work *work = user;
  const struct camera *camera = work->camera;
  const struct projection projection = projection_of(camera);
  for (size_t p = range.begin; p < range.end; p++) {
    struct view_point view = camera_view(camera, &work->scene->point.item[p]);
    /* What is used lies in this range. */
    view.d = clamp(view.d, camera->d_min, camera->d_max);
    struct geom_point at = project_point(&projection, view);
    work->place[p] = (struct page_place){{at.x, at.y}};
  }
  return true;
}

struct page_place *page_places(const struct camera *camera,
                               const struct scene *scene) {
  size_t count = scene->point.count;
  struct place_work work = {camera, scene,
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
  uint32_t *weight;  /* of the cells below and left of a corner of the raster,
                        row by row: a summed-area table */
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

/* The index of the corner where a cell begins. */
static size_t corner_of(int x, int y) {
  return (size_t)y * (RASTER + 1) + (size_t)x;
}

/* The points in a block's cells below a line. */
static uint64_t weight_below(const struct window_work *work,
                             const struct cell_block *block, int axis,
                             int line) {
  int high[2] = {block->high[0], block->high[1]};
  high[axis] = line;
  const uint32_t *sum = work->weight;
  return (uint64_t)sum[corner_of(high[0], high[1])] +
         sum[corner_of(block->low[0], block->low[1])] -
         sum[corner_of(block->low[0], high[1])] -
         sum[corner_of(high[0], block->low[1])];
}

/* Divides a block into two, with about as many points for each window.  Where
 * it is a single cell the second one is empty. */
static void divide_cells(const struct window_work *work,
                         struct cell_block *block, struct cell_block *rest) {
  double size[2];
  for (int k = 0; k < 2; k++)
    size[k] = (double)(block->high[k] - block->low[k]) * (double)work->half[k];
  int axis = size[1] > size[0];
  if (block->high[axis] - block->low[axis] < 2)
    axis = !axis;
  uint32_t own = block->count / 2;
  uint64_t all = weight_below(work, block, axis, block->high[axis]);
  int cut = block->low[axis] + (block->low[axis] < block->high[axis]);
  while (cut + 1 < block->high[axis] &&
         (double)weight_below(work, block, axis, cut) * block->count <
             (double)all * own)
    cut++;
  *rest = *block;
  rest->first += own;
  rest->count -= own;
  rest->low[axis] = cut;
  block->count = own;
  block->high[axis] = cut;
}

static struct part_window window_of_cells(const struct window_work *work,
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
      window[block.first] = window_of_cells(work, &block);
      continue;
    }
    struct cell_block rest;
    divide_cells(work, &block, &rest);
    work->stack[depth++] = rest;
    work->stack[depth++] = block;
  }
}

bool page_windows_make(const struct camera *camera,
                       const struct page_place *place, size_t points,
                       uint32_t count, struct part_window *window) {
  struct window_work *work = mem_calloc(1, sizeof *work);
  if (work == NULL)
    return false;
  const struct projection projection = projection_of(camera);
  for (int k = 0; k < 2; k++) {
    work->half[k] = (int64_t)projection.half[k];
    work->inverse[k] = RASTER / (2 * projection.half[k]);
  }
  size_t corners = corner_of(RASTER, RASTER) + 1;
  uint32_t *sum = mem_calloc(corners, sizeof *sum);
  work->weight = sum;
  for (size_t p = 0; sum != NULL && p < points; p++)
    sum[corner_of(cell_of(work, place[p].at[0], 0) + 1,
                  cell_of(work, place[p].at[1], 1) + 1)]++;
  for (size_t c = RASTER + 2; sum != NULL && c < corners; c++)
    sum[c] += c % (RASTER + 1) != 0
                  ? sum[c - 1] + sum[c - RASTER - 1] - sum[c - RASTER - 2]
                  : 0;
  if (sum != NULL)
    divide_all(work, count, window);
  mem_free(work->weight);
  mem_free(work);
  return sum != NULL;
}

bool page_window_owns(const struct part_window *window, const int32_t at[2]) {
  for (int k = 0; k < 2; k++)
    if (at[k] < window->low[k] || at[k] >= window->high[k])
      return false;
  return true;
}

/* ---- Boxes --------------------------------------------------------------- */

struct part_window page_box(const struct page_place *place,
                            const uint32_t *corner, uint32_t count) {
  struct part_window box;
  for (int k = 0; k < 2; k++) {
    box.low[k] = box.high[k] = place[corner[0]].at[k];
    for (uint32_t c = 1; c < count; c++) {
      int32_t at = place[corner[c]].at[k];
      box.low[k] = at < box.low[k] ? at : box.low[k];
      box.high[k] = at > box.high[k] ? at : box.high[k];
    }
  }
  return box;
}

static int32_t limit_to_sheet(int64_t at) {
  return at < -SHEET_XY_MAX  ? -SHEET_XY_MAX
         : at > SHEET_XY_MAX ? SHEET_XY_MAX
                             : (int32_t)at;
}

static bool window_is_empty(const struct part_window *box) {
  return box->low[0] > box->high[0];
}

struct part_window page_window_widen(const struct part_window *box,
                                     int64_t by) {
  struct part_window wide = *box;
  for (int k = 0; k < 2 && !window_is_empty(box); k++) {
    wide.low[k] = limit_to_sheet(box->low[k] - by);
    wide.high[k] = limit_to_sheet(box->high[k] + by);
  }
  return wide;
}

void page_window_include(struct part_window *box,
                         const struct part_window *other) {
  for (int k = 0; k < 2; k++) {
    box->low[k] = other->low[k] < box->low[k] ? other->low[k] : box->low[k];
    box->high[k] =
        other->high[k] > box->high[k] ? other->high[k] : box->high[k];
  }
}
