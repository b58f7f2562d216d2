/* test_parts_read.c - parts of a model that they read themselves, block by
 * block, are those of the model when it was read before; and they hold less of
 * it. */
#define _GNU_SOURCE /* wait4 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "api/handle.h"
#include "base/sanitizer.h"
#include "tests/memory_peak.h"
#include "tests/svg_text.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"

/* ---- Models -------------------------------------------------------------- */

/* What makes a model such that a part needs more than one pass over it. */
enum oddity {
  PLAIN = 0,
  FAR_POINT = 1,   /* a point without a face, which the camera must not see */
  FLOOR = 2,       /* faces larger than windows */
  INTERLEAVED = 4, /* rows of points between rows of faces, and groups */
  WIRES = 8,
  TWICE = 16 /* with the floor: a far corner of it is a small face's too, by
                another point */
};

static void write_rows(FILE *file, int side, int from, int to, bool points,
                       bool relative) {
  int every = side / 4;
  for (int i = from; i < to; i++)
    for (int k = 0; k < side; k++) {
      double x = (double)k / side, y = (double)i / side;
      if (points)
        fprintf(file, "v %.5f %.5f %.5f\n", x, y,
                0.2 * x * (1 - x) * (1 + 7 * ((k + 2 * i) % every == 0)));
      else if (i > 0 && k > 0) {
        int a = i * side + k + 1, last = (i + 1) * side + 1;
        int b = a - 1, c = a - side, d = c - 1, to_end = relative ? last : 0;
        fprintf(file, "f %d %d %d\nf %d %d %d\n", a - to_end, b - to_end,
                d - to_end, a - to_end, d - to_end, c - to_end);
      }
    }
}

/* A bumpy surface of 2 (side - 1)^2 triangles. */
static void write_model(const char *path, int side, unsigned oddity) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  if (oddity & INTERLEAVED) {
    for (int i = 0; i < side; i++) {
      fprintf(file, "g row%d\n", i % 5);
      write_rows(file, side, i, i + 1, true, true);
      write_rows(file, side, i, i + 1, false, true);
    }
  } else {
    write_rows(file, side, 0, side, true, false);
    if (oddity & TWICE)
      fputs("v 2 -1 -.1\nv 2.2 -1 -.1\nv 2 -1.2 -.1\nf -1 -2 -3\n", file);
    if (oddity & FLOOR)
      fputs("f -1 1 -2\ng floor\nv -1 -1 -.1\nv 2 -1 -.1\nv 2 2 -.1\n"
            "v -1 2 -.1\nf -1 -2 -3 -4\nf -4 -3 -1\n",
            file);
    write_rows(file, side, 0, side, false, false);
  }
  if (oddity & FAR_POINT)
    fputs("v 17 -90 400\n", file);
  if (oddity & WIRES)
    fputs("l 1 3 9 2\ng wire\nl 7 1\n", file);
  assert_int_equal(fclose(file), 0);
}

/* ---- Parts --------------------------------------------------------------- */

static recto_scene *read_model(const char *model, bool for_parts) {
  recto_scene *scene;
  recto_error error = {0};
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  if ((for_parts
           ? recto_scene_read_for_parts(scene, model, NULL, NULL, &error)
           : recto_scene_read(scene, model, NULL, NULL, &error)) != RECTO_OK)
    fail_msg("%s", error.text);
  assert_int_equal(scene->is_deferred, for_parts);
  return scene;
}

static void write_part(const recto_scene *scene, const recto_options *options,
                       unsigned number, unsigned count, const char *path) {
  recto_error error = {0};
  bool is_there = false;
  if (recto_scene_write_part(scene, options, number, count, path, &error) !=
          RECTO_OK ||
      recto_scene_has_part(scene, options, number, count, path, &is_there,
                           &error) != RECTO_OK)
    fail_msg("%s", error.text);
  assert_true(is_there);
}

static void compare_files(const char *a, const char *b, unsigned number,
                          unsigned oddity) {
  size_t count[2];
  char *bytes[2] = {temporary_read(a, &count[0]), temporary_read(b, &count[1])};
  if (bytes[0] == NULL || bytes[1] == NULL || count[0] != count[1] ||
      memcmp(bytes[0], bytes[1], count[0]) != 0)
    fail_msg("part %u of model %u differs", number, oddity);
  free(bytes[0]);
  free(bytes[1]);
}

enum { PARTS = 5 };

