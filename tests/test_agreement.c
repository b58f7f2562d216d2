/* test_agreement.c - every exact solver gives brute force's map, on scenes made
 * to reveal differences. */
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "tests/scenes/exact.h"

/* A scene, made anew for each solver: solving adds to the sheet. */
struct recipe {
  const int (*corner)[3][3]; /* `count` triangles; NULL: by seed */
  int count;
  uint64_t seed;
};

static void make(struct sheet *sheet, const struct recipe *recipe) {
  uint64_t r = recipe->seed;
  if (recipe->corner == NULL) {
    exact_random_sheet(sheet, (enum exact_kind)(r % EXACT_KINDS),
                       2 + exact_random_below(&r, 12), &r);
    return;
  }
  exact_sheet_init(sheet);
  for (int f = 0; f < recipe->count; f++)
    exact_add_face(sheet, recipe->corner[f], 3, 1);
}

static void check(const struct recipe *recipe, const char *name) {
  struct sheet first;
  struct map map;
  make(&first, recipe);
  exact_solve(&solver_brute, &first, &map, NULL);
  for (const struct solver *const *s = solvers(); *s != NULL; s++) {
    struct sheet sheet;
    struct map again;
    char what[128];
    if (!is_exact(*s) || *s == &solver_brute)
      continue;
    snprintf(what, sizeof what, "%s by %s", name, (*s)->name);
    make(&sheet, recipe);
    exact_solve(*s, &sheet, &again, NULL);
    exact_assert_same_map(&map, &again, what);
    map_fini(&again);
    exact_sheet_fini(&sheet);
  }
  map_fini(&map);
  exact_sheet_fini(&first);
}

static void exact_solvers_agree_on_hard_sheets(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 600; seed++) {
    const struct recipe recipe = {.seed = seed};
    char name[64];
    snprintf(name, sizeof name, "seed %u", (unsigned)seed);
    check(&recipe, name);
  }
}

/* One end of the line between faces 0 and 3 is rounded off face 0, behind
 * face 3's neighbour, which Newell's order had painted before. */
static void
an_intersection_rounded_off_its_face_is_tested_against_all(void **state) {
  static const int corner[7][3][3] = {
      {{0, 0, 2}, {1, 0, 1}, {16, 3, 3}}, {{0, 6, 1}, {16, 3, 3}, {0, 0, 2}},
      {{16, 3, 3}, {1, 0, 0}, {0, 0, 0}}, {{0, 3, 0}, {68, 0, 26}, {1, 0, 0}},
      {{0, 0, 0}, {0, 3, 0}, {0, 6, 1}},  {{16, 3, 3}, {0, 6, 1}, {0, 0, 0}},
      {{68, 0, 26}, {1, 0, 0}, {0, 0, 2}}};
  (void)state;
  check(&(struct recipe){.corner = corner, .count = 7}, "a rounded end");
}

/* Faces 1 and 2 end on face 0 at the limit of contact; what was rounded of
 * their line is beyond it, and only brute tested face 0 against it. */
static void an_intersection_is_not_hidden_by_its_own_faces(void **state) {
  static const int corner[3][3][3] = {{{0, 0, 10}, {0, 6, 10}, {24, 7, 154}},
                                      {{25, 7, 153}, {0, 5, 17}, {0, 0, 0}},
                                      {{25, 7, 153}, {0, 5, 17}, {0, 6, 21}}};
  struct sheet sheet;
  struct map map;
  const struct recipe recipe = {.corner = corner, .count = 3};
  bool found = false;
  (void)state;
  check(&recipe, "a seam");
  make(&sheet, &recipe);
  exact_solve(&solver_brute, &sheet, &map, NULL);
  for (size_t e = 0; e < sheet.edge.count; e++)
    if (sheet.edge.item[e].edge_class == RECTO_EDGE_INTERSECTION) {
      assert_int_equal(map.edge_state[e], MAP_VISIBLE);
      found = true;
    }
  assert_true(found);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(
          an_intersection_rounded_off_its_face_is_tested_against_all),
      cmocka_unit_test(an_intersection_is_not_hidden_by_its_own_faces),
      cmocka_unit_test(exact_solvers_agree_on_hard_sheets),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
