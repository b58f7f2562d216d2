/* test_api_prepare.c - a scene that was prepared is drawn as one that was not,
 * either by several threads at once; and a drawing is written by several. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"
#include "svg_text.h"

enum { RINGS = 12, SIDES = 20, VIEWS = 8 };

/* A bumpy torus whose quads have corners of their own, some of them moved apart
 * by less than single precision: borders until they are welded. */
static recto_scene *make_torus(void) {
  static float point[RINGS * SIDES * 12];
  static uint32_t corner[RINGS * SIDES * 4];
  size_t at = 0;
  for (int r = 0; r < RINGS; r++)
    for (int s = 0; s < SIDES; s++)
      for (int k = 0; k < 4; k++, at++) {
        double u = 2 * M_PI * ((r + (k == 1 || k == 2)) % RINGS) / RINGS;
        double v = 2 * M_PI * ((s + (k > 1)) % SIDES) / SIDES;
        double far = 3 + (1 + 0.2 * cos(5 * u)) * cos(v);
        point[3 * at] = (float)(far * cos(u));
        point[3 * at + 1] = (float)(far * sin(u));
        point[3 * at + 2] = nextafterf((float)sin(v), k == 2 ? 9 : -9);
        corner[at] = (uint32_t)at;
      }
  const recto_mesh mesh = {.points_single = point,
                           .point_count = at,
                           .corners = corner,
                           .corner_count = at,
                           .face_size = 4};
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  return scene;
}

/* ---- A drawing as text --------------------------------------------------- */

static void init_view(recto_options *options, int view) {
  recto_options_init(options);
  options->camera.azimuth_deg = 45 * view;
  options->camera.fov_deg = view % 2 ? 40 : 0;
  options->ink.fill = view % 3 ? RECTO_FILL_NONE : RECTO_FILL_HATCH;
  options->ink.hidden = view % 4 ? RECTO_HIDDEN_NONE : RECTO_HIDDEN_DASHED;
  options->solver.threads = 1;
}

/* NULL where it fails. */
static char *draw_view(const recto_scene *scene, int view) {
  recto_options options;
  recto_drawing *drawing;
  init_view(&options, view);
  if (recto_scene_render(scene, &options, &drawing, NULL) != RECTO_OK)
    return NULL;
  char *text = svg_text_of(drawing, NULL);
  recto_drawing_destroy(drawing);
  return text;
}

static void prepare(recto_scene *scene) {
  recto_options options;
  init_view(&options, 0);
  assert_int_equal(recto_scene_prepare(scene, &options, NULL), RECTO_OK);
}

static void assert_same_text(char *a, char *b) {
  assert_non_null(a);
  assert_non_null(b);
  assert_string_equal(a, b);
  free(a);
  free(b);
}

/* ---- Claims -------------------------------------------------------------- */

static void a_prepared_scene_is_drawn_as_one_that_is_not(void **state) {
  (void)state;
  recto_scene *plain = make_torus(), *prepared = make_torus();
  prepare(prepared);
  for (int view = 0; view < VIEWS; view++)
    assert_same_text(draw_view(plain, view), draw_view(prepared, view));
  recto_scene_destroy(plain);
  recto_scene_destroy(prepared);
}

static void other_options_are_prepared_by_the_render(void **state) {
  (void)state;
  recto_scene *plain = make_torus(), *prepared = make_torus();
  recto_options options;
  recto_options_init(&options);
  options.mesh.weld = 0; /* nothing but borders */
  options.mesh.crease_deg = 1;
  assert_int_equal(recto_scene_prepare(prepared, &options, NULL), RECTO_OK);
  assert_same_text(draw_view(plain, 1), draw_view(prepared, 1));
  recto_scene_destroy(plain);
  recto_scene_destroy(prepared);
}

/* An octagonal prism whose sides are of one smoothing group. */
static recto_scene *make_prism(void) {
  char text[2000], *to = text;
  for (int i = 0; i < 8; i++)
    to += sprintf(to, "v %.6f 0 %.6f\nv %.6f 1 %.6f\n", cos(i * M_PI / 4),
                  sin(i * M_PI / 4), cos(i * M_PI / 4), sin(i * M_PI / 4));
  to += sprintf(to, "s 1\n");
  for (int i = 0; i < 8; i++)
    to += sprintf(to, "f %d %d %d %d\n", 2 * i + 1, 2 * i + 2,
                  (2 * i + 3) % 16 + 1, (2 * i + 2) % 16 + 1);
  to += sprintf(to, "s off\nf 1 3 5 7 9 11 13 15\nf 16 14 12 10 8 6 4 2\n");
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read_memory(scene, text, (size_t)(to - text),
                                           "obj", NULL, NULL, NULL),
                   RECTO_OK);
  return scene;
}

static char *draw_marked(const recto_scene *scene, recto_crease_marks which,
                         double crease_deg) {
  recto_options options;
  recto_drawing *drawing;
  recto_options_init(&options);
  options.mesh.crease_marks = which;
  options.mesh.crease_deg = crease_deg;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  char *text = svg_text_of(drawing, NULL);
  recto_drawing_destroy(drawing);
  return text;
}

