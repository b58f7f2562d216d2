/* edge_crossing.h - finds where surfaces pass through each other along an edge.
 *
 * A surface that has an edge on a face's plane, and continues behind the plane
 * on one side of the edge and in front of it on the other, passes through the
 * face although none of its triangles does: each of them ends on the plane,
 * with two corners in contact with it (occlusion.h) and the third not.
 *
 * Contact may be a large length.  So the intersection line runs along the edge
 * only where the triangles incident to the edge meet the face there; where they
 * meet it elsewhere, the line is there, and where they do not meet it there is
 * none.
 *
 * Where an edge lies on another edge their fans decide (edge_fan.h).
 */
#ifndef VISIBILITY_INTERSECTION_EDGE_CROSSING_H
#define VISIBILITY_INTERSECTION_EDGE_CROSSING_H

#include "visibility/intersection/edge_fan.h"
#include "visibility/intersection/intersection_segment.h"

/* A candidate for a crossing.  An edge with an incident triangle that ends on
 * the plane of a triangle; or two edges, each on a plane of the other's
 * triangles. */
struct edge_crossing {
  struct surface_edge side[2]; /* the lower first: edges, then triangles, whose
                                  index is i; their j is SHEET_NONE */
};

struct edge_crossings {
  ARRAY(struct edge_crossing) list;
  ARRAY(struct edge_crossing) slanted; /* an edge and a triangle: see below */
};

void edge_crossings_fini(struct edge_crossings *crossings);

/* Adds the candidates of another list.  Returns false when memory ran out. */
USE_RESULT bool edge_crossings_unite(struct edge_crossings *crossings,
                                     const struct edge_crossings *other);

/* Adds a candidate: triangle f ends on the plane of g, which straddles that of
 * f or ends on it.  Returns false when memory ran out.
 * cf, cg  the corners of f by side of the plane of g, and those of g */
USE_RESULT bool edge_crossings_add(struct edge_crossings *crossings,
                                   const struct sheet *sheet, uint32_t f,
                                   struct corner_counts cf, uint32_t g,
                                   struct corner_counts cg);

/* Adds the edges of triangle f that pass through the plane of g between an end
 * beyond contact and an end that touches it.  By contact the triangle across
 * such an edge may not straddle the plane though a part of the intersection
 * line lies in it: the part between the edge and the end that touches.  The
 * two may be far apart where the edge is nearly parallel to the plane.
 * plane  triangle g, prepared
 * Returns false when memory ran out. */
USE_RESULT bool edge_crossings_add_slanted(struct edge_crossings *crossings,
                                           const struct sheet *sheet,
                                           uint32_t f, uint32_t g,
                                           const struct occluder *plane);

/* Decides the candidates, appends the segments of the crossings to `segments`,
 * and counts them.  It is enough that one pair of the triangles incident to an
 * edge was added: the others, which rounding may have kept out, are taken from
 * the sheet.  Sorts the candidates.  Returns false when memory ran out. */
USE_RESULT bool edge_crossings_resolve(struct edge_crossings *crossings,
                                       const struct sheet *sheet,
                                       struct intersection_segments *segments,
                                       uint64_t *count);

#endif
