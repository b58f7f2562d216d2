/* occlusion_culling.c - finds triangles that are certainly hidden, before
 * anything is solved.
 *
 * Phases
 *   1 find the page box and the depth complexity of large triangles; stop where
 *     it is low
 *   2 sort the triangles from near to far, approximately
 *   3 test each, and raise the bounds of the cells that it surrounds
 *   4 for fragments: lower the bounds by the contact tolerances of the
 *     triangles that are left, and test the culled ones again
 */
#include "visibility/culling/occlusion_culling.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/surrounder.h"

enum {
  CELLS_PER_TRIANGLE = 2,
  CELLS_MIN = 1 << 12,
  CELLS_MAX = 1 << 21,
  BLOCK_SHIFT = 3, /* a block has 8 by 8 cells */
  DEPTH_SHIFT = 9, /* bounds are in steps of 2^9 depth units */
  SORT_SHIFT = 19, /* triangles are sorted by 2^12 ranges of steps */
  SORT_RANGES = 1 << (SHEET_Z_BITS - DEPTH_SHIFT - SORT_SHIFT),
  COMPLEXITY_MIN = 2,   /* faces over a point of the page, on average */
  COVERAGE_MIN = 2,     /* times that large triangles cover the page */
  SLOPE = 8,            /* in the scene; few triangles are steeper */
  VISITS = 64,          /* to a block to raise its cells, on average, at most */
  VISITS_MIN = 1 << 15, /* to all blocks, this many are no cost */
  SAMPLE = 1 << 12      /* triangles that estimate the complexity */
};

/* A triangle to be tested: its cells, and its nearest depth with the margin, in
 * steps. */
struct candidate {
  uint32_t triangle;
  int32_t nearest;
  uint16_t x0, y0, x1, y1;
};

struct culling_work {
  const struct sheet *sheet;
  struct occlusion_culling *culling;
  bool fragments;
  struct occlusion_bound contact;
  struct candidate *candidate; /* one per triangle, from near to far */
  int64_t raises; /* blocks that may still be raised: what is near comes first,
                     and more than VISITS would not pay */
};

/* ---- Phase 1 ------------------------------------------------------------- */

/* Estimates the depth complexity of the sheet, from a sample.  A triangle
 * counts with its area. */
static double depth_complexity(const struct sheet *sheet, struct box2 page) {
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1;
  double sum = 0;
  for (size_t t = 0; t < n; t += stride) {
    struct geom_triangle c = sheet_corners(sheet, t);
    sum += (double)geom_orient2d(c.p[0], c.p[1], c.p[2]) * (double)stride;
  }
  return sum / 2 /
         (((double)page.x1 - page.x0 + 1) * ((double)page.y1 - page.y0 + 1));
}

static struct box2 page_box(const struct sheet *sheet) {
  struct box2 all = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  for (size_t i = 0; i < sheet->point.count; i++) {
    struct geom_point p = sheet->point.item[i];
    all.x0 = box2_min(all.x0, p.x);
    all.y0 = box2_min(all.y0, p.y);
    all.x1 = box2_max(all.x1, p.x);
    all.y1 = box2_max(all.y1, p.y);
  }
  return all;
}

/* The cells: the smallest squares that are not too many. */
static void shape_cells(struct triangle_grid *cells, struct box2 page,
                        size_t triangles) {
  size_t room = CELLS_PER_TRIANGLE * triangles;
  room = room < CELLS_MIN ? CELLS_MIN : room > CELLS_MAX ? CELLS_MAX : room;
  *cells = (struct triangle_grid){.x0 = page.x0, .y0 = page.y0, .shift = -1};
  do {
    cells->shift++;
    cells->columns = (int)(((int64_t)page.x1 - page.x0) >> cells->shift) + 1;
    cells->rows = (int)(((int64_t)page.y1 - page.y0) >> cells->shift) + 1;
  } while (cells->columns > UINT16_MAX || cells->rows > UINT16_MAX ||
           triangle_grid_cell_count(cells) > room);
}

