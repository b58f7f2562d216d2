/* light.h - how bright a face is by its angle to the light. */
#ifndef INK_FILL_LIGHT_H
#define INK_FILL_LIGHT_H

#include "view/camera.h"

/* Brightness where the light does not reach; 1 is where it falls squarely. */
#define LIGHT_DARKEST 0.3

/* Towards the light, of unit length, scene space; over the viewer's left
 * shoulder where options->light is 0, 0, 0. */
void light_direction(const struct camera *camera, const recto_options *options,
                     double light[3]);

/* The brightness of a surface, LIGHT_DARKEST to 1, by Lambert's law.
 * normal, light  of unit length; a normal of length 0 is dark */
double light_brightness(const double normal[3], const double light[3]);

/* The normal of a face by Newell's sums, its length twice the area, on the
 * side from which it is counter-clockwise; measured from its first corner, so
 * that far models lose nothing. */
void light_face_normal(const struct scene *scene, uint32_t face,
                       double normal[3]);

/* Whether the normal of a face points away from the viewer. */
bool light_is_turned_away(const struct scene *scene, uint32_t face,
                          const struct camera *camera, const double normal[3]);

#endif
