/* section_sweep.c - sweeps over the edges of a section: winding numbers, and
 * the bridges from boundaries within a place to what is left of them.
 *
 * Invariant  The active edges are those that cross the sweep line, from below
 * to above, as long as no two of them cross: each two that become neighbours
 * are tested.  Upright edges count as leaning to the right, by the order of
 * nodes. */
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "cut/section_phases.h"

/* More winding numbers than these, of all places together, are refused: lines
 * of thousands of parts would have to lie within each other. */
enum { WINDINGS_MAX = 1 << 24 };

struct section_sweep {
  struct section *section;
  uint32_t *helper;         /* NULL: labels are to be set */
  ARRAY(uint32_t) active;   /* edges */
  ARRAY(uint32_t) starting; /* those that replace others in it */
  bool planar;
};

static const struct section_node *node_of(const struct section_sweep *sweep,
                                          uint32_t node) {
  return &sweep->section->node.item[node];
}

static struct section_edge *edge_at(const struct section_sweep *sweep,
                                    size_t place) {
  return &sweep->section->edge.item[sweep->active.item[place]];
}

static int side_of(const struct section_sweep *sweep,
                   const struct section_edge *edge, uint32_t node) {
  return section_side(node_of(sweep, edge->a), node_of(sweep, edge->b),
                      node_of(sweep, node));
}

/* Whether the upper one of two neighbours stays above the lower one until one
 * of them ends. */
static bool stays_above(const struct section_sweep *sweep,
                        const struct section_edge *lower,
                        const struct section_edge *upper) {
  if (lower->b == upper->b)
    return true;
  return lower->b < upper->b ? side_of(sweep, upper, lower->b) < 0
                             : side_of(sweep, lower, upper->b) > 0;
}

/* ---- Labels -------------------------------------------------------------- */

/* The label of a place: see section.h. */
static uint32_t choose_label(const struct section *section,
                             const struct section_winding *winding,
                             size_t count) {
  int64_t total = 0;
  uint32_t label = SECTION_NONE;
  for (size_t i = 0; i < count; i++) {
    total += winding[i].number;
    if (label == SECTION_NONE ||
        section->area[winding[i].label] < section->area[label])
      label = winding[i].label;
  }
  return total != 0 ? label : SECTION_NONE;
}

/* Sets the winding numbers above an edge: those below it, `count` from `first`,
 * and what its lines add.  Both are sorted by their labels. */
static bool add_windings(struct section *section, struct section_edge *edge,
                         size_t first, size_t count) {
  size_t start = section->winding.count, i = first, past = first + count;
  if (!ARRAY_RESERVE(&section->winding, count + edge->lines))
    return false;
  const struct section_line *line = section->line.item + edge->line;
  const struct section_line *lines_end = line + edge->lines;
  const struct section_winding *below = section->winding.item;
  while (i < past || line < lines_end) {
    struct section_winding next = {SECTION_NONE, 0};
    if (i < past)
      next.label = below[i].label;
    if (line < lines_end && line->label < next.label)
      next.label = line->label;
    if (i < past && below[i].label == next.label)
      next.number = below[i++].number;
    for (; line < lines_end && line->label == next.label; line++)
      next.number += line->weight;
    if (next.number != 0)
      section->winding.item[section->winding.count++] = next;
  }
  edge->winding = (uint32_t)start;
  edge->windings = (uint32_t)(section->winding.count - start);
  return true;
}

static recto_status set_labels(struct section_sweep *sweep, size_t low,
                               recto_error *error) {
  struct section *section = sweep->section;
  const struct section_edge *below = low > 0 ? edge_at(sweep, low - 1) : NULL;
  for (size_t i = 0; i < sweep->starting.count; i++) {
    struct section_edge *edge = &section->edge.item[sweep->starting.item[i]];
    size_t first = below != NULL ? below->winding : 0;
    size_t count = below != NULL ? below->windings : 0;
    if (!add_windings(section, edge, first, count))
      return error_memory(error);
    if (section->winding.count > WINDINGS_MAX)
      return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                       "too many parts lie within each other where they are "
                       "cut");
    edge->below = below != NULL ? below->above : SECTION_NONE;
    edge->above = choose_label(section, section->winding.item + edge->winding,
                               edge->windings);
    below = edge;
  }
  return RECTO_OK;
}

