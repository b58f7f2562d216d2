/* short_spurs.h - short silhouettes and creases within the picture that lead
 * nowhere. */
#ifndef INK_LINES_SHORT_SPURS_H
#define INK_LINES_SHORT_SPURS_H

#include "ink/lines/segment_graph.h"

/* Sets drop[i] of the visible segments i of silhouettes of the mesh in chains
 * that begin at a loose end, end where other lines meet them or at another
 * loose end, and on which no other line ends; that have a loose end which no
 * other line is within half a pen of, and are shorter than the shortest crease
 * that may end free (pens_shortest_crease_mm); or of which that is so of both
 * ends, and which are shorter than pens_shortest_isolated_mm.  So none is part
 * of the picture's outline.
 * Creases in chains with two such ends are treated alike, if they are shorter
 * than the shortest crease that may end free: where contours are smooth, the
 * line that hides the rest of a crease may not be drawn there.  So are smooth
 * contours that are shorter than pens_shortest_contour_mm.
 * rows  of the graph's nodes
 * step  how far nodes may be from the lines that meet there, grid units
 * smooth  whether contours are smooth: these, and creases, are looked for, too
 * drop  one a segment, 0
 * Returns false when memory ran out or the caller cancelled.
 * Cost  near linear; of segments far from loose ends of such chains, that of
 *       finding the cells of their nodes, in parallel */
USE_RESULT bool segment_graph_find_short_spurs(
    const struct segment_graph *graph, const struct node_rows *rows,
    const struct sheet *sheet, const struct pens *pens, double step,
    bool smooth, uint8_t *drop);

#endif
