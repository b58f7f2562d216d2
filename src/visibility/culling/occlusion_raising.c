/* occlusion_raising.c - raises the bounds of the cells that a triangle
 * surrounds, alone or with the one beyond a side. */
#include <math.h>
#include <string.h>

#include "geom/vector.h"
#include "visibility/culling/occlusion_buffer.h"
#include "visibility/predicate/surrounder.h"

enum {
  ALL_SIDES = 7,  /* of a triangle, as bits */
  LARGE_CELLS = 8 /* in either direction, of a large triangle */
};

/* The edge functions of a triangle's sides, which are positive inside it, less
 * 1: their least values over a cell, negative where it is not wholly inside,
 * and their increments per cell to the right and up.  Within the page box they
 * are below 2^62, as are the products of which they are differences; steps may
 * wrap around, but come to what they are where they are read. */
struct edge_functions {
  uint64_t at[3], right[3], up[3];
};

/* The edge functions of the cell whose lower left corner is (x, y). */
static struct edge_functions
edge_functions_at(const struct geom_triangle *corners, int64_t x, int64_t y,
                  int shift) {
  struct edge_functions functions;
  int64_t side = INT64_C(1) << shift;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = corners->p[k], b = corners->p[geom_next_corner(k)];
    int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
    functions.at[k] = (uint64_t)(dx * (y + (dx < 0 ? side : 0) - a.y) -
                                 dy * (x + (dy > 0 ? side : 0) - a.x) - 1);
    functions.right[k] = (uint64_t)-dy << shift;
    functions.up[k] = (uint64_t)dx << shift;
  }
  return functions;
}

/* Those of the cell so many columns and rows on. */
static inline struct edge_functions
move_edge_functions(struct edge_functions functions, int columns, int rows) {
  for (int k = 0; k < 3; k++)
    functions.at[k] += (uint64_t)columns * functions.right[k] +
                       (uint64_t)rows * functions.up[k];
  return functions;
}

static inline void step_edge_functions(uint64_t at[3], const uint64_t by[3]) {
  at[0] += by[0];
  at[1] += by[1];
  at[2] += by[2];
}

static inline bool is_any_negative(const uint64_t at[3]) {
  return (at[0] | at[1] | at[2]) >> 63 != 0;
}

/* Which of the three values are negative, as bits. */
static inline int outside_mask(const uint64_t at[3]) {
  return (int)(at[0] >> 63 | at[1] >> 63 << 1 | at[2] >> 63 << 2);
}

/* The corner of triangle n at which its side q-p starts; -1: it has none. */
static int side_between(const struct sheet *sheet, uint32_t n, uint32_t p,
                        uint32_t q) {
  const uint32_t *point = sheet->triangle.item[n].point;
  for (int k = 0; k < 3; k++)
    if (point[k] == q && point[geom_next_corner(k)] == p)
      return k;
  return -1;
}

/* A triangle that continues another one beyond a side. */
struct neighbour {
  uint32_t triangle; /* SHEET_NONE: there is none */
  int side;          /* the corner where the common side starts */
  bool has_plane;    /* what follows is known, once it is needed */
  struct geom_triangle corners;
  struct surrounder_plane plane;
};

/* Finds the triangle beyond side k, across an edge or a diagonal: one that has
 * the same side the other way round, so that it lies beyond it on the page. */
static void find_neighbour(struct neighbour *neighbour,
                           const struct sheet *sheet, uint32_t t, int k) {
  const struct sheet_triangle *triangle = &sheet->triangle.item[t];
  uint32_t p = triangle->point[k], q = triangle->point[geom_next_corner(k)],
           edge = sheet_triangle_sides(sheet, t)[k];
  uint32_t candidate[2] = {t - 1, t + 1}; /* a face's triangles follow */
  if (edge != SHEET_NONE)
    memcpy(candidate, sheet->edge.item[edge].triangle, sizeof candidate);
  neighbour->triangle = SHEET_NONE;
  neighbour->has_plane = false;
  for (int i = 0; i < 2; i++) {
    uint32_t n = candidate[i];
    if (n >= sheet->triangle.count || n == t || sheet_is_edge_on(sheet, n))
      continue;
    neighbour->side = side_between(sheet, n, p, q);
    if (neighbour->side < 0)
      continue;
    neighbour->triangle = n;
    return;
  }
}

