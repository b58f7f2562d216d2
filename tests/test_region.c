/* test_region.c - the union of pieces has a canonical form, independent of the
 * pieces. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"
#include "geom/region.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Pieces, and the memory for what they are made of. */
struct mosaic {
  geom_pieces piece;
  struct arena arena;
};

static void mosaic_fini(struct mosaic *m) {
  ARRAY_FREE(&m->piece);
  arena_fini(&m->arena);
}

static void *take(struct mosaic *m, size_t count, size_t size) {
  void *block = arena_alloc(&m->arena, count, size);
  assert_non_null(block);
  return block;
}

/* Adds a convex polygon of up to 8 counter-clockwise corners. */
static void add_polygon(struct mosaic *m, const int xy[][2], int count) {
  struct geom_line *line = take(m, 8, sizeof *line);
  struct geom_convex piece;
  struct geom_point p[8];
  for (int k = 0; k < count; k++)
    p[k] = (struct geom_point){xy[k][0], xy[k][1], 0};
  for (int k = 0; k < count; k++)
    geom_line_through(&line[k], p[k], p[(k + 1) % count]);
  piece.count = (uint32_t)count;
  piece.corner = take(m, 8, sizeof *piece.corner);
  piece.side = take(m, 8, sizeof *piece.side);
  piece.x0 = piece.y0 = -1e9;
  piece.x1 = piece.y1 = 1e9;
  for (int k = 0; k < count; k++) {
    piece.corner[k] = geom_corner_at(p[k]);
    piece.side[k] = &line[k];
  }
  assert_true(ARRAY_PUSH(&m->piece, piece));
}

static void add_triangle(struct mosaic *m, int ax, int ay, int bx, int by,
                         int cx, int cy) {
  const int xy[3][2] = {{ax, ay}, {bx, by}, {cx, cy}};
  add_polygon(m, xy, 3);
}

