/* flaws.c - faces that a sound mesh would not have: edge-on, needles, no area,
 * collinear or repeated corners; and bars thinner than any pitch. */
#include "tests/scenes/scenes.h"

/* Faces in planes that hold the viewing direction of the front view. */
static void add_edge_on(struct scene *scene) {
  build_parallelogram(scene, vector_of(-2, -3, -1), vector_of(0, 5, 0),
                      vector_of(0, 0, 2));
  build_parallelogram(scene, vector_of(-3, -2, 0.25), vector_of(6, 0, 0),
                      vector_of(0, 3, 0));
  build_parallelogram(scene, vector_of(-1, -2, -2), vector_of(2, 0, 4),
                      vector_of(0, 4, 0));
}

static void add_needles(struct scene *scene) {
  static const double needle[4][9] = {
      {-3, -2, 0, 3, -2, 0.125, 3, -2, 0.1250001},
      {-3, -1.5, 1, 3, 1.5, 1.00000001, 3, 1.5, 1},
      {-2, -2, -2, 2, 2, 2, 2.0000001, 2, 2},
      {0, -3, -2, 0x1p-40, -3, 2, 0, -2, 2},
  };
  for (unsigned i = 0; i < 4; i++)
    build_polygon(scene, needle[i], 3);
}

static void add_zero_area(struct scene *scene) {
  static const double nothing[3][12] = {
      {-2, -2, 0, 0, -2, 0, 2, -2, 0, 1, -2, 0},
      {-2, -2, 1, 2, -2, 1, -2, -2, 1, 2, -2, 1},
      {-2, -3, -1, -1, -3, -0.5, 2, -3, 1, 0, -3, 0},
  };
  for (unsigned i = 0; i < 3; i++)
    build_polygon(scene, nothing[i], 4);
}

static void add_collinear(struct scene *scene) {
  static const double square[24] = {
      -2, -2, -2, 0, -2, -2, 2, -2, -2, 2,  -2, -1,
      2,  -2, 0,  1, -2, 0,  0, -2, 0,  -2, -2, 0,
  };
  static const double wedge[15] = {
      -2, -1.5, 1, 2, -1.5, 1, 1, -1.5, 1.5, 0, -1.5, 2, -1, -1.5, 1.5,
  };
  build_polygon(scene, square, 8);
  build_polygon(scene, wedge, 5);
}

static void add_repeated(struct scene *scene) {
  uint32_t a = build_point(scene, -2, -2, -2);
  uint32_t b = build_point(scene, 2, -2, -2);
  uint32_t c = build_point(scene, 2, -2, 0);
  uint32_t d = build_point(scene, -2, -2, 0);
  uint32_t b2 = build_point(scene, 2, -2, -2);
  uint32_t corner[] = {a, b, b, b2, c, d, d};
  /* A spike that goes out and comes back, as exporters leave them. */
  uint32_t tip = build_point(scene, 3, -2, 1);
  uint32_t spike[] = {d, c, tip, c, build_point(scene, 0, -2, 2)};
  build_face(scene, corner, 7);
  build_face(scene, spike, 5);
}

void scenes_flaw(struct scene *scene, recto_options *options,
                 enum scenes_flaw flaw) {
  static void (*const add[SCENES_FLAW_COUNT])(struct scene *) = {
      add_edge_on, add_needles, add_zero_area, add_collinear, add_repeated,
  };
  build_group(scene, "cube");
  build_box(scene, vector_of(-1, -1, -1), vector_of(1, 1, 1));
  build_group(scene, "flawed");
  for (unsigned i = 0; i < SCENES_FLAW_COUNT; i++)
    if (flaw == SCENES_FLAW_COUNT || flaw == (enum scenes_flaw)i)
      add[i](scene);
  if (flaw == SCENES_FLAW_EDGE_ON)
    scenes_view_direction(options, 0, 0);
  else
    scenes_view_direction(options, 21, 13);
}

void scenes_thin_bars(struct scene *scene, recto_options *options, unsigned n) {
  double width = 0.5;
  build_parallelogram(scene, vector_of(-1, 0, -1), vector_of(n + 1.0, 0, 0),
                      vector_of(0, 0, 6));
  for (unsigned i = 0; i < n; i++) {
    build_parallelogram(scene, vector_of(i, -1, 0), vector_of(width, 0, 0.3),
                        vector_of(0.2, 0, 4));
    width *= 2.0 / 3.0;
  }
  scenes_view_direction(options, 5, 8);
}
