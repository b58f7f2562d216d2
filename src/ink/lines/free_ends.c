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

#include "base/parallel.h"
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

/* What the ranges of paths have in common. */
struct free_end_search {
  struct ink_paths *paths;
  const struct segment_graph *graph;
  const struct sheet *sheet;
  double near;
  uint8_t *count;      /* see is_free_end */
  atomic_bool any_may; /* end free */
};

static bool find_candidates_of_range(void *user, struct parallel_range range) {
  struct free_end_search *search = user;
  bool any = false;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &search->paths->path.item[i];
    path->is_free = may_end_free(search->graph, path);
    any = any || path->is_free;
  }
  if (any)
    atomic_store(&search->any_may, true);
  return true;
}

static bool test_ends_of_range(void *user, struct parallel_range range) {
  const struct free_end_search *s = user;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &s->paths->path.item[i];
    path->is_free =
        path->is_free &&
        (is_free_end(s->graph, s->sheet, path->end[0], s->near, s->count) ||
         is_free_end(s->graph, s->sheet, path->end[1], s->near, s->count));
  }
  return true;
}

bool paths_find_free_ends(struct ink_paths *paths,
                          const struct segment_graph *graph,
                          const struct sheet *sheet, const uint8_t *dropped,
                          double output_step) {
  size_t count = paths->path.count;
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  struct free_end_search search = {.paths = paths,
                                   .graph = graph,
                                   .sheet = sheet,
                                   .near = output_step +
                                           2 * TOLERANCE_COINCIDENT_UNITS};
  if (!parallel_ranges(workers, count, PARALLEL_ITEMS, find_candidates_of_range,
                       &search))
    return false;
  if (!atomic_load(&search.any_may))
    return true;
  search.count = count_edges_at_vertices(sheet, dropped);
  bool ok =
      search.count != NULL && parallel_ranges(workers, count, PARALLEL_ITEMS,
                                              test_ends_of_range, &search);
  mem_free(search.count);
  return ok;
}
