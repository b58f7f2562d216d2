/* light.h - computes the brightness of a face from its angle to the light. */
#ifndef INK_FILL_LIGHT_H
#define INK_FILL_LIGHT_H

#include "view/camera.h"

/* The lamps of a drawing: a key light, a fill light that reaches what the key
 * light leaves dark, and ambient light. */
struct light {
  double towards[3]; /* the unit vector towards the key light, scene space */
  double ambient;    /* the brightness of what no light reaches, 0 to 1 */
  double fill;       /* the fill light's share of the rest, 0 to 1 */
};

/* The light of the options.  If options->ink.light is 0, 0, 0, it comes from
 * behind the viewer, from the upper left. */
struct light light_of(const struct camera *camera,
                      const recto_options *options);

/* The share of ambient light that the options say. */
double light_ambient(const recto_options *options);

/* The brightness of a surface, from the ambient share where it faces away from
 * the light to 1 where it faces the light.  The key light is Lambert's law.
 * The fill light is a hemisphere light about the same direction, which shades
 * every surface by its angle: none is as dark as another at another angle.
 * normal  of length 1, or of length 0, which no light reaches
 * Source  [FoleyVanDam1990] for Lambert's law */
double light_brightness(const double normal[3], const struct light *light);

/* Whether the normal of a face points away from the viewer. */
bool light_is_turned_away(const struct scene *scene, uint32_t face,
                          const struct camera *camera, const double normal[3]);

#endif
