/* vertex_snapping.c - merges nodes that the output cannot distinguish.
 *
 * Phases
 *   1 cluster     in reading order, every node collects the nodes near it that
 *                 belong to no other: its cluster.  Nothing moves
 *   2 contract    the segments inside one large cluster whose ends are near
 *   3 duplicates  segments between the same two clusters are consecutive, best
 *                 first; one whose ends are near those of a better one is
 *                 removed
 * Invariant  A merge target never moves and a moved node is never a target, so
 *   each node moves at most once, and by at most one unit.
 * Cost  The segments kept between two clusters differ by at least a unit at one
 *   end or the other, and a cluster is two units wide, so they are few.
 *   Without this phase a thousand nested rings would be a million pairs for the
 *   next. */
#include "ink/lines/vertex_snapping.h"

#include <stdlib.h>
#include <string.h>

#include "base/sort.h"
#include "ink/lines/overlap.h"

/* A cluster of more nodes is large: the next phase would see the square of
 * their number in pairs. */
enum { CROWDED = 16 };

bool vertex_snapping_init(struct vertex_snapping *snapping,
                          struct segment_graph *graph, int32_t unit) {
  size_t nodes = graph->node.count;
  *snapping = (struct vertex_snapping){.graph = graph, .unit = unit};
  snapping->root = mem_alloc(nodes, sizeof *snapping->root);
  snapping->anchor = mem_calloc(nodes, sizeof *snapping->anchor);
  snapping->gone = mem_calloc(graph->segment.count, sizeof *snapping->gone);
  if (!snapping->root || !snapping->anchor || !snapping->gone)
    return false;
  for (uint32_t i = 0; i < nodes; i++)
    snapping->root[i] = i;
  return true;
}

void vertex_snapping_fini(struct vertex_snapping *snapping) {
  mem_free(snapping->root);
  mem_free(snapping->anchor);
  mem_free(snapping->gone);
}

bool vertex_snapping_is_near(const struct vertex_snapping *snapping, uint32_t a,
                             uint32_t b) {
  struct ink_point p = vertex_snapping_at(snapping, a),
                   q = vertex_snapping_at(snapping, b);
  return llabs((int64_t)p.x - q.x) <= snapping->unit &&
         llabs((int64_t)p.y - q.y) <= snapping->unit;
}

bool vertex_snapping_unite(struct vertex_snapping *snapping, uint32_t from,
                           uint32_t to) {
  uint32_t a = snapping->root[from], b = snapping->root[to];
  if (a == b)
    return true;
  if ((snapping->anchor[a] && snapping->anchor[b]) ||
      !vertex_snapping_is_near(snapping, a, b))
    return false;
  uint32_t moves = snapping->anchor[a] ? b : a,
           stays = snapping->anchor[a] ? a : b;
  snapping->root[moves] = stays;
  snapping->anchor[stays] = 1;
  return true;
}

/* ---- 1 Gather ------------------------------------------------------------ */

