/* light.c - computes the brightness of a face from its angle to the light. */
#include "ink/fill/light.h"

#include <math.h>
#include <string.h>

#include "geom/vector.h"

#define USUAL_AMBIENT 0.3
#define USUAL_FILL 0.5

double light_ambient(const recto_options *options) {
  return options->ink.has_ambient ? options->ink.ambient : USUAL_AMBIENT;
}

struct light light_of(const struct camera *camera,
                      const recto_options *options) {
  struct light light = {.ambient = light_ambient(options),
                        .fill = options->ink.has_fill_light
                                    ? options->ink.fill_light
                                    : USUAL_FILL};
  memcpy(light.towards, options->ink.light, sizeof light.towards);
  if (vector_normalise(light.towards))
    return light;
  for (int k = 0; k < 3; k++)
    light.towards[k] = camera->back[k] + (camera->up[k] - camera->right[k]) / 2;
  (void)vector_normalise(light.towards);
  return light;
}

double light_brightness(const double normal[3], const struct light *light) {
  if (vector_dot(normal, normal) == 0)
    return light->ambient;
  double cosine = fmax(-1, fmin(vector_dot(normal, light->towards), 1));
  double lit =
      (1 - light->fill) * fmax(cosine, 0) + light->fill * (1 + cosine) / 2;
  return light->ambient + (1 - light->ambient) * lit;
}

bool light_is_turned_away(const struct scene *scene, uint32_t face,
                          const struct camera *camera, const double normal[3]) {
  uint32_t corner = scene->corner.item[scene_face_start(scene, face)];
  const struct scene_point *o = &scene->point.item[corner];
  double eye[3];
  memcpy(eye, camera->back, sizeof eye);
  if (camera->perspective) {
    eye[0] = camera->eye[0] - o->x;
    eye[1] = camera->eye[1] - o->y;
    eye[2] = camera->eye[2] - o->z;
  }
  return vector_dot(normal, eye) < 0;
}
