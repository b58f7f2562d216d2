/* nodes_near_segment.c - enumerates the nodes near a segment, row by row.
 *
 * Cost  A segment of average length meets a node or two besides its own. */
#include "ink/lines/nodes_near_segment.h"

#include <stdlib.h>

/* The current segment, from the node in the lower row to the other. */
struct probe {
  uint32_t segment, p, q; /* nodes, p < q */
  struct ink_point from, to;
  int64_t dx, dy;
  int64_t cross_max; /* a greater cross product is beyond the tolerance */
};

static inline bool is_near(const struct probe *probe, struct ink_point p) {
  int64_t cross = probe->dx * ((int64_t)p.y - probe->from.y) -
                  probe->dy * ((int64_t)p.x - probe->from.x);
  return -probe->cross_max <= cross && cross <= probe->cross_max;
}

/* Visits the nodes from k upwards, up to `end` and up to x. */
static bool scan_up(const struct node_search *w, const struct probe *probe,
                    uint32_t k, uint32_t end, double x) {
  const struct ink_point *at = w->graph->node.item;
  for (; k < end && at[k].x <= x; k++)
    if (is_near(probe, at[k]) && k != probe->q &&
        !w->visit(w->user, probe->segment, k))
      return false;
  return true;
}

/* Visits the nodes before k downwards, from `start` and from x. */
static bool scan_down(const struct node_search *w, const struct probe *probe,
                      uint32_t k, uint32_t start, double x) {
  const struct ink_point *at = w->graph->node.item;
  while (k > start && at[k - 1].x >= x) {
    k--;
    if (is_near(probe, at[k]) && k != probe->p &&
        !w->visit(w->user, probe->segment, k))
      return false;
  }
  return true;
}

/* The x of the probe's line at height y, if it is not level. */
static double x_at(const struct probe *probe, double y) {
  return probe->from.x +
         (double)probe->dx * (y - probe->from.y) / (double)probe->dy;
}

/* The row that has an end of the probe, at `node`, from where the probe runs
 * towards x. */
static bool scan_from(const struct node_search *w, const struct probe *probe,
                      uint32_t node, double x) {
  uint32_t r = w->rows->row[node];
  uint32_t start = w->rows->start[r], end = w->rows->start[r + 1];
  double here = w->graph->node.item[node].x;
  double low = (x < here ? x : here) - w->near - 1;
  double high = (x < here ? here : x) + w->near + 1;
  return scan_down(w, probe, node, start, low) &&
         scan_up(w, probe, node + 1, end, high);
}

/* The first of the nodes from `start` to before `end`, in order of x, that is
 * not left of an x; no jump depends on them, as none could be predicted. */
static uint32_t first_node_from(const struct ink_point *at, uint32_t start,
                                uint32_t end, double x) {
  uint32_t count = end - start;
  while (count > 0) {
    uint32_t half = count / 2, left = -(uint32_t)(at[start + half].x < x);
    start += left & (half + 1);
    count = (left & (count - half - 1)) | (~left & half);
  }
  return start;
}

/* A row without an end of the probe. */
static bool scan_row(const struct node_search *w, const struct probe *probe,
                     uint32_t r) {
  double low = (double)w->rows->low[r] - w->near;
  double high = (double)w->rows->low[r + 1] + w->near;
  double a = probe->from.x, b = probe->to.x;
  if (low > probe->from.y && probe->dy > 0)
    a = x_at(probe, low < probe->to.y ? low : probe->to.y);
  if (high < probe->to.y && probe->dy > 0)
    b = x_at(probe, high > probe->from.y ? high : probe->from.y);
  double left = (a < b ? a : b) - w->near - 1,
         right = (a < b ? b : a) + w->near + 1;

  const struct ink_point *at = w->graph->node.item;
  uint32_t end = w->rows->start[r + 1];
  uint32_t first = first_node_from(at, w->rows->start[r], end, left);
  return scan_up(w, probe, first, end, right);
}

/* The rows within the tolerance of the probe beyond its ends, and those between
 * the rows of its ends. */
static bool scan_other_rows(const struct node_search *w,
                            const struct probe *probe) {
  const struct node_rows *rows = w->rows;
  uint32_t first = rows->row[probe->p], last = rows->row[probe->q];
  for (uint32_t r = first; r > 0 && rows->low[r] > probe->from.y - w->near; r--)
    if (!scan_row(w, probe, r - 1))
      return false;
  for (uint32_t r = first + 1; r < last; r++)
    if (!scan_row(w, probe, r))
      return false;
  for (uint32_t r = last + 1; rows->low[r] <= probe->to.y + w->near; r++)
    if (!scan_row(w, probe, r))
      return false;
  return true;
}

bool nodes_near_segment_visit(const struct node_search *w, uint32_t segment) {
  const struct graph_segment *s = &w->graph->segment.item[segment];
  const struct node_rows *rows = w->rows;
  struct probe probe = {.segment = segment};
  probe.p = s->node[0];
  probe.q = s->node[1];
  probe.from = w->graph->node.item[probe.p];
  probe.to = w->graph->node.item[probe.q];
  probe.dx = (int64_t)probe.to.x - probe.from.x;
  probe.dy = (int64_t)probe.to.y - probe.from.y;
  probe.cross_max = w->near * (llabs(probe.dx) + llabs(probe.dy));

  uint32_t first = rows->row[probe.p], last = rows->row[probe.q];
  if (first == last) {
    if (!scan_from(w, &probe, probe.p, probe.to.x))
      return false;
  } else {
    double leave = (double)rows->low[first + 1] + w->near;
    double enter = (double)rows->low[last] - w->near;
    leave = leave < probe.to.y ? leave : probe.to.y;
    enter = enter > probe.from.y ? enter : probe.from.y;
    if (!scan_from(w, &probe, probe.p, x_at(&probe, leave)) ||
        !scan_from(w, &probe, probe.q, x_at(&probe, enter)))
      return false;
  }
  return scan_other_rows(w, &probe);
}
