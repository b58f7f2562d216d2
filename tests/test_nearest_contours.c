/* test_nearest_contours.c - the nearest contours are those that a comparison
 * with all of them finds, in work that does not follow how many there are. */
#include "visibility/fold/nearest_contours.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/tolerance.h"
#include "exact_fixture/scene.h"
#include "geom/nearest.h"

/* ---- Sheets -------------------------------------------------------------- */

static uint32_t add_point(struct sheet *sheet, int32_t x, int32_t y) {
  struct geom_point made = {x, y, 0};
  assert_true(ARRAY_PUSH(&sheet->point, made));
  return (uint32_t)sheet->point.count - 1;
}

static void add_edge(struct sheet *sheet, uint32_t p, uint32_t q,
                     unsigned edge_class) {
  struct sheet_edge made = {.point = {p, q}, .edge_class = (uint8_t)edge_class};
  assert_true(ARRAY_PUSH(&sheet->edge, made));
}

/* A sheet of lines and, after these, contours; all are visible, but for some
 * that `hidden` says. */
struct contour_sheet {
  struct sheet sheet;
  struct map map;
  struct nearest_contours nearest;
};

static void find_contours(struct contour_sheet *s, uint32_t first,
                          uint32_t first_point, uint64_t *hidden) {
  s->map = (struct map){.edge_count = s->sheet.edge.count};
  s->map.edge_state = mem_calloc(s->sheet.edge.count, 1);
  for (size_t i = 0; i < s->sheet.edge.count; i++)
    s->map.edge_state[i] = hidden != NULL && exact_random_below(hidden, 5) == 0
                               ? MAP_HIDDEN
                               : MAP_VISIBLE;
  s->nearest = (struct nearest_contours){.sheet = &s->sheet,
                                         .map = &s->map,
                                         .first = first,
                                         .cusps = s->nearest.cusps,
                                         .first_point = first_point};
  assert_true(nearest_contours_init(&s->nearest));
}

static void fini_contours(struct contour_sheet *s) {
  nearest_contours_fini(&s->nearest);
  mem_free(s->map.edge_state);
  exact_sheet_fini(&s->sheet);
}

static int32_t random_between(uint64_t *r, int32_t span) {
  return (int32_t)exact_random_below(r, 2 * span + 1) - span;
}

/* ---- The definition ------------------------------------------------------ */

struct all_compared {
  double any, loose;
  bool on_line;
};

static bool is_visible(const struct contour_sheet *s, size_t e) {
  return s->map.edge_state[e] != MAP_HIDDEN &&
         sheet_edge_is_drawn(&s->sheet, e);
}

static int count_ends(const struct contour_sheet *s, uint32_t point) {
  int count = 0;
  for (size_t e = s->nearest.first; e < s->sheet.edge.count; e++)
    if (is_visible(s, e))
      count += (s->sheet.edge.item[e].point[0] == point) +
               (s->sheet.edge.item[e].point[1] == point);
  return count;
}

/* How far a point is to the right of a line, and how far contours may be that
 * do not bulge. */
static double offset_to_right(struct geom_point at, struct geom_point p,
                              const double along[2]) {
  return along[1] * ((double)at.x - p.x) - along[0] * ((double)at.y - p.y);
}
#define HALF_A_MM 0x1p19

static void compare_edge(const struct contour_sheet *s, size_t e,
                         struct geom_point p, const double along[2],
                         struct all_compared *all) {
  const struct sheet_edge *edge = &s->sheet.edge.item[e];
  struct geom_segment of = sheet_ends(&s->sheet, edge->point);
  double x = (double)of.q.x - of.p.x, y = (double)of.q.y - of.p.y;
  double px = (double)p.x - of.p.x, py = (double)p.y - of.p.y;
  double t = geom_nearest_parameter(x, y, px, py);
  double away = hypot(px - t * x, py - t * y);
  if (e < s->nearest.first)
    all->on_line =
        all->on_line ||
        ((edge->edge_class & (RECTO_EDGE_CREASE | RECTO_EDGE_GROUP)) == 0 &&
         away <= TOLERANCE_COINCIDENT_UNITS);
  else if (x * along[0] + y * along[1] < -0.5 * hypot(x, y) ||
           fmin(offset_to_right(of.p, p, along),
                offset_to_right(of.q, p, along)) > HALF_A_MM)
    return;
  else if ((t == 0 || t == 1) && count_ends(s, edge->point[t > 0]) < 2)
    all->loose = fmin(all->loose, away);
  else
    all->any = fmin(all->any, away);
}

