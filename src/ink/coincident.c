/* coincident.c - finds the segments that lie on each other and has one drawn.
 *
 * Phases
 *   1 twins   of segments between the same two nodes, which stand together,
 *             the best stays
 *   2 walk    two segments that overlap otherwise have an end of one inside
 *             the other, so each segment looks at the nodes along it, row by
 *             row; where a segment that starts there runs along it, the two
 *             are of one cluster
 *   3 resolve each cluster leaves pieces that do not overlap (overlap.c)
 *   4 rebuild the segments
 * Cost  A segment of average length meets a node or two besides its own.  On a
 *   mesh without overlaps phase 2 is nearly all of the time. */
#include "ink/net.h"

#include <stdlib.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/overlap.h"

#define NEAR TOLERANCE_COINCIDENT_UNITS

struct walk {
  struct net *net;
  const struct net_rows *rows;
  uint8_t *gone; /* one a segment: not to be drawn as it is */
  size_t gone_count;
  /* Clusters: the parent's number and one; 0: its own root.  So the pages of
   * segments that overlap nothing are never touched. */
  uint32_t *parent;
  ARRAY(uint32_t) member; /* segments of clusters, some of them often */
};

/* The segment at hand, from the node in the lower row to the other. */
struct probe {
  uint32_t segment, p, q; /* nodes, p < q */
  struct ink_point from, to;
  int64_t dx, dy;
  int64_t reach; /* a cross product beyond it is farther than the tolerance */
};

recto_status net_index_ends(struct net *net, recto_error *error) {
  size_t nodes = net->node.count, ends = 2 * net->segment.count;
  mem_free(net->end_start);
  mem_free(net->end);
  net->end_start = mem_calloc(nodes + 2, sizeof *net->end_start);
  net->end = mem_alloc(ends, sizeof *net->end);
  if (!net->end_start || !net->end)
    return error_memory(error);
  uint32_t *next = net->end_start + 1; /* ends as the next node's start */
  for (size_t e = 0; e < ends; e++)
    next[net->segment.item[e >> 1].node[e & 1] + 1]++;
  for (size_t n = 0; n < nodes; n++)
    next[n + 1] += next[n];
  for (size_t e = 0; e < ends; e++)
    net->end[next[net->segment.item[e >> 1].node[e & 1]]++] = (uint32_t)e;
  return RECTO_OK;
}

/* ---- 1 Twins --------------------------------------------------------------
 */

static void drop_twins(struct walk *w) {
  const struct net_segment *s = w->net->segment.item;
  uint32_t best = 0;
  for (uint32_t i = 1; i < w->net->segment.count; i++) {
    bool twins =
        s[i].node[0] == s[best].node[0] && s[i].node[1] == s[best].node[1];
    bool better =
        !twins || overlap_rank(w->net, i) < overlap_rank(w->net, best);
    if (twins) {
      w->gone[better ? best : i] = 1;
      w->gone_count++;
    }
    if (better)
      best = i;
  }
}

/* ---- 2 Walk ---------------------------------------------------------------
 */

static uint32_t root_of(uint32_t *parent, uint32_t segment) {
  while (parent[segment]) {
    uint32_t up = parent[segment] - 1;
    if (parent[up])
      parent[segment] = parent[up];
    segment = up;
  }
  return segment;
}

static bool join_clusters(struct walk *w, uint32_t a, uint32_t b) {
  uint32_t ra = root_of(w->parent, a), rb = root_of(w->parent, b);
  if (ra == rb)
    return true;
  /* The lower root stays, so that a cluster is named by its first member. */
  w->parent[ra < rb ? rb : ra] = (ra < rb ? ra : rb) + 1;
  return ARRAY_PUSH(&w->member, a) && ARRAY_PUSH(&w->member, b);
}

/* Node k is near the probe's line: looks for segments that run along. */
static bool look_at(struct walk *w, const struct probe *probe, uint32_t k) {
  const struct net *net = w->net;
  for (uint32_t i = net->end_start[k]; i < net->end_start[k + 1]; i++) {
    uint32_t other = net->end[i] >> 1;
    if (!w->gone[other] && overlap_is_along(net, probe->segment, other) &&
        !join_clusters(w, probe->segment, other))
      return false;
  }
  return true;
}

