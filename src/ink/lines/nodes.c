/* nodes.c - merges nodes at one position and stores them in rows for searching.
 *
 * Phases
 *   1 sort      all nodes by x, then y
 *   2 rows      horizontal bands, about as many as there are nodes in each:
 *               where nodes are dense, bands are thin, so that a search visits
 *               at most one band
 *   3 merge     in reading order the nodes near each node are merged into it
 *   4 renumber  the nodes, and sort the segments by them
 * Invariant  Two remaining nodes differ in x or in y by more than the
 *   tolerance: the later one was compared with the earlier and would have been
 *   merged into it. Nothing moves by more than the tolerance, as a node that
 *   others were merged into stays. */
#include "base/parallel.h"
#include "base/poll.h"
#include "ink/lines/segment_graph.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"

enum { BUCKET_BITS = 16, BUCKETS = 1 << BUCKET_BITS, ROWS_MAX = 65535 };

struct unite {
  struct segment_graph *graph;
  struct node_rows *rows;
  size_t count;         /* of nodes, before */
  struct ink_point *at; /* row by row */
  uint32_t *order;      /* row by row: the original number of the node */
  uint32_t *root;       /* row by row: the node it is merged into, or itself */
  uint32_t *renumber;   /* old number -> new */
  uint32_t *bucket;     /* number of nodes by bucket of y, then the row of
                           the bucket */
  int32_t x_low, y_low;
  int shift;          /* y - y_low to bucket */
  atomic_size_t dots; /* segments that lost their length */
};

void node_rows_fini(struct node_rows *rows) {
  mem_free(rows->start);
  mem_free(rows->low);
  mem_free(rows->row);
  *rows = (struct node_rows){0};
}

/* ---- 1 Sort -------------------------------------------------------------- */

static int bit_width(uint64_t value) {
  int width = 0;
  for (; value; value >>= 1)
    width++;
  return width;
}

struct node_keys {
  const struct unite *unite;
  struct sort_key *key; /* one a node */
  int y_bits;
};

static bool make_keys_of_range(void *user, struct parallel_range range) {
  const struct node_keys *keys = user;
  const struct unite *u = keys->unite;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_point p = u->graph->node.item[i];
    uint64_t x = (uint64_t)((int64_t)p.x - u->x_low);
    uint64_t y = (uint64_t)((int64_t)p.y - u->y_low);
    keys->key[i] = (struct sort_key){x << keys->y_bits | y, (uint32_t)i};
  }
  return true;
}

/* The node numbers by x, then y; NULL when memory ran out or the caller
 * cancelled. */
static struct sort_key *sort_nodes(struct unite *u) {
  const struct ink_point *node = u->graph->node.item;
  int32_t y_high = node[0].y;
  u->x_low = node[0].x;
  u->y_low = node[0].y;
  for (size_t i = 1; i < u->count; i++) {
    u->x_low = node[i].x < u->x_low ? node[i].x : u->x_low;
    u->y_low = node[i].y < u->y_low ? node[i].y : u->y_low;
    y_high = node[i].y > y_high ? node[i].y : y_high;
  }
  int y_bits = bit_width((uint64_t)((int64_t)y_high - u->y_low));
  u->shift = y_bits > BUCKET_BITS ? y_bits - BUCKET_BITS : 0;

  struct sort_key *key = mem_alloc(u->count, sizeof *key);
  struct sort_key *scratch = mem_alloc(u->count, sizeof *scratch);
  struct node_keys keys = {u, key, y_bits};
  if (key != NULL && scratch != NULL &&
      parallel_ranges(parallel_workers(u->count, PARALLEL_ITEMS), u->count,
                      PARALLEL_ITEMS, make_keys_of_range, &keys)) {
    sort_keys(key, scratch, u->count);
  } else {
    mem_free(key);
    key = NULL;
  }
  mem_free(scratch);
  return key;
}

/* ---- 2 Rows -------------------------------------------------------------- */

static size_t bucket_of(const struct unite *u, int32_t y) {
  return (size_t)(((int64_t)y - u->y_low) >> u->shift);
}

/* Groups buckets into rows: bucket[b] becomes its row, start[r + 1] the number
 * of nodes before row r, as fill_rows needs it. */
static void assign_rows(struct unite *u) {
  struct node_rows *rows = u->rows;
  double aim = sqrt((double)u->count);
  uint32_t target =
      (uint32_t)(aim < ROWS_MAX ? aim + 1 : aim * aim / ROWS_MAX + 1);
  uint32_t in_row = target, before = 0;
  rows->count = 0;
  for (size_t b = 0; b < BUCKETS; b++) {
    uint32_t here = u->bucket[b];
    if (here && in_row >= target) {
      rows->low[rows->count] = u->y_low + ((int64_t)b << u->shift);
      rows->start[++rows->count] = before;
      in_row = 0;
    }
    u->bucket[b] = rows->count - 1;
    in_row += here;
    before += here;
  }
  rows->low[rows->count] = INT64_MAX;
}

/* Distributes the sorted nodes over their rows, in order. */
static void fill_rows(struct unite *u, const struct sort_key *key) {
  const struct ink_point *node = u->graph->node.item;
  uint32_t *next = u->rows->start + 1; /* becomes the start of the next row */
  for (size_t i = 0; i < u->count; i++) {
    struct ink_point p = node[key[i].value];
    (void)poll_at(i);
    uint32_t slot = next[u->bucket[bucket_of(u, p.y)]]++;
    u->order[slot] = key[i].value;
    u->at[slot] = p;
  }
  u->rows->start[0] = 0;
}

