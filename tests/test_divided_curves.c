/* test_divided_curves.c - how far from the surface the visibility of a contour
 * is sampled. */
#include "visibility/contour/divided_curves.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* A line of short sides, a long one in the middle, and short ones; mm. */
enum { SHORT_SIDES = 8, SIDES = 2 * SHORT_SIDES + 1 };
#define SHORT_MM 0.1
#define SHORT_WIDTH_MM 0.05

struct line {
  struct sheet sheet; /* its camera alone */
  struct zero_set set;
  struct contour_curves curves;
  struct divided_curves divided;
};

static void add_side(struct line *line, double from, double to, double width) {
  uint32_t i = (uint32_t)line->set.segment.count;
  struct contour_node made = {.flat = {to, 50, 0}};
  made.page = divided_curves_project(&line->divided, made.flat);
  struct contour_segment side = {.node = {i, i + 1},
                                 .normal = {0, 1, 0},
                                 .radial = 1,
                                 .height = width,
                                 .width = width};
  if (i == 0) {
    struct contour_node first = {.flat = {from, 50, 0}};
    first.page = divided_curves_project(&line->divided, first.flat);
    assert_true(ARRAY_PUSH(&line->set.node, first));
  }
  assert_true(ARRAY_PUSH(&line->set.node, made));
  assert_true(ARRAY_PUSH(&line->set.segment, side));
  assert_true(ARRAY_PUSH(&line->curves.step, ((struct contour_step){i, i})));
}

/* Divides the line at all of its nodes, so that each side has one sample. */
static void start(struct line *line, double long_mm, double long_width_mm) {
  *line = (struct line){.set = {.node = {0}}};
  line->sheet.camera = (struct camera){.right = {1, 0, 0},
                                       .up = {0, 1, 0},
                                       .back = {0, 0, 1},
                                       .eye = {0, 0, 10},
                                       .s = 1,
                                       .d_max = 20,
                                       .page_mm = {200, 100}};
  line->curves.set = &line->set;
  line->divided =
      (struct divided_curves){.sheet = &line->sheet,
                              .curves = &line->curves,
                              .projection = projection_of(&line->sheet.camera)};
  double at = 20;
  for (int i = 0; i < SIDES; i++) {
    bool is_long = i == SHORT_SIDES;
    double to = at + (is_long ? long_mm : SHORT_MM);
    add_side(line, at, to, is_long ? long_width_mm : SHORT_WIDTH_MM);
    at = to;
  }
  assert_true(ARRAY_PUSH(&line->curves.step,
                         ((struct contour_step){SIDES, SHEET_NONE})));
  assert_true(ARRAY_PUSH(&line->curves.curve,
                         ((struct contour_curve){.step = 0, .count = SIDES})));
  for (uint32_t i = 1; i < SIDES; i++)
    assert_true(ARRAY_PUSH(&line->curves.cut, contour_cut_at(i)));
  assert_true(divided_curves_find(&line->divided));
  assert_int_equal(line->divided.sample.count, SIDES);
}

static void finish(struct line *line) {
  divided_curves_fini(&line->divided);
  contour_curves_fini(&line->curves);
  zero_set_fini(&line->set);
}

/* The height about a side, mm: its sample is a tenth of it beside the side. */
static double height_at(const struct line *line, int side) {
  double beside = (double)line->divided.sample.item[side].aside.on.y -
                  (double)line->set.node.item[side].page.y;
  return 10 * beside / SHEET_UNITS_PER_MM;
}

static void a_long_side_has_the_height_of_its_triangles(void **state) {
  (void)state;
  struct line line;
  start(&line, 20, 1);
  assert_true(fabs(height_at(&line, SHORT_SIDES) - 1) < 0.01);
  for (int i = 0; i < SIDES; i++)
    if (i != SHORT_SIDES)
      assert_true(fabs(height_at(&line, i) - SHORT_WIDTH_MM) < 0.01);
  finish(&line);
}

/* One side as long as the others, but at a triangle that is higher. */
static void a_single_height_does_not_count(void **state) {
  (void)state;
  struct line line;
  start(&line, SHORT_MM, 1);
  for (int i = 0; i < SIDES; i++)
    assert_true(fabs(height_at(&line, i) - SHORT_WIDTH_MM) < 0.01);
  finish(&line);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_long_side_has_the_height_of_its_triangles),
      cmocka_unit_test(a_single_height_does_not_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
