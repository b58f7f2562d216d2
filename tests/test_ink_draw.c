/* test_ink_draw.c - the ink stage as a whole: on every scene of the stability
 * list, and with failing allocations. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/ink_fixture.h"
#include "tests/memory_faults.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"

#define NANOMETRE (1.0 / 1048576)

/* ---- The shared scenes --------------------------------------------------- */

struct side {
  struct drawing_point a, b;
  double length;
};

/* All straight pieces of the strokes; free with mem_free. */
static struct side *sides_of(const struct drawing *d, size_t *count) {
  struct side *side = mem_alloc(d->point.count + 1, sizeof *side);
  assert_non_null(side);
  *count = 0;
  for (size_t s = 0; s < d->stroke.count; s++) {
    const struct drawing_stroke *stroke = &d->stroke.item[s];
    const struct drawing_point *p = d->point.item + stroke->point;
    for (uint32_t i = 0; i + !stroke->closed < stroke->count; i++) {
      struct side made = {p[i], p[(i + 1) % stroke->count], 0};
      made.length = hypot(made.b.x - made.a.x, made.b.y - made.a.y);
      side[(*count)++] = made;
    }
  }
  return side;
}

static double off(const struct side *s, struct drawing_point p) {
  return fabs((p.x - s->a.x) * (s->b.y - s->a.y) -
              (p.y - s->a.y) * (s->b.x - s->a.x)) /
         s->length;
}

/* How far two sides run along each other within 4 grid units. */
static double overlap(const struct side *s, const struct side *t) {
  const double error = 4 * NANOMETRE;
  double t_low = INFINITY, t_high = -INFINITY;
  const struct drawing_point end[] = {t->a, t->b};
  for (int i = 0; i < 2; i++) {
    double along = ((end[i].x - s->a.x) * (s->b.x - s->a.x) +
                    (end[i].y - s->a.y) * (s->b.y - s->a.y)) /
                   s->length;
    t_low = fmin(t_low, along);
    t_high = fmax(t_high, along);
  }
  if (off(s, t->a) > error || off(s, t->b) > error)
    return 0;
  return fmin(t_high, s->length) - fmax(t_low, 0);
}

static void no_scene_draws_a_line_twice(void **state) {
  enum { MOST = 3000 };
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name; e++) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    scene_init(&scene);
    pipeline_fill(&scene, &options, e);
    options.ink.hidden = RECTO_HIDDEN_LAYER;
    pipeline_run(&pipeline, &scene, &options, &solver_newell);
    size_t count;
    struct side *side = sides_of(&pipeline.drawing, &count);
    for (size_t i = 0; i < count && count < MOST; i++)
      for (size_t k = 0; k < i; k++) {
        /* Of two, the longer gives the direction. */
        bool longer = side[i].length > side[k].length;
        const struct side *s = longer ? &side[i] : &side[k];
        const struct side *t = longer ? &side[k] : &side[i];
        if (t->length > 100 * NANOMETRE && overlap(s, t) > 20 * NANOMETRE)
          fail_msg("%s: %.6f mm from %.6f, %.6f to %.6f, %.6f twice", e->name,
                   overlap(s, t), t->a.x, t->a.y, t->b.x, t->b.y);
      }
    mem_free(side);
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

static void options_change_where_ink_goes_not_how_much(void **state) {
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name; e++) {
    double visible[4];
    for (int i = 0; i < 4; i++) {
      struct scene scene;
      recto_options options;
      struct pipeline pipeline;
      scene_init(&scene);
      pipeline_fill(&scene, &options, e);
      options.ink.hidden = i == 1 ? RECTO_HIDDEN_LAYER : RECTO_HIDDEN_NONE;
      options.ink.order = i == 2 ? RECTO_ORDER_NEAR : RECTO_ORDER_NONE;
      options.ink.ids = i == 3;
      pipeline_run(&pipeline, &scene, &options, &solver_newell);
      visible[i] = pipeline_length(&pipeline, RECTO_EDGES_ALL, false);
      pipeline_fini(&pipeline);
      scene_fini(&scene);
    }
    /* Dropped points and united nodes: a few units a stroke at most. */
    for (int i = 1; i < 4; i++)
      if (fabs(visible[i] - visible[0]) > 1e-4)
        fail_msg("%s: %.9f mm, then %.9f mm", e->name, visible[0], visible[i]);
  }
}

