/* test_scanfill.c - the scan-line fill, compared pixel by pixel with a count of
 * crossings in integers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geom/scanfill.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"

enum { SIDE = 48, MANY = 64 };

/* A grid whose pixels are num / den plane units wide and whose lower left
 * corner is a whole point; den even. */
static struct scan_grid make_grid(int64_t num, int64_t den, int64_t x,
                                  int64_t y, bool down) {
  return (struct scan_grid){den,           x * den, 2 * (num / 2), y * den,
                            2 * (num / 2), SIDE,    SIDE,          down};
}

/* One pixel a unit, from the origin. */
static struct scan_grid plain_grid(bool down) {
  return make_grid(2, 2, 0, 0, down);
}

/* Adds all sides of a closed loop of plane points, x y after each other;
 * several loops make holes and islands. */
static bool add_loop(struct scan_table *table, const int64_t *xy, size_t count,
                     uint32_t owner) {
  struct scan_point last;
  if (count == 0)
    return true;
  last = scan_point_of(&table->grid, xy[2 * count - 2], xy[2 * count - 1]);
  for (size_t i = 0; i < count; i++) {
    struct scan_point p = scan_point_of(&table->grid, xy[2 * i], xy[2 * i + 1]);
    if (!scan_table_add(table, &last, &p, owner))
      return false;
    last = p;
  }
  return true;
}

/* ---- The oracle: half-open crossings counted in integers ----------------- */

/* Does the side from p to q count at the pixel's centre: is the centre's
 * height in [low, high) and the side not right of it?  0, +1 or -1. */
static int judge_side(const struct scan_grid *grid, const int64_t *p,
                      const int64_t *q, int column, int line) {
  int128 cx = 2 * grid->x_first + (2 * column + 1) * grid->x_step;
  int128 cy = 2 * grid->y_first + (2 * line + 1) * grid->y_step;
  int128 scale = 2 * grid->den;
  int winding = 1;
  if (p[1] > q[1]) {
    const int64_t *swap = p;
    p = q;
    q = swap;
    winding = -1;
  }
  if (cy < scale * p[1] || cy >= scale * q[1])
    return 0;
  /* x of the side at cy, times its height, against cx times its height. */
  int128 height = q[1] - p[1];
  int128 x = scale * p[0] * height + (cy - scale * p[1]) * (q[0] - p[0]);
  return x <= cx * height ? winding : 0;
}

struct loops {
  size_t count;
  size_t points[4];
  int64_t xy[4][2 * MANY];
};

static bool judge_pixel(const struct scan_grid *grid, const struct loops *loops,
                        enum scan_rule rule, int column, int line) {
  int crossings = 0, winding = 0;
  for (size_t l = 0; l < loops->count; l++) {
    for (size_t i = 0; i < loops->points[l]; i++) {
      size_t j = i + 1 == loops->points[l] ? 0 : i + 1;
      int side = judge_side(grid, &loops->xy[l][2 * i], &loops->xy[l][2 * j],
                            column, line);
      crossings += side != 0;
      winding += side;
    }
  }
  return rule == SCAN_EVEN_ODD ? crossings % 2 == 1 : winding != 0;
}

/* ---- The fill at work ---------------------------------------------------- */

static void fill(const struct scan_grid *grid, const struct loops *loops,
                 enum scan_rule rule, unsigned char pixel[SIDE][SIDE]) {
  struct scan_table table;
  struct scan_span span[4 * MANY];
  memset(pixel, 0, SIDE * SIDE);
  scan_table_init(&table, grid);
  for (size_t l = 0; l < loops->count; l++)
    assert_true(add_loop(&table, loops->xy[l], loops->points[l], 0));
  assert_true(scan_table_start(&table));
  while (scan_table_next(&table)) {
    size_t count = scan_table_spans(&table, rule, span);
    assert_in_range(table.line, 0, SIDE - 1);
    for (size_t s = 0; s < count; s++) {
      const struct scan_edge *edge = table.edge.item;
      int32_t c = scan_edge_column(&edge[span[s].left], grid);
      int32_t past = scan_edge_column(&edge[span[s].right], grid);
      assert_true(span[s].x0 <= span[s].x1);
      for (; c < past; c++)
        pixel[table.line][c]++;
    }
  }
  scan_table_fini(&table);
}

