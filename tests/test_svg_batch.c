/* test_svg_batch.c - elements that are formatted by several threads make the
 * same file as by one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "backends/writer.h"
#include "base/poll.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"

/* Layers take turns, so that each batch has elements of others; all strokes
 * have more points than a batch, and so have all fills. */
enum { LAYERS = 3, STROKES = 9000, STROKE_POINTS_MAX = 60, FILLS = 12000 };

static uint32_t add_random_points(struct drawing *drawing,
                                  struct random *random, uint32_t count) {
  uint32_t first = (uint32_t)drawing->point.count;
  for (uint32_t i = 0; i < count; i++) {
    struct drawing_point p = {random_between(random, 0, 200),
                              random_between(random, 0, 100)};
    assert_true(ARRAY_PUSH(&drawing->point, p));
  }
  return first;
}

static void add_random_strokes(struct drawing *drawing, struct random *random) {
  for (uint32_t i = 0; i < STROKES; i++) {
    uint32_t count = (uint32_t)random_int(random, 2, STROKE_POINTS_MAX);
    struct drawing_stroke stroke = {
        .point = add_random_points(drawing, random, count),
        .count = count,
        .layer = i % LAYERS,
        .face = i,
        .edge = i / 2,
        .group = DRAWING_NONE,
        .edge_class = i % 700 < 300 ? RECTO_EDGE_CREASE : RECTO_EDGE_BORDER,
        .closed = i % 5 == 0};
    assert_true(ARRAY_PUSH(&drawing->stroke, stroke));
  }
}

static void add_random_fills(struct drawing *drawing, struct random *random) {
  for (uint32_t i = 0; i < FILLS; i++) {
    struct drawing_fill fill = {.loop = (uint32_t)drawing->loop.count,
                                .loops = 1 + i % 2,
                                .layer = i % LAYERS,
                                .colour = i,
                                .face = i,
                                .group = DRAWING_NONE};
    for (uint32_t k = 0; k < fill.loops; k++) {
      uint32_t count = (uint32_t)random_int(random, 3, 20);
      struct drawing_loop loop = {add_random_points(drawing, random, count),
                                  count};
      assert_true(ARRAY_PUSH(&drawing->loop, loop));
    }
    assert_true(ARRAY_PUSH(&drawing->fill, fill));
  }
}

static int set_up(void **state) {
  static struct drawing drawing;
  struct random random = {7};
  drawing_init(&drawing);
  drawing.width_mm = 200;
  drawing.height_mm = 100;
  drawing.ids = true;
  for (unsigned i = 0; i < LAYERS; i++) {
    struct drawing_layer layer = {
        .pen = i + 1, .label = "lines", .colour = 0, .width_mm = 0.3};
    assert_true(ARRAY_PUSH(&drawing.layer, layer));
  }
  add_random_strokes(&drawing, &random);
  *state = &drawing;
  return 0;
}

static int tear_down(void **state) {
  drawing_fini(*state);
  return 0;
}

/* Writes by so many threads at most.
 * stream  gets what was written; NULL: nothing does */
static recto_status write_drawing(const struct drawing *drawing, int threads,
                                  struct stream **stream) {
  const struct writer_options writing = {.precision = 3};
  recto_options options;
  struct poll poll;
  recto_error error;
  struct stream *to;
  recto_options_init(&options);
  options.solver.threads = threads;
  recto_status status = stream_open_memory(&to, &error);
  if (status != RECTO_OK)
    return status;
  poll_open(&poll, &options);
  status = writer_svg.write(drawing, &writing, to, &error);
  poll_close(&poll);
  if (status == RECTO_OK)
    status = stream_status(to);
  if (status == RECTO_OK && stream != NULL)
    *stream = to;
  else
    stream_discard(to);
  return status;
}

static void assert_same_bytes(const struct drawing *drawing) {
  struct stream *alone, *together;
  size_t count, same;
  assert_int_equal(write_drawing(drawing, 1, &alone), RECTO_OK);
  assert_int_equal(write_drawing(drawing, 2, &together), RECTO_OK);
  const char *a = stream_memory(alone, &count);
  const char *b = stream_memory(together, &same);
  assert_int_equal(count, same);
  assert_memory_equal(a, b, count);
  stream_discard(alone);
  stream_discard(together);
}

static void strokes_by_threads_are_those_by_one(void **state) {
  assert_same_bytes(*state);
}

static void fills_and_seams_by_threads_are_those_by_one(void **state) {
  struct drawing *drawing = *state;
  struct random random = {8};
  add_random_fills(drawing, &random);
  drawing->seam_mm = 0.1;
  assert_same_bytes(drawing);
}

static void running_out_of_memory_in_a_thread_is_reported(void **state) {
  struct memory_faults faults = {.least = 20};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults, write_drawing(*state, 2, NULL));
  }
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      T(strokes_by_threads_are_those_by_one),
      T(fills_and_seams_by_threads_are_those_by_one),
      T(running_out_of_memory_in_a_thread_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
