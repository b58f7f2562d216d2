/* line_index.c - a spatial index of triangle sides, by page cell and supporting
 * line. */
#include "visibility/fragments/line_index.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "geom/line_key.h"

/* The cells are as small as possible with at most
 *   max(4 n, min(16 n, 2^20))
 * entries, and as many cells, for n sides: memory is linear in the sides, and
 * small inputs get smaller cells. */
enum { ENTRIES_PER_SIDE = 4, ENTRIES_PER_SIDE_MAX = 16, SMALL_SIZE = 1 << 20 };

/* Adding up the starts of all parts is left to one thread. */
enum { PARTS_MAX = 8 };

enum { SORTED_BY_INSERTION = 24 }; /* entries of a cell, at most */

/* Grid units; exceeds the error of a corner's doubles (line.c). */
#define MARGIN 2.0

/* The triangles whose sides are to be indexed. */
struct gathered_sides {
  struct line_index *index;
  const struct sheet *sheet;
  const uint32_t *triangle;
  size_t count;
  uint32_t *line;             /* the keys of their lines, three a triangle */
  struct side_extent *extent; /* one a worker */
  size_t items;               /* triangles of a part, each of which has */
  uint32_t *start[PARTS_MAX]; /* ends of its own in the lists; the first: those
                                 of the index */
};

/* What is measured of sides: their bounding box, and the sum of the widths and
 * heights of their boxes. */
struct side_extent {
  struct box2 box;
  int64_t length;
};

/* Finds the ends of side k of a triangle that is not edge-on.  Returns whether
 * the side is an edge of the sheet. */
static bool is_edge(const struct sheet *sheet, uint32_t t, int k,
                    struct geom_point end[2]) {
  const struct sheet_triangle *triangle = &sheet->triangle.item[t];
  end[0] = sheet->point.item[triangle->point[k]];
  end[1] = sheet->point.item[triangle->point[geom_next_corner(k)]];
  return sheet_triangle_sides(sheet, t)[k] != SHEET_NONE;
}

/* Fetches the corners of a triangle that comes later in a range. */
MEM_PREFETCH_INLINE void prefetch_later(const struct gathered_sides *sides,
                                        size_t i, size_t end) {
  if (i + MEM_PREFETCH_AHEAD < end)
    sheet_prefetch_corners(sides->sheet,
                           sides->triangle[i + MEM_PREFETCH_AHEAD]);
}

/* ---- The cells ----------------------------------------------------------- */

static uint32_t key_of_ends(const struct geom_point end[2]) {
  struct geom_line line;
  uint64_t key = 0;
  geom_line_through(&line, end[0], end[1]);
  (void)geom_line_key(&line, &key);
  return (uint32_t)key;
}

/* Measures the sides of a range of triangles, and finds the keys of their
 * lines. */
static bool measure_range(void *user, struct parallel_range range) {
  const struct gathered_sides *sides = user;
  struct side_extent extent = sides->extent[range.worker];
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t t = sides->triangle[i];
    struct geom_point end[2];
    prefetch_later(sides, i, range.end);
    for (int k = 0; k < 3 && !sheet_is_edge_on(sides->sheet, t); k++)
      if (is_edge(sides->sheet, t, k, end)) {
        struct box2 b = box2_of_segment(end[0], end[1]);
        extent.length += ((int64_t)b.x1 - b.x0) + ((int64_t)b.y1 - b.y0);
        extent.box = box2_union(extent.box, b);
        sides->line[3 * i + (size_t)k] = key_of_ends(end);
      }
  }
  sides->extent[range.worker] = extent;
  return true;
}

/* Chooses the smallest cells that keep to the limit on the entries. */
static void choose_shape(struct line_index *index, struct side_extent extent,
                         size_t triangles) {
  struct box2 box = extent.box;
  double length = (double)extent.length, count = 3 * (double)triangles;
  double entries_max = fmax(ENTRIES_PER_SIDE * count,
                            fmin(ENTRIES_PER_SIDE_MAX * count, SMALL_SIZE)),
         width, height;
  int shift = 30;
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

static bool measure_sides(struct gathered_sides *sides, int workers) {
  const struct side_extent none = {{INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN},
                                   0};
  struct side_extent all = none;
  sides->extent = mem_alloc((size_t)workers, sizeof *sides->extent);
  bool ok = sides->extent != NULL;
  for (int w = 0; ok && w < workers; w++)
    sides->extent[w] = none;
  ok = ok && parallel_ranges(workers, sides->count, PARALLEL_ITEMS,
                             measure_range, sides);
  for (int w = 0; ok && w < workers; w++) {
    all.box = box2_union(all.box, sides->extent[w].box);
    all.length += sides->extent[w].length;
  }
  mem_free(sides->extent);
  if (ok)
    choose_shape(sides->index, all, sides->count);
  return ok;
}

/* ---- The lists ----------------------------------------------------------- */

/* Counts an entry of the cells that a side meets or, once there is room, stores
 * it.
 * start  of this part */
static void put_side(const struct gathered_sides *sides, uint32_t *start,
                     const struct geom_point end[2], uint64_t entry) {
  const struct triangle_grid *shape = &sides->index->shape;
  uint64_t *stored = sides->index->entry;
  struct cell_range r =
      triangle_grid_cells(shape, box2_of_segment(end[0], end[1]));
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(shape, end[0], end[1], r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      uint32_t *last = &start[triangle_grid_index(shape, x, y)];
      if (stored == NULL)
        ++*last;
      else
        stored[--*last] = entry;
    }
  }
}