static void assert_fill_is_judged(const struct scan_grid *grid,
                                  const struct loops *loops) {
  unsigned char pixel[SIDE][SIDE];
  for (int rule = SCAN_EVEN_ODD; rule <= SCAN_NON_ZERO; rule++) {
    fill(grid, loops, (enum scan_rule)rule, pixel);
    for (int y = 0; y < SIDE; y++)
      for (int x = 0; x < SIDE; x++)
        assert_int_equal(pixel[y][x],
                         judge_pixel(grid, loops, (enum scan_rule)rule, x, y));
  }
}

static int32_t clamp_column(int64_t column) {
  return (int32_t)(column < 0 ? 0 : column > SIDE ? SIDE : column);
}

/* Sides of whole corners, where centres often lie right on them. */
static void columns_past_an_edge_exclude_the_one_on_it(void **state) {
  struct random random = {10};
  int on = 0;
  (void)state;
  for (int round = 0; round < 3000; round++) {
    struct scan_grid grid = plain_grid(round % 2 == 1);
    struct scan_point p = scan_point_of(&grid, random_int(&random, -9, 60),
                                        random_int(&random, 0, SIDE));
    struct scan_point q = scan_point_of(&grid, random_int(&random, -9, 60),
                                        random_int(&random, 0, SIDE));
    struct scan_edge edge;
    if (!scan_edge_init(&edge, &grid, &p, &q))
      continue;
    /* 2 (x - 1/2) times the height, and its floor and ceiling. */
    int64_t height = edge.y1 - edge.y0;
    int64_t x = 2 * edge.x0 * height +
                (2 * edge.line + 1 - 2 * edge.y0) * (edge.x1 - edge.x0) -
                height;
    int64_t low = x / (2 * height) - (x % (2 * height) < 0);
    bool exact = x % (2 * height) == 0;
    on += exact;
    assert_int_equal(scan_edge_column(&edge, &grid),
                     clamp_column(exact ? low : low + 1));
    assert_int_equal(scan_edge_column_past(&edge, &grid),
                     clamp_column(low + 1));
  }
  assert_true(on > 50);
}

static struct loops one_loop(const int64_t *xy, size_t count) {
  struct loops loops = {.count = 1, .points = {count}};
  memcpy(loops.xy[0], xy, 2 * count * sizeof *xy);
  return loops;
}

static size_t count_pixels(const struct loops *loops, enum scan_rule rule) {
  struct scan_grid grid = plain_grid(false);
  unsigned char pixel[SIDE][SIDE];
  size_t count = 0;
  fill(&grid, loops, rule, pixel);
  for (size_t i = 0; i < SIDE * SIDE; i++)
    count += pixel[i / SIDE][i % SIDE];
  return count;
}

static void both_ways(const struct loops *loops) {
  struct scan_grid up = plain_grid(false), down = plain_grid(true);
  assert_fill_is_judged(&up, loops);
  assert_fill_is_judged(&down, loops);
}

/* ---- Claims -------------------------------------------------------------- */

static void convex_polygon_is_filled(void **state) {
  const int64_t square[] = {10, 5, 25, 5, 25, 25, 10, 25};
  struct loops loops = one_loop(square, 4);
  (void)state;
  both_ways(&loops);
  assert_int_equal(count_pixels(&loops, SCAN_EVEN_ODD), 300);
}

static void concave_polygon_is_filled(void **state) {
  const int64_t comb[] = {2,  2,  40, 2,  40, 30, 34, 30, 34, 8,  24, 8,
                          24, 30, 18, 30, 18, 8,  8,  8,  8,  30, 2,  30};
  struct loops loops = one_loop(comb, 12);
  (void)state;
  both_ways(&loops);
  assert_int_equal(count_pixels(&loops, SCAN_EVEN_ODD), 38 * 6 + 3 * 6 * 22);
}

