/* gcode.c - a writer of one's own: a program for a machine that holds a pen,
 * which pauses for each pen: gcode MODEL >DRAWING.gcode */
#include <stdio.h>

#include "recto.h"

static void write_drawing(const recto_drawing *drawing) {
  double page_mm[2];
  recto_stroke stroke;
  recto_layer layer;
  uint32_t fetched = RECTO_NONE;
  recto_drawing_page(drawing, page_mm);
  printf("(page %g x %g mm)\nG21 G90\nG0 Z5\n", page_mm[0], page_mm[1]);
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++) {
    const double *point = stroke.points;
    if (stroke.layer != fetched) { /* strokes come layer by layer */
      fetched = stroke.layer;
      recto_drawing_layer(drawing, fetched, &layer);
      printf("M0 (pen %u, %g mm)\n", layer.pen, layer.width_mm);
    }
    printf("G0 X%.3f Y%.3f\nG1 Z0 F600\n", point[0], point[1]);
    for (size_t k = 1; k < stroke.count + stroke.closed; k++) {
      const double *to = point + 2 * (k % stroke.count);
      printf("G1 X%.3f Y%.3f F3000\n", to[0], to[1]);
    }
    printf("G0 Z5\n");
  }
  printf("G0 X0 Y0\nM2\n");
}

int main(int argc, char **argv) {
  recto_options options;
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  if (argc != 2) {
    fputs("usage: gcode MODEL >DRAWING\n", stderr);
    return 2;
  }
  recto_options_init(&options);
  options.ink.order = RECTO_ORDER_NEAR; /* short ways with the pen up */
  options.ink.has_weights = true;       /* every line one pen wide */
  options.output.unit_mm = 0.001;       /* as the coordinates are written */
  bool ok =
      recto_scene_create(&scene, &error) == RECTO_OK &&
      recto_scene_read(scene, argv[1], NULL, &options, &error) == RECTO_OK &&
      recto_scene_render(scene, &options, &drawing, &error) == RECTO_OK;
  if (ok)
    write_drawing(drawing);
  else
    fprintf(stderr, "gcode: %s\n", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ok && fclose(stdout) == 0 ? 0 : 1;
}
