/* occlusion_culling.h - finds triangles that are certainly hidden, before
 * anything is solved.
 *
 * A buffer (occlusion_buffer.h) has for each page cell a depth behind which all
 * is hidden.  Triangles come from near to far.  Each is tested first: it is
 * hidden if in all cells that it meets its nearest corner is behind the bound,
 * or its plane is all over the cell.  Otherwise it raises the bounds of the
 * cells that it surrounds.
 *
 * Claim.  The visible lines and fragments of all triangles are those of the
 * triangles that are not culled, to the last bit.
 *
 * Proof.  Let O, one triangle or two that share a side, surround a cell, and
 * let T be farther there by more than O's contact tolerance and `margin`.
 *   - What T occludes at a point of the cell, O occludes as well: also on the
 *     shared side, each side of which one of the triangles covers.  Only an
 *     edge of O's own face is not occluded by O; it lies on O's plane, within
 *     the tolerance, and so is not behind T.
 *   - T's edges are hidden there, and so are its intersections with other
 *     triangles.  These lie on T but for its contact length, a level of T's
 *     tolerance in depth, and for rounding: `margin` and `xy_margin` exceed
 *     their sum.  So where T's plane is compared, it is over a cell that is
 *     larger by xy_margin on all sides.
 *   - For fragments, let V be a triangle that is visible there and touches T,
 *     so that V's fragments may be T's.  Where O does not hide V, V is no
 *     farther behind O than O's tolerance.  T's tolerance as a depth is in the
 *     margin, and the bounds are lowered by the largest tolerance of all
 *     triangles that meet the cell and were not culled, V's among them: V and T
 *     do not touch.
 *
 * Cost  Linear in the triangles: tests and raised bounds are limited, and what
 * is not tested is not culled.
 */
#ifndef VISIBILITY_CULLING_OCCLUSION_CULLING_H
#define VISIBILITY_CULLING_OCCLUSION_CULLING_H

#include "view/sheet.h"
#include "visibility/culling/occlusion_buffer.h"

/* By how much what lies on a triangle, within the contact length and rounding,
 * may be off the triangle. */
struct occlusion_margins {
  int64_t xy;   /* on the page, grid units */
  double depth; /* depth units */
};

struct occlusion_culling {
  uint8_t *culled; /* one per triangle, not 0: it is hidden; NULL: culling was
                      not worth while, and nothing is culled */
  size_t count;    /* of culled triangles */
  struct occlusion_buffer buffer;
  int64_t xy_margin; /* by how much edges may stray on the page */
  double margin;     /* the same in depth */
};

/* The margins that hold for all triangles of the scene of a sheet, also for
 * those that are not in the sheet. */
struct occlusion_margins occlusion_margins_of(const struct sheet *sheet);

/* Culls the triangles of the sheet, whose sides it finds, or, if that would not
 * be worth while or would leave more than three quarters of them, none.
 * fragments  whether faces will be solved, so that contact matters
 * Returns false when memory ran out or the caller cancelled; end with
 * occlusion_culling_fini either way. */
USE_RESULT bool occlusion_culling_init(struct occlusion_culling *culling,
                                       struct sheet *sheet, bool fragments);
void occlusion_culling_fini(struct occlusion_culling *culling);

/* Estimates the depth complexity: the mean number of triangles over a point of
 * a part of the page with that area.  From a sample, in which a triangle counts
 * with the area of its box, but at most a few times its own area, so that
 * needles count for little; and what it stands for counts once at most, so that
 * a large one among many small ones does. */
double occlusion_culling_complexity(const struct sheet *sheet, double area);

static inline bool
occlusion_culling_is_culled(const struct occlusion_culling *culling,
                            uint32_t triangle) {
  return culling->culled != NULL && culling->culled[triangle] != 0;
}

/* A part of a segment, in units of its OCCLUSION_PARTS-th part. */
enum { OCCLUSION_PARTS = 1 << 16 };
struct segment_part {
  int from, to; /* from >= to: it is empty */
};

/* The part of the segment p-q outside of which it is certainly hidden, by the
 * cells that it meets. */
struct segment_part
occlusion_culling_rest(const struct occlusion_culling *culling,
                       struct geom_point p, struct geom_point q);

/* Is the segment p-q, an edge or an intersection, hidden in all cells that it
 * meets?  Sufficient, not necessary. */
bool occlusion_culling_hides(const struct occlusion_culling *culling,
                             struct geom_point p, struct geom_point q);

/* The same of one of which each point is off that of p-q by less than `xy` on
 * the page, in each direction, and `z` in depth. */
bool occlusion_culling_hides_near(const struct occlusion_culling *culling,
                                  struct geom_point p, struct geom_point q,
                                  double xy, double z);

#endif
