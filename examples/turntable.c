/* turntable.c - draw a model from all around, at one scale, into turn000.svg
 * and so on: turntable MODEL [COUNT] */
#include <stdio.h>
#include <stdlib.h>

#include "recto.h"

static recto_status draw_frame(const recto_scene *scene,
                               const recto_options *options, int frame,
                               recto_error *error) {
  char path[32];
  recto_drawing *drawing;
  recto_status status = recto_scene_render(scene, options, &drawing, error);
  if (status == RECTO_OK) {
    snprintf(path, sizeof path, "turn%03d.svg", frame);
    status = recto_drawing_write(drawing, path, NULL, options, error);
  }
  recto_drawing_destroy(drawing);
  return status;
}

int main(int argc, char **argv) {
  int count = argc > 2 ? atoi(argv[2]) : 36;
  if (argc < 2 || count < 1 || count > 1000) {
    fputs("usage: turntable MODEL [COUNT]\n", stderr);
    return 2;
  }
  recto_options options;
  recto_options_init(&options);
  options.camera.fit = RECTO_FIT_SPHERE; /* the scale of all directions */
  options.camera.elevation_deg = 20;
  options.ink.contours = RECTO_CONTOURS_SMOOTH; /* of what a mesh samples */

  /* What does not depend on the direction is found once, for all frames. */
  recto_scene *scene = NULL;
  recto_error error = {0};
  bool ok =
      recto_scene_create(&scene, &error) == RECTO_OK &&
      recto_scene_read(scene, argv[1], NULL, &options, &error) == RECTO_OK &&
      recto_scene_prepare(scene, &options, &error) == RECTO_OK;
  for (int i = 0; ok && i < count; i++) {
    options.camera.azimuth_deg = 360.0 * i / count;
    ok = draw_frame(scene, &options, i, &error) == RECTO_OK;
  }
  if (!ok)
    fprintf(stderr, "turntable: %s\n", error.text);
  recto_scene_destroy(scene);
  return ok ? 0 : 1;
}