/* An upper bound of a triangle's contact tolerance as a depth; INFINITY where
 * it is flat. */
static double thickness_of(const struct occlusion_bound *contact,
                           const struct geom_triangle *corners) {
  const struct geom_point *p = corners->p;
  double ux = (double)p[1].x - p[0].x, uy = (double)p[1].y - p[0].y,
         uz = (double)(p[1].z - p[0].z), vx = (double)p[2].x - p[0].x,
         vy = (double)p[2].y - p[0].y, vz = (double)(p[2].z - p[0].z);
  double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  return nz > 0 ? (1 + contact->slope * (fabs(nx) + fabs(ny))) / nz +
                      contact->level
                : INFINITY;
}

/* A depth in steps, rounded towards the viewer. */
static int32_t steps_up(double depth) {
  double steps = ceil(depth * (1.0 / (1 << DEPTH_SHIFT)));
  return steps < (double)INT32_MAX ? (int32_t)steps : INT32_MAX;
}

/* A depth in steps, rounded away from the viewer; nothing is behind -1. */
static int32_t steps_down(double depth) {
  double steps = floor(depth * (1.0 / (1 << DEPTH_SHIFT)));
  return steps > 0 ? (int32_t)steps : -1;
}

/* Makes the candidates, in the order of the triangles.  Returns the number of
 * cells in the boxes of all triangles that may surround one, which is their
 * area with some excess. */
static double make_candidates(const struct culling_work *work,
                              struct candidate *candidate) {
  const struct sheet *sheet = work->sheet;
  const struct triangle_grid *cells = &work->culling->cells;
  const int32_t reach = (int32_t)work->culling->reach;
  double covered = 0;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    (void)poll_at(t);
    struct geom_triangle corners = sheet_corners(sheet, t);
    struct box2 box = box2_of_triangle(sheet, (uint32_t)t);
    struct cell_range r = triangle_grid_cells(
        cells, (struct box2){box.x0 - reach, box.y0 - reach, box.x1 + reach,
                             box.y1 + reach});
    double margin = work->culling->margin;
    if (work->fragments && !(sheet->triangle_flags[t] & SHEET_FLAT))
      margin += thickness_of(&work->contact, &corners);
    candidate[t] = (struct candidate){
        (uint32_t)t,
        steps_up((double)triangle_nearest_z(sheet, (uint32_t)t) + margin),
        (uint16_t)r.x0,
        (uint16_t)r.y0,
        (uint16_t)r.x1,
        (uint16_t)r.y1};
    if (r.x1 - r.x0 > 1 && r.y1 - r.y0 > 1)
      covered += (double)(r.x1 - r.x0 - 1) * (r.y1 - r.y0 - 1);
  }
  return covered;
}

/* ---- Phase 2 ------------------------------------------------------------- */

static int sort_range(const struct candidate *candidate) {
  return SORT_RANGES - 1 - (candidate->nearest >> SORT_SHIFT);
}

/* A counting sort from near to far, by ranges of depth. */
static void sort_candidates(const struct candidate *from, size_t n,
                            struct candidate *to) {
  uint32_t start[SORT_RANGES] = {0}, sum = 0;
  for (size_t i = 0; i < n; i++)
    start[sort_range(&from[i])]++;
  for (int k = 0; k < SORT_RANGES; k++) {
    uint32_t count = start[k];
    start[k] = sum;
    sum += count;
  }
  for (size_t i = 0; i < n; i++)
    to[start[sort_range(&from[i])]++] = from[i];
}

/* ---- Phase 3 ------------------------------------------------------------- */

/* Is everything behind `nearest` hidden in all cells of a range of a row? */
static bool hides_in_row(const struct occlusion_culling *culling, int y, int x0,
                         int x1, int32_t nearest) {
  const int32_t *bound =
      culling->bound + (size_t)y * (size_t)culling->cells.columns;
  for (int x = x0; x <= x1; x++)
    if (bound[x] <= nearest)
      return false;
  return true;
}

