/* test_speckles.c - short creases that lead nowhere are not drawn, and nothing
 * else is left out with them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <time.h>

#include <cmocka.h>

#include "tests/ink_fixture.h"

enum {
  SILHOUETTE = RECTO_EDGE_SILHOUETTE,
  BORDER = RECTO_EDGE_BORDER,
  CREASE = RECTO_EDGE_CREASE,
  GROUP = RECTO_EDGE_GROUP,
  INTERSECTION = RECTO_EDGE_INTERSECTION,
  WIRE = RECTO_EDGE_WIRE,
  SMOOTH = RECTO_EDGE_SMOOTH
};

static void start(struct ink_fixture *k) {
  ink_fixture_start(k);
  k->options.ink.min_stroke_mm = -1;
}

/* How many strokes a drawing of one line has. */
static size_t draw_line(double length, double min_stroke_mm, unsigned of,
                        bool exact) {
  struct ink_fixture k;
  start(&k);
  k.options.ink.min_stroke_mm = min_stroke_mm;
  k.options.ink.exact = exact;
  ink_fixture_line(&k, 10, 10, 10 + length, 10, of);
  ink_fixture_draw(&k);
  size_t strokes = k.drawing.stroke.count;
  assert_int_equal(k.drawing.counts.too_short, 1 - strokes);
  assert_int_equal(k.drawing.dropped.count, 1 - strokes);
  ink_fixture_end(&k);
  return strokes;
}

static void creases_shorter_than_ten_pens_are_dropped(void **state) {
  (void)state;
  assert_int_equal(draw_line(2.9, -1, CREASE, false), 0);
  assert_int_equal(draw_line(3.1, -1, CREASE, false), 1);
  assert_int_equal(draw_line(1.9, 2, CREASE, false), 0);
  assert_int_equal(draw_line(2.1, 2, CREASE, false), 1);
  assert_int_equal(draw_line(0.001, 0, CREASE, false), 1);
  assert_int_equal(draw_line(2.9, -1, GROUP, false), 0);
}

static void exact_drawings_drop_none(void **state) {
  (void)state;
  assert_int_equal(draw_line(0.2, -1, CREASE, true), 1);
  assert_int_equal(draw_line(0.1, -1, CREASE, true), 0);
  assert_int_equal(draw_line(2.9, 20, CREASE, true), 1);
}

/* Whatever the least length, of other lines only dots are dropped; silhouettes
 * are the subject of test_short_spurs.c. */
static void other_lines_are_drawn(void **state) {
  static const unsigned other[] = {BORDER, INTERSECTION, WIRE, SMOOTH};
  (void)state;
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
    assert_int_equal(draw_line(0.16, -1, other[i], false), 1);
    assert_int_equal(draw_line(0.16, 20, other[i], false), 1);
    assert_int_equal(draw_line(0.14, 20, other[i], false), 0);
    assert_int_equal(draw_line(0.14, 0.1, other[i], false), 1);
  }
}

/* A line from a to b of 2 mm, and at each of them, or not, a long one. */
static size_t draw_between(unsigned ends, unsigned of) {
  struct ink_fixture k;
  start(&k);
  uint32_t end[2] = {ink_fixture_point(&k, 50, 50),
                     ink_fixture_point(&k, 52, 50)};
  ink_fixture_edge(&k, end[0], end[1], CREASE);
  size_t longer = 0;
  for (int i = 0; i < 2; i++)
    for (int up = 0; up < 2 && (ends >> i & 1); up++) {
      uint32_t far = ink_fixture_point(&k, 50 + 2 * i, up ? 90 : 10);
      ink_fixture_edge(&k, far, end[i], of);
      longer = longer + 1;
    }
  ink_fixture_draw(&k);
  size_t dropped = k.drawing.dropped.count;
  double length = 0;
  for (size_t s = 0; s < k.drawing.stroke.count; s++)
    length += ink_fixture_stroke_length(&k, s);
  assert_true(fabs(length - 40.0 * (double)longer - (dropped ? 0 : 2)) < 1e-5);
  ink_fixture_end(&k);
  return dropped;
}

static void a_spur_is_dropped_and_a_bridge_is_not(void **state) {
  (void)state;
  static const unsigned of[] = {CREASE, SILHOUETTE, BORDER, WIRE};
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    assert_int_equal(draw_between(0, of[i]), 1);
    assert_int_equal(draw_between(1, of[i]), 1);
    assert_int_equal(draw_between(2, of[i]), 1);
    assert_int_equal(draw_between(3, of[i]), 0);
  }
}

