/* loop_changes.h - moves corners of visible fragments, and puts points into
 * their sides. */
#ifndef VISIBILITY_FIT_LOOP_CHANGES_H
#define VISIBILITY_FIT_LOOP_CHANGES_H

#include "visibility/map.h"

/* A point that is put into a half-edge. */
struct side_point {
  double x, y;
  uint32_t id; /* as map_corner's, of the side that starts there; SHEET_NONE:
                  that of the half-edge */
};

/* All corners at a point of the page are moved as one, and what is put into a
 * half-edge is put into its twin in the opposite order. */
struct loop_changes {
  struct map *map;
  double (*to)[2];      /* one a corner: where it is now */
  uint8_t *is_moved;    /* one a corner */
  uint8_t *starts_side; /* one a half-edge: it is a side of its own */
  uint32_t *first_id;   /* one a half-edge: the id of that side; SHEET_NONE:
                              it stays */
  uint32_t *start;      /* one a half-edge and one more: its first point */
  ARRAY(struct side_point) point;
};

/* Nothing is moved at first.  `start` and `point` are the caller's to fill, in
 * the order of the half-edges.  Returns false when memory ran out. */
USE_RESULT bool loop_changes_init(struct loop_changes *changes,
                                  struct map *map);
void loop_changes_fini(struct loop_changes *changes);

/* Makes the map's loops anew.  Returns false when memory ran out or the caller
 * cancelled. */
USE_RESULT bool loop_changes_apply(struct loop_changes *changes);

/* A coordinate with the precision that corners of a map have. */
double loop_changes_round(double x);

#endif
