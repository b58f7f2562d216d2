/* section_loops.c - traces the boundaries of the places of a section.
 *
 * Half-edge 2 e runs along edge e from a to b, with the place above it on its
 * left, half-edge 2 e + 1 the other way.  Bridges are edges too.  At the end of
 * a half-edge the next one of its place is the one that comes first clockwise
 * from where it came from.  As bridges join the parts of its boundary, a place
 * has one. */
#include "base/sort.h"
#include "cut/section_phases.h"

struct tracer {
  struct section *section;
  size_t half_edges;
  uint32_t *order; /* half-edges by the nodes from which they run, then counter-
                      clockwise */
  uint32_t *place; /* of each half-edge, in the order */
  uint32_t *start; /* of each node, in the order */
};

static uint32_t node_from(const struct section *section, uint32_t half) {
  const struct section_edge *edge = &section->edge.item[half / 2];
  return half % 2 == 0 ? edge->a : edge->b;
}

static uint32_t label_on_left(const struct section *section, uint32_t half) {
  const struct section_edge *edge = &section->edge.item[half / 2];
  return half % 2 == 0 ? edge->above : edge->below;
}

/* Counter-clockwise about the node from which both run, from straight down:
 * those that run to later nodes come first. */
static int compare_half_edges(const void *a, const void *b, void *user) {
  const struct section *section = user;
  uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  uint32_t from = node_from(section, p), other = node_from(section, q);
  if (from != other)
    return from < other ? -1 : 1;
  if (p % 2 != q % 2)
    return p % 2 < q % 2 ? -1 : 1;
  const struct section_node *node = section->node.item;
  return -section_side(&node[from], &node[node_from(section, p ^ 1)],
                       &node[node_from(section, q ^ 1)]);
}

/* Adds the bridges to the boundaries; other edges are given up. */
static bool add_bridges(struct section *section, const uint32_t *helper) {
  section->edge.count = section->boundaries;
  /* The place of a bridge is below the first edge that starts at its node. */
  for (size_t e = 0; e < section->boundaries; e++) {
    const struct section_edge *edge = &section->edge.item[e];
    uint32_t node = edge->a;
    if ((e > 0 && section->edge.item[e - 1].a == node) ||
        helper[node] == SECTION_NONE)
      continue;
    const struct section_edge bridge = {.a = helper[node],
                                        .b = node,
                                        .below = edge->below,
                                        .above = edge->below};
    if (!ARRAY_PUSH(&section->edge, bridge))
      return false;
  }
  return true;
}

static bool sort_half_edges(struct tracer *tracer) {
  struct section *section = tracer->section;
  size_t count = tracer->half_edges, nodes = section->node.count;
  tracer->order = mem_alloc(count, sizeof *tracer->order);
  tracer->place = mem_alloc(count, sizeof *tracer->place);
  tracer->start = mem_alloc(nodes + 1, sizeof *tracer->start);
  if (tracer->order == NULL || tracer->place == NULL || tracer->start == NULL)
    return false;
  for (size_t h = 0; h < count; h++)
    tracer->order[h] = (uint32_t)h;
  if (!sort_stable(tracer->order, count, sizeof *tracer->order,
                   compare_half_edges, section))
    return false;
  uint32_t next = 0;
  for (uint32_t i = 0; i < count; i++) {
    tracer->place[tracer->order[i]] = i;
    for (; next <= node_from(section, tracer->order[i]); next++)
      tracer->start[next] = i;
  }
  for (; next <= nodes; next++)
    tracer->start[next] = (uint32_t)count;
  return true;
}

static uint32_t next_half_edge(const struct tracer *tracer, uint32_t half) {
  uint32_t twin = half ^ 1;
  uint32_t node = node_from(tracer->section, twin);
  uint32_t place = tracer->place[twin];
  return tracer
      ->order[place > tracer->start[node] ? place - 1
                                          : tracer->start[node + 1] - 1];
}

bool section_trace(struct section *section, const uint32_t *helper) {
  section->corner.count = section->loop.count = 0;
  if (!add_bridges(section, helper))
    return false;
  struct tracer tracer = {.section = section,
                          .half_edges = 2 * section->edge.count};
  uint8_t *done = mem_calloc(tracer.half_edges, sizeof *done);
  bool ok = done != NULL && sort_half_edges(&tracer);
  for (uint32_t h = 0; ok && h < tracer.half_edges; h++) {
    struct section_loop loop = {(uint32_t)section->corner.count, 0,
                                label_on_left(section, h)};
    if (done[h] || loop.label == SECTION_NONE)
      continue;
    for (uint32_t at = h; ok && !done[at]; at = next_half_edge(&tracer, at)) {
      done[at] = 1;
      ok = ARRAY_PUSH(&section->corner, node_from(section, at));
    }
    loop.count = (uint32_t)section->corner.count - loop.corner;
    ok = ok && ARRAY_PUSH(&section->loop, loop);
  }
  mem_free(done);
  mem_free(tracer.order);
  mem_free(tracer.place);
  mem_free(tracer.start);
  return ok;
}
