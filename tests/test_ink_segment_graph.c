/* test_ink_segment_graph.c - intervals become lines, and every line is drawn
 * once. */
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
  BORDER = RECTO_EDGE_BORDER,
  CREASE = RECTO_EDGE_CREASE,
  SMOOTH = RECTO_EDGE_SMOOTH
};

#define NANOMETRE (1.0 / 1048576)

/* ---- Intervals ----------------------------------------------------------- */

static void visible_edge_is_a_stroke(void **state) {
  struct ink_fixture k;
  const double line[] = {10, 20, 30, 45};
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 20, 30, 45, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_stroke(&k, 0, false, INK_FIXTURE_XY(line));
  assert_true(k.drawing.width_mm == 100 && k.drawing.height_mm == 100);
  ink_fixture_end(&k);
}

static void hidden_edges_and_outlines_are_not_drawn(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 20, 30, 45, CREASE));
  ink_fixture_line(&k, 10, 30, 30, 55, 0);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

static void map_without_strokes_gives_none(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 20, 30, 45, CREASE);
  assert_int_equal(
      ink_draw(&k.drawing, &k.sheet, &k.scene, &k.map, &k.options, NULL),
      RECTO_OK);
  assert_int_equal(k.drawing.stroke.count, 0);
  assert_int_equal(k.drawing.layer.count, 1);
  ink_fixture_end(&k);
}

static void intervals_are_cut_out_of_their_edge(void **state) {
  struct ink_fixture k;
  const double first[] = {10, 10, 20, 20}, second[] = {30, 30, 40, 40};
  (void)state;
  ink_fixture_start(&k);
  uint32_t edge = ink_fixture_line(&k, 0, 0, 40, 40, CREASE);
  ink_fixture_show(&k, edge, 1, 2, 4);
  ink_fixture_show(&k, edge, 3, 4, 4);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  /* The open end of the second comes first: it is the edge's own point. */
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(first));
  ink_fixture_assert_same_line(&k, 1, false, INK_FIXTURE_XY(second));
  ink_fixture_end(&k);
}

static void interval_ends_are_rounded_to_the_grid(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  uint32_t edge = ink_fixture_line_at(&k, 0, 0, 1000000, 500000, CREASE);
  ink_fixture_show(&k, edge, 1, 2,
                   3); /* 333333.3, 166666.7 to 666666.7, 333333.3 */
  ink_fixture_draw(&k);
  const double line[] = {50 + 333333 * NANOMETRE, 50 + 166667 * NANOMETRE,
                         50 + 666667 * NANOMETRE, 50 + 333333 * NANOMETRE};
  ink_fixture_assert_stroke(&k, 0, false, INK_FIXTURE_XY(line));
  const struct drawing_point *p = k.drawing.point.item;
  for (int i = 0; i < 2; i++)
    assert_true(p[i].x * 1048576 == floor(p[i].x * 1048576) &&
                p[i].y * 1048576 == floor(p[i].y * 1048576));
  ink_fixture_end(&k);
}

static void visible_and_hidden_make_the_edge_whole(void **state) {
  struct random random = {7};
  (void)state;
  for (int round = 0; round < 200; round++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.hidden = RECTO_HIDDEN_LAYER;
    uint32_t edge = ink_fixture_line_at(
        &k, random_int(&random, -50000000, 0), random_int(&random, -9000, 9000),
        random_int(&random, 10000, 50000000),
        random_int(&random, -50000000, 50000000), CREASE);
    double whole =
        hypot((double)k.sheet.point.item[1].x - k.sheet.point.item[0].x,
              (double)k.sheet.point.item[1].y - k.sheet.point.item[0].y) /
        1048576;
    int count = random_int(&random, 1, 6), t = random_int(&random, 0, 1) * 10;
    for (int i = 0; i < count; i++, t += 20)
      ink_fixture_show(&k, edge, t, t + 10, 120);
    ink_fixture_draw(&k);
    double drawn = 0;
    for (size_t s = 0; s < k.drawing.stroke.count; s++)
      drawn += ink_fixture_stroke_length(&k, s);
    assert_true(fabs(drawn - whole) < 12 * NANOMETRE);
    ink_fixture_end(&k);
  }
}