static void hole_is_left_out(void **state) {
  struct loops loops = {.count = 2, .points = {4, 4}};
  const int64_t outer[] = {4, 4, 40, 4, 40, 40, 4, 40};
  const int64_t hole[] = {10, 10, 10, 20, 20, 20, 20, 10};
  (void)state;
  memcpy(loops.xy[0], outer, sizeof outer);
  memcpy(loops.xy[1], hole, sizeof hole);
  both_ways(&loops);
  assert_int_equal(count_pixels(&loops, SCAN_EVEN_ODD), 36 * 36 - 100);
  assert_int_equal(count_pixels(&loops, SCAN_NON_ZERO), 36 * 36 - 100);
}

static void rules_differ_where_a_star_crosses_itself(void **state) {
  const int64_t star[] = {24, 44, 12, 6, 42, 30, 6, 30, 36, 6};
  struct loops loops = one_loop(star, 5);
  (void)state;
  both_ways(&loops);
  assert_true(count_pixels(&loops, SCAN_NON_ZERO) >
              count_pixels(&loops, SCAN_EVEN_ODD) + 50);
}

static void horizontal_sides_and_repeated_points_are_dropped(void **state) {
  const int64_t odd[] = {5, 5, 20, 5, 20, 5, 30, 5, 30, 9, 30, 9, 5, 9};
  struct loops loops = one_loop(odd, 7);
  struct scan_grid grid = plain_grid(false);
  struct scan_table table;
  (void)state;
  both_ways(&loops);
  scan_table_init(&table, &grid);
  assert_true(add_loop(&table, odd, 7, 0));
  assert_int_equal(table.edge.count, 2);
  scan_table_fini(&table);
}

/* Whole corners on a grid of whole and half steps: many centres lie exactly
 * on sides and corners. */
static void random_polygons_match_the_judge(void **state) {
  struct random random = {4};
  (void)state;
  for (int round = 0; round < 300; round++) {
    struct loops loops = {.count = 1 + random_below(&random, 3)};
    int64_t den = 2 * random_int(&random, 1, 3);
    int64_t num = random_int(&random, 1, 2) * den;
    struct scan_grid grid =
        make_grid(num, den, random_int(&random, -5, 5),
                  random_int(&random, -5, 5), random_below(&random, 2) == 1);
    for (size_t l = 0; l < loops.count; l++) {
      loops.points[l] = 3 + random_below(&random, 9);
      for (size_t i = 0; i < 2 * loops.points[l]; i++)
        loops.xy[l][i] = random_int(&random, -8, 56);
    }
    assert_fill_is_judged(&grid, &loops);
  }
}

/* Pixels of no whole width, corners of 30 bits: the sheet's own ranges. */
static void random_large_polygons_match_the_judge(void **state) {
  struct random random = {5};
  (void)state;
  for (int round = 0; round < 200; round++) {
    struct loops loops = {.count = 1};
    int64_t den = 2 * random_int(&random, 1, 4096);
    int64_t num = ((INT64_C(1) << 31) / SIDE) * den + 2 * round;
    int64_t low = -(INT64_C(1) << 30);
    struct scan_grid grid = make_grid(num, den, low, low, round % 2 == 1);
    loops.points[0] = 3 + random_below(&random, 9);
    for (size_t i = 0; i < 2 * loops.points[0]; i++)
      loops.xy[0][i] = low + (int64_t)(random_next(&random) >> 33);
    assert_fill_is_judged(&grid, &loops);
  }
}

/* The number n in [1, m) with a n = 1 modulo m, for a and m coprime. */
static int64_t invert(int64_t a, int64_t m) {
  int64_t r0 = m, r1 = a, n0 = 0, n1 = 1;
  while (r1 != 0) {
    int64_t q = r0 / r1, r = r0 - q * r1, n = n0 - q * n1;
    r0 = r1;
    r1 = r;
    n0 = n1;
    n1 = n;
  }
  assert_int_equal(r0, 1);
  return n0 < 0 ? n0 + m : n0;
}