static inline bool is_near(const struct probe *probe, struct ink_point p) {
  int64_t cross = probe->dx * ((int64_t)p.y - probe->from.y) -
                  probe->dy * ((int64_t)p.x - probe->from.x);
  return -probe->reach <= cross && cross <= probe->reach;
}

/* Nodes from k on upwards, up to `end` and up to x. */
static bool scan_up(struct walk *w, const struct probe *probe, uint32_t k,
                    uint32_t end, double x) {
  const struct ink_point *at = w->net->node.item;
  for (; k < end && at[k].x <= x; k++)
    if (is_near(probe, at[k]) && k != probe->q && !look_at(w, probe, k))
      return false;
  return true;
}

/* Nodes before k downwards, from `start` and from x. */
static bool scan_down(struct walk *w, const struct probe *probe, uint32_t k,
                      uint32_t start, double x) {
  const struct ink_point *at = w->net->node.item;
  while (k > start && at[k - 1].x >= x) {
    k--;
    if (is_near(probe, at[k]) && k != probe->p && !look_at(w, probe, k))
      return false;
  }
  return true;
}

/* Where the probe's line is at height y; only for those that rise. */
static double x_at(const struct probe *probe, double y) {
  return probe->from.x +
         (double)probe->dx * (y - probe->from.y) / (double)probe->dy;
}

/* The row in which the probe starts or ends, at `node`, the probe leaving
 * it towards x. */
static bool scan_from(struct walk *w, const struct probe *probe, uint32_t node,
                      double x) {
  uint32_t r = w->rows->row[node];
  uint32_t start = w->rows->start[r], end = w->rows->start[r + 1];
  double here = w->net->node.item[node].x;
  double low = (x < here ? x : here) - NEAR - 1;
  double high = (x < here ? here : x) + NEAR + 1;
  return scan_down(w, probe, node, start, low) &&
         scan_up(w, probe, node + 1, end, high);
}

/* A row in which the probe has no end. */
static bool scan_row(struct walk *w, const struct probe *probe, uint32_t r) {
  double low = (double)w->rows->low[r] - NEAR;
  double high = (double)w->rows->low[r + 1] + NEAR;
  double a = probe->from.x, b = probe->to.x;
  if (low > probe->from.y && probe->dy > 0)
    a = x_at(probe, low < probe->to.y ? low : probe->to.y);
  if (high < probe->to.y && probe->dy > 0)
    b = x_at(probe, high > probe->from.y ? high : probe->from.y);
  double left = (a < b ? a : b) - NEAR - 1, right = (a < b ? b : a) + NEAR + 1;

  const struct ink_point *at = w->net->node.item;
  uint32_t i = w->rows->start[r], end = w->rows->start[r + 1], j = end;
  while (i < j) {
    uint32_t middle = i + (j - i) / 2;
    if (at[middle].x < left)
      i = middle + 1;
    else
      j = middle;
  }
  return scan_up(w, probe, i, end, right);
}

/* Rows that the probe comes near without reaching them, and those between
 * the rows of its ends. */
static bool scan_other_rows(struct walk *w, const struct probe *probe) {
  const struct net_rows *rows = w->rows;
  uint32_t first = rows->row[probe->p], last = rows->row[probe->q];
  for (uint32_t r = first; r > 0 && rows->low[r] > probe->from.y - NEAR; r--)
    if (!scan_row(w, probe, r - 1))
      return false;
  for (uint32_t r = first + 1; r < last; r++)
    if (!scan_row(w, probe, r))
      return false;
  for (uint32_t r = last + 1; rows->low[r] <= probe->to.y + NEAR; r++)
    if (!scan_row(w, probe, r))
      return false;
  return true;
}

