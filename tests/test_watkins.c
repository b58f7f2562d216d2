/* test_watkins.c - the interval scan line: the worked frames and lists, its
 * coherence, and what it draws. */
#include "exact_fixture/pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/near.h"
#include "visibility/watkins/pitch/watkins.h"

/* The lists of a sheet, line by line. */
struct scanned {
  struct sheet sheet;
  struct facets facets;
  struct watkins watkins;
};

static void start_scan(struct scanned *scanned,
                       const struct pixels_scene *scene, double pitch_mm) {
  struct scan_grid grid;
  pixels_sheet(&scanned->sheet, scene);
  assert_true(facets_init(&scanned->facets, &scanned->sheet));
  assert_int_equal(watkins_grid(&grid, &scanned->sheet, pitch_mm, NULL),
                   RECTO_OK);
  assert_true(watkins_init(&scanned->watkins, &scanned->sheet, &scanned->facets,
                           &grid));
}

static void end_scan(struct scanned *scanned) {
  watkins_fini(&scanned->watkins);
  facets_fini(&scanned->facets);
  exact_sheet_fini(&scanned->sheet);
}

static bool next_line(struct scanned *scanned) {
  bool more;
  assert_true(watkins_next(&scanned->watkins, &more));
  return more;
}

/* x on the line, as the scene has it. */
static double scene_x(double x) { return x / PIXELS_UNIT + PIXELS_SIDE / 2; }

static int face_of(const struct scanned *scanned,
                   const struct watkins_span *span) {
  return (int)scanned->watkins.facet.item[span->facet].face;
}

/* ---- Frames -------------------------------------------------------------- */

/* Is the facet's depth at x above that of another by more than rounding? */
static bool is_nearer(const struct scanned *scanned, uint32_t f, uint32_t g,
                      double x) {
  return watkins_depth(&scanned->watkins, f, x) -
             watkins_depth(&scanned->watkins, g, x) >
         1;
}

/* The face at the centre of a column.  Pieces are tested with their ends: where
 * two meet at the centre, the nearer, the earlier where equally near. */
static int seen_at_column(const struct scanned *scanned, int column,
                          int columns) {
  const struct watkins *watkins = &scanned->watkins;
  double x =
      ((column + 0.5) * PIXELS_SIDE / columns - PIXELS_SIDE / 2) * PIXELS_UNIT;
  const struct watkins_span *seen = NULL;
  for (size_t i = 0; i < watkins->span.count; i++) {
    const struct watkins_span *span = &watkins->span.item[i];
    if (x < span->x0 - 0x1p-8 || x > span->x1 + 0x1p-8)
      continue;
    if (seen == NULL || is_nearer(scanned, span->facet, seen->facet, x) ||
        (!is_nearer(scanned, seen->facet, span->facet, x) &&
         face_of(scanned, span) < face_of(scanned, seen)))
      seen = span;
  }
  return seen == NULL ? -1 : face_of(scanned, seen);
}

static void assert_spans_in_order(const struct scanned *scanned) {
  const struct watkins *watkins = &scanned->watkins;
  for (size_t i = 0; i < watkins->span.count; i++) {
    assert_true(watkins->span.item[i].x0 <= watkins->span.item[i].x1);
    if (i > 0)
      assert_true(watkins->span.item[i - 1].x1 <= watkins->span.item[i].x0);
  }
}

/* Compares every pixel with the oracle, at `lines` lines over the page. */
static void assert_frame_is_judged(const struct pixels_scene *scene,
                                   int lines) {
  struct scanned scanned;
  int32_t next = lines - 1;
  start_scan(&scanned, scene, (double)PIXELS_SIDE / lines);
  assert_int_equal(scanned.watkins.table.grid.lines, lines);
  while (next_line(&scanned)) {
    int32_t line = scanned.watkins.table.line;
    for (; next >= line; next--) {
      if (next == line)
        assert_spans_in_order(&scanned);
      for (int column = 0; column < lines; column++) {
        int want = pixels_seen(scene, lines, column, next, NULL);
        int got = next == line ? seen_at_column(&scanned, column, lines) : -1;
        if (got != want)
          fail_msg("%d lines, pixel %d %d: face %d, not %d", lines, column,
                   (int)next, got, want);
      }
    }
  }
  for (; next >= 0; next--)
    for (int column = 0; column < lines; column++)
      assert_int_equal(pixels_seen(scene, lines, column, next, NULL), -1);
  end_scan(&scanned);
}

