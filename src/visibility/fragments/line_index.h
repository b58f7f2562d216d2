/* line_index.h - which sides of triangles run where on the page, and on which
 * line.
 *
 * Triangles long and thin are about everywhere; their sides are not.  In each
 * cell sides are found by the number of their line (geom/line.h), so that only
 * those on one line are met.
 */
#ifndef VISIBILITY_FRAGMENTS_LINE_INDEX_H
#define VISIBILITY_FRAGMENTS_LINE_INDEX_H

#include "geom/line.h"
#include "visibility/index/triangle_grid.h"

/* Side k of triangle t is number 3 t + k. */
typedef ARRAY(uint32_t) side_list;

struct line_index {
  struct triangle_grid shape; /* of its cells; it has no lists */
  uint32_t *start, *item;     /* of cell c: item[start[c] .. start[c + 1]) */
  uint32_t *number; /* one an item, ascending in each cell: of its line */
};

/* Indexes the sides that are edges of the sheet.
 * triangle  `count` of the sheet's, each once; flat ones are left out */
USE_RESULT bool line_index_init(struct line_index *grid,
                                const struct sheet *sheet,
                                const uint32_t *triangle, size_t count);
void line_index_fini(struct line_index *grid);

/* Appends every side that shares a stretch of the line with the one from p to
 * q, and a few more; some of them several times.  False when memory ran out. */
USE_RESULT bool line_index_find(const struct line_index *grid,
                                const struct geom_line *line,
                                const struct geom_corner *p,
                                const struct geom_corner *q, side_list *found);

#endif
