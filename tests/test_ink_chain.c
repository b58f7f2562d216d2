/* test_ink_chain.c - lines are joined to the longest strokes, outlines to
 * closed ones. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "tests/ink_fixture.h"
#include "tests/scenes/random.h"

enum {
  SILHOUETTE = RECTO_EDGE_SILHOUETTE,
  CREASE = RECTO_EDGE_CREASE,
  SMOOTH = RECTO_EDGE_SMOOTH,
  WIRE = RECTO_EDGE_WIRE
};

static double total_length(const struct ink_fixture *k) {
  double length = 0;
  for (size_t s = 0; s < k->drawing.stroke.count; s++)
    length += ink_fixture_stroke_length(k, s);
  return length;
}

static size_t count_closed(const struct ink_fixture *k) {
  size_t closed = 0;
  for (size_t s = 0; s < k->drawing.stroke.count; s++)
    closed += k->drawing.stroke.item[s].closed;
  return closed;
}

/* ---- Outlines ------------------------------------------------------------ */

static const double square[] = {20, 20, 60, 20, 60, 50, 20, 50};

static void outline_of_shared_points_is_closed(void **state) {
  struct ink_fixture k;
  uint32_t p[4];
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < 4; i++)
    p[i] = ink_fixture_point(&k, square[2 * i], square[2 * i + 1]);
  ink_fixture_edge(&k, p[0], p[1], SILHOUETTE);
  ink_fixture_edge(&k, p[3], p[2], SILHOUETTE); /* as the file has them */
  ink_fixture_edge(&k, p[1], p[2], SILHOUETTE);
  ink_fixture_edge(&k, p[0], p[3], SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, true, INK_FIXTURE_XY(square));
  ink_fixture_end(&k);
}

static void outline_of_points_at_the_same_places_is_closed(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < 4; i++) {
    const double *a = square + 2 * i, *b = square + 2 * ((i + 1) % 4);
    ink_fixture_line(&k, a[0], a[1], b[0], b[1], SILHOUETTE);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, true, INK_FIXTURE_XY(square));
  ink_fixture_end(&k);
}

static void cube_is_a_closed_outline_and_two_strokes(void **state) {
  struct ink_fixture k;
  double hexagon[12];
  uint32_t p[7];
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < 6; i++) {
    hexagon[2 * i] = 50 + 30 * cos(i * acos(-1) / 3 + 0.5);
    hexagon[2 * i + 1] = 50 + 30 * sin(i * acos(-1) / 3 + 0.5);
    p[i] = ink_fixture_point(&k, hexagon[2 * i], hexagon[2 * i + 1]);
  }
  p[6] = ink_fixture_point(&k, 50, 50);
  for (int i = 0; i < 6; i += 2)
    ink_fixture_edge(&k, p[i], p[6], CREASE);
  for (int i = 0; i < 6; i++)
    ink_fixture_edge(&k, p[i], p[(i + 1) % 6], SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 3);
  assert_int_equal(count_closed(&k), 1);
  ink_fixture_assert_same_line(&k, 2, true, INK_FIXTURE_XY(hexagon));
  assert_int_equal(k.drawing.stroke.item[0].edge_class, CREASE);
  assert_int_equal(k.drawing.stroke.item[2].edge_class, SILHOUETTE);
  ink_fixture_end(&k);
}

static void outlines_that_touch_at_a_point_close_each(void **state) {
  struct ink_fixture k;
  const double boxes[2][8] = {{10, 10, 50, 10, 50, 50, 10, 50},
                              {50, 50, 90, 50, 90, 90, 50, 90}};
  (void)state;
  ink_fixture_start(&k);
  for (int b = 0; b < 2; b++)
    for (int i = 0; i < 4; i++) {
      const double *p = boxes[b] + 2 * i, *q = boxes[b] + 2 * ((i + 1) % 4);
      uint32_t edge = ink_fixture_line(&k, p[0], p[1], q[0], q[1], SILHOUETTE);
      ink_fixture_set_group(&k, edge, (uint32_t)b);
    }
  ink_fixture_group(&k, "other");
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  assert_int_equal(count_closed(&k), 2);
  ink_fixture_end(&k);
}

