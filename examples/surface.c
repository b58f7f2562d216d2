/* surface.c - draw the surface z = f(x, y) from arrays: surface DRAWING.svg */
#include <math.h>
#include <stdio.h>

#include "recto.h"

enum { SIDE = 61 }; /* points along each side of the grid */

static float f(float x, float y) {
  float r = sqrtf(x * x + y * y);
  return r > 0 ? 10 * sinf(r) / r : 10;
}

int main(int argc, char **argv) {
  static float point[SIDE * SIDE][3];
  static uint32_t square[(SIDE - 1) * (SIDE - 1)][4];
  size_t squares = 0;
  for (uint32_t i = 0; i < SIDE * SIDE; i++) {
    float x = (float)(i % SIDE) / 2 - 15, y = (float)(i / SIDE) / 2 - 15;
    point[i][0] = x;
    point[i][1] = y;
    point[i][2] = f(x, y);
    if (i % SIDE < SIDE - 1 && i / SIDE < SIDE - 1) {
      const uint32_t corner[4] = {i, i + 1, i + SIDE + 1, i + SIDE};
      for (int k = 0; k < 4; k++)
        square[squares][k] = corner[k];
      squares++;
    }
  }
  recto_mesh mesh = {.points_single = point[0],
                     .point_count = SIDE * SIDE,
                     .corners = square[0],
                     .corner_count = 4 * squares,
                     .face_size = 4};

  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = 30;
  options.camera.elevation_deg = 30;
  options.camera.up[2] = 1;            /* z */
  options.ink.edges = RECTO_EDGES_ALL; /* smooth ones too: the grid */

  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  bool ok = recto_scene_create(&scene, &error) == RECTO_OK &&
            recto_scene_add_mesh(scene, &mesh, &error) == RECTO_OK &&
            recto_scene_render(scene, &options, &drawing, &error) == RECTO_OK &&
            recto_drawing_write(drawing, argc > 1 ? argv[1] : "-", "svg",
                                &options, &error) == RECTO_OK;
  if (!ok)
    fprintf(stderr, "surface: %s\n", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ok ? 0 : 1;
}
