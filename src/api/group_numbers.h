/* group_numbers.h - numbers faces and edges within their groups, and within the
 * scene. */
#ifndef API_GROUP_NUMBERS_H
#define API_GROUP_NUMBERS_H

#include "drawing/drawing.h"
#include "scene/topology/topology.h"

/* Sets the sources of all strokes and fills, whose faces are those of the
 * scene: the number of the face, of the edge or of the polyline among those of
 * its group, in their order.  So a group has the same numbers whatever is drawn
 * beside it.  Faces that were skipped between two of a group are counted.
 * scene     what was drawn
 * whole     the same before it was cut, whose faces and polylines are numbered;
 *           cut faces have no number
 * topology  of `scene`; NULL: strokes have no edges but polylines
 * Returns false when memory ran out. */
USE_RESULT bool group_numbers_set(struct drawing *drawing,
                                  const struct scene *scene,
                                  const struct scene *whole,
                                  const struct topology *topology);

/* Gives faces the numbers that they have in the scene's sources, where faces
 * that were skipped are counted too, and polylines those that they had before
 * they were cut. */
void source_numbers_set(struct drawing *drawing, const struct scene *scene);

#endif