static bool walk_segment(struct walk *w, uint32_t segment) {
  const struct net_segment *s = &w->net->segment.item[segment];
  const struct net_rows *rows = w->rows;
  struct probe probe = {.segment = segment};
  probe.p = s->node[0];
  probe.q = s->node[1];
  probe.from = w->net->node.item[probe.p];
  probe.to = w->net->node.item[probe.q];
  probe.dx = (int64_t)probe.to.x - probe.from.x;
  probe.dy = (int64_t)probe.to.y - probe.from.y;
  probe.reach = NEAR * (llabs(probe.dx) + llabs(probe.dy));

  uint32_t first = rows->row[probe.p], last = rows->row[probe.q];
  if (first == last) {
    if (!scan_from(w, &probe, probe.p, probe.to.x))
      return false;
  } else {
    double leave = (double)rows->low[first + 1] + NEAR;
    double enter = (double)rows->low[last] - NEAR;
    leave = leave < probe.to.y ? leave : probe.to.y;
    enter = enter > probe.from.y ? enter : probe.from.y;
    if (!scan_from(w, &probe, probe.p, x_at(&probe, leave)) ||
        !scan_from(w, &probe, probe.q, x_at(&probe, enter)))
      return false;
  }
  return scan_other_rows(w, &probe);
}

/* ---- 3 Resolve ------------------------------------------------------------
 */

/* Sorts the members by cluster and drops those named twice. */
static bool gather_members(struct walk *w) {
  size_t count = w->member.count, kept = 0;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct sort_key *scratch = mem_alloc(count, sizeof *scratch);
  if (key && scratch) {
    for (size_t i = 0; i < count; i++) {
      uint32_t segment = w->member.item[i];
      uint64_t root = root_of(w->parent, segment);
      key[i] = (struct sort_key){root << 32 | segment, segment};
    }
    sort_keys(key, scratch, count);
    for (size_t i = 0; i < count; i++)
      if (i == 0 || key[i].value != key[i - 1].value)
        w->member.item[kept++] = key[i].value;
    w->member.count = kept;
  }
  bool good = key && scratch;
  mem_free(key);
  mem_free(scratch);
  return good;
}

static bool resolve_clusters(struct walk *w, struct overlap *overlap) {
  const uint32_t *member = w->member.item;
  for (size_t i = 0, end; i < w->member.count; i = end) {
    uint32_t root = root_of(w->parent, member[i]);
    for (end = i;
         end < w->member.count && root_of(w->parent, member[end]) == root;
         end++) {
      w->gone[member[end]] = 1;
      w->gone_count++;
    }
    if (!overlap_resolve(overlap, w->net, member + i, end - i))
      return false;
  }
  return true;
}

/* ---- 4 Rebuild ------------------------------------------------------------
 */

static void drop_gone(struct walk *w) {
  struct net *net = w->net;
  size_t kept = 0;
  for (size_t i = 0; i < net->segment.count; i++)
    if (!w->gone[i])
      net->segment.item[kept++] = net->segment.item[i];
  net->segment.count = kept;
}

static bool add_pieces(struct net *net, const struct overlap *overlap) {
  for (size_t i = 0; i < overlap->piece.count; i++)
    if (!ARRAY_PUSH(&net->segment, overlap->piece.item[i]))
      return false;
  return net_sort_segments(net);
}

static bool replace_clusters(struct walk *w) {
  struct overlap overlap;
  bool good = overlap_init(&overlap, w->member.count) && gather_members(w) &&
              resolve_clusters(w, &overlap);
  if (good) {
    drop_gone(w);
    good = add_pieces(w->net, &overlap);
  }
  overlap_fini(&overlap);
  return good;
}

recto_status net_drop_coincident(struct net *net, const struct net_rows *rows,
                                 recto_error *error) {
  size_t count = net->segment.count;
  struct walk w = {.net = net, .rows = rows};
  recto_status status = net_index_ends(net, error);
  if (status)
    return status;
  w.gone = mem_calloc(count, sizeof *w.gone);
  w.parent = mem_calloc(count, sizeof *w.parent);
  bool good = w.gone && w.parent;
  if (good)
    drop_twins(&w);
  for (uint32_t i = 0; good && i < count; i++)
    good = w.gone[i] || walk_segment(&w, i);
  if (good && w.member.count)
    good = replace_clusters(&w);
  else if (good && w.gone_count)
    drop_gone(&w);
  net->doubled = w.gone_count;
  mem_free(w.gone);
  mem_free(w.parent);
  ARRAY_FREE(&w.member);
  if (!good)
    return error_memory(error);
  return w.gone_count ? net_index_ends(net, error) : RECTO_OK;
}
