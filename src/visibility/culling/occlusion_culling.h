/* occlusion_culling.h - finds triangles that are certainly hidden, before
 * anything is solved.
 *
 * A buffer (occlusion_buffer.h) has for each page cell a depth behind which all
 * is hidden.  Triangles come from near to far.  Each is tested first: it is
 * hidden if its nearest corner is behind the bounds of all cells that it meets.
 * Otherwise it raises the bounds of the cells that it surrounds.
 *
 * Claim.  The visible lines and fragments of all triangles are those of the
 * triangles that are not culled, to the last bit.
 *
 * Proof.  Let O surround a cell and be nearer than T there by more than O's
 * contact tolerance and `margin`, which exceeds the extent in depth of whatever
 * T's plane touches.
 *   - What T occludes at a point of the cell, O occludes as well.
 *   - T's edges are hidden there, and so are its intersections with other
 *     triangles, which lie on T within the contact length and rounding.
 *   - For fragments, contact matters beyond: where V is visible and touches T,
 *     V's fragments may be T's.  At a point of V that O does not hide, V is no
 *     farther behind O than O's tolerance.  `margin` contains T's tolerance as
 *     a depth, and the bounds are lowered by the largest tolerance of all
 *     triangles that meet the cell and are not culled: so V and T do not touch.
 *
 * Cost  Linear in the triangles, and in the cells of those that are not culled.
 */
#ifndef VISIBILITY_CULLING_OCCLUSION_CULLING_H
#define VISIBILITY_CULLING_OCCLUSION_CULLING_H

#include "view/sheet.h"
#include "visibility/culling/occlusion_buffer.h"

struct occlusion_culling {
  uint8_t *culled; /* one per triangle, not 0: it is hidden; NULL: culling was
                      not worth while, and nothing is culled */
  size_t count;    /* of culled triangles */
  struct occlusion_buffer buffer;
  int64_t reach; /* by how much edges may stray on the page */
  double margin; /* the same in depth */
};

/* Culls the triangles of the sheet, or, if that would not be worth while, none.
 * fragments  whether faces will be solved, so that contact matters
 * Returns false when memory ran out; end with occlusion_culling_fini either
 * way. */
USE_RESULT bool occlusion_culling_init(struct occlusion_culling *culling,
                                       const struct sheet *sheet,
                                       bool fragments);
void occlusion_culling_fini(struct occlusion_culling *culling);

static inline bool
occlusion_culling_is_culled(const struct occlusion_culling *culling,
                            uint32_t triangle) {
  return culling->culled != NULL && culling->culled[triangle] != 0;
}

/* Is the segment p-q, an edge or an intersection, hidden in all cells that it
 * meets?  Sufficient, not necessary. */
bool occlusion_culling_hides(const struct occlusion_culling *culling,
                             struct geom_point p, struct geom_point q);

#endif
