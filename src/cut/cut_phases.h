/* cut_phases.h - the phases of a cut, and what they share.
 *
 *   faces     splits the faces that planes meet: the parts that stay are
 *             stored, and of those that go the sides in the planes.
 *   sections  finds the cut faces in each plane.
 *   assemble  makes the scene that is left.
 */
#ifndef CUT_CUT_PHASES_H
#define CUT_CUT_PHASES_H

#include "cut/cut_lines.h"
#include "cut/section.h"
#include "scene/triangulation/triangulate.h"

enum { CUT_NO_PLANE = 255 };

/* A corner of a part of a face. */
struct cut_corner {
  uint32_t point;
  uint8_t plane; /* in which the side from it lies; CUT_NO_PLANE: in none, it is
                    one of the face */
};

/* A part of a face that stays. */
struct cut_part {
  uint32_t face, corner, count;
  bool united; /* of several: it has corners that only these needed */
};

/* What planes do to a face, from which of its corners are beyond them. */
enum cut_fate { CUT_STAYS, CUT_GOES, CUT_IS_SPLIT };

struct cutter {
  struct cut *cut;
  const struct scene *scene;
  const uint32_t *weld; /* of its points; NULL: to themselves */
  struct cut_points points;
  uint8_t *fate; /* of each face: enum cut_fate */
  ARRAY(struct cut_corner) corner;
  ARRAY(struct cut_part) part; /* in the order of their faces */
  struct triangulation triangulation;
  bool is_warped;  /* the current face is not planar */
  bool edge_goes;  /* an edge of it that lies in a plane, if not all of it */
  uint32_t *place; /* of each point of the cut: the first one at its place */
  size_t places;
  struct cut_lines lines;
  struct section section[CUT_PLANES_MAX];
  bool has_common_vertex;     /* three planes have a point in common */
  double common_vertex_at[3]; /* its place, in units of the grid */
  uint32_t common_vertex;     /* SCENE_NONE: none, or not in the scene's box */
  bool anything_goes;
};

static inline uint32_t cut_weld(const struct cutter *cutter, uint32_t point) {
  return cutter->weld != NULL ? cutter->weld[point] : point;
}

/* The point that stands for all at a point's place. */
static inline uint32_t cut_place(const struct cutter *cutter, uint32_t point) {
  uint32_t first = cutter->points.first;
  return point < first || point - first >= cutter->places
             ? point
             : cutter->place[point - first];
}

/* The point of a node of a plane's section. */
static inline uint32_t cut_node_point(const struct cutter *cutter,
                                      unsigned plane, uint32_t node) {
  return cutter->section[plane].node.item[node].point;
}

USE_RESULT recto_status cut_faces(struct cutter *cutter, recto_error *error);
USE_RESULT recto_status cut_sections(struct cutter *cutter, recto_error *error);
/* Opens the lines of a surface that is not closed but goes around the point
 * that three planes have in common, where that is outside the scene's box.
 * Sets *open_at to a point of the first, where it is SCENE_NONE.  Returns false
 * when memory ran out. */
USE_RESULT bool cut_open_lines_past_vertex(struct cutter *cutter,
                                           uint32_t *open_at);
USE_RESULT recto_status cut_assemble(struct cutter *cutter,
                                     struct precision unstated,
                                     recto_error *error);

#endif