/* A side that passes a pixel's centre at 1 / height of a plane unit, on
 * either side: far closer than doubles resolve in pixels of 2^24 units. */
static void sides_that_graze_a_centre_are_decided_exactly(void **state) {
  const int64_t pixel = 1 << 24, top = SIDE * pixel;
  (void)state;
  for (int line = 3; line < SIDE - 3; line++) {
    struct scan_grid grid = make_grid(2 * pixel, 2, 0, 0, line % 2 == 1);
    int64_t y = line * pixel + pixel / 2, height = top - 1;
    for (int side = -1; side <= 1; side++) {
      /* x at y is a whole number plus side / height. */
      int64_t run = side * invert(y + 1, height);
      int64_t whole = ((y + 1) * run - side) / height;
      int64_t x = (SIDE / 2) * pixel + pixel / 2 - whole;
      const int64_t triangle[] = {x, -1, x + run, top - 2, x, line * 1000};
      struct loops loops = one_loop(triangle, 3);
      assert_fill_is_judged(&grid, &loops);
    }
  }
}

static void neighbours_share_no_pixel_and_leave_none(void **state) {
  struct random random = {7};
  (void)state;
  for (int round = 0; round < 100; round++) {
    struct scan_grid grid = plain_grid(round % 2 == 1);
    unsigned char pixel[SIDE][SIDE], sum[SIDE][SIDE] = {{0}};
    int64_t corner[] = {0, 0, SIDE, 0, SIDE, SIDE, 0, SIDE};
    int64_t x = random_int(&random, 1, SIDE - 1),
            y = random_int(&random, 1, SIDE - 1);
    for (int k = 0; k < 4; k++) {
      const int64_t *p = &corner[2 * k], *q = &corner[2 * ((k + 1) % 4)];
      const int64_t piece[] = {p[0], p[1], q[0], q[1], x, y};
      struct loops loops = one_loop(piece, 3);
      fill(&grid, &loops, SCAN_EVEN_ODD, pixel);
      for (int i = 0; i < SIDE * SIDE; i++)
        sum[i / SIDE][i % SIDE] += pixel[i / SIDE][i % SIDE];
    }
    for (int i = 0; i < SIDE * SIDE; i++)
      assert_int_equal(sum[i / SIDE][i % SIDE], 1);
  }
}

/* ---- Lists --------------------------------------------------------------- */

static void active_edges_stay_in_order_and_end_in_time(void **state) {
  struct random random = {8};
  (void)state;
  for (int round = 0; round < 50; round++) {
    struct scan_grid grid = plain_grid(round % 2 == 1);
    struct scan_table table;
    int64_t xy[2 * MANY];
    for (size_t i = 0; i < 2 * MANY; i++)
      xy[i] = random_int(&random, 0, SIDE);
    scan_table_init(&table, &grid);
    assert_true(add_loop(&table, xy, MANY, 0));
    assert_true(scan_table_start(&table));
    while (scan_table_next(&table)) {
      const struct scan_edge *edge = table.edge.item;
      for (size_t i = 0; i < table.active_count; i++) {
        const struct scan_edge *e = &edge[table.active[i]];
        /* Half-open: y0 <= line + 1/2 < y1, doubled. */
        assert_int_equal(e->line, table.line);
        assert_true(2 * e->y0 <= 2 * e->line + 1);
        assert_true(2 * e->y1 > 2 * e->line + 1);
        if (i > 0)
          assert_true(scan_edge_compare(&edge[table.active[i - 1]], e, &grid) <=
                      0);
      }
    }
    for (size_t i = 0; i < table.edge.count; i++)
      assert_int_equal(table.edge.item[i].dy, 0);
    scan_table_fini(&table);
  }
}

/* Many sides from one point that is the centre of a pixel: all have the same
 * x on the first line and differ only in their slopes. */