/* Draws a model in parts both ways, and at once. */
static void compare_model(void *const *state, const char *path, unsigned oddity,
                          const recto_options *options) {
  char part[PARTS][400];
  const char *const all[PARTS] = {part[0], part[1], part[2], part[3], part[4]};
  recto_scene *held = read_model(path, false), *read = read_model(path, true);
  recto_drawing *whole, *joined;
  recto_error error = {0};
  for (unsigned i = 0; i < PARTS; i++) {
    char name[40];
    snprintf(name, sizeof name, "part-%u", i);
    snprintf(part[i], sizeof part[i], "%s", temporary_path(state, name));
    write_part(held, options, i + 1, PARTS, temporary_path(state, "held"));
    write_part(read, options, i + 1, PARTS, part[i]);
    compare_files(temporary_path(state, "held"), part[i], i + 1, oddity);
  }
  assert_int_equal(recto_scene_render(held, options, &whole, NULL), RECTO_OK);
  if (recto_join_parts(all, PARTS, options, &joined, &error) != RECTO_OK)
    fail_msg("model %u: %s", oddity, error.text);
  char *a = svg_text_of(whole, options), *b = svg_text_of(joined, options);
  if (a == NULL || b == NULL || strcmp(a, b) != 0)
    fail_msg("the drawing of model %u differs", oddity);
  free(a);
  free(b);
  recto_drawing_destroy(whole);
  recto_drawing_destroy(joined);
  recto_scene_destroy(held);
  recto_scene_destroy(read);
}

static void parts_that_read_are_the_same(void **state) {
  static const unsigned oddities[] = {
      PLAIN,
      FAR_POINT,
      FLOOR | TWICE,
      INTERLEAVED | WIRES,
      INTERLEAVED | FAR_POINT,
      FAR_POINT | FLOOR | WIRES,
  };
  char model[400];
  recto_options options;
  snprintf(model, sizeof model, "%s", temporary_path(state, "model.obj"));
  for (size_t i = 0; i < sizeof oddities / sizeof oddities[0]; i++) {
    write_model(model, 40, oddities[i]);
    recto_options_init(&options);
    compare_model(state, model, oddities[i], &options);
    options.ink.fill = RECTO_FILL_SHADE;
    options.ink.hidden = RECTO_HIDDEN_DASHED;
    compare_model(state, model, oddities[i], &options);
  }
}

/* ---- Errors -------------------------------------------------------------- */

static recto_status part_status(recto_scene *scene, const char *path,
                                recto_error *error) {
  return recto_scene_write_part(scene, NULL, 1, 2, path, error);
}

static void faults_of_the_model_are_told(void **state) {
  static const char broken[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 \x01\n";
  recto_scene *scene;
  recto_error error = {0};
  char model[400];
  const char *part = temporary_path(state, "part.recto");
  snprintf(model, sizeof model, "%s",
           temporary_file(state, "model.obj", broken, sizeof broken - 1));
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read_for_parts(scene, model, NULL, NULL, &error),
                   RECTO_OK);
  assert_int_equal(part_status(scene, part, &error), RECTO_ERROR_FORMAT);
  assert_string_equal(error.file, model);
  assert_int_equal(error.line, 5);
  /* It is not to be drawn with what was added later. */
  assert_int_equal(
      recto_scene_add_point(scene, (const double[3]){0, 0, 0}, NULL, NULL),
      RECTO_OK);
  assert_int_equal(part_status(scene, part, &error), RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
  /* The model is gone. */
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read_for_parts(scene, model, NULL, NULL, &error),
                   RECTO_OK);
  assert_int_equal(unlink(model), 0);
  assert_int_equal(part_status(scene, part, &error), RECTO_ERROR_IO);
  recto_scene_destroy(scene);
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read_for_parts(scene, model, NULL, NULL, &error),
                   RECTO_ERROR_IO);
  recto_scene_destroy(scene);
}

/* ---- Memory -------------------------------------------------------------- */