static void edges_without_length_are_dropped_and_counted(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 20, 10, 20, CREASE);
  uint32_t tiny = ink_fixture_line_at(&k, 5, 5, 105, 5, CREASE);
  ink_fixture_show(&k, tiny, 1000, 1001,
                   1000000); /* a ten-thousandth of a unit */
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

static void segments_and_strokes_are_counted(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 20, 10, 20, CREASE);
  ink_fixture_line(&k, 10, 20, 30, 20, CREASE);
  ink_fixture_line(&k, 10, 20, 30, 20, CREASE);
  ink_fixture_line(&k, 80, 80, 80.25, 80, CREASE);
  k.options.ink.min_stroke_mm = 1;
  k.map.edge_state = k.state.item;
  k.map.edge_count = k.state.count;
  assert_int_equal(
      ink_draw(&k.drawing, &k.sheet, &k.scene, &k.map, &k.options, NULL),
      RECTO_OK);
  k.map.edge_state = NULL;
  const struct drawing_counts *counts = &k.drawing.counts;
  assert_int_equal(counts->segments, 3);
  assert_int_equal(counts->without_length, 1);
  assert_int_equal(counts->drawn_twice, 1);
  assert_int_equal(counts->too_short, 1);
  assert_int_equal(counts->pen_lifts, 1);
  ink_fixture_end(&k);
}

/* ---- Joints -------------------------------------------------------------- */

static void interval_ends_join_at_one_grid_point(void **state) {
  struct ink_fixture k;
  const double line[] = {10, 10, 30, 10, 30, 40};
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_show(&k, ink_fixture_line(&k, 10, 10, 50, 10, SILHOUETTE), 0, 1,
                   2);
  ink_fixture_line(&k, 30, 10, 30, 40, RECTO_EDGE_INTERSECTION);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(line));
  ink_fixture_end(&k);
}

static void ends_a_unit_apart_join(void **state) {
  (void)state;
  for (int dx = -2; dx <= 2; dx++) {
    for (int dy = -2; dy <= 2; dy++) {
      struct ink_fixture k;
      ink_fixture_start(&k);
      ink_fixture_line_at(&k, -1000000, 0, 0, 0, CREASE);
      ink_fixture_line_at(&k, dx, dy, 0, 1000000, CREASE);
      ink_fixture_draw(&k);
      assert_int_equal(k.drawing.stroke.count, 1);
      ink_fixture_end(&k);
    }
  }
}

/* So flat a sheet that there are rows a few units high. */
static void ends_join_across_rows(void **state) {
  enum { PAIRS = 2000 };
  struct random random = {17};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < PAIRS; i++) {
    int x = (i - PAIRS / 2) * 4000, y = random_int(&random, -150, 150);
    int dx = random_int(&random, -2, 2), dy = random_int(&random, -2, 2);
    ink_fixture_line_at(&k, x - 800, y, x, y, CREASE);
    ink_fixture_line_at(&k, x + dx, y + dy, x + 900, y - 5, CREASE);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, PAIRS);
  ink_fixture_end(&k);
}

static void lines_are_seen_to_overlap_across_rows(void **state) {
  enum { PAIRS = 2000 };
  struct random random = {19};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < PAIRS; i++) {
    int x = (i - PAIRS / 2) * 5000, y = random_int(&random, -150, 150);
    int rise = i % 2 ? random_int(&random, -60, 60) : i % 4 / 2;
    int off = random_int(&random, -1, 1);
    /* From a third to its end and beyond; or to before its end, where only
     * the longer one meets ends of the other. */
    int end = i % 3 ? 3 : 2;
    ink_fixture_line_at(&k, x, y, x + 1800, y + 3 * rise, CREASE);
    ink_fixture_line_at(&k, x + 600, y + rise + off, x + 600 * (end + i % 3),
                        y + (end + i % 3) * rise + off, CREASE);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, PAIRS);
  for (size_t s = 0; s < PAIRS; s++)
    assert_true(ink_fixture_stroke_length(&k, s) < 3100 * NANOMETRE);
  ink_fixture_end(&k);
}

