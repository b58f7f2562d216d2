/* test_ink_overlap_output.c - lines that are equal at the output's resolution
 * are in a file once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/clock.h"
#include "ink/lines/segment_graph.h"
#include "ink/pens.h"
#include "tests/ink_fixture.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/valgrind.h"

/* The unit of these drawings, in grid units and in mm. */
enum { UNIT = 1024, BIG = 20000 * UNIT };
#define UNIT_MM (UNIT / 1048576.0)

enum { CREASE = RECTO_EDGE_CREASE, BORDER = RECTO_EDGE_BORDER };

static void start(struct ink_fixture *k) {
  ink_fixture_start(k);
  k->options.output.unit_mm = UNIT_MM;
}

/* ---- What a drawing is once it is rounded -------------------------------- */

struct unit_point {
  int64_t x, y; /* output units */
};

struct side {
  struct unit_point a, b;
  bool hidden;
};

struct sides {
  ARRAY(struct side) side;
};

static struct unit_point round_point(struct drawing_point p, double unit) {
  return (struct unit_point){llround(p.x / unit), llround(p.y / unit)};
}

static void round_drawing(struct sides *sides, const struct drawing *drawing,
                          double unit) {
  *sides = (struct sides){0};
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const struct drawing_point *p = drawing->point.item + stroke->point;
    for (uint32_t k = 0; k + !stroke->closed < stroke->count; k++) {
      struct side side = {round_point(p[k], unit),
                          round_point(p[(k + 1) % stroke->count], unit),
                          stroke->layer > 0};
      if (side.a.x != side.b.x || side.a.y != side.b.y)
        assert_true(ARRAY_PUSH(&sides->side, side));
    }
  }
}

static double length_of(const struct side *s) {
  return hypot((double)(s->b.x - s->a.x), (double)(s->b.y - s->a.y));
}

static double along(const struct side *s, struct unit_point p) {
  return (double)((p.x - s->a.x) * (s->b.x - s->a.x) +
                  (p.y - s->a.y) * (s->b.y - s->a.y)) /
         length_of(s);
}

static bool is_on_line(const struct side *s, struct unit_point p) {
  return (s->b.x - s->a.x) * (p.y - s->a.y) ==
         (s->b.y - s->a.y) * (p.x - s->a.x);
}

/* How many units two sides share, as numbers in the file. */
static double shared(const struct side *s, const struct side *t) {
  if (!is_on_line(s, t->a) || !is_on_line(s, t->b))
    return 0;
  double p = along(s, t->a), q = along(s, t->b);
  return fmin(length_of(s), fmax(p, q)) - fmax(0, fmin(p, q));
}

/* The most units that two sides of the rounded drawing share. */
static double most_shared(const struct drawing *drawing, double unit) {
  struct sides sides;
  double most = 0;
  round_drawing(&sides, drawing, unit);
  for (size_t i = 0; i < sides.side.count; i++)
    for (size_t k = 0; k < i; k++)
      most = fmax(most, shared(&sides.side.item[i], &sides.side.item[k]));
  ARRAY_FREE(&sides.side);
  return most;
}

/* ---- By hand ------------------------------------------------------------- */

static void lines_within_a_unit_are_one(void **state) {
  (void)state;
  struct random random = {41};
  for (int round = 0; round < 300; round++) {
    struct ink_fixture k;
    int32_t end[4];
    for (int i = 0; i < 4; i++)
      end[i] = random_int(&random, -BIG, BIG);
    start(&k);
    for (int i = 0; i < 2; i++) {
      int o[4];
      for (int c = 0; c < 4; c++)
        o[c] = i * random_int(&random, -UNIT, UNIT);
      ink_fixture_line_at(&k, end[0] + o[0], end[1] + o[1], end[2] + o[2],
                          end[3] + o[3], CREASE);
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].count, 2);
    ink_fixture_end(&k);
  }
}

static void a_slit_wider_than_a_unit_stays_two_lines(void **state) {
  (void)state;
  const int widths[] = {UNIT + 1, 2 * UNIT, 5 * UNIT};
  for (int i = 0; i < 3; i++)
    for (int upright = 0; upright < 2; upright++) {
      struct ink_fixture k;
      int w = widths[i];
      start(&k);
      ink_fixture_line_at(&k, -BIG, -BIG, upright ? -BIG : BIG,
                          upright ? BIG : -BIG, CREASE);
      ink_fixture_line_at(&k, upright ? w - BIG : -BIG,
                          upright ? -BIG : w - BIG, upright ? w - BIG : BIG,
                          upright ? BIG : w - BIG, CREASE);
      ink_fixture_draw(&k);
      assert_int_equal(k.drawing.stroke.count, 2);
      ink_fixture_end(&k);
    }
}

