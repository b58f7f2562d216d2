/* crease_lines.h - the lines that creases form on the mesh, whatever is seen of
 * them: edges that are joined at points. */
#ifndef INK_LINES_CREASE_LINES_H
#define INK_LINES_CREASE_LINES_H

#include <stdatomic.h>

#include "base/memory.h"
#include "scene/topology/large_faces.h"
#include "view/project.h"
#include "view/sheet.h"

/* The cosine of the angle between the two faces of an edge that is drawn as a
 * crease or a silhouette; 1 where it has other faces than two.  Faces that run
 * the same way along it count as bent sharply, and so do those whose edge is
 * marked as hard; one that is marked as smooth as not bent.  Where those of all
 * are needed, crease_lines_measure finds them by several threads.
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

/* What is looked up of the creases of a sheet more than once: found when it is
 * asked for first.  Zero-initialised but for the sheet is empty. */
struct crease_lines {
  const struct sheet *sheet;
  uint32_t *edge; /* those drawn as creases or silhouettes, ascending: no other
                     bends by the crease angle; NULL: not yet listed */
  size_t count;
  double *cosine;   /* one a listed edge: crease_cosine; NULL: not yet found */
  atomic_uchar *at; /* one a point: CREASE_END_ALONE where one of these is the
                       only drawable edge; NULL: not yet found */
  /* The points at which listed edges end are few of the sheet's: what is kept
   * of each is by its number among them. */
  uint32_t *end;          /* two a listed edge: the numbers of its endpoints;
                             NULL: not yet numbered */
  uint32_t *point;        /* one an endpoint: the sheet's point */
  uint32_t *end_of_point; /* one a point: its number, if it is an endpoint;
                             else not set */
  size_t end_count;
  struct view_point *place; /* one an endpoint: where it is in view space;
                               NULL: not yet found */
  uint32_t *number; /* one an endpoint: its line's, from 1 to line_count; NULL:
                       not yet joined */
  size_t line_count;
};

enum { CREASE_END = 1, CREASE_END_ALONE = 3, CREASE_END_SHARED = 7 };

/* Counts the drawable edges, visible or not, at some points of a sheet.
 * dropped  one an edge: it does not count; NULL: all do
 * at       one a point: CREASE_END where edges are counted, else 0; becomes
 *          CREASE_END_ALONE where there is one, CREASE_END_SHARED where there
 *          are more
 * Returns false when the caller cancelled.  Cost: linear in the edges, in
 * parallel */
USE_RESULT bool crease_ends_count(const struct sheet *sheet,
                                  const uint8_t *dropped, atomic_uchar *at);

void crease_lines_fini(struct crease_lines *lines);

/* List the edges; find their cosines, where they end alone; number their
 * endpoints, and place these, too; join the lines, of edges that bend by more
 * than an angle, which is the same at every call, where their cosines are found
 * too.  Return false when memory ran out or the caller cancelled. */
USE_RESULT bool crease_lines_list(struct crease_lines *lines);
USE_RESULT bool crease_lines_measure(struct crease_lines *lines);
USE_RESULT bool crease_lines_find_ends(struct crease_lines *lines);
USE_RESULT bool crease_lines_number_ends(struct crease_lines *lines);
USE_RESULT bool crease_lines_place_ends(struct crease_lines *lines);
USE_RESULT bool crease_lines_join(struct crease_lines *lines,
                                  double crease_deg);

/* The number of the line of a listed edge that ends at a point, when they are
 * joined.  What is kept of each line takes little memory by it. */
static inline uint32_t crease_line_of_point(const struct crease_lines *lines,
                                            uint32_t point) {
  return lines->number[lines->end_of_point[point]];
}

#endif
