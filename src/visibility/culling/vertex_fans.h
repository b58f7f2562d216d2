/* vertex_fans.h - raises the bounds of page cells about the vertices of a
 * sheet.
 *
 * About the corner of a box three faces meet, so that neither a triangle nor
 * two that share a side surround the cell there (occlusion_buffer.h).  All
 * triangles about a vertex do, where each shares a side with the next one,
 * round the vertex, and the cell is on the inner side of each side that is
 * opposite to it.
 */
#ifndef VISIBILITY_CULLING_VERTEX_FANS_H
#define VISIBILITY_CULLING_VERTEX_FANS_H

#include "visibility/culling/occlusion_buffer.h"

/* Raises the bounds of the cells about all vertices of a sheet of few
 * triangles.  Returns false when memory ran out. */
USE_RESULT bool vertex_fans_raise(struct occlusion_buffer *buffer,
                                  const struct sheet *sheet);

#endif
