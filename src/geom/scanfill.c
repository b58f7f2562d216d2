/* scanfill.c - scan-line polygon fill: edge table, active edges, spans.
 *
 * The algebra.  Twice nothing is rounded: with the centre of line j at
 *     c_j = y_first + j y_step + y_step / 2        (steps are even)
 * in units of 1 / den, an edge from (x0, y0) up by (ex, ey) is there at
 *     x = ((x0 den - x_first) ey + (c_j - y0 den) ex) / (ey x_step).
 *
 * The bound of error.  With u = 2^-53 and M = |x low| + |x high| in frame
 * units: the first x takes at most 8 roundings of values up to M; dx is off by
 * 4 u |dx|, which n lines gather to 4 u M; each of n steps rounds once more.
 * So x is off by less than u M (n + 12), and x_error = 2 u M (n + 16) is safe
 * for comparisons that round again.
 */
#include "geom/scanfill.h"

#include <float.h>
#include <string.h>

#include "base/sort.h"

/* A key of 44 bits, four passes of the sort: 20 for the line, the rest for x.
 * A unit of it is 2^-24 of the range of x; x_error is below 2^-30 of it, with
 * the 2^20 lines that are the most. */
#define KEY_X_BITS 24

/* So many edges with one key are sorted by insertion. */
#define FEW_EQUAL 8

/* ---- Points and edges ---------------------------------------------------- */

/* ceil(a / b), b > 0. */
static int64_t divide_up(int64_t a, int64_t b) { return a / b + (a % b > 0); }

struct scan_point scan_point_of(const struct scan_grid *grid, int64_t x,
                                int64_t y) {
  struct scan_point point = {x, y, 0, 0};
  int64_t line =
      divide_up(y * grid->den - scan_centre_y(grid, 0), grid->y_step);
  point.column = (double)(x * grid->den - grid->x_first) / (double)grid->x_step;
  point.line = (int32_t)(line < 0             ? 0
                         : line > grid->lines ? grid->lines
                                              : line);
  return point;
}

bool scan_edge_init(struct scan_edge *edge, const struct scan_grid *grid,
                    const struct scan_point *p, const struct scan_point *q) {
  int32_t count = q->line - p->line;
  const struct scan_point *low = p, *high = q;
  if (count == 0)
    return false;
  edge->winding = 1;
  if (count < 0) {
    low = q;
    high = p;
    count = -count;
    edge->winding = -1;
  }
  double slope = (double)(high->x - low->x) /
                 ((double)(high->y - low->y) * (double)grid->x_step);
  edge->line = grid->down ? high->line - 1 : low->line;
  edge->dy = count - 1;
  edge->x =
      low->column +
      (double)(scan_centre_y(grid, edge->line) - low->y * grid->den) * slope;
  edge->dx = (double)grid->y_step * slope;
  if (grid->down)
    edge->dx = -edge->dx;
  edge->x_error = DBL_EPSILON * (count + 16) *
                  ((low->column < 0 ? -low->column : low->column) +
                   (high->column < 0 ? -high->column : high->column));
  edge->owner = 0;
  edge->x0 = low->x;
  edge->y0 = low->y;
  edge->x1 = high->x;
  edge->y1 = high->y;
  return true;
}

/* x of the edge on a line, times its height and x_step. */
static int128 exact_x(const struct scan_edge *edge,
                      const struct scan_grid *grid, int32_t line) {
  return (int128)(edge->x0 * grid->den - grid->x_first) *
             (edge->y1 - edge->y0) +
         (int128)(scan_centre_y(grid, line) - edge->y0 * grid->den) *
             (edge->x1 - edge->x0);
}

int32_t scan_edge_column_exact(const struct scan_edge *edge,
                               const struct scan_grid *grid, int32_t line,
                               int32_t near, bool on) {
  int128 at =
      (int128)(near * grid->x_step + grid->x_step / 2) * (edge->y1 - edge->y0);
  int128 edge_at = exact_x(edge, grid, line);
  return near + (at < edge_at || (at == edge_at && !on));
}

int scan_edge_compare_exact(const struct scan_edge *a,
                            const struct scan_edge *b,
                            const struct scan_grid *grid, bool dx) {
  int order;
  /* The common side of two neighbours. */
  if (a->x0 == b->x0 && a->y0 == b->y0 && a->x1 == b->x1 && a->y1 == b->y1)
    return 0;
  order =
      ratio_compare((struct ratio){exact_x(a, grid, a->line), a->y1 - a->y0},
                    (struct ratio){exact_x(b, grid, b->line), b->y1 - b->y0});
  if (order == 0 && dx) {
    int128 turn = (int128)(a->x1 - a->x0) * (b->y1 - b->y0) -
                  (int128)(b->x1 - b->x0) * (a->y1 - a->y0);
    order = (turn > 0) - (turn < 0);
    if (grid->down)
      order = -order;
  }
  return order;
}