static void ends_farther_apart_stay_apart(void **state) {
  (void)state;
  for (int turn = 0; turn < 4; turn++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    ink_fixture_line_at(&k, -1000000, -1000000, 0, 0, CREASE);
    ink_fixture_line_at(&k, turn & 1 ? 5 : 0, turn & 2 ? 5 : -5, 1000000,
                        4000000, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 2);
    ink_fixture_end(&k);
  }
}

/* ---- Lines on each other ------------------------------------------------- */

static void line_drawn_twice_is_drawn_once(void **state) {
  const double line[] = {10, 10, 40, 30};
  (void)state;
  for (int turned = 0; turned < 2; turned++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    ink_fixture_line(&k, 10, 10, 40, 30, CREASE);
    if (turned)
      ink_fixture_line(&k, 40, 30, 10, 10, CREASE);
    else
      ink_fixture_line(&k, 10, 10, 40, 30, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(line));
    ink_fixture_end(&k);
  }
}

static void lower_class_survives_then_lower_edge(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 10, 40, 30, SMOOTH);
  ink_fixture_line(&k, 40, 30, 10, 10, CREASE);
  ink_fixture_line(&k, 10, 10, 40, 30, BORDER);
  ink_fixture_line(&k, 10, 10, 40, 30, BORDER);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].edge_class, BORDER);
  assert_int_equal(k.drawing.stroke.item[0].edge, 2);
  ink_fixture_end(&k);
}

static void what_lies_beyond_the_other_stays(void **state) {
  struct ink_fixture k;
  const double all[] = {10, 10, 70, 40};
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 10, 50, 30, CREASE);
  ink_fixture_line(&k, 70, 40, 30, 20, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(all));
  ink_fixture_end(&k);
}

static void shorter_line_of_lower_class_is_let_in(void **state) {
  struct ink_fixture k;
  const double left[] = {10, 10, 20, 10}, middle[] = {20, 10, 40, 10};
  const double right[] = {40, 10, 90, 10};
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.ids = true;
  ink_fixture_line(&k, 10, 10, 90, 10, SMOOTH);
  ink_fixture_line(&k, 40, 10, 20, 10, BORDER);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 3);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(left));
  ink_fixture_assert_same_line(&k, 1, false, INK_FIXTURE_XY(right));
  ink_fixture_assert_same_line(&k, 2, false, INK_FIXTURE_XY(middle));
  assert_int_equal(k.drawing.stroke.item[0].edge_class, SMOOTH);
  assert_int_equal(k.drawing.stroke.item[1].edge_class, SMOOTH);
  assert_int_equal(k.drawing.stroke.item[2].edge_class, BORDER);
  ink_fixture_end(&k);
}

static void visible_line_wins_over_hidden(void **state) {
  struct ink_fixture k;
  const double seen[] = {30, 10, 50, 10};
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.hidden = RECTO_HIDDEN_LAYER;
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 10, 90, 10, SILHOUETTE));
  ink_fixture_line(&k, 30, 10, 50, 10, SMOOTH);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 3);
  /* The hidden lines come first, on a layer below. */
  ink_fixture_assert_same_line(&k, 2, false, INK_FIXTURE_XY(seen));
  assert_int_equal(k.drawing.stroke.item[0].layer, 0);
  assert_int_equal(k.drawing.stroke.item[1].layer, 0);
  assert_int_equal(k.drawing.stroke.item[2].layer, 1);
  double hidden =
      ink_fixture_stroke_length(&k, 0) + ink_fixture_stroke_length(&k, 1);
  assert_true(fabs(hidden - 60) < 4 * NANOMETRE);
  ink_fixture_end(&k);
}