static void circle_is_one_closed_stroke(void **state) {
  enum { SIDES = 1000 };
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < SIDES; i++) {
    double a = 2 * acos(-1) * ((i * 7) % SIDES) / SIDES;
    double b = 2 * acos(-1) * ((i * 7) % SIDES + 1) / SIDES;
    ink_fixture_line(&k, 50 + 40 * cos(a), 50 + 40 * sin(a), 50 + 40 * cos(b),
                     50 + 40 * sin(b), SILHOUETTE);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_true(k.drawing.stroke.item[0].closed);
  assert_int_equal(k.drawing.stroke.item[0].count, SIDES);
  ink_fixture_end(&k);
}

/* ---- What is joined ------------------------------------------------------ */

static void straightest_pair_goes_on(void **state) {
  struct ink_fixture k;
  const double flat[] = {10, 50, 90, 50}, steep[] = {40, 10, 60, 90};
  (void)state;
  ink_fixture_start(&k);
  uint32_t middle = ink_fixture_point(&k, 50, 50);
  ink_fixture_edge(&k, ink_fixture_point(&k, 10, 50), middle, CREASE);
  ink_fixture_edge(&k, ink_fixture_point(&k, 40, 10), middle, CREASE);
  ink_fixture_edge(&k, middle, ink_fixture_point(&k, 60, 90), CREASE);
  ink_fixture_edge(&k, ink_fixture_point(&k, 90, 50), middle, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(flat));
  ink_fixture_assert_same_line(&k, 1, false, INK_FIXTURE_XY(steep));
  ink_fixture_end(&k);
}

static void one_class_goes_on_before_a_straighter_other(void **state) {
  struct ink_fixture k;
  const double bent[] = {10, 50, 50, 50, 70, 90};
  (void)state;
  ink_fixture_start(&k);
  uint32_t middle = ink_fixture_point(&k, 50, 50);
  ink_fixture_edge(&k, middle, ink_fixture_point(&k, 90, 50), CREASE);
  ink_fixture_edge(&k, ink_fixture_point(&k, 10, 50), middle, SILHOUETTE);
  ink_fixture_edge(&k, middle, ink_fixture_point(&k, 70, 90), SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_assert_same_line(&k, 1, false, INK_FIXTURE_XY(bent));
  ink_fixture_end(&k);
}

static void two_ends_are_joined_whatever_their_class(void **state) {
  struct ink_fixture k;
  const double sharp[] = {10, 50, 50, 50, 11, 52};
  (void)state;
  ink_fixture_start(&k);
  uint32_t middle = ink_fixture_point(&k, 50, 50);
  ink_fixture_edge(&k, ink_fixture_point(&k, 10, 50), middle, SILHOUETTE);
  ink_fixture_edge(&k, ink_fixture_point(&k, 11, 52), middle, SMOOTH);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(sharp));
  assert_int_equal(k.drawing.stroke.item[0].edge_class, SILHOUETTE);
  ink_fixture_end(&k);
}

static void hidden_and_visible_are_not_joined(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_show(&k, ink_fixture_line(&k, 10, 50, 90, 50, CREASE), 0, 1, 2);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_end(&k);
}

static void strokes_of_two_pens_are_not_joined(void **state) {
  (void)state;
  for (int pens = 1; pens <= 2; pens++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    ink_fixture_group(&k, "other");
    k.options.ink.pens = pens;
    ink_fixture_line(&k, 10, 50, 50, 50, CREASE);
    uint32_t edge = ink_fixture_line(&k, 50, 50, 90, 80, CREASE);
    ink_fixture_set_group(&k, edge, 1);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, pens);
    ink_fixture_end(&k);
  }
}