/* Three lines of some length between three points, and at two of these lines of
 * 30 mm, the far ends of which are joined or free.  Returns how many of its
 * lines are dropped. */
static size_t draw_triangle(double side, bool joined, bool exact) {
  struct ink_fixture k;
  start(&k);
  k.options.ink.exact = exact;
  const uint32_t at[3] = {
      ink_fixture_point(&k, 50, 50), ink_fixture_point(&k, 50 + side, 50),
      ink_fixture_point(&k, 50 + side / 2, 50 + side * sqrt(0.75))};
  const uint32_t far[2] = {ink_fixture_point(&k, 50, 20),
                           ink_fixture_point(&k, 50 + side, 20)};
  for (int i = 0; i < 3; i++)
    ink_fixture_edge(&k, at[i], at[(i + 1) % 3], CREASE);
  for (int i = 0; i < 2; i++)
    ink_fixture_edge(&k, at[i], far[i], CREASE);
  if (joined)
    ink_fixture_edge(&k, far[0], far[1], CREASE);
  ink_fixture_draw(&k);
  size_t dropped = k.drawing.dropped.count;
  ink_fixture_end(&k);
  return dropped;
}

static void of_a_short_cycle_a_line_remains(void **state) {
  (void)state;
  assert_int_equal(draw_triangle(2.9, false, false), 1);
  assert_int_equal(draw_triangle(3.1, false, false), 0);
  assert_int_equal(draw_triangle(2.9, true, false), 0);
  assert_int_equal(draw_triangle(2.9, false, true), 0);
}

static void a_small_closed_line_is_drawn(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  uint32_t p = ink_fixture_point(&k, 50, 50);
  uint32_t q = ink_fixture_point(&k, 50.3, 50);
  uint32_t r = ink_fixture_point(&k, 50, 50.3);
  ink_fixture_edge(&k, p, q, CREASE);
  ink_fixture_edge(&k, q, r, CREASE);
  ink_fixture_edge(&k, r, p, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_true(k.drawing.stroke.item[0].closed);
  ink_fixture_end(&k);
}

/* The length of a line is that of all its edges. */
static void a_long_line_of_short_edges_is_drawn(void **state) {
  (void)state;
  for (int edges = 20; edges <= 40; edges += 20) {
    struct ink_fixture k;
    start(&k);
    uint32_t p = ink_fixture_point(&k, 10, 10);
    for (int i = 1; i <= edges; i++) {
      uint32_t q = ink_fixture_point(&k, 10 + 0.1 * i, 10 + i % 2 * 0.01);
      ink_fixture_edge(&k, p, q, CREASE);
      p = q;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, edges == 40);
    ink_fixture_end(&k);
  }
}

/* What is seen of a line that is partly hidden ends where it is hidden, not
 * free; nor where a hidden edge continues it, nor at a point that clipping
 * made. */
static void a_line_that_goes_on_in_the_model_is_drawn(void **state) {
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    struct ink_fixture k;
    start(&k);
    uint32_t p = ink_fixture_point(&k, 20, 50);
    uint32_t q = ink_fixture_point(&k, 22, 50);
    uint32_t r = ink_fixture_point(&k, 30, 50);
    uint32_t o = ink_fixture_point(&k, 10, 50);
    if (kind == 0) {
      ink_fixture_show(&k, ink_fixture_edge(&k, o, r, CREASE), 1, 2, 10);
    } else if (kind == 1) {
      ink_fixture_edge(&k, p, q, CREASE);
      ink_fixture_hide(&k, ink_fixture_edge(&k, q, r, CREASE));
      ink_fixture_hide(&k, ink_fixture_edge(&k, o, p, CREASE));
    } else {
      ink_fixture_edge(&k, p, q, CREASE);
      k.sheet.vertex_count = kind == 2 ? p : r;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, kind < 3);
    ink_fixture_end(&k);
  }
}

