/* hides.c - which face hides the middle of a part of an edge: hides MODEL */
#include <stdio.h>

#include "recto.h"

/* The face that is visible at x, y: by the fragment whose sides a ray to the
 * right crosses an odd number of times. */
static uint32_t find_face(const recto_drawing *drawing, double x, double y) {
  size_t loops, sides;
  recto_fragment fragment;
  const recto_loop *loop = recto_drawing_loops(drawing, &loops);
  const recto_half_edge *side = recto_drawing_half_edges(drawing, &sides);
  for (size_t i = 0; recto_drawing_fragment(drawing, i, &fragment); i++) {
    bool is_inside = false;
    for (uint32_t l = 0; l < fragment.loop_count; l++) {
      const recto_loop *ring = loop + fragment.loop + l;
      const recto_half_edge *a = side + ring->half_edge;
      for (uint32_t k = 0; k < ring->count; k++) {
        const recto_half_edge *p = a + k, *q = a + (k + 1) % ring->count;
        if ((p->y_mm > y) != (q->y_mm > y) &&
            x < p->x_mm +
                    (q->x_mm - p->x_mm) * (y - p->y_mm) / (q->y_mm - p->y_mm))
          is_inside = !is_inside;
      }
    }
    if (is_inside)
      return fragment.face;
  }
  return RECTO_NONE;
}

int main(int argc, char **argv) {
  recto_options options;
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  recto_edge edge;
  recto_options_init(&options);
  options.results = RECTO_RESULT_EDGES | RECTO_RESULT_FACES;
  bool ok =
      recto_scene_create(&scene, &error) == RECTO_OK &&
      recto_scene_read(scene, argc > 1 ? argv[1] : "-", argc > 1 ? NULL : "obj",
                       &options, &error) == RECTO_OK &&
      recto_scene_render(scene, &options, &drawing, &error) == RECTO_OK;
  for (size_t i = 0; ok && recto_drawing_edge(drawing, i, &edge); i++)
    for (size_t k = 0; k < edge.interval_count; k++) {
      const recto_interval *part = edge.intervals + k;
      if (part->hidden_by > 0 && edge.points[0] != RECTO_NONE)
        printf("edge %u-%u: %.4f to %.4f, in the middle behind face %u\n",
               edge.points[0], edge.points[1], part->t0, part->t1,
               find_face(drawing, (part->from_mm[0] + part->to_mm[0]) / 2,
                         (part->from_mm[1] + part->to_mm[1]) / 2));
    }
  if (!ok)
    fprintf(stderr, "hides: %s\n", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ok && fclose(stdout) == 0 ? 0 : 1;
}
