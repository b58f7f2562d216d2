/* test_edge_crossing.c - no lines where faces of a smooth surface meet. */
#include "exact_fixture/sheet.h"
#include "visibility/predicate/plane_filter.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Six triangles about a point of a smooth mesh seen from its side, all but in
 * one plane: corners touch the planes of triangles that are not next to theirs,
 * from before and from behind.  Their edges, which run in all directions from
 * the point, are not on one line. */
static void add_fan(struct sheet *sheet, bool turned) {
  static const struct geom_point around[] = {
      {-16778556, 4839605, 410393927284}, {-18350550, 4794619, 416206825945},
      {-18423067, 4548095, 448069058762}, {-17076004, 4337560, 475414706239},
      {-16010733, 4443727, 461725473471}, {-15582105, 4657861, 433977804774},
      {-17089679, 4611075, 439983509530}};
  static const uint32_t triangle[][3] = {{0, 1, 6}, {6, 5, 0}, {2, 6, 1},
                                         {5, 6, 4}, {6, 2, 3}, {3, 4, 6}};
  uint32_t *group = mem_calloc(6, sizeof *group);
  exact_sheet_init(sheet);
  sheet->camera.contact = sheet->camera.contact_most = 7.6155887709093129e-06;
  sheet->z_scale = 410225734732.82434;
  sheet->units_per_view = 17994439.889407944;
  for (size_t k = 0; k < 7; k++) {
    struct geom_point p = around[k];
    if (turned) /* by a quarter */
      p = (struct geom_point){-p.y, p.x, p.z};
    assert_true(ARRAY_PUSH(&sheet->point, p));
  }
  for (uint32_t t = 0; t < 6; t++) {
    struct sheet_triangle f = {.face = t};
    for (int k = 0; k < 3; k++)
      f.point[k] = triangle[t][k];
    assert_true(ARRAY_PUSH(&sheet->triangle, f));
  }
  sheet->triangle_flags = mem_calloc(6, 1);
  sheet->face_group = group;
}

/* May corners of triangle f pierce the plane of g, for all that is known? */
static bool is_in_doubt(const struct sheet *sheet, uint32_t f, uint32_t g) {
  struct plane_filter plane = plane_filter_of(sheet, g);
  struct geom_point corner[3];
  for (int k = 0; k < 3; k++)
    corner[k] = sheet->point.item[sheet->triangle.item[f].point[k]];
  return plane_filter_may_intersect(&plane, corner);
}

/* How many pairs that are not next to each other the planes do not settle. */
static int count_doubts(const struct sheet *sheet) {
  static const uint32_t apart[][2] = {{0, 3}, {0, 4}, {0, 5}, {1, 2}, {1, 4},
                                      {1, 5}, {2, 3}, {2, 5}, {3, 4}};
  int doubts = 0;
  for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
    doubts += is_in_doubt(sheet, apart[i][0], apart[i][1]) &&
              is_in_doubt(sheet, apart[i][1], apart[i][0]);
  return doubts;
}

static void faces_of_a_smooth_surface_make_no_line(void **state) {
  (void)state;
  for (int turned = 0; turned < 2; turned++) {
    struct sheet sheet;
    struct map map;
    add_fan(&sheet, turned == 1);
    /* Their planes leave pairs in doubt, and yet. */
    assert_true(count_doubts(&sheet) > 0);
    exact_solve(&solver_brute, &sheet, &map, NULL);
    assert_int_equal(sheet.edge.count, 0);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faces_of_a_smooth_surface_make_no_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
