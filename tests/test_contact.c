/* test_contact.c - faces in contact do not hide each other, however they are
 * rotated: the drawn length of scenes in contact changes as little as the angle
 * does. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/scenes/build.h"
#include "tests/scenes/pipeline.h"

enum { ANGLES = 200, SIDES = 24 };

/* ---- Scenes -------------------------------------------------------------- */

static void add_box_on_table(struct scene *scene) {
  build_box(scene, vector_of(-5, -4, -0.25), vector_of(5, 4, 0));
  build_box(scene, vector_of(-1, -1.5, 0), vector_of(1.5, 1, 2));
}

static void add_cube_stack(struct scene *scene) {
  double low = 0, size = 3;
  for (int i = 0; i < 5; i++) {
    build_box(scene, vector_of(-size / 2, -size / 2, low),
              vector_of(size / 2, size / 2, low + size));
    low += size;
    size *= 0.75;
  }
}

/* A prism that has sides right and left of its axis, which is upright. */
static void add_cylinder(struct scene *scene, double x, double low,
                         double high) {
  const double pi = 3.14159265358979323846;
  uint32_t ring[2][SIDES];
  for (int k = 0; k < SIDES; k++) {
    double angle = pi * (2 * k + 1) / SIDES;
    /* The radius to a side's middle is 1: neighbours' walls agree exactly. */
    double across = k == 0 || k == SIDES - 1 ? 1
                    : k == SIDES / 2 || k == SIDES / 2 - 1
                        ? -1
                        : cos(angle) / cos(pi / SIDES);
    double along = sin(angle) / cos(pi / SIDES);
    ring[0][k] = build_point(scene, x + across, along, low);
    ring[1][k] = build_point(scene, x + across, along, high);
  }
  for (int k = 0; k < SIDES; k++) {
    int next = (k + 1) % SIDES;
    build_quad(scene, ring[0][k], ring[0][next], ring[1][next], ring[1][k]);
  }
  build_face(scene, ring[1], SIDES);
  for (int k = 0; k < SIDES / 2; k++) {
    uint32_t swap = ring[0][k];
    ring[0][k] = ring[0][SIDES - 1 - k];
    ring[0][SIDES - 1 - k] = swap;
  }
  build_face(scene, ring[0], SIDES);
}

/* Two side by side, wall on wall, and one that stands on the first. */
static void add_cylinders(struct scene *scene) {
  add_cylinder(scene, 0, 0, 3);
  add_cylinder(scene, 2, 0.5, 2.5);
  add_cylinder(scene, 0, 3, 4);
}

/* ---- Turning ------------------------------------------------------------- */

enum {
  FROM_ASIDE = 37, /* no wall of a cylinder is seen edge-on */
  EDGE_ON = 45
}; /* one on either side is */

enum rounding {
  EXACT,  /* double precision */
  SINGLE, /* single precision */
  FAR     /* single precision, a hundred sizes from the origin and more */
};

/* In single precision a coordinate of a million is off by a 32nd. */
static void move_far(struct scene *scene) {
  for (size_t i = 0; i < scene->point.count; i++) {
    struct scene_point *p = &scene->point.item[i];
    *p =
        (struct scene_point){1e6 + 20 * p->x, 1e6 + 20 * p->y, 20 * p->z - 1e6};
  }
}

static double length_of(void (*add)(struct scene *), int azimuth,
                        double radians, enum rounding rounding) {
  struct scene scene;
  struct pipeline pipeline;
  recto_options options;
  recto_options_init(&options);
  options.ink.min_stroke_mm = 0;
  options.output.unit_mm = 1e-3; /* SVG's: a wall against a wall is one line */
  options.camera.azimuth_deg = azimuth;
  options.camera.elevation_deg = 31;
  scene_init(&scene);
  scene.up[1] = 0;
  scene.up[2] = 1;
  add(&scene);
  scenes_turn(&scene, vector_of(2, 3, 6), radians); /* an axis of no meaning */
  if (rounding == FAR)
    move_far(&scene);
  if (rounding != EXACT)
    scenes_round_to_float(&scene);
  pipeline_run(&pipeline, &scene, &options, &solver_tiles);
  assert_int_equal(pipeline.status, RECTO_OK);
  double length = pipeline_length(&pipeline, RECTO_EDGES_ALL, false);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
  return length;
}