/* ---- Ids ----------------------------------------------------------------- */

static void stroke_has_the_ids_of_its_first_segment(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_group(&k, "other");
  uint32_t edge = ink_fixture_line(&k, 10, 10, 50, 10, CREASE);
  struct sheet_triangle t = {.face = 42};
  assert_true(ARRAY_PUSH(&k.sheet.triangle, t));
  k.sheet.edge.item[edge].triangle[0] = 0;
  ink_fixture_set_group(&k, edge, 1);
  k.sheet.edge.item[edge].source = 7;
  ink_fixture_draw(&k);
  const struct drawing_stroke *stroke = k.drawing.stroke.item;
  assert_int_equal(stroke->face, 42);
  assert_int_equal(stroke->edge, 7);
  assert_int_equal(stroke->group, 1);
  assert_int_equal(stroke->edge_class, CREASE);
  assert_false(k.drawing.ids);
  assert_int_equal(k.drawing.group_name.count, 2);
  ink_fixture_end(&k);
}

/* A square, two sides of which are another group's. */
static void by_groups_every_stroke_is_of_one_group(void **state) {
  (void)state;
  for (int by_groups = 0; by_groups < 2; by_groups++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.by_groups = by_groups;
    k.options.ink.min_stroke_mm = 1;
    uint32_t other = ink_fixture_group(&k, "other"), p[4];
    for (int i = 0; i < 4; i++)
      p[i] = ink_fixture_point(&k, square[2 * i], square[2 * i + 1]);
    for (uint32_t i = 0; i < 4; i++) {
      uint32_t edge = ink_fixture_edge(&k, p[i], p[(i + 1) % 4], SILHOUETTE);
      ink_fixture_set_group(&k, edge, i < 2 ? other : 0);
    }
    ink_fixture_draw(&k);
    const struct drawing_stroke *stroke = k.drawing.stroke.item;
    assert_int_equal(k.drawing.stroke.count, 1 + by_groups);
    assert_int_equal(stroke[0].closed, !by_groups);
    for (uint32_t i = 0; i < 2 && by_groups; i++) {
      assert_int_equal(stroke[i].group, i);
      assert_int_equal(stroke[i].count, 3);
    }
    assert_false(k.drawing.ids);
    ink_fixture_end(&k);
  }
}

static void with_ids_every_stroke_is_of_one_edge(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.ids = true;
  ink_fixture_group(&k, "other");
  uint32_t p[4];
  for (int i = 0; i < 4; i++)
    p[i] = ink_fixture_point(&k, square[2 * i], square[2 * i + 1]);
  for (uint32_t i = 0; i < 4; i++)
    ink_fixture_edge(&k, p[i], p[(i + 1) % 4], SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 4);
  for (uint32_t i = 0; i < 4; i++) {
    assert_int_equal(k.drawing.stroke.item[i].edge, i);
    assert_int_equal(k.drawing.stroke.item[i].count, 2);
  }
  assert_true(k.drawing.ids);
  assert_int_equal(k.drawing.group_name.count, 2);
  assert_string_equal(k.drawing.group_name.item[0], "thing");
  assert_string_equal(k.drawing.group_name.item[1], "other");
  ink_fixture_end(&k);
}

static void with_ids_a_polyline_of_the_users_is_one_stroke(void **state) {
  struct ink_fixture k;
  const double first[] = {10, 10, 20, 30, 40, 10}, second[] = {40, 10, 60, 20};
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.ids = true;
  uint32_t a = ink_fixture_line(&k, 10, 10, 20, 30, WIRE);
  uint32_t b = ink_fixture_line(&k, 20, 30, 40, 10, WIRE);
  uint32_t c = ink_fixture_line(&k, 40, 10, 60, 20, WIRE);
  k.sheet.edge.item[a].source = k.sheet.edge.item[b].source = 5;
  k.sheet.edge.item[c].source = 6;
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_assert_stroke(&k, 0, false, INK_FIXTURE_XY(first));
  ink_fixture_assert_stroke(&k, 1, false, INK_FIXTURE_XY(second));
  assert_int_equal(k.drawing.stroke.item[0].edge, 5);
  assert_int_equal(k.drawing.stroke.item[1].edge, 6);
  assert_int_equal(k.drawing.stroke.item[0].face, DRAWING_NONE);
  ink_fixture_end(&k);
}