static void assert_worked_frame(const struct pixels_scene *scene,
                                int (*frame)(int, int)) {
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 32; x++)
      assert_int_equal(pixels_seen(scene, 32, x, y, NULL), frame(x, y));
  assert_frame_is_judged(scene, 32);
}

static void pierced_rectangle_is_right_in_every_pixel(void **state) {
  (void)state;
  assert_worked_frame(&pixels_pierced_rectangle,
                      pixels_frame_of_pierced_rectangle);
}

static void two_rectangles_are_right_in_every_pixel(void **state) {
  (void)state;
  assert_worked_frame(&pixels_two_rectangles, pixels_frame_of_two_rectangles);
}

/* Line centres keep clear of corners, or a facet may be there without any
 * width. */
static void random_scenes_are_right_in_every_pixel(void **state) {
  static const int lines[] = {32, 64, 128};
  (void)state;
  for (uint64_t seed = 0; seed < 150; seed++) {
    struct pixels_scene scene;
    pixels_random_scene(&scene, seed);
    assert_frame_is_judged(&scene, lines[seed % 3]);
  }
}

/* ---- Worked lists -------------------------------------------------------- */

struct listed_edge {
  double x, dx;
  int lines_left;
  double z, dz;
  int face;
};

static void assert_active(const struct scanned *scanned,
                          const struct listed_edge want[4]) {
  const struct watkins *watkins = &scanned->watkins;
  const struct scan_table *table = &watkins->table;
  assert_int_equal(table->active_count, 4);
  for (size_t i = 0; i < 4; i++) {
    uint32_t e = table->active[i];
    assert_near(scene_x(table->edge.item[e].x), want[i].x);
    assert_near(table->edge.item[e].dx / PIXELS_UNIT, want[i].dx);
    assert_int_equal(table->edge.item[e].dy, want[i].lines_left);
    assert_near(watkins_edge_depth(watkins, e) / PIXELS_UNIT, want[i].z);
    assert_near(watkins->edge.item[e].dz / PIXELS_UNIT, want[i].dz);
    assert_int_equal(watkins->facet.item[watkins->edge.item[e].facet[0]].face,
                     want[i].face);
  }
}

static void scan_to_line(struct scanned *scanned, int32_t line) {
  do
    assert_true(next_line(scanned));
  while (scanned->watkins.table.line > line);
  assert_int_equal(scanned->watkins.table.line, line);
}

static void active_edges_are_as_listed(void **state) {
  static const struct listed_edge line_24[] = {
      {10, 0, 19, 10, 0, 0},
      {24.5, -1, 9, 5.5, 1, 1},
      {25, 0, 19, 10, 0, 0},
      {25 + 1 / 6., 1 / 3., 14, 5, 0, 1}};
  static const struct listed_edge line_15[] = {
      {10, 0, 10, 10, 0, 0},
      {15.5, -1, 0, 14.5, 1, 1},
      {25, 0, 10, 10, 0, 0},
      {28 + 1 / 6., 1 / 3., 5, 5, 0, 1}};
  static const struct listed_edge line_14[] = {{10, 0, 9, 10, 0, 0},
                                               {16.5, 3, 4, 14, -2, 1},
                                               {25, 0, 9, 10, 0, 0},
                                               {28.5, 1 / 3., 4, 5, 0, 1}};
  struct scanned scanned;
  (void)state;
  start_scan(&scanned, &pixels_pierced_rectangle, 1);
  scan_to_line(&scanned, 24);
  assert_active(&scanned, line_24);
  scan_to_line(&scanned, 15);
  assert_active(&scanned, line_15);
  scan_to_line(&scanned, 14);
  assert_active(&scanned, line_14);
  scan_to_line(&scanned, 9);
  assert_int_equal(scanned.watkins.table.active_count, 2);
  end_scan(&scanned);
}

