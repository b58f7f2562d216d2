/* raster_small.h - fast drawing of small triangles into the pixel frame.
 *
 * Most triangles of a fine mesh cover a few lines of a few pixels each. */
#ifndef VISIBILITY_ZBUFFER_RASTER_SMALL_H
#define VISIBILITY_ZBUFFER_RASTER_SMALL_H

#include "visibility/raster/raster.h"

/* As span_fill_triangle, for a triangle that covers a line.  Also returns
 * false, and does nothing, where the triangle is not small or doubles do not
 * decide which pixels it covers.
 * corner  the triangle's points */
bool raster_small_triangle(struct raster *raster, uint32_t triangle,
                           const uint32_t corner[3], int64_t *covered);

#endif
