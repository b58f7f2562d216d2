/* test_polls.c - the caller is asked often enough to cancel, whatever the work,
 * and may cancel at any time.
 *
 * How often is counted in polls for a mesh of 100,000 triangles, not measured
 * in time: a loop over triangles, edges or strokes that does not poll is missed
 * here. */
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
#include "tests/temporary.h"

/* ---- The work ------------------------------------------------------------ */

/* A surface with hills that hide each other, of 2 n n triangles. */
static recto_scene *make_hills(uint32_t n) {
  size_t side = n + 1;
  double *point = malloc(side * side * 3 * sizeof *point), *p = point;
  uint32_t *corner = malloc((size_t)n * n * 6 * sizeof *corner), *c = corner;
  recto_scene *scene;
  assert_true(point != NULL && corner != NULL);
  for (size_t i = 0; i < side * side; i++) {
    double x = (double)(i % side) / n, y = (double)(i / side) / n;
    *p++ = x;
    *p++ = 0.1 * sin(19 * x) * sin(23 * y);
    *p++ = y;
  }
  for (uint32_t i = 0; i < n * n; i++) {
    uint32_t at = i % n + i / n * (n + 1);
    const uint32_t own[6] = {at, at + 1,     at + n + 2,
                             at, at + n + 2, at + n + 1};
    memcpy(c, own, sizeof own);
    c += 6;
  }
  const recto_mesh mesh = {.points = point,
                           .point_count = side * side,
                           .corners = corner,
                           .corner_count = (size_t)n * n * 6};
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  free(point);
  free(corner);
  return scene;
}

struct listener {
  const char *stage;   /* whose polls are counted; NULL: all */
  int polls, last;     /* cancels at this one; 0: never */
  double first, share; /* of the first poll where `first` was negative; of the
                          last */
};

static pthread_t caller;

static bool listen(void *user, double share, const char *stage) {
  struct listener *listener = user;
  assert_true(share >= listener->share && share <= 1);
  assert_true(pthread_equal(pthread_self(), caller));
  listener->share = share;
  if (listener->first < 0)
    listener->first = share;
  if (listener->stage == NULL || strcmp(stage, listener->stage) == 0)
    listener->polls++;
  return listener->last == 0 || listener->polls < listener->last;
}

static void init(recto_options *options, struct listener *listener) {
  recto_options_init(options);
  options->camera.elevation_deg = 20;
  options->solver.threads = 1;
  options->progress = listen;
  options->user = listener;
}

static void all_edges(recto_options *o) {
  o->ink.edges = RECTO_EDGES_ALL;
  o->ink.hidden = RECTO_HIDDEN_LAYER;
  o->output.format = "hpgl"; /* in short order */
}
static void one_source(recto_options *o) {
  all_edges(o);
  o->ink.ids = true;
}
static void lines(recto_options *o) { (void)o; }
static void welded(recto_options *o) { o->mesh.weld = 1e-9; }
static void clipped(recto_options *o) {
  o->camera.fit = RECTO_FIT_SCALE;
  o->camera.scale = 300;
}
static void painted(recto_options *o) { o->ink.fill = RECTO_FILL_PAINT; }
static void hatched(recto_options *o) { o->ink.fill = RECTO_FILL_HATCH; }
static void shaded_by_pen(recto_options *o) {
  o->ink.fill = RECTO_FILL_HATCH;
  o->ink.light[0] = 1;
}
static void results(recto_options *o) {
  o->results = RECTO_RESULTS_ALL;
  o->ink.edges = RECTO_EDGES_ALL;
}
static void verified(recto_options *o) { o->verify = 100; }
static void newell(recto_options *o) { o->solver.method = RECTO_METHOD_NEWELL; }
static void watkins(recto_options *o) {
  o->solver.method = RECTO_METHOD_WATKINS;
}
static void warnock(recto_options *o) {
  o->solver.method = RECTO_METHOD_WARNOCK;
}
static void zbuffer(recto_options *o) {
  o->solver.method = RECTO_METHOD_ZBUFFER;
}

/* ---- Often enough -------------------------------------------------------- */