/* Relative to its length the drawing changes by less than the angle, in
 * radians, and what the page's grid and the points' roundings explain; both
 * from where it stood and from one angle to the next.  Single precision rounds
 * the coordinates, of 5 at most, by 2.4e-7 at most: of a drawing whose lines
 * add up to more than ten times as much, each moved at both ends but none like
 * the next, that is less than 1e-7. */
static void assert_steady(void (*add)(struct scene *), int azimuth,
                          double least, double most, enum rounding rounding) {
  const double noise = rounding == FAR      ? 1e-2
                       : rounding == SINGLE ? 1e-7
                                            : 2e-8;
  double still = length_of(add, azimuth, 0, rounding), last = still,
         last_angle = 0;
  assert_true(still > 500);
  for (int i = 0; i < ANGLES; i++) {
    double angle = least * pow(most / least, i / (ANGLES - 1.0));
    double length = length_of(add, azimuth, angle, rounding);
    double change = fabs(length - still) / still;
    double step = fabs(length - last) / still;
    if (!(change < angle + noise && step < angle - last_angle + noise))
      fail_msg("turned by %g: %g mm for %g, and %g before", angle, length,
               still, last);
    assert_true(rounding == FAR || angle > 1e-7 || change < 1e-4);
    last = length;
    last_angle = angle;
  }
}

static void a_box_on_a_table_is_steady(void **state) {
  (void)state;
  assert_steady(add_box_on_table, FROM_ASIDE, 1e-9, 1e-4, EXACT);
  assert_steady(add_box_on_table, FROM_ASIDE, 1e-9, 1e-4, SINGLE);
}

static void a_stack_of_cubes_is_steady(void **state) {
  (void)state;
  assert_steady(add_cube_stack, FROM_ASIDE, 1e-9, 1e-4, EXACT);
  assert_steady(add_cube_stack, FROM_ASIDE, 1e-9, 1e-4, SINGLE);
}

static void touching_cylinders_are_steady(void **state) {
  (void)state;
  assert_steady(add_cylinders, FROM_ASIDE, 1e-9, 1e-4, EXACT);
  assert_steady(add_cylinders, FROM_ASIDE, 1e-9, 1e-4, SINGLE);
}

/* A wall that rounding twists has one triangle that is seen from before and
 * one from behind.  Beyond 1e-5 its two sides come out as two lines. */
static void walls_seen_edge_on_keep_their_outline(void **state) {
  (void)state;
  assert_steady(add_cylinders, EDGE_ON, 1e-9, 1e-5, EXACT);
  assert_steady(add_cylinders, EDGE_ON, 1e-9, 1e-5, SINGLE);
}

static void far_from_the_origin_they_are_steady_too(void **state) {
  (void)state;
  assert_steady(add_box_on_table, FROM_ASIDE, 1e-9, 1e-4, FAR);
  assert_steady(add_cube_stack, FROM_ASIDE, 1e-9, 1e-4, FAR);
  assert_steady(add_cylinders, FROM_ASIDE, 1e-9, 1e-4, FAR);
}

/* What the others stand on: a compiler that skips the rounding must not make
 * them say that it does no harm. */
static void rounding_is_to_single_precision(void **state) {
  (void)state;
  struct scene scene;
  scene_init(&scene);
  build_point(&scene, 0.1, 1 + 0x1p-25, -1e-3);
  scenes_round_to_float(&scene);
  struct scene_point p = scene.point.item[0];
  assert_true(p.x == 0x1.99999ap-4);
  assert_true(p.y == 1);
  assert_true(p.z == -0x1.0624dep-10);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rounding_is_to_single_precision),
      cmocka_unit_test(a_box_on_a_table_is_steady),
      cmocka_unit_test(a_stack_of_cubes_is_steady),
      cmocka_unit_test(touching_cylinders_are_steady),
      cmocka_unit_test(walls_seen_edge_on_keep_their_outline),
      cmocka_unit_test(far_from_the_origin_they_are_steady_too),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
