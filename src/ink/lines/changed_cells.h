/* changed_cells.h - the cells of a grid over the page in which segments have
 * changed.
 *
 * A search for pairs of segments that are near each other, after one that found
 * none but those that have changed since, need only try segments that are in
 * these cells. */
#ifndef INK_LINES_CHANGED_CELLS_H
#define INK_LINES_CHANGED_CELLS_H

#include "ink/lines/segment_graph.h"

/* A cell is 2^20 grid units wide, a millimetre.  Columns, and rows, that are
 * CHANGED_CELLS_SIDE apart share their cells: no page is too large, and what is
 * tried in vain costs time only. */
enum { CHANGED_CELLS_SHIFT = 20, CHANGED_CELLS_SIDE = 256 };

struct changed_cells {
  uint8_t is_marked[CHANGED_CELLS_SIDE][CHANGED_CELLS_SIDE];
};

/* Marks the cells within `near` grid units of the box of a segment. */
void changed_cells_mark(struct changed_cells *cells,
                        const struct segment_graph *graph,
                        const struct graph_segment *segment, int32_t near);

/* Whether a cell of the box of a segment is marked; true if it has many. */
bool changed_cells_have(const struct changed_cells *cells,
                        const struct segment_graph *graph,
                        const struct graph_segment *segment);

#endif
