/* segment_graph.h - the lines of a sheet as segments that share nodes.
 *
 * Phases, each of which leaves the graph ready for the next
 *   segment_graph_collect               intervals of edges become segments
 *                                       (segments.c)
 *   segment_graph_unite                 nodes at one position are merged
 *                                       (nodes.c)
 *   segment_graph_separate_isolated     segments without any other node near
 *                                       them take no part in what follows
 *                                       (isolated.c)
 *   segment_graph_drop_collinear        collinear overlaps are drawn once
 *                                       (overlap_collinear.c)
 *   segment_graph_drop_output_overlaps  overlaps at the output's precision are
 *                                       drawn once (overlap_output.c)
 *   segment_graph_merge_isolated        all segments are together again
 *   segment_graph_close_gaps            gaps less than half a pen are closed,
 *                                       unless the drawing is to be exact
 *                                       (gaps.c)
 * Unless it is, overlaps are dropped at one precision for all outputs, and in
 * the end once more where the output's is coarser.
 * Invariants, from segment_graph_unite on
 *   Two nodes differ in x or in y by more than the tolerance; they are numbered
 *   by position, row by row.
 *   A segment's first node has the lower number; segments are sorted by first,
 *   then by second node.  So what is near on the page is near in memory, and
 *   the order of the edges decides nothing except which of two coinciding
 *   segments is kept. */
#ifndef INK_LINES_SEGMENT_GRAPH_H
#define INK_LINES_SEGMENT_GRAPH_H

#include <stdatomic.h>

#include "base/memory.h"
#include "base/number_lists.h"
#include "visibility/map.h"

#define SEGMENT_GRAPH_NONE UINT32_MAX

/* The classes whose lines are tidied as a pen draws them: not the user's own
 * lines, and not all edges of a mesh. */
#define SEGMENT_GRAPH_FEATURES                                                 \
  (RECTO_EDGES_ALL & ~(unsigned)(RECTO_EDGE_WIRE | RECTO_EDGE_SMOOTH))

struct ink_point {
  int32_t x, y; /* grid units from the middle of the page */
};

struct graph_segment {
  uint32_t node[2];
  uint32_t edge;      /* the sheet edge that it is a piece of */
  uint32_t pen_key;   /* only segments with equal keys are joined; odd: the
                       segment is hidden */
  uint32_t style_key; /* class (low bits, see recto_edge_class) and group:
                         where several segments could be joined, those with
                         equal style keys are preferred */
};

struct graph_segments {
  struct graph_segment *item;
  size_t count, capacity;
};

struct pens;
struct crease_lines;

struct segment_graph {
  ARRAY(struct ink_point) node;
  struct graph_segments segment;
  /* Those that were set apart: sorted, not in `segment`. */
  struct graph_segments isolated;
  /* One a node: it is near a segment that does not end there; NULL: unknown. */
  atomic_uchar *near_segment;
  /* Whether some were marked so since isolated segments were looked through. */
  atomic_bool near_is_new;
  /* One a segment: whether a search by segment_graph_separate_isolated found
   * nodes near it; NULL: unknown, since segments have changed. */
  uint8_t *has_near;
  /* The ends at each node, ascending; end e is node[e & 1] of segment
   * e >> 1. */
  struct number_lists ends;
  /* One a node: not 0 where the node lies on the lines that meet there only up
   * to the output's step; NULL: no such nodes. */
  uint8_t *approximate;
  /* The numbers of segments without length on the page and of segments that
   * were drawn twice in whole or in part. */
  size_t dots, doubled;
  /* The ends of the segments that segment_graph_close_gaps added, in pairs. */
  ARRAY(struct ink_point) gap_end;
  /* Those segments, sorted; or those that segment_graph_set_gaps_apart took
   * from `segment`. */
  struct graph_segments gap;
};

/* Nodes by rows, which are horizontal bands, about as many as there are nodes
 * in each.  Row r holds the nodes [start[r], start[r + 1]), sorted by x, then
 * y; their y are in [low[r], low[r + 1]). */
struct node_rows {
  uint32_t *start;
  int64_t *low;
  uint16_t *row; /* of each node */
  uint32_t count;
};

