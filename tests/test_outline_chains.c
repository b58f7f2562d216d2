/* test_outline_chains.c - outlines are linked as a search of all of them says,
 * in work that is near linear also where very many meet at a point. */
#include "visibility/fold/outline_chains.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "exact_fixture/scene.h"

static void add_outline(struct zero_set *set, struct geom_point p,
                        struct geom_point q) {
  struct contour_outline made = {.image = {p, q}};
  assert_true(ARRAY_PUSH(&set->outline, made));
}

static struct geom_point random_place(uint64_t *r, int32_t span) {
  int32_t most = 2 * span + 1;
  int32_t x = (int32_t)exact_random_below(r, most) - span;
  int32_t y = (int32_t)exact_random_below(r, most) - span;
  return (struct geom_point){x, y, (int64_t)exact_random_below(r, 2)};
}

/* Outlines that begin or end at one of a few points. */
static void make_outlines(struct zero_set *set, uint64_t *r, uint32_t count,
                          uint32_t points, int32_t span) {
  struct geom_point hub[4];
  *set = (struct zero_set){.node = {0}};
  for (uint32_t k = 0; k < points; k++)
    hub[k] = random_place(r, 2);
  for (uint32_t i = 0; i < count; i++) {
    struct geom_point p = hub[exact_random_below(r, (int)points)];
    struct geom_point q = random_place(r, span);
    if (exact_random_below(r, 2) == 0)
      add_outline(set, p, q);
    else
      add_outline(set, q, p);
  }
}

static bool is_same_place(struct geom_point p, struct geom_point q) {
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

static double cosine_of_turn(struct geom_segment a, struct geom_segment b) {
  double ax = (double)a.q.x - a.p.x, ay = (double)a.q.y - a.p.y;
  double bx = (double)b.q.x - b.p.x, by = (double)b.q.y - b.p.y;
  double size = hypot(ax, ay) * hypot(bx, by);
  return size > 0 ? (ax * bx + ay * by) / size : 0;
}

/* The least turn to an outline that no earlier one leads to. */
static double least_turn(const struct zero_set *set, const uint8_t *is_led_to,
                         size_t from, uint32_t *first) {
  struct geom_segment own = set->outline.item[from].image;
  double most = -INFINITY;
  *first = SHEET_NONE;
  for (uint32_t to = 0; to < set->outline.count; to++) {
    struct geom_segment other = set->outline.item[to].image;
    if (to == from || is_led_to[to] || !is_same_place(own.q, other.p) ||
        cosine_of_turn(own, other) <= most)
      continue;
    most = cosine_of_turn(own, other);
    *first = to;
  }
  return most;
}

/* In their order, each one leads to that to which it turns least; where few
 * meet, to the first of several such ones, whatever rounding says. */
static void check_links(const struct zero_set *set,
                        const struct outline_chains *chains) {
  size_t count = set->outline.count;
  uint8_t *is_led_to = mem_calloc(count, 1);
  for (size_t i = 0; i < count; i++) {
    struct geom_segment own = set->outline.item[i].image;
    uint32_t to = chains->next[i], first;
    double most = least_turn(set, is_led_to, i, &first);
    assert_true((to == SHEET_NONE) == (first == SHEET_NONE));
    if (to == SHEET_NONE)
      continue;
    struct geom_segment other = set->outline.item[to].image;
    assert_true(to != i && !is_led_to[to] && is_same_place(own.q, other.p));
    assert_true(cosine_of_turn(own, other) >= most - 1e-12);
    if (count < 32)
      assert_int_equal(to, first);
    is_led_to[to] = 1;
  }
  for (size_t i = 0; i < count; i++)
    assert_int_equal(chains->is_led_to[i], is_led_to[i]);
  mem_free(is_led_to);
}

static void each_outline_leads_to_that_to_which_it_turns_least(void **state) {
  (void)state;
  static const int32_t span[] = {1, 3, 20, 1 << 28};
  uint64_t r = 5;
  for (int trial = 0; trial < 300; trial++) {
    struct zero_set set;
    struct outline_chains chains = {.compared = 0};
    make_outlines(&set, &r,
                  1 + (uint32_t)exact_random_below(&r, trial % 2 ? 40 : 300),
                  1 + (uint32_t)exact_random_below(&r, 4), span[trial % 4]);
    assert_true(outline_chains_link(&chains, &set));
    check_links(&set, &chains);
    outline_chains_fini(&chains);
    ARRAY_FREE(&set.outline);
  }
}

/* In any direction, in few of them, in one, and within a
 * narrow angle. */
static void outlines_at_one_point_are_linked_in_linear_work(void **state) {
  (void)state;
  enum { OUTLINES = 20000 };
  const struct geom_point hub = {0, 0, 0};
  for (int kind = 0; kind < 4; kind++) {
    struct zero_set set = {.node = {0}};
    struct outline_chains chains = {.compared = 0};
    uint64_t r = 7;
    for (uint32_t i = 0; i < OUTLINES; i++) {
      struct geom_point q = random_place(&r, kind == 1 ? 3 : 1 << 28);
      if (kind == 2)
        q.y = 0, q.x = 5;
      if (kind == 3)
        q.x = 1 << 28, q.y %= OUTLINES;
      if (i % 2 == 0)
        add_outline(&set, hub, q);
      else
        add_outline(&set, (struct geom_point){-q.x, -q.y, 0}, hub);
    }
    assert_true(outline_chains_link(&chains, &set));
    assert_in_range(chains.compared, OUTLINES / 2, 3 * OUTLINES);
    outline_chains_fini(&chains);
    ARRAY_FREE(&set.outline);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_outline_leads_to_that_to_which_it_turns_least),
      cmocka_unit_test(outlines_at_one_point_are_linked_in_linear_work),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
