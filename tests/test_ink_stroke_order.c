/* test_ink_stroke_order.c - strokes are ordered for short pen-up travel, and
 * keep their shape. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/poll.h"
#include "ink/lines/nearest.h"
#include "ink/order/stroke_order.h"
#include "tests/ink_fixture.h"
#include "tests/scenes/random.h"

/* ---- Drawings ------------------------------------------------------------ */

static void add_layer(struct drawing *drawing) {
  struct drawing_layer layer = {.pen = (unsigned)drawing->layer.count + 1};
  assert_true(ARRAY_PUSH(&drawing->layer, layer));
}

/* A stroke on the layer added last; its number is its edge. */
static void add_stroke(struct drawing *drawing, const double *xy,
                       uint32_t count, bool closed) {
  struct drawing_stroke stroke = {.point = (uint32_t)drawing->point.count,
                                  .count = count,
                                  .layer = (uint32_t)drawing->layer.count - 1,
                                  .edge = (uint32_t)drawing->stroke.count,
                                  .closed = closed};
  for (uint32_t i = 0; i < count; i++) {
    struct drawing_point p = {xy[2 * i], xy[2 * i + 1]};
    assert_true(ARRAY_PUSH(&drawing->point, p));
  }
  assert_true(ARRAY_PUSH(&drawing->stroke, stroke));
}

/* Strokes at random: lines up to `length` mm, every fifth one of three points,
 * every seventh a loop. */
static void add_random(struct drawing *drawing, struct random *random,
                       int count, double length) {
  for (int i = 0; i < count; i++) {
    double xy[10], angle = random_between(random, 0, 6.28);
    double x = random_between(random, 10, 190);
    double y = random_between(random, 10, 280);
    for (int c = 0; c < 5; c++) {
      double reach = length * random_unit(random);
      xy[2 * c] = c ? x + reach * cos(angle + c) : x;
      xy[2 * c + 1] = c ? y + reach * sin(angle + c) : y;
    }
    if (i % 7 == 0)
      add_stroke(drawing, xy, 5, true);
    else
      add_stroke(drawing, xy, i % 5 ? 2 : 3, false);
  }
}

/* A copy of the strokes and points, to compare with. */
static void copy_drawing(struct drawing *to, const struct drawing *from) {
  drawing_init(to);
  for (size_t i = 0; i < from->layer.count; i++)
    assert_true(ARRAY_PUSH(&to->layer, from->layer.item[i]));
  for (size_t i = 0; i < from->stroke.count; i++)
    assert_true(ARRAY_PUSH(&to->stroke, from->stroke.item[i]));
  for (size_t i = 0; i < from->point.count; i++)
    assert_true(ARRAY_PUSH(&to->point, from->point.item[i]));
}

static bool is_same_point(struct drawing_point a, struct drawing_point b) {
  return a.x == b.x && a.y == b.y;
}

/* The same points, from another corner on where closed, the other way round
 * where open. */
static bool is_same_line(const struct drawing *a,
                         const struct drawing_stroke *s,
                         const struct drawing *b,
                         const struct drawing_stroke *t) {
  const struct drawing_point *p = a->point.item + s->point;
  const struct drawing_point *q = b->point.item + t->point;
  if (s->count != t->count || s->closed != t->closed)
    return false;
  for (uint32_t first = 0; first < s->count; first++) {
    bool same = true;
    for (uint32_t i = 0; i < s->count; i++) {
      uint32_t at = (first + i) % s->count;
      if (!s->closed)
        at = first ? s->count - 1 - i : i;
      same = same && is_same_point(p[i], q[at]);
    }
    if (same)
      return true;
  }
  return false;
}

/* Every stroke is there once, on its layer, layers in order. */
static void assert_reordered(const struct drawing *was,
                             const struct drawing *is) {
  assert_int_equal(was->stroke.count, is->stroke.count);
  bool *seen = mem_calloc(was->stroke.count, sizeof *seen);
  assert_non_null(seen);
  for (size_t i = 0; i < is->stroke.count; i++) {
    const struct drawing_stroke *s = &is->stroke.item[i];
    assert_in_range(s->edge, 0, was->stroke.count - 1);
    assert_false(seen[s->edge]);
    seen[s->edge] = true;
    assert_true(is_same_line(is, s, was, &was->stroke.item[s->edge]));
    assert_int_equal(s->layer, was->stroke.item[s->edge].layer);
    assert_true(i == 0 || s[-1].layer <= s->layer);
  }
  mem_free(seen);
}

