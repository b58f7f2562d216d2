/* test_null.c - every call of the public interface accepts NULL or refuses it.
 * */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"

static const double origin[3] = {0, 0, 0};
static const uint32_t corner[3] = {0, 1, 2};

/* A triangle, and its drawing. */
struct things {
  recto_scene *scene;
  recto_drawing *drawing;
};

static int make_things(void **state) {
  recto_options options;
  recto_options_init(&options);
  options.results = RECTO_RESULTS_ALL; /* an edge and a fragment are there */
  static const double point[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  static struct things things;
  recto_error error;
  assert_int_equal(recto_scene_create(&things.scene, &error), RECTO_OK);
  for (int k = 0; k < 3; k++)
    assert_int_equal(
        recto_scene_add_point(things.scene, point[k], NULL, &error), RECTO_OK);
  assert_int_equal(recto_scene_add_face(things.scene, corner, 3, &error),
                   RECTO_OK);
  assert_int_equal(
      recto_scene_render(things.scene, &options, &things.drawing, &error),
      RECTO_OK);
  *state = &things;
  return 0;
}

static int drop_things(void **state) {
  struct things *things = *state;
  recto_scene_destroy(things->scene);
  recto_drawing_destroy(things->drawing);
  return 0;
}

/* Asserts that the call is refused, with a record of the error and without. */
#define REFUSED(call)                                                          \
  do {                                                                         \
    recto_error record, *error = &record;                                      \
    memset(&record, 0, sizeof record);                                         \
    if ((call) != RECTO_ERROR_ARGUMENT)                                        \
      fail_msg("%s is not refused", #call);                                    \
    assert_int_equal(record.code, RECTO_ERROR_ARGUMENT);                       \
    assert_non_null(strstr(record.text, "NULL was given for the "));           \
    error = NULL;                                                              \
    if ((call) != RECTO_ERROR_ARGUMENT)                                        \
      fail_msg("%s is not refused without a record", #call);                   \
  } while (0)

static void calls_with_a_status_refuse_it(void **state) {
  struct things *things = *state;
  recto_scene *scene = things->scene;
  recto_drawing *drawing = things->drawing, *made;
  recto_verdict verdict;
  REFUSED(recto_draw_file(NULL, NULL, "o.svg", NULL, NULL, error));
  REFUSED(recto_draw_file("i.obj", NULL, NULL, NULL, NULL, error));
  REFUSED(recto_draw_file("i.obj", "obj", NULL, "svg", NULL, error));
  REFUSED(recto_scene_create(NULL, error));
  REFUSED(recto_scene_read(NULL, "i.obj", NULL, NULL, error));
  REFUSED(recto_scene_read(scene, NULL, NULL, NULL, error));
  REFUSED(recto_scene_read(scene, NULL, "obj", NULL, error));
  REFUSED(recto_scene_add_point(NULL, origin, NULL, error));
  REFUSED(recto_scene_add_point(scene, NULL, NULL, error));
  REFUSED(recto_scene_add_group(NULL, "a", error));
  REFUSED(recto_scene_add_group(scene, NULL, error));
  REFUSED(recto_scene_add_face(NULL, corner, 3, error));
  REFUSED(recto_scene_add_face(scene, NULL, 3, error));
  REFUSED(recto_scene_add_face(scene, NULL, 0, error));
  REFUSED(recto_scene_add_polyline(NULL, corner, 2, error));
  REFUSED(recto_scene_add_polyline(scene, NULL, 2, error));
  made = drawing;
  REFUSED(recto_scene_render(NULL, NULL, &made, error));
  assert_null(made);
  REFUSED(recto_scene_render(scene, NULL, NULL, error));
  REFUSED(recto_drawing_write(NULL, "o.svg", NULL, NULL, error));
  REFUSED(recto_drawing_write(drawing, NULL, NULL, NULL, error));
  REFUSED(recto_drawing_write(drawing, NULL, "svg", NULL, error));
  memset(&verdict, 1, sizeof verdict);
  REFUSED(recto_scene_check(NULL, "o.svg", NULL, &verdict, error));
  assert_true(verdict.drawn_mm == 0);
  REFUSED(recto_scene_check(scene, NULL, NULL, &verdict, error));
  REFUSED(recto_scene_check(scene, "o.svg", NULL, NULL, error));
}

static void calls_without_one_do_nothing(void **state) {
  recto_stroke stroke;
  (void)state;
  recto_scene_destroy(NULL);
  recto_drawing_destroy(NULL);
  recto_options_init_sized(NULL, sizeof(recto_options));
  assert_null(recto_output_format(NULL, NULL));
  assert_string_equal(recto_output_format(NULL, "svg"), "svg");
  assert_null(recto_drawing_verdict(NULL));
  assert_non_null(recto_drawing_stats(NULL));
  assert_int_equal(recto_drawing_stroke_count(NULL), 0);
  assert_false(recto_drawing_stroke(NULL, 0, &stroke));
  assert_int_equal(stroke.count, 0);
  assert_null(stroke.points);
}

/* A size of 0 is no struct: nothing is written, and nothing is there. */
static void no_struct_has_the_size_0(void **state) {
  struct things *things = *state;
  recto_drawing *drawing = things->drawing;
  recto_verdict verdict = {.drawn_mm = 1};
  recto_layer layer = {.pen = 77};
  recto_stroke stroke = {.count = 77};
  recto_edge edge = {.number = 77};
  recto_fragment fragment = {.face = 77};
  recto_options options = {.verify = 77};
  recto_options_init_sized(&options, 0);
  recto_options_init_sized(&options, sizeof options.size - 1);
  assert_int_equal(options.verify, 77);
  assert_false(recto_drawing_layer_sized(drawing, 0, &layer, 0));
  assert_int_equal(layer.pen, 77);
  assert_false(recto_drawing_stroke_sized(drawing, 0, &stroke, 0));
  assert_int_equal(stroke.count, 77);
  assert_false(recto_drawing_edge_sized(drawing, 0, &edge, 0));
  assert_int_equal(edge.number, 77);
  assert_false(recto_drawing_fragment_sized(drawing, 0, &fragment, 0));
  assert_int_equal(fragment.face, 77);
  REFUSED(recto_scene_check_sized(things->scene, "o.svg", NULL, &verdict, 0,
                                  error));
  assert_true(verdict.drawn_mm == 1);
}

static void there_is_nothing_past_the_last_stroke(void **state) {
  struct things *things = *state;
  size_t count = recto_drawing_stroke_count(things->drawing);
  assert_true(count > 0);
  recto_stroke stroke;
  assert_true(recto_drawing_stroke(things->drawing, count - 1, &stroke));
  assert_true(stroke.count > 0);
  assert_false(recto_drawing_stroke(things->drawing, count, &stroke));
  assert_int_equal(stroke.count, 0);
  assert_false(recto_drawing_stroke(things->drawing, SIZE_MAX, &stroke));
}

static void what_may_be_null_may_be(void **state) {
  struct things *things = *state;
  recto_drawing *drawing;
  assert_int_equal(recto_scene_add_point(things->scene, origin, NULL, NULL),
                   RECTO_OK);
  assert_int_equal(recto_scene_render(things->scene, NULL, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(calls_with_a_status_refuse_it),
      cmocka_unit_test(calls_without_one_do_nothing),
      cmocka_unit_test(no_struct_has_the_size_0),
      cmocka_unit_test(there_is_nothing_past_the_last_stroke),
      cmocka_unit_test(what_may_be_null_may_be),
  };
  return cmocka_run_group_tests_name("null", tests, make_things, drop_things);
}
