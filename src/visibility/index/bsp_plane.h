/* bsp_plane.h - a line of the page, or a plane, that parts a crowd of triangles, so
 * that those on different sides need not be asked about one another.
 *
 * A triangle is on a side where a corner of it is, or is so near to the cut
 * that it might as well be; one with corners on both is on both.  The cut's
 * apex, a point that many triangles share, does not count: of two triangles
 * that share it, one on each side, nothing else meets.  So a fan about one
 * vertex falls into halves, and these into quarters.  A plane also has a hinge:
 * triangles that share the side from the apex to there, like the pages of a
 * book, are on the side of their third corner.
 *
 * Near, of a line: within BSP_PLANE_MARGIN units, more than any two lines may be
 * apart that count as one.  Of a plane: what is before or behind it by no more
 * than the thickest contact tolerance of the crowd, all but the steepest
 * triangles', which are on both sides.  So of what a triangle may hide or touch
 * nothing is on the other side alone; see the reasons at bsp_plane.c.
 */
#ifndef VISIBILITY_INDEX_BSP_PLANE_H
#define VISIBILITY_INDEX_BSP_PLANE_H

#include "base/tolerance.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/predicate/plane_filter.h"

/* Units: so far off a line on the page a point counts as beside it. */
enum { BSP_PLANE_MARGIN = 4 * TOLERANCE_COINCIDENT_UNITS };

enum { BSP_LEFT = 1, BSP_RIGHT = 2, BSP_BOTH = 3 };

struct bsp_plane {
  struct geom_point shared_vertex;
  struct geom_point
      shared_edge;        /* of a plane: another corner of its triangle */
  uint32_t point[2];      /* apex and hinge, in the sheet */
  int64_t dx, dy, margin; /* of a line: its direction, what is near to it */
  bool is_plane;
  struct plane_filter plane;
  double thickness; /* depth units: the most that a triangle may be thick */
};

/* On which sides a triangle, or a segment, is. */
int bsp_plane_side_of_triangle(const struct bsp_plane *cut,
                               const struct sheet *sheet, uint32_t triangle);
int bsp_plane_side_of_segment(const struct bsp_plane *cut, struct geom_point p,
                              struct geom_point q);

/* The sides of anything within three points, no apex among them. */
int bsp_plane_side_of_corners(const struct bsp_plane *cut,
                              const struct geom_point p[3]);

/* Chooses what parts a crowd best, by a sample of it.
 * planes  may be planes, not only lines of the page
 * Returns false where nothing leaves clearly fewer pairs. */
bool bsp_plane_choose(struct bsp_plane *cut, const struct sheet *sheet,
                      const uint32_t *triangle, size_t count, bool planes);

#endif
