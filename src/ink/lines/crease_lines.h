/* crease_lines.h - the lines that creases form on the mesh, whatever is seen of
 * them: edges that are joined at points. */
#ifndef INK_LINES_CREASE_LINES_H
#define INK_LINES_CREASE_LINES_H

#include "base/memory.h"
#include "view/sheet.h"

/* The normals of the two last faces with many corners, so that they are not
 * computed again for each of their edges. */
struct large_face_normals {
  uint32_t face[2]; /* SHEET_NONE: none yet */
  double normal[2][3];
  int last; /* which was used last */
};

static inline struct large_face_normals large_face_normals_start(void) {
  return (struct large_face_normals){.face = {SHEET_NONE, SHEET_NONE}};
}

/* The cosine of the angle between the two faces of an edge that is drawn as a
 * crease or a silhouette; 1 where it has other faces than two.  Faces that run
 * the same way along it count as bent sharply, and so do those whose edge is
 * marked as hard; one that is marked as smooth as not bent.
 * normals  of the edges before */
double crease_cosine(const struct sheet *sheet, const struct sheet_edge *edge,
                     struct large_face_normals *normals);

/* Whether an edge is of the line of a crease: one, or a silhouette that bends
 * as sharply.
 * cosine  the edge's
 * crease  that of the crease angle */
static inline bool crease_is_joined(const struct sheet_edge *edge,
                                    double cosine, double crease) {
  return cosine < crease || edge->edge_class == RECTO_EDGE_CREASE;
}

/* The lines as a union-find of the sheet's points; NULL when memory ran out. */
uint32_t *crease_lines_create(const struct sheet *sheet, double crease_deg);

#endif
