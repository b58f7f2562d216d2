/* dxf.c - a writer of one's own: the lines of a drawing in the format of CAD
 * programs, hidden ones on a layer of their own: dxf MODEL >DRAWING.dxf */
#include <stdio.h>

#include "recto.h"

/* DXF is pairs of lines, a code that says what follows and its value. */
static void write_line(unsigned pen, const double from[2], const double to[2]) {
  printf("0\nLINE\n8\nPEN%u\n", pen);
  printf("10\n%.4f\n20\n%.4f\n30\n0\n", from[0], from[1]);
  printf("11\n%.4f\n21\n%.4f\n31\n0\n", to[0], to[1]);
}

static void write_drawing(const recto_drawing *drawing) {
  double page_mm[2];
  recto_stroke stroke;
  recto_layer layer;
  recto_drawing_page(drawing, page_mm);
  printf("0\nSECTION\n2\nHEADER\n9\n$LIMMIN\n10\n0\n20\n0\n");
  printf("9\n$LIMMAX\n10\n%.4f\n20\n%.4f\n0\nENDSEC\n", page_mm[0], page_mm[1]);
  printf("0\nSECTION\n2\nENTITIES\n");
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++) {
    const double *point = stroke.points;
    recto_drawing_layer(drawing, stroke.layer, &layer);
    for (size_t k = 1; k < stroke.count; k++)
      write_line(layer.pen, point + 2 * (k - 1), point + 2 * k);
    if (stroke.closed)
      write_line(layer.pen, point + 2 * (stroke.count - 1), point);
  }
  printf("0\nENDSEC\n0\nEOF\n");
}

int main(int argc, char **argv) {
  recto_options options;
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  if (argc != 2) {
    fputs("usage: dxf MODEL >DRAWING\n", stderr);
    return 2;
  }
  recto_options_init(&options);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  bool ok =
      recto_scene_create(&scene, &error) == RECTO_OK &&
      recto_scene_read(scene, argv[1], NULL, &options, &error) == RECTO_OK &&
      recto_scene_render(scene, &options, &drawing, &error) == RECTO_OK;
  if (ok)
    write_drawing(drawing);
  else
    fprintf(stderr, "dxf: %s\n", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ok && fclose(stdout) == 0 ? 0 : 1;
}
