/* segment_graph.h - the ink of a sheet as segments that share nodes: what is left of
 * the visible map once only lines on the page matter.
 *
 * Phases, each leaves the net ready for the next
 *   segment_graph_collect          intervals of edges become segments (segments.c)
 *   segment_graph_unite            nodes at one place become one (nodes.c)
 *   segment_graph_drop_collinear  lines drawn twice are drawn once (overlap_collinear.c)
 *   segment_graph_drop_repeats     and those that the output would make one (overlap_output.c)
 * Invariants, from segment_graph_unite on
 *   no two nodes are nearer than the tolerance; they are numbered by where
 *   they are on the page, row by row;
 *   a segment's first node is the lower one; segments stand in the order of
 *   their first nodes, then of their second ones.  So what is near on the page
 * is near in memory, and nothing depends on the order of the edges but the
 * choice between two segments that coincide. */
#ifndef INK_LINES_SEGMENT_GRAPH_H
#define INK_LINES_SEGMENT_GRAPH_H

#include "base/memory.h"
#include "visibility/map.h"

#define SEGMENT_GRAPH_NONE UINT32_MAX

struct ink_point {
  int32_t x, y; /* grid units from the middle of the page */
};

struct graph_segment {
  uint32_t node[2];
  uint32_t edge;    /* sheet edge it is a piece of */
  uint32_t pen_key; /* only segments of the same bond are ever joined; odd where
                    the segment is hidden */
  uint32_t style_key; /* class (low bits, see recto_edge_class) and group: where
                    several could be joined, those alike in this go first */
};

struct pens;

struct segment_graph {
  ARRAY(struct ink_point) node;
  ARRAY(struct graph_segment) segment;
  /* The ends at node n: end[end_start[n] .. end_start[n + 1]), ascending;
   * end e is node[e & 1] of segment e >> 1. */
  uint32_t *end_start, *end;
  /* Of each node whether it is on the lines that meet there to the output's
   * unit only; NULL: none. */
  uint8_t *approximate;
  /* How many segments had no length on the page, how many were drawn twice
   * (in whole or in part). */
  size_t dots, doubled;
};

/* Nodes by rows: horizontal bands with about as many nodes as there are rows.
 * Row r holds nodes [start[r], start[r + 1]), by x, then y; their y are in
 * [low[r], low[r + 1]). */
struct node_rows {
  uint32_t *start;
  int64_t *low;
  uint16_t *row; /* of each node */
  uint32_t count;
};

void segment_graph_init(struct segment_graph *graph);
void segment_graph_fini(struct segment_graph *graph);
void node_rows_fini(struct node_rows *rows);

/* Fills an empty net with the visible intervals of the drawable edges and,
 * where options->hidden asks, the hidden ones.  Ends at an edge's own end are
 * the sheet's point, others are rounded to the grid once.
 * Errors  RECTO_ERROR_MEMORY; RECTO_ERROR_LIMIT: 2^31 segments. */
USE_RESULT recto_status segment_graph_collect(struct segment_graph *graph,
                                              const struct sheet *sheet,
                                              const struct map *map,
                                              const struct pens *pens,
                                              const recto_options *options,
                                              recto_error *error);

/* Makes one node of those within TOLERANCE_COINCIDENT_UNITS in x and y of the
 * first in reading order, renumbers the nodes row by row, drops the segments
 * that lost their length, sorts the rest.
 * rows  zero-initialised; the caller ends it with node_rows_fini
 * Cost  linear, but for the radix sort. */
USE_RESULT recto_status segment_graph_unite(struct segment_graph *graph,
                                            struct node_rows *rows,
                                            recto_error *error);

/* Keeps of segments that lie on each other one: visible before hidden, then
 * the lower class bit, then the lower edge.  What others have beyond it
 * stays.  Indexes the ends.
 * Cost  near linear in the segments without overlap; k log k for k that lie
 *       on one line. */
USE_RESULT recto_status
segment_graph_drop_collinear(struct segment_graph *graph,
                             const struct node_rows *rows, recto_error *error);

/* How often lines that the output cannot tell apart are looked for.  What has
 * moved by a unit may be near something else: one round leaves lines twice, two
 * have left none in thousands of random drawings.  Models drawn to whole
 * millimetres have a little more to lose in a third; in later ones what they
 * lose they have again. */
#define SEGMENT_GRAPH_ROUNDS 3

/* Of lines that the output cannot tell apart keeps one, by the same rank, and
 * shrinks what has no length in it where that crowds.  Afterwards a node may
 * have no ends. Leaves the ends indexed. unit    the output's finest step, in
 * grid units; up to the tolerance of segment_graph_drop_collinear there is nothing to do
 * Cost    near linear in the segments where few repeat */
USE_RESULT recto_status segment_graph_drop_repeats(struct segment_graph *graph,
                                                   const struct node_rows *rows,
                                                   double unit,
                                                   recto_error *error);

/* Builds end_start and end. */
USE_RESULT recto_status segment_graph_index_ends(struct segment_graph *graph,
                                                 recto_error *error);

/* Restores the order of the segments. */
USE_RESULT bool segment_graph_sort_segments(struct segment_graph *graph);

/* Drops the segments i with drop[i] != 0 and indexes the ends anew.  Nodes stay;
 * some may have no ends afterwards. */
USE_RESULT recto_status segment_graph_drop_segments(struct segment_graph *graph,
                                                    const uint8_t *drop,
                                                    recto_error *error);

/* Replaces the pen keys by keys of the sources: segments have the same key
 * where they are pieces of one mesh edge, of one intersection or of one
 * polyline of the user's, and both are visible or both hidden.
 * Cost  linear in the segments and the edges of the sheet. */
USE_RESULT recto_status segment_graph_key_by_source(struct segment_graph *graph,
                                                    const struct sheet *sheet,
                                                    recto_error *error);

static inline bool
graph_segment_is_hidden(const struct graph_segment *segment) {
  return segment->pen_key & 1;
}

#endif