/* The same in all blocks that meet a range of cells. */
static bool hides_in_blocks(const struct occlusion_culling *culling,
                            struct cell_range r, int32_t nearest) {
  for (int y = r.y0 >> BLOCK_SHIFT; y <= r.y1 >> BLOCK_SHIFT; y++) {
    const int32_t *farthest =
        culling->farthest + (size_t)y * (size_t)culling->blocks;
    for (int x = r.x0 >> BLOCK_SHIFT; x <= r.x1 >> BLOCK_SHIFT; x++)
      if (farthest[x] <= nearest)
        return false;
  }
  return true;
}

/* The columns of a row that the triangle meets, or comes close to. */
static bool columns_in_row(const struct occlusion_culling *culling,
                           const struct geom_triangle *corners, int y, int *x0,
                           int *x1) {
  const struct triangle_grid *cells = &culling->cells;
  int64_t side = INT64_C(1) << cells->shift;
  double low = (double)(cells->y0 + y * side - culling->reach),
         high = (double)(cells->y0 + (y + 1) * side + culling->reach),
         least = INFINITY, most = -INFINITY;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = corners->p[k], q = corners->p[geom_next_corner(k)];
    double from = p.y, to = q.y, x = p.x,
           run = ((double)q.x - p.x) / (to - from);
    if (from >= low && from <= high) {
      least = fmin(least, x);
      most = fmax(most, x);
    }
    const double level[2] = {low, high};
    for (int l = 0; l < 2; l++)
      if ((from < level[l]) != (to < level[l])) {
        double at = x + run * (level[l] - from);
        least = fmin(least, at);
        most = fmax(most, at);
      }
  }
  if (!(least <= most))
    return false;
  *x0 = triangle_grid_cell(
      (int32_t)fmax(floor(least) - (double)culling->reach, INT32_MIN),
      cells->x0, cells->shift, cells->columns);
  *x1 = triangle_grid_cell(
      (int32_t)fmin(ceil(most) + (double)culling->reach, INT32_MAX), cells->x0,
      cells->shift, cells->columns);
  return true;
}

static struct cell_range cells_of(const struct candidate *candidate) {
  return (struct cell_range){candidate->x0, candidate->y0, candidate->x1,
                             candidate->y1};
}

/* Is the triangle hidden in all cells that it meets? */
static bool is_hidden(const struct culling_work *work,
                      const struct candidate *candidate) {
  const struct occlusion_culling *culling = work->culling;
  if (hides_in_blocks(culling, cells_of(candidate), candidate->nearest))
    return true;
  struct geom_triangle corners =
      sheet_corners(work->sheet, candidate->triangle);
  for (int y = candidate->y0, x0, x1; y <= candidate->y1; y++)
    if (columns_in_row(culling, &corners, y, &x0, &x1) &&
        !hides_in_row(culling, y, x0, x1, candidate->nearest))
      return false;
  return true;
}

/* The edge functions of a triangle's sides, which are positive inside it: their
 * least values over a cell, and their increments per cell to the right and up.
 * Within the triangle's box they are below 2^62; one step outside they may wrap
 * around, but are not read there. */
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
                                 dy * (x + (dy > 0 ? side : 0) - a.x));
    functions.right[k] = (uint64_t)-dy << shift;
    functions.up[k] = (uint64_t)dx << shift;
  }
  return functions;
}

static void step(uint64_t at[3], const uint64_t by[3]) {
  for (int k = 0; k < 3; k++)
    at[k] += by[k];
}

/* Which of the three values are not positive, as bits. */
static int outside(const uint64_t at[3]) {
  return (int)((at[0] - 1) >> 63 | (at[1] - 1) >> 63 << 1 |
               (at[2] - 1) >> 63 << 2);
}

