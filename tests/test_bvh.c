/* test_bvh.c - a BVH finds every triangle that hides a part of an edge, and few
 * others where all share an edge or are almost the same. */
#include "exact_fixture/sheet.h"
#include "visibility/index/bvh.h"
#include "visibility/predicate/occlusion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t seed = 1;

enum { TRIANGLES = 200, EDGES = 400, BITS = 20 };

enum kind {
  AT_RANDOM,
  AROUND_EDGE,
  AROUND_CORNER,
  NEAR_COPIES,
  ONE_PLANE,
  KINDS
};

static int32_t number(int bits) {
  int32_t most = (int32_t)1 << bits;
  return (int32_t)(exact_random(&seed) % (uint64_t)(2 * most)) - most;
}

/* A place on a page of 2^(BITS + 1) units a side, at any depth of the sheet or
 * near the middle. */
static struct geom_point place(int depth_bits) {
  struct geom_point p = {.x = number(BITS)};
  p.y = number(BITS);
  p.z = (INT64_C(1) << (SHEET_Z_BITS - 1)) +
        ((int64_t)(exact_random(&seed) >> (64 - depth_bits)));
  return p;
}

/* The place of p on one sloping plane, rounded. */
static struct geom_point on_plane(struct geom_point p) {
  p.z = (INT64_C(1) << (SHEET_Z_BITS - 1)) + INT64_C(517) * p.x -
        INT64_C(1203) * p.y + number(9);
  return p;
}

/* The corners of triangle i of its kind. */
static void choose_corners(enum kind kind, const struct geom_point common[3],
                           int i, struct geom_point p[3]) {
  int depth_bits = 10 + exact_random_below(&seed, 28);
  for (int k = 0; k < 3; k++)
    p[k] = place(depth_bits);
  switch (kind) {
  case AROUND_EDGE:
    p[1] = common[1];
    p[0] = common[0];
    break;
  case AROUND_CORNER:
    p[0] = common[0];
    break;
  case NEAR_COPIES:
    for (int k = 0; k < 3; k++) {
      p[k] = common[k];
      p[k].y += i / 8;
      p[k].z += 100 * i;
    }
    break;
  case ONE_PLANE:
    for (int k = 0; k < 3; k++)
      p[k] = on_plane(p[k]);
    break;
  default:
    break;
  }
}

static void make_sheet(struct sheet *sheet, enum kind kind) {
  struct geom_point common[3] = {place(38), place(38), place(38)};
  exact_sheet_init(sheet);
  for (int i = 0; i < TRIANGLES;) {
    struct geom_point p[3];
    choose_corners(kind, common, i, p);
    if (!exact_turn_triangle(p) && kind != NEAR_COPIES)
      continue; /* seen edge-on */
    exact_add_triangle(sheet, p, (uint32_t)i++);
  }
}

/* An edge of which each end is a corner of the sheet or any place. */
static struct geom_segment choose_edge(const struct sheet *sheet,
                                       enum kind kind) {
  struct geom_segment s;
  do {
    struct geom_point end[2];
    for (int k = 0; k < 2; k++) {
      end[k] =
          exact_random_below(&seed, 3) > 0
              ? sheet->point
                    .item[exact_random_below(&seed, (int)sheet->point.count)]
              : place(10 + exact_random_below(&seed, 28));
      if (kind == ONE_PLANE)
        end[k] = on_plane(end[k]);
    }
    s = (struct geom_segment){end[0], end[1]};
  } while (s.p.x == s.q.x && s.p.y == s.q.y);
  return s;
}

/* The whole edge, or a part of it. */
struct part {
  struct ratio from, to;
  struct geom_point end[2];
};

static struct geom_point point_at(struct geom_segment s, struct ratio t) {
  return (struct geom_point){(int32_t)ratio_lerp(t, s.p.x, s.q.x),
                             (int32_t)ratio_lerp(t, s.p.y, s.q.y),
                             ratio_lerp(t, s.p.z, s.q.z)};
}

static struct part choose_part(struct geom_segment s) {
  int from = exact_random_below(&seed, 1000),
      to = from + 1 + exact_random_below(&seed, 1000 - from);
  struct part part = {ratio_of(from, 1000), ratio_of(to, 1000), {s.p, s.q}};
  if (exact_random_below(&seed, 2) == 0) {
    part.from = ratio_of(0, 1);
    part.to = ratio_of(1, 1);
  }
  part.end[0] = point_at(s, part.from);
  part.end[1] = point_at(s, part.to);
  return part;
}

/* Marks what the tree finds for the part; returns how many triangles it is. */
static size_t find_all(const struct bvh *bvh, const uint32_t *list,
                       struct geom_segment s, const struct part *part,
                       uint8_t found[TRIANGLES]) {
  struct bvh_traversal traversal = bvh_traversal_start();
  struct bvh_query query;
  size_t from, to, count = 0;
  memset(found, 0, TRIANGLES);
  bvh_query_set(&query, bvh, s, part->end, ratio_to_double(part->from),
                ratio_to_double(part->to));
  while (bvh_next(bvh, &traversal, &query, &from, &to))
    for (; from < to; from++, count++)
      found[list[from]]++;
  return count;
}

/* Asserts that each triangle that hides something of the part is found, once.
 * Returns how many triangles are found beside these. */
static size_t check_edge(const struct sheet *sheet, const struct bvh *bvh,
                         const uint32_t *list, struct geom_segment s) {
  struct part part = choose_part(s);
  uint8_t found[TRIANGLES];
  size_t count = find_all(bvh, list, s, &part, found);
  for (uint32_t t = 0; t < TRIANGLES; t++) {
    struct occluder occluder;
    struct occluded_interval hidden;
    struct occlusion_counts counts = {0};
    assert_true(found[t] <= 1);
    if (sheet_is_edge_on(sheet, t))
      continue;
    occluder_init(&occluder, sheet, t);
    if (!occlude_edge(&occluder, s.p, s.q, &hidden, &counts) ||
        ratio_compare(hidden.from, part.to) >= 0 ||
        ratio_compare(part.from, hidden.to) >= 0)
      continue;
    assert_int_equal(found[t], 1);
    count--;
  }
  return count;
}

/* How many triangles an edge finds on average that hide nothing of it. */
static double needless(enum kind kind, int sheets) {
  size_t count = 0;
  for (int n = 0; n < sheets; n++) {
    struct sheet sheet;
    struct bvh bvh = {0};
    uint32_t list[TRIANGLES];
    make_sheet(&sheet, kind);
    for (uint32_t t = 0; t < TRIANGLES; t++)
      list[t] = t;
    assert_true(bvh_init(&bvh, &sheet, list, TRIANGLES));
    for (int e = 0; e < EDGES; e++)
      count += check_edge(&sheet, &bvh, list, choose_edge(&sheet, kind));
    bvh_fini(&bvh);
    exact_sheet_fini(&sheet);
  }
  return (double)count / sheets / EDGES;
}

static void test_every_occluder_is_found(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++)
    (void)needless((enum kind)kind, 20);
}

/* A quarter of all at most, though half of the edges are at random. */
static void test_few_others_are_found(void **state) {
  (void)state;
  assert_true(needless(AROUND_EDGE, 20) < TRIANGLES / 4);
  assert_true(needless(NEAR_COPIES, 20) < TRIANGLES / 4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_occluder_is_found),
      cmocka_unit_test(test_few_others_are_found),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