static void edges_wait_in_the_order_of_y_x_and_dx(void **state) {
  (void)state;
  for (uint64_t seed = 300; seed < 340; seed++) {
    struct pixels_scene scene;
    struct scanned scanned;
    const struct scan_table *table = &scanned.watkins.table;
    pixels_random_scene(&scene, seed);
    start_scan(&scanned, &scene, 1);
    for (size_t i = 1; i < table->edge.count; i++) {
      const struct scan_edge *a = &table->edge.item[table->order[i - 1]];
      const struct scan_edge *b = &table->edge.item[table->order[i]];
      assert_true(a->line >= b->line);
      if (a->line == b->line)
        assert_true(scan_edge_compare(a, b, &table->grid) <= 0);
    }
    end_scan(&scanned);
  }
}

struct listed_span {
  double x0, x1;
  int face;
};

static void assert_spans(const struct scanned *scanned,
                         const struct listed_span *want, size_t count) {
  assert_int_equal(scanned->watkins.span.count, count);
  for (size_t i = 0; i < count; i++) {
    const struct watkins_span *span = &scanned->watkins.span.item[i];
    assert_near(scene_x(span->x0), want[i].x0);
    assert_near(scene_x(span->x1), want[i].x1);
    assert_int_equal(face_of(scanned, span), want[i].face);
  }
}

static double grid_x(double x) { return (x - PIXELS_SIDE / 2) * PIXELS_UNIT; }

/* The interval from 15.5 to 25 has different signs at its ends. */
static void assert_depths_of_line_15(struct scanned *scanned) {
  struct watkins *watkins = &scanned->watkins;
  static const struct {
    double x, depth;
    int sign;
  } at[] = {{15.5, 14.5, 1},
            {25, 7.375, -1},
            {18.5, 12.25, 1},
            {23.25, 8.6875, -1},
            {21.5, 10, 0}};
  for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
    double x = grid_x(at[i].x);
    assert_near(watkins_depth(watkins, 1, x) / PIXELS_UNIT, at[i].depth);
    assert_near(watkins_depth(watkins, 0, x) / PIXELS_UNIT, 10);
    assert_int_equal(watkins_compare(watkins, 1, 0, x), at[i].sign);
  }
}

static void line_15_is_split_as_listed(void **state) {
  static const struct listed_span spans[] = {
      {10, 15.5, 0}, {15.5, 21.5, 1}, {21.5, 25, 0}, {25, 28 + 1 / 6., 1}};
  struct scanned scanned;
  int64_t before;
  (void)state;
  start_scan(&scanned, &pixels_pierced_rectangle, 1);
  scan_to_line(&scanned, 16);
  before = scanned.watkins.counts.splits;
  scan_to_line(&scanned, 15);
  assert_int_equal(scanned.watkins.counts.splits, before + 1);
  assert_spans(&scanned, spans, 4);
  assert_int_equal(scanned.watkins.span.item[1].right, WATKINS_NONE);
  assert_int_equal(scanned.watkins.span.item[2].left, WATKINS_NONE);
  assert_depths_of_line_15(&scanned);
  end_scan(&scanned);
}

static void line_14_is_split_as_listed(void **state) {
  /* 3 x + y = 80 at y = 14.5. */
  static const struct listed_span spans[] = {
      {10, 16.5, 0}, {16.5, 65.5 / 3, 1}, {65.5 / 3, 25, 0}, {25, 28.5, 1}};
  struct scanned scanned;
  (void)state;
  start_scan(&scanned, &pixels_pierced_rectangle, 1);
  scan_to_line(&scanned, 14);
  assert_spans(&scanned, spans, 4);
  end_scan(&scanned);
}