static void add_box(struct mosaic *m, int x0, int y0, int x1, int y1) {
  const int xy[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  add_polygon(m, xy, 4);
}

/* Adds a box less a convex polygon within it. */
static void add_box_around(struct mosaic *m, int x0, int y0, int x1, int y1,
                           const int hole[][2], int count) {
  struct geom_line *line = take(m, 16, sizeof *line);
  struct geom_convex box;
  add_box(m, x0, y0, x1, y1);
  box = m->piece.item[--m->piece.count];
  for (int k = 0; k < count; k++) {
    const int *p = hole[k], *q = hole[(k + 1) % count];
    geom_line_through(&line[k], (struct geom_point){p[0], p[1], 0},
                      (struct geom_point){q[0], q[1], 0});
    line[8 + k] = geom_line_reversed(&line[k]);
  }
  assert_true(geom_convex_subtract(&box, line, line + 8, count, &m->piece, NULL,
                                   &m->arena));
}

/* ---- What holds of every region ------------------------------------------ */

static const struct geom_region_side *sides(const struct geom_region *region,
                                            size_t loop) {
  return &region->side.item[region->loop.item[loop].side];
}

/* Does the line run from left to right, or straight up? */
static bool runs_forward(const struct geom_line *line) {
  return line->b > 0 || (line->b == 0 && line->a < 0);
}

/* Each side runs on its line from its corner to the next, and turns there. */
static void check_loop(const struct geom_region *region, size_t l) {
  const struct geom_region_side *side = sides(region, l);
  uint32_t n = region->loop.item[l].count;
  mpq_t area2;
  assert_true(n >= 3);
  for (uint32_t k = 0; k < n; k++) {
    const struct geom_region_side *next = &side[(k + 1) % n];
    int order = geom_corner_compare(&side[k].corner, &next->corner);
    assert_int_not_equal(order, 0);
    assert_int_equal(geom_line_side(side[k].line, &side[k].corner), 0);
    assert_int_equal(geom_line_side(side[k].line, &next->corner), 0);
    assert_int_equal(runs_forward(side[k].line), order < 0);
    assert_int_not_equal(geom_line_turn(side[k].line, next->line), 0);
    assert_true(geom_corner_compare(&side[0].corner, &side[k].corner) <= 0);
    if (k > 0 && geom_corner_compare(&side[0].corner, &side[k].corner) == 0)
      assert_true(geom_corner_compare(&side[1].corner, &next->corner) < 0);
  }
  mpq_init(area2);
  rational_add_loop(area2, region, l);
  assert_int_equal(mpq_sgn(area2), region->loop.item[l].hole ? -1 : 1);
  mpq_clear(area2);
}

/* Outers by their first corners; each is followed by its holes, likewise. */
static void check_order(const struct geom_region *region) {
  size_t outer = 0;
  for (size_t l = 0; l < region->loop.count; l++) {
    bool hole = region->loop.item[l].hole;
    size_t before = hole && l > outer + 1 ? l - 1 : outer;
    if (l == 0)
      assert_false(hole);
    if (l > 0 && (!hole || l > outer + 1)) {
      const struct geom_region_side *p = sides(region, before),
                                    *q = sides(region, l);
      int order = geom_corner_compare(&p->corner, &q->corner);
      assert_true(
          order < 0 ||
          (order == 0 && geom_corner_compare(&p[1].corner, &q[1].corner) < 0));
    }
    if (!hole)
      outer = l;
  }
}

/* How often a loop goes round a point that is on none of its sides. */
static int winding(const struct geom_region *region, size_t l,
                   const struct rational_point *p) {
  const struct geom_region_side *side = sides(region, l);
  uint32_t n = region->loop.item[l].count;
  struct rational_point from, to;
  mpq_t x, slope;
  int turns = 0;
  mpq_inits(x, slope, NULL);
  rational_point_init(&from);
  rational_point_init(&to);
  rational_point_at_corner(&from, &side[n - 1].corner);
  for (uint32_t k = 0; k < n; k++) {
    bool above, next_above;
    rational_point_at_corner(&to, &side[k].corner);
    above = mpq_cmp(from.y, p->y) > 0;
    next_above = mpq_cmp(to.y, p->y) > 0;
    if (above != next_above) { /* does it cross right of p? */
      mpq_sub(slope, to.x, from.x);
      mpq_sub(x, to.y, from.y);
      mpq_div(slope, slope, x);
      mpq_sub(x, p->y, from.y);
      mpq_mul(x, x, slope);
      mpq_add(x, x, from.x);
      if (mpq_cmp(x, p->x) > 0)
        turns += next_above ? 1 : -1;
    }
    mpq_set(from.x, to.x);
    mpq_set(from.y, to.y);
  }
  rational_point_clear(&from);
  rational_point_clear(&to);
  mpq_clears(x, slope, NULL);
  return turns;
}

static bool inside_piece(const struct geom_convex *piece,
                         const struct rational_point *p) {
  struct rational_line line;
  bool inside = true;
  rational_line_init(&line);
  for (uint32_t k = 0; k < piece->count && inside; k++) {
    const struct geom_line *l = piece->side[k];
    rational_line_through(&line, (struct geom_point){l->x0, l->y0, 0},
                          (struct geom_point){l->x1, l->y1, 0});
    inside = rational_line_side(&line, p) > 0;
  }
  rational_line_clear(&line);
  return inside;
}

/* A number between 0 and `size` that is not whole, of a prime denominator, so
 * that two of them are on no line of the lattice. */
static void set_between(mpq_t to, uint64_t *r, int size, int prime) {
  int whole = exact_random_below(r, size);
  mpq_set_si(to, whole * prime + 1 + exact_random_below(r, prime - 1),
             (unsigned long)prime);
}

/* Each outer with its holes goes round a point once or not at all, and round
 * the points of the pieces alone.  The pieces' sides are grid lines. */
static void check_samples(const struct geom_region *region,
                          const struct mosaic *m, int size, uint64_t *r) {
  enum { SAMPLES = 12 };
  struct rational_point p;
  rational_point_init(&p);
  for (int i = 0; i < SAMPLES; i++) {
    int covered = 0, round = 0, all = 0;
    set_between(p.x, r, size, 9973);
    set_between(p.y, r, size, 9967);
    for (size_t k = 0; k < m->piece.count; k++)
      covered += inside_piece(&m->piece.item[k], &p);
    for (size_t l = 0; l < region->loop.count; l++) {
      if (!region->loop.item[l].hole)
        round = 0;
      round += winding(region, l, &p);
      all += winding(region, l, &p);
      if (l + 1 == region->loop.count || !region->loop.item[l + 1].hole)
        assert_in_range(round, 0, 1);
    }
    assert_int_equal(all, covered);
  }
  rational_point_clear(&p);
}

static void sum_loops(const struct geom_region *region, mpq_t sum) {
  mpq_set_ui(sum, 0, 1);
  for (size_t l = 0; l < region->loop.count; l++)
    rational_add_loop(sum, region, l);
}

static void check_area(const struct geom_region *region,
                       const struct mosaic *m) {
  mpq_t sum, want;
  mpq_inits(sum, want, NULL);
  sum_loops(region, sum);
  for (size_t k = 0; k < m->piece.count; k++)
    rational_add_area2(want, &m->piece.item[k]);
  assert_true(mpq_equal(sum, want));
  mpq_clears(sum, want, NULL);
}

static void check_region(const struct geom_region *region,
                         const struct mosaic *m) {
  check_area(region, m);
  for (size_t l = 0; l < region->loop.count; l++)
    check_loop(region, l);
  check_order(region);
}

static void unite(struct geom_region *region, const struct mosaic *m) {
  assert_true(geom_region_unite(region, m->piece.item, m->piece.count));
  check_region(region, m);
}

static void assert_same_region(const struct geom_region *a,
                               const struct geom_region *b) {
  assert_int_equal(a->loop.count, b->loop.count);
  assert_int_equal(a->side.count, b->side.count);
  for (size_t l = 0; l < a->loop.count; l++) {
    const struct geom_region_side *p = sides(a, l), *q = sides(b, l);
    assert_int_equal(a->loop.item[l].count, b->loop.item[l].count);
    assert_int_equal(a->loop.item[l].hole, b->loop.item[l].hole);
    for (uint32_t k = 0; k < a->loop.item[l].count; k++) {
      assert_int_equal(geom_corner_compare(&p[k].corner, &q[k].corner), 0);
      assert_int_equal(geom_line_turn(p[k].line, q[k].line), 0);
      assert_int_equal(geom_line_along(p[k].line, q[k].line), 1);
    }
  }
}

/* ---- Cutting up ---------------------------------------------------------- */

/* Splits all pieces by a line. */
static void cut_by(struct mosaic *m, const struct geom_line *cut) {
  size_t n = m->piece.count;
  struct geom_line *line = take(m, 2, sizeof *line);
  line[0] = line[1] = *cut;
  line[1] = geom_line_reversed(&line[1]);
  for (size_t k = 0; k < n; k++) {
    struct geom_convex left, right;
    assert_true(geom_convex_split(&m->piece.item[k], &line[0], &line[1], &left,
                                  &right, &m->arena));
    m->piece.item[k] = left.count > 0 ? left : right;
    if (left.count > 0 && right.count > 0)
      assert_true(ARRAY_PUSH(&m->piece, right));
  }
}

static struct geom_point lattice_point(uint64_t *r, int size) {
  return (struct geom_point){exact_random_below(r, size + 1),
                             exact_random_below(r, size + 1),
                             exact_random_below(r, 50)};
}

/* A random line through lattice points, or where two planes cross. */
static bool random_cut(uint64_t *r, int size, struct geom_line *line) {
  struct geom_plane plane[2];
  for (int i = 0; i < 2; i++) {
    struct geom_point p[3];
    for (int k = 0; k < 3; k++)
      p[k] = lattice_point(r, size);
    if (i == 0 && exact_random_below(r, 2)) {
      if (p[0].x == p[1].x && p[0].y == p[1].y)
        return false;
      geom_line_through(line, p[0], p[1]);
      return true;
    }
    if (geom_orient2d(p[0], p[1], p[2]) <= 0)
      return false;
    plane[i] = geom_plane_of(p[0], p[1], p[2]);
  }
  return geom_line_between(line, &plane[0], &plane[1]) == 0;
}

static void shuffle(struct mosaic *m, uint64_t *r) {
  for (size_t k = m->piece.count; k > 1; k--) {
    size_t other = (size_t)exact_random_below(r, (int)k);
    struct geom_convex swap = m->piece.item[k - 1];
    m->piece.item[k - 1] = m->piece.item[other];
    m->piece.item[other] = swap;
  }
}

/* Random parts of a lattice whose squares are cut in up to four. */
static void random_mosaic(struct mosaic *m, uint64_t *r, int size) {
  int fill = 2 + exact_random_below(r, 5);
  for (int y = 0; y < size; y++)
    for (int x = 0; x < size; x++) {
      int a = 2 * x, b = 2 * y, c = a + 2, d = b + 2;
      if (exact_random_below(r, 3) == 0) {
        if (exact_random_below(r, 8) < fill)
          add_box(m, a, b, c, d);
        continue;
      }
      if (exact_random_below(r, 8) < fill)
        add_triangle(m, a, b, c, b, a + 1, b + 1);
      if (exact_random_below(r, 8) < fill)
        add_triangle(m, c, b, c, d, a + 1, b + 1);
      if (exact_random_below(r, 8) < fill)
        add_triangle(m, c, d, a, d, a + 1, b + 1);
      if (exact_random_below(r, 8) < fill)
        add_triangle(m, a, d, a, b, a + 1, b + 1);
    }
}

static void random_regions_are_right(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 1500; seed++) {
    uint64_t r = seed;
    struct mosaic m = {0};
    struct geom_region region = {0};
    int size = 2 + exact_random_below(&r, 5);
    random_mosaic(&m, &r, size);
    unite(&region, &m);
    check_samples(&region, &m, 2 * size, &r);
    mosaic_fini(&m);
    geom_region_fini(&region);
  }
}