/* One end hidden, the other one free: a speckle. */
static void a_free_end_of_a_half_hidden_line_counts(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  ink_fixture_show(&k, ink_fixture_line(&k, 10, 10, 20, 10, CREASE), 0, 2, 10);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

/* With ids a stroke is a piece of one edge; the line decides all the same. */
static void with_ids_the_line_decides(void **state) {
  (void)state;
  for (int edges = 1; edges <= 4; edges += 3) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.ids = true;
    uint32_t p = ink_fixture_point(&k, 10, 10);
    for (int i = 1; i <= edges; i++) {
      uint32_t q = ink_fixture_point(&k, 10 + i, 10 + i % 2 * 0.3);
      ink_fixture_edge(&k, p, q, CREASE);
      p = q;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, edges == 1 ? 0 : 4);
    ink_fixture_end(&k);
  }
}

/* ---- Gaps ---------------------------------------------------------------- */

/* How many strokes are drawn of a line of 20 mm that ends in the middle of the
 * page, and one of another class from there on, shifted by dx and dy, in a
 * direction. */
static size_t draw_gap(double dx, double dy, double angle_deg,
                       const unsigned of[2], bool exact, bool ids) {
  struct ink_fixture k;
  double angle = angle_deg / 180 * acos(-1), x = 50 + dx, y = 50 + dy;
  start(&k);
  k.options.ink.exact = exact;
  k.options.ink.ids = ids;
  ink_fixture_line(&k, 30, 50, 50, 50, of[0]);
  ink_fixture_line(&k, x + 20 * cos(angle), y + 20 * sin(angle), x, y, of[1]);
  ink_fixture_draw(&k);
  size_t strokes = k.drawing.stroke.count;
  assert_int_equal(k.drawing.gap_end.count, strokes == 1 || ids ? 2 : 0);
  if (ids) /* the side that closes the gap is of one of the two sources */
    assert_true(fabs(ink_fixture_stroke_length(&k, 0) +
                     ink_fixture_stroke_length(&k, 1) - 40 - hypot(dx, dy)) <
                1e-5);
  if (strokes == 1)
    assert_true(fabs(ink_fixture_stroke_length(&k, 0) - 40 - hypot(dx, dy)) <
                1e-5);
  ink_fixture_end(&k);
  return strokes;
}

static void gaps_below_half_a_pen_are_closed(void **state) {
  static const unsigned classes[][2] = {{CREASE, CREASE},
                                        {SILHOUETTE, SILHOUETTE}};
  (void)state;
  for (size_t i = 0; i < 2; i++) {
    assert_int_equal(draw_gap(0.14, 0, 0, classes[i], false, false), 1);
    assert_int_equal(draw_gap(0.16, 0, 0, classes[i], false, false), 2);
    assert_int_equal(draw_gap(0.1, 0.1, 30, classes[i], false, false), 1);
    assert_int_equal(draw_gap(0.1, 0.12, 30, classes[i], false, false), 2);
    assert_int_equal(draw_gap(0.14, 0, 0, classes[i], true, false), 2);
    assert_int_equal(draw_gap(0.14, 0, 0, classes[i], false, true), 2);
  }
}

static void only_lines_that_go_on_are_joined(void **state) {
  static const unsigned crease[2] = {CREASE, CREASE};
  static const unsigned others[][2] = {
      {CREASE, SILHOUETTE}, {CREASE, GROUP}, {WIRE, WIRE}, {SMOOTH, SMOOTH}};
  (void)state;
  assert_int_equal(draw_gap(0, 0.1, 80, crease, false, false), 1);
  assert_int_equal(draw_gap(0, 0.1, 100, crease, false, false), 2);
  assert_int_equal(draw_gap(0, 0.1, 180, crease, false, false), 2);
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    assert_int_equal(draw_gap(0.1, 0, 0, others[i], false, false), 2);
}

/* What closes a gap shorter than a step is no line drawn twice. */
static void gaps_are_closed_for_all_outputs(void **state) {
  const double unit_mm[] = {0, 0.001, 0.025, 0.1}, gap[] = {0.01, 0.14};
  (void)state;
  for (size_t i = 0; i < 4; i++)
    for (size_t g = 0; g < 2; g++) {
      struct ink_fixture k;
      start(&k);
      k.options.output.unit_mm = unit_mm[i];
      ink_fixture_line(&k, 30, 50, 50, 50, CREASE);
      ink_fixture_line(&k, 50 + gap[g], 50, 70, 55, CREASE);
      ink_fixture_draw(&k);
      assert_int_equal(k.drawing.stroke.count, 1);
      assert_int_equal(k.drawing.counts.drawn_twice, 0);
      ink_fixture_end(&k);
    }
}

