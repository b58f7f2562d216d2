/* shading.c - the colour and the brightness of a face where it is filled. */
#include "ink/shading.h"

#include "geom/vector.h"
#include "ink/fill/light.h"
#include "scene/newell_normal.h"

/* Colours of low saturation, so that the lines dominate the picture; any two
 * differ in hue or in lightness. */
static const uint32_t palette[] = {
    0x9db4c8, 0xe0c29a, 0xa9c4a0, 0xd3a39c, 0xb9aecb, 0xd9d3a4,
    0x8fb5b0, 0xc4a586, 0xc7d4de, 0xe3b8a0, 0x96a68a, 0xcfb3c3,
};

/* The colour of the face's group: its own if it has one, else that of the
 * palette at the group's index modulo the palette's size. */
uint32_t face_colour_of(const struct scene *scene, uint32_t face) {
  uint32_t group = scene_face_group(scene, face);
  if (group < scene->group.count && scene->group.item[group].has_colour)
    return scene->group.item[group].colour;
  return palette[group % (sizeof palette / sizeof palette[0])];
}

/* The brightness of a face by its angle to the light.  The normal is turned
 * towards the viewer first, so both sides of a face are shaded alike. */
static double shade(const struct scene *scene, uint32_t face,
                    const struct camera *camera, const struct light *light,
                    bool *is_back) {
  double normal[3];
  newell_normal_of_face(scene, face, normal);
  *is_back = light_is_turned_away(scene, face, camera, normal);
  for (int k = 0; k < 3 && *is_back; k++)
    normal[k] = -normal[k];
  (void)vector_normalise(normal);
  return light_brightness(normal, light);
}

struct face_shading face_shading_of(const struct scene *scene, uint32_t face,
                                    const struct camera *camera,
                                    const recto_options *options) {
  struct face_shading shading = {.colour = face_colour_of(scene, face)};
  struct light light = light_of(camera, options);
  shading.brightness = shade(scene, face, camera, &light, &shading.is_back);
  return shading;
}