/* Computes a block's bound from those of its cells. */
static void update_block(struct occlusion_culling *culling, int bx, int by) {
  const struct triangle_grid *cells = &culling->cells;
  int x0 = bx << BLOCK_SHIFT, y0 = by << BLOCK_SHIFT,
      x1 = x0 + (1 << BLOCK_SHIFT), y1 = y0 + (1 << BLOCK_SHIFT);
  int32_t least = INT32_MAX;
  for (int y = y0; y < y1 && y < cells->rows; y++) {
    const int32_t *bound = culling->bound + (size_t)y * (size_t)cells->columns;
    for (int x = x0; x < x1 && x < cells->columns; x++)
      least = bound[x] < least ? bound[x] : least;
  }
  culling->farthest[(size_t)by * (size_t)culling->blocks + (size_t)bx] = least;
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
  bool found;
  struct geom_triangle corners;
  struct surrounder_plane plane;
  int side; /* the corner where the common side starts */
};

/* Finds the triangle beyond side k, across an edge or a diagonal: one that has
 * the same side the other way round, so that it lies beyond it on the page. */
static struct neighbour find_neighbour(const struct sheet *sheet, uint32_t t,
                                       int k) {
  const struct sheet_triangle *triangle = &sheet->triangle.item[t];
  uint32_t p = triangle->point[k], q = triangle->point[geom_next_corner(k)],
           edge = triangle->side[k];
  uint32_t candidate[2] = {t - 1, t + 1}; /* a face's triangles follow */
  if (edge != SHEET_NONE)
    memcpy(candidate, sheet->edge.item[edge].triangle, sizeof candidate);
  for (int i = 0; i < 2; i++) {
    uint32_t n = candidate[i];
    if (n >= sheet->triangle.count || n == t ||
        (sheet->triangle_flags[n] & SHEET_FLAT))
      continue;
    int side = side_between(sheet, n, p, q);
    if (side >= 0)
      return (struct neighbour){true, sheet_corners(sheet, n),
                                surrounder_plane_of(sheet, n), side};
  }
  return (struct neighbour){.found = false};
}

/* Does the triangle surround the window but for its own side? */
static bool surrounds_beyond(const struct neighbour *neighbour,
                             const struct box2 *window, int shift) {
  struct edge_functions functions =
      edge_functions_at(&neighbour->corners, window->x0, window->y0, shift);
  return (outside(functions.at) & ~(1 << neighbour->side)) == 0;
}

/* The triangle that raises bounds, and those beyond its sides. */
struct raising {
  const struct culling_work *work;
  uint32_t triangle;
  struct geom_triangle corners;
  struct box2 box;
  struct surrounder_plane plane;
  struct neighbour neighbour[3];
  int searched; /* bit k: the neighbour beyond side k was looked for */
};

/* The bound of a cell that the triangle surrounds, or that it surrounds
 * together with its neighbour beyond one side; -1: neither.
 * out  the sides that are not beyond the cell, as bits */
static int32_t bound_of_cell(struct raising *raising, int out,
                             const struct box2 *window) {
  const struct occlusion_culling *culling = raising->work->culling;
  double low = surrounder_farthest_z(&raising->plane, window);
  if (out != 0) {
    int k = out >> 1; /* out is 1, 2 or 4 */
    struct neighbour *neighbour = &raising->neighbour[k];
    if ((raising->searched >> k & 1) == 0)
      *neighbour = find_neighbour(raising->work->sheet, raising->triangle, k);
    raising->searched |= 1 << k;
    if (!neighbour->found ||
        !surrounds_beyond(neighbour, window, culling->cells.shift))
      return -1;
    low = fmin(low, surrounder_farthest_z(&neighbour->plane, window));
  }
  return steps_down(low);
}

/* The part of the triangle's box that is in a range of cells. */
static struct box2 part_in_cells(const struct raising *raising,
                                 struct cell_range r) {
  const struct triangle_grid *cells = &raising->work->culling->cells;
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
  return steps_up(depth_plane_at(plane, plane->per_x > 0 ? part.x1 : part.x0,
                                 plane->per_y > 0 ? part.y1 : part.y0));
}

