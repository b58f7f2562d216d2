/* faces.c - the visible faces as polygons with holes, in a table whose column
 * `wkt` geographic programs and databases read: faces MODEL >FACES.csv */
#include <stdio.h>

#include "recto.h"

/* A ring of WKT ends where it started. */
static void write_ring(const recto_half_edge *side, uint32_t count) {
  putchar('(');
  for (uint32_t k = 0; k <= count; k++)
    printf("%s%.6f %.6f", k > 0 ? "," : "", side[k % count].x_mm,
           side[k % count].y_mm);
  putchar(')');
}

static void write_faces(const recto_drawing *drawing) {
  size_t count;
  recto_fragment fragment;
  const recto_loop *loop = recto_drawing_loops(drawing, &count);
  const recto_half_edge *side = recto_drawing_half_edges(drawing, &count);
  printf("face,brightness,wkt\n");
  for (size_t i = 0; recto_drawing_fragment(drawing, i, &fragment); i++) {
    printf("%u,%.3f,\"POLYGON(", fragment.face, fragment.brightness);
    for (uint32_t k = 0; k < fragment.loop_count; k++) {
      const recto_loop *ring = loop + fragment.loop + k;
      if (k > 0)
        putchar(',');
      write_ring(side + ring->half_edge, ring->count);
    }
    printf(")\"\n");
  }
}

int main(int argc, char **argv) {
  recto_options options;
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  if (argc != 2) {
    fputs("usage: faces MODEL >FACES\n", stderr);
    return 2;
  }
  recto_options_init(&options);
  options.results = RECTO_RESULT_FACES;
  bool ok =
      recto_scene_create(&scene, &error) == RECTO_OK &&
      recto_scene_read(scene, argv[1], NULL, &options, &error) == RECTO_OK &&
      recto_scene_render(scene, &options, &drawing, &error) == RECTO_OK;
  if (ok)
    write_faces(drawing);
  else
    fprintf(stderr, "faces: %s\n", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ok && fclose(stdout) == 0 ? 0 : 1;
}