static void hidden_line_under_a_visible_one_is_not_drawn(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.hidden = RECTO_HIDDEN_DASHED;
  ink_fixture_line(&k, 10, 10, 90, 10, SMOOTH);
  ink_fixture_hide(&k, ink_fixture_line(&k, 10, 10, 90, 10, SILHOUETTE));
  ink_fixture_hide(&k, ink_fixture_line(&k, 30, 10, 40, 10, SILHOUETTE));
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_end(&k);
}

static void hanging_vertices_draw_their_line_once(void **state) {
  struct random random = {11};
  (void)state;
  for (int round = 0; round < 300; round++) {
    /* One long edge, and the same as pieces whose ends are rounded. */
    struct ink_fixture k;
    int32_t x0 = random_int(&random, -40000000, 40000000);
    int32_t y0 = random_int(&random, -40000000, 40000000);
    int32_t x1 = random_int(&random, -40000000, 40000000);
    int32_t y1 = round % 3 ? random_int(&random, -40000000, 40000000) : y0;
    int pieces = random_int(&random, 2, 40);
    if (hypot((double)x1 - x0, (double)y1 - y0) < 1e6)
      continue;
    ink_fixture_start(&k);
    ink_fixture_line_at(&k, x0, y0, x1, y1, BORDER);
    uint32_t last = 0;
    for (int i = 1; i <= pieces; i++) {
      double t = (double)i / pieces;
      uint32_t here =
          ink_fixture_point_at(&k, (int32_t)lrint(x0 + t * (x1 - x0)),
                               (int32_t)lrint(y0 + t * (y1 - y0)));
      ink_fixture_edge(&k, last, here, BORDER);
      last = here;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].count, 2);
    ink_fixture_end(&k);
  }
}

static void parallel_lines_farther_than_the_tolerance_stay_two(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line_at(&k, -9000000, 100, 9000000, 100, CREASE);
  ink_fixture_line_at(&k, -9000000, 106, 9000000, 106, CREASE);
  ink_fixture_line_at(&k, -9000000, -9000000, 9000000, 9000000, CREASE);
  ink_fixture_line_at(&k, -9000000, -9000008, 9000000, 8999992, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 4);
  ink_fixture_end(&k);
}

static void crossings_and_t_junctions_change_nothing(void **state) {
  struct ink_fixture k;
  const double through[] = {10, 50, 90, 50};
  (void)state;
  ink_fixture_start(&k);
  ink_fixture_line(&k, 10, 50, 90, 50, SILHOUETTE);
  ink_fixture_line(&k, 50, 10, 50, 90, CREASE); /* crosses */
  ink_fixture_line(&k, 30, 50, 30, 90, CREASE); /* ends on it */
  ink_fixture_line(&k, 10, 20, 60, 50, CREASE); /* at a slant */
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 4);
  ink_fixture_assert_stroke(&k, 0, false, INK_FIXTURE_XY(through));
  ink_fixture_end(&k);
}

static void sharp_angle_is_two_lines(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.ids = true; /* each on its own */
  uint32_t tip = ink_fixture_point_at(&k, 0, 0);
  for (int i = 0; i < 20; i++) {
    /* Neighbours are 20 units apart where they end. */
    uint32_t far = ink_fixture_point_at(&k, 40000000, 20 * i);
    ink_fixture_edge(&k, tip, far, CREASE);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 20);
  for (size_t i = 0; i < 20; i++)
    assert_true(ink_fixture_stroke_length(&k, i) > 38);
  ink_fixture_end(&k);
}

/* ---- Many of them -------------------------------------------------------- */

struct piece {
  int from, to; /* along the line, in steps */
  unsigned edge_class;
  bool hidden;
};