/* ---- Bridges ------------------------------------------------------------- */

/* Where nothing ends at a node, the place to its left is on both sides of the
 * boundary that begins there. */
static void set_helpers(struct section_sweep *sweep, uint32_t node, size_t low,
                        size_t ending) {
  struct section_edge *below = low > 0 ? edge_at(sweep, low - 1) : NULL;
  sweep->helper[node] = SECTION_NONE;
  if (ending == 0 && sweep->starting.count > 0 && below != NULL &&
      below->above != SECTION_NONE)
    sweep->helper[node] = below->helper;
  if (below != NULL)
    below->helper = node;
  for (size_t i = 0; i < sweep->starting.count; i++)
    sweep->section->edge.item[sweep->starting.item[i]].helper = node;
}

/* ---- The sweep ----------------------------------------------------------- */

/* Replaces the edges from place `low` to before `high` by those that start. */
static bool replace_active_edges(struct section_sweep *sweep, size_t low,
                                 size_t high) {
  size_t count = sweep->starting.count, rest = sweep->active.count - high;
  if (!ARRAY_RESERVE(&sweep->active, count))
    return false;
  uint32_t *active = sweep->active.item;
  memmove(active + low + count, active + high, rest * sizeof *active);
  if (count > 0)
    memcpy(active + low, sweep->starting.item, count * sizeof *active);
  sweep->active.count = low + count + rest;
  return true;
}

/* Tests the pairs of neighbours that are new, from the one below place `low`
 * on. */
static bool are_neighbours_in_order(const struct section_sweep *sweep,
                                    size_t low) {
  size_t last = low + sweep->starting.count;
  for (size_t i = low > 0 ? low : 1; i <= last && i < sweep->active.count;
       i++) {
    const struct section_edge *lower = edge_at(sweep, i - 1);
    const struct section_edge *upper = edge_at(sweep, i);
    if (lower->a == upper->a && side_of(sweep, lower, upper->b) == 0)
      return false;
    if (!stays_above(sweep, lower, upper))
      return false;
  }
  return true;
}

/* Goes on to a node; the edges that start there are known. */
static recto_status visit_node(struct section_sweep *sweep, uint32_t node,
                               recto_error *error) {
  size_t low, high;
  recto_status status = RECTO_OK;
  LOWER_BOUND(low, 0, sweep->active.count,
              side_of(sweep, edge_at(sweep, low), node) > 0);
  for (high = low;
       high < sweep->active.count && edge_at(sweep, high)->b == node;)
    high++;
  if (low == high && sweep->starting.count == 0)
    return RECTO_OK; /* no edge has this node */
  if (high < sweep->active.count &&
      side_of(sweep, edge_at(sweep, high), node) == 0)
    sweep->planar = false;
  if (sweep->helper != NULL)
    set_helpers(sweep, node, low, high - low);
  else
    status = set_labels(sweep, low, error);
  if (status == RECTO_OK && !replace_active_edges(sweep, low, high))
    status = error_memory(error);
  if (status == RECTO_OK && !are_neighbours_in_order(sweep, low))
    sweep->planar = false;
  return status;
}

recto_status section_sweep(struct section *section, uint32_t *helper,
                           bool *planar, recto_error *error) {
  struct section_sweep sweep = {
      .section = section, .helper = helper, .planar = true};
  recto_status status = RECTO_OK;
  size_t next = 0;
  size_t edges = helper == NULL ? section->edge.count : section->boundaries;
  section->winding.count = helper == NULL ? 0 : section->winding.count;
  for (uint32_t n = 0;
       n < section->node.count && sweep.planar && status == RECTO_OK; n++) {
    sweep.starting.count = 0;
    for (; next < edges && section->edge.item[next].a == n; next++)
      if (!ARRAY_PUSH(&sweep.starting, (uint32_t)next))
        status = error_memory(error);
    if (status == RECTO_OK)
      status =
          poll_at(n) ? visit_node(&sweep, n, error) : error_cancelled(error);
  }
  *planar = sweep.planar && sweep.active.count == 0;
  ARRAY_FREE(&sweep.active);
  ARRAY_FREE(&sweep.starting);
  return status;
}