/* Of three ends the two nearest ones are joined. */
static void a_gap_is_closed_once(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  ink_fixture_line(&k, 20, 50, 50, 50, CREASE);
  ink_fixture_line(&k, 50.08, 50, 80, 60, CREASE);
  ink_fixture_line(&k, 50.1, 50, 80, 40, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.gap_end.count, 0); /* these two turn back */
  ink_fixture_line(&k, 50, 50.02, 20, 60, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.gap_end.count, 0);
  ink_fixture_line(&k, 20, 20, 50, 20, CREASE);
  ink_fixture_line(&k, 50.08, 20, 80, 20, CREASE);
  ink_fixture_line(&k, 50.1, 20.1, 80, 30, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.gap_end.count, 2);
  assert_int_equal(k.drawing.stroke.count, 6);
  ink_fixture_end(&k);
}

/* ---- Zigzags ------------------------------------------------------------- */

/* A scene of two faces that meet at an angle, of which all creases are. */
static void start_fold(struct ink_fixture *k, double fold_deg) {
  const double fold = fold_deg * acos(-1) / 180;
  const struct scene_point corner[4] = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -cos(fold), -sin(fold)}};
  static const uint32_t face[2][3] = {{0, 1, 2}, {1, 0, 3}};
  start(k);
  for (int i = 0; i < 4; i++)
    assert_true(ARRAY_PUSH(&k->scene.point, corner[i]));
  for (int i = 0; i < 2; i++)
    assert_int_equal(scene_add_face(&k->scene, face[i], 3, 1, NULL, NULL),
                     RECTO_OK);
  k->sheet.scene = &k->scene;
  k->sheet.triangles_dropped = true;
  k->sheet.camera.s = k->sheet.camera.d_max = 1;
  k->sheet.camera.middle_mm[0] = k->sheet.camera.middle_mm[1] = 50;
}

static void add_fold(struct ink_fixture *k, uint32_t p, uint32_t q) {
  uint32_t e = ink_fixture_edge(k, p, q, CREASE);
  k->sheet.edge.item[e].triangle[0] = 0;
  k->sheet.edge.item[e].triangle[1] = 1;
}

/* Draws it, and returns how many strokes there are; the rest is dropped. */
static size_t draw_folds(struct ink_fixture *k) {
  ink_fixture_draw(k);
  size_t strokes = k->drawing.stroke.count;
  assert_true((k->drawing.dropped.count == 0) == (strokes > 0));
  ink_fixture_end(k);
  return strokes;
}

/* Whether a crease of forty edges of four millimetres is drawn that begins and
 * ends free: it turns at each point by one angle, and its faces meet at another
 * one. */
static bool is_zigzag_drawn(double turn_deg, double fold_deg) {
  enum { POINTS = 41 };
  const double degree = acos(-1) / 180;
  struct ink_fixture k;
  uint32_t last = 0;
  start_fold(&k, fold_deg);
  for (int i = 0; i < POINTS; i++) {
    uint32_t p = ink_fixture_point(&k, 5 + 4 * i * cos(turn_deg * degree / 2),
                                   50 + i % 2 * 4 * sin(turn_deg * degree / 2));
    if (i > 0)
      add_fold(&k, last, p);
    last = p;
  }
  return draw_folds(&k) == 1;
}

/* Decision 0056: 45 degrees are asked of a line, and 60 of one that turns back,
 * which is by more than 120. */
static void zigzags_must_be_sharper_than_other_lines(void **state) {
  (void)state;
  assert_false(is_zigzag_drawn(0, 40));
  assert_true(is_zigzag_drawn(0, 50));
  assert_false(is_zigzag_drawn(110, 40));
  assert_true(is_zigzag_drawn(110, 65));
  assert_false(is_zigzag_drawn(130, 50));
  assert_true(is_zigzag_drawn(130, 65));
}

/* ---- Lines that are noise by their shape: decision 0079 ------------------ */

/* A line whose pieces have so many edges of a length, between turns by 90
 * degrees. */
static size_t draw_steps(int pieces, int edges, double length,
                         double fold_deg) {
  struct ink_fixture k;
  double at[2] = {10, 10};
  start_fold(&k, fold_deg);
  uint32_t last = ink_fixture_point(&k, at[0], at[1]);
  for (int i = 0; i < pieces * edges; i++) {
    at[i / edges % 2] += length;
    uint32_t p = ink_fixture_point(&k, at[0], at[1]);
    add_fold(&k, last, p);
    last = p;
  }
  return draw_folds(&k);
}