/* A slit a few units long: straightened by as much as a unit, both ways round
 * it would be its diagonal. */
static void a_short_slit_does_not_close(void **state) {
  (void)state;
  const int x = 1045 * UNIT / 1000, y = 443 * UNIT / 100,
            slant = 35 * UNIT / 100;
  const int p[5][2] = {{0, 0}, {0, y}, {x, y + slant}, {x, slant}, {0, 0}};
  struct ink_fixture k;
  start(&k);
  for (int twice = 0; twice < 2; twice++)
    for (int i = 0; i < 4; i++) {
      int off = twice * UNIT / 10;
      ink_fixture_line_at(&k, p[i][0] + off, p[i][1] + off, p[i + 1][0] + off,
                          p[i + 1][1] + off, CREASE);
    }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].count, 4);
  assert_true(k.drawing.stroke.item[0].closed);
  assert_true(most_shared(&k.drawing, UNIT_MM) == 0);
  ink_fixture_end(&k);
}

static void without_a_unit_all_lines_stay(void **state) {
  (void)state;
  struct ink_fixture k;
  ink_fixture_start(&k);
  ink_fixture_line_at(&k, -BIG, 0, BIG, 0, CREASE);
  ink_fixture_line_at(&k, -BIG, 100, BIG, 100, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_end(&k);
}

static void nothing_moves_where_nothing_repeats(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  /* Three lines that meet, their ends within a unit, and a curve of sides
   * shorter than one. */
  ink_fixture_line_at(&k, -BIG, 0, 0, 0, CREASE);
  ink_fixture_line_at(&k, 300, 200, BIG, BIG, CREASE);
  ink_fixture_line_at(&k, 0, -300, 0, -BIG, CREASE);
  uint32_t last = ink_fixture_point_at(&k, -BIG, BIG);
  for (int i = 1; i <= 12; i++) {
    uint32_t here = ink_fixture_point_at(&k, -BIG + i * 500, BIG + i * i * 50);
    ink_fixture_edge(&k, last, here, CREASE);
    last = here;
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 4);
  assert_int_equal(k.drawing.point.count, 6 + 13);
  ink_fixture_end(&k);
}

static void hidden_lines_near_visible_ones_go(void **state) {
  (void)state;
  for (int dashed = 0; dashed < 2; dashed++) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.hidden = dashed ? RECTO_HIDDEN_DASHED : RECTO_HIDDEN_LAYER;
    ink_fixture_hide(&k, ink_fixture_line_at(&k, -BIG, 400, BIG, -300, BORDER));
    ink_fixture_line_at(&k, -BIG, 0, BIG, 0, CREASE);
    ink_fixture_hide(
        &k, ink_fixture_line_at(&k, -BIG / 2, -500, BIG / 2, 500, BORDER));
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.layer.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].edge_class, CREASE);
    ink_fixture_end(&k);
  }
}

static void a_divided_edge_near_a_whole_one_is_two_points(void **state) {
  (void)state;
  struct random random = {43};
  for (int round = 0; round < 300; round++) {
    struct ink_fixture k;
    int32_t x = random_int(&random, 1, BIG), y = random_int(&random, -BIG, BIG);
    int pieces = random_int(&random, 2, 9), whole_first = round % 2;
    int off = random_int(&random, -UNIT / 2, UNIT / 2);
    start(&k);
    if (whole_first)
      ink_fixture_line_at(&k, -x, -y, x, y, CREASE);
    uint32_t last = ink_fixture_point_at(&k, -x + off, -y);
    for (int i = 1; i <= pieces; i++) {
      double t = 2.0 * i / pieces - 1;
      uint32_t here = ink_fixture_point_at(&k, (int32_t)lrint(t * x) + off,
                                           (int32_t)lrint(t * y));
      ink_fixture_edge(&k, last, here, CREASE);
      last = here;
    }
    if (!whole_first)
      ink_fixture_line_at(&k, -x, -y, x, y, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_int_equal(k.drawing.stroke.item[0].count, 2);
    ink_fixture_end(&k);
  }
}

static void what_is_beyond_a_near_line_goes_on_from_it(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  ink_fixture_line_at(&k, -BIG, 0, BIG / 2, 0, CREASE);
  ink_fixture_line_at(&k, -BIG / 2, 600, BIG, 600, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].count, 2);
  assert_true(fabs(ink_fixture_stroke_length(&k, 0) - 2 * BIG / 1048576.0) <
              UNIT_MM);
  ink_fixture_end(&k);
}