static bool put_range(void *user, struct parallel_range range) {
  const struct gathered_sides *sides = user;
  uint32_t *start = sides->start[range.begin / sides->items];
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t t = sides->triangle[i];
    struct geom_point end[2];
    if (!poll_at(i))
      return false;
    prefetch_later(sides, i, range.end);
    for (uint32_t k = 0; k < 3 && !sheet_is_edge_on(sides->sheet, t); k++)
      if (is_edge(sides->sheet, t, (int)k, end))
        put_side(sides, start, end,
                 (uint64_t)sides->line[3 * i + k] << 32 | (3 * t + k));
  }
  return true;
}

/* Lets each part of a list begin where it ends; returns false where memory ran
 * out, or where there are 2^32 entries. */
static bool allocate_lists(const struct gathered_sides *sides, size_t parts,
                           size_t cells) {
  struct line_index *index = sides->index;
  size_t sum = 0;
  for (size_t i = 0; i < cells; i++)
    for (size_t p = 0; p < parts; p++) {
      sum += sides->start[p][i];
      sides->start[p][i] = (uint32_t)sum;
    }
  if (sum > UINT32_MAX)
    return false;
  index->start[cells] = (uint32_t)sum;
  index->entry = mem_alloc(sum, sizeof *index->entry);
  return index->entry != NULL;
}

/* Sorts the entries of a cell: few as a rule. */
static bool sort_cell(uint64_t *entry, size_t count) {
  if (count > SORTED_BY_INSERTION) {
    struct sort_key *key = mem_alloc(count, sizeof *key);
    for (size_t i = 0; key != NULL && i < count; i++)
      key[i] = (struct sort_key){entry[i], 0};
    bool ok = key != NULL && sort_keys_alone(key, count);
    for (size_t i = 0; ok && i < count; i++)
      entry[i] = key[i].key;
    mem_free(key);
    return ok;
  }
  for (size_t i = 1; i < count; i++) {
    uint64_t moving = entry[i];
    size_t hole = i;
    for (; hole > 0 && entry[hole - 1] > moving; hole--)
      entry[hole] = entry[hole - 1];
    entry[hole] = moving;
  }
  return true;
}

/* The order in which threads stored the entries of a cell does not matter, as
 * no two are equal. */
static bool sort_cells_of_range(void *user, struct parallel_range range) {
  const struct line_index *index = user;
  for (size_t c = range.begin; c < range.end; c++)
    if (!sort_cell(index->entry + index->start[c],
                   index->start[c + 1] - index->start[c]))
      return false;
  return true;
}

/* Counts and stores by parts, each of one thread: if they shared the ends of
 * the lists, each of them would wait for memory at every entry, one after the
 * other. */
static bool make_lists(struct gathered_sides *sides, int workers) {
  struct line_index *index = sides->index;
  size_t cells = triangle_grid_cell_count(&index->shape), made = 0,
         parts = workers < PARTS_MAX ? (size_t)workers : PARTS_MAX;
  sides->items = sides->count / parts + 1;
  for (bool ok = true; ok && made < parts; made += ok) {
    sides->start[made] = mem_calloc(cells + 1, sizeof *index->start);
    ok = sides->start[made] != NULL;
  }
  index->start = sides->start[0];
  bool ok =
      made == parts &&
      parallel_ranges(workers, sides->count, sides->items, put_range, sides) &&
      allocate_lists(sides, parts, cells) &&
      parallel_ranges(workers, sides->count, sides->items, put_range, sides);
  for (size_t p = 1; p < parts; p++)
    mem_free(sides->start[p]);
  return ok && parallel_ranges(parallel_workers(cells, PARALLEL_ITEMS), cells,
                               PARALLEL_ITEMS, sort_cells_of_range, index);
}

bool line_index_init(struct line_index *index, const struct sheet *sheet,
                     const uint32_t *triangle, size_t count) {
  struct gathered_sides sides = {
      .index = index, .sheet = sheet, .triangle = triangle, .count = count};
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  memset(index, 0, sizeof *index);
  sides.line = mem_alloc(3 * count, sizeof *sides.line);
  bool ok = sides.line != NULL && measure_sides(&sides, workers) &&
            make_lists(&sides, workers);
  mem_free(sides.line);
  return ok;
}

void line_index_fini(struct line_index *index) {
  mem_free(index->start);
  mem_free(index->entry);
  index->start = NULL;
  index->entry = NULL;
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
  double side = (double)(INT64_C(1) << shape->shift);
  double low = shape->y0 + y * side - MARGIN;
  double high = shape->y0 + (y + 1.0) * side + MARGIN;
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
  uint64_t first = (uint64_t)key << 32;
  LOWER_BOUND(i, index->start[cell], end, index->entry[i] < first);
  for (; i < end && index->entry[i] >> 32 == key; i++)
    if (!ARRAY_PUSH(found, (uint32_t)index->entry[i]))
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