/* Orders the drawing; returns the travel after it. */
static double order(struct drawing *drawing, const struct tour_effort *effort) {
  struct drawing was;
  copy_drawing(&was, drawing);
  assert_true(stroke_order_improve(drawing, effort));
  assert_reordered(&was, drawing);
  double before = drawing_travel_mm(&was), after = drawing_travel_mm(drawing);
  assert_true(after <= before);
  drawing_fini(&was);
  return after;
}

/* ---- Small ones ---------------------------------------------------------- */

static void strokes_in_a_row_are_drawn_one_after_the_other(void **state) {
  static const int place[] = {3, 7, 1, 0, 9, 5, 2, 8, 4, 6};
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  add_layer(&drawing);
  for (int i = 0; i < 10; i++) {
    double x = 10 + 10 * place[i];
    double line[] = {x, 20, x + 8, 20};
    double back[] = {x + 8, 20, x, 20};
    add_stroke(&drawing, i % 2 ? line : back, 2, false);
  }
  double travel = order(&drawing, &stroke_order_usual_effort);
  assert_true(fabs(travel - (hypot(10, 20) + 9 * 2)) < 1e-9);
  for (uint32_t i = 0; i < 10; i++)
    assert_int_equal(place[drawing.stroke.item[i].edge], i);
  drawing_fini(&drawing);
}

static void one_stroke_is_begun_at_its_nearer_end(void **state) {
  const double line[] = {50, 50, 3, 4};
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  add_layer(&drawing);
  add_stroke(&drawing, line, 2, false);
  assert_true(order(&drawing, &stroke_order_usual_effort) == 5);
  drawing_fini(&drawing);
}

static void loop_is_begun_where_it_suits(void **state) {
  /* A loop of many corners between two lines: in at one corner is out at the
   * same, so the one in the middle is best. */
  struct drawing drawing;
  double ring[200];
  const double before[] = {0, 0, 100, 0}, after[] = {100, 200, 0, 200};
  (void)state;
  for (int i = 0; i < 100; i++) {
    ring[2 * i] = 150 + 40 * cos(i * acos(-1) / 50);
    ring[2 * i + 1] = 100 + 40 * sin(i * acos(-1) / 50);
  }
  drawing_init(&drawing);
  add_layer(&drawing);
  add_stroke(&drawing, after, 2, false);
  add_stroke(&drawing, ring, 100, true);
  add_stroke(&drawing, before, 2, false);
  double travel = order(&drawing, &stroke_order_usual_effort);
  assert_true(fabs(travel - 2 * hypot(100, 10)) < 1e-6);
  assert_int_equal(drawing.stroke.item[1].edge, 1);
  drawing_fini(&drawing);
}

static void layers_are_never_mixed(void **state) {
  struct random random = {61};
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  for (int layer = 0; layer < 4; layer++) {
    add_layer(&drawing);
    add_random(&drawing, &random, 30, 5);
  }
  order(&drawing, &stroke_order_usual_effort);
  for (size_t i = 0; i < drawing.stroke.count; i++)
    assert_int_equal(drawing.stroke.item[i].layer, i / 30);
  drawing_fini(&drawing);
}

static void strokes_at_one_position_take_bounded_time(void **state) {
  int count = is_under_valgrind() ? 200 : 50000;
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  add_layer(&drawing);
  for (int i = 0; i < count; i++) {
    const double line[] = {50, 50, 50 + 40 * cos(i), 50 + 40 * sin(i)};
    add_stroke(&drawing, line, 2, false);
  }
  double before = clock_cpu();
  assert_true(stroke_order_improve(&drawing, &stroke_order_usual_effort));
  assert_true(is_under_valgrind() || clock_cpu() - before < 10);
  drawing_fini(&drawing);
}

static void empty_drawing_is_in_order(void **state) {
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  assert_true(stroke_order_improve(&drawing, &stroke_order_usual_effort));
  assert_int_equal(stroke_order_pen_lifts(&drawing), 0);
  drawing_fini(&drawing);
}