/* Pieces are short below ten pens.  A line is noise where most of it is in such
 * pieces and it bends by at most 60 degrees in the mean. */
static void lines_of_short_pieces_are_not_drawn(void **state) {
  (void)state;
  assert_int_equal(draw_steps(20, 4, 0.7, 55), 0);
  assert_int_equal(draw_steps(20, 4, 0.8, 55), 1);
  assert_int_equal(draw_steps(20, 4, 0.7, 65), 1);
  assert_int_equal(draw_steps(33, 4, 0.7, 55), 1); /* of few ends */
  assert_int_equal(draw_steps(32, 4, 0.7, 55), 0);
}

/* Nowhere above 60 degrees: 30 pens at least, and two edges a piece from four
 * pieces on. */
/* Sharp as they are, of a line below thirty pens that ends free. */
static void short_saws_are_not_drawn(void **state) {
  (void)state;
  assert_int_equal(draw_steps(4, 1, 1.5, 65), 0);
  assert_int_equal(draw_steps(3, 3, 0.8, 65), 0);
  assert_int_equal(draw_steps(4, 1, 2.2, 65), 0);
  assert_int_equal(draw_steps(4, 1, 2.3, 65), 1); /* 9.2 mm */
  assert_int_equal(draw_steps(2, 1, 2, 65), 1);   /* it turns once */
  assert_int_equal(draw_steps(2, 1, 4, 65), 1);
}

static void shallow_lines_are_long_and_smooth(void **state) {
  (void)state;
  assert_int_equal(draw_steps(1, 4, 2.2, 55), 0);
  assert_int_equal(draw_steps(1, 4, 2.3, 55), 1);
  assert_int_equal(draw_steps(1, 4, 2.2, 65), 1);
  assert_int_equal(draw_steps(4, 1, 6, 55), 0);
  assert_int_equal(draw_steps(4, 1, 6, 65), 1);
  assert_int_equal(draw_steps(3, 1, 6, 55), 1);
  assert_int_equal(draw_steps(1, 1, 20, 55), 1);
  assert_int_equal(draw_steps(4, 2, 6, 55), 1);
}

/* A closed line of so many edges. */
static size_t draw_ring(int sides, double radius, double fold_deg, bool exact) {
  struct ink_fixture k;
  uint32_t p[12];
  start_fold(&k, fold_deg);
  k.options.ink.exact = exact;
  for (int i = 0; i < sides; i++) {
    double angle = 2 * acos(-1) * i / sides;
    p[i] = ink_fixture_point(&k, 50 + radius * cos(angle),
                             50 + radius * sin(angle));
  }
  for (int i = 0; i < sides; i++)
    add_fold(&k, p[i], p[(i + 1) % sides]);
  return draw_folds(&k);
}

/* Rings are what solids have, however small and shallow; one about a single
 * triangle is not. */
static void closed_lines_stay(void **state) {
  (void)state;
  for (int sides = 4; sides <= 12; sides++)
    assert_int_equal(draw_ring(sides, 0.5, 35, false), 1);
  assert_int_equal(draw_ring(3, 0.5, 55, false), 0);
  assert_int_equal(draw_ring(3, 0.5, 65, false), 1);
  assert_int_equal(draw_ring(3, 0.5, 55, true), 1);
}

/* ---- Hairs --------------------------------------------------------------- */

/* Whether a line of `length` mm is drawn beside a long one of two sides, from
 * 10, 50 to 50, 50 and 90, 60: at x, and y above it, parallel to the first. */
static bool is_hair_drawn(double x, double y, double length,
                          const unsigned of[2], double min_stroke_mm,
                          bool exact) {
  static const recto_pen_use border = CLASS_ON(RECTO_EDGE_BORDER, 2);
  struct ink_fixture k;
  start(&k);
  k.options.ink.has_weights = false;
  k.options.ink.edges &= ~(unsigned)RECTO_EDGE_GROUP; /* keeps silhouettes */
  k.options.ink.exact = exact;
  k.options.ink.min_stroke_mm = min_stroke_mm;
  if (of[0] == BORDER || of[1] == BORDER)
    ink_fixture_use(&k, &border, 1);
  uint32_t p = ink_fixture_point(&k, 50, 50);
  ink_fixture_edge(&k, ink_fixture_point(&k, 10, 50), p, of[0]);
  ink_fixture_edge(&k, p, ink_fixture_point(&k, 90, 60), of[0]);
  ink_fixture_line(&k, x, 50 + y, x + length, 50 + y, of[1]);
  ink_fixture_draw(&k);
  bool drawn = k.drawing.stroke.count == 2;
  assert_int_equal(k.drawing.counts.covered, !drawn);
  assert_int_equal(k.drawing.dropped.count, !drawn);
  ink_fixture_end(&k);
  return drawn;
}

