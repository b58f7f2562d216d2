/* pair_sweep.h - the state of a search for pairs of triangles that may pierce
 * each other (candidate_pairs.h). */
#ifndef VISIBILITY_INTERSECTION_PAIR_SWEEP_H
#define VISIBILITY_INTERSECTION_PAIR_SWEEP_H

#include "base/sort.h"
#include "visibility/index/bsp.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/predicate/coarse_plane.h"
#include "visibility/predicate/point_lanes.h"
#include "visibility/progress.h"

struct swept_triangle; /* swept_triangle.h */

/* The search for pairs in the cells of a grid, by one thread or by several,
 * each of which has its own. */
struct pair_sweep {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  const uint8_t *cells; /* per cell, not 0: selected; NULL: all are */
  bool (*visit)(void *user, const struct swept_triangle *f,
                const struct swept_triangle *g, bool straddle);
  void *user;
  struct progress *progress; /* counts the work */
  uint64_t met; /* the number of pairs of one list whose ranges overlap, in
                   depth or along the list's direction */
  struct occlusion_bound all; /* of contact tolerances */
  int x, y;                   /* the current cell */
  point_lanes first;          /* the grid's lower left corner */
  point_lanes cell;           /* x, y */
  point_lanes selected; /* -1 in lanes 0 and 1 where the cell before it in its
                           row, in its column is selected; else 0 */
  ARRAY(struct swept_triangle) swept; /* those of the current list */
  ARRAY(struct swept_box) box;        /* of these */
  ARRAY(uint32_t) met_now; /* scratch: those that a triangle is tested with */
  ARRAY(struct sort_key) key;   /* twice as many: by depth, and scratch */
  ARRAY(struct sort_key) other; /* those that are not of the face, or about the
                                   edge, that most of the list's triangles are
                                   of */
  bool is_along_normal; /* the current list has the keys of sweep_direction.h */
  ARRAY(struct sort_key) along; /* scratch: such keys, twice as many */
  ARRAY(int64_t) high;          /* scratch: high ends of ranges */
  struct bsp bsp;
};

#endif
