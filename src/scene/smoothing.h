/* smoothing.h - the smoothing groups of faces: faces of one group that meet are
 * to look as one smooth surface. */
#ifndef SCENE_SMOOTHING_H
#define SCENE_SMOOTHING_H

#include <stdbool.h>
#include <stdint.h>

#include "base/memory.h"
#include "base/status.h"

/* Faces of no known group, of none, or of a group: its number, from
 * SMOOTHING_GROUPS on. */
enum { SMOOTHING_UNKNOWN, SMOOTHING_OFF, SMOOTHING_GROUPS };

/* Faces of one group, up to those of the next range. */
struct smoothing_range {
  uint32_t first_face, group;
};

/* Zero-initialised, nothing is known of any face. */
struct smoothing_groups {
  ARRAY(struct smoothing_range) range;
  uint32_t first_file_face; /* of the file that is read */
  /* Of a file that is read in passes, whose faces are not kept: */
  bool has_dropped_faces, has_several;
};

/* The faces from one on, which comes after all so far, are of a group.
 * Returns false when memory ran out. */
USE_RESULT bool smoothing_set(struct smoothing_groups *smoothing, uint32_t face,
                              uint32_t group);

/* The same for a file that says so, where the faces before its first such
 * statement are of no group. */
USE_RESULT bool smoothing_set_in_file(struct smoothing_groups *smoothing,
                                      uint32_t face, uint32_t group);

/* A file begins, or ends: nothing is known of the faces from one on. */
void smoothing_begin_file(struct smoothing_groups *smoothing, uint32_t face);

/* Forgets the faces from one on. */
void smoothing_restore(struct smoothing_groups *smoothing, uint32_t face);

/* Forgets all faces, `faces` of them, which are dropped; those that follow are
 * of the group of the last. */
void smoothing_drop_faces(struct smoothing_groups *smoothing, uint32_t faces);

/* Whether faces are of several groups, or some of one and some of none. */
bool smoothing_has_several(const struct smoothing_groups *smoothing);

/* The group of a face.  Cost: logarithmic in the number of ranges. */
uint32_t smoothing_of_face(const struct smoothing_groups *smoothing,
                           uint32_t face);

#endif
