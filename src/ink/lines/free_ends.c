/* free_ends.c - finds the chains of creases that end free.
 *
 * Phases
 *   1 count the drawable edges, visible or not, at each vertex of the mesh
 *   2 an end of a chain is free where no other segment ends at its node, and
 *     which is a vertex with one drawable edge
 * Where something hides the rest of a line, or the page or a cut ends it, it
 * goes on in the model, and that end is not free.  So a closed network of
 * lines, as the edges of a solid are, has no free ends, whatever is seen of
 * it. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/poll.h"
#include "base/tolerance.h"

/* Classes of lines of which a chain may be a speckle. */
static const unsigned inner_classes = RECTO_EDGE_CREASE | RECTO_EDGE_GROUP;

/* The number of drawable edges at each vertex that were not dropped, up to 2;
 * NULL when memory ran out. */
static uint8_t *count_edges_at_vertices(const struct sheet *sheet,
                                        const uint8_t *dropped) {
  uint8_t *count = mem_calloc(sheet->point.count, sizeof *count);
  for (size_t e = 0; count != NULL && e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    (void)poll_at(e);
    for (int k = 0;
         k < 2 && edge->edge_class != 0 && (dropped == NULL || !dropped[e]);
         k++)
      count[edge->point[k]] =
          (uint8_t)(count[edge->point[k]] + (count[edge->point[k]] < 2));
  }
  return count;
}

/* Whether the path bounds nothing on the page and has an end to itself. */
static bool may_end_free(const struct segment_graph *graph,
                         const struct ink_path *path) {
  bool alone = false;
  for (int k = 0; k < 2 && !path->closed; k++) {
    uint32_t end = path->end[k];
    uint32_t node = graph->segment.item[end >> 1].node[end & 1];
    alone = alone || graph->ends.start[node + 1] - graph->ends.start[node] == 1;
  }
  return alone && (path->classes & ~inner_classes) == 0;
}

/* Whether an end of a chain is free.
 * near   how far its node may be from the vertex, grid units
 * count  of the drawable edges at each sheet point */
static bool is_free_end(const struct segment_graph *graph,
                        const struct sheet *sheet, uint32_t end, double near,
                        const uint8_t *count) {
  const struct graph_segment *s = &graph->segment.item[end >> 1];
  uint32_t node = s->node[end & 1];
  struct ink_point at = graph->node.item[node];
  if (graph->ends.start[node + 1] - graph->ends.start[node] > 1)
    return false;
  for (int k = 0; k < 2; k++) {
    uint32_t point = sheet->edge.item[s->edge].point[k];
    const struct geom_point *p = &sheet->point.item[point];
    if (fabs((double)p->x - at.x) <= near && fabs((double)p->y - at.y) <= near)
      return point < sheet->vertex_count && count[point] == 1;
  }
  return false; /* within an edge */
}

bool paths_find_free_ends(struct ink_paths *paths,
                          const struct segment_graph *graph,
                          const struct sheet *sheet, const uint8_t *dropped,
                          double output_step) {
  double near = output_step + 2 * TOLERANCE_COINCIDENT_UNITS;
  uint8_t *count = NULL;
  bool ok = true;
  for (size_t i = 0; ok && i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    if (!may_end_free(graph, path))
      continue;
    if (count == NULL)
      count = count_edges_at_vertices(sheet, dropped);
    ok = count != NULL;
    path->is_free =
        ok && (is_free_end(graph, sheet, path->end[0], near, count) ||
               is_free_end(graph, sheet, path->end[1], near, count));
  }
  mem_free(count);
  return ok;
}