static void fan_from_a_centre_is_ordered_by_slope(void **state) {
  enum { FAN = 5000 };
  struct scan_grid grid = make_grid(2 << 20, 2, 0, 0, false);
  struct scan_point apex = scan_point_of(&grid, 41 * (1 << 19), 9 * (1 << 19));
  struct scan_table table;
  (void)state;
  scan_table_init(&table, &grid);
  for (int i = 0; i < FAN; i++) {
    struct scan_point end =
        scan_point_of(&grid, (i * 7919 % FAN) * 8192, 40 * (1 << 20));
    assert_true(scan_table_add(&table, &apex, &end, 0));
  }
  assert_true(scan_table_start(&table));
  assert_true(scan_table_next(&table));
  assert_int_equal(table.line, 4);
  assert_int_equal(table.active_count, FAN);
  for (size_t i = 1; i < FAN; i++)
    assert_true(table.edge.item[table.active[i - 1]].x1 <
                table.edge.item[table.active[i]].x1);
  scan_table_fini(&table);
}

static void worked_crossings_come_in_steps_of_a_third(void **state) {
  /* The side from (25, 25) to (30, 10), lines 24 down to 10, in tenths. */
  static const int tenths[] = {252, 255, 258, 262, 265, 268, 272, 275,
                               278, 282, 285, 288, 292, 295, 298};
  struct scan_grid grid = plain_grid(true);
  struct scan_point p = scan_point_of(&grid, 25, 25);
  struct scan_point q = scan_point_of(&grid, 30, 10);
  struct scan_edge edge;
  (void)state;
  assert_true(scan_edge_init(&edge, &grid, &p, &q));
  assert_int_equal(edge.line, 24);
  assert_int_equal(edge.dy, 14);
  for (int i = 0; i < 15; i++) {
    assert_int_equal(edge.line, 24 - i);
    assert_int_equal((int)(edge.x * 10 + 0.5), tenths[i]);
    assert_int_equal(edge.dy, 14 - i);
    if (edge.dy > 0)
      scan_edge_step(&edge, true);
  }
}

/* ---- Convex polygons ----------------------------------------------------- */

static void fill_convex(const struct scan_grid *grid, const int64_t *xy,
                        uint32_t count, unsigned char pixel[SIDE][SIDE]) {
  struct scan_point point[16];
  struct scan_convex walk;
  memset(pixel, 0, SIDE * SIDE);
  for (uint32_t i = 0; i < count; i++)
    point[i] = scan_point_of(grid, xy[2 * i], xy[2 * i + 1]);
  if (!scan_convex_start(&walk, grid, point, count))
    return;
  do {
    int32_t past = scan_edge_column(&walk.right, grid);
    assert_int_equal(walk.left.line, walk.right.line);
    for (int32_t c = scan_edge_column(&walk.left, grid); c < past; c++)
      pixel[walk.left.line][c]++;
  } while (scan_convex_next(&walk, grid, point));
}

static void assert_convex_is_judged(const int64_t *xy, uint32_t count) {
  struct loops loops = one_loop(xy, count);
  for (int down = 0; down < 2; down++) {
    struct scan_grid grid = plain_grid(down == 1);
    unsigned char pixel[SIDE][SIDE];
    fill_convex(&grid, xy, count, pixel);
    for (int i = 0; i < SIDE * SIDE; i++)
      assert_int_equal(
          pixel[i / SIDE][i % SIDE],
          judge_pixel(&grid, &loops, SCAN_EVEN_ODD, i % SIDE, i / SIDE));
  }
}

static void triangles_are_split_at_the_middle_vertex(void **state) {
  struct random random = {9};
  (void)state;
  for (int round = 0; round < 1000; round++) {
    int64_t p[6];
    for (int i = 0; i < 6; i++)
      p[i] = random_int(&random, -5, SIDE + 5);
    if ((p[2] - p[0]) * (p[5] - p[1]) < (p[3] - p[1]) * (p[4] - p[0])) {
      int64_t x = p[2], y = p[3];
      p[2] = p[4];
      p[3] = p[5];
      p[4] = x;
      p[5] = y;
    }
    assert_convex_is_judged(p, 3);
  }
}