/* ---- Convex polygons ----------------------------------------------------- */

/* Starts the next edge of one chain that covers a line.  Counter-clockwise
 * corners lead down on the left and up on the right. */
static bool next_chain_edge(struct scan_convex *scan,
                            const struct scan_grid *grid,
                            const struct scan_point *point, bool left) {
  uint32_t *at = left ? &scan->left_at : &scan->right_at;
  struct scan_edge *edge = left ? &scan->left : &scan->right;
  while (*at != scan->end) {
    uint32_t from = *at;
    *at = left == grid->down ? (from + 1 == scan->count ? 0 : from + 1)
                             : (from == 0 ? scan->count : from) - 1;
    if (scan_edge_init(edge, grid, &point[from], &point[*at]))
      return true;
  }
  return false;
}

bool scan_convex_start(struct scan_convex *scan, const struct scan_grid *grid,
                       const struct scan_point *point, uint32_t count) {
  uint32_t low = 0, high = 0;
  for (uint32_t k = 1; k < count; k++) {
    if (point[k].y < point[low].y)
      low = k;
    if (point[k].y > point[high].y)
      high = k;
  }
  if (point[low].line == point[high].line)
    return false;
  scan->count = count;
  scan->left_at = scan->right_at = grid->down ? high : low;
  scan->end = grid->down ? low : high;
  scan->left_new = scan->right_new = true;
  return next_chain_edge(scan, grid, point, true) &&
         next_chain_edge(scan, grid, point, false);
}

bool scan_convex_next(struct scan_convex *scan, const struct scan_grid *grid,
                      const struct scan_point *point) {
  scan->left_new = scan->left.dy == 0;
  scan->right_new = scan->right.dy == 0;
  if (scan->left_new) {
    if (!next_chain_edge(scan, grid, point, true))
      return false;
  } else {
    scan_edge_step(&scan->left, grid->down);
  }
  if (!scan->right_new) {
    scan_edge_step(&scan->right, grid->down);
    return true;
  }
  return next_chain_edge(scan, grid, point, false);
}

/* ---- Any polygons -------------------------------------------------------- */

void scan_table_init(struct scan_table *table, const struct scan_grid *grid) {
  memset(table, 0, sizeof *table);
  table->grid = *grid;
}

void scan_table_fini(struct scan_table *table) {
  ARRAY_FREE(&table->edge);
  mem_free(table->order);
  mem_free(table->active);
  mem_free(table->scratch);
  table->order = table->active = table->scratch = NULL;
}

bool scan_table_add(struct scan_table *table, const struct scan_point *p,
                    const struct scan_point *q, uint32_t owner) {
  struct scan_edge edge;
  if (!scan_edge_init(&edge, &table->grid, p, q))
    return true;
  edge.owner = owner;
  return ARRAY_PUSH(&table->edge, edge);
}

/* Keys that order as (first line in scan order, x) up to rounding. */
static void make_keys(const struct scan_table *table, struct sort_key *key) {
  const struct scan_grid *grid = &table->grid;
  const struct scan_edge *edge = table->edge.item;
  double low = 0, high = 1;
  for (size_t i = 0; i < table->edge.count; i++) {
    if (edge[i].x < low)
      low = edge[i].x;
    if (edge[i].x > high)
      high = edge[i].x;
  }
  for (size_t i = 0; i < table->edge.count; i++) {
    int32_t line = edge[i].line;
    if (grid->down)
      line = grid->lines - 1 - line;
    key[i].key = ((uint64_t)line << KEY_X_BITS) |
                 (uint64_t)((edge[i].x - low) / (high - low) *
                            (double)((UINT64_C(1) << KEY_X_BITS) - 1));
    key[i].value = (uint32_t)i;
  }
}

static int compare_span_edges(const void *a, const void *b, void *user) {
  const struct scan_table *table = user;
  const uint32_t *p = a, *q = b;
  return scan_edge_compare(&table->edge.item[*p], &table->edge.item[*q],
                           &table->grid);
}

/* Moves the last of `count` indices to its place among the others, which are
 * in order. */
static void insert_last(const struct scan_table *table, uint32_t *index,
                        size_t count) {
  const struct scan_edge *edge = table->edge.item;
  uint32_t moving = index[count - 1];
  size_t hole = count - 1;
  while (hole > 0 && scan_edge_compare(&edge[index[hole - 1]], &edge[moving],
                                       &table->grid) > 0) {
    index[hole] = index[hole - 1];
    hole--;
  }
  index[hole] = moving;
}

/* Corrects the order where the keys could not decide: first edges with the
 * same key where these are many, then neighbours within a bucket. */
