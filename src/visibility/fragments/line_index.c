/* line_index.c - a spatial index of triangle sides, by page cell and supporting
 * line. */
#include "visibility/fragments/line_index.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "geom/line_key.h"

/* The cells are as small as possible with at most
 *   max(4 n, min(16 n, 2^20))
 * entries, and as many cells, for n sides: memory is linear in the sides, and
 * small inputs get smaller cells. */
enum { ENTRIES_PER_SIDE = 4, ENTRIES_PER_SIDE_MAX = 16, SMALL_SIZE = 1 << 20 };

/* Grid units; exceeds the error of a corner's doubles (line.c). */
#define MARGIN 2.0

/* The triangles whose sides are to be indexed. */
struct gathered_sides {
  const struct sheet *sheet;
  const uint32_t *triangle;
  size_t count;
  uint32_t *line; /* the keys of their lines, three a triangle */
};

/* Finds the ends of side k of triangle t.  Returns whether it is an edge of the
 * sheet and the triangle is not edge-on. */
static bool is_edge(const struct sheet *sheet, uint32_t t, int k,
                    struct geom_point end[2]) {
  const struct sheet_triangle *triangle = &sheet->triangle.item[t];
  end[0] = sheet->point.item[triangle->point[k]];
  end[1] = sheet->point.item[triangle->point[geom_next_corner(k)]];
  return sheet_triangle_sides(sheet, t)[k] != SHEET_NONE &&
         !sheet_is_edge_on(sheet, t);
}

/* Chooses the smallest cells that keep to the limit on the entries. */
static void choose_shape(struct line_index *index,
                         const struct gathered_sides *sides) {
  struct box2 box = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  double length = 0, count = 3 * (double)sides->count;
  double entries_max = fmax(ENTRIES_PER_SIDE * count,
                            fmin(ENTRIES_PER_SIDE_MAX * count, SMALL_SIZE)),
         width, height;
  int shift = 30;
  for (size_t i = 0; i < sides->count; i++)
    for (int k = 0; k < 3; k++) {
      struct geom_point end[2];
      struct box2 b;
      if (!is_edge(sides->sheet, sides->triangle[i], k, end))
        continue;
      b = box2_of_segment(end[0], end[1]);
      length += ((double)b.x1 - b.x0) + ((double)b.y1 - b.y0);
      box = box2_union(box, b);
    }
  if (box.x0 > box.x1)
    box = (struct box2){0, 0, 0, 0};
  width = (double)box.x1 - box.x0;
  height = (double)box.y1 - box.y0;
  while (shift > 0) {
    double side = (double)(INT64_C(1) << (shift - 1));
    if (count + length / side > entries_max ||
        (width / side + 1) * (height / side + 1) > entries_max)
      break;
    shift--;
  }
  index->shape = (struct triangle_grid){
      .shift = shift,
      .x0 = box.x0,
      .y0 = box.y0,
      .columns = (int)(((int64_t)box.x1 - box.x0) >> shift) + 1,
      .rows = (int)(((int64_t)box.y1 - box.y0) >> shift) + 1};
}

/* The sort keys: the cell in the upper 32 bits and the key of the line in the
 * lower; the value is the side. */
typedef ARRAY(struct sort_key) side_keys;

static uint32_t key_of_ends(const struct geom_point end[2]) {
  struct geom_line line;
  uint64_t key = 0;
  geom_line_through(&line, end[0], end[1]);
  (void)geom_line_key(&line, &key);
  return (uint32_t)key;
}

/* Finds the keys of the lines of the sides of a range of triangles. */
static bool find_line_keys(void *user, struct parallel_range range) {
  const struct gathered_sides *sides = user;
  for (size_t i = range.begin; i < range.end; i++)
    for (int k = 0; k < 3; k++) {
      struct geom_point end[2];
      if (is_edge(sides->sheet, sides->triangle[i], k, end))
        sides->line[3 * i + (size_t)k] = key_of_ends(end);
    }
  return true;
}

static bool index_side(const struct line_index *index,
                       const struct geom_point end[2], uint32_t side,
                       uint32_t key, side_keys *keys) {
  const struct triangle_grid *shape = &index->shape;
  struct cell_range r =
      triangle_grid_cells(shape, box2_of_segment(end[0], end[1]));
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(shape, end[0], end[1], r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      uint64_t cell = (uint64_t)y * (uint64_t)shape->columns + (uint64_t)x;
      struct sort_key entry = {cell << 32 | key, side};
      if (!ARRAY_PUSH(keys, entry))
        return false;
    }
  }
  return true;
}

