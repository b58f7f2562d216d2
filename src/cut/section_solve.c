/* section_solve.c - the phases by which the cut faces in one plane are found.
 *
 *   nodes    are sorted by (u, v); those at one place become one.
 *   edges    of the segments, or where these cross of their parts (snap
 *            rounding): lines between the same two nodes are one edge.
 *   labels   of the places on both sides of each edge, by a sweep; edges that
 *            are found to cross send it back to the phase before.
 *   bridges  by a second sweep, over the edges with different places beside
 *            them.
 *   trace    walks along these. */
#include "cut/section.h"

#include <math.h>

#include "base/sort.h"
#include "cut/section_phases.h"

/* ---- Edges --------------------------------------------------------------- */

static bool add_section_line(struct section *section, uint32_t from,
                             uint32_t to,
                             const struct section_segment *segment) {
  struct section_line line = {from, to, segment->label, segment->weight};
  if (from > to)
    line = (struct section_line){to, from, segment->label, -segment->weight};
  return from == to || ARRAY_PUSH(&section->line, line);
}

static bool make_section_lines(struct section *section) {
  section->line.count = 0;
  for (size_t s = 0; s < section->segment.count; s++) {
    const struct section_segment *segment = &section->segment.item[s];
    if (section->path_start.count == 0) {
      if (!add_section_line(section, segment->from, segment->to, segment))
        return false;
      continue;
    }
    const uint32_t *path = section->path.item;
    for (uint32_t i = section->path_start.item[s] + 1;
         i < section->path_start.item[s + 1]; i++)
      if (!add_section_line(section, path[i - 1], path[i], segment))
        return false;
  }
  return true;
}

/* By their first nodes, then upwards, then by their labels. */
static int compare_section_lines(const void *a, const void *b, void *user) {
  const struct section_line *p = a, *q = b;
  const struct section_node *node = user;
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  int side = section_side(&node[p->a], &node[p->b], &node[q->b]);
  if (side != 0)
    return -side;
  if (p->b != q->b)
    return p->b < q->b ? -1 : 1;
  return p->label != q->label ? (p->label < q->label ? -1 : 1) : 0;
}

static bool make_section_edges(struct section *section) {
  const struct section_line *line = section->line.item;
  section->edge.count = 0;
  if (!make_section_lines(section))
    return false;
  line = section->line.item;
  if (!sort_stable(section->line.item, section->line.count, sizeof *line,
                   compare_section_lines, section->node.item))
    return false;
  for (size_t i = 0, next; i < section->line.count; i = next) {
    for (next = i + 1; next < section->line.count &&
                       line[next].a == line[i].a && line[next].b == line[i].b;)
      next++;
    const struct section_edge edge = {.a = line[i].a,
                                      .b = line[i].b,
                                      .line = (uint32_t)i,
                                      .lines = (uint32_t)(next - i)};
    if (!ARRAY_PUSH(&section->edge, edge))
      return false;
  }
  return true;
}

/* ---- Labels -------------------------------------------------------------- */

/* The area that the lines of each label enclose, from the first node. */
static bool measure_labels(struct section *section, uint32_t labels) {
  const struct section_node *node = section->node.item;
  section->area = mem_calloc(labels, sizeof *section->area);
  if (section->area == NULL)
    return false;
  for (size_t s = 0; s < section->segment.count; s++) {
    const struct section_segment *segment = &section->segment.item[s];
    const struct section_node *a = &node[segment->from],
                              *b = &node[segment->to];
    section->area[segment->label] +=
        segment->weight * ((double)(a->u - node->u) * (double)(b->v - node->v) -
                           (double)(b->u - node->u) * (double)(a->v - node->v));
  }
  for (uint32_t i = 0; i < labels; i++)
    section->area[i] = fabs(section->area[i]);
  return true;
}

/* Finds the labels beside the edges of the segments, which are split where they
 * cross.  Rounding the parts may, in theory, make others touch. */
static recto_status label_edges(struct section *section, recto_error *error) {
  enum { ROUNDS = 4 };
  bool planar = false;
  recto_status status = RECTO_OK;
  for (int round = 0; status == RECTO_OK && round < ROUNDS && !planar;
       round++) {
    if (round > 0)
      status = section_snap(section, error);
    if (status == RECTO_OK && !make_section_edges(section))
      status = error_memory(error);
    if (status == RECTO_OK)
      status = section_sweep(section, NULL, &planar, error);
  }
  if (status == RECTO_OK && !planar)
    status = error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                       "the lines of a cut cross each other in places too "
                       "close to separate");
  return status;
}

/* Edges within a place come last.  Returns false when memory ran out. */
static bool move_boundaries_first(struct section *section) {
  size_t count = section->edge.count, kept = 0, within = 0;
  struct section_edge *edge = section->edge.item;
  struct section_edge *rest = mem_alloc(count, sizeof *rest);
  if (rest == NULL)
    return false;
  for (size_t e = 0; e < count; e++)
    if (edge[e].below != edge[e].above)
      edge[kept++] = edge[e];
    else
      rest[within++] = edge[e];
  for (size_t e = 0; e < within; e++)
    edge[kept + e] = rest[e];
  section->boundaries = kept;
  mem_free(rest);
  return true;
}

recto_status section_solve(struct section *section, uint32_t labels,
                           recto_error *error) {
  if (section->segment.count == 0)
    return RECTO_OK;
  if (!measure_labels(section, labels))
    return error_memory(error);
  recto_status status = label_edges(section, error);
  if (status != RECTO_OK)
    return status;
  bool planar;
  uint32_t *helper = mem_alloc(section->node.count, sizeof *helper);
  if (helper == NULL || !move_boundaries_first(section)) {
    mem_free(helper);
    return error_memory(error);
  }
  status = section_sweep(section, helper, &planar, error);
  if (status == RECTO_OK && !section_trace(section, helper))
    status = error_memory(error);
  mem_free(helper);
  return status;
}
