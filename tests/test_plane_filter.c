/* test_plane_filter.c - planes in doubles, and 8-DOP keys, only decide what the
 * exact answers say, and their error bounds hold. */
#include "exact_fixture/sheet.h"
#include "visibility/index/kdop8.h"
#include "visibility/predicate/depth_plane.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/plane_cache.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t seed = 1;

static int32_t number(int bits) {
  int32_t most = (int32_t)1 << bits;
  return (int32_t)(exact_random(&seed) % (uint64_t)(2 * most)) - most;
}

/* A place on a page of 2^(bits + 1) units a side. */
static struct geom_point place(int bits, int depth_bits) {
  struct geom_point p;
  p.x = number(bits);
  p.y = number(bits);
  p.z = (int64_t)(exact_random(&seed) >> (64 - depth_bits));
  return p;
}

/* One triangle that is not edge-on, seen as `perspective` says. */
static void start(struct sheet *sheet, bool perspective, int bits,
                  int depth_bits) {
  exact_sheet_init(sheet);
  sheet->camera.perspective = perspective;
  sheet->camera.d_min = 2;
  sheet->camera.d_max = 5;
  sheet->camera.contact = perspective ? 0x1p-20 : 0x1p-18;
  sheet->camera.contact_most = sheet->camera.contact;
  sheet->z_scale = perspective ? 0x1p41 : 0x1p38;
  sheet->units_per_view = 0x1p26;
  struct geom_point p[3];
  do
    for (int k = 0; k < 3; k++)
      p[k] = place(bits, depth_bits);
  while (geom_orient2d(p[0], p[1], p[2]) <= 0);
  exact_add_triangle(sheet, p, 0);
}

/* A point of the triangle's plane, but for rounding and for `off`. */
static struct geom_point near_plane(const struct occluder *h, int64_t off) {
  double u = (double)number(20) / 0x1p20, v = (double)number(20) / 0x1p20;
  const struct geom_point *p = h->p;
  return (struct geom_point){(int32_t)(p[0].x + u * ((double)p[1].x - p[0].x) +
                                       v * ((double)p[2].x - p[0].x)),
                             (int32_t)(p[0].y + u * ((double)p[1].y - p[0].y) +
                                       v * ((double)p[2].y - p[0].y)),
                             off + (int64_t)((double)p[0].z +
                                             u * (double)(p[1].z - p[0].z) +
                                             v * (double)(p[2].z - p[0].z))};
}

static bool side_count_of_sides(const int side[3]) {
  int behind = 0, before = 0;
  for (int k = 0; k < 3; k++) {
    behind += side[k] < 0;
    before += side[k] > 0;
  }
  return (behind > 0 && before > 0) || behind + before == 1;
}

/* The bounds of the two other forms of the occluder's plane, at a point. */
static void check_bounds(const struct occluder *occluder,
                         const struct plane_filter *filter,
                         struct geom_point p) {
  const struct geom_plane *plane = &occluder->plane;
  double tolerance = (double)(occluder->t0 + occluder->t1 * p.z) / 0x1p16;
  assert_true(tolerance <= plane_filter_thickness(filter) * (double)plane->nz);
  struct depth_plane depth = depth_plane_of(plane);
  long double fall = ((long double)plane->nx * ((int64_t)p.x - plane->a.x) +
                      (long double)plane->ny * ((int64_t)p.y - plane->a.y)) /
                     (long double)plane->nz;
  long double off = depth_plane_at(&depth, p.x, p.y) - (plane->a.z - fall);
  assert_true(fabsl(off) <= depth_plane_error(&depth, p.x, p.y));
}

/* The sign along a part of a segment; whether it is certain. */
static bool check_sign_between(const struct occluder *occluder,
                               const struct plane_filter *filter,
                               const struct coarse_plane *coarse,
                               struct geom_point p, struct geom_point q) {
  enum { PARTS = 32 }; /* of the segment: 2^5 times 2^121 fits */
  int t[2] = {(int)(exact_random(&seed) % PARTS), PARTS};
  t[1] = t[0] + 1 + (int)(exact_random(&seed) % (uint64_t)(PARTS - t[0]));
  int sign = plane_filter_contact_sign_between(
      filter, p, q, (double)t[0] / PARTS, (double)t[1] / PARTS);
  int coarse_sign = coarse_plane_contact_sign_between(
      coarse, p, q, (double)t[0] / PARTS, (double)t[1] / PARTS);
  for (int k = 0; k < 2; k++) {
    int128 at = occluder_value(occluder, p) * (PARTS - t[k]) +
                occluder_value(occluder, q) * t[k];
    assert_true(sign == 0 || sign == geom_sign128(at));
    assert_true(coarse_sign == 0 || coarse_sign == geom_sign128(at));
  }
  return sign != 0;
}

