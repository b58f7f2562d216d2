/* occlusion_buffer.c - for each page cell a depth behind which all is
 * hidden. */
#include "visibility/culling/occlusion_buffer.h"

#include <string.h>

#include "base/parallel.h"

enum {
  CELLS_PER_TRIANGLE = 8,
  CELLS_MIN = 1 << 12,
  CELLS_MAX = 1 << 22,
  CELLS_IN_RANGE = PARALLEL_RANGE(1 << 18),
  VISITS = 64,         /* to a block to raise its cells, on average, at most */
  VISITS_MIN = 1 << 15 /* to all blocks, this many are no cost */
};

void occlusion_buffer_shape(struct occlusion_buffer *buffer, struct box2 page,
                            size_t triangles) {
  struct triangle_grid *cells = &buffer->cells;
  size_t capacity = CELLS_PER_TRIANGLE * triangles;
  capacity = capacity < CELLS_MIN   ? CELLS_MIN
             : capacity > CELLS_MAX ? CELLS_MAX
                                    : capacity;
  *cells = (struct triangle_grid){.x0 = page.x0, .y0 = page.y0, .shift = -1};
  do {
    cells->shift++;
    cells->columns = (int)(((int64_t)page.x1 - page.x0) >> cells->shift) + 1;
    cells->rows = (int)(((int64_t)page.y1 - page.y0) >> cells->shift) + 1;
  } while (cells->columns > UINT16_MAX || cells->rows > UINT16_MAX ||
           triangle_grid_cell_count(cells) > capacity);
}

/* Sets the bounds of a range of cells, which the system clears for it first. */
static bool begin_bounds(void *user, struct parallel_range range) {
  int32_t *bound = user;
  memset(bound + range.begin, 0xff, (range.end - range.begin) * sizeof *bound);
  return true;
}

bool occlusion_buffer_init(struct occlusion_buffer *buffer) {
  const struct triangle_grid *cells = &buffer->cells;
  size_t n = triangle_grid_cell_count(cells);
  buffer->blocks = ((cells->columns - 1) >> OCCLUSION_BLOCK_SHIFT) + 1;
  buffer->block_rows = ((cells->rows - 1) >> OCCLUSION_BLOCK_SHIFT) + 1;
  size_t blocks = (size_t)buffer->blocks * (size_t)buffer->block_rows;
  buffer->bound = mem_alloc(n, sizeof *buffer->bound);
  buffer->farthest = mem_alloc(blocks, sizeof *buffer->farthest);
  if (buffer->bound == NULL || buffer->farthest == NULL)
    return false;
  memset(buffer->farthest, 0xff, blocks * sizeof *buffer->farthest);
  return parallel_ranges(parallel_workers(n, CELLS_IN_RANGE), n, CELLS_IN_RANGE,
                         begin_bounds, buffer->bound);
}

struct occlusion_band
occlusion_buffer_band(const struct occlusion_buffer *buffer, int k) {
  int first = (int)((int64_t)buffer->block_rows * k / OCCLUSION_BANDS),
      end = (int)((int64_t)buffer->block_rows * (k + 1) / OCCLUSION_BANDS),
      last = (end << OCCLUSION_BLOCK_SHIFT) - 1, rows = buffer->cells.rows;
  return (struct occlusion_band){
      first << OCCLUSION_BLOCK_SHIFT, last < rows ? last : rows - 1,
      VISITS_MIN / OCCLUSION_BANDS +
          VISITS * (int64_t)buffer->blocks * (end - first)};
}

bool occlusion_buffer_hides_in_blocks(const struct occlusion_buffer *buffer,
                                      struct cell_range r, int32_t nearest) {
  int x0 = r.x0 >> OCCLUSION_BLOCK_SHIFT, x1 = r.x1 >> OCCLUSION_BLOCK_SHIFT,
      y0 = r.y0 >> OCCLUSION_BLOCK_SHIFT, y1 = r.y1 >> OCCLUSION_BLOCK_SHIFT;
  const int32_t *row = buffer->farthest + (size_t)y0 * (size_t)buffer->blocks,
                *last = buffer->farthest + (size_t)y1 * (size_t)buffer->blocks;
  /* All blocks of a small range are at its corners: one jump for all. */
  bool hidden = (row[x0] > nearest) & (row[x1] > nearest) &
                (last[x0] > nearest) & (last[x1] > nearest);
  if (!hidden || (x1 - x0 <= 1 && y1 - y0 <= 1))
    return hidden;
  for (; row <= last; row += buffer->blocks)
    for (int x = x0; x <= x1; x++)
      if (row[x] <= nearest)
        return false;
  return true;
}

/* ---- Changing bounds ----------------------------------------------------- */

void occlusion_buffer_update_block(struct occlusion_buffer *buffer, int bx,
                                   int by) {
  const struct triangle_grid *cells = &buffer->cells;
  enum { SIDE = 1 << OCCLUSION_BLOCK_SHIFT };
  int x0 = bx * SIDE, y0 = by * SIDE, columns = cells->columns - x0,
      rows = cells->rows - y0;
  const int32_t *bound =
      buffer->bound + (size_t)y0 * (size_t)cells->columns + x0;
  int32_t least = INT32_MAX;
  for (int y = 0; y < SIDE && y < rows; y++, bound += cells->columns)
    if (columns >= SIDE)
      for (int x = 0; x < SIDE; x++) /* so many are unrolled */
        least = bound[x] < least ? bound[x] : least;
    else
      for (int x = 0; x < columns; x++)
        least = bound[x] < least ? bound[x] : least;
  buffer->farthest[(size_t)by * (size_t)buffer->blocks + (size_t)bx] = least;
}

void occlusion_buffer_raise_cell(struct occlusion_buffer *buffer, int x, int y,
                                 int32_t bound) {
  int32_t *own = &buffer->bound[triangle_grid_index(&buffer->cells, x, y)];
  if (bound > *own) {
    *own = bound;
    occlusion_buffer_update_block(buffer, x >> OCCLUSION_BLOCK_SHIFT,
                                  y >> OCCLUSION_BLOCK_SHIFT);
  }
}

void occlusion_buffer_lower(struct occlusion_buffer *buffer,
                            const struct occlusion_band *band,
                            const int32_t *steps) {
  size_t columns = (size_t)buffer->cells.columns,
         end = (size_t)(band->y1 + 1) * columns;
  for (size_t i = (size_t)band->y0 * columns; i < end; i++)
    buffer->bound[i] =
        buffer->bound[i] < steps[i] ? -1 : buffer->bound[i] - steps[i];
  for (int y = band->y0; y <= band->y1; y += 1 << OCCLUSION_BLOCK_SHIFT)
    for (int x = 0; x < buffer->blocks; x++)
      occlusion_buffer_update_block(buffer, x, y >> OCCLUSION_BLOCK_SHIFT);
}

void occlusion_buffer_fini(struct occlusion_buffer *buffer) {
  mem_free(buffer->bound);
  mem_free(buffer->farthest);
  buffer->bound = buffer->farthest = NULL;
}