/* Does the triangle surround the window but for its own side? */
static bool surrounds_beyond(const struct neighbour *neighbour,
                             const struct box2 *window, int shift) {
  struct edge_functions functions =
      edge_functions_at(&neighbour->corners, window->x0, window->y0, shift);
  return (outside_mask(functions.at) & ~(1 << neighbour->side)) == 0;
}

/* The triangle that raises bounds, and those beyond its sides. */
struct raising {
  struct occlusion_buffer *buffer;
  const struct sheet *sheet;
  uint32_t triangle;
  struct geom_triangle corners;
  struct box2 box;
  struct cell_range cells;         /* that it may raise */
  struct edge_functions functions; /* of the first of them */
  struct surrounder_plane plane;
  struct neighbour neighbour[3];
  bool searched; /* for neighbours, once a block is raised */
  int open;      /* bit k: there is none beyond side k */
};

static void find_all_neighbours(struct raising *raising) {
  for (int k = 0; k < 3; k++) {
    struct neighbour *neighbour = &raising->neighbour[k];
    find_neighbour(neighbour, raising->sheet, raising->triangle, k);
    raising->open |= (neighbour->triangle == SHEET_NONE) << k;
  }
  raising->searched = true;
}

/* The bound of a cell that the triangle surrounds together with its neighbour
 * beyond one side, which there is; -1: they do not.
 * k  the side that is not beyond the cell */
static int32_t bound_with_neighbour(struct raising *raising, int k,
                                    const struct box2 *window) {
  struct neighbour *neighbour = &raising->neighbour[k];
  if (!neighbour->has_plane) {
    neighbour->corners = sheet_corners(raising->sheet, neighbour->triangle);
    neighbour->plane = surrounder_plane_of(raising->sheet, neighbour->triangle);
    neighbour->has_plane = true;
  }
  if (!surrounds_beyond(neighbour, window, raising->buffer->cells.shift))
    return -1;
  return occlusion_steps_down(
      min_number(surrounder_farthest_z(&neighbour->plane, window),
                 surrounder_farthest_z(&raising->plane, window)));
}

/* The farthest depths of the triangle over the cells of a block, less its
 * contact tolerance: `first` over the first of them, and the changes from one
 * to the next. */
struct block_depths {
  double first, per_column, per_row;
};

/* As of surrounder_farthest_z, with an error that bounds that of all cells: the
 * steps are exact, and with two more products and sums each term takes fewer
 * than 14 roundings.
 * x, y  the lower left corner of the first cell */
static struct block_depths depths_of_block(const struct surrounder_plane *plane,
                                           int64_t x, int64_t y, int64_t side) {
  const struct depth_plane *depth = &plane->depth;
  double at_x = (double)(depth->per_x < 0 ? x + side : x),
         at_y = (double)(depth->per_y < 0 ? y + side : y),
         block = (double)(side << OCCLUSION_BLOCK_SHIFT),
         magnitude = fabs(depth->z) +
                     fabs(depth->per_x) * (fabs(at_x - depth->x) + block) +
                     fabs(depth->per_y) * (fabs(at_y - depth->y) + block);
  return (struct block_depths){
      depth_plane_at(depth, at_x, at_y) - FILTER_ERROR * magnitude - 1 -
          plane->contact,
      depth->per_x * (double)side, depth->per_y * (double)side};
}

/* The part of the triangle's box that is in a range of cells. */
static struct box2 part_in_cells(const struct raising *raising,
                                 struct cell_range r) {
  const struct triangle_grid *cells = &raising->buffer->cells;
  int64_t side = INT64_C(1) << cells->shift, x0 = cells->x0 + r.x0 * side,
          y0 = cells->y0 + r.y0 * side, x1 = cells->x0 + (r.x1 + 1) * side,
          y1 = cells->y0 + (r.y1 + 1) * side;
  struct box2 box = raising->box;
  return (struct box2){
      box.x0 > x0 ? box.x0 : (int32_t)x0, box.y0 > y0 ? box.y0 : (int32_t)y0,
      box.x1 < x1 ? box.x1 : (int32_t)x1, box.y1 < y1 ? box.y1 : (int32_t)y1};
}

/* The nearest depth of the triangle's plane over a part of its box, in steps:
 * no bound that it gives there is nearer. */
static int32_t nearest_over(const struct raising *raising, struct box2 part) {
  const struct depth_plane *plane = &raising->plane.depth;
  return occlusion_steps_up(
      depth_plane_at(plane, plane->per_x > 0 ? part.x1 : part.x0,
                     plane->per_y > 0 ? part.y1 : part.y0));
}