/* What is not nearer than the lesser of both distances need not be right. */
static void check_distances(const struct nearest_contour *found,
                            const struct all_compared *all, double radius) {
  double least = fmin(all->any, all->loose);
  if (least > radius) {
    assert_true(found->any > radius - 1e-6 && found->loose > radius - 1e-6);
    return;
  }
  assert_true(fabs(fmin(found->any, found->loose) - least) < 1e-6);
  assert_true(found->any >= all->any - 1e-6 &&
              found->loose >= all->loose - 1e-6);
  assert_true((all->any > least + 1e-6) == (found->any > least + 1e-6));
  assert_true((all->loose > least + 1e-6) == (found->loose > least + 1e-6));
}

static void make_random(struct contour_sheet *s, uint64_t *r, int32_t span) {
  static const unsigned edge_class[] = {0, RECTO_EDGE_BORDER, RECTO_EDGE_CREASE,
                                        RECTO_EDGE_GROUP | RECTO_EDGE_BORDER};
  uint32_t lines = (uint32_t)exact_random_below(r, 30);
  uint32_t contours = (uint32_t)exact_random_below(r, 60);
  exact_sheet_init(&s->sheet);
  for (int i = 0; i < 12; i++)
    (void)add_point(&s->sheet, random_between(r, span),
                    random_between(r, span));
  for (uint32_t i = 0; i < lines; i++)
    add_edge(&s->sheet, (uint32_t)exact_random_below(r, 12),
             (uint32_t)exact_random_below(r, 12),
             edge_class[exact_random_below(r, 4)]);
  for (int i = 0; i < 40; i++)
    (void)add_point(&s->sheet, random_between(r, span),
                    random_between(r, span));
  for (uint32_t i = 0; i < contours; i++)
    add_edge(&s->sheet, 12 + (uint32_t)exact_random_below(r, 40),
             12 + (uint32_t)exact_random_below(r, 40), RECTO_EDGE_SILHOUETTE);
  find_contours(s, lines, 12, r);
}

static void the_nearest_of_all_contours_is_found(void **state) {
  (void)state;
  uint64_t r = 11;
  for (int trial = 0; trial < 500; trial++) {
    struct contour_sheet s = {.nearest = {.sheet = NULL}};
    int32_t span = trial % 3 == 0 ? 8 : 1 << (10 + trial % 18);
    make_random(&s, &r, span);
    for (int i = 0; i < 20; i++) {
      struct geom_point p = {random_between(&r, 2 * span),
                             random_between(&r, 2 * span), 0};
      double angle = (double)exact_random_below(&r, 628) / 100;
      const double along[2] = {cos(angle), sin(angle)};
      double radius = 1 + (double)exact_random_below(&r, 2 * span);
      struct all_compared all = {INFINITY, INFINITY, false};
      for (size_t e = 0; e < s.sheet.edge.count; e++)
        if (is_visible(&s, e))
          compare_edge(&s, e, p, along, &all);
      struct nearest_contour found =
          nearest_contours_find(&s.nearest, p, along, radius);
      check_distances(&found, &all, radius);
      assert_int_equal(nearest_contours_has_line(&s.nearest, p), all.on_line);
    }
    fini_contours(&s);
  }
}