/* What the coarse plane says of three points; counts what is certain.
 * side  of occluder_side */
static void check_coarse_plane(const struct coarse_plane *plane,
                               const struct occluder *occluder,
                               const struct geom_point p[3], const int side[3],
                               int certain[2]) {
  for (int k = 0; k < 3; k++) {
    int sign = coarse_plane_contact_sign(plane, p[k]);
    assert_true(sign == 0 ||
                sign == geom_sign128(occluder_value(occluder, p[k])));
    certain[0] += sign != 0;
  }
  bool may = coarse_counts_may_intersect(coarse_plane_counts(plane, p));
  assert_true(may || !side_count_of_sides(side));
  bool touches = side[0] == 0 && side[1] == 0 && side[2] == 0;
  assert_true(coarse_plane_may_touch(plane, p) || !touches);
  bool straddles = coarse_counts_straddle(coarse_plane_counts(plane, p));
  assert_true(!straddles || side[0] * side[1] * side[2] != 0);
  assert_true(!straddles || side[0] != side[1] || side[1] != side[2]);
  certain[1] += !may + straddles;
}

/* All doubts and certainties of one triangle; counts the certain ones. */
static void compare_with_exact(bool perspective, int bits, int depth_bits,
                               int certain[9]) {
  struct sheet sheet;
  struct occluder occluder;
  start(&sheet, perspective, bits, depth_bits);
  occluder_init(&occluder, &sheet, 0);
  struct plane_filter plane = plane_filter_of(&sheet, 0);
  struct occlusion_bound all = occlusion_tolerance_bound_all(&sheet);
  struct coarse_plane coarse = coarse_plane_of(&all, occluder.p);
  for (int i = 0; i < 200; i++) {
    struct geom_point p[3];
    int side[3];
    for (int k = 0; k < 3; k++) {
      int far = (int)(exact_random(&seed) % (uint64_t)depth_bits);
      p[k] =
          near_plane(&occluder, number(20) * (INT64_C(1) << far) / (1 << 20));
      if (p[k].z < 0 || p[k].z > SHEET_Z_MAX)
        p[k].z = 0;
      check_bounds(&occluder, &plane, p[k]);
      side[k] = occluder_side(&occluder, p[k]);
      int sign = plane_filter_contact_sign(&plane, p[k]);
      int exact = geom_sign128(occluder_value(&occluder, p[k]));
      assert_true(sign == 0 || sign == exact);
      certain[1] += sign != 0;
      sign = plane_filter_sign(&plane, p[k]);
      exact = geom_sign128(geom_plane_value(&occluder.plane, p[k]));
      assert_true(sign == 0 || sign == exact);
      certain[3] += sign != 0;
    }
    bool may = plane_filter_may_intersect(&plane, p);
    assert_true(may || !side_count_of_sides(side));
    certain[0] += !may;
    certain[2] += may && side_count_of_sides(side);
    bool touches = side[0] == 0 && side[1] == 0 && side[2] == 0;
    assert_true(plane_filter_may_touch(&plane, p) || !touches);
    certain[4] += !plane_filter_may_touch(&plane, p);
    bool differ = side[0] * side[1] < 0;
    certain[5] +=
        check_sign_between(&occluder, &plane, &coarse, p[0], p[1]) && differ;
    certain[6] += differ;
    check_coarse_plane(&coarse, &occluder, p, side, certain + 7);
  }
  exact_sheet_fini(&sheet);
}

static void doubles_are_right_or_undecided(void **state) {
  int certain[9] = {0};
  (void)state;
  for (int i = 0; i < 300; i++) {
    int bits = 4 + i % 26, depth_bits = 4 + i % 36;
    compare_with_exact(i % 2 == 0, bits, depth_bits, certain);
  }
  /* And they mostly decide. */
  assert_true(certain[0] > 15000);
  assert_true(certain[1] > 150000);
  assert_true(certain[2] > 1000);
  assert_true(certain[3] > 150000);
  assert_true(certain[4] > 10000);
  assert_true(certain[5] > 500 && 2 * certain[5] > certain[6]);
  assert_true(certain[7] > 90000);
  assert_true(certain[8] > 400);
}

/* ---- Keys of 8-DOPs ------------------------------------------------------ */

