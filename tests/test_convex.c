/* test_convex.c - convex polygons of the page, split and subtracted exactly. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define XY_MAX ((1 << 30) - 1)

enum { ROUNDS = 10000 };

/* ---- Random input -------------------------------------------------------- */

static struct geom_point point(uint64_t *r, int size) {
  struct geom_point p = {exact_random_below(r, size) * 2 - size,
                         exact_random_below(r, size) * 2 - size,
                         exact_random_below(r, 1 << 20)};
  if (size == XY_MAX) { /* at the ends of the range, or next to them */
    if (exact_random_below(r, 3) == 0)
      p.x = XY_MAX - exact_random_below(r, 3);
    if (exact_random_below(r, 3) == 0)
      p.x = exact_random_below(r, 3) - XY_MAX;
    if (exact_random_below(r, 3) == 0)
      p.y = XY_MAX - exact_random_below(r, 3);
    if (exact_random_below(r, 3) == 0)
      p.y = exact_random_below(r, 3) - XY_MAX;
  }
  return p;
}

static int size_of_scene(uint64_t *r) {
  static const int size[] = {3, 5, 1000, XY_MAX};
  return size[exact_random_below(r, 4)];
}

static void triangle(uint64_t *r, int size, struct geom_point p[3]) {
  do {
    for (int k = 0; k < 3; k++)
      p[k] = point(r, size);
  } while (!exact_turn_triangle(p));
}

static void *take(struct arena *arena, size_t count, size_t size) {
  void *block = arena_alloc(arena, count, size);
  assert_non_null(block);
  return block;
}

/* The lines of a triangle's sides and the same turned round: 6 of them. */
static struct geom_line *lines_of(const struct geom_point p[3],
                                  struct arena *arena) {
  struct geom_line *line = take(arena, 6, sizeof *line);
  for (int k = 0; k < 3; k++) {
    geom_line_through(&line[k], p[k], p[(k + 1) % 3]);
    line[3 + k] = geom_line_reversed(&line[k]);
  }
  return line;
}

static struct geom_convex piece_of(const struct geom_point p[3],
                                   struct arena *arena) {
  struct geom_convex piece;
  assert_true(geom_convex_triangle(&piece, p, lines_of(p, arena), arena));
  return piece;
}

/* A line and its back: through points, along a side or through a corner of
 * the piece, or where two planes cross. */
static struct geom_line *random_line(uint64_t *r, int size,
                                     const struct geom_convex *piece,
                                     struct arena *arena) {
  struct geom_line *line = take(arena, 2, sizeof *line);
  struct geom_point f[3], g[3];
  triangle(r, size, f);
  triangle(r, size, g);
  geom_line_through(&line[0], f[0], f[1]);
  switch (exact_random_below(r, 4)) {
  case 0: {
    struct geom_plane front = geom_plane_of(f[0], f[1], f[2]),
                      back = geom_plane_of(g[0], g[1], g[2]);
    struct geom_line wide;
    if (geom_line_between(&wide, &front, &back) == 0)
      line[0] = wide;
    break;
  }
  case 1: {
    const struct geom_corner *c =
        &piece->corner[exact_random_below(r, (int)piece->count)];
    if (c->l1 == NULL && (c->ix != f[1].x || c->iy != f[1].y))
      geom_line_through(&line[0], (struct geom_point){c->ix, c->iy, 0}, f[1]);
    break;
  }
  case 2:
    line[0] = *piece->side[exact_random_below(r, (int)piece->count)];
    break;
  default:
    break;
  }
  if (exact_random_below(r, 2))
    line[0] = geom_line_reversed(&line[0]);
  line[1] = geom_line_reversed(&line[0]);
  return line;
}

/* A triangle after a few cuts. */
static struct geom_convex random_piece(uint64_t *r, int size,
                                       struct arena *arena) {
  struct geom_point p[3];
  struct geom_convex piece;
  int cuts = exact_random_below(r, 6);
  triangle(r, size, p);
  piece = piece_of(p, arena);
  for (int k = 0; k < cuts; k++) {
    struct geom_line *line = random_line(r, size, &piece, arena);
    struct geom_convex inside, outside;
    assert_true(
        geom_convex_split(&piece, line, line + 1, &inside, &outside, arena));
    piece = outside.count > inside.count ? outside : inside;
  }
  return piece;
}

/* ---- What holds of every piece ------------------------------------------- */

