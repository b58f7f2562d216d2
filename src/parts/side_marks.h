/* side_marks.h - the marks of creases that count in a model, by the sides of
 * its faces: so the scene of a part, which has some of these, gets its own. */
#ifndef PARTS_SIDE_MARKS_H
#define PARTS_SIDE_MARKS_H

#include "scene/topology/topology.h"

/* Zero-initialised is empty: none counts. */
struct side_marks {
  ARRAY(uint64_t) side; /* ascending: face number, side, whether it is soft */
};

/* Lists the marks of a model's edges; false when memory ran out. */
USE_RESULT bool side_marks_list(struct side_marks *marks,
                                const struct scene *scene,
                                const struct topology *topology);

/* The marks of a scene that has some of the faces: enum crease_mark, one a
 * corner, of the side from it.
 * face_number  of each of its faces in the model, ascending
 * Returns an allocated array; NULL when memory ran out. */
uint8_t *side_marks_select(const struct side_marks *marks,
                           const struct scene *scene,
                           const uint32_t *face_number);

/* Sets topology->crease_mark of the edges of two faces.
 * mark  one a corner, as of side_marks_select; NULL: none counts
 * Returns false when memory ran out. */
USE_RESULT bool side_marks_apply(const uint8_t *mark, struct topology *topology,
                                 const struct scene *scene);

#endif
