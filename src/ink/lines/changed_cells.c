/* changed_cells.c - the cells of a grid over the page in which segments have
 * changed. */
#include "ink/lines/changed_cells.h"

/* Of a longer box not all cells are tried. */
enum { CELLS_TRIED_MAX = 64 };

/* Cells along x and y, from first to last, at most all. */
struct cell_box {
  uint32_t first[2], count[2];
};

static uint32_t cell_at_coordinate(int64_t at) {
  return (uint32_t)((at + INT32_MAX) >> CHANGED_CELLS_SHIFT);
}

static void set_cell_span(struct cell_box *box, int axis, int32_t a, int32_t b,
                          int32_t near) {
  uint32_t first = cell_at_coordinate((int64_t)(a < b ? a : b) - near);
  uint32_t count =
      cell_at_coordinate((int64_t)(a < b ? b : a) + near) - first + 1;
  box->first[axis] = first;
  box->count[axis] = count < CHANGED_CELLS_SIDE ? count : CHANGED_CELLS_SIDE;
}

static struct cell_box box_of_segment(const struct segment_graph *graph,
                                      const struct graph_segment *segment,
                                      int32_t near) {
  struct ink_point p = graph->node.item[segment->node[0]];
  struct ink_point q = graph->node.item[segment->node[1]];
  struct cell_box box;
  set_cell_span(&box, 0, p.x, q.x, near);
  set_cell_span(&box, 1, p.y, q.y, near);
  return box;
}

void changed_cells_mark(struct changed_cells *cells,
                        const struct segment_graph *graph,
                        const struct graph_segment *segment, int32_t near) {
  struct cell_box box = box_of_segment(graph, segment, near);
  for (uint32_t y = 0; y < box.count[1]; y++)
    for (uint32_t x = 0; x < box.count[0]; x++)
      cells->is_marked[(box.first[1] + y) % CHANGED_CELLS_SIDE]
                      [(box.first[0] + x) % CHANGED_CELLS_SIDE] = 1;
}

bool changed_cells_have(const struct changed_cells *cells,
                        const struct segment_graph *graph,
                        const struct graph_segment *segment) {
  struct cell_box box = box_of_segment(graph, segment, 0);
  if (box.count[0] * box.count[1] > CELLS_TRIED_MAX)
    return true;
  for (uint32_t y = 0; y < box.count[1]; y++)
    for (uint32_t x = 0; x < box.count[0]; x++)
      if (cells->is_marked[(box.first[1] + y) % CHANGED_CELLS_SIDE]
                          [(box.first[0] + x) % CHANGED_CELLS_SIDE])
        return true;
  return false;
}