/* Which of the pieces is to be drawn between steps s and s + 1; -1: none. */
static int owner_of(const struct piece *piece, int count, int s) {
  int best = -1;
  for (int i = 0; i < count; i++) {
    int low = piece[i].from < piece[i].to ? piece[i].from : piece[i].to;
    int high = piece[i].from < piece[i].to ? piece[i].to : piece[i].from;
    if (low > s || s >= high)
      continue;
    if (best < 0 || piece[i].hidden < piece[best].hidden ||
        (piece[i].hidden == piece[best].hidden &&
         piece[i].edge_class < piece[best].edge_class))
      best = i;
  }
  return best;
}

/* The stroke that passes within a few units of a place, -1: none; fails
 * where there are two. */
static int stroke_at(const struct ink_fixture *k, double x, double y) {
  int found = -1;
  for (size_t s = 0; s < k->drawing.stroke.count; s++) {
    struct ink_fixture one = *k;
    one.drawing.stroke.item += s;
    one.drawing.stroke.count = 1;
    if (ink_fixture_distance(&one, x, y) < 8 * NANOMETRE) {
      assert_int_equal(found, -1);
      found = (int)s;
    }
  }
  return found;
}

static void random_lines_on_a_line_leave_their_best(void **state) {
  enum { STEPS = 30, MOST = 12 };
  struct random random = {3};
  int rounds = is_under_valgrind() ? 40 : 1500;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct ink_fixture k;
    struct piece piece[MOST];
    int count = random_int(&random, 2, MOST);
    /* A direction that is the grid's, nearly the grid's, or neither. */
    double angle = random_unit(&random) * 6.3;
    double dx = cos(angle) * 1000000, dy = sin(angle) * 1000000;
    if (round % 4 == 0) {
      dx = round % 8 ? 0 : 1000000;
      dy = round % 8 ? 1000000 : 0;
    }
    double x0 = random_between(&random, -1e6, 1e6);
    double y0 = random_between(&random, -1e6, 1e6);
    ink_fixture_start(&k);
    k.options.ink.ids = true;
    k.options.ink.hidden = RECTO_HIDDEN_LAYER;
    for (int i = 0; i < count; i++) {
      struct piece *p = &piece[i];
      p->from = random_int(&random, 0, STEPS);
      do
        p->to = random_int(&random, 0, STEPS);
      while (p->to == p->from);
      p->edge_class = 1u << random_int(&random, 0, 6);
      p->hidden = random_below(&random, 3) == 0;
      uint32_t edge = ink_fixture_line_at(
          &k, (int32_t)lrint(x0 + p->from * dx),
          (int32_t)lrint(y0 + p->from * dy), (int32_t)lrint(x0 + p->to * dx),
          (int32_t)lrint(y0 + p->to * dy), p->edge_class);
      k.sheet.edge.item[edge].source = edge; /* wires: each its own */
      if (p->hidden)
        ink_fixture_hide(&k, edge);
    }
    /* Something to cross, so that there are more rows. */
    ink_fixture_line_at(&k, -30000000, -40000000, -30000000, 40000000, CREASE);
    ink_fixture_line_at(&k, -20000000, -45000000, 30000000, -45000000, CREASE);
    ink_fixture_draw(&k);
    for (int s = 0; s < STEPS; s++) {
      double x = 50 + (x0 + (s + 0.5) * dx) * NANOMETRE;
      double y = 50 + (y0 + (s + 0.5) * dy) * NANOMETRE;
      int owner = owner_of(piece, count, s), stroke = stroke_at(&k, x, y);
      if (owner < 0) {
        assert_int_equal(stroke, -1);
        continue;
      }
      assert_int_not_equal(stroke, -1);
      const struct drawing_stroke *drawn = &k.drawing.stroke.item[stroke];
      assert_int_equal(drawn->edge, owner);
      assert_int_equal(drawn->edge_class, piece[owner].edge_class);
      assert_int_equal(k.drawing.layer.item[drawn->layer].pen,
                       piece[owner].hidden ? 2 : 1);
    }
    ink_fixture_end(&k);
  }
}