static void the_form_depends_on_the_union_alone(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 600; seed++) {
    struct geom_region region[2] = {0};
    struct mosaic m[2] = {0};
    uint64_t r;
    for (int i = 0; i < 2; i++) {
      struct geom_line line;
      int size, cuts;
      r = seed;
      size = 2 + exact_random_below(&r, 4);
      random_mosaic(&m[i], &r, size);
      r += (uint64_t)i;
      cuts = exact_random_below(&r, 4) * i;
      for (int k = 0; k < cuts;)
        if (random_cut(&r, 2 * size, &line)) {
          cut_by(&m[i], &line);
          k++;
        }
      if (i == 1)
        shuffle(&m[i], &r);
      unite(&region[i], &m[i]);
    }
    assert_same_region(&region[0], &region[1]);
    for (int i = 0; i < 2; i++) {
      geom_region_fini(&region[i]);
      mosaic_fini(&m[i]);
    }
  }
}

/* ---- Known regions ------------------------------------------------------- */

/* Asserts the corners of a loop. */
static void assert_corners(const struct geom_region *region, size_t l,
                           const int xy[][2], uint32_t count) {
  const struct geom_region_side *side = sides(region, l);
  assert_int_equal(region->loop.item[l].count, count);
  for (uint32_t k = 0; k < count; k++) {
    struct geom_corner want =
        geom_corner_at((struct geom_point){xy[k][0], xy[k][1], 0});
    assert_int_equal(geom_corner_compare(&side[k].corner, &want), 0);
  }
}

