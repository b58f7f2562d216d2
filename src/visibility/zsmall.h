/* zsmall.h - small triangles put into the pixel frame.
 *
 * Most triangles of a fine mesh cover a few lines of a few pixels each. */
#ifndef VISIBILITY_ZSMALL_H
#define VISIBILITY_ZSMALL_H

#include "visibility/raster.h"

/* As zfill_triangle, of a triangle that covers a line; also returns false, and
 * does nothing, where the triangle is not small or doubles cannot tell which
 * pixels it covers.
 * corner  the triangle's points */
bool zsmall_triangle(struct raster *raster, uint32_t triangle,
                     const uint32_t corner[3], int64_t *covered);

#endif
