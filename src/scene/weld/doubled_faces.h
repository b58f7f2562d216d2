/* doubled_faces.h - finds faces that a file lists twice, on the same points. */
#ifndef SCENE_WELD_DOUBLED_FACES_H
#define SCENE_WELD_DOUBLED_FACES_H

#include "scene/topology/topology.h"

/* Finds the faces that have the points of an earlier face of their group, in
 * either direction, where two of these are ends of edges of more than two
 * faces: as programs write surfaces that have two sides, each face and its
 * reverse.  Without these faces the edges are those of the surface.
 * doubled  set to a new map of a bit a face, which the caller owns, also on
 *          failure; NULL: no edge has more than two faces
 * count    gets how many there are
 * Returns false when memory ran out, or the caller cancelled.
 * Cost     none where no edge has more than two faces; else linear */
USE_RESULT bool doubled_faces_find(const struct scene *scene,
                                   const struct topology *topology,
                                   uint64_t **doubled, size_t *count);

#endif