static bool refine_order(struct scan_table *table, const struct sort_key *key) {
  size_t count = table->edge.count, bucket = 0;
  for (size_t i = 0, past; i < count; i = past) {
    for (past = i; past < count && key[past].key == key[i].key; past++)
      table->order[past] = key[past].value;
    if (past - i > FEW_EQUAL &&
        !sort_stable(table->order + i, past - i, sizeof *table->order,
                     compare_span_edges, table))
      return false;
  }
  for (size_t i = 1; i < count; i++) {
    if (key[i].key >> KEY_X_BITS != key[bucket].key >> KEY_X_BITS)
      bucket = i;
    /* Further apart, the keys decide: a unit of them is more than any error. */
    else if (key[i].key - key[i - 1].key <= 1)
      insert_last(table, table->order + bucket, i + 1 - bucket);
  }
  return true;
}

bool scan_table_start(struct scan_table *table) {
  size_t count = table->edge.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  bool ok = false;
  table->order = mem_alloc(count, sizeof *table->order);
  table->active = mem_alloc(count, sizeof *table->active);
  table->scratch = mem_alloc(count, sizeof *table->scratch);
  if (key != NULL && table->order != NULL && table->active != NULL &&
      table->scratch != NULL) {
    make_keys(table, key);
    sort_keys(key, key + count, count);
    ok = refine_order(table, key);
  }
  mem_free(key);
  return ok;
}

/* Drops the edges that ended and moves the rest to the next line. */
static void step_active(struct scan_table *table) {
  struct scan_edge *edge = table->edge.item;
  size_t kept = 0;
  for (size_t i = 0; i < table->active_count; i++) {
    uint32_t e = table->active[i];
    if (edge[e].dy == 0)
      continue;
    scan_edge_step(&edge[e], table->grid.down);
    table->active[kept++] = e;
  }
  table->active_count = kept;
}

/* Merges the bucket of the line, order[first..past), into the active edges:
 * of equals, those already there come first. */
static void merge_bucket(struct scan_table *table, size_t first, size_t past) {
  const struct scan_edge *edge = table->edge.item;
  size_t kept = table->active_count, i = 0, count = 0;
  memcpy(table->scratch, table->active, kept * sizeof *table->active);
  while (first < past) {
    uint32_t next = table->order[first];
    if (i < kept && scan_edge_compare(&edge[table->scratch[i]], &edge[next],
                                      &table->grid) <= 0) {
      table->active[count++] = table->scratch[i++];
    } else {
      table->active[count++] = next;
      first++;
    }
  }
  memcpy(table->active + count, table->scratch + i,
         (kept - i) * sizeof *table->active);
  table->active_count = count + kept - i;
}

bool scan_table_next(struct scan_table *table) {
  const struct scan_edge *edge = table->edge.item;
  size_t first = table->entered, past = first, count = table->edge.count;
  if (table->active_count > 0) {
    table->line += table->grid.down ? -1 : 1;
    step_active(table);
    /* Edges that crossed since the last line change places. */
    for (size_t i = 1; i < table->active_count; i++)
      insert_last(table, table->active, i + 1);
  }
  if (table->active_count == 0) {
    if (first == count)
      return false;
    table->line = edge[table->order[first]].line;
  }
  while (past < count && edge[table->order[past]].line == table->line)
    past++;
  if (past > first)
    merge_bucket(table, first, past);
  table->entered = past;
  return true;
}

/* Appends the span between two edges unless it is empty; one that starts
 * where the last ended makes that one longer. */
static size_t append_span(const struct scan_table *table,
                          struct scan_span *span, size_t count, uint32_t left,
                          uint32_t right) {
  const struct scan_edge *edge = table->edge.item;
  const struct scan_edge *l = &edge[left], *r = &edge[right];
  double x1 = r->x > l->x ? r->x : l->x;
  if (scan_edge_compare_x(l, r, &table->grid) == 0)
    return count;
  if (count > 0 &&
      scan_edge_compare_x(&edge[span[count - 1].right], l, &table->grid) == 0) {
    span[count - 1].x1 = x1;
    span[count - 1].right = right;
    return count;
  }
  span[count] = (struct scan_span){l->x, x1, left, right};
  return count + 1;
}

size_t scan_table_spans(const struct scan_table *table, enum scan_rule rule,
                        struct scan_span *span) {
  size_t count = 0;
  int32_t inside = 0;
  uint32_t left = 0;
  for (size_t i = 0; i < table->active_count; i++) {
    uint32_t e = table->active[i];
    int32_t before = inside;
    if (rule == SCAN_EVEN_ODD)
      inside ^= 1;
    else
      inside += table->edge.item[e].winding;
    if (before == 0)
      left = e;
    else if (inside == 0)
      count = append_span(table, span, count, left, e);
  }
  return count;
}
