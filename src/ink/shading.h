/* shading.h - the colour and the brightness of a face where it is filled. */
#ifndef INK_SHADING_H
#define INK_SHADING_H

#include "recto.h"
#include "scene/scene.h"
#include "view/camera.h"

/* The colour in which RECTO_FILL_PAINT fills a face, 0xRRGGBB,
 * and the brightness with which RECTO_FILL_SHADE does, to 1. */
struct face_shading {
  uint32_t colour;
  double brightness;
  bool is_back; /* seen from its back */
};
/* The colour alone. */
uint32_t face_colour_of(const struct scene *scene, uint32_t face);
struct face_shading face_shading_of(const struct scene *scene, uint32_t face,
                                    const struct camera *camera,
                                    const recto_options *options);

#endif
