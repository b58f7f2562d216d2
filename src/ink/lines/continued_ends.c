/* continued_ends.c - finds the hidden lines that continue visible ones. */
#include "base/poll.h"
#include "ink/lines/paths.h"
#include "ink/lines/stroke.h"

/* The point of an end of a segment, grid units. */
static struct drawing_point position_of_end(const struct segment_graph *graph,
                                            uint32_t end) {
  uint32_t node = graph->segment.item[end >> 1].node[end & 1];
  struct ink_point p = graph->node.item[node];
  return (struct drawing_point){p.x, p.y};
}

/* Whether a visible segment leaves the end's node in the opposite direction. */
static bool is_continued_end(const struct segment_graph *graph, uint32_t end) {
  uint32_t node = graph->segment.item[end >> 1].node[end & 1];
  struct drawing_point here = position_of_end(graph, end);
  struct drawing_point ahead = position_of_end(graph, end ^ 1);
  for (uint32_t i = graph->ends.start[node]; i < graph->ends.start[node + 1];
       i++) {
    uint32_t other = graph->ends.item[i];
    if (!graph_segment_is_hidden(&graph->segment.item[other >> 1]) &&
        !stroke_turns_sharply(position_of_end(graph, other ^ 1), here, ahead))
      return true;
  }
  return false;
}

void paths_find_continued(struct ink_paths *paths,
                          const struct segment_graph *graph) {
  for (size_t i = 0; i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    (void)poll_at(i);
    for (int k = 0; k < 2 && path->hidden && !path->closed; k++)
      path->is_continued[k] = is_continued_end(graph, path->end[k]);
  }
}
