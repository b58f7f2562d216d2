/* paper.c - scenes in true scale: calibration, seams, worked examples. */
#include "scene/diagnostics.h"
#include "tests/scenes/scenes.h"

void scenes_calibration_square(struct scene *scene, recto_options *options) {
  static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  uint32_t ring[5];
  build_group(scene, "calibration");
  for (unsigned i = 0; i < 4; i++)
    ring[i] = build_point(scene, 55 + 100 * corner[i][0],
                          98.5 + 100 * corner[i][1], 0);
  ring[4] = ring[0];
  struct diagnostics silent = {.file = "scenes"};
  build_require(scene_add_wire(scene, ring, 5, 0, &silent, NULL) == RECTO_OK);
  scenes_view_page(options, 210, 297);
}

void scenes_calibration_grid(struct scene *scene, recto_options *options) {
  build_group(scene, "grid");
  for (unsigned i = 0; i <= 15; i++) {
    uint32_t a = build_point(scene, 30 + 10 * i, 48.5, 0);
    build_segment(scene, a, build_point(scene, 30 + 10 * i, 248.5, 0));
  }
  for (unsigned i = 0; i <= 20; i++) {
    uint32_t a = build_point(scene, 30, 48.5 + 10 * i, 0);
    build_segment(scene, a, build_point(scene, 180, 48.5 + 10 * i, 0));
  }
  scenes_view_page(options, 210, 297);
}

void scenes_white_square(struct scene *scene, recto_options *options,
                         unsigned n) {
  uint32_t first = (uint32_t)scene->point.count;
  build_group(scene, "white");
  scene->group.item[scene->current_group].has_colour = true;
  scene->group.item[scene->current_group].colour = 0xffffff;
  for (unsigned y = 0; y <= n; y++)
    for (unsigned x = 0; x <= n; x++)
      build_point(scene, 5 + 40.0 * x / n, 5 + 40.0 * y / n, 0);
  build_grid(scene, first, n, n, true);
  scenes_view_page(options, 50, 50);
  options->ink.fill = RECTO_FILL_PAINT;
}

/* Worked examples, from the classical texts' own figures. */

void scenes_pierced_rectangle(struct scene *scene, recto_options *options) {
  static const double rectangle[12] = {10, 5,  10, 10, 25, 10,
                                       25, 25, 10, 25, 5,  10};
  static const double triangle[9] = {15, 15, 15, 25, 25, 5, 30, 10, 5};
  build_group(scene, "1");
  build_polygon(scene, rectangle, 4);
  build_group(scene, "2");
  build_polygon(scene, triangle, 3);
  scenes_view_page(options, 32, 32);
}

void scenes_two_rectangles(struct scene *scene, recto_options *options) {
  static const double upright[12] = {10, 3,  20, 10, 28, 20,
                                     22, 28, 20, 22, 3,  20};
  static const double lying[12] = {5,  12, 10, 5,  20, 10,
                                   27, 20, 10, 27, 12, 10};
  static const double triangle[9] = {15, 15, 25, 25, 25, 5, 30, 10, 5};
  build_group(scene, "1");
  build_polygon(scene, upright, 4);
  build_group(scene, "2");
  build_polygon(scene, lying, 4);
  build_group(scene, "3");
  build_polygon(scene, triangle, 3);
  scenes_view_page(options, 32, 32);
}
