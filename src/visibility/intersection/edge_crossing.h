/* edge_crossing.h - where surfaces cross along an edge.
 *
 * A surface that has an edge on a face's plane, and goes on behind the plane
 * on one side of the edge and before it on the other, passes through the face
 * there though none of its triangles does.  Each of them ends on the plane:
 * two corners touch it (occlusion.h), the third does not.
 *
 * Touching is a matter of contact, which may be large.  So the edge makes a line
 * only where the triangles about it meet the face along the edge; where they
 * meet it elsewhere, the line is there, and where they do not there is none.
 *
 * Where edge lies on edge four triangles meet, or more.  The two surfaces
 * cross where, going round the edge, one meets a triangle of the one, of the
 * other, of the one and of the other again.  Triangles that touch one another
 * on the same side of the edge are one sheet there and no crossing: two
 * prisms that stand wall on wall do not pierce each other along the walls'
 * sides.
 */
#ifndef VISIBILITY_INTERSECTION_EDGE_CROSSING_H
#define VISIBILITY_INTERSECTION_EDGE_CROSSING_H

#include "base/memory.h"
#include "visibility/intersection/intersection_segment.h"

/* How a triangle's corners lie to a plane, beyond contact or touching it. */
struct side_count {
  int behind, before; /* how many corners */
  int apart;          /* the last corner that does not touch */
};

struct side_count side_count_of(const struct occluder *plane,
                                const struct geom_point p[3]);

/* Two corners touch the plane: the triangle ends there, along a side. */
static inline bool ends_there(struct side_count s) {
  return s.behind + s.before == 1;
}

struct edge_crossing_side {
  uint32_t i, j; /* ends of an edge, i < j; or i: a triangle, j: none */
};

/* An edge whose triangle ends on another's plane; or two edges, each of which
 * is on a plane of the other's triangles. */
struct edge_crossing {
  struct edge_crossing_side side[2]; /* the lower first */
};

struct edge_crossings {
  ARRAY(struct edge_crossing) list;
  ARRAY(struct edge_crossing) slanted; /* an edge and a triangle */
};

void edge_crossings_fini(struct edge_crossings *crossings);

/* Notes that triangle f ends on the plane of g, which straddles that of f or
 * ends on it.  Returns false when memory ran out. */
USE_RESULT bool edge_crossings_note(struct edge_crossings *crossings,
                                    const struct sheet *sheet, uint32_t f,
                                    struct side_count sf, uint32_t g,
                                    struct side_count sg);

/* Notes the edges of triangle f that pass through the plane of g between an end
 * beyond contact and an end that touches it.  By contact the triangle across
 * such an edge may not straddle the plane though a part of the intersection
 * line lies in it: the part between the edge and the end that touches.  The
 * two may be far apart where the edge is nearly parallel to the plane.
 * Returns false when memory ran out. */
USE_RESULT bool edge_crossings_note_slanted(struct edge_crossings *crossings,
                                            const struct sheet *sheet,
                                            uint32_t f, uint32_t g,
                                            const struct occluder *plane);

/* Adds the crossings, and counts them.  It is enough that one pair of the
 * triangles about an edge was noted: the sheet is asked for the others, which
 * may be apart by a rounding.  Sorts the seams.  Returns false when memory ran
 * out. */
USE_RESULT bool edge_crossings_join(struct edge_crossings *crossings,
                                    const struct sheet *sheet,
                                    struct intersection_segments *segments,
                                    uint64_t *count);

#endif