/* Tangents of a parabola: each of the nine is seen between two others, and the
 * stack holds several parts. */
static void an_interval_is_split_wherever_two_seen_faces_pierce(void **state) {
  struct pixels_scene fan = {9, {{0}}};
  struct scanned scanned;
  (void)state;
  for (int f = 0; f < 9; f++) {
    int t = f - 4, left = 48 - 8 * t - t * t, right = 48 + 8 * t - t * t;
    fan.face[f] = (struct pixels_face){
        4, {{0, 0, left}, {32, 0, right}, {32, 32, right}, {0, 32, left}}};
  }
  start_scan(&scanned, &fan, 1);
  assert_true(next_line(&scanned));
  assert_int_equal(scanned.watkins.counts.intervals, 1);
  assert_int_equal(scanned.watkins.counts.splits, 8);
  assert_int_equal(scanned.watkins.span.count, 9);
  for (size_t i = 0; i < 9; i++)
    assert_int_equal(face_of(&scanned, &scanned.watkins.span.item[i]), i);
  end_scan(&scanned);
  assert_frame_is_judged(&fan, 32);
}

/* ---- Coherence ----------------------------------------------------------- */

/* Depth comparisons with coherence, and without, where what was kept of the
 * line above is forgotten; the spans of each line are the same. */
static void compare_coherence(const struct pixels_scene *scene, double pitch_mm,
                              int64_t *with, int64_t *without) {
  struct scanned kept, anew;
  start_scan(&kept, scene, pitch_mm);
  start_scan(&anew, scene, pitch_mm);
  while (next_line(&kept)) {
    anew.watkins.record[0].count = anew.watkins.record[1].count = 0;
    assert_true(next_line(&anew));
    assert_int_equal(kept.watkins.span.count, anew.watkins.span.count);
    for (size_t i = 0; i < kept.watkins.span.count; i++) {
      const struct watkins_span *p = &kept.watkins.span.item[i],
                                *q = &anew.watkins.span.item[i];
      assert_int_equal(p->facet, q->facet);
      assert_true(p->x0 == q->x0 && p->x1 == q->x1);
    }
  }
  *with = kept.watkins.counts.comparisons;
  *without = anew.watkins.counts.comparisons;
  assert_int_equal(anew.watkins.counts.coherent, 0);
  end_scan(&kept);
  end_scan(&anew);
}

static void coherence_saves_comparisons_and_changes_nothing(void **state) {
  static const double pitch[] = {1, 0.37, 0.05, 2.5};
  int64_t all_with = 0, all_without = 0;
  (void)state;
  for (uint64_t seed = 500; seed < 620; seed++) {
    struct pixels_scene scene;
    int64_t with, without;
    pixels_random_scene(&scene, seed);
    compare_coherence(&scene, pitch[seed % 4], &with, &without);
    assert_in_range(with, 0, without);
    all_with += with;
    all_without += without;
  }
  assert_true(2 * all_with < all_without);
}

static void an_order_that_holds_is_computed_once(void **state) {
  /* Two parallel slopes, one before the other: one order for all lines. */
  const struct pixels_scene slopes = {
      2,
      {{4, {{4, 4, 9}, {4, 28, 9}, {28, 28, 19}, {28, 4, 19}}},
       {4, {{4, 4, 3}, {28, 4, 13}, {28, 28, 13}, {4, 28, 3}}}}};
  int64_t with, without, with_fine, without_fine;
  (void)state;
  compare_coherence(&slopes, 1, &with, &without);
  compare_coherence(&slopes, 0.25, &with_fine, &without_fine);
  assert_true(with > 0);
  assert_int_equal(with, with_fine);
  assert_int_equal(without, 24 * with);
  assert_int_equal(without_fine, 4 * without);
}