/* Is a part of the triangle's box outside of one of its sides? */
static bool has_part_outside(const struct geom_triangle *corners,
                             struct box2 part) {
  for (int k = 0; k < 3; k++) {
    struct geom_point a = corners->p[k], b = corners->p[geom_next_corner(k)];
    struct geom_point innermost = {b.y > a.y ? part.x0 : part.x1,
                                   b.x > a.x ? part.y1 : part.y0, 0};
    if (geom_orient2d(a, b, innermost) <= 0)
      return true;
  }
  return false;
}

/* Is a cell beyond none of the sides, or one that has no neighbour, for which
 * the bits stand?  Then the triangle does not raise its bound. */
static bool is_outside(const struct raising *raising, int out) {
  return (out & (out - 1)) != 0 || (out & raising->open) != 0;
}

/* What raises the cells of a block. */
struct block_raise {
  struct raising *raising;
  int32_t least;   /* the least bound in the block */
  int32_t nearest; /* no bound becomes nearer than this */
  bool least_raised;
};

static inline void raise_cell(struct block_raise *block, int32_t *bound,
                              int32_t low) {
  block->least_raised |= (low > *bound) & (*bound <= block->least);
  *bound = low > *bound ? low : *bound;
}

/* Raises the bound of a cell that is beyond the sides of the mask `out`. */
static void raise_beyond(struct block_raise *block, int cx, int cy, int out) {
  struct raising *raising = block->raising;
  const struct triangle_grid *cells = &raising->buffer->cells;
  int32_t *bound = raising->buffer->bound + triangle_grid_index(cells, cx, cy);
  if (is_outside(raising, out) || *bound >= block->nearest)
    return;
  int64_t side = INT64_C(1) << cells->shift, x = cells->x0 + cx * side,
          y = cells->y0 + cy * side;
  struct box2 window = {(int32_t)x, (int32_t)y, (int32_t)(x + side),
                        (int32_t)(y + side)};
  raise_cell(block, bound,
             bound_with_neighbour(raising, out >> 1, &window)); /* 1, 2, 4 */
}

/* Raises the bounds of a row of cells, where the triangle surrounds some alone
 * or with others.
 * row    the edge functions of the first
 * depth  the farthest depth over the first */
static void raise_row(struct block_raise *block, struct cell_range r, int cy,
                      const struct edge_functions *row, double depth,
                      double per_column) {
  struct raising *raising = block->raising;
  int32_t *bound = raising->buffer->bound +
                   triangle_grid_index(&raising->buffer->cells, r.x0, cy);
  uint64_t at[3] = {row->at[0], row->at[1], row->at[2]};
  for (int i = 0; i <= r.x1 - r.x0; i++, step_edge_functions(at, row->right)) {
    if (!is_any_negative(at))
      raise_cell(block, &bound[i],
                 occlusion_steps_down(depth + i * per_column));
    else if (raising->open != ALL_SIDES)
      raise_beyond(block, r.x0 + i, cy, outside_mask(at));
  }
}

/* The same of a triangle that nothing continues: the cells that it surrounds
 * follow one another. */
static void raise_row_alone(struct block_raise *block, int32_t *bound,
                            int count, const struct edge_functions *row,
                            double depth, double per_column) {
  uint64_t at[3] = {row->at[0], row->at[1], row->at[2]};
  int i = 0;
  for (; i < count && is_any_negative(at); i++)
    step_edge_functions(at, row->right);
  for (; i < count && !is_any_negative(at); i++) {
    raise_cell(block, &bound[i], occlusion_steps_down(depth + i * per_column));
    step_edge_functions(at, row->right);
  }
}

