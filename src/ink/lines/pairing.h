/* pairing.h - decides which of the ends that meet at a node are joined. */
#ifndef INK_LINES_PAIRING_H
#define INK_LINES_PAIRING_H

#include "ink/lines/segment_graph.h"

/* Pairs the ends at every node of an indexed graph; see paths_chain.
 * mate  one an end: the end that it is joined to, or SEGMENT_GRAPH_NONE
 * Cost  linear; v log v at a node with v ends. */
USE_RESULT bool pairing_find(uint32_t *mate, const struct segment_graph *graph);

#endif