/* n edges on one line, each begun and ended elsewhere, all overlapping. */
static void draw_staggered(struct ink_fixture *k, int n) {
  for (int i = 0; i < n; i++)
    ink_fixture_line_at(k, -20000000 + 700 * i, -10000000 + 350 * i,
                        20000000 + 7000 * (i % 99), 10000000 + 3500 * (i % 99),
                        CREASE);
  ink_fixture_draw(k);
}

static void thousands_of_coincident_edges_take_bounded_time(void **state) {
  int count = is_under_valgrind() ? 200 : 4000;
  const double end[] = {50 - 20000000 * NANOMETRE, 50 - 10000000 * NANOMETRE,
                        50 + 20686000 * NANOMETRE, 50 + 10343000 * NANOMETRE};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  double before = clock_cpu();
  draw_staggered(&k, count);
  assert_true(is_under_valgrind() || clock_cpu() - before < 3);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(end));
  ink_fixture_end(&k);
}

static void pipe_along_its_axis_is_one_ring(void **state) {
  /* Rings of a pipe, one behind the other, all at the same places; the edges
   * along the axis have no length on the page. */
  enum { SIDES = 32, RINGS = 200 };
  struct ink_fixture k;
  uint32_t last[SIDES];
  (void)state;
  ink_fixture_start(&k);
  for (int ring = 0; ring < RINGS; ring++) {
    uint32_t first = (uint32_t)k.sheet.point.count;
    for (int i = 0; i < SIDES; i++) {
      double angle = i * 2 * acos(-1) / SIDES;
      uint32_t p =
          ink_fixture_point(&k, 50 + 40 * cos(angle), 50 + 40 * sin(angle));
      if (ring > 0)
        ink_fixture_edge(&k, last[i], p, SMOOTH);
      last[i] = p;
    }
    for (uint32_t i = 0; i < SIDES; i++)
      ink_fixture_edge(&k, first + i, first + (i + 1) % SIDES, BORDER);
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].count, SIDES);
  assert_true(k.drawing.stroke.item[0].closed);
  ink_fixture_end(&k);
}

static void dense_nodes_take_bounded_time(void **state) {
  /* Half of all in one corner of a nanometre grid, half across the page. */
  int count = is_under_valgrind() ? 300 : 40000;
  struct random random = {5};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int i = 0; i < count; i++) {
    int span = i % 2 ? 2000 : 40000000;
    int x = random_int(&random, -span, span),
        y = random_int(&random, -span, span);
    ink_fixture_line_at(
        &k, x, y, x + random_int(&random, -span / 100, span / 100),
        y + random_int(&random, -span / 100, span / 100), CREASE);
  }
  double before = clock_cpu();
  ink_fixture_draw(&k);
  assert_true(is_under_valgrind() || clock_cpu() - before < 3);
  assert_true(k.drawing.stroke.count > 0);
  ink_fixture_end(&k);
}

static void columns_and_rows_of_a_lattice_are_lines(void **state) {
  /* A lattice of N x N cells, every cell with four edges of its own: as a
   * stack of touching boxes seen square-on. */
  enum { N = 40 };
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  for (int y = 0; y < N; y++) {
    for (int x = 0; x < N; x++) {
      uint32_t p[4];
      for (int i = 0; i < 4; i++)
        p[i] = ink_fixture_point(&k, 10 + 2 * (x + (i == 1 || i == 2)),
                                 10 + 2 * (y + i / 2));
      for (int i = 0; i < 4; i++)
        ink_fixture_edge(&k, p[i], p[(i + 1) % 4], CREASE);
    }
  }
  ink_fixture_draw(&k);
  double length = 0;
  for (size_t i = 0; i < k.drawing.stroke.count; i++)
    length += ink_fixture_stroke_length(&k, i);
  assert_true(fabs(length - 2 * (N + 1) * 2 * N) < 1e-3);
  assert_int_equal(k.drawing.stroke.count, 2 * (N - 1) + 1);
  ink_fixture_end(&k);
}

