/* line_index.c - which sides of triangles run where on the page, and on which
 * line. */
#include "visibility/fragments/line_index.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"

enum {
  SPREAD = 4,      /* cells a side is in, on average, at most ... */
  ROOM = 1 << 20,  /* ... but so many places are always there ... */
  SPREAD_MOST = 16 /* ... for as many more of each */
};

/* A corner's doubles are off by less (line.c). */
#define MARGIN 2.0

/* What is to be indexed. */
struct gathered_sides {
  const struct sheet *sheet;
  const uint32_t *triangle;
  size_t count;
};

static bool is_edge(const struct sheet *sheet, uint32_t t, int k,
                    struct geom_point end[2]) {
  const struct sheet_triangle *triangle = &sheet->triangle.item[t];
  end[0] = sheet->point.item[triangle->point[k]];
  end[1] = sheet->point.item[triangle->point[k == 2 ? 0 : k + 1]];
  return triangle->side[k] != SHEET_NONE &&
         !(sheet->triangle_flags[t] & SHEET_FLAT);
}

/* The smallest cells for which there is room. */
static void choose_shape(struct line_index *grid,
                         const struct gathered_sides *sides) {
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  double length = 0, count = 3 * (double)sides->count;
  double most = fmax(SPREAD * count, fmin(SPREAD_MOST * count, ROOM)), width,
         height;
  int shift = 30;
  for (size_t i = 0; i < sides->count; i++)
    for (int k = 0; k < 3; k++) {
      struct geom_point end[2];
      struct box2 b;
      if (!is_edge(sides->sheet, sides->triangle[i], k, end))
        continue;
      b = box2_of_segment(end[0], end[1]);
      length += ((double)b.x1 - b.x0) + ((double)b.y1 - b.y0);
      box.x0 = box2_min(box.x0, b.x0);
      box.y0 = box2_min(box.y0, b.y0);
      box.x1 = box2_max(box.x1, b.x1);
      box.y1 = box2_max(box.y1, b.y1);
    }
  if (box.x0 > box.x1)
    box = (struct box2){0, 0, 0, 0};
  width = (double)box.x1 - box.x0;
  height = (double)box.y1 - box.y0;
  while (shift > 0) {
    double side = (double)(INT64_C(1) << (shift - 1));
    if (count + length / side > most ||
        (width / side + 1) * (height / side + 1) > most)
      break;
    shift--;
  }
  grid->shape = (struct triangle_grid){
      .shift = shift,
      .x0 = box.x0,
      .y0 = box.y0,
      .columns = (int)(((int64_t)box.x1 - box.x0) >> shift) + 1,
      .rows = (int)(((int64_t)box.y1 - box.y0) >> shift) + 1};
}

/* What is sorted: a cell and, below it, a line's number; and the side. */
typedef ARRAY(struct sort_key) side_keys;

static uint32_t number_of(const struct geom_point end[2]) {
  struct geom_line line;
  uint64_t number = 0;
  geom_line_through(&line, end[0], end[1]);
  (void)geom_line_number(&line, &number);
  return (uint32_t)number;
}

static bool add_side(const struct line_index *grid,
                     const struct geom_point end[2], uint32_t side,
                     side_keys *keys) {
  const struct triangle_grid *shape = &grid->shape;
  struct cell_range r =
      triangle_grid_cells(shape, box2_of_segment(end[0], end[1]));
  uint32_t number = number_of(end);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(shape, end[0], end[1], r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      uint64_t cell = (uint64_t)y * (uint64_t)shape->columns + (uint64_t)x;
      struct sort_key key = {cell << 32 | number, side};
      if (!ARRAY_PUSH(keys, key))
        return false;
    }
  }
  return true;
}

static bool gather_keys(const struct line_index *grid,
                        const struct gathered_sides *sides, side_keys *keys) {
  for (size_t i = 0; i < sides->count; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t t = sides->triangle[i];
      struct geom_point end[2];
      if (is_edge(sides->sheet, t, k, end) &&
          !add_side(grid, end, 3 * t + (uint32_t)k, keys))
        return false;
    }
  return true;
}