/* A loop over all of 100,352 triangles has 13 polls, one over their edges 19,
 * one over their corners 37.  `least` is by 3 to 6 less than what was counted
 * when this was written: where a loop goes or comes, it is to be counted
 * again. */
static void a_stage_polls_in_each_of_its_loops(void **state) {
  (void)state;
  static const struct {
    void (*set)(recto_options *options);
    const char *stage;
    int least;
  } job[] = {
      {lines, "topology", 41},       {lines, "sheet", 92},
      {lines, "solve", 38},          {welded, "topology", 41},
      {clipped, "sheet", 138},       {all_edges, "ink", 738},
      {painted, "faces", 252},       {painted, "ink", 53},
      {hatched, "ink", 64},          {shaded_by_pen, "ink", 253},
      {results, "results", 47},      {verified, "verify", 1258},
      {newell, "solve", 38},         {watkins, "intersections", 329},
      {warnock, "subdividing", 364}, {zbuffer, "visibility", 28},
      {one_source, "ink", 2978},
  };
  recto_scene *scene = make_hills(224);
  for (size_t i = 0; i < sizeof job / sizeof job[0]; i++) {
    struct listener listener = {.stage = job[i].stage};
    recto_options options;
    recto_drawing *drawing;
    init(&options, &listener);
    job[i].set(&options);
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    if (listener.polls < job[i].least)
      print_message("job %zu, %s: %d polls\n", i, job[i].stage, listener.polls);
    assert_true(listener.polls >= job[i].least);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* ---- At any time --------------------------------------------------------- */

/* What some work takes; not all of it takes all. */
struct input {
  recto_scene *scene;
  recto_drawing *drawing;
  const char *path;
  recto_options options;
  struct listener listener;
};

typedef recto_status work(struct input *input, recto_error *error);

/* Does the work to its end, and then again and again up to polls that are
 * spread over all of them. */
static void cancel_at_many_polls(struct input *input, work *run) {
  enum { TIMES = 12 };
  recto_error error = {0};
  input->listener = (struct listener){0};
  input->options.user = &input->listener;
  if (run(input, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  int all = input->listener.polls;
  assert_true(all > 0);
  for (int k = 0; k < TIMES && k < all; k++) {
    int last = all <= TIMES ? k + 1 : 1 + k * (all - 1) / (TIMES - 1);
    input->listener = (struct listener){.last = last};
    assert_int_equal(run(input, &error), RECTO_ERROR_CANCELLED);
    assert_int_equal(error.code, RECTO_ERROR_CANCELLED);
    assert_string_equal(error.text, "cancelled");
    assert_int_equal(input->listener.polls, last); /* and not asked again */
  }
}

static recto_status render(struct input *input, recto_error *error) {
  recto_drawing *drawing;
  recto_status status =
      recto_scene_render(input->scene, &input->options, &drawing, error);
  assert_int_equal(drawing != NULL, status == RECTO_OK);
  recto_drawing_destroy(drawing);
  return status;
}

static void a_render_is_cancelled_at_any_poll(void **state) {
  (void)state;
  void (*const set[])(recto_options *) = {
      lines,   welded,  clipped,       all_edges, one_source,
      painted, hatched, shaded_by_pen, results,   newell,
      watkins, warnock, zbuffer,       verified};
  struct input input = {.scene = make_hills(40)};
  for (size_t i = 0; i < sizeof set / sizeof set[0]; i++) {
    init(&input.options, &input.listener);
    set[i](&input.options);
    cancel_at_many_polls(&input, render);
  }
  recto_scene_destroy(input.scene);
}

static recto_status prepare(struct input *input, recto_error *error) {
  return recto_scene_prepare(input->scene, &input->options, error);
}

static recto_status read_model(struct input *input, recto_error *error) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, error), RECTO_OK);
  recto_status status =
      recto_scene_read(scene, input->path, NULL, &input->options, error);
  recto_scene_destroy(scene);
  return status;
}

static recto_status check(struct input *input, recto_error *error) {
  recto_verdict verdict;
  recto_status status = recto_scene_check(input->scene, input->path,
                                          &input->options, &verdict, error);
  assert_int_equal(verdict.drawn_mm > 0, status == RECTO_OK);
  return status;
}

static recto_status write_file(struct input *input, recto_error *error) {
  return recto_drawing_write(input->drawing, input->path,
                             input->options.output.format, &input->options,
                             error);
}

static bool take_bytes(void *user, const void *bytes, size_t count) {
  (void)user;
  return bytes != NULL && count > 0;
}

static recto_status write_bytes(struct input *input, recto_error *error) {
  return recto_drawing_write_to(input->drawing, input->options.output.format,
                                &input->options, take_bytes, NULL, error);
}

/* The path of a file of many triangles, of a megabyte and more. */
static const char *write_triangles(void **state) {
  enum { FACES = 80000, LINE = 64 };
  char *text = malloc((size_t)FACES * 4 * LINE), *at = text;
  assert_non_null(text);
  for (int i = 0; i < FACES; i++)
    at += sprintf(at, "v %d 0 0\nv %d 1 0\nv %d 0 1\nf -3 -2 -1\n", i, i, i);
  const char *path = temporary_file(state, "a.obj", text, (size_t)(at - text));
  free(text);
  return path;
}

static void preparing_and_reading_are_cancelled_at_any_poll(void **state) {
  struct input input = {.scene = make_hills(40)};
  init(&input.options, &input.listener);
  cancel_at_many_polls(&input, prepare);
  input.path = write_triangles(state);
  cancel_at_many_polls(&input, read_model);
  recto_scene_destroy(input.scene);
}

static void writing_and_checking_are_cancelled_at_any_poll(void **state) {
  struct input input = {.scene = make_hills(40),
                        .path = temporary_path(state, "a.out")};
  recto_options options;
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGES_ALL;
  assert_int_equal(
      recto_scene_render(input.scene, &options, &input.drawing, NULL),
      RECTO_OK);
  const char *format;
  for (size_t i = 0; (format = recto_output_format_name(i)) != NULL; i++) {
    init(&input.options, &input.listener);
    input.options.output.format = format;
    cancel_at_many_polls(&input, write_file);
    cancel_at_many_polls(&input, write_bytes);
  }
  input.options = options;
  input.options.output.format = "svg";
  assert_int_equal(write_file(&input, NULL), RECTO_OK);
  input.options.progress = listen;
  cancel_at_many_polls(&input, check);
  recto_drawing_destroy(input.drawing);
  recto_scene_destroy(input.scene);
}

/* ---- The share ----------------------------------------------------------- */

/* The shares of the first poll and of the last one. */
static void expect_shares(struct input *input, work *run, double low,
                          double high) {
  input->listener = (struct listener){.first = -1};
  assert_int_equal(run(input, NULL), RECTO_OK);
  assert_true(input->listener.first >= low && input->listener.first < high);
  assert_true(input->listener.share > low + 0.9 * (high - low));
  assert_true(input->listener.share <= high);
}

static void the_share_moves_in_reading_and_writing(void **state) {
  struct input input = {.scene = make_hills(40),
                        .path = temporary_path(state, "a.svg")};
  init(&input.options, &input.listener);
  input.options.ink.edges = RECTO_EDGES_ALL;
  assert_int_equal(
      recto_scene_render(input.scene, &input.options, &input.drawing, NULL),
      RECTO_OK);
  double reading = 0.1214, written = input.listener.share;
  assert_true(written > 0.9);
  const char *const format[] = {"svg", "svgz", "hpgl"};
  for (size_t i = 0; i < sizeof format / sizeof format[0]; i++) {
    input.options.output.format = format[i];
    expect_shares(&input, write_bytes, written, 1);
  }
  input.path = write_triangles(state);
  expect_shares(&input, read_model, 0, reading);
  input.listener = (struct listener){0};
  recto_drawing_destroy(input.drawing);
  recto_scene_destroy(input.scene);
}

/* The stream polls at every 64 KB, of which a PNG has few. */
static void what_cairo_draws_and_compresses_is_polled(void **state) {
  (void)state;
  struct input input = {.scene = make_hills(80)};
  init(&input.options, &input.listener);
  input.options.ink.edges = RECTO_EDGES_ALL;
  assert_int_equal(
      recto_scene_render(input.scene, &input.options, &input.drawing, NULL),
      RECTO_OK);
  const struct {
    const char *format;
    int least;
  } job[] = {{"png", 120}, {"pdf", 70}, {"ps", 70}};
  for (size_t i = 0; i < sizeof job / sizeof job[0]; i++) {
    input.listener = (struct listener){0};
    input.options.output.format = job[i].format;
    if (recto_output_format(NULL, job[i].format) == NULL)
      continue; /* built without cairo */
    assert_int_equal(write_bytes(&input, NULL), RECTO_OK);
    assert_true(input.listener.polls >= job[i].least);
  }
  recto_drawing_destroy(input.drawing);
  recto_scene_destroy(input.scene);
}

/* ---- The share ----------------------------------------------------------- */

struct invisibility_polls {
  double from, to; /* shares of the first and of the last poll of the stage */
  bool extra;      /* a stage was named that was not requested */
};

static bool watch_invisibility(void *user, double share, const char *stage) {
  struct invisibility_polls *polls = user;
  if (strcmp(stage, "invisibility") == 0) {
    polls->from = polls->from > 0 ? polls->from : share;
    polls->to = share;
  }
  if (strcmp(stage, "verify") == 0 || strcmp(stage, "contours") == 0)
    polls->extra = true;
  return true;
}

/* The count of hiding faces takes longer than all the rest. */
static void the_share_rises_while_hiding_faces_are_counted(void **state) {
  (void)state;
  recto_scene *scene = make_hills(60);
  recto_drawing *drawing;
  recto_options options;
  struct invisibility_polls polls = {0};
  recto_options_init(&options);
  options.progress = watch_invisibility;
  options.user = &polls;
  options.ink.edges = RECTO_EDGES_ALL;
  options.results = RECTO_RESULT_INVISIBILITY;
  options.camera.elevation_deg = 2;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  assert_true(polls.from > 0 && polls.to > polls.from + 0.1);
  assert_false(polls.extra);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* ---- Within the callback ------------------------------------------------- */

/* Renders another scene, which neither asks nor cancels this one. */
static bool render_within(void *user, double share, const char *stage) {
  int *polls = user;
  recto_scene *scene = make_hills(4);
  recto_drawing *drawing;
  (void)share;
  (void)stage;
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return ++*polls < 5;
}

static void the_progress_function_may_call_the_library(void **state) {
  (void)state;
  int polls = 0;
  recto_scene *scene = make_hills(20);
  recto_drawing *drawing;
  recto_options options;
  recto_options_init(&options);
  options.progress = render_within;
  options.user = &polls;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_ERROR_CANCELLED);
  assert_int_equal(polls, 5);
  recto_scene_destroy(scene);
}

/* `listen` requires it. */
static void polls_are_in_the_callers_thread(void **state) {
  (void)state;
  recto_scene *scene = make_hills(100);
  struct listener listener = {0};
  recto_options options;
  recto_drawing *drawing;
  init(&options, &listener);
  all_edges(&options);
  painted(&options);
  options.solver.threads = 0;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  caller = pthread_self();
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_stage_polls_in_each_of_its_loops),
      cmocka_unit_test(a_render_is_cancelled_at_any_poll),
      cmocka_unit_test(the_share_rises_while_hiding_faces_are_counted),
      cmocka_unit_test_setup_teardown(
          preparing_and_reading_are_cancelled_at_any_poll, temporary_set_up,
          temporary_tear_down),
      cmocka_unit_test_setup_teardown(
          writing_and_checking_are_cancelled_at_any_poll, temporary_set_up,
          temporary_tear_down),
      cmocka_unit_test_setup_teardown(the_share_moves_in_reading_and_writing,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test(what_cairo_draws_and_compresses_is_polled),
      cmocka_unit_test(the_progress_function_may_call_the_library),
      cmocka_unit_test(polls_are_in_the_callers_thread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