static void outlines_near_each_other_are_one_closed_one(void **state) {
  (void)state;
  struct random random = {47};
  for (int round = 0; round < 100; round++) {
    enum { COPIES = 3 };
    struct ink_fixture k;
    start(&k);
    for (int copy = 0; copy < COPIES; copy++) {
      uint32_t p[4];
      int dx = random_int(&random, -UNIT / 2, UNIT / 2);
      int dy = random_int(&random, -UNIT / 2, UNIT / 2);
      for (int i = 0; i < 4; i++)
        p[i] = ink_fixture_point_at(&k, (i == 1 || i == 2 ? BIG : -BIG) + dx,
                                    (i > 1 ? BIG : -BIG) + dy);
      for (int i = 0; i < 4; i++)
        ink_fixture_edge(&k, p[i], p[(i + 1) % 4], CREASE);
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_true(k.drawing.stroke.item[0].closed);
    assert_int_equal(k.drawing.stroke.item[0].count, 4);
    ink_fixture_end(&k);
  }
}

static void with_ids_the_higher_priority_stays(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  k.options.ink.ids = true;
  ink_fixture_line_at(&k, -BIG, 0, BIG, 0, CREASE);
  ink_fixture_line_at(&k, -BIG, 500, BIG, 500, BORDER);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].edge_class, BORDER);
  assert_int_equal(k.drawing.stroke.item[0].edge, 1);
  ink_fixture_end(&k);
}

/* ---- Many ---------------------------------------------------------------- */

/* Lines between few places, each a little beside its place. */
static void add_hay(struct ink_fixture *k, struct random *random, int count) {
  for (int i = 0; i < count; i++) {
    int at[4];
    for (int c = 0; c < 4; c++)
      at[c] = random_int(random, -3, 3) * (BIG / 60) +
              random_int(random, -UNIT / 3, UNIT / 3);
    uint32_t edge = ink_fixture_line_at(k, at[0], at[1], at[2], at[3],
                                        1u << random_int(random, 0, 6));
    if (random_below(random, 4) == 0)
      ink_fixture_hide(k, edge);
  }
}

/* The graph of the drawing's lines, with its nodes in rows. */
static struct segment_graph collect_lines(struct ink_fixture *k,
                                          struct node_rows *rows) {
  struct segment_graph graph;
  struct pens pens;
  segment_graph_init(&graph);
  k->map.edge_state = k->state.item;
  k->map.edge_count = k->state.count;
  assert_int_equal(pens_init(&pens, &k->scene, &k->options, NULL), RECTO_OK);
  assert_int_equal(segment_graph_collect(&graph, &k->sheet, &k->map, &pens,
                                         &k->options, NULL),
                   RECTO_OK);
  k->map.edge_state = NULL;
  pens_fini(&pens);
  assert_int_equal(segment_graph_unite(&graph, rows, NULL), RECTO_OK);
  return graph;
}

/* The same without overlaps.
 * apart  isolated segments are set apart meanwhile */
static struct segment_graph make_graph(struct ink_fixture *k, bool apart) {
  struct node_rows rows = {0};
  struct segment_graph graph = collect_lines(k, &rows);
  if (apart)
    assert_int_equal(segment_graph_separate_isolated(&graph, &rows, UNIT, NULL),
                     RECTO_OK);
  else
    graph.near_segment =
        mem_calloc(graph.node.count, sizeof *graph.near_segment);
  assert_int_equal(segment_graph_drop_collinear(&graph, &rows, NULL), RECTO_OK);
  assert_int_equal(
      segment_graph_drop_output_overlaps(&graph, &rows, UNIT, NULL), RECTO_OK);
  assert_true(apart || graph.isolated.count == 0);
  assert_int_equal(segment_graph_merge_isolated(&graph, NULL), RECTO_OK);
  node_rows_fini(&rows);
  return graph;
}