static bool make_rows(struct unite *u) {
  struct sort_key *key = sort_nodes(u);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < u->count; i++)
    u->bucket[bucket_of(u, u->graph->node.item[i].y)]++;
  assign_rows(u);
  fill_rows(u, key);
  mem_free(key);
  return true;
}

/* ---- 3 Merge ------------------------------------------------------------- */

/* Merges the nodes among [low, high), of one row, that are near node i into it.
 */
static void merge_into(struct unite *u, uint32_t i, size_t low, uint32_t high) {
  const struct ink_point *at = u->at, p = at[i];
  int64_t y_min = (int64_t)p.y - TOLERANCE_COINCIDENT_UNITS,
          y_max = (int64_t)p.y + TOLERANCE_COINCIDENT_UNITS;
  for (int64_t x = (int64_t)p.x - TOLERANCE_COINCIDENT_UNITS;
       x <= (int64_t)p.x + TOLERANCE_COINCIDENT_UNITS; x++) {
    size_t k;
    LOWER_BOUND(k, low, high, at[k].x < x || (at[k].x == x && at[k].y < y_min));
    for (; k < high && at[k].x == x && at[k].y <= y_max; k++)
      if (u->root[k] == k)
        u->root[k] = i;
    low = k;
  }
}

static void merge_near_nodes(struct unite *u) {
  const struct node_rows *rows = u->rows;
  for (uint32_t i = 0; i < u->count; i++)
    u->root[i] = i;
  for (uint32_t r = 0; r < rows->count; r++) {
    uint32_t end = rows->start[r + 1];
    for (uint32_t i = rows->start[r]; i < end; i++) {
      (void)poll_at(i);
      if (u->root[i] != i)
        continue;
      struct ink_point p = u->at[i];
      if (i + 1 < end &&
          u->at[i + 1].x <= (int64_t)p.x + TOLERANCE_COINCIDENT_UNITS)
        merge_into(u, i, i + 1, end);
      for (uint32_t q = r + 1;
           (int64_t)p.y + TOLERANCE_COINCIDENT_UNITS >= rows->low[q]; q++)
        merge_into(u, i, rows->start[q], rows->start[q + 1]);
    }
  }
}

/* ---- 4 Renumber ---------------------------------------------------------- */

static void renumber_nodes(struct unite *u) {
  struct node_rows *rows = u->rows;
  struct ink_point *node = u->graph->node.item;
  uint32_t count = 0;
  for (uint32_t r = 0; r < rows->count; r++) {
    uint32_t i = rows->start[r], end = rows->start[r + 1];
    rows->start[r] = count;
    for (; i < end; i++) {
      (void)poll_at(i);
      /* A root precedes the nodes merged into it, so its number is known. */
      if (u->root[i] == i) {
        node[count] = u->at[i];
        rows->row[count] = (uint16_t)r;
        u->renumber[u->order[i]] = count++;
      } else {
        u->renumber[u->order[i]] = u->renumber[u->order[u->root[i]]];
      }
    }
  }
  rows->start[rows->count] = count;
  u->graph->node.count = count;
}

static bool renumber_range(void *user, struct parallel_range range) {
  struct unite *u = user;
  size_t dots = 0;
  for (size_t i = range.begin; i < range.end; i++) {
    struct graph_segment *s = &u->graph->segment.item[i];
    for (int k = 0; k < 2; k++)
      s->node[k] = u->renumber[s->node[k]];
    *s = graph_segment_sorted(*s);
    dots += s->node[0] == s->node[1];
  }
  if (dots > 0)
    atomic_fetch_add_explicit(&u->dots, dots, memory_order_relaxed);
  return true;
}

static bool renumber_segments(struct unite *u) {
  struct segment_graph *graph = u->graph;
  size_t count = graph->segment.count, kept = 0;
  bool ok = parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, renumber_range, u);
  graph->dots = u->dots;
  for (size_t i = 0; graph->dots > 0 && i < count; i++) {
    struct graph_segment s = graph->segment.item[i];
    if (s.node[0] != s.node[1])
      graph->segment.item[kept++] = s;
  }
  graph->segment.count = count - graph->dots;
  return ok;
}

recto_status segment_graph_unite(struct segment_graph *graph,
                                 struct node_rows *rows, recto_error *error) {
  size_t count = graph->node.count;
  struct unite u = {.graph = graph, .rows = rows, .count = count};
  bool ok = false;
  u.at = mem_alloc(count, sizeof *u.at);
  u.order = mem_alloc(count, sizeof *u.order);
  u.root = mem_alloc(count, sizeof *u.root);
  u.renumber = mem_alloc(count, sizeof *u.renumber);
  u.bucket = mem_calloc(BUCKETS, sizeof *u.bucket);
  /* Every row has at least one node, and the number of rows is bounded. */
  size_t most = count < ROWS_MAX ? count : ROWS_MAX;
  rows->start = mem_calloc(most + 2, sizeof *rows->start);
  rows->low = mem_alloc(most + 1, sizeof *rows->low);
  rows->row = mem_alloc(count, sizeof *rows->row);
  if (u.at == NULL || u.order == NULL || u.root == NULL || u.renumber == NULL ||
      u.bucket == NULL || rows->start == NULL || rows->low == NULL ||
      rows->row == NULL)
    goto done;
  if (count > 0) {
    if (!make_rows(&u))
      goto done;
    merge_near_nodes(&u);
    renumber_nodes(&u);
    if (!renumber_segments(&u))
      goto done;
  }
  ok = true;
done:
  mem_free(u.at);
  mem_free(u.order);
  mem_free(u.root);
  mem_free(u.renumber);
  mem_free(u.bucket);
  /* Sorting takes as much memory as the segments, and none of this. */
  return ok && segment_graph_sort_segments(graph) ? RECTO_OK
                                                  : error_memory(error);
}
