/* thin_faces.h - finds triangles that rounding alone explains. */
#ifndef SCENE_WELD_THIN_FACES_H
#define SCENE_WELD_THIN_FACES_H

#include "scene/topology/topology.h"

/* How far from its place rounding may have moved a point beside a side: four
 * times the error of its largest coordinate, but no more than
 * TOLERANCE_WELD_FACE_SHARE of the side.
 * side      its length
 * unstated  of points whose precision is not stated */
double thin_faces_length(const struct scene *scene, uint32_t point, double side,
                         struct precision unstated);

/* Finds the triangles whose corners are on one line but for that, one between
 * the two others, and each of whose sides another face has: as programs make
 * them of points that are on one line before they are rounded.  Their normals
 * mean nothing.  Of those that have sides in common all corners are on one
 * line.
 * thin   set to a new map of a bit a face, which the caller owns, also on
 *        failure
 * count  gets how many there are
 * Finds corner_edge of the topology where any may be such.  Returns false when
 * memory ran out, or the caller cancelled. */
USE_RESULT bool thin_faces_find(const struct scene *scene,
                                struct topology *topology,
                                struct precision unstated, uint64_t **thin,
                                size_t *count);

#endif
