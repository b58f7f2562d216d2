/* repeated_part.h - faces that the next ones repeat with other points. */
#ifndef SCENE_TOPOLOGY_REPEATED_PART_H
#define SCENE_TOPOLOGY_REPEATED_PART_H

#include "scene/scene.h"

/* Consecutive faces, of one body or several, and the points between the lowest
 * and the highest of their corners. */
struct repeated_part {
  uint32_t face, faces;
  uint32_t corner, corners;
  uint32_t point, points;
};

/* Looks for the first faces from one on that are repeated by those just after
 * them, each with points that are higher by one number and than all of theirs.
 * Not all such faces are found: the search ends after a few thousand sides.
 * free  one a point: SCENE_NONE where the first corners of the part may be;
 *       NULL: not known, so that it begins with a face that has higher points
 *       than all from `face` on before it
 * Returns whether there are any. */
bool repeated_part_find(struct repeated_part *part, const struct scene *scene,
                        const uint32_t *free, uint32_t face, uint32_t end_face);

/* Whether the faces from one on repeat the part.
 * shift  gets what is added to its points, modulo 2^32; at least as much as
 *        there are points in it */
bool repeated_part_is_at(const struct repeated_part *part,
                         const struct scene *scene, uint32_t face,
                         uint32_t end_face, uint32_t *shift);

/* Whether the faces seem to be parts that are repeated many times, whose edges
 * are copied in less time than those of several ranges take to be joined.
 * samples  how many places to look at */
bool repeated_parts_fill(const struct scene *scene, int samples);

#endif