static void order_of_the_edges_does_not_change_the_lines(void **state) {
  struct random random = {29};
  (void)state;
  for (int round = 0; round < 50; round++) {
    /* The same lines, given forwards and backwards: the same ink. */
    struct ink_fixture a, b;
    int32_t xy[60][4];
    ink_fixture_start(&a);
    ink_fixture_start(&b);
    for (int i = 0; i < 60; i++)
      for (int c = 0; c < 4; c++)
        xy[i][c] = random_int(&random, -6, 6) * 4000000 +
                   random_int(&random, -1, 1) * (round % 2);
    for (int i = 0; i < 60; i++) {
      const int32_t *p = xy[i], *q = xy[59 - i];
      ink_fixture_line_at(&a, p[0], p[1], p[2], p[3], CREASE);
      ink_fixture_line_at(&b, q[0], q[1], q[2], q[3], CREASE);
    }
    ink_fixture_draw(&a);
    ink_fixture_draw(&b);
    double of_a = drawing_length_mm(&a.drawing);
    double of_b = drawing_length_mm(&b.drawing);
    assert_true(fabs(of_a - of_b) < 1000 * NANOMETRE);
    for (size_t s = 0; s < a.drawing.stroke.count; s++) {
      struct drawing_point p =
          a.drawing.point.item[a.drawing.stroke.item[s].point];
      assert_true(ink_fixture_distance(&b, p.x, p.y) < 8 * NANOMETRE);
    }
    ink_fixture_end(&a);
    ink_fixture_end(&b);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(visible_edge_is_a_stroke),
      cmocka_unit_test(hidden_edges_and_outlines_are_not_drawn),
      cmocka_unit_test(map_without_strokes_gives_none),
      cmocka_unit_test(intervals_are_cut_out_of_their_edge),
      cmocka_unit_test(interval_ends_are_rounded_to_the_grid),
      cmocka_unit_test(visible_and_hidden_make_the_edge_whole),
      cmocka_unit_test(edges_without_length_are_dropped_and_counted),
      cmocka_unit_test(segments_and_strokes_are_counted),
      cmocka_unit_test(interval_ends_join_at_one_grid_point),
      cmocka_unit_test(ends_a_unit_apart_join),
      cmocka_unit_test(ends_join_across_rows),
      cmocka_unit_test(lines_are_seen_to_overlap_across_rows),
      cmocka_unit_test(ends_farther_apart_stay_apart),
      cmocka_unit_test(line_drawn_twice_is_drawn_once),
      cmocka_unit_test(lower_class_survives_then_lower_edge),
      cmocka_unit_test(what_lies_beyond_the_other_stays),
      cmocka_unit_test(shorter_line_of_lower_class_is_let_in),
      cmocka_unit_test(visible_line_wins_over_hidden),
      cmocka_unit_test(hidden_line_under_a_visible_one_is_not_drawn),
      cmocka_unit_test(hanging_vertices_draw_their_line_once),
      cmocka_unit_test(parallel_lines_farther_than_the_tolerance_stay_two),
      cmocka_unit_test(crossings_and_t_junctions_change_nothing),
      cmocka_unit_test(sharp_angle_is_two_lines),
      cmocka_unit_test(random_lines_on_a_line_leave_their_best),
      cmocka_unit_test(thousands_of_coincident_edges_take_bounded_time),
      cmocka_unit_test(pipe_along_its_axis_is_one_ring),
      cmocka_unit_test(dense_nodes_take_bounded_time),
      cmocka_unit_test(columns_and_rows_of_a_lattice_are_lines),
      cmocka_unit_test(order_of_the_edges_does_not_change_the_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
