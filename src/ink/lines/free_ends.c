/* free_ends.c - finds the chains of creases that end free.
 *
 * Phases
 *   1 find the ends of chains of which no other segment ends at the node, and
 *     which are vertices of the mesh
 *   2 count the drawable edges, visible or not, at these vertices
 *   3 an end is free where there is one
 * Where something hides the rest of a line, or the page or a cut ends it, it
 * goes on in the model, and that end is not free.  So a closed network of
 * lines, as the edges of a solid are, has no free ends, whatever is seen of
 * it. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/lines/crease_lines.h"

/* Classes of lines of which a chain may be a speckle. */
static const unsigned inner_classes = RECTO_EDGE_CREASE | RECTO_EDGE_GROUP;

/* What the ranges of paths have in common. */
struct free_end_search {
  struct ink_paths *paths;
  const struct segment_graph *graph;
  const struct sheet *sheet;
  double near;         /* how far a node may be from a vertex, grid units */
  atomic_uchar *at;    /* one a sheet point: see crease_ends_count */
  atomic_bool any_may; /* end free */
};

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

/* The vertex at an end of a chain where no other segment ends; SHEET_NONE:
 * there is none. */
static uint32_t vertex_of_end(const struct free_end_search *search,
                              uint32_t end) {
  const struct segment_graph *graph = search->graph;
  const struct sheet *sheet = search->sheet;
  const struct graph_segment *s = &graph->segment.item[end >> 1];
  uint32_t node = s->node[end & 1];
  struct ink_point at = graph->node.item[node];
  double near = search->near;
  if (graph->ends.start[node + 1] - graph->ends.start[node] > 1)
    return SHEET_NONE;
  for (int k = 0; k < 2; k++) {
    uint32_t point = sheet->edge.item[s->edge].point[k];
    const struct geom_point *p = &sheet->point.item[point];
    if (fabs((double)p->x - at.x) <= near && fabs((double)p->y - at.y) <= near)
      return point < sheet->vertex_count ? point : SHEET_NONE;
  }
  return SHEET_NONE; /* within an edge */
}

static bool find_candidates_of_range(void *user, struct parallel_range range) {
  struct free_end_search *search = user;
  bool any = false;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &search->paths->path.item[i];
    path->is_free = may_end_free(search->graph, path);
    for (int k = 0; k < 2 && path->is_free; k++) {
      uint32_t vertex = vertex_of_end(search, path->end[k]);
      if (vertex == SHEET_NONE)
        continue;
      atomic_store_explicit(&search->at[vertex], CREASE_END,
                            memory_order_relaxed);
      any = true;
    }
  }
  if (any)
    atomic_store(&search->any_may, true);
  return true;
}

static bool is_free_end(const struct free_end_search *search, uint32_t end) {
  uint32_t vertex = vertex_of_end(search, end);
  return vertex != SHEET_NONE && search->at[vertex] == CREASE_END_ALONE;
}

static bool test_ends_of_range(void *user, struct parallel_range range) {
  const struct free_end_search *search = user;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &search->paths->path.item[i];
    path->is_free = path->is_free && (is_free_end(search, path->end[0]) ||
                                      is_free_end(search, path->end[1]));
  }
  return true;
}

bool paths_find_free_ends(struct ink_paths *paths,
                          const struct segment_graph *graph,
                          const struct sheet *sheet, const uint8_t *dropped,
                          double output_step) {
  size_t count = paths->path.count;
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  struct free_end_search search = {
      .paths = paths,
      .graph = graph,
      .sheet = sheet,
      .near = output_step + 2 * TOLERANCE_COINCIDENT_UNITS,
      .at = mem_calloc(sheet->point.count, sizeof *search.at)};
  bool ok =
      search.at != NULL && parallel_ranges(workers, count, PARALLEL_ITEMS,
                                           find_candidates_of_range, &search);
  if (ok && search.any_may)
    ok = crease_ends_count(sheet, dropped, search.at);
  ok = ok && parallel_ranges(workers, count, PARALLEL_ITEMS, test_ends_of_range,
                             &search);
  mem_free((void *)search.at);
  return ok;
}
