/* light.h - computes the brightness of a face from its angle to the light. */
#ifndef INK_FILL_LIGHT_H
#define INK_FILL_LIGHT_H

#include "view/camera.h"

/* The brightness of a face turned away from the light, its ambient part; a face
 * perpendicular to the light has 1. */
#define LIGHT_DARKEST 0.3

/* Sets `light` to the unit vector towards the light, in scene space.  If
 * options->ink.light is 0, 0, 0, the light comes from behind the viewer, from
 * the upper left. */
void light_direction(const struct camera *camera, const recto_options *options,
                     double light[3]);

/* The brightness of a surface, LIGHT_DARKEST to 1, by Lambert's law.
 * normal, light  of unit length; a normal of length 0 gives
 *                LIGHT_DARKEST */
double light_brightness(const double normal[3], const double light[3]);

/* Whether the normal of a face points away from the viewer. */
bool light_is_turned_away(const struct scene *scene, uint32_t face,
                          const struct camera *camera, const double normal[3]);

#endif
