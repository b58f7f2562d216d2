/* blur.c - nodes that the output cannot tell apart, and making one of them.
 *
 * Phases
 *   1 gather  in reading order, every node takes in those near it that no
 *             other has taken in: its crowd.  Nothing moves
 *   2 shrink  the segments within one large crowd whose ends are near
 *   3 twins   segments between the same two crowds stand together, best
 *             first; one whose ends are near those of a better one is that
 *             one
 * Invariant  A node that another one has become never moves, and one that has
 *   moved is nobody's: so each moves once at most, and by a unit at most.
 * Cost  Those kept between two crowds are no nearer than a unit to each other
 *   at one end or the other, and a crowd is two units wide, so there are few.
 *   Without this phase a thousand rings behind one another would be a million
 *   pairs for the next. */
#include "ink/blur.h"

#include <stdlib.h>
#include <string.h>

#include "base/sort.h"
#include "ink/overlap.h"

/* A crowd of more than so many nodes is large: what is between them would be
 * so many squared pairs for the next phase. */
enum { CROWDED = 16 };

bool blur_init(struct blur *blur, struct net *net, int32_t unit) {
  size_t nodes = net->node.count;
  *blur = (struct blur){.net = net, .unit = unit};
  blur->root = mem_alloc(nodes, sizeof *blur->root);
  blur->anchor = mem_calloc(nodes, sizeof *blur->anchor);
  blur->gone = mem_calloc(net->segment.count, sizeof *blur->gone);
  if (!blur->root || !blur->anchor || !blur->gone)
    return false;
  for (uint32_t i = 0; i < nodes; i++)
    blur->root[i] = i;
  return true;
}

void blur_fini(struct blur *blur) {
  mem_free(blur->root);
  mem_free(blur->anchor);
  mem_free(blur->gone);
}

bool blur_is_near(const struct blur *blur, uint32_t a, uint32_t b) {
  struct ink_point p = blur_at(blur, a), q = blur_at(blur, b);
  return llabs((int64_t)p.x - q.x) <= blur->unit &&
         llabs((int64_t)p.y - q.y) <= blur->unit;
}

bool blur_unite(struct blur *blur, uint32_t from, uint32_t to) {
  uint32_t a = blur->root[from], b = blur->root[to];
  if (a == b)
    return true;
  if ((blur->anchor[a] && blur->anchor[b]) || !blur_is_near(blur, a, b))
    return false;
  uint32_t moves = blur->anchor[a] ? b : a, stays = blur->anchor[a] ? a : b;
  blur->root[moves] = stays;
  blur->anchor[stays] = 1;
  return true;
}

/* ---- 1 Gather ------------------------------------------------------------ */

/* The first place of [low, high), one row's, that is not left of x. */
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

/* Node i takes in what is near it of the places from k to `end`. */
static void take_in(const struct blur *blur, uint32_t *crowd, uint32_t i,
                    uint32_t k, uint32_t end) {
  const struct ink_point *at = blur->net->node.item;
  int64_t most = (int64_t)at[i].x + blur->unit;
  for (; k < end && at[k].x <= most; k++)
    if (crowd[k] == k && llabs((int64_t)at[k].y - at[i].y) <= blur->unit)
      crowd[k] = i;
}

static void gather_crowds(const struct blur *blur, uint32_t *crowd,
                          const struct net_rows *rows) {
  const struct ink_point *at = blur->net->node.item;
  for (uint32_t i = 0; i < blur->net->node.count; i++)
    crowd[i] = i;
  for (uint32_t r = 0; r < rows->count; r++) {
    uint32_t end = rows->start[r + 1];
    for (uint32_t i = rows->start[r]; i < end; i++) {
      if (crowd[i] != i)
        continue;
      take_in(blur, crowd, i, i + 1, end);
      for (uint32_t q = r + 1; at[i].y + blur->unit >= rows->low[q]; q++) {
        uint32_t last = rows->start[q + 1];
        uint32_t k = find_place(at, rows->start[q], last, at[i].x - blur->unit);
        take_in(blur, crowd, i, k, last);
      }
    }
  }
}

/* ---- 2 and 3 Shrink, twins ----------------------------------------------- */

