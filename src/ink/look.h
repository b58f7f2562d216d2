/* look.h - how a face looks where it is filled. */
#ifndef INK_LOOK_H
#define INK_LOOK_H

#include "recto.h"
#include "scene/scene.h"
#include "view/camera.h"

/* How a face looks: the colour in which RECTO_FILL_PAINT fills it, 0xRRGGBB,
 * and the brightness with which RECTO_FILL_SHADE does, to 1. */
struct ink_look {
  uint32_t colour;
  double brightness;
  bool is_back; /* seen from its back */
};
struct ink_look ink_look_of(const struct scene *scene, uint32_t face,
                            const struct camera *camera,
                            const recto_options *options);

#endif