/* Is a part of the triangle's box outside of one of its sides? */
static bool is_outside(const struct geom_triangle *corners, struct box2 part) {
  for (int k = 0; k < 3; k++) {
    struct geom_point a = corners->p[k], b = corners->p[geom_next_corner(k)];
    struct geom_point innermost = {b.y > a.y ? part.x0 : part.x1,
                                   b.x > a.x ? part.y1 : part.y0, 0};
    if (geom_orient2d(a, b, innermost) <= 0)
      return true;
  }
  return false;
}

/* Raises the bounds of the cells of a block. */
static void raise_block(struct raising *raising, struct cell_range r, int bx,
                        int by) {
  struct occlusion_culling *culling = raising->work->culling;
  const struct triangle_grid *cells = &culling->cells;
  int64_t side = INT64_C(1) << cells->shift, x = cells->x0 + r.x0 * side,
          y = cells->y0 + r.y0 * side;
  struct edge_functions row =
      edge_functions_at(&raising->corners, x, y, cells->shift);
  bool raised = false;
  for (int cy = r.y0; cy <= r.y1; cy++, y += side, step(row.at, row.up)) {
    int32_t *bound = culling->bound + (size_t)cy * (size_t)cells->columns;
    uint64_t at[3] = {row.at[0], row.at[1], row.at[2]};
    for (int cx = r.x0; cx <= r.x1; cx++, step(at, row.right)) {
      int out = outside(at);
      if ((out & (out - 1)) != 0)
        continue;
      struct box2 window = {(int32_t)(cells->x0 + cx * side), (int32_t)y,
                            (int32_t)(cells->x0 + (cx + 1) * side),
                            (int32_t)(y + side)};
      int32_t low = bound_of_cell(raising, out, &window);
      raised |= low > bound[cx];
      bound[cx] = low > bound[cx] ? low : bound[cx];
    }
  }
  if (raised)
    update_block(culling, bx, by);
}

/* Raises the bounds of the cells that the triangle surrounds, alone or with one
 * neighbour: block by block, as most of them lie outside of a large triangle or
 * have nearer bounds. */
static void raise_bounds(struct culling_work *work,
                         const struct candidate *candidate) {
  struct occlusion_culling *culling = work->culling;
  const struct triangle_grid *cells = &culling->cells;
  const struct sheet *sheet = work->sheet;
  uint32_t t = candidate->triangle;
  struct box2 box = box2_of_triangle(sheet, t);
  struct cell_range r = triangle_grid_cells(cells, box);
  r = (struct cell_range){r.x0 + 1, r.y0 + 1, r.x1 - 1, r.y1 - 1};
  if (r.x0 > r.x1 || r.y0 > r.y1 || (sheet->triangle_flags[t] & SHEET_FLAT))
    return;
  struct raising raising = {.work = work,
                            .triangle = t,
                            .corners = sheet_corners(sheet, t),
                            .box = box,
                            .plane = surrounder_plane_of(sheet, t)};
  enum { LAST = (1 << BLOCK_SHIFT) - 1 };
  for (int by = r.y0 >> BLOCK_SHIFT; by <= r.y1 >> BLOCK_SHIFT; by++)
    for (int bx = r.x0 >> BLOCK_SHIFT; bx <= r.x1 >> BLOCK_SHIFT; bx++) {
      int x = bx << BLOCK_SHIFT, y = by << BLOCK_SHIFT;
      struct cell_range part = {x > r.x0 ? x : r.x0, y > r.y0 ? y : r.y0,
                                x + LAST < r.x1 ? x + LAST : r.x1,
                                y + LAST < r.y1 ? y + LAST : r.y1};
      struct box2 box_part = part_in_cells(&raising, part);
      if (culling->farthest[(size_t)by * (size_t)culling->blocks + (size_t)bx] <
              nearest_over(&raising, box_part) &&
          !is_outside(&raising.corners, box_part)) {
        raise_block(&raising, part, bx, by);
        work->raises--;
      }
    }
}

