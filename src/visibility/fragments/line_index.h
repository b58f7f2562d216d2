/* line_index.h - a spatial index of triangle sides, by page cell and supporting
 * line.
 *
 * The bounding boxes of long thin triangles overlap nearly everything, but
 * their sides cross few cells.  Within a cell, sides are sorted by the key of
 * their supporting line (geom_line_key), so that a query visits only the sides
 * on one line.
 */
#ifndef VISIBILITY_FRAGMENTS_LINE_INDEX_H
#define VISIBILITY_FRAGMENTS_LINE_INDEX_H

#include "geom/line.h"
#include "visibility/index/triangle_grid.h"

/* Side k of triangle t has the number 3 t + k. */
typedef ARRAY(uint32_t) side_list;

struct line_index {
  struct triangle_grid shape; /* the cells; its own lists are not used */
  uint32_t *start;            /* of cell c: entry[start[c] .. start[c + 1]), */
  uint64_t *entry; /* ascending: the key of the line in the upper 32 bits, the
                      side in the lower */
};

/* Indexes the triangle sides that are edges of the sheet.
 * triangle  `count` triangles of the sheet without duplicates; those seen
 *           edge-on are left out
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool line_index_init(struct line_index *index,
                                const struct sheet *sheet,
                                const uint32_t *triangle, size_t count);
void line_index_fini(struct line_index *index);

/* Appends every side that overlaps the segment from p to q of the line in more
 * than a point, and possibly some that do not; a side may be appended more than
 * once.  Returns false when memory ran out. */
USE_RESULT bool line_index_find(const struct line_index *index,
                                const struct geom_line *line,
                                const struct geom_corner *p,
                                const struct geom_corner *q, side_list *found);

#endif
