/* occlusion_buffer.h - for each page cell a depth behind which all is hidden.
 *
 * A cell's bound is raised by a triangle that surrounds the cell, or by two
 * that share a side and surround it together, to the farthest depth that they
 * have there, less their contact tolerances.  Whatever lies farther than the
 * bound is hidden everywhere in the cell.  A block of cells has the farthest
 * of their bounds, so that large ranges are tested quickly.
 *
 * Depths are in steps of 2^OCCLUSION_DEPTH_SHIFT depth units, rounded so that
 * nothing is said to be hidden that is not.
 *
 * Source  The hierarchical z-buffer [Greene1993], with bounds that hold all
 *         over a cell in place of depths at pixels.
 */
#ifndef VISIBILITY_CULLING_OCCLUSION_BUFFER_H
#define VISIBILITY_CULLING_OCCLUSION_BUFFER_H

#include "visibility/index/triangle_grid.h"

enum {
  OCCLUSION_DEPTH_SHIFT = 9,
  OCCLUSION_BLOCK_SHIFT = 3, /* a block has 8 by 8 cells */
  OCCLUSION_BANDS = 8        /* of a buffer */
};

struct occlusion_buffer {
  struct triangle_grid cells; /* their shape; there are no lists */
  int32_t *bound;         /* one per cell, in steps; -1: nothing is hidden */
  int32_t *farthest;      /* one per block, of its cells' */
  int blocks, block_rows; /* blocks in a row, and their rows */
};

/* A band of the rows of cells, of whole blocks, so that threads may change the
 * bounds of different bands. */
struct occlusion_band {
  int y0, y1;     /* the first and the last row; y1 < y0: it is empty */
  int64_t visits; /* of blocks that may still be made to raise bounds: what is
                     near comes first, and more would not pay */
};

/* Shapes the cells of a part of the page: the smallest squares of which there
 * are not too many for so many triangles. */
void occlusion_buffer_shape(struct occlusion_buffer *buffer, struct box2 page,
                            size_t triangles);

/* Allocates bounds that hide nothing.  Returns false when memory ran out; end
 * with occlusion_buffer_fini either way. */
USE_RESULT bool occlusion_buffer_init(struct occlusion_buffer *buffer);
void occlusion_buffer_fini(struct occlusion_buffer *buffer);

/* Band `k` from before OCCLUSION_BANDS, with all of its visits. */
struct occlusion_band
occlusion_buffer_band(const struct occlusion_buffer *buffer, int k);

/* Raises the bounds of the cells of a band that the triangle surrounds, alone
 * or with the one beyond a side: block by block, as most of them lie outside of
 * a large triangle or have nearer bounds. */
void occlusion_buffer_raise(struct occlusion_buffer *buffer,
                            struct occlusion_band *band,
                            const struct sheet *sheet, uint32_t triangle);

/* Raises the bound of one cell to `bound`, if it is farther. */
void occlusion_buffer_raise_cell(struct occlusion_buffer *buffer, int x, int y,
                                 int32_t bound);

/* Computes a block's bound from those of its cells. */
void occlusion_buffer_update_block(struct occlusion_buffer *buffer, int bx,
                                   int by);

/* Lowers the bounds of a band.
 * steps  one per cell of the buffer */
void occlusion_buffer_lower(struct occlusion_buffer *buffer,
                            const struct occlusion_band *band,
                            const int32_t *steps);

/* Is everything behind `nearest` hidden in all blocks that meet a range of
 * cells? */
bool occlusion_buffer_hides_in_blocks(const struct occlusion_buffer *buffer,
                                      struct cell_range range, int32_t nearest);

/* A depth in steps, rounded towards the viewer; what is behind all bounds, as a
 * steep plane may be far beside its triangle, is -1.  Without calls of ceil and
 * floor: this is done for each cell. */
static inline int32_t occlusion_steps_up(double depth) {
  double steps = depth * (1.0 / (1 << OCCLUSION_DEPTH_SHIFT));
  if (!(steps <= INT32_MAX - 1))
    return INT32_MAX;
  int32_t whole = steps > -1 ? (int32_t)steps : -1;
  return whole + (whole < steps);
}

/* A depth in steps, rounded away from the viewer; nothing is behind -1. */
static inline int32_t occlusion_steps_down(double depth) {
  double steps = depth * (1.0 / (1 << OCCLUSION_DEPTH_SHIFT));
  return steps >= 1 ? (int32_t)steps : -1;
}

#endif
