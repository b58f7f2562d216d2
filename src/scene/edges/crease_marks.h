/* crease_marks.h - which edges a file marks as hard or as smooth, by normals of
 * corners and by smoothing groups, and which of these marks count. */
#ifndef SCENE_EDGES_CREASE_MARKS_H
#define SCENE_EDGES_CREASE_MARKS_H

#include "base/sort.h"
#include "scene/topology/topology.h"

enum crease_mark {
  CREASE_MARK_NONE, /* the angle decides */
  CREASE_MARK_HARD, /* a crease */
  CREASE_MARK_SOFT  /* no crease */
};

/* Between which angles marks decide, degrees. */
struct crease_mark_range {
  double low_deg, high_deg;
};
struct crease_mark_range crease_mark_range_of(recto_crease_marks which,
                                              double crease_deg);

/* Whether marks may count in a scene, without its edges: where they do, it is
 * so, but not the reverse.  Of a scene whose faces are read in passes, after a
 * pass.  Returns false when memory ran out.
 * found  gets the answer */
USE_RESULT bool crease_marks_exist(const struct scene *scene,
                                   recto_crease_marks which, bool *found);

/* Sets topology->crease_mark: of an edge that bends by more than a degree,
 * whose two faces have normals at its ends, both of the same or both of
 * different ones, or else groups, what these say, if it counts at its angle.
 * By RECTO_CREASE_MARKS_AUTO it counts in connected parts of the mesh alone
 * that have hard edges and smooth ones; an edge of two faces that are flat by
 * themselves counts where at most a quarter of the edges are such.
 * Returns false when memory ran out. */
USE_RESULT bool crease_marks_find(struct topology *topology,
                                  const struct scene *scene,
                                  recto_crease_marks which, double crease_deg);

/* The marks of a scene by pairs of faces, for the scene that a cut makes of it:
 * keys of both, ascending, and their marks. */
struct crease_pairs {
  ARRAY(struct sort_key) pair;
};
USE_RESULT bool crease_pairs_list(struct crease_pairs *pairs,
                                  const struct topology *topology);
USE_RESULT bool crease_pairs_mark(const struct crease_pairs *pairs,
                                  struct topology *topology,
                                  const struct scene *cut);

/* What the mark of an edge makes of a mask of classes; of the class smooth this
 * makes nothing. */
static inline unsigned crease_mark_apply(const struct topology *topology,
                                         size_t edge, unsigned class_mask) {
  const unsigned crease = RECTO_EDGE_CREASE;
  if (topology->crease_mark == NULL ||
      topology->crease_mark[edge] == CREASE_MARK_NONE)
    return class_mask;
  return topology->crease_mark[edge] == CREASE_MARK_HARD ? class_mask | crease
                                                         : class_mask & ~crease;
}

/* The same for the masks of all edges, in which smooth ones have that class. */
void crease_marks_apply(const struct topology *topology, uint8_t *class_masks);

#endif
