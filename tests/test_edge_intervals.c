/* test_edge_intervals.c - from occluded intervals to visible ones. */
#include "exact_fixture/sheet.h"
#include "visibility/predicate/edge_intervals.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Parameters are whole twelfths, so that all is known in between. */
enum { STEPS = 12 };

struct span {
  int from, to, sides;
};

/* k / STEPS, written narrow or too wide for 64 bits. */
static struct ratio step(int k, uint64_t *r) {
  int128 factor = (int128)1 << (exact_random_below(r, 2) ? 0 : 100);
  factor *= 1 + exact_random_below(r, 5);
  return (struct ratio){k * factor, STEPS * factor};
}

static void hide(struct edge_intervals *intervals, const struct span *span,
                 int count, uint64_t *r) {
  edge_intervals_start(intervals);
  for (int k = 0; k < count; k++) {
    struct occluded_interval part = {step(span[k].from, r), step(span[k].to, r),
                                     span[k].sides};
    assert_true(edge_intervals_occlude(intervals, part));
  }
}

/* Is the piece from step k to step k + 1 hidden? */
static bool is_hidden(const struct span *span, int count, int k) {
  int sides = 0;
  for (int i = 0; i < count; i++)
    if (span[i].from <= k && k < span[i].to)
      sides |= span[i].sides;
  return sides == OCCLUDED_BOTH;
}

/* The map has exactly the pieces that are visible, joined. */
static void check(const struct map *map, uint32_t edge, const struct span *span,
                  int count) {
  const struct map_mixed *mixed = NULL;
  uint32_t found = 0;
  int visible = 0;
  for (int k = 0; k < STEPS; k++)
    visible += !is_hidden(span, count, k);
  for (size_t m = 0; m < map->mixed.count; m++)
    if (map->mixed.item[m].edge == edge)
      mixed = &map->mixed.item[m];
  assert_int_equal(map->edge_state[edge], visible == 0       ? MAP_HIDDEN
                                          : visible == STEPS ? MAP_VISIBLE
                                                             : MAP_MIXED);
  if (map->edge_state[edge] != MAP_MIXED) {
    assert_null(mixed);
    return;
  }
  assert_non_null(mixed);
  for (int k = 0, end; k < STEPS; k = end) {
    const struct map_interval *interval;
    for (end = k + 1; end < STEPS &&
                      is_hidden(span, count, end) == is_hidden(span, count, k);)
      end++;
    if (is_hidden(span, count, k))
      continue;
    assert_true(found < mixed->count);
    interval = &map->interval.item[mixed->interval + found++];
    assert_int_equal(ratio_compare(interval->t0, ratio_of(k, STEPS)), 0);
    assert_int_equal(ratio_compare(interval->t1, ratio_of(end, STEPS)), 0);
  }
  assert_int_equal(found, mixed->count);
}

static int draw_spans(struct span *span, uint64_t *r) {
  int count = exact_random_below(r, 7), one_sided = exact_random_below(r, 3);
  for (int k = 0; k < count; k++) {
    span[k].from = exact_random_below(r, STEPS);
    span[k].to = span[k].from + 1 + exact_random_below(r, STEPS - span[k].from);
    span[k].sides = exact_random_below(r, 3) < one_sided
                        ? 1 + exact_random_below(r, 2)
                        : OCCLUDED_BOTH;
  }
  return count;
}

static void visible_is_what_is_not_hidden_on_both_sides(void **state) {
  enum { EDGES = 20000, MOST = 8 };
  static struct span span[EDGES][MOST];
  static int count[EDGES];
  uint64_t r = 1;
  struct edge_intervals intervals = {0};
  struct map map;
  (void)state;
  map_init(&map);
  assert_true(edge_intervals_open_map(&map, EDGES));
  for (uint32_t e = 0; e < EDGES; e++) {
    count[e] = draw_spans(span[e], &r);
    hide(&intervals, span[e], count[e], &r);
    assert_true(edge_intervals_store(&intervals, e, &map));
  }
  for (uint32_t e = 0; e < EDGES; e++)
    check(&map, e, span[e], count[e]);
  for (size_t m = 1; m < map.mixed.count; m++)
    assert_true(map.mixed.item[m - 1].edge < map.mixed.item[m].edge);
  map_fini(&map);
  edge_intervals_fini(&intervals);
}

static void store_one(const struct span *span, int count, struct map *map) {
  uint64_t r = 2;
  struct edge_intervals intervals = {0};
  map_init(map);
  assert_true(edge_intervals_open_map(map, 1));
  hide(&intervals, span, count, &r);
  assert_true(edge_intervals_store(&intervals, 0, map));
  check(map, 0, span, count);
  edge_intervals_fini(&intervals);
}

static void nothing_hidden_is_visible(void **state) {
  struct map map;
  (void)state;
  store_one(NULL, 0, &map);
  assert_int_equal(map.edge_state[0], MAP_VISIBLE);
  map_fini(&map);
}

static void one_side_covered_is_visible(void **state) {
  static const struct span left = {0, 12, OCCLUDED_LEFT};
  struct map map;
  (void)state;
  store_one(&left, 1, &map);
  assert_int_equal(map.edge_state[0], MAP_VISIBLE);
  map_fini(&map);
}

