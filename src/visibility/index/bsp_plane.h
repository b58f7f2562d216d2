/* bsp_plane.h - a splitter of a BSP: a line of the page, or a plane.  Triangles
 * that lie on different sides of it cannot hide, touch or pierce each other in
 * the way that the tree is queried for.
 *
 * A triangle is on a side where one of its corners is, or is within the
 * splitter's margin; one with corners on both sides is on both.  Two exceptions
 * make fans separable:
 *   - shared vertex: a point that many triangles share does not count.  Of two
 *     triangles that share it, one on each side, nothing else meets, so that a
 *     fan about a vertex falls into halves, and these into quarters;
 *   - shared edge, of a plane only: triangles that have the side from the
 *     shared vertex to the other end of this edge, like the pages of a book,
 *     are on the side of their third corner.
 *
 * The margin of a line is BSP_PLANE_MARGIN units, more than the distance of any
 * two lines that count as coincident.  That of a plane is the largest contact
 * tolerance of the triangles, in depth, except for the steepest triangles,
 * which are on both sides.  So nothing that a triangle may hide or touch is on
 * the other side alone; bsp_plane.c has the proof.
 *
 * Source  [Fuchs1980].
 */
#ifndef VISIBILITY_INDEX_BSP_PLANE_H
#define VISIBILITY_INDEX_BSP_PLANE_H

#include "base/tolerance.h"
#include "visibility/predicate/plane_filter.h"

/* Grid units: a point of the page this close to a line is on both sides. */
enum { BSP_PLANE_MARGIN = 4 * TOLERANCE_COINCIDENT_UNITS };

/* Sides of a splitter; a plane's left is in front of it. */
enum { BSP_LEFT = 1, BSP_RIGHT = 2, BSP_BOTH = 3 };

struct bsp_plane {
  struct geom_point shared_vertex;
  struct geom_point shared_edge; /* of a plane: the edge's other end */
  uint32_t point[2]; /* of a plane: the edge's ends, as points of the sheet */
  struct geom_point from, to; /* of a line: points on it */
  int64_t margin; /* of a line: BSP_PLANE_MARGIN as a twofold area */
  bool is_plane;
  struct plane_filter plane;
  double thickness; /* of a plane: its margin, depth units */
};

/* On which sides a triangle, or a segment, lies. */
int bsp_plane_side_of_triangle(const struct bsp_plane *splitter,
                               const struct sheet *sheet, uint32_t triangle);
int bsp_plane_side_of_segment(const struct bsp_plane *splitter,
                              struct geom_point p, struct geom_point q);

/* On which sides the triangle p lies, shared corners not excepted. */
int bsp_plane_side_of_corners(const struct bsp_plane *splitter,
                              const struct geom_point p[3]);

/* Chooses the splitter that leaves fewest pairs of triangles on a common side,
 * judged by a sample.
 * planes  planes are allowed, not only lines of the page
 * Returns false where none leaves clearly fewer pairs. */
bool bsp_plane_choose(struct bsp_plane *splitter, const struct sheet *sheet,
                      const uint32_t *triangle, size_t count, bool planes);

#endif
