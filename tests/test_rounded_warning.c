/* test_rounded_warning.c - who draws lines of a part with rounded edges hears
 * that they show little of it, and nobody else does. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"

enum { STEPS = 3, LINES = 2 * STEPS + 2 };

/* The lines of a grid over the side of a block: its corners, and between them
 * and its edges the steps of the fillets. */
static void find_lines(double half, double radius, double line[LINES]) {
  for (int i = 0; i <= STEPS; i++) {
    double out = radius * tan(acos(-1) / 4 * (STEPS - i) / STEPS);
    line[i] = -half - out;
    line[LINES - 1 - i] = half + out;
  }
}

/* The point of the rounded block that is nearest to one of the block that
 * encloses it. */
static uint32_t add_rounded_point(recto_scene *scene, const double half[3],
                                  double radius, const double outer[3]) {
  double inner[3], out[3], point[3], length = 0;
  uint32_t index;
  for (int k = 0; k < 3; k++) {
    inner[k] = fmax(-half[k], fmin(half[k], outer[k]));
    out[k] = outer[k] - inner[k];
    length += out[k] * out[k];
  }
  for (int k = 0; k < 3; k++)
    point[k] = inner[k] + (length > 0 ? radius * out[k] / sqrt(length) : 0);
  assert_int_equal(recto_scene_add_point(scene, point, &index, NULL), RECTO_OK);
  return index;
}

static void add_side(recto_scene *scene, const double half[3], double radius,
                     int axis, int sign) {
  uint32_t point[LINES][LINES];
  double u[LINES], v[LINES], outer[3];
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  find_lines(half[a], radius, u);
  find_lines(half[b], radius, v);
  for (int i = 0; i < LINES; i++)
    for (int k = 0; k < LINES; k++) {
      outer[axis] = sign * (half[axis] + radius);
      outer[a] = u[i];
      outer[b] = sign * v[k];
      point[i][k] = add_rounded_point(scene, half, radius, outer);
    }
  for (int i = 0; i + 1 < LINES; i++)
    for (int k = 0; k + 1 < LINES; k++) {
      const uint32_t corner[] = {point[i][k], point[i + 1][k],
                                 point[i + 1][k + 1], point[i][k + 1]};
      if (u[i] < u[i + 1] && v[k] < v[k + 1])
        assert_int_equal(recto_scene_add_face(scene, corner, 4, NULL),
                         RECTO_OK);
    }
}

static void count_warning(void *user, const char *file, unsigned long line,
                          const char *text) {
  assert_string_equal(file, "");
  assert_int_equal(line, 0);
  if (strstr(text, "rounded edges") != NULL)
    ++*(int *)user;
}

/* How often it is heard of a block whose flats are 2 half[k] long and whose
 * edges have that radius. */
static int count_warnings(const double half[3], double radius,
                          recto_options *options) {
  recto_scene *scene;
  recto_drawing *drawing;
  int warnings = 0;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  for (int axis = 0; axis < 3; axis++)
    for (int sign = -1; sign < 2; sign += 2)
      add_side(scene, half, radius, axis, sign);
  options->warning = count_warning;
  options->user = &warnings;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return warnings;
}

static const double block[] = {20, 15, 10};

static void lines_of_a_rounded_block_are_warned_about(void **state) {
  recto_options options;
  (void)state;
  recto_options_init(&options);
  assert_int_equal(count_warnings(block, 4, &options), 1);
}

static void nothing_is_said_of_other_shapes(void **state) {
  static const double ball[] = {0, 0, 0};
  recto_options options;
  (void)state;
  recto_options_init(&options);
  assert_int_equal(count_warnings(block, 0, &options), 0);
  assert_int_equal(count_warnings(ball, 4, &options), 0);
  options.mesh.crease_deg = 5; /* its fillets have lines */
  assert_int_equal(count_warnings(block, 4, &options), 0);
}

static void nothing_is_said_where_more_than_lines_is_drawn(void **state) {
  (void)state;
  for (int what = 0; what < 4; what++) {
    recto_options options;
    recto_options_init(&options);
    options.ink.fill = what == 0   ? RECTO_FILL_SHADE
                       : what == 1 ? RECTO_FILL_HATCH
                                   : RECTO_FILL_NONE;
    if (what == 2)
      options.ink.edges |= RECTO_EDGE_SMOOTH;
    if (what == 3)
      options.ink.edges = RECTO_EDGE_SILHOUETTE;
    assert_int_equal(count_warnings(block, 4, &options), 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_of_a_rounded_block_are_warned_about),
      cmocka_unit_test(nothing_is_said_of_other_shapes),
      cmocka_unit_test(nothing_is_said_where_more_than_lines_is_drawn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
