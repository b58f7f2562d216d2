/* layers.c - large faces below small ones, coplanar and doubled faces, sheets
 * that nearly touch, slits. */
#include "tests/scenes/scenes.h"

void scenes_large_table(struct scene *scene, recto_options *options) {
  build_group(scene, "table");
  build_parallelogram(scene, vector_of(-50, -30, 0), vector_of(100, 0, 0),
                      vector_of(0, 60, 0));
  build_group(scene, "things");
  for (int i = 0; i < 5; i++) {
    double x = -40 + 18 * i, y = -25 + 11 * i;
    build_box(scene, vector_of(x, y, 0.5), vector_of(x + 2, y + 3, 3));
    build_box(scene, vector_of(x + 4, y, -3), vector_of(x + 6, y + 2, -0.5));
  }
  build_group(scene, "legs");
  for (int i = 0; i < 4; i++) {
    double x = i & 1 ? 47 : -49, y = i & 2 ? 27 : -29;
    build_box(scene, vector_of(x, y, -40), vector_of(x + 2, y + 2, -0.5));
  }
  scenes_view_direction(options, 15, 12);
}

void scenes_coplanar(struct scene *scene, recto_options *options) {
  /* Rectangles and a triangle of one plane, each over a part of the others;
   * the plane is z = x / 4 + y / 2, exact in doubles. */
  build_group(scene, "first");
  build_parallelogram(scene, vector_of(0, 0, 0), vector_of(4, 0, 1),
                      vector_of(0, 4, 2));
  build_group(scene, "second");
  build_parallelogram(scene, vector_of(2, 2, 1.5), vector_of(4, 0, 1),
                      vector_of(0, 4, 2));
  build_group(scene, "third");
  static const double triangle[9] = {1, 5, 2.75, 3, -1, 0.25, 7, 3, 3.25};
  build_polygon(scene, triangle, 3);
  /* One within the first, one that shares a side with it. */
  build_parallelogram(scene, vector_of(1, 1, 0.75), vector_of(1, 0, 0.25),
                      vector_of(0, 1, 0.5));
  build_parallelogram(scene, vector_of(4, 0, 1), vector_of(2, 0, 0.5),
                      vector_of(0, 4, 2));
  scenes_view_direction(options, -24, 52);
}

void scenes_doubled(struct scene *scene, recto_options *options) {
  for (unsigned i = 0; i < 2; i++) {
    build_group(scene, i == 0 ? "once" : "twice");
    build_box(scene, vector_of(-1, -1, -1), vector_of(1, 1, 1));
    build_parallelogram(scene, vector_of(-2, -0.5, 0), vector_of(4, 0, 0),
                        vector_of(0, 1, 0.5));
  }
  scenes_view_direction(options, 33, 27);
}

void scenes_two_colours(struct scene *scene, recto_options *options) {
  enum { fields = 4 };
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned y = 0; y <= fields; y++)
    for (unsigned x = 0; x <= fields; x++)
      build_point(scene, x, y, 0.25 * x - 0.5 * y);
  for (uint32_t y = 0; y < fields; y++) {
    for (uint32_t x = 0; x < fields; x++) {
      uint32_t a = first + y * (fields + 1) + x, d = a + fields + 1;
      build_group(scene, (x + y) % 2 == 0 ? "white" : "black");
      build_quad(scene, a, a + 1, d + 1, d);
    }
  }
  for (size_t i = 0; i < scene->group.count; i++) {
    scene->group.item[i].has_colour = true;
    scene->group.item[i].colour = i == 0 ? 0xffffff : 0x000000;
  }
  scenes_view_direction(options, 12, 64);
}

void scenes_near_sheets(struct scene *scene, recto_options *options,
                        double gap) {
  /* Unit of depth: the marks at z = 0 and z = 1 span the scene's depth. */
  build_group(scene, "marks");
  build_parallelogram(scene, vector_of(-2, -2, 0), vector_of(0.5, 0, 0),
                      vector_of(0, 0.5, 0));
  build_parallelogram(scene, vector_of(2, 2, 1), vector_of(0.5, 0, 0),
                      vector_of(0, 0.5, 0));
  /* z rises by 1/128 along x and 1/256 along y: a nanometre on the page, to
   * which points are rounded, is less than 1e-9 of the depth. */
  build_group(scene, "far sheet");
  build_parallelogram(scene, vector_of(-1.5, -1, 0.4),
                      vector_of(3, 0, 3 / 128.0), vector_of(0, 2, 2 / 256.0));
  build_group(scene, "near sheet");
  build_parallelogram(scene,
                      vector_of(-1, -1.5, 0.4 + gap + 0.5 / 128 - 0.5 / 256),
                      vector_of(3, 0, 3 / 128.0), vector_of(0, 2, 2 / 256.0));
  scenes_view_above(options);
  options->solver.contact = 0;
}

void scenes_slit(struct scene *scene, recto_options *options, double width_mm) {
  build_group(scene, "plates");
  build_parallelogram(scene, vector_of(10, 10, 5), vector_of(40, 0, 0),
                      vector_of(0, 30, 0));
  build_parallelogram(scene, vector_of(50 + width_mm, 10, 5),
                      vector_of(40, 0, 0), vector_of(0, 30, 0));
  build_group(scene, "behind");
  build_parallelogram(scene, vector_of(5, 20, 0), vector_of(90, 0, 0),
                      vector_of(0, 7, 0));
  scenes_view_page(options, 100, 50);
  options->ink.min_stroke_mm = 0;
}
