/* test_intersection_estimate.c - the exact segment of two triangles is within
 * the errors of its estimate. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"
#include "visibility/intersection/intersection_estimate.h"
#include "visibility/intersection/intersection_segment.h"

/* Needles among them, whose planes are known the least. */
static void add_triangles(struct scene *scene, struct random *random,
                          int count) {
  for (int i = 0; i < count; i++) {
    double xyz[9], middle[3],
        width = random_below(random, 3) == 0 ? 0x1p-16 : 0.7;
    for (int k = 0; k < 3; k++)
      middle[k] = random_unit(random);
    for (int k = 0; k < 9; k++)
      xyz[k] =
          middle[k % 3] + (k < 3 ? 0.9 : width) * (random_unit(random) - 0.5);
    build_polygon(scene, xyz, 3);
  }
}

/* Is a point off the line through two others by less than the errors, within
 * them but for these? */
static bool is_near(const struct intersection_estimate *estimate,
                    struct geom_point at) {
  struct geom_point p = estimate->end[0], q = estimate->end[1];
  double d[3] = {(double)q.x - p.x, (double)q.y - p.y, (double)(q.z - p.z)},
         e[3] = {(double)at.x - p.x, (double)at.y - p.y, (double)(at.z - p.z)},
         error[3] = {estimate->xy_error, estimate->xy_error, estimate->z_error},
         low = 0, high = 1;
  for (int k = 0; k < 3; k++) { /* the parameters of points near enough */
    if (d[k] == 0 && fabs(e[k]) > error[k])
      return false;
    if (d[k] == 0)
      continue;
    double a = (e[k] - error[k]) / d[k], b = (e[k] + error[k]) / d[k];
    low = fmax(low, fmin(a, b));
    high = fmin(high, fmax(a, b));
  }
  return low <= high;
}

static void exact_segments_are_near(void **state) {
  struct random random = {5};
  size_t estimates = 0, empty = 0, segments = 0;
  (void)state;
  for (int round = 0; round < 20; round++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    fixture.options.camera.fov_deg = round % 2 ? 60 : 0;
    fixture.options.solver.contact = round % 3 ? -1 : 0;
    add_triangles(&fixture.scene, &random, 80);
    sheet_fixture_out(&fixture, true);
    const struct sheet *sheet = &fixture.sheet;
    struct occlusion_bound all = occlusion_tolerance_bound_all(sheet);
    for (uint32_t f = 0; f < sheet->triangle.count; f++)
      for (uint32_t g = 0; g < f; g++) {
        struct triangle_plane pf = triangle_plane_of(sheet, f),
                              pg = triangle_plane_of(sheet, g);
        struct coarse_plane cf = coarse_plane_of(&all, pf.p),
                            cg = coarse_plane_of(&all, pg.p);
        struct intersection_estimate estimate;
        struct intersection_segment exact;
        if (!coarse_counts_straddle(coarse_plane_counts(&cf, pg.p)) ||
            !coarse_counts_straddle(coarse_plane_counts(&cg, pf.p)) ||
            !intersection_estimate_of(&estimate, pf.p, pg.p, &cf, &cg, &all))
          continue;
        estimates++;
        empty += estimate.empty;
        if (!intersection_segment_of_planes(sheet, f, g, &pf, &pg, &exact))
          continue;
        segments++;
        assert_false(estimate.empty);
        assert_true(is_near(&estimate, exact.end[0]));
        assert_true(is_near(&estimate, exact.end[1]));
      }
    sheet_fixture_fini(&fixture);
  }
  assert_true(segments > 500 && empty > 500);
  assert_true(estimates < 2 * (segments + empty));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_segments_are_near),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