static void draw_at_once(const char *model) {
  recto_drawing *drawing;
  recto_scene *scene = read_model(model, false);
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void draw_part(const char *model, unsigned number, unsigned count,
                      const char *path) {
  recto_scene *scene = read_model(model, true);
  write_part(scene, NULL, number, count, path);
  recto_scene_destroy(scene);
}

/* Of a part, or with number 0 of all at once. */
struct part_run {
  const char *model, *path;
  unsigned number, count;
};

static bool draw_part_or_all(const void *user) {
  const struct part_run *run = user;
  if (run->number == 0)
    draw_at_once(run->model);
  else
    draw_part(run->model, run->number, run->count, run->path);
  return true;
}

static size_t peak_kb(const char *model, unsigned number, unsigned count,
                      const char *path) {
  return memory_peak_of(draw_part_or_all,
                        &(struct part_run){model, path, number, count}) /
         1024;
}

static void a_part_holds_less_than_a_third(void **state) {
  enum { SIDE = 700, COUNT = 16 };
  char model[400];
  if (is_under_valgrind() || SANITIZER_OF_ADDRESSES || SANITIZER_OF_THREADS)
    skip();
  const char *part = temporary_path(state, "part.recto");
  snprintf(model, sizeof model, "%s", temporary_path(state, "model.obj"));
  write_model(model, SIDE, FAR_POINT);
  size_t whole = peak_kb(model, 0, COUNT, part);
  for (unsigned i = 1; i <= COUNT; i += 5) {
    size_t own = peak_kb(model, i, COUNT, part);
    print_message("part %u of %d: %zu of %zu kB\n", i, COUNT, own, whole);
    assert_true(3 * own < whole);
  }
}

/* A torus of 2 side^2 triangles, few edges of which are silhouettes. */
static void write_torus(const char *path, int side) {
  const double step = 8 * atan(1) / side;
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  for (int i = 0; i < side * side; i++) {
    double around = step * (i / side), across = step * (i % side),
           radius = 2 + cos(across);
    fprintf(file, "v %.6f %.6f %.6f\n", radius * cos(around),
            radius * sin(around), sin(across));
  }
  for (int i = 0; i < side * side; i++) {
    int row = i - i % side, next = (row + side) % (side * side);
    int a = i + 1, b = row + (i + 1) % side + 1, c = next + i % side + 1,
        d = next + (i + 1) % side + 1;
    fprintf(file, "f %d %d %d\nf %d %d %d\n", a, c, d, a, d, b);
  }
  assert_int_equal(fclose(file), 0);
}

/* A drawing with one thread. */
struct drawn {
  const char *model;
  unsigned edges; /* 0: the default ones */
  bool from_eye;
};

static bool draw_with_one_thread(const void *user) {
  const struct drawn *drawn = user;
  recto_options options;
  recto_drawing *drawing;
  recto_scene *scene = read_model(drawn->model, false);
  recto_options_init(&options);
  options.solver.threads = 1;
  if (drawn->edges != 0)
    options.ink.edges = drawn->edges;
  if (drawn->from_eye) {
    options.camera.kind = RECTO_CAMERA_EYE;
    options.camera.fov_deg = 30;
    options.camera.eye[0] = 6;
    options.camera.eye[1] = 4;
    options.camera.eye[2] = 5;
  }
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return true;
}

/* What a large model takes that a small one does not, for each of so many
 * triangles. */
static double bytes_of_triangle(struct drawn small, struct drawn large,
                                double triangles) {
  double more = (double)memory_peak_of(draw_with_one_thread, &large) -
                (double)memory_peak_of(draw_with_one_thread, &small);
  print_message("edges %x%s: %.1f bytes a triangle\n", large.edges,
                large.from_eye ? " from an eye" : "", more / triangles);
  return more / triangles;
}

static void a_triangle_takes_few_bytes(void **state) {
  enum { SIDE = 700, LEAST = 20, LINES = 75, ALL = 120 };
  const double triangles = 2.0 * SIDE * SIDE;
  char small[400], large[400];
  if (is_under_valgrind() || SANITIZER_OF_ADDRESSES || SANITIZER_OF_THREADS)
    skip();
  snprintf(small, sizeof small, "%s", temporary_path(state, "model.obj"));
  snprintf(large, sizeof large, "%s", temporary_path(state, "all.obj"));
  write_torus(small, LEAST);
  write_torus(large, SIDE);
  for (int eye = 0; eye < 2; eye++) {
    struct drawn few = {small, 0, eye}, many = {large, 0, eye};
    assert_true(bytes_of_triangle(few, many, triangles) < LINES);
    few.edges = many.edges = RECTO_EDGES_ALL;
    assert_true(bytes_of_triangle(few, many, triangles) < ALL);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_part_holds_less_than_a_third,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(a_triangle_takes_few_bytes,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(parts_that_read_are_the_same,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(faults_of_the_model_are_told,
                                      temporary_set_up, temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