static void no_depth_is_computed_of_faces_clearly_apart(void **state) {
  const struct pixels_scene squares = {
      2,
      {{4, {{4, 4, 9}, {4, 28, 9}, {28, 28, 9}, {28, 4, 9}}},
       {4, {{4, 4, 3}, {28, 4, 3}, {28, 28, 3}, {4, 28, 3}}}}};
  int64_t with, without;
  (void)state;
  compare_coherence(&squares, 1, &with, &without);
  assert_int_equal(with, 0);
  assert_int_equal(without, 0);
}

/* ---- What it draws ------------------------------------------------------- */

static void solve_scene(const struct pixels_scene *scene, double pitch_mm,
                        struct map *map) {
  const struct solver_request request = {
      .edges = true, .fragments = true, .threads = 1, .pitch_mm = pitch_mm};
  struct sheet sheet;
  pixels_sheet(&sheet, scene);
  map_init(map);
  assert_int_equal(solver_watkins.solve(&sheet, &request, map, NULL, NULL),
                   RECTO_OK);
  exact_sheet_fini(&sheet);
}

static void equal_sides_make_one_trapezoid(void **state) {
  const struct pixels_scene square = {
      1, {{4, {{4, 4, 9}, {4, 28, 9}, {20, 28, 9}, {20, 4, 9}}}}};
  const struct pixels_scene triangle = {
      1, {{3, {{4, 4, 9}, {28, 16, 9}, {4, 28, 9}}}}};
  struct map map;
  (void)state;
  solve_scene(&square, 0.5, &map);
  assert_int_equal(map.fragment.count, 1);
  assert_int_equal(map.corner.count, 4);
  for (int k = 0; k < 4; k++) {
    assert_near(fabs(map.corner.item[k].x / PIXELS_UNIT + 4), 8);
    assert_near(fabs(map.corner.item[k].y / PIXELS_UNIT), 12);
  }
  map_fini(&map);
  /* One above the right corner, one below it. */
  solve_scene(&triangle, 0.5, &map);
  assert_int_equal(map.fragment.count, 2);
  map_fini(&map);
}

static void whole_edges_are_visible_from_end_to_end(void **state) {
  static const double pitch[] = {0.3, 1, 3, 7};
  const struct pixels_scene scene = {
      2,
      {{4, {{3, 2, 9}, {5, 29, 9}, {20, 28, 9}, {22, 4, 9}}},
       {3, {{23, 5, 1}, {30, 14, 1}, {24, 30, 1}}}}};
  (void)state;
  for (int i = 0; i < 4; i++) {
    struct map map;
    solve_scene(&scene, pitch[i], &map);
    for (size_t e = 0; e < map.edge_count; e++)
      assert_int_equal(map.edge_state[e], MAP_VISIBLE);
    map_fini(&map);
  }
}

/* What lies between two lines behind what the nearer one sees is not drawn,
 * whatever the other sees; one line is the page's middle. */
static void what_no_line_meets_is_not_drawn_where_it_is_hidden(void **state) {
  static const struct {
    double pitch;
    int low, high;
  } row[] = {{1000, 6, 10}, {1000, 20, 24}, {16, 10, 14}, {12, 20, 23}};
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    int y0 = row[i].low, y1 = row[i].high;
    const struct pixels_scene scene = {
        2,
        {{4, {{4, 4, 9}, {4, 28, 9}, {28, 28, 9}, {28, 4, 9}}},
         {4, {{8, y0, 1}, {8, y1, 1}, {12, y1, 1}, {12, y0, 1}}}}};
    struct map map;
    solve_scene(&scene, row[i].pitch, &map);
    assert_int_equal(map.edge_count, 8);
    for (size_t e = 0; e < 8; e++)
      assert_int_equal(map.edge_state[e], e < 4 ? MAP_VISIBLE : MAP_HIDDEN);
    map_fini(&map);
  }
}