static void marks_are_those_of_the_render(void **state) {
  (void)state;
  recto_scene *plain = make_prism(), *prepared = make_prism();
  assert_int_equal(recto_scene_prepare(prepared, NULL, NULL), RECTO_OK);
  for (int which = 0; which <= RECTO_CREASE_MARKS_ALL; which++)
    for (double deg = 20; deg <= 30; deg += 10)
      assert_same_text(draw_marked(plain, which, deg),
                       draw_marked(prepared, which, deg));
  char *marked = draw_marked(prepared, RECTO_CREASE_MARKS_AUTO, 30);
  char *unmarked = draw_marked(prepared, RECTO_CREASE_MARKS_NONE, 30);
  assert_string_not_equal(marked, unmarked);
  assert_same_text(unmarked,
                   draw_marked(prepared, RECTO_CREASE_MARKS_AUTO, 20));
  free(marked);
  recto_scene_destroy(plain);
  recto_scene_destroy(prepared);
}

static void what_is_added_undoes_the_preparation(void **state) {
  (void)state;
  static const double point[3][3] = {{5, 0, 0}, {6, 0, 0}, {5, 0, 1}};
  recto_scene *plain = make_torus(), *prepared = make_torus();
  prepare(prepared);
  recto_scene *const both[] = {plain, prepared};
  for (int i = 0; i < 2; i++) {
    uint32_t corner[3];
    for (int k = 0; k < 3; k++)
      assert_int_equal(
          recto_scene_add_point(both[i], point[k], &corner[k], NULL), RECTO_OK);
    assert_int_equal(recto_scene_add_face(both[i], corner, 3, NULL), RECTO_OK);
  }
  assert_same_text(draw_view(plain, 0), draw_view(prepared, 0));
  recto_scene_destroy(plain);
  recto_scene_destroy(prepared);
}

struct task {
  const recto_scene *scene;
  int view;
  char *text;
};

static void *run(void *user) {
  struct task *task = user;
  task->text = draw_view(task->scene, task->view);
  return NULL;
}

static void draw_by_threads(const recto_scene *scene) {
  recto_scene *plain = make_torus();
  struct task task[VIEWS];
  pthread_t thread[VIEWS];
  for (int i = 0; i < VIEWS; i++) {
    task[i] = (struct task){scene, i, NULL};
    assert_int_equal(pthread_create(&thread[i], NULL, run, &task[i]), 0);
  }
  for (int i = 0; i < VIEWS; i++)
    assert_int_equal(pthread_join(thread[i], NULL), 0);
  for (int i = 0; i < VIEWS; i++)
    assert_same_text(task[i].text, draw_view(plain, i));
  recto_scene_destroy(plain);
}

static void several_threads_draw_a_scene_at_once(void **state) {
  (void)state;
  recto_scene *scene = make_torus();
  draw_by_threads(scene);
  prepare(scene);
  draw_by_threads(scene);
  recto_scene_destroy(scene);
}

struct write_task {
  const recto_drawing *drawing;
  char *text;
};

static void *write_drawing(void *user) {
  struct write_task *task = user;
  task->text = svg_text_of(task->drawing, NULL);
  return NULL;
}

/* The first writes of a drawing add to its stats. */
static void several_threads_write_a_drawing_at_once(void **state) {
  enum { TIMES = 30 };
  (void)state;
  recto_scene *scene = make_torus();
  for (int time = 0; time < TIMES; time++) {
    struct write_task task[VIEWS] = {{NULL, NULL}};
    pthread_t thread[VIEWS];
    recto_drawing *drawing;
    assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
    for (int i = 0; i < VIEWS; i++) {
      task[i].drawing = drawing;
      assert_int_equal(
          pthread_create(&thread[i], NULL, write_drawing, &task[i]), 0);
    }
    for (int i = 0; i < VIEWS; i++)
      assert_int_equal(pthread_join(thread[i], NULL), 0);
    for (int i = 1; i < VIEWS; i++) {
      assert_string_equal(task[i].text, task[0].text);
      free(task[i].text);
    }
    free(task[0].text);
    const char *once = strstr(recto_drawing_stats(drawing), "\"write_cpu_s\"");
    assert_non_null(once);
    assert_null(strstr(once + 1, "\"write_cpu_s\""));
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

static void bad_options_are_refused_and_prepare_nothing(void **state) {
  (void)state;
  recto_scene *scene = make_torus();
  recto_options options;
  recto_options_init(&options);
  options.mesh.crease_deg = NAN;
  assert_int_equal(recto_scene_prepare(scene, &options, NULL),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(recto_scene_prepare(NULL, NULL, NULL), RECTO_ERROR_ARGUMENT);
  char *text = draw_view(scene, 0);
  assert_non_null(text);
  free(text);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_prepared_scene_is_drawn_as_one_that_is_not),
      cmocka_unit_test(other_options_are_prepared_by_the_render),
      cmocka_unit_test(marks_are_those_of_the_render),
      cmocka_unit_test(what_is_added_undoes_the_preparation),
      cmocka_unit_test(several_threads_draw_a_scene_at_once),
      cmocka_unit_test(several_threads_write_a_drawing_at_once),
      cmocka_unit_test(bad_options_are_refused_and_prepare_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