static void hairs_within_half_a_pen_are_covered(void **state) {
  static const unsigned outline[2] = {SILHOUETTE, SILHOUETTE};
  static const unsigned lines[2] = {INTERSECTION, INTERSECTION};
  (void)state;
  for (int i = 0; i < 2; i++) {
    const unsigned *of = i ? lines : outline;
    assert_false(is_hair_drawn(20, 0.14, 2, of, -1, false));
    assert_true(is_hair_drawn(20, 0.16, 2, of, -1, false));
    assert_false(is_hair_drawn(20, -0.14, 2.9, of, -1, false));
    assert_true(is_hair_drawn(20, 0.14, 3.1, of, -1, false));
    assert_false(is_hair_drawn(20, 0.14, 3.1, of, 4, false));
    assert_true(is_hair_drawn(20, 0.14, 2, of, 1, false));
    assert_true(is_hair_drawn(20, 0.14, 2, of, -1, true));
  }
}

/* With smooth contours fills end at hairs, too; the longer line, 0.6 mm wide,
 * must cover their seams. */
static void hairs_beyond_which_seams_are_seen_are_drawn(void **state) {
  (void)state;
  const struct {
    double away;
    recto_fill fill;
    recto_contours contours;
    double seam;
    bool covered;
  } hair[] = {{0.09, RECTO_FILL_PAINT, RECTO_CONTOURS_SMOOTH, 0.4, true},
              {0.11, RECTO_FILL_PAINT, RECTO_CONTOURS_SMOOTH, 0.4, false},
              {0.11, RECTO_FILL_SHADE, RECTO_CONTOURS_SMOOTH, 0.4, false},
              {0.14, RECTO_FILL_PAINT, RECTO_CONTOURS_SMOOTH, 0, true},
              {0.14, RECTO_FILL_PAINT, RECTO_CONTOURS_SMOOTH, 0.6, true},
              {0.14, RECTO_FILL_PAINT, RECTO_CONTOURS_MESH, 0.4, true},
              {0.14, RECTO_FILL_HATCH, RECTO_CONTOURS_SMOOTH, 0.4, true}};
  for (size_t i = 0; i < sizeof hair / sizeof *hair; i++) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.has_weights = false;
    k.options.ink.min_stroke_mm = -1;
    k.options.ink.fill = hair[i].fill;
    k.options.ink.contours = hair[i].contours;
    k.options.ink.seam_mm = hair[i].seam;
    double y = 50 + hair[i].away;
    ink_fixture_line(&k, 10, 50, 90, 50, SILHOUETTE);
    ink_fixture_line(&k, 20, y, 22, y, SILHOUETTE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.counts.covered, hair[i].covered);
    ink_fixture_end(&k);
  }
}

static void a_hair_that_sticks_out_is_drawn(void **state) {
  static const unsigned of[2] = {SILHOUETTE, SILHOUETTE};
  (void)state;
  assert_false(is_hair_drawn(10, 0.1, 2, of, -1, false));
  assert_false(is_hair_drawn(9.95, 0.1, 2, of, -1, false));
  assert_true(is_hair_drawn(9.8, 0.1, 2, of, -1, false));
  assert_false(is_hair_drawn(48, 0.1, 2.5, of, -1, false));
  assert_true(is_hair_drawn(49, -0.14, 2.5, of, -1, false));
}

static void what_covers_is_of_the_same_pen_and_as_wide(void **state) {
  static const unsigned narrow[2] = {SILHOUETTE, INTERSECTION};
  static const unsigned wide[2] = {INTERSECTION, SILHOUETTE};
  static const unsigned pens[2] = {BORDER, INTERSECTION};
  static const unsigned wire[2] = {SILHOUETTE, WIRE};
  (void)state;
  assert_false(is_hair_drawn(20, 0.1, 2, narrow, -1, false));
  assert_true(is_hair_drawn(20, 0.1, 2, wide, -1, false));
  assert_true(is_hair_drawn(20, 0.1, 2, pens, -1, false));
  assert_true(is_hair_drawn(20, 0.1, 2, wire, -1, false));
}