void segment_graph_init(struct segment_graph *graph);
void segment_graph_fini(struct segment_graph *graph);
void node_rows_fini(struct node_rows *rows);

/* Fills an empty graph with the visible intervals of the drawable edges, and
 * the hidden ones if options->ink.hidden requests them.  An end of an interval
 * at an end of the edge is the sheet's point; others are rounded to the grid
 * once.  Segments without length are counted in dots.
 * Errors  RECTO_ERROR_MEMORY; RECTO_ERROR_LIMIT: 2^31 segments. */
USE_RESULT recto_status segment_graph_collect(struct segment_graph *graph,
                                              const struct sheet *sheet,
                                              const struct map *map,
                                              const struct pens *pens,
                                              const recto_options *options,
                                              recto_error *error);

/* Merges the nodes within TOLERANCE_COINCIDENT_UNITS in x and in y of the first
 * of them in reading order, renumbers the nodes row by row, removes the
 * segments that lost their length, and sorts the others.
 * rows  zero-initialised; the caller frees it with node_rows_fini
 * Cost  linear, apart from the radix sort. */
USE_RESULT recto_status segment_graph_unite(struct segment_graph *graph,
                                            struct node_rows *rows,
                                            recto_error *error);

/* Moves to `isolated` the segments that can overlap no other one: they have no
 * node near them but their own, and no other segment has one of these near it
 * or the same ends.
 * output_step  as of segment_graph_drop_output_overlaps
 * Errors  RECTO_ERROR_MEMORY
 * Cost    near linear; the search runs in parallel */
USE_RESULT recto_status segment_graph_separate_isolated(
    struct segment_graph *graph, const struct node_rows *rows,
    double output_step, recto_error *error);

/* Marks the nodes near a segment, except its own, in near_segment; returns
 * whether there are any. */
bool segment_graph_mark_near_nodes(struct segment_graph *graph,
                                   const struct node_rows *rows, int32_t near,
                                   uint32_t segment);

/* Moves isolated segments to the end of `taken`: those with an end that is
 * marked in near_segment.  Returns false when memory ran out.
 * Cost  linear in the isolated segments, in parallel; none where no node was
 *       marked since the last time */
USE_RESULT bool segment_graph_take_isolated(struct segment_graph *graph,
                                            struct graph_segments *taken);

/* Moves all isolated segments back, and indexes the ends. */
USE_RESULT recto_status
segment_graph_merge_isolated(struct segment_graph *graph, recto_error *error);

/* Of collinear segments that overlap, keeps one along the overlap: visible
 * before hidden, then the lower class bit, then the lower edge.  The rest of
 * the others stays.  Indexes the ends.
 * Cost  near linear in the segments without overlap; k log k for k on one line.
 *       */
USE_RESULT recto_status
segment_graph_drop_collinear(struct segment_graph *graph,
                             const struct node_rows *rows, recto_error *error);

/* The rounds of segment_graph_drop_output_overlaps.  What has moved by a step
 * may come near something else: after one round some lines are still drawn
 * twice; after two, none were in thousands of random drawings.  Models drawn to
 * whole millimetres lose a little more in a third round; later rounds only
 * alternate. */
#define SEGMENT_GRAPH_ROUNDS 3

/* Of lines that round to the same output, keeps one, by the same priority, and
 * contracts segments without length at that precision where many nodes are near
 * each other.  Afterwards a node may have no ends.  Leaves the ends indexed.
 * output_step  the output's finest step, in grid units; up to the tolerance of
 *       segment_graph_drop_collinear there is nothing to do
 * Cost  near linear in the segments if few overlap. */
USE_RESULT recto_status segment_graph_drop_output_overlaps(
    struct segment_graph *graph, const struct node_rows *rows,
    double output_step, recto_error *error);

/* Joins two visible ends of equal pen key and class by a segment where they are
 * at most half a pen apart, each is the nearest such end to the other and the
 * only one at its node, and the lines do not turn back there.
 * Errors  RECTO_ERROR_MEMORY
 * Cost    linear, and for each end that is alone at its node the nodes that its
 *         row and those beside it have as near as the nearest such end */