/* However steep the face is that the line sees: it reaches there itself. */
static void a_face_hides_as_far_as_it_reaches(void **state) {
  const struct pixels_scene scene = {
      2,
      {{3, {{4, 4, 0}, {28, 4, 0}, {16, 28, 24}}},
       {4, {{15, 18, 4}, {17, 18, 4}, {17, 20, 4}, {15, 20, 4}}}}};
  struct map map;
  (void)state;
  solve_scene(&scene, 1000, &map);
  for (size_t e = 0; e < 7; e++)
    assert_int_equal(map.edge_state[e], e < 3 ? MAP_VISIBLE : MAP_HIDDEN);
  map_fini(&map);
}

/* The sum of the visible shares of all edges. */
static double visible_share(const struct map *map) {
  double share = 0;
  for (size_t e = 0; e < map->edge_count; e++)
    share += map->edge_state[e] == MAP_VISIBLE;
  for (size_t i = 0; i < map->interval.count; i++)
    share += ratio_to_double(map->interval.item[i].t1) -
             ratio_to_double(map->interval.item[i].t0);
  return share;
}

/* The two steep sides that enter the rectangle at (20, 20): the pierced one is
 * seen from (15, 15) halfway up; the rectangle's right side is hidden nowhere;
 * the side to (30, 10) wholly seen. */
static void strokes_end_where_faces_pierce_within_a_pitch(void **state) {
  static const double pitch[] = {1, 0.3, 0.05};
  (void)state;
  for (int i = 0; i < 3; i++) {
    struct map map, exact;
    solve_scene(&pixels_pierced_rectangle, pitch[i], &map);
    solve_scene(&pixels_pierced_rectangle, 0, &exact);
    assert_true(fabs(visible_share(&map) - visible_share(&exact)) <
                2 * pitch[i] / 10);
    assert_int_equal(map.edge_count, exact.edge_count);
    for (size_t e = 0; e < map.edge_count; e++)
      assert_int_equal(map.edge_state[e], exact.edge_state[e]);
    map_fini(&map);
    map_fini(&exact);
  }
}

static void lines_are_refused_where_there_are_too_many(void **state) {
  struct sheet sheet;
  struct scan_grid grid;
  recto_error error;
  (void)state;
  pixels_sheet(&sheet, &pixels_two_rectangles);
  assert_int_equal(watkins_grid(&grid, &sheet, 1e-5, &error),
                   RECTO_ERROR_LIMIT);
  assert_non_null(strstr(error.text, "pitch"));
  assert_int_equal(watkins_grid(&grid, &sheet, 1e300, &error), RECTO_OK);
  assert_int_equal(grid.lines, 1);
  assert_int_equal(watkins_grid(&grid, &sheet, 0.3, &error), RECTO_OK);
  assert_int_equal(grid.lines, 107);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pierced_rectangle_is_right_in_every_pixel),
      cmocka_unit_test(two_rectangles_are_right_in_every_pixel),
      cmocka_unit_test(random_scenes_are_right_in_every_pixel),
      cmocka_unit_test(active_edges_are_as_listed),
      cmocka_unit_test(edges_wait_in_the_order_of_y_x_and_dx),
      cmocka_unit_test(line_15_is_split_as_listed),
      cmocka_unit_test(line_14_is_split_as_listed),
      cmocka_unit_test(an_interval_is_split_wherever_two_seen_faces_pierce),
      cmocka_unit_test(coherence_saves_comparisons_and_changes_nothing),
      cmocka_unit_test(an_order_that_holds_is_computed_once),
      cmocka_unit_test(no_depth_is_computed_of_faces_clearly_apart),
      cmocka_unit_test(equal_sides_make_one_trapezoid),
      cmocka_unit_test(whole_edges_are_visible_from_end_to_end),
      cmocka_unit_test(what_no_line_meets_is_not_drawn_where_it_is_hidden),
      cmocka_unit_test(a_face_hides_as_far_as_it_reaches),
      cmocka_unit_test(strokes_end_where_faces_pierce_within_a_pitch),
      cmocka_unit_test(lines_are_refused_where_there_are_too_many),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