/* The best of all orders and directions, by trying them. */
static double best_travel(const struct drawing *d, struct drawing_point pen,
                          unsigned left) {
  double best = left ? INFINITY : 0;
  for (size_t i = 0; i < d->stroke.count; i++) {
    if (!(left & 1u << i))
      continue;
    const struct drawing_point *p = d->point.item + d->stroke.item[i].point;
    for (int turned = 0; turned < 2; turned++) {
      double way = hypot(p[turned].x - pen.x, p[turned].y - pen.y) +
                   best_travel(d, p[!turned], left & ~(1u << i));
      best = fmin(best, way);
    }
  }
  return best;
}

static void few_strokes_are_ordered_nearly_best(void **state) {
  struct random random = {67};
  int rounds = is_under_valgrind() ? 12 : 60, best = 0;
  double sum = 0, least = 0;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct drawing drawing;
    drawing_init(&drawing);
    add_layer(&drawing);
    for (int i = 0; i < 6; i++) {
      double xy[4];
      for (int c = 0; c < 4; c++)
        xy[c] = random_between(&random, 0, 100);
      add_stroke(&drawing, xy, 2, false);
    }
    double optimum =
        best_travel(&drawing, (struct drawing_point){0, 0}, (1u << 6) - 1);
    double travel = order(&drawing, &stroke_order_usual_effort);
    assert_true(travel > optimum - 1e-9);
    best += travel < optimum + 1e-9;
    sum += travel;
    least += optimum;
    drawing_fini(&drawing);
  }
  assert_true(best > rounds / 3);
  assert_true(sum < 1.08 * least);
}

/* ---- Many ---------------------------------------------------------------- */

static void random_strokes_stay_what_they_were(void **state) {
  struct random random = {71};
  int rounds = is_under_valgrind() ? 5 : 200;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct drawing drawing;
    drawing_init(&drawing);
    for (int layer = 0; layer <= round % 3; layer++) {
      add_layer(&drawing);
      add_random(&drawing, &random, random_int(&random, 1, 40),
                 round % 2 ? 1 : 60);
    }
    order(&drawing, &stroke_order_usual_effort);
    drawing_fini(&drawing);
  }
}

static void same_strokes_give_the_same_order(void **state) {
  struct drawing drawing[2];
  (void)state;
  for (int i = 0; i < 2; i++) {
    struct random random = {73};
    drawing_init(&drawing[i]);
    add_layer(&drawing[i]);
    add_random(&drawing[i], &random, 500, 10);
    order(&drawing[i], &stroke_order_usual_effort);
  }
  for (size_t i = 0; i < 500; i++)
    assert_int_equal(drawing[0].stroke.item[i].edge,
                     drawing[1].stroke.item[i].edge);
  for (size_t i = 0; i < drawing[0].point.count; i++)
    assert_true(
        is_same_point(drawing[0].point.item[i], drawing[1].point.item[i]));
  drawing_fini(&drawing[0]);
  drawing_fini(&drawing[1]);
}

static void more_effort_gains_little(void **state) {
  const struct tour_effort endless = {1e12, 1e12}, none = {0, 0};
  int count = is_under_valgrind() ? 100 : 5000;
  (void)state;
  for (int kind = 0; kind < 3; kind++) {
    double travel[3];
    const struct tour_effort *effort[] = {&none, &stroke_order_usual_effort,
                                          &endless};
    for (int i = 0; i < 3; i++) {
      struct random random = {79};
      struct drawing drawing;
      drawing_init(&drawing);
      add_layer(&drawing);
      add_random(&drawing, &random, count, kind == 0 ? 0.5 : kind * 10);
      travel[i] = order(&drawing, effort[i]);
      drawing_fini(&drawing);
    }
    assert_true(travel[1] < 1.1 * travel[2]);
    assert_true(travel[1] < 0.95 * travel[0]); /* and some gains much */
  }
}

static void ordering_100000_strokes_takes_bounded_time(void **state) {
  int count = is_under_valgrind() ? 100 : 100000;
  struct random random = {83};
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  add_layer(&drawing);
  add_random(&drawing, &random, count, 1);
  double before = clock_cpu();
  assert_true(stroke_order_improve(&drawing, &stroke_order_usual_effort));
  /* Two seconds is the aim; sanitizers and busy machines take longer. */
  assert_true(is_under_valgrind() || clock_cpu() - before < 20);
  drawing_fini(&drawing);
}

/* Tours that are bad in every way, few strokes and many, some of them without
 * length as loops are, some at one place. */