static struct kdop8 kdop8_of(const struct geom_point p[3], int count) {
  struct kdop8 kdop = kdop8_of_point(p[0]);
  for (int k = 1; k < count; k++)
    kdop8_add(&kdop, p[k]);
  return kdop;
}

static bool overlap(const struct kdop8 *a, const struct kdop8 *b) {
  for (int k = 0; k < 4; k++)
    if (a->most[k] < b->least[k] || b->most[k] < a->least[k])
      return false;
  return a->high >= b->low;
}

static void keys_exclude_only_disjoint_triangles(void **state) {
  int denied = 0, met = 0;
  (void)state;
  for (int i = 0; i < 20000; i++) {
    struct kdop8_range range = {
        number(10), number(10), i % 12, (int64_t)(exact_random(&seed) >> 50),
        i % 10,     false};
    struct geom_point p[3], q[3];
    for (int k = 0; k < 3; k++) {
      p[k] = place(11, 15);
      q[k] = k == 0 ? place(11, 15) : p[0];
      q[k].x = q[0].x + number(8);
      q[k].y = q[0].y + number(8);
    }
    struct kdop8 a = kdop8_of(p, 3), b = kdop8_of(q, 2);
    bool may = kdop8_overlaps(kdop8_key(&range, &a), kdop8_query(&range, &b));
    assert_true(may || !overlap(&a, &b));
    denied += !may;
    met += overlap(&a, &b);
  }
  assert_true(denied > 1000);
  assert_true(met > 1000);
}

/* A difference of a cell's corner and a coordinate, of any magnitude that fits
 * into lanes, and often the greatest. */
static int32_t difference_in_lanes(void) {
  const int32_t most = (1 << 29) - 1;
  int32_t d = number(4 + (int)(exact_random(&seed) % 26));
  return exact_random(&seed) % 8 == 0 ? (d < 0 ? -most : most)
         : d < -most                  ? -most
         : d > most                   ? most
                                      : d;
}

/* For any size of cell and all differences for which lanes are used. */
static void keys_and_queries_in_lanes_are_those_of_numbers(void **state) {
  int inner = 0;
  (void)state;
  assert_false(kdop8_fits_lanes(6, 1 << 20));
  assert_false(kdop8_fits_lanes(20, (1 << 29) + 1));
  for (int i = 0; i < 20000; i++) {
    struct kdop8_range range = {.x0 = number(29),
                                .y0 = number(29),
                                .shift = 7 + i % 23,
                                .z0 = number(20),
                                .z_shift = i % 10};
    struct geom_point p[3];
    assert_true(kdop8_fits_lanes(range.shift, 1 << 29));
    for (int k = 0; k < 3; k++)
      p[k] = (struct geom_point){range.x0 + difference_in_lanes(),
                                 range.y0 + difference_in_lanes(), number(25)};
    struct kdop8 kdop = kdop8_of(p, 3);
    uint64_t key = kdop8_key(&range, &kdop);
    assert_true(key == kdop8_key_of_triangle(&range, &p[0], &p[1], &p[2]));
    inner += (key & 63) != 0 && (key & 63) != 63;
    for (int k = 0; k < 4; k++) {
      kdop.least[k] -= 2;
      kdop.most[k] += 2;
    }
    uint64_t query = kdop8_query(&range, &kdop);
    range.fits_lanes = true;
    assert_true(query == kdop8_query(&range, &kdop));
  }
  assert_true(inner > 1000);
}

/* Also where two triangles have one slot. */
static void a_cached_plane_is_that_of_its_triangle(void **state) {
  enum { TRIANGLES = 5000, SLOTS = 4096 };
  struct sheet sheet;
  struct plane_cache cache;
  (void)state;
  start(&sheet, true, 20, 30);
  for (int t = 1; t < TRIANGLES; t++) {
    struct geom_point p[3] = {place(20, 30), place(20, 30), place(20, 30)};
    exact_add_triangle(&sheet, p, 0);
  }
  assert_true(plane_cache_init(&cache, &sheet));
  for (uint32_t t = 0; t < TRIANGLES - SLOTS; t++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t triangle = t + k % 2 * SLOTS;
      struct plane_filter plane = plane_filter_of(&sheet, triangle);
      assert_memory_equal(plane_cache_get(&cache, triangle), &plane,
                          sizeof plane);
    }
  plane_cache_fini(&cache);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(doubles_are_right_or_undecided),
      cmocka_unit_test(keys_exclude_only_disjoint_triangles),
      cmocka_unit_test(keys_and_queries_in_lanes_are_those_of_numbers),
      cmocka_unit_test(a_cached_plane_is_that_of_its_triangle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