USE_RESULT recto_status segment_graph_close_gaps(struct segment_graph *graph,
                                                 const struct node_rows *rows,
                                                 const struct pens *pens,
                                                 recto_error *error);

/* Moves the segments that close gaps from `segment` to `gap`: they follow their
 * nodes while overlaps are dropped, and are none themselves.  `segment` is then
 * not indexed. */
void segment_graph_set_gaps_apart(struct segment_graph *graph);

/* Lets those that were set apart follow their nodes.
 * root  what each node is merged into */
void segment_graph_move_gaps(struct segment_graph *graph, const uint32_t *root);

/* Moves those back that are gaps still, between two ends that are the only ones
 * at their nodes, and indexes the ends, which are indexed without them. */
USE_RESULT recto_status segment_graph_merge_gaps(struct segment_graph *graph,
                                                 recto_error *error);

/* Lists the ends at each node.  The segments are sorted. */
USE_RESULT recto_status segment_graph_index_ends(struct segment_graph *graph,
                                                 recto_error *error);

/* Sorts the segments again by first, then by second node; equal ones keep their
 * order. */
USE_RESULT bool segment_graph_sort_segments(struct segment_graph *graph);

/* Adds sorted segments to others that are sorted too, of equal ones behind
 * these.  Returns false when memory ran out. */
USE_RESULT bool graph_segments_merge(struct graph_segments *to,
                                     const struct graph_segments *from);

/* Moves the segments i of `from` with flag[i] == 1 to the end of `taken`, or
 * drops them where that is NULL; flags are 0 or 1.  Those that are left keep
 * their order.  Returns false when memory ran out. */
USE_RESULT bool graph_segments_take(struct graph_segments *from,
                                    const uint8_t *flag,
                                    struct graph_segments *taken);

/* Drops the segments i with drop[i] != 0 and indexes the ends anew.  Nodes
 * stay; some may have no ends afterwards. */
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

/* The most groups that segment_graph_key_by_group tells apart. */
enum { SEGMENT_GRAPH_GROUPS_MAX = 1 << 17 };

/* Makes the pen keys of lines of different groups differ, of which there are at
 * most SEGMENT_GRAPH_GROUPS_MAX. */
void segment_graph_key_by_group(struct segment_graph *graph,
                                const struct sheet *sheet);

static inline bool
graph_segment_is_hidden(const struct graph_segment *segment) {
  return segment->pen_key & 1;
}

/* The segment with the lower node first. */
static inline struct graph_segment
graph_segment_sorted(struct graph_segment segment) {
  uint32_t a = segment.node[0], b = segment.node[1];
  segment.node[0] = a < b ? a : b;
  segment.node[1] = a < b ? b : a;
  return segment;
}

/* Of creases: the angle; that by which one that ends free bends somewhere, 0:
 * none need; and one that is a zigzag. */
struct crease_angles {
  double crease_deg, start_deg, zigzag_deg;
};

/* Sets drop[i] of the segments i of creases whose line on the mesh is speckled:
 * more than half of its length is in pieces shorter than the shortest crease
 * that may end free (pens_shortest_crease_mm), where a piece ends at ends,
 * branches and turns of more than 45 degrees; one in 16 pieces or more ends
 * free; and the mean angle of its faces is not above that for zigzags.
 * drop  one a segment, 0
 * Returns false when memory ran out.  Cost: linear in the edges */
USE_RESULT bool segment_graph_find_speckled(const struct segment_graph *graph,
                                            struct crease_lines *creases,
                                            const struct pens *pens,
                                            const struct crease_angles *angles,
                                            uint8_t *drop);

/* Sets drop[i] of the visible segments i of creases that close a cycle of
 * visible segments on the page which is no longer than three of the shortest
 * creases that may end free (pens_shortest_crease_mm), and are themselves
 * shorter than one; those of cycles' least sharp sides.  Creases whose line
 * ends nowhere free on the mesh stay.
 * drop  one a segment, 0
 * Returns false when memory ran out.
 * Cost  n log n; the search for a cycle ends after 32 nodes */
USE_RESULT bool segment_graph_find_short_cycles(
    const struct segment_graph *graph, struct crease_lines *creases,
    const struct pens *pens, const struct crease_angles *angles, uint8_t *drop);

#endif
