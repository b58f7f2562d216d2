/* edge_fan.h - the triangles about an edge, and whether the surfaces of two
 * coincident edges cross there.
 *
 * A diagonal may be an edge of other faces as well, by index.  So a surface's
 * edge is named by its ends and, where it is a diagonal of a face, by that
 * face: its fan is then two triangles of that face alone.
 *
 * Where an edge lies on another edge four triangles meet, or more.  The two
 * surfaces cross where, in the circular order around the edge, triangles of the
 * two alternate.  Triangles that are in contact on the same side of the edge
 * count as one sheet there and as no crossing: two prisms that stand wall to
 * wall do not pierce each other along the sides of the walls.
 */
#ifndef VISIBILITY_INTERSECTION_EDGE_FAN_H
#define VISIBILITY_INTERSECTION_EDGE_FAN_H

#include "visibility/intersection/intersection_segment.h"

/* An edge of a surface: its ends i < j, and the face of which it is a diagonal,
 * or SHEET_NONE. */
struct surface_edge {
  uint32_t i, j, face;
};

/* A total order: by ends, then faces. */
int surface_edge_compare(struct surface_edge a, struct surface_edge b);

/* The surface's edge along side k of a triangle. */
struct surface_edge surface_edge_of(const struct sheet *sheet,
                                    uint32_t triangle, int k);

/* Is a-b closer to the vertical than to the horizontal of the page? */
bool edge_is_upright(struct geom_point a, struct geom_point b);

/* The order of two points along edges that are upright, by y, or are not, by x.
 * The other coordinate cannot serve: rounding turns an upright edge by a
 * unit. */
int edge_compare_along(bool upright, struct geom_point a, struct geom_point b);

/* A triangle and one of its edges. */
struct incidence {
  struct surface_edge edge;
  uint32_t triangle;
};

struct incidences {
  ARRAY(struct incidence) list; /* by edge, then triangle */
};

/* Finds all triangles incident to edges between two marked points, one byte for
 * each point of the sheet.
 * incidences  zero-initialised
 * Returns false when memory ran out. */
USE_RESULT bool incidences_init(struct incidences *incidences,
                                const struct sheet *sheet,
                                const uint8_t *marked);
void incidences_fini(struct incidences *incidences);

/* The incidences of an edge: from the result up to `end`. */
const struct incidence *incidences_find(const struct incidences *incidences,
                                        struct surface_edge edge,
                                        const struct incidence **end);

/* A triangle of the fan about an edge: the edge, in the direction that is
 * common to all, and the triangle's third corner. */
struct side_triangle {
  struct geom_point from, to, third;
  uint32_t triangle;
};

/* The triangles about an edge. */
struct edge_fan {
  ARRAY(struct side_triangle) list;
};

/* Decides whether the surfaces of two overlapping edges cross.
 * scratch  zero-initialised at first, kept from call to call, freed by the
 *          caller
 * Returns false when memory ran out. */
USE_RESULT bool edge_fans_cross(const struct sheet *sheet,
                                const struct incidences *incidences,
                                const struct surface_edge edge[2],
                                struct edge_fan scratch[3], bool *cross);

#endif