/* Ten edges of a row, 0.4 mm each, and one of that length alone. */
static void with_ids_the_whole_line_decides_what_is_too_short(void **state) {
  enum { EDGES = 10 };
  (void)state;
  for (int ids = 0; ids < 2; ids++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.ids = ids;
    k.options.ink.min_stroke_mm = 0.5;
    uint32_t p = ink_fixture_point(&k, 10, 10);
    for (int i = 1; i <= EDGES; i++) {
      uint32_t q = ink_fixture_point(&k, 10 + 0.4 * i, 10 + i % 2 * 0.1);
      ink_fixture_edge(&k, p, q, CREASE);
      p = q;
    }
    ink_fixture_line(&k, 50, 50, 50.4, 50, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, ids ? EDGES : 1);
    double length = 0;
    for (size_t i = 0; i < k.drawing.stroke.count; i++)
      length += ink_fixture_stroke_length(&k, i);
    assert_true(fabs(length - EDGES * hypot(0.4, 0.1)) < 1e-5);
    ink_fixture_end(&k);
  }
}

/* ---- Any graph ----------------------------------------------------------- */

/* An open stroke starts at its lower end, a closed one goes to the lower
 * neighbour of its start. */
static void assert_directions(const struct ink_fixture *k) {
  for (size_t s = 0; s < k->drawing.stroke.count; s++) {
    const struct drawing_stroke *stroke = &k->drawing.stroke.item[s];
    const struct drawing_point *p = k->drawing.point.item + stroke->point;
    struct drawing_point a = p[stroke->closed], b = p[stroke->count - 1];
    assert_true(a.x < b.x || (a.x == b.x && a.y <= b.y));
  }
}

/* Chains of a graph: every edge once, and no more open strokes than its odd
 * nodes demand. */
static void random_graphs_need_no_more_strokes_than_odd_nodes(void **state) {
  enum { NODES = 40, EDGES = 90 };
  struct random random = {23};
  int rounds = is_under_valgrind() ? 20 : 500;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct ink_fixture k;
    bool linked[NODES][NODES] = {{false}};
    int degree[NODES] = {0};
    double length = 0;
    ink_fixture_start(&k);
    /* On a circle: no two edges overlap. */
    for (int i = 0; i < NODES; i++)
      ink_fixture_point(&k, 50 + 45 * cos(i * 0.157), 50 + 45 * sin(i * 0.157));
    for (int i = 0; i < EDGES; i++) {
      uint32_t a = random_below(&random, NODES),
               b = random_below(&random, NODES);
      if (round % 5 == 0)
        a = 3; /* more ends at a node than are paired one by one */
      if (a == b || linked[a][b])
        continue;
      linked[a][b] = linked[b][a] = true;
      degree[a]++;
      degree[b]++;
      ink_fixture_edge(&k, a, b,
                       1u << random_below(&random, 1 + (uint32_t)round % 7));
      length +=
          hypot((double)k.sheet.point.item[a].x - k.sheet.point.item[b].x,
                (double)k.sheet.point.item[a].y - k.sheet.point.item[b].y) /
          1048576;
    }
    ink_fixture_draw(&k);
    size_t odd = 0;
    for (int i = 0; i < NODES; i++)
      odd += (size_t)(degree[i] % 2);
    assert_int_equal(k.drawing.stroke.count - count_closed(&k), odd / 2);
    assert_directions(&k);
    assert_true(fabs(total_length(&k) - length) < 1e-3);
    ink_fixture_end(&k);
  }
}