static void check_piece(const struct geom_convex *piece) {
  struct rational_point p;
  mpq_t bound;
  if (piece->count == 0)
    return;
  mpq_init(bound);
  rational_point_init(&p);
  assert_true(piece->count >= 3);
  for (uint32_t k = 0; k < piece->count; k++) {
    uint32_t next = (k + 1) % piece->count;
    const struct geom_corner *c = &piece->corner[k];
    /* Strictly convex, and its corners on its sides. */
    assert_int_equal(geom_line_turn(piece->side[k], piece->side[next]), 1);
    assert_int_equal(geom_line_side(piece->side[k], c), 0);
    assert_int_equal(geom_line_side(piece->side[k], &piece->corner[next]), 0);
    for (uint32_t i = 0; i < piece->count; i++)
      assert_int_equal(geom_line_side(piece->side[k], &piece->corner[i]),
                       i == k || i == next ? 0 : 1);
    /* The box is around it. */
    rational_point_at_corner(&p, c);
    mpq_set_d(bound, piece->x0);
    assert_true(mpq_cmp(bound, p.x) <= 0);
    mpq_set_d(bound, piece->x1);
    assert_true(mpq_cmp(p.x, bound) <= 0);
    mpq_set_d(bound, piece->y0);
    assert_true(mpq_cmp(bound, p.y) <= 0);
    mpq_set_d(bound, piece->y1);
    assert_true(mpq_cmp(p.y, bound) <= 0);
  }
  mpq_clear(bound);
  rational_point_clear(&p);
}

/* Are all corners left of the line or on it (way 1), or right of it (way
 * -1)? */
static bool lies(const struct geom_convex *piece, const struct geom_line *line,
                 int way) {
  for (uint32_t k = 0; k < piece->count; k++)
    if (geom_line_side(line, &piece->corner[k]) * way < 0)
      return false;
  return true;
}

/* Convex pieces are disjoint if and only if a side of one parts them. */
static bool are_disjoint(const struct geom_convex *p,
                         const struct geom_convex *q) {
  for (uint32_t k = 0; k < p->count; k++)
    if (lies(q, p->side[k], -1))
      return true;
  for (uint32_t k = 0; k < q->count; k++)
    if (lies(p, q->side[k], -1))
      return true;
  return false;
}

/* The areas of `count` parts make up that of the whole. */
static void check_sum(const struct geom_convex *whole,
                      const struct geom_convex *part, size_t count,
                      const struct geom_convex *more) {
  mpq_t sum, want;
  mpq_inits(sum, want, NULL);
  for (size_t k = 0; k < count; k++)
    rational_add_area2(sum, &part[k]);
  if (more->count > 0)
    rational_add_area2(sum, more);
  rational_area2(want, whole);
  assert_true(mpq_equal(sum, want));
  mpq_clears(sum, want, NULL);
}

static bool is_same_piece(const struct geom_convex *p,
                          const struct geom_convex *q) {
  return p->count == q->count && p->corner == q->corner && p->side == q->side;
}

/* ---- Splitting ----------------------------------------------------------- */

static void pieces_of_a_split_add_up_to_the_whole(void **state) {
  uint64_t r = 1;
  int proper = 0, touching = 0;
  struct arena arena = {0};
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    int size = size_of_scene(&r);
    struct geom_convex piece = random_piece(&r, size, &arena), part[2];
    struct geom_line *line = random_line(&r, size, &piece, &arena);
    check_piece(&piece);
    assert_true(
        geom_convex_split(&piece, line, line + 1, &part[0], &part[1], &arena));
    check_piece(&part[0]);
    check_piece(&part[1]);
    assert_true(lies(&part[0], line, 1) && lies(&part[1], line, -1));
    check_sum(&piece, part, 2, &(struct geom_convex){0});
    if (part[0].count > 0 && part[1].count > 0) {
      proper++;
      touching += part[0].count + part[1].count < piece.count + 4;
    } else {
      assert_true(is_same_piece(&piece, &part[part[0].count == 0]));
    }
    arena_reset(&arena);
  }
  assert_true(proper > ROUNDS / 8 && touching > ROUNDS / 64);
  arena_fini(&arena);
}