static void improved_tour_is_never_longer(void **state) {
  enum { MOST = 60 };
  struct random random = {103};
  int rounds = is_under_valgrind() ? 50 : 1000;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct drawing_point end[2 * MOST];
    uint32_t stroke[MOST], times[MOST] = {0};
    bool turned[MOST];
    struct tour tour = {.end = end, .stroke = stroke, .reversed = turned};
    tour.count = (uint32_t)random_int(&random, 1, round % 2 ? 6 : MOST);
    tour.start = (struct drawing_point){random_int(&random, 0, 9), 0};
    for (uint32_t i = 0; i < tour.count; i++) {
      end[2 * i].x = random_int(&random, 0, round % 3 ? 1000 : 3);
      end[2 * i].y = random_int(&random, 0, round % 3 ? 1000 : 3);
      end[2 * i + 1].x = end[2 * i].x + random_int(&random, 0, round % 4 * 50);
      end[2 * i + 1].y = end[2 * i].y + random_int(&random, 0, round % 4 * 50);
      uint32_t k = random_below(&random, i + 1);
      stroke[i] = stroke[k];
      stroke[k] = i;
      turned[i] = random_below(&random, 2);
    }
    /* Every bit of effort is an improvement, and none is lost. */
    double travel = tour_travel(&tour);
    for (double moves = 0; moves < 1e6; moves = moves * 3 + 1) {
      const struct tour_effort effort = {1e6, moves};
      assert_true(tour_improve(&tour, &effort));
      assert_true(tour_travel(&tour) <= travel + 1e-9);
      travel = tour_travel(&tour);
    }
    for (uint32_t i = 0; i < tour.count; i++)
      times[stroke[i]]++;
    for (uint32_t i = 0; i < tour.count; i++)
      assert_int_equal(times[i], 1);
  }
}

/* ---- The nearest --------------------------------------------------------- */

static void nearest_is_what_a_look_at_all_finds(void **state) {
  enum { MOST = 300 };
  struct random random = {89};
  int rounds = is_under_valgrind() ? 5 : 60;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct drawing_point point[MOST];
    bool gone[MOST] = {false};
    uint32_t count = (uint32_t)random_int(&random, 1, MOST);
    struct nearest nearest;
    for (uint32_t i = 0; i < count; i++) {
      point[i].x = random_int(&random, 0, round % 2 ? 10 : 1000);
      point[i].y = random_int(&random, 0, round % 3 ? 10 : 0);
    }
    assert_true(nearest_init(&nearest, point, count));
    for (uint32_t left = count; left > 0; left--) {
      struct drawing_point from = {random_int(&random, -5, 1005),
                                   random_int(&random, -5, 15)};
      uint32_t found = nearest_find(&nearest, from);
      assert_in_range(found, 0, count - 1);
      assert_false(gone[found]);
      double best = hypot(point[found].x - from.x, point[found].y - from.y);
      for (uint32_t i = 0; i < count; i++)
        assert_true(gone[i] ||
                    hypot(point[i].x - from.x, point[i].y - from.y) >= best);
      gone[found] = true;
      nearest_remove(&nearest, found);
    }
    assert_int_equal(nearest_find(&nearest, point[0]), NEAREST_NONE);
    nearest_fini(&nearest);
  }
}

static void lists_of_the_nearest_are_complete_and_in_order(void **state) {
  enum { COUNT = 200, WANTED = 8 };
  struct random random = {97};
  struct drawing_point point[COUNT];
  struct nearest nearest;
  (void)state;
  for (uint32_t i = 0; i < COUNT; i++)
    point[i] = (struct drawing_point){random_int(&random, 0, 30),
                                      random_int(&random, 0, 30)};
  assert_true(nearest_init(&nearest, point, COUNT));
  for (uint32_t i = 0; i < COUNT; i++) {
    uint32_t found[WANTED];
    double far = 0;
    assert_int_equal(
        nearest_list(&nearest, point[i], i / 2, INFINITY, found, WANTED),
        WANTED);
    for (int k = 0; k < WANTED; k++) {
      assert_int_not_equal(found[k] / 2, i / 2);
      double d =
          hypot(point[found[k]].x - point[i].x, point[found[k]].y - point[i].y);
      assert_true(d >= far);
      far = d;
    }
    int nearer = 0;
    for (uint32_t k = 0; k < COUNT; k++)
      nearer += k / 2 != i / 2 &&
                hypot(point[k].x - point[i].x, point[k].y - point[i].y) < far;
    assert_in_range(nearer, 0, WANTED - 1);
  }
  nearest_fini(&nearest);
}