/* The first index of [low, high), which is one row, that is not left of x. */
static uint32_t find_place(const struct ink_point *at, uint32_t low,
                           uint32_t high, int64_t x) {
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (at[middle].x < x)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* Node i collects the nodes near it, from index k up to `end`. */
static void take_in(const struct vertex_snapping *snapping, uint32_t *crowd,
                    uint32_t i, uint32_t k, uint32_t end) {
  const struct ink_point *at = snapping->graph->node.item;
  int64_t most = (int64_t)at[i].x + snapping->unit;
  for (; k < end && at[k].x <= most; k++)
    if (crowd[k] == k && llabs((int64_t)at[k].y - at[i].y) <= snapping->unit)
      crowd[k] = i;
}

static void gather_crowds(const struct vertex_snapping *snapping,
                          uint32_t *crowd, const struct node_rows *rows) {
  const struct ink_point *at = snapping->graph->node.item;
  for (uint32_t i = 0; i < snapping->graph->node.count; i++)
    crowd[i] = i;
  for (uint32_t r = 0; r < rows->count; r++) {
    uint32_t end = rows->start[r + 1];
    for (uint32_t i = rows->start[r]; i < end; i++) {
      if (crowd[i] != i)
        continue;
      take_in(snapping, crowd, i, i + 1, end);
      for (uint32_t q = r + 1; at[i].y + snapping->unit >= rows->low[q]; q++) {
        uint32_t last = rows->start[q + 1];
        uint32_t k =
            find_place(at, rows->start[q], last, at[i].x - snapping->unit);
        take_in(snapping, crowd, i, k, last);
      }
    }
  }
}

/* ---- 2 and 3 Shrink, twins ----------------------------------------------- */

static void drop(struct vertex_snapping *snapping, uint32_t segment) {
  snapping->gone[segment] = 1;
  snapping->gone_count++;
}

/* Merges the worse segment with the better; false if their ends are not near.
 * */
static bool unite_twins(struct vertex_snapping *snapping, uint32_t better,
                        uint32_t worse) {
  const uint32_t *a = snapping->graph->segment.item[better].node;
  const uint32_t *b = snapping->graph->segment.item[worse].node;
  for (int turned = 0; turned < 2; turned++) {
    uint32_t to[2] = {a[turned], a[!turned]};
    if (!vertex_snapping_is_near(snapping, b[0], to[0]) ||
        !vertex_snapping_is_near(snapping, b[1], to[1]))
      continue;
    snapping->graph->approximate[snapping->root[to[0]]] = 1;
    snapping->graph->approximate[snapping->root[to[1]]] = 1;
    return vertex_snapping_unite(snapping, b[0], to[0]) &&
           vertex_snapping_unite(snapping, b[1], to[1]);
  }
  return false;
}

/* Of segments between the same two clusters, best first, removes those that
 * duplicate a better one. */
static void settle(struct vertex_snapping *snapping,
                   const struct sort_key *twin, size_t count, uint32_t *kept) {
  size_t keeps = 0;
  for (size_t i = 0; i < count; i++) {
    bool ok = true;
    for (size_t k = 0; ok && k < keeps; k++)
      ok = !unite_twins(snapping, kept[k], twin[i].value);
    if (ok)
      kept[keeps++] = twin[i].value;
    else
      drop(snapping, twin[i].value);
  }
}

/* Contracts the segments inside a large cluster; lists those with other nodes
 * near at both ends. */
static size_t list_twins(struct vertex_snapping *snapping,
                         const uint32_t *crowd, const uint8_t *company,
                         struct sort_key *twin) {
  const struct segment_graph *graph = snapping->graph;
  size_t count = 0;
  for (uint32_t i = 0; i < graph->segment.count; i++) {
    const uint32_t *node = graph->segment.item[i].node;
    uint32_t a = crowd[node[0]], b = crowd[node[1]];
    if (!company[a] || !company[b])
      continue;
    bool is_large = company[a] == CROWDED;
    if (a == b && is_large &&
        vertex_snapping_is_near(snapping, node[0], node[1]) &&
        vertex_snapping_unite(snapping, node[1], node[0]))
      drop(snapping, i);
    else if (a != b || is_large) /* short ones are left to the next phase */
      twin[count++] = (struct sort_key){
          (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a), i};
  }
  return count;
}

static void settle_all(struct vertex_snapping *snapping, struct sort_key *twin,
                       struct sort_key *scratch, size_t count, uint32_t *kept) {
  sort_keys(twin, scratch, count);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && twin[end].key == twin[i].key; end++)
      continue;
    if (end == i + 1)
      continue;
    for (size_t k = i; k < end; k++)
      twin[k].key = overlap_rank(snapping->graph, twin[k].value);
    sort_keys(twin + i, scratch + i, end - i);
    settle(snapping, twin + i, end - i, kept);
  }
}

bool vertex_snapping_drop_twins(struct vertex_snapping *snapping,
                                const struct node_rows *rows) {
  size_t nodes = snapping->graph->node.count, count = 0;
  uint32_t *crowd = mem_alloc(nodes, sizeof *crowd);
  uint8_t *company = mem_calloc(nodes, sizeof *company);
  struct sort_key *twin = NULL, *scratch = NULL;
  uint32_t *kept = NULL;
  bool ok = crowd && company;
  if (ok && nodes > 0) {
    gather_crowds(snapping, crowd, rows);
    for (uint32_t i = 0; i < nodes; i++)
      if (crowd[i] != i) {
        company[crowd[i]] =
            (uint8_t)(company[crowd[i]] + (company[crowd[i]] < CROWDED));
        count++;
      }
  }
  if (ok && count > 0) {
    count = snapping->graph->segment.count;
    twin = mem_alloc(count, sizeof *twin);
    scratch = mem_alloc(count, sizeof *scratch);
    kept = mem_alloc(count, sizeof *kept);
    ok = twin && scratch && kept;
  }
  if (ok && count > 0) {
    count = list_twins(snapping, crowd, company, twin);
    settle_all(snapping, twin, scratch, count, kept);
  }
  mem_free(crowd);
  mem_free(company);
  mem_free(twin);
  mem_free(scratch);
  mem_free(kept);
  return ok;
}