#define ASSERT_CORNERS(region, l, ...)                                         \
  do {                                                                         \
    static const int xy[][2] = __VA_ARGS__;                                    \
    assert_corners(region, l, xy, sizeof xy / sizeof *xy);                     \
  } while (0)

static void nothing_has_no_loops(void **state) {
  struct geom_region region = {0};
  (void)state;
  assert_true(geom_region_unite(&region, NULL, 0));
  assert_int_equal(region.loop.count, 0);
  assert_int_equal(region.side.count, 0);
  geom_region_fini(&region);
}

static void collinear_sides_become_one(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_triangle(&m, 0, 0, 2, 0, 2, 2);
  add_triangle(&m, 0, 0, 2, 2, 0, 2);
  add_box(&m, 2, 0, 5, 1);
  add_box(&m, 2, 1, 5, 2);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 1);
  ASSERT_CORNERS(&region, 0, {{0, 0}, {5, 0}, {5, 2}, {0, 2}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

/* A frame from (x, y) of outer side 6 s and inner side 2 s. */
static void add_frame(struct mosaic *m, int x, int y, int s) {
  add_box(m, x, y, x + 6 * s, y + 2 * s);
  add_box(m, x, y + 4 * s, x + 6 * s, y + 6 * s);
  add_box(m, x, y + 2 * s, x + 2 * s, y + 4 * s);
  add_box(m, x + 4 * s, y + 2 * s, x + 6 * s, y + 4 * s);
}

static void a_hole_runs_clockwise(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_frame(&m, 0, 0, 1);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 2);
  ASSERT_CORNERS(&region, 0, {{0, 0}, {6, 0}, {6, 6}, {0, 6}});
  ASSERT_CORNERS(&region, 1, {{2, 2}, {2, 4}, {4, 4}, {4, 2}});
  assert_true(region.loop.item[1].hole);
  mosaic_fini(&m);
  geom_region_fini(&region);
}

static void islands_in_holes_are_outers_of_their_own(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_frame(&m, 0, 0, 27);
  add_frame(&m, 63, 63, 6);
  add_frame(&m, 78, 78, 1);
  add_frame(&m, 200, 0, 1);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 8);
  for (size_t l = 0; l < 8; l++)
    assert_int_equal(region.loop.item[l].hole, l % 2);
  ASSERT_CORNERS(&region, 3, {{75, 75}, {75, 87}, {87, 87}, {87, 75}});
  ASSERT_CORNERS(&region, 5, {{80, 80}, {80, 82}, {82, 82}, {82, 80}});
  ASSERT_CORNERS(&region, 7, {{202, 2}, {202, 4}, {204, 4}, {204, 2}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

static void boxes_that_touch_at_a_corner_stay_apart(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_box(&m, 0, 0, 2, 2);
  add_box(&m, 2, 2, 4, 4);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 2);
  ASSERT_CORNERS(&region, 0, {{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  ASSERT_CORNERS(&region, 1, {{2, 2}, {4, 2}, {4, 4}, {2, 4}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

static void holes_that_touch_at_a_corner_are_one(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 4; x++)
      if (!(x == y && (x == 1 || x == 2)))
        add_box(&m, x, y, x + 1, y + 1);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 2);
  ASSERT_CORNERS(
      &region, 1,
      {{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 2}, {2, 2}, {2, 1}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

static void a_hole_at_the_outline_s_corner_joins_it(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  /* A square of side 6 less the triangle (0, 0) (4, 2) (2, 4). */
  add_triangle(&m, 0, 0, 6, 0, 4, 2);
  add_triangle(&m, 6, 0, 6, 6, 4, 2);
  add_triangle(&m, 4, 2, 6, 6, 2, 4);
  add_triangle(&m, 2, 4, 6, 6, 0, 6);
  add_triangle(&m, 0, 0, 2, 4, 0, 6);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 1);
  ASSERT_CORNERS(&region, 0,
                 {{0, 0}, {2, 4}, {4, 2}, {0, 0}, {6, 0}, {6, 6}, {0, 6}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

/* The hole's tip is in the middle of a side, which turns away there. */
static void a_hole_at_a_side_joins_the_outline(void **state) {
  static const int hole[][2] = {{4, 0}, {6, 4}, {2, 4}};
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_box_around(&m, 0, 0, 8, 8, hole, 3);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 1);
  ASSERT_CORNERS(
      &region, 0,
      {{0, 0}, {4, 0}, {2, 4}, {6, 4}, {4, 0}, {8, 0}, {8, 8}, {0, 8}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

/* Two stand on one line, and a third hangs below where they touch: walking
 * straight on along that line would lead from one to the other. */
static void triangles_that_touch_on_a_line_stay_apart(void **state) {
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_triangle(&m, 0, 4, 4, 4, 2, 8);
  add_triangle(&m, 4, 4, 8, 4, 6, 8);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 2);
  ASSERT_CORNERS(&region, 0, {{0, 4}, {4, 4}, {2, 8}});
  ASSERT_CORNERS(&region, 1, {{4, 4}, {8, 4}, {6, 8}});
  add_triangle(&m, 4, 4, 2, 0, 6, 0);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 3);
  ASSERT_CORNERS(&region, 1, {{2, 0}, {6, 0}, {4, 4}});
  mosaic_fini(&m);
  geom_region_fini(&region);
}

/* The star touches the hole with each of the hole's corners and comes before
 * it in order. */
static void a_hole_does_not_belong_to_the_island_in_it(void **state) {
  static const int hole[][2] = {{4, 8}, {14, 4}, {14, 12}};
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_triangle(&m, 4, 8, 8, 7, 8, 9);
  add_triangle(&m, 8, 7, 12, 8, 8, 9);
  add_triangle(&m, 8, 7, 14, 4, 12, 8);
  add_triangle(&m, 12, 8, 14, 12, 8, 9);
  add_box_around(&m, 0, 0, 20, 16, hole, 3);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 3);
  ASSERT_CORNERS(&region, 0, {{0, 0}, {20, 0}, {20, 16}, {0, 16}});
  ASSERT_CORNERS(&region, 1, {{4, 8}, {14, 12}, {14, 4}});
  ASSERT_CORNERS(&region, 2,
                 {{4, 8}, {8, 7}, {14, 4}, {12, 8}, {14, 12}, {8, 9}});
  assert_true(region.loop.item[1].hole && !region.loop.item[2].hole);
  mosaic_fini(&m);
  geom_region_fini(&region);
}

/* Its tip reaches the hole's first corner, and the visit that comes first in
 * order turns left. */
static void a_hole_pinched_by_a_spit_is_still_a_hole(void **state) {
  static const int hole[][2] = {{10, 10}, {18, 2}, {26, 10}, {18, 18}};
  static const int spit[][2] = {{10, 10}, {14, 8}, {22, 6}, {26, 10}, {22, 14}};
  struct mosaic m = {0};
  struct geom_region region = {0};
  (void)state;
  add_box_around(&m, 0, 0, 40, 20, hole, 4);
  add_polygon(&m, spit, 5);
  unite(&region, &m);
  assert_int_equal(region.loop.count, 2);
  ASSERT_CORNERS(
      &region, 1,
      {{10, 10}, {14, 8}, {22, 6}, {18, 2}, {10, 10}, {18, 18}, {22, 14}});
  assert_true(region.loop.item[1].hole);
  mosaic_fini(&m);
  geom_region_fini(&region);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_has_no_loops),
      cmocka_unit_test(collinear_sides_become_one),
      cmocka_unit_test(a_hole_runs_clockwise),
      cmocka_unit_test(islands_in_holes_are_outers_of_their_own),
      cmocka_unit_test(boxes_that_touch_at_a_corner_stay_apart),
      cmocka_unit_test(holes_that_touch_at_a_corner_are_one),
      cmocka_unit_test(a_hole_at_the_outline_s_corner_joins_it),
      cmocka_unit_test(a_hole_at_a_side_joins_the_outline),
      cmocka_unit_test(triangles_that_touch_on_a_line_stay_apart),
      cmocka_unit_test(a_hole_does_not_belong_to_the_island_in_it),
      cmocka_unit_test(a_hole_pinched_by_a_spit_is_still_a_hole),
      cmocka_unit_test(random_regions_are_right),
      cmocka_unit_test(the_form_depends_on_the_union_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