static bool gather_keys(const struct line_index *index,
                        const struct gathered_sides *sides, side_keys *keys) {
  for (size_t i = 0; i < sides->count; i++) {
    if (!poll_at(i))
      return false;
    for (int k = 0; k < 3; k++) {
      uint32_t t = sides->triangle[i];
      struct geom_point end[2];
      if (is_edge(sides->sheet, t, k, end) &&
          !index_side(index, end, 3 * t + (uint32_t)k,
                      sides->line[3 * i + (size_t)k], keys))
        return false;
    }
  }
  return true;
}

/* Builds the lists of the cells from the sorted keys. */
static bool make_lists(struct line_index *index, const side_keys *keys) {
  size_t cells = triangle_grid_cell_count(&index->shape);
  index->start = mem_calloc(cells + 1, sizeof *index->start);
  index->item = mem_alloc(keys->count, sizeof *index->item);
  index->key = mem_alloc(keys->count, sizeof *index->key);
  if (index->start == NULL || index->item == NULL || index->key == NULL)
    return false;
  for (size_t i = 0; i < keys->count; i++) {
    if (!poll_at(i))
      return false;
    index->start[(keys->item[i].key >> 32) + 1]++;
    index->item[i] = keys->item[i].value;
    index->key[i] = (uint32_t)keys->item[i].key;
  }
  for (size_t i = 0; i < cells; i++)
    index->start[i + 1] += index->start[i];
  return true;
}

bool line_index_init(struct line_index *index, const struct sheet *sheet,
                     const uint32_t *triangle, size_t count) {
  struct gathered_sides sides = {sheet, triangle, count,
                                 mem_alloc(3 * count, sizeof *sides.line)};
  side_keys keys = {0};
  memset(index, 0, sizeof *index);
  choose_shape(index, &sides);
  bool ok = sides.line != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, find_line_keys, &sides) &&
            gather_keys(index, &sides, &keys);
  mem_free(sides.line);
  ok = ok && sort_keys_alone(keys.item, keys.count) && make_lists(index, &keys);
  ARRAY_FREE(&keys);
  return ok;
}

void line_index_fini(struct line_index *index) {
  mem_free(index->start);
  mem_free(index->item);
  mem_free(index->key);
  index->start = index->item = index->key = NULL;
}

/* The row or column that contains coordinate v, clamped to the index. */
static int index_cell_at(double v, int32_t v0, int shift, int count) {
  double cell = floor((v - v0) / (double)(INT64_C(1) << shift));
  return cell < 0 ? 0 : cell >= count ? count - 1 : (int)cell;
}

/* The range of columns of row y that the segment from p to q may cross. */
static void find_index_columns(const struct triangle_grid *shape,
                               const struct geom_corner *p,
                               const struct geom_corner *q, int y, int *x0,
                               int *x1) {
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
  *x0 = index_cell_at(fmin(a, b) - MARGIN, shape->x0, shape->shift,
                      shape->columns);
  *x1 = index_cell_at(fmax(a, b) + MARGIN, shape->x0, shape->shift,
                      shape->columns);
}

/* Appends the sides of a cell whose line has that key. */
static bool find_in_cell(const struct line_index *index, size_t cell,
                         uint32_t key, side_list *found) {
  size_t i, end = index->start[cell + 1];
  LOWER_BOUND(i, index->start[cell], end, index->key[i] < key);
  for (; i < end && index->key[i] == key; i++)
    if (!ARRAY_PUSH(found, index->item[i]))
      return false;
  return true;
}

bool line_index_find(const struct line_index *index,
                     const struct geom_line *line, const struct geom_corner *p,
                     const struct geom_corner *q, side_list *found) {
  const struct triangle_grid *shape = &index->shape;
  int y0 = index_cell_at(fmin(p->y, q->y) - MARGIN, shape->y0, shape->shift,
                         shape->rows);
  int y1 = index_cell_at(fmax(p->y, q->y) + MARGIN, shape->y0, shape->shift,
                         shape->rows);
  uint64_t key;
  if (!geom_line_key(line, &key))
    return true;
  for (int y = y0; y <= y1; y++) {
    int x0, x1;
    find_index_columns(shape, p, q, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      if (!find_in_cell(index, triangle_grid_index(shape, x, y), (uint32_t)key,
                        found))
        return false;
  }
  return true;
}
