/* potentially_visible.h - what culling leaves of a sheet, as a sheet of its
 * own.
 *
 * What a method reads of a deep scene is then as small, and as close together
 * in memory, as what it solves; and no method needs to know what was culled.
 *
 * The part has the triangles that are not culled, their edges, the wires that
 * are not hidden, and the points of all these, each in the order of the whole
 * sheet, so that ties are decided in the same way.  Hidden edges are not drawn
 * in it (class 0).  A side beyond which the triangle was culled is a contour
 * of it.
 *
 * Source  The potentially visible set [Airey1990], here that of one view.
 */
#ifndef VISIBILITY_CULLING_POTENTIALLY_VISIBLE_H
#define VISIBILITY_CULLING_POTENTIALLY_VISIBLE_H

#include "visibility/culling/occlusion_culling.h"
#include "visibility/map.h"

struct potentially_visible {
  struct sheet sheet;
  uint32_t *triangle, *edge; /* the whole sheet's, of those in the part */
  size_t points, edges; /* of the whole sheet that are in the part; those of
                           intersections may follow */
};

/* Makes the part of a sheet, of which triangles were culled.
 * Returns false when memory ran out; end with potentially_visible_fini either
 * way. */
USE_RESULT bool
potentially_visible_init(struct potentially_visible *part,
                         const struct sheet *whole,
                         const struct occlusion_culling *culling);
void potentially_visible_fini(struct potentially_visible *part);

/* Appends the intersections that were found in the part to the whole sheet, and
 * makes a map of the part that of the whole sheet.  Returns false when memory
 * ran out. */
USE_RESULT bool potentially_visible_restore(struct potentially_visible *part,
                                            struct sheet *whole,
                                            struct map *map);

#endif