/* Makes the cells' lists of the sorted keys. */
static bool make_lists(struct line_index *grid, const side_keys *keys) {
  size_t cells = triangle_grid_cell_count(&grid->shape);
  grid->start = mem_calloc(cells + 1, sizeof *grid->start);
  grid->item = mem_alloc(keys->count, sizeof *grid->item);
  grid->number = mem_alloc(keys->count, sizeof *grid->number);
  if (grid->start == NULL || grid->item == NULL || grid->number == NULL)
    return false;
  for (size_t i = 0; i < keys->count; i++) {
    grid->start[(keys->item[i].key >> 32) + 1]++;
    grid->item[i] = keys->item[i].value;
    grid->number[i] = (uint32_t)keys->item[i].key;
  }
  for (size_t i = 0; i < cells; i++)
    grid->start[i + 1] += grid->start[i];
  return true;
}

bool line_index_init(struct line_index *grid, const struct sheet *sheet,
                     const uint32_t *triangle, size_t count) {
  const struct gathered_sides sides = {sheet, triangle, count};
  side_keys keys = {0};
  struct sort_key *scratch = NULL;
  bool ok = false;
  memset(grid, 0, sizeof *grid);
  choose_shape(grid, &sides);
  if (!gather_keys(grid, &sides, &keys))
    goto end;
  scratch = mem_alloc(keys.count, sizeof *scratch);
  if (scratch == NULL)
    goto end;
  sort_keys(keys.item, scratch, keys.count);
  ok = make_lists(grid, &keys);
end:
  mem_free(scratch);
  ARRAY_FREE(&keys);
  return ok;
}

void line_index_fini(struct line_index *grid) {
  mem_free(grid->start);
  mem_free(grid->item);
  mem_free(grid->number);
  grid->start = grid->item = grid->number = NULL;
}

static int cell_of(double v, int32_t v0, int shift, int count) {
  double cell = floor((v - v0) / (double)(INT64_C(1) << shift));
  return cell < 0 ? 0 : cell >= count ? count - 1 : (int)cell;
}

/* Of row y the columns where the segment may be. */
static void find_columns(const struct triangle_grid *shape,
                         const struct geom_corner *p,
                         const struct geom_corner *q, int y, int *x0, int *x1) {
  double low = shape->y0 + ldexp(y, shape->shift) - MARGIN;
  double high = shape->y0 + ldexp(y + 1, shape->shift) + MARGIN;
  double dy = q->y - p->y, from = 0, to = 1, a, b;
  if (fabs(dy) > MARGIN) {
    double s = (low - p->y) / dy, t = (high - p->y) / dy;
    from = fmax(from, fmin(s, t));
    to = fmin(to, fmax(s, t));
  }
  a = p->x + from * (q->x - p->x);
  b = p->x + to * (q->x - p->x);
  *x0 = cell_of(fmin(a, b) - MARGIN, shape->x0, shape->shift, shape->columns);
  *x1 = cell_of(fmax(a, b) + MARGIN, shape->x0, shape->shift, shape->columns);
}

/* Appends those of a cell whose line has that number. */
static bool find_in_cell(const struct line_index *grid, size_t cell,
                         uint32_t number, side_list *found) {
  uint32_t low = grid->start[cell], high = grid->start[cell + 1];
  uint32_t end = high;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (grid->number[middle] < number)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < end && grid->number[low] == number; low++)
    if (!ARRAY_PUSH(found, grid->item[low]))
      return false;
  return true;
}

bool line_index_find(const struct line_index *grid,
                     const struct geom_line *line, const struct geom_corner *p,
                     const struct geom_corner *q, side_list *found) {
  const struct triangle_grid *shape = &grid->shape;
  int y0 =
      cell_of(fmin(p->y, q->y) - MARGIN, shape->y0, shape->shift, shape->rows);
  int y1 =
      cell_of(fmax(p->y, q->y) + MARGIN, shape->y0, shape->shift, shape->rows);
  uint64_t number;
  if (!geom_line_number(line, &number))
    return true;
  for (int y = y0; y <= y1; y++) {
    int x0, x1;
    find_columns(shape, p, q, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      if (!find_in_cell(grid, (size_t)y * (size_t)shape->columns + (size_t)x,
                        (uint32_t)number, found))
        return false;
  }
  return true;
}