/* A contour that turns back along itself, and a line across. */
static void cusps_are_ends_and_lines_are_between(void **state) {
  (void)state;
  static const double along[2] = {1, 0};
  for (int cusps = 0; cusps < 2; cusps++) {
    struct contour_sheet s = {.nearest = {.sheet = NULL}};
    exact_sheet_init(&s.sheet);
    (void)add_point(&s.sheet, 1500, -900);
    (void)add_point(&s.sheet, 1500, 900);
    add_edge(&s.sheet, 0, 1, RECTO_EDGE_BORDER);
    (void)add_point(&s.sheet, 0, 0);
    (void)add_point(&s.sheet, 1000, 0);
    (void)add_point(&s.sheet, 200, 100);
    add_edge(&s.sheet, 2, 3, RECTO_EDGE_SILHOUETTE);
    add_edge(&s.sheet, 4, 3, RECTO_EDGE_SILHOUETTE);
    s.nearest.cusps = cusps;
    find_contours(&s, 1, 2, NULL);
    struct geom_point beyond = {2000, 0, 0};
    struct nearest_contour found =
        nearest_contours_find(&s.nearest, beyond, along, 5000);
    assert_true((cusps ? found.loose : found.any) == 1000);
    assert_true((cusps ? found.any : found.loose) > 1000);
    assert_true(nearest_contours_has_line_between(&s.nearest, beyond,
                                                  s.sheet.point.item[3]));
    assert_false(nearest_contours_has_line_between(
        &s.nearest, s.sheet.point.item[2], s.sheet.point.item[3]));
    fini_contours(&s);
  }
}

/* ---- Work ---------------------------------------------------------------- */

enum { ROWS = 20000 };

/* Looks about places all over a square; returns how many segments were compared
 * for each. */
static double compare_all_over(struct contour_sheet *s, int32_t size,
                               double radius) {
  const double along[2] = {1, 0};
  uint64_t r = 3;
  for (int i = 0; i < 1000; i++) {
    struct geom_point p = {random_between(&r, size), random_between(&r, size),
                           0};
    (void)nearest_contours_find(&s->nearest, p, along, radius);
    (void)nearest_contours_has_line(&s->nearest, p);
  }
  return (double)s->nearest.compared / 1000;
}

/* Lines are of no account but where they are: without a contour nothing is
 * looked for within the radius. */
static void lines_far_off_are_not_compared(void **state) {
  (void)state;
  const int32_t size = 1 << 27;
  struct contour_sheet s = {.nearest = {.sheet = NULL}};
  exact_sheet_init(&s.sheet);
  for (int32_t i = 0; i < ROWS; i++) {
    int32_t y = i * (2 * size / ROWS) - size;
    add_edge(&s.sheet, add_point(&s.sheet, -size, y),
             add_point(&s.sheet, size, y), RECTO_EDGE_BORDER);
  }
  find_contours(&s, ROWS, 2 * ROWS, NULL);
  double compared = compare_all_over(&s, size, size);
  assert_true(compared > 0.1 && compared < 300);
  fini_contours(&s);
}

/* Contours so near each other that very many lie within the first distance in
 * which they are looked for, and as large a radius. */
static void few_of_many_near_contours_are_compared(void **state) {
  (void)state;
  const int32_t size = 1 << 23;
  struct contour_sheet s = {.nearest = {.sheet = NULL}};
  exact_sheet_init(&s.sheet);
  for (int32_t i = 0; i < ROWS; i++) {
    int32_t x = random_between((uint64_t[]){(uint64_t)i * 77 + 1}, size);
    int32_t y = i * (2 * size / ROWS) - size;
    uint32_t p = add_point(&s.sheet, x, y), q = add_point(&s.sheet, x + 999, y);
    add_edge(&s.sheet, p, q, RECTO_EDGE_SILHOUETTE);
    add_edge(&s.sheet, q, p, RECTO_EDGE_SILHOUETTE);
  }
  find_contours(&s, 0, 0, NULL);
  double compared = compare_all_over(&s, size, 1 << 29);
  assert_true(compared > 1 && compared < 1000);
  fini_contours(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_nearest_of_all_contours_is_found),
      cmocka_unit_test(cusps_are_ends_and_lines_are_between),
      cmocka_unit_test(lines_far_off_are_not_compared),
      cmocka_unit_test(few_of_many_near_contours_are_compared),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