/* As many of the points are equally near, the order of the boxes counts. */
static void assert_split_tree_finds_the_same(size_t at_once, int threads) {
  enum { COUNT = 6000, WANTED = 4, MOST = 5 };
  static struct drawing_point point[COUNT];
  struct random random = {101};
  struct nearest whole, part;
  recto_options options;
  struct poll poll;
  recto_options_init(&options);
  options.solver.threads = threads;
  poll_open(&poll, &options);
  for (uint32_t i = 0; i < COUNT; i++)
    point[i] = (struct drawing_point){random_int(&random, 0, 150),
                                      random_int(&random, 0, 150)};
  assert_true(nearest_init(&whole, point, COUNT));
  assert_true(nearest_init_unsplit(&part, point, COUNT));
  for (uint32_t i = 0; i < COUNT / 2; i++) {
    uint32_t of_whole[WANTED], of_part[WANTED];
    uint32_t found =
        nearest_list(&whole, point[i], NEAREST_NONE, MOST, of_whole, WANTED);
    if (i % at_once == 0)
      assert_true(nearest_split(&part, &point[i], at_once, MOST));
    assert_int_equal(
        nearest_list(&part, point[i], NEAREST_NONE, MOST, of_part, WANTED),
        found);
    assert_memory_equal(of_part, of_whole, found * sizeof *of_whole);
  }
  nearest_fini(&whole);
  nearest_fini(&part);
  poll_close(&poll);
}

static void
tree_split_where_asked_finds_what_the_whole_one_finds(void **state) {
  (void)state;
  assert_split_tree_finds_the_same(1, 1);
  assert_split_tree_finds_the_same(3000, 1);
  assert_split_tree_finds_the_same(3000, 3);
}

/* ---- Lifts, options ------------------------------------------------------ */

static void pen_is_not_lifted_between_strokes_that_meet(void **state) {
  const double a[] = {0, 0, 10, 0}, b[] = {10, 0, 20, 5}, c[] = {50, 5, 60, 5};
  struct drawing drawing;
  (void)state;
  drawing_init(&drawing);
  add_layer(&drawing);
  add_stroke(&drawing, a, 2, false);
  add_stroke(&drawing, b, 2, false);
  add_stroke(&drawing, c, 2, false);
  assert_int_equal(stroke_order_pen_lifts(&drawing), 2);
  drawing_fini(&drawing);
}

static void order_is_an_option(void **state) {
  double travel[2];
  (void)state;
  for (int near = 0; near < 2; near++) {
    struct ink_fixture k;
    struct random random = {101};
    ink_fixture_start(&k);
    k.options.ink.order = near ? RECTO_ORDER_NEAR : RECTO_ORDER_NONE;
    for (int i = 0; i < 100; i++) {
      double x = random_between(&random, 5, 90);
      double y = random_between(&random, 5, 90);
      ink_fixture_line(&k, x, y, x + 3, y + 1, RECTO_EDGE_CREASE);
    }
    ink_fixture_draw(&k);
    travel[near] = drawing_travel_mm(&k.drawing);
    ink_fixture_end(&k);
  }
  assert_true(travel[1] < travel[0] / 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strokes_in_a_row_are_drawn_one_after_the_other),
      cmocka_unit_test(one_stroke_is_begun_at_its_nearer_end),
      cmocka_unit_test(loop_is_begun_where_it_suits),
      cmocka_unit_test(layers_are_never_mixed),
      cmocka_unit_test(strokes_at_one_position_take_bounded_time),
      cmocka_unit_test(empty_drawing_is_in_order),
      cmocka_unit_test(few_strokes_are_ordered_nearly_best),
      cmocka_unit_test(random_strokes_stay_what_they_were),
      cmocka_unit_test(same_strokes_give_the_same_order),
      cmocka_unit_test(more_effort_gains_little),
      cmocka_unit_test(ordering_100000_strokes_takes_bounded_time),
      cmocka_unit_test(improved_tour_is_never_longer),
      cmocka_unit_test(nearest_is_what_a_look_at_all_finds),
      cmocka_unit_test(lists_of_the_nearest_are_complete_and_in_order),
      cmocka_unit_test(tree_split_where_asked_finds_what_the_whole_one_finds),
      cmocka_unit_test(pen_is_not_lifted_between_strokes_that_meet),
      cmocka_unit_test(order_is_an_option),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