/* Of two hairs that cover each other the longer one stays, and of a stack of
 * them each that lies within half a pen of one that stays is left out. */
static void something_of_a_stack_of_hairs_stays(void **state) {
  enum { HAIRS = 20 };
  struct ink_fixture k;
  (void)state;
  start(&k);
  for (int i = 0; i < HAIRS; i++)
    ink_fixture_line(&k, 50, 50 + 0.1 * i, 52 - 0.01 * i, 50 + 0.1 * i,
                     SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, HAIRS / 2);
  for (int i = 0; i < HAIRS; i++)
    assert_true(ink_fixture_distance(&k, 51, 50 + 0.1 * i) < 0.15);
  ink_fixture_end(&k);
}

static void a_closed_line_beside_another_is_drawn(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  ink_fixture_line(&k, 10, 50, 90, 50, SILHOUETTE);
  uint32_t p = ink_fixture_point(&k, 50, 50.05);
  uint32_t q = ink_fixture_point(&k, 50.08, 50.1);
  uint32_t r = ink_fixture_point(&k, 50, 50.12);
  ink_fixture_edge(&k, p, q, SILHOUETTE);
  ink_fixture_edge(&k, q, r, SILHOUETTE);
  ink_fixture_edge(&k, r, p, SILHOUETTE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 2);
  ink_fixture_end(&k);
}

/* Cost: hairs and lines by the hundred thousand in one place, or alone. */
static void many_hairs_take_no_longer_each(void **state) {
  enum { HAIRS = 100000 };
  (void)state;
  for (int spread = 0; spread < 2; spread++) {
    struct ink_fixture k;
    start(&k);
    for (int i = 0; i < HAIRS; i++) {
      double x = spread ? 1 + i % 317 * 0.3 : 50 + i % 317 * 1e-4;
      double y =
          spread ? 1 + (double)(i / 317) * 0.3 : 50 + (double)(i / 317) * 1e-4;
      ink_fixture_line(&k, x, y, x + 0.2, y + 0.05 * (i % 5), SILHOUETTE);
    }
    clock_t before = clock();
    ink_fixture_draw(&k);
    assert_true((double)(clock() - before) / CLOCKS_PER_SEC < 20);
    assert_true(k.drawing.stroke.count < (spread ? HAIRS + 1 : HAIRS / 2));
    ink_fixture_end(&k);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(creases_shorter_than_ten_pens_are_dropped),
      cmocka_unit_test(exact_drawings_drop_none),
      cmocka_unit_test(other_lines_are_drawn),
      cmocka_unit_test(a_spur_is_dropped_and_a_bridge_is_not),
      cmocka_unit_test(of_a_short_cycle_a_line_remains),
      cmocka_unit_test(a_small_closed_line_is_drawn),
      cmocka_unit_test(a_long_line_of_short_edges_is_drawn),
      cmocka_unit_test(a_line_that_goes_on_in_the_model_is_drawn),
      cmocka_unit_test(a_free_end_of_a_half_hidden_line_counts),
      cmocka_unit_test(with_ids_the_line_decides),
      cmocka_unit_test(gaps_below_half_a_pen_are_closed),
      cmocka_unit_test(only_lines_that_go_on_are_joined),
      cmocka_unit_test(gaps_are_closed_for_all_outputs),
      cmocka_unit_test(a_gap_is_closed_once),
      cmocka_unit_test(zigzags_must_be_sharper_than_other_lines),
      cmocka_unit_test(lines_of_short_pieces_are_not_drawn),
      cmocka_unit_test(short_saws_are_not_drawn),
      cmocka_unit_test(shallow_lines_are_long_and_smooth),
      cmocka_unit_test(closed_lines_stay),
      cmocka_unit_test(hairs_within_half_a_pen_are_covered),
      cmocka_unit_test(hairs_beyond_which_seams_are_seen_are_drawn),
      cmocka_unit_test(a_hair_that_sticks_out_is_drawn),
      cmocka_unit_test(what_covers_is_of_the_same_pen_and_as_wide),
      cmocka_unit_test(something_of_a_stack_of_hairs_stays),
      cmocka_unit_test(a_closed_line_beside_another_is_drawn),
      cmocka_unit_test(many_hairs_take_no_longer_each),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