/* Raises the bounds of the cells of a block. */
static void raise_block(struct raising *raising, struct cell_range r, int bx,
                        int by, int32_t nearest) {
  struct occlusion_buffer *buffer = raising->buffer;
  const struct triangle_grid *cells = &buffer->cells;
  int64_t side = INT64_C(1) << cells->shift, x = cells->x0 + r.x0 * side,
          y = cells->y0 + r.y0 * side;
  if (!raising->searched)
    find_all_neighbours(raising);
  struct block_raise block = {
      raising,
      buffer->farthest[(size_t)by * (size_t)buffer->blocks + (size_t)bx],
      nearest, false};
  struct edge_functions row = move_edge_functions(
      raising->functions, r.x0 - raising->cells.x0, r.y0 - raising->cells.y0);
  struct block_depths depths = depths_of_block(&raising->plane, x, y, side);
  int32_t *bound = buffer->bound + triangle_grid_index(cells, r.x0, r.y0);
  uint64_t last[3]; /* the edge functions of the row's last cell */
  for (int k = 0; k < 3; k++)
    last[k] = row.at[k] + (uint64_t)(r.x1 - r.x0) * row.right[k];
  for (int cy = r.y0; cy <= r.y1; cy++, bound += cells->columns) {
    /* What is beyond a side at both ends of the row is so everywhere. */
    const uint64_t both[3] = {row.at[0] & last[0], row.at[1] & last[1],
                              row.at[2] & last[2]};
    double depth = depths.first + (cy - r.y0) * depths.per_row;
    if (raising->open == ALL_SIDES) {
      if (!is_any_negative(both))
        raise_row_alone(&block, bound, r.x1 - r.x0 + 1, &row, depth,
                        depths.per_column);
    } else if (!is_any_negative(both) ||
               !is_outside(raising, outside_mask(both))) {
      raise_row(&block, r, cy, &row, depth, depths.per_column);
    }
    step_edge_functions(row.at, row.up);
    step_edge_functions(last, row.up);
  }
  if (block.least_raised)
    occlusion_buffer_update_block(buffer, bx, by);
}

/* The cells of a band that a triangle may surround, alone or with others: not
 * the outermost ones of its box, except that of a large triangle a side may run
 * along them, beyond which there is another one. */
static struct cell_range cells_to_raise(const struct occlusion_buffer *buffer,
                                        const struct occlusion_band *band,
                                        struct box2 box) {
  const struct triangle_grid *cells = &buffer->cells;
  struct cell_range r = triangle_grid_cells(cells, box);
  int trim = r.x1 - r.x0 >= LARGE_CELLS && r.y1 - r.y0 >= LARGE_CELLS ? 0 : 1;
  /* The last column and row are not wholly within the page. */
  int x1 = r.x1 - trim < cells->columns - 2 ? r.x1 - trim : cells->columns - 2,
      y1 = r.y1 - trim < cells->rows - 2 ? r.y1 - trim : cells->rows - 2;
  return (struct cell_range){r.x0 + trim,
                             r.y0 + trim < band->y0 ? band->y0 : r.y0 + trim,
                             x1, y1 > band->y1 ? band->y1 : y1};
}

void occlusion_buffer_raise(struct occlusion_buffer *buffer,
                            struct occlusion_band *band,
                            const struct sheet *sheet, uint32_t t) {
  struct box2 box = box2_of_triangle(sheet, t);
  struct cell_range r = cells_to_raise(buffer, band, box);
  if (r.x0 > r.x1 || r.y0 > r.y1 || sheet_is_edge_on(sheet, t))
    return;
  struct raising raising = {.buffer = buffer,
                            .sheet = sheet,
                            .triangle = t,
                            .corners = sheet_corners(sheet, t),
                            .box = box,
                            .cells = r,
                            .plane = surrounder_plane_of(sheet, t)};
  int64_t side = INT64_C(1) << buffer->cells.shift;
  raising.functions =
      edge_functions_at(&raising.corners, buffer->cells.x0 + r.x0 * side,
                        buffer->cells.y0 + r.y0 * side, buffer->cells.shift);
  enum { LAST = (1 << OCCLUSION_BLOCK_SHIFT) - 1 };
  for (int by = r.y0 >> OCCLUSION_BLOCK_SHIFT;
       by <= r.y1 >> OCCLUSION_BLOCK_SHIFT; by++)
    for (int bx = r.x0 >> OCCLUSION_BLOCK_SHIFT;
         bx <= r.x1 >> OCCLUSION_BLOCK_SHIFT; bx++) {
      int x = bx << OCCLUSION_BLOCK_SHIFT, y = by << OCCLUSION_BLOCK_SHIFT;
      struct cell_range part = {x > r.x0 ? x : r.x0, y > r.y0 ? y : r.y0,
                                x + LAST < r.x1 ? x + LAST : r.x1,
                                y + LAST < r.y1 ? y + LAST : r.y1};
      struct box2 box_part = part_in_cells(&raising, part);
      int32_t nearest = nearest_over(&raising, box_part);
      if (buffer->farthest[(size_t)by * (size_t)buffer->blocks + (size_t)bx] <
              nearest &&
          !has_part_outside(&raising.corners, box_part)) {
        raise_block(&raising, part, bx, by, nearest);
        band->visits--;
      }
    }
}