static void box_seen_square_on_draws_four_edges(void **state) {
  const double point[8][3] = {{0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0},
                              {0, 0, 9}, {30, 0, 9}, {30, 20, 9}, {0, 20, 9}};
  const uint32_t face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  (void)state;
  scene_init(&scene);
  recto_options_init(&options);
  for (int i = 0; i < 8; i++) {
    struct scene_point p = {point[i][0], point[i][1], point[i][2]};
    assert_true(ARRAY_PUSH(&scene.point, p));
  }
  for (int i = 0; i < 6; i++)
    assert_int_equal(scene_add_face(&scene, face[i], 4, 0, NULL, NULL),
                     RECTO_OK);
  scenes_view_above(&options);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  pipeline_run(&pipeline, &scene, &options, &solver_newell);
  assert_int_equal(pipeline.status, RECTO_OK);
  assert_int_equal(pipeline.drawing.stroke.count, 1);
  assert_int_equal(pipeline.drawing.stroke.item[0].count, 4);
  assert_true(pipeline.drawing.stroke.item[0].closed);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

/* ---- Memory -------------------------------------------------------------- */

/* Something of everything: lines on each other, a fan, loops, hidden lines,
 * groups, fragments. */
static void fill_all(struct ink_fixture *k) {
  struct random random = {107};
  static const double flat[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  static const double outer[] = {10, 10, 90, 10, 90, 80, 10, 80};
  static const double inner[] = {30, 30, 30, 50, 60, 50, 60, 30};
  ink_fixture_group(k, "second");
  for (int i = 0; i < 30; i++) {
    double x = random_int(&random, 1, 9) * 10,
           y = random_int(&random, 1, 9) * 10;
    uint32_t edge = ink_fixture_line(k, x, y, random_int(&random, 1, 9) * 10, y,
                                     RECTO_EDGE_CREASE);
    ink_fixture_set_group(k, edge, (uint32_t)i % 2);
    edge = ink_fixture_line(k, x, y, x, y + 7, RECTO_EDGE_BORDER);
    ink_fixture_show(k, edge, 0, 1, 3);
  }
  uint32_t hub = ink_fixture_point(k, 55, 55);
  for (int i = 0; i < 20; i++)
    ink_fixture_edge(k, hub, ink_fixture_point(k, 55 + i, 90 - i % 3),
                     RECTO_EDGE_SMOOTH);
  for (int i = 0; i < 4; i++)
    ink_fixture_line(k, inner[2 * i], inner[2 * i + 1], inner[(2 * i + 2) % 8],
                     inner[(2 * i + 3) % 8], RECTO_EDGE_SILHOUETTE);
  ink_fixture_side(k);
  ink_fixture_fragment(k, ink_fixture_face(k, 0, flat, 4),
                       INK_FIXTURE_XY(outer));
  ink_fixture_hole(k, INK_FIXTURE_XY(inner));
  k->options.ink.pens = 2;
  k->options.ink.simplify_mm = 0.01;
  k->options.ink.order = RECTO_ORDER_NEAR;
  k->options.ink.hatch_pitch_mm = 10;
}

static void running_out_of_memory_is_reported(void **state) {
  static const struct {
    recto_hidden hidden;
    recto_fill fill;
    bool ids, inset;
  } cases[] = {{RECTO_HIDDEN_DASHED, RECTO_FILL_HATCH, false, false},
               {RECTO_HIDDEN_NONE, RECTO_FILL_HATCH, false, true},
               {RECTO_HIDDEN_LAYER, RECTO_FILL_PAINT, true, false},
               {RECTO_HIDDEN_NONE, RECTO_FILL_SHADE, false, false}};
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    fill_all(&k);
    k.options.ink.hidden = cases[i].hidden;
    k.options.ink.fill = cases[i].fill;
    k.options.ink.ids = cases[i].ids;
    k.options.ink.hatch_inset = cases[i].inset;
    unsigned long left_out = is_under_valgrind() ? 6 : 0;
    struct memory_faults faults = {.least = 40 / (left_out + 1)};
    while (memory_faults_go_on(&faults)) {
      memory_faults_begin(&faults);
      memory_faults_end(&faults, ink_fixture_try(&k));
      faults.allocation += left_out;
    }
    assert_true(k.drawing.stroke.count > 20);
    ink_fixture_end(&k);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_scene_draws_a_line_twice),
      cmocka_unit_test(options_change_where_ink_goes_not_how_much),
      cmocka_unit_test(box_seen_square_on_draws_four_edges),
      cmocka_unit_test(running_out_of_memory_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
