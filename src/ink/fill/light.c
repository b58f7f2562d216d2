/* light.c - computes the brightness of a face from its angle to the light. */
#include "ink/fill/light.h"

#include <string.h>

#include "view/vector.h"

void light_direction(const struct camera *camera, const recto_options *options,
                     double light[3]) {
  memcpy(light, options->ink.light, 3 * sizeof *light);
  if (vector_normalise(light))
    return;
  for (int k = 0; k < 3; k++)
    light[k] = camera->back[k] + (camera->up[k] - camera->right[k]) / 2;
  (void)vector_normalise(light);
}

double light_brightness(const double normal[3], const double light[3]) {
  double lit = vector_dot(normal, light);
  double share = LIGHT_DARKEST + (1 - LIGHT_DARKEST) * (lit > 0 ? lit : 0);
  return share < 1 ? share : 1;
}

bool light_is_turned_away(const struct scene *scene, uint32_t face,
                          const struct camera *camera, const double normal[3]) {
  uint32_t corner = scene->corner.item[scene->face_start.item[face]];
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