static void either_piece_of_a_split_may_be_requested_alone(void **state) {
  uint64_t r = 2;
  struct arena arena = {0};
  (void)state;
  for (int i = 0; i < 500; i++) {
    int size = size_of_scene(&r);
    struct geom_convex piece = random_piece(&r, size, &arena), both[2], one[2];
    struct geom_line *line = random_line(&r, size, &piece, &arena);
    assert_true(
        geom_convex_split(&piece, line, line + 1, &both[0], &both[1], &arena));
    assert_true(
        geom_convex_split(&piece, line, line + 1, &one[0], NULL, &arena));
    assert_true(
        geom_convex_split(&piece, line, line + 1, NULL, &one[1], &arena));
    for (int k = 0; k < 2; k++) {
      assert_int_equal(one[k].count, both[k].count);
      for (uint32_t c = 0; c < one[k].count; c++)
        assert_int_equal(
            geom_corner_compare(&one[k].corner[c], &both[k].corner[c]), 0);
    }
    arena_reset(&arena);
  }
  arena_fini(&arena);
}

static void a_line_through_corners_makes_no_new_ones(void **state) {
  const struct geom_point square[4] = {
      {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const struct geom_point half[3] = {square[0], square[1], square[2]};
  struct geom_line diagonal[2], median[2];
  struct geom_convex piece, part[2];
  struct arena arena = {0};
  (void)state;
  geom_line_through(&diagonal[0], square[0], square[2]);
  geom_line_through(&median[0], square[1], (struct geom_point){2, 2, 0});
  diagonal[1] = geom_line_reversed(&diagonal[0]);
  median[1] = geom_line_reversed(&median[0]);
  piece = piece_of(half, &arena);
  /* Along a side: nothing is cut. */
  assert_true(geom_convex_split(&piece, diagonal, diagonal + 1, &part[0],
                                &part[1], &arena));
  assert_int_equal(part[0].count, 0);
  assert_true(is_same_piece(&part[1], &piece));
  /* Through a corner and across the opposite side: two triangles. */
  assert_true(geom_convex_split(&piece, median, median + 1, &part[0], &part[1],
                                &arena));
  assert_int_equal(part[0].count, 3);
  assert_int_equal(part[1].count, 3);
  /* Through a corner alone: nothing is cut. */
  geom_line_through(&median[0], square[1], (struct geom_point){8, 1, 0});
  median[1] = geom_line_reversed(&median[0]);
  assert_true(geom_convex_split(&piece, median, median + 1, &part[0], &part[1],
                                &arena));
  assert_true(is_same_piece(&part[0], &piece));
  assert_int_equal(part[1].count, 0);
  arena_fini(&arena);
}

/* More corners than the fixed scratch of the split holds. */
static void a_piece_may_have_many_corners(void **state) {
  enum { N = 100 };
  struct geom_convex piece, part[2];
  struct geom_point big[3] = {
      {-40000, -40000, 0}, {80000, -40000, 0}, {-40000, 80000, 0}};
  struct arena arena = {0};
  (void)state;
  piece = piece_of(big, &arena);
  for (int k = 0; k < N; k++) { /* tangents of the parabola y = x^2 */
    int x = k - N / 2;
    struct geom_line *line = take(&arena, 2, sizeof *line);
    geom_line_through(&line[0], (struct geom_point){x, x * x, 0},
                      (struct geom_point){x + 1, x * x + 2 * x, 0});
    line[1] = geom_line_reversed(&line[0]);
    assert_true(
        geom_convex_split(&piece, line, line + 1, &part[0], &part[1], &arena));
    check_sum(&piece, part, 2, &(struct geom_convex){0});
    piece = part[0];
  }
  assert_true(piece.count > N - 2);
  check_piece(&piece);
  arena_fini(&arena);
}

/* ---- Subtracting --------------------------------------------------------- */

static void what_is_left_and_what_is_common_make_up_the_whole(void **state) {
  uint64_t r = 3;
  int overlaps = 0, apart = 0;
  struct arena arena = {0};
  geom_pieces rest = {0};
  (void)state;
  for (int i = 0; i < ROUNDS / 2; i++) {
    int size = size_of_scene(&r), count = 3;
    struct geom_convex piece = random_piece(&r, size, &arena), inside;
    struct geom_line line[8], *cut;
    struct geom_point p[3];
    triangle(&r, size, p);
    memcpy(line, lines_of(p, &arena), 3 * sizeof *line);
    cut = random_line(&r, size, &piece, &arena);
    if (exact_random_below(&r, 2))
      line[count++] = cut[0];
    cut = take(&arena, 8, sizeof *cut);
    memcpy(cut, line, sizeof line);
    for (int k = 0; k < count; k++) {
      cut[count + k] = geom_line_reversed(&cut[k]);
    }
    rest.count = 0;
    assert_true(geom_convex_subtract(&piece, cut, cut + count, count, &rest,
                                     &inside, &arena));
    check_piece(&inside);
    check_sum(&piece, rest.item, rest.count, &inside);
    for (size_t k = 0; k < rest.count; k++) {
      check_piece(&rest.item[k]);
      for (size_t j = 0; j < k; j++)
        assert_true(are_disjoint(&rest.item[j], &rest.item[k]));
      if (inside.count > 0)
        assert_true(are_disjoint(&rest.item[k], &inside));
    }
    for (int k = 0; k < count; k++)
      assert_true(lies(&inside, &cut[k], 1));
    if (inside.count == 0) {
      assert_int_equal(rest.count, 1);
      assert_true(is_same_piece(&rest.item[0], &piece));
      apart++;
    } else {
      overlaps++;
    }
    arena_reset(&arena);
  }
  assert_true(overlaps > 100 && apart > 100);
  ARRAY_FREE(&rest);
  arena_fini(&arena);
}

static void a_piece_less_itself_is_nothing(void **state) {
  const struct geom_point p[3] = {{0, 0, 0}, {7, 1, 0}, {3, 9, 0}};
  struct arena arena = {0};
  struct geom_line *line = lines_of(p, &arena);
  struct geom_convex piece = piece_of(p, &arena), inside;
  geom_pieces rest = {0};
  (void)state;
  assert_true(
      geom_convex_subtract(&piece, line, line + 3, 3, &rest, &inside, &arena));
  assert_int_equal(rest.count, 0);
  assert_true(is_same_piece(&inside, &piece));
  ARRAY_FREE(&rest);
  arena_fini(&arena);
}

/* What only touches takes nothing and cuts nothing. */
static void neighbours_take_nothing_from_each_other(void **state) {
  static const struct geom_point p[3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
  static const struct geom_point other[][3] = {
      {{0, 0, 0}, {4, 4, 0}, {0, 4, 0}},    /* a whole side */
      {{1, 1, 0}, {3, 3, 0}, {1, 9, 0}},    /* within a side */
      {{-2, -2, 0}, {9, 9, 0}, {0, 9, 0}},  /* beyond a side */
      {{4, 4, 0}, {5, 5, 0}, {4, 6, 0}},    /* a corner */
      {{4, 2, 0}, {6, 1, 0}, {6, 3, 0}},    /* a corner within a side */
      {{9, 0, 0}, {12, 0, 0}, {12, 4, 0}}}; /* far away */
  struct arena arena = {0};
  geom_pieces rest = {0};
  (void)state;
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
    struct geom_convex piece = piece_of(p, &arena), inside;
    struct geom_line *line = lines_of(other[i], &arena);
    rest.count = 0;
    assert_true(geom_convex_subtract(&piece, line, line + 3, 3, &rest, &inside,
                                     &arena));
    assert_int_equal(rest.count, 1);
    assert_int_equal(inside.count, 0);
    assert_true(is_same_piece(&rest.item[0], &piece));
  }
  ARRAY_FREE(&rest);
  arena_fini(&arena);
}

/* ---- Copying ------------------------------------------------------------- */

static void a_copy_stands_alone(void **state) {
  uint64_t r = 4;
  struct arena arena = {0}, other = {0};
  (void)state;
  for (int i = 0; i < 500; i++) {
    int size = size_of_scene(&r);
    struct geom_convex piece = random_piece(&r, size, &arena), copy;
    mpq_t area[2];
    mpq_inits(area[0], area[1], NULL);
    rational_area2(area[0], &piece);
    assert_true(geom_convex_copy(&copy, &piece, &other));
    assert_int_equal(copy.count, piece.count);
    for (uint32_t k = 0; k < piece.count; k++)
      assert_int_equal(geom_corner_compare(&copy.corner[k], &piece.corner[k]),
                       0);
    arena_fini(&arena); /* what it was copied from is gone */
    check_piece(&copy);
    rational_area2(area[1], &copy);
    assert_true(mpq_equal(area[0], area[1]));
    mpq_clears(area[0], area[1], NULL);
    arena_reset(&other);
  }
  arena_fini(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pieces_of_a_split_add_up_to_the_whole),
      cmocka_unit_test(either_piece_of_a_split_may_be_requested_alone),
      cmocka_unit_test(a_line_through_corners_makes_no_new_ones),
      cmocka_unit_test(a_piece_may_have_many_corners),
      cmocka_unit_test(what_is_left_and_what_is_common_make_up_the_whole),
      cmocka_unit_test(a_piece_less_itself_is_nothing),
      cmocka_unit_test(neighbours_take_nothing_from_each_other),
      cmocka_unit_test(a_copy_stands_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