static void full_fan_is_paired_straight_through(void **state) {
  static const int spokes[] = {4, 8, 14, 16, 18, 40, 1000};
  (void)state;
  for (size_t n = 0; n < sizeof spokes / sizeof *spokes; n++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    uint32_t hub = ink_fixture_point(&k, 50, 50);
    for (int i = 0; i < spokes[n]; i++) {
      double angle = 2 * acos(-1) * ((i * 3) % spokes[n]) / spokes[n] + 0.1;
      if (spokes[n] % 3 == 0)
        angle = 2 * acos(-1) * i / spokes[n] + 0.1;
      ink_fixture_edge(
          &k, hub,
          ink_fixture_point(&k, 50 + 40 * cos(angle), 50 + 40 * sin(angle)),
          CREASE);
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, spokes[n] / 2);
    for (size_t s = 0; s < k.drawing.stroke.count; s++)
      assert_int_equal(k.drawing.stroke.item[s].count, 2);
    ink_fixture_end(&k);
  }
}

static void fan_of_100000_takes_bounded_time(void **state) {
  int spokes = is_under_valgrind() ? 500 : 100000;
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  uint32_t hub = ink_fixture_point(&k, 10, 10);
  for (int i = 0; i < spokes; i++)
    ink_fixture_edge(&k, hub, ink_fixture_point(&k, 90, 20 + 60.0 * i / spokes),
                     i % 3 ? CREASE : SMOOTH);
  double before = clock_cpu();
  ink_fixture_draw(&k);
  assert_true(is_under_valgrind() || clock_cpu() - before < 2);
  assert_int_equal(k.drawing.stroke.count, spokes / 2);
  ink_fixture_end(&k);
}

static void strokes_come_as_the_edges_come(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < 20; i++)
    ink_fixture_line(&k, 10, 5 + (i * 7 % 20) * 4, 90, 5 + (i * 7 % 20) * 4,
                     CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 20);
  for (uint32_t i = 0; i < 20; i++)
    assert_int_equal(k.drawing.stroke.item[i].edge, i);
  ink_fixture_end(&k);
}

/* Rows of Ys: at every fork the foot goes on as straight to either side.  The
 * edges are in any order and direction. */
static void draw_forks(struct ink_fixture *k, uint64_t seed) {
  enum { SIDE = 9, EDGES = 3 * SIDE * SIDE };
  static const int arm[3][2] = {{1, 1}, {-1, 1}, {0, -1}};
  struct random random = {seed};
  int order[EDGES];
  ink_fixture_start(k);
  for (int i = 0; i < EDGES; i++) {
    int other = (int)random_below(&random, (uint32_t)i + 1);
    order[i] = order[other];
    order[other] = i;
  }
  for (int i = 0; i < EDGES; i++) {
    int x = 10 + 8 * (order[i] / 3 % SIDE), y = 10 + 9 * (order[i] / 3 / SIDE);
    int dx = 4 * arm[order[i] % 3][0], dy = 4 * arm[order[i] % 3][1];
    if (random_below(&random, 2))
      ink_fixture_line(k, x, y, x + dx, y + dy, SMOOTH);
    else
      ink_fixture_line(k, x + dx, y + dy, x, y, SMOOTH);
  }
  /* And a loop. */
  for (int i = 0; i < 4; i++) {
    int at = seed % 2 ? i : 3 - i, to = (at + 1) % 4;
    ink_fixture_line(k, 5 + square[2 * at] / 50, square[2 * at + 1],
                     5 + square[2 * to] / 50, square[2 * to + 1], SMOOTH);
  }
  ink_fixture_draw(k);
}