/* A new line from one end of the first of three to one of the last passes an
 * end of the second; each is looked through once. */
static void isolated_segments_are_taken_when_a_line_comes_near(void **state) {
  (void)state;
  struct ink_fixture k;
  struct node_rows rows = {0};
  start(&k);
  for (int i = -1; i <= 1; i++)
    ink_fixture_line_at(&k, 0, i * BIG / 2, BIG, i * BIG / 2, CREASE);
  struct segment_graph graph = collect_lines(&k, &rows);
  assert_int_equal(segment_graph_separate_isolated(&graph, &rows, UNIT, NULL),
                   RECTO_OK);
  assert_int_equal(graph.isolated.count, 3);
  assert_true(segment_graph_take_isolated(&graph, &graph.segment));
  assert_int_equal(graph.segment.count, 0);
  struct graph_segment added = graph.isolated.item[0],
                       second = graph.isolated.item[1];
  added.node[1] = graph.isolated.item[2].node[0];
  assert_true(ARRAY_PUSH(&graph.segment, added));
  assert_true(segment_graph_mark_near_nodes(&graph, &rows, UNIT, 0));
  for (int time = 0; time < 2; time++) {
    assert_true(segment_graph_take_isolated(&graph, &graph.segment));
    assert_int_equal(graph.segment.count, 2);
    assert_int_equal(graph.isolated.count, 2);
    assert_memory_equal(&graph.segment.item[1], &second, sizeof second);
  }
  node_rows_fini(&rows);
  segment_graph_fini(&graph);
  ink_fixture_end(&k);
}

/* Whatever the share of those that overlap others: what is left is the same. */
static void isolated_segments_overlap_nothing(void **state) {
  (void)state;
  struct random random = {61};
  for (int round = 0; round < 300; round++) {
    struct ink_fixture k;
    int side = round % 2 ? BIG / 400 : 30 * UNIT;
    start(&k);
    add_hay(&k, &random, 10);
    for (int i = 0; i < 120; i++) {
      int at[4];
      for (int c = 0; c < 4; c++)
        at[c] = random_int(&random, -side, side);
      ink_fixture_line_at(&k, at[0], at[1], at[2], at[3], CREASE);
    }
    struct segment_graph one = make_graph(&k, false),
                         two = make_graph(&k, true);
    assert_int_equal(one.segment.count, two.segment.count);
    assert_int_equal(one.doubled, two.doubled);
    assert_memory_equal(one.segment.item, two.segment.item,
                        one.segment.count * sizeof *one.segment.item);
    assert_memory_equal(one.approximate, two.approximate, one.node.count);
    segment_graph_fini(&one);
    segment_graph_fini(&two);
    ink_fixture_end(&k);
  }
}

static void
no_two_sides_of_random_drawings_share_more_than_a_unit(void **state) {
  (void)state;
  struct random random = {53};
  for (int round = 0; round < 200; round++) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.hidden = round % 2 ? RECTO_HIDDEN_LAYER : RECTO_HIDDEN_NONE;
    add_hay(&k, &random, 60);
    ink_fixture_draw(&k);
    double most = most_shared(&k.drawing, UNIT_MM);
    if (most > 1.5)
      fail_msg("round %d: %g units", round, most);
    ink_fixture_end(&k);
  }
}

/* Every requested line is near something drawn. */
static void no_ink_is_lost_by_more_than_two_units(void **state) {
  (void)state;
  struct random random = {59};
  for (int round = 0; round < 100; round++) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.hidden = RECTO_HIDDEN_LAYER;
    add_hay(&k, &random, 60);
    ink_fixture_draw(&k);
    for (size_t i = 0; i < k.sheet.edge.count; i++) {
      const struct geom_point *p =
          &k.sheet.point.item[k.sheet.edge.item[i].point[0]];
      const struct geom_point *q =
          &k.sheet.point.item[k.sheet.edge.item[i].point[1]];
      for (int s = 0; s <= 20; s++) {
        double t = s / 20.0;
        double x = 50 + (p->x + t * ((double)q->x - p->x)) / 1048576;
        double y = 50 + (p->y + t * ((double)q->y - p->y)) / 1048576;
        double far = ink_fixture_distance(&k, x, y);
        if (far > 2.9 * UNIT_MM) /* the diagonal of two units */
          fail_msg("round %d: %g units off", round, far / UNIT_MM);
      }
    }
    ink_fixture_end(&k);
  }
}