static void each_side_covered_by_another_is_hidden(void **state) {
  static const struct span span[] = {
      {0, 12, OCCLUDED_LEFT}, {0, 4, OCCLUDED_RIGHT}, {4, 12, OCCLUDED_RIGHT}};
  struct map map;
  (void)state;
  store_one(span, 3, &map);
  assert_int_equal(map.edge_state[0], MAP_HIDDEN);
  assert_int_equal(map.interval.count, 0);
  map_fini(&map);
}

static void a_visible_piece_without_length_is_none(void **state) {
  static const struct span span[] = {{6, 12, OCCLUDED_BOTH},
                                     {0, 6, OCCLUDED_BOTH}};
  struct map map;
  (void)state;
  store_one(span, 2, &map);
  assert_int_equal(map.edge_state[0], MAP_HIDDEN);
  map_fini(&map);
}

static void whole_occlusion_ends_the_query(void **state) {
  static const struct span span[] = {
      {0, 11, OCCLUDED_BOTH}, {0, 12, OCCLUDED_LEFT}, {0, 12, OCCLUDED_BOTH}};
  uint64_t r = 3;
  struct edge_intervals intervals = {0};
  struct map map;
  (void)state;
  map_init(&map);
  assert_true(edge_intervals_open_map(&map, 1));
  hide(&intervals, span, 2, &r);
  assert_false(intervals.occluded);
  hide(&intervals, span, 3, &r);
  assert_true(intervals.occluded);
  assert_true(edge_intervals_store(&intervals, 0, &map));
  assert_int_equal(map.edge_state[0], MAP_HIDDEN);
  edge_intervals_start(&intervals);
  assert_false(intervals.occluded);
  assert_true(edge_intervals_store(&intervals, 0, &map));
  assert_int_equal(map.edge_state[0], MAP_VISIBLE);
  map_fini(&map);
  edge_intervals_fini(&intervals);
}

static void assert_same_intervals(const struct map *a, const struct map *b) {
  assert_int_equal(a->edge_state[0], b->edge_state[0]);
  assert_int_equal(a->interval.count, b->interval.count);
  for (size_t i = 0; i < a->interval.count; i++) {
    const struct map_interval *s = &a->interval.item[i],
                              *t = &b->interval.item[i];
    assert_int_equal(ratio_compare(s->t0, t->t0), 0);
    assert_int_equal(ratio_compare(s->t1, t->t1), 0);
  }
}

static void the_order_of_pieces_does_not_matter(void **state) {
  uint64_t r = 4;
  (void)state;
  for (int i = 0; i < 2000; i++) {
    struct span span[8];
    int count = draw_spans(span, &r);
    struct map map, again;
    store_one(span, count, &map);
    for (int k = count; k > 1; k--) {
      int other = exact_random_below(&r, k);
      struct span swap = span[k - 1];
      span[k - 1] = span[other];
      span[other] = swap;
    }
    store_one(span, count, &again);
    assert_same_intervals(&map, &again);
    map_fini(&map);
    map_fini(&again);
  }
}

/* Starts that no double tells apart are ordered all the same: of 1,000 pieces
 * of 2^-90 from 2/3 on, given in any order, every tenth is missing. */
static void
many_starts_that_doubles_do_not_tell_apart_are_ordered(void **state) {
  enum { PIECES = 1000 };
  const int128 one = (int128)3 << 90, from = (int128)2 << 90;
  struct edge_intervals intervals = {0};
  struct map map;
  uint64_t r = 5;
  int piece[PIECES];
  (void)state;
  map_init(&map);
  assert_true(edge_intervals_open_map(&map, 1));
  edge_intervals_start(&intervals);
  for (int k = 0; k < PIECES; k++) {
    int other = exact_random_below(&r, k + 1);
    piece[k] = piece[other];
    piece[other] = k;
  }
  for (int i = 0; i < PIECES; i++) {
    int128 at = from + 3 * piece[i];
    struct occluded_interval part = {{at, one}, {at + 3, one}, OCCLUDED_BOTH};
    if (piece[i] % 10 != 5)
      assert_true(edge_intervals_occlude(&intervals, part));
  }
  assert_true(edge_intervals_store(&intervals, 0, &map));
  assert_int_equal(map.mixed.item[0].count, PIECES / 10 + 2);
  for (int k = 0; k < PIECES / 10; k++) {
    const struct map_interval *visible = &map.interval.item[k + 1];
    int128 at = from + 3 * (10 * k + 5);
    assert_int_equal(ratio_compare(visible->t0, (struct ratio){at, one}), 0);
    assert_int_equal(ratio_compare(visible->t1, (struct ratio){at + 3, one}),
                     0);
  }
  map_fini(&map);
  edge_intervals_fini(&intervals);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_hidden_is_visible),
      cmocka_unit_test(one_side_covered_is_visible),
      cmocka_unit_test(each_side_covered_by_another_is_hidden),
      cmocka_unit_test(a_visible_piece_without_length_is_none),
      cmocka_unit_test(whole_occlusion_ends_the_query),
      cmocka_unit_test(the_order_of_pieces_does_not_matter),
      cmocka_unit_test(many_starts_that_doubles_do_not_tell_apart_are_ordered),
      cmocka_unit_test(visible_is_what_is_not_hidden_on_both_sides),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