static void convex_polygons_hand_over_at_their_corners(void **state) {
  const int64_t octagon[] = {14, 4,  30, 4,  41, 15, 41, 31,
                             30, 42, 14, 42, 3,  31, 3,  15};
  const int64_t straight[] = {10, 5,  20, 5,  30, 5,  30, 5,  30, 20,
                              30, 30, 20, 30, 10, 30, 10, 17, 10, 17};
  (void)state;
  assert_convex_is_judged(octagon, 8);
  assert_convex_is_judged(straight, 10);
}

static void flat_polygon_covers_no_line(void **state) {
  struct scan_grid grid = plain_grid(false);
  struct scan_point p[3] = {scan_point_of(&grid, 3, 7),
                            scan_point_of(&grid, 9, 7),
                            scan_point_of(&grid, 30, 7)};
  struct scan_convex walk;
  (void)state;
  assert_false(scan_convex_start(&walk, &grid, p, 3));
}

/* ---- Hatching, memory ---------------------------------------------------- */

/* Spans keep x unrounded, so that a turned square's hatch adds up to its
 * area: 30 by 30 units turned by the angle of a 3-4-5 triangle. */
static void spans_add_up_to_the_area_of_a_turned_square(void **state) {
  const int64_t square[] = {18, 0, 42, 18, 24, 42, 0, 24};
  struct scan_grid grid = {512, 0, 512, 0, 64, SIDE, 42 * 8, false};
  struct scan_table table;
  struct scan_span span[4];
  double area = 0;
  (void)state;
  scan_table_init(&table, &grid);
  assert_true(add_loop(&table, square, 4, 0));
  assert_true(scan_table_start(&table));
  while (scan_table_next(&table)) {
    assert_int_equal(scan_table_spans(&table, SCAN_EVEN_ODD, span), 1);
    area += (span[0].x1 - span[0].x0) / 8;
  }
  scan_table_fini(&table);
  assert_true(area > 900 - 0.05 && area < 900 + 0.05);
}

static void running_out_of_memory_is_reported(void **state) {
  const int64_t square[] = {10, 5, 25, 5, 25, 25, 10, 25};
  struct scan_grid grid = plain_grid(false);
  struct memory_faults faults = {.least = 5};
  (void)state;
  while (memory_faults_go_on(&faults)) {
    struct scan_table table;
    scan_table_init(&table, &grid);
    memory_faults_begin(&faults);
    bool ok = add_loop(&table, square, 4, 0) && scan_table_start(&table);
    memory_faults_end(&faults, memory_faults_status(ok));
    scan_table_fini(&table);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(convex_polygon_is_filled),
      cmocka_unit_test(concave_polygon_is_filled),
      cmocka_unit_test(hole_is_left_out),
      cmocka_unit_test(rules_differ_where_a_star_crosses_itself),
      cmocka_unit_test(horizontal_sides_and_repeated_points_are_dropped),
      cmocka_unit_test(random_polygons_match_the_judge),
      cmocka_unit_test(random_large_polygons_match_the_judge),
      cmocka_unit_test(sides_that_graze_a_centre_are_decided_exactly),
      cmocka_unit_test(columns_past_an_edge_exclude_the_one_on_it),
      cmocka_unit_test(neighbours_share_no_pixel_and_leave_none),
      cmocka_unit_test(active_edges_stay_in_order_and_end_in_time),
      cmocka_unit_test(fan_from_a_centre_is_ordered_by_slope),
      cmocka_unit_test(worked_crossings_come_in_steps_of_a_third),
      cmocka_unit_test(triangles_are_split_at_the_middle_vertex),
      cmocka_unit_test(convex_polygons_hand_over_at_their_corners),
      cmocka_unit_test(flat_polygon_covers_no_line),
      cmocka_unit_test(spans_add_up_to_the_area_of_a_turned_square),
      cmocka_unit_test(running_out_of_memory_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