static void drop(struct blur *blur, uint32_t segment) {
  blur->gone[segment] = 1;
  blur->gone_count++;
}

/* Makes the worse segment one with the better; false where they are not. */
static bool unite_twins(struct blur *blur, uint32_t better, uint32_t worse) {
  const uint32_t *a = blur->net->segment.item[better].node;
  const uint32_t *b = blur->net->segment.item[worse].node;
  for (int turned = 0; turned < 2; turned++) {
    uint32_t to[2] = {a[turned], a[!turned]};
    if (!blur_is_near(blur, b[0], to[0]) || !blur_is_near(blur, b[1], to[1]))
      continue;
    blur->net->loose[blur->root[to[0]]] = 1;
    blur->net->loose[blur->root[to[1]]] = 1;
    return blur_unite(blur, b[0], to[0]) && blur_unite(blur, b[1], to[1]);
  }
  return false;
}

/* Of segments between the same two crowds, best first, keeps those that are
 * not one with a better one. */
static void settle(struct blur *blur, const struct sort_key *twin, size_t count,
                   uint32_t *kept) {
  size_t keeps = 0;
  for (size_t i = 0; i < count; i++) {
    bool ok = true;
    for (size_t k = 0; ok && k < keeps; k++)
      ok = !unite_twins(blur, kept[k], twin[i].value);
    if (ok)
      kept[keeps++] = twin[i].value;
    else
      drop(blur, twin[i].value);
  }
}

/* Shrinks what is within a large crowd; lists what has company at both
 * ends. */
static size_t list_twins(struct blur *blur, const uint32_t *crowd,
                         const uint8_t *company, struct sort_key *twin) {
  const struct net *net = blur->net;
  size_t count = 0;
  for (uint32_t i = 0; i < net->segment.count; i++) {
    const uint32_t *node = net->segment.item[i].node;
    uint32_t a = crowd[node[0]], b = crowd[node[1]];
    if (!company[a] || !company[b])
      continue;
    bool is_large = company[a] == CROWDED;
    if (a == b && is_large && blur_is_near(blur, node[0], node[1]) &&
        blur_unite(blur, node[1], node[0]))
      drop(blur, i);
    else if (a != b || is_large) /* short ones are left to the next phase */
      twin[count++] = (struct sort_key){
          (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a), i};
  }
  return count;
}

static void settle_all(struct blur *blur, struct sort_key *twin,
                       struct sort_key *scratch, size_t count, uint32_t *kept) {
  sort_keys(twin, scratch, count);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && twin[end].key == twin[i].key; end++)
      continue;
    if (end == i + 1)
      continue;
    for (size_t k = i; k < end; k++)
      twin[k].key = overlap_rank(blur->net, twin[k].value);
    sort_keys(twin + i, scratch + i, end - i);
    settle(blur, twin + i, end - i, kept);
  }
}

bool blur_drop_twins(struct blur *blur, const struct net_rows *rows) {
  size_t nodes = blur->net->node.count, count = 0;
  uint32_t *crowd = mem_alloc(nodes, sizeof *crowd);
  uint8_t *company = mem_calloc(nodes, sizeof *company);
  struct sort_key *twin = NULL, *scratch = NULL;
  uint32_t *kept = NULL;
  bool ok = crowd && company;
  if (ok && nodes > 0) {
    gather_crowds(blur, crowd, rows);
    for (uint32_t i = 0; i < nodes; i++)
      if (crowd[i] != i) {
        company[crowd[i]] =
            (uint8_t)(company[crowd[i]] + (company[crowd[i]] < CROWDED));
        count++;
      }
  }
  if (ok && count > 0) {
    count = blur->net->segment.count;
    twin = mem_alloc(count, sizeof *twin);
    scratch = mem_alloc(count, sizeof *scratch);
    kept = mem_alloc(count, sizeof *kept);
    ok = twin && scratch && kept;
  }
  if (ok && count > 0) {
    count = list_twins(blur, crowd, company, twin);
    settle_all(blur, twin, scratch, count, kept);
  }
  mem_free(crowd);
  mem_free(company);
  mem_free(twin);
  mem_free(scratch);
  mem_free(kept);
  return ok;
}