/* Returns false when the caller cancelled. */
static bool cull(struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  for (size_t i = 0; i < work->sheet->triangle.count; i++) {
    if (!poll_at(i))
      return false;
    const struct candidate *candidate = &work->candidate[i];
    bool hidden = is_hidden(work, candidate);
    culling->culled[candidate->triangle] = hidden;
    culling->count += hidden;
    if (!hidden && work->raises > 0)
      raise_bounds(work, candidate);
  }
  return true;
}

/* ---- Phase 4 ------------------------------------------------------------- */

/* Raises the contact tolerances, in steps, of the cells that a triangle meets to
 * its own; they start as that of a slope of SLOPE, which few triangles
 * exceed. */
static void add_thickness(const struct culling_work *work,
                          const struct candidate *candidate, int32_t least,
                          int32_t *thickness) {
  const struct triangle_grid *cells = &work->culling->cells;
  struct geom_triangle corners =
      sheet_corners(work->sheet, candidate->triangle);
  int32_t steps = steps_up(thickness_of(&work->contact, &corners));
  if (steps <= least ||
      (work->sheet->triangle_flags[candidate->triangle] & SHEET_FLAT))
    return;
  for (int y = candidate->y0, x0, x1; y <= candidate->y1; y++)
    if (columns_in_row(work->culling, &corners, y, &x0, &x1))
      for (int x = x0; x <= x1; x++) {
        int32_t *at =
            &thickness[(size_t)y * (size_t)cells->columns + (size_t)x];
        *at = steps > *at ? steps : *at;
      }
}

/* Lowers the bounds by the contact tolerances of the triangles that are not
 * culled.  Returns false when memory ran out. */
static bool lower_bounds(const struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  size_t n = triangle_grid_cell_count(&culling->cells);
  const struct camera *camera = &work->sheet->camera;
  double slope = SLOPE * work->sheet->z_scale / work->sheet->units_per_view /
                 (camera->perspective ? camera->d_max : 1);
  int32_t least =
      steps_up(1 + work->contact.slope * slope + work->contact.level);
  int32_t *thickness = mem_alloc(n, sizeof *thickness);
  if (thickness == NULL)
    return false;
  for (size_t i = 0; i < n; i++)
    thickness[i] = least;
  for (size_t i = 0; i < work->sheet->triangle.count; i++)
    if (!culling->culled[work->candidate[i].triangle])
      add_thickness(work, &work->candidate[i], least, thickness);
  for (size_t i = 0; i < n; i++)
    culling->bound[i] = culling->bound[i] < thickness[i]
                            ? -1
                            : culling->bound[i] - thickness[i];
  mem_free(thickness);
  for (int y = 0; y < culling->block_rows; y++)
    for (int x = 0; x < culling->blocks; x++)
      update_block(culling, x, y);
  return true;
}

/* Tests the culled triangles again.  Returns false when the caller
 * cancelled. */
static bool test_again(const struct culling_work *work) {
  struct occlusion_culling *culling = work->culling;
  for (size_t i = 0; i < work->sheet->triangle.count; i++) {
    const struct candidate *candidate = &work->candidate[i];
    uint8_t *culled = &culling->culled[candidate->triangle];
    if (*culled && !is_hidden(work, candidate)) {
      *culled = 0;
      culling->count--;
    }
    if (!poll_at(i))
      return false;
  }
  return true;
}

/* ---- Culling ------------------------------------------------------------- */

/* Makes the sorted candidates; none where large triangles cover too little.
 * Returns false when memory ran out. */
static bool list_candidates(struct culling_work *work) {
  size_t n = work->sheet->triangle.count;
  struct candidate *unsorted = mem_alloc(n, sizeof *unsorted);
  bool ok = unsorted != NULL;
  if (ok && make_candidates(work, unsorted) >=
                COVERAGE_MIN *
                    (double)triangle_grid_cell_count(&work->culling->cells)) {
    work->candidate = mem_alloc(n, sizeof *work->candidate);
    ok = work->candidate != NULL;
    if (ok)
      sort_candidates(unsorted, n, work->candidate);
  }
  mem_free(unsorted);
  return ok;
}