static bool is_same_stroke(const struct drawing *a, size_t s,
                           const struct drawing *b, size_t t) {
  const struct drawing_stroke *p = &a->stroke.item[s], *q = &b->stroke.item[t];
  return p->count == q->count && p->closed == q->closed &&
         memcmp(a->point.item + p->point, b->point.item + q->point,
                p->count * sizeof *a->point.item) == 0;
}

static void shuffled_edges_give_the_same_strokes(void **state) {
  struct ink_fixture a;
  (void)state;
  draw_forks(&a, 1);
  assert_in_range(a.drawing.stroke.count, 50, 200);
  assert_in_range(count_closed(&a), 1, 2);
  for (uint64_t seed = 2; seed < 12; seed++) {
    struct ink_fixture b;
    draw_forks(&b, seed);
    assert_int_equal(a.drawing.stroke.count, b.drawing.stroke.count);
    for (size_t s = 0; s < a.drawing.stroke.count; s++) {
      size_t found = 0;
      for (size_t t = 0; t < b.drawing.stroke.count; t++)
        found += is_same_stroke(&a.drawing, s, &b.drawing, t);
      assert_int_equal(found, 1);
    }
    ink_fixture_end(&b);
  }
  ink_fixture_end(&a);
}

static void same_sheet_gives_the_same_drawing(void **state) {
  struct random random = {31};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.order = RECTO_ORDER_NEAR;
  for (int i = 0; i < 300; i++)
    ink_fixture_line(
        &k, random_int(&random, 0, 20) * 5, random_int(&random, 0, 20) * 5,
        random_int(&random, 0, 20) * 5, random_int(&random, 0, 20) * 5,
        1u << random_below(&random, 7));
  ink_fixture_draw(&k);
  struct drawing first = k.drawing;
  drawing_init(&k.drawing);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, first.stroke.count);
  for (size_t i = 0; i < first.stroke.count; i++) {
    const struct drawing_stroke *a = &first.stroke.item[i];
    const struct drawing_stroke *b = &k.drawing.stroke.item[i];
    assert_int_equal(a->point, b->point);
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->closed, b->closed);
    assert_int_equal(a->edge, b->edge);
  }
  assert_int_equal(k.drawing.point.count, first.point.count);
  assert_memory_equal(k.drawing.point.item, first.point.item,
                      first.point.count * sizeof *first.point.item);
  drawing_fini(&first);
  ink_fixture_end(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(outline_of_shared_points_is_closed),
      cmocka_unit_test(outline_of_points_at_the_same_places_is_closed),
      cmocka_unit_test(cube_is_a_closed_outline_and_two_strokes),
      cmocka_unit_test(outlines_that_touch_at_a_point_close_each),
      cmocka_unit_test(circle_is_one_closed_stroke),
      cmocka_unit_test(straightest_pair_goes_on),
      cmocka_unit_test(one_class_goes_on_before_a_straighter_other),
      cmocka_unit_test(two_ends_are_joined_whatever_their_class),
      cmocka_unit_test(hidden_and_visible_are_not_joined),
      cmocka_unit_test(strokes_of_two_pens_are_not_joined),
      cmocka_unit_test(stroke_has_the_ids_of_its_first_segment),
      cmocka_unit_test(by_groups_every_stroke_is_of_one_group),
      cmocka_unit_test(with_ids_every_stroke_is_of_one_edge),
      cmocka_unit_test(with_ids_a_polyline_of_the_users_is_one_stroke),
      cmocka_unit_test(with_ids_the_whole_line_decides_what_is_too_short),
      cmocka_unit_test(random_graphs_need_no_more_strokes_than_odd_nodes),
      cmocka_unit_test(full_fan_is_paired_straight_through),
      cmocka_unit_test(fan_of_100000_takes_bounded_time),
      cmocka_unit_test(strokes_come_as_the_edges_come),
      cmocka_unit_test(shuffled_edges_give_the_same_strokes),
      cmocka_unit_test(same_sheet_gives_the_same_drawing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