static void thousands_of_near_rings_take_bounded_time(void **state) {
  enum { SIDES = 32, RINGS = 3000 };
  (void)state;
  int rings = is_under_valgrind() ? 50 : RINGS;
  struct ink_fixture k;
  start(&k);
  for (int ring = 0; ring < rings; ring++) {
    uint32_t first = (uint32_t)k.sheet.point.count;
    double radius = BIG - ring * (UNIT / 2.0) / rings;
    for (int i = 0; i < SIDES; i++)
      ink_fixture_point_at(&k, (int32_t)lrint(radius * cos(i * acos(-1) / 16)),
                           (int32_t)lrint(radius * sin(i * acos(-1) / 16)));
    for (uint32_t i = 0; i < SIDES; i++)
      ink_fixture_edge(&k, first + i, first + (i + 1) % SIDES, CREASE);
  }
  double before = clock_cpu();
  ink_fixture_draw(&k);
  assert_true(rings < RINGS || clock_cpu() - before < 3);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_true(k.drawing.stroke.item[0].closed);
  assert_int_equal(k.drawing.stroke.item[0].count, SIDES);
  ink_fixture_end(&k);
}

/* ---- Scenes, turned by a little ------------------------------------------ */

static double drawn_length(const char *name, double turn_deg, double unit) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  pipeline_fill(&scene, &options, scenes_find(name));
  options.camera.kind = RECTO_CAMERA_DIRECTION;
  options.camera.azimuth_deg = options.camera.elevation_deg = turn_deg;
  options.camera.fov_deg = 0;
  options.output.unit_mm = unit;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  pipeline_run(&pipeline, &scene, &options, &solver_newell);
  assert_int_equal(pipeline.status, RECTO_OK);
  double most = most_shared(&pipeline.drawing, unit);
  if (most > 1.5)
    fail_msg("%s turned by %g: %g units twice", name, turn_deg, most);
  double length = drawing_length_mm(&pipeline.drawing);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
  return length;
}

static void assert_steady(const char *name, double unit, double largest) {
  double straight = drawn_length(name, 0, unit);
  for (int i = 0; i <= 50; i++) {
    double turn = pow(10, -12 + i / 5.0);
    double length = drawn_length(name, turn, unit);
    if (turn <= largest && fabs(length - straight) > 400 * unit)
      fail_msg("%s turned by %g: %.6f mm, not %.6f", name, turn, length,
               straight);
  }
}

static const char *const turned[] = {"cube", "touching boxes", "doubled mesh",
                                     "box on table", "cube stack"};

static void no_line_is_twice_in_svg(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof turned / sizeof *turned; i++)
    assert_steady(turned[i], 1e-3, 1e-5);
}

static void no_line_is_twice_in_hpgl(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof turned / sizeof *turned; i++)
    assert_steady(turned[i], 0.025, 1e-4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_within_a_unit_are_one),
      cmocka_unit_test(a_slit_wider_than_a_unit_stays_two_lines),
      cmocka_unit_test(a_short_slit_does_not_close),
      cmocka_unit_test(without_a_unit_all_lines_stay),
      cmocka_unit_test(nothing_moves_where_nothing_repeats),
      cmocka_unit_test(hidden_lines_near_visible_ones_go),
      cmocka_unit_test(a_divided_edge_near_a_whole_one_is_two_points),
      cmocka_unit_test(what_is_beyond_a_near_line_goes_on_from_it),
      cmocka_unit_test(outlines_near_each_other_are_one_closed_one),
      cmocka_unit_test(with_ids_the_higher_priority_stays),
      cmocka_unit_test(isolated_segments_are_taken_when_a_line_comes_near),
      cmocka_unit_test(isolated_segments_overlap_nothing),
      cmocka_unit_test(no_two_sides_of_random_drawings_share_more_than_a_unit),
      cmocka_unit_test(no_ink_is_lost_by_more_than_two_units),
      cmocka_unit_test(thousands_of_near_rings_take_bounded_time),
      cmocka_unit_test(no_line_is_twice_in_svg),
      cmocka_unit_test(no_line_is_twice_in_hpgl),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