/* Allocates the buffer, with bounds that hide nothing. */
static bool init_buffer(struct occlusion_culling *culling, size_t triangles) {
  const struct triangle_grid *cells = &culling->cells;
  size_t n = triangle_grid_cell_count(cells);
  culling->blocks = ((cells->columns - 1) >> BLOCK_SHIFT) + 1;
  culling->block_rows = ((cells->rows - 1) >> BLOCK_SHIFT) + 1;
  size_t blocks = (size_t)culling->blocks * (size_t)culling->block_rows;
  culling->bound = mem_alloc(n, sizeof *culling->bound);
  culling->farthest = mem_alloc(blocks, sizeof *culling->farthest);
  culling->culled = mem_calloc(triangles, 1);
  if (culling->bound == NULL || culling->farthest == NULL ||
      culling->culled == NULL)
    return false;
  memset(culling->bound, 0xff, n * sizeof *culling->bound);
  memset(culling->farthest, 0xff, blocks * sizeof *culling->farthest);
  return true;
}

/* By how much what lies on a triangle, within the contact length and rounding,
 * may be off the triangle: on the page, and in depth. */
static void measure_reach(struct occlusion_culling *culling,
                          const struct sheet *sheet,
                          const struct occlusion_bound *contact) {
  const struct camera *camera = &sheet->camera;
  double length = camera->contact_most * sheet->units_per_view /
                  (camera->perspective ? camera->d_min : 1);
  double reach = ceil(length + occlusion_grid_units(sheet)) + 2;
  culling->reach = reach < SHEET_XY_MAX ? (int64_t)reach : SHEET_XY_MAX;
  culling->margin = 2 * contact->level + 4;
}

bool occlusion_culling_init(struct occlusion_culling *culling,
                            const struct sheet *sheet, bool fragments) {
  struct culling_work work = {.sheet = sheet,
                              .culling = culling,
                              .fragments = fragments,
                              .contact = occlusion_tolerance_bound_all(sheet)};
  struct box2 page = page_box(sheet);
  *culling = (struct occlusion_culling){.culled = NULL};
  if (sheet->triangle.count == 0 ||
      depth_complexity(sheet, page) < COMPLEXITY_MIN)
    return true;
  shape_cells(&culling->cells, page, sheet->triangle.count);
  measure_reach(culling, sheet, &work.contact);
  bool ok = list_candidates(&work);
  if (ok && work.candidate != NULL) {
    ok = init_buffer(culling, sheet->triangle.count);
    work.raises =
        VISITS_MIN + VISITS * (int64_t)culling->blocks * culling->block_rows;
    ok = ok && cull(&work);
    if (fragments && culling->count > 0)
      ok = ok && lower_bounds(&work) && test_again(&work);
  }
  mem_free(work.candidate);
  return ok;
}

void occlusion_culling_fini(struct occlusion_culling *culling) {
  mem_free(culling->culled);
  mem_free(culling->bound);
  mem_free(culling->farthest);
  *culling = (struct occlusion_culling){.culled = NULL};
}

bool occlusion_culling_hides(const struct occlusion_culling *culling,
                             struct geom_point p, struct geom_point q) {
  const struct triangle_grid *cells = &culling->cells;
  if (culling->culled == NULL)
    return false;
  int32_t nearest = steps_up((double)(p.z > q.z ? p.z : q.z) + culling->margin);
  struct cell_range r = triangle_grid_cells(cells, box2_of_segment(p, q));
  if (hides_in_blocks(culling, r, nearest))
    return true;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(cells, p, q, r, y, &x0, &x1);
    if (!hides_in_row(culling, y, x0, x1, nearest))
      return false;
  }
  return true;
}
