/* test_occlusion_culling.c - culled triangles are hidden, and most hidden ones
 * are culled.  That drawings do not change is test_solvers_agree's claim, and
 * test_exact_map's for soups. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"
#include "visibility/culling/potentially_visible.h"
#include "visibility/predicate/occlusion.h"

enum { PARTS = 512 };

/* Looks down, on a square page. */
static void start(struct sheet_fixture *fixture) {
  sheet_fixture_start(fixture);
  scenes_view_above(&fixture->options);
  fixture->options.page.width_mm = fixture->options.page.height_mm = 200;
  fixture->options.page.margin_mm = 0;
}

/* Small squares, in a lattice within the unit square, at this height. */
static void add_squares(struct scene *scene, int a_side, double z) {
  double step = 1.0 / a_side;
  for (int i = 0; i < a_side * a_side; i++)
    build_parallelogram(
        scene,
        vector_of((i % a_side + 0.3) * step, (i / a_side + 0.3) * step, z),
        vector_of(0.4 * step, 0, 0), vector_of(0, 0.4 * step, 0));
}

/* The number of culled triangles. */
static size_t count_culled(struct sheet_fixture *fixture, bool fragments) {
  struct occlusion_culling culling;
  sheet_fixture_out(fixture, true);
  assert_true(occlusion_culling_init(&culling, &fixture->sheet, fragments));
  size_t culled = culling.count;
  occlusion_culling_fini(&culling);
  return culled;
}

/* All parts are behind the inside of a triangle, or of two that share a
 * diagonal, and one layer of them covers the page. */
static void what_is_in_a_box_is_culled(void **state) {
  (void)state;
  for (int fragments = 0; fragments <= 1; fragments++) {
    struct sheet_fixture fixture;
    start(&fixture);
    build_box(&fixture.scene, vector_of(-0.1, -0.1, -1),
              vector_of(1.1, 1.1, 1));
    for (int layer = 0; layer < 8; layer++)
      add_squares(&fixture.scene, 8, 0.1 * layer);
    size_t culled = count_culled(&fixture, fragments);
    /* The parts, and the bottom of the box but for its border cells. */
    assert_true(culled >= 2 * PARTS);
    assert_true(culled <= 2 * PARTS + 2);
    sheet_fixture_fini(&fixture);
  }
}

/* Squares above the plates, none of which is hidden, and under the highest, all
 * of which are. */
static void what_is_in_front_is_not_culled(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  start(&fixture);
  for (int plate = 0; plate < 8; plate++)
    build_parallelogram(&fixture.scene, vector_of(-0.1, -0.1, -0.1 * plate),
                        vector_of(1.2, 0, 0), vector_of(0, 1.2, 0));
  add_squares(&fixture.scene, 8, 0.1);
  add_squares(&fixture.scene, 8, -0.05);
  add_squares(&fixture.scene, 8, -0.07);
  sheet_fixture_out(&fixture, true);
  struct occlusion_culling culling;
  assert_true(occlusion_culling_init(&culling, &fixture.sheet, true));
  for (uint32_t t = 0; t < fixture.sheet.triangle.count; t++) {
    uint32_t face = fixture.sheet.triangle.item[t].face;
    if (face >= 8)
      assert_int_equal(occlusion_culling_is_culled(&culling, t),
                       face >= 8 + 64);
  }
  occlusion_culling_fini(&culling);
  sheet_fixture_fini(&fixture);
}

/* Strips under plates of the same slope, along which they rise above the lowest
 * place of the plates: only their depths in each cell tell that they and their
 * sides are hidden.  Those above the plates are not. */
static void what_is_under_a_slope_is_culled(void **state) {
  struct sheet_fixture fixture;
  struct occlusion_culling culling;
  (void)state;
  start(&fixture);
  for (int plate = 0; plate < 8; plate++)
    build_parallelogram(&fixture.scene,
                        vector_of(-0.1, -0.1, -0.1 - 0.001 * plate),
                        vector_of(1.2, 0, 1.2), vector_of(0, 1.2, 0));
  for (int strip = 0; strip < 128; strip++)
    build_parallelogram(
        &fixture.scene,
        vector_of(0, strip / 128.0, strip % 2 == 0 ? -0.1 : 0.1),
        vector_of(1, 0, 1), vector_of(0, 0.005, 0));
  sheet_fixture_out(&fixture, true);
  assert_true(occlusion_culling_init(&culling, &fixture.sheet, true));
  for (uint32_t t = 0; t < fixture.sheet.triangle.count; t++) {
    struct geom_triangle c = sheet_corners(&fixture.sheet, t);
    uint32_t face = fixture.sheet.triangle.item[t].face;
    for (int k = 0; face >= 8 && k < 3; k++)
      assert_int_equal(
          occlusion_culling_hides(&culling, c.p[k], c.p[(k + 1) % 3]),
          face % 2 == 0);
    if (face >= 8)
      assert_int_equal(occlusion_culling_is_culled(&culling, t), face % 2 == 0);
  }
  occlusion_culling_fini(&culling);
  sheet_fixture_fini(&fixture);
}

/* A plate a thousandth in front hides the squares; if so much is in contact, it
 * does not. */
static void contact_is_not_culled(void **state) {
  (void)state;
  for (int touching = 0; touching <= 1; touching++) {
    struct sheet_fixture fixture;
    start(&fixture);
    for (int plate = 0; plate < 8; plate++)
      build_parallelogram(&fixture.scene,
                          vector_of(-0.1, -0.1, 1 + 0.01 * plate),
                          vector_of(1.2, 0, 0), vector_of(0, 1.2, 0));
    add_squares(&fixture.scene, 8, 1.069);
    fixture.options.solver.contact = touching ? 0.002 : 0;
    sheet_fixture_out(&fixture, true);
    struct occlusion_culling culling;
    assert_true(occlusion_culling_init(&culling, &fixture.sheet, true));
    size_t culled = 0;
    for (uint32_t t = 0; t < fixture.sheet.triangle.count; t++)
      culled += fixture.sheet.triangle.item[t].face >= 8 &&
                occlusion_culling_is_culled(&culling, t);
    assert_int_equal(culled, touching ? 0 : 128);
    occlusion_culling_fini(&culling);
    sheet_fixture_fini(&fixture);
  }
}

/* Where nothing lies behind anything, no buffer is made. */
static void shallow_scenes_are_left_alone(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  start(&fixture);
  add_squares(&fixture.scene, 32, 0);
  sheet_fixture_out(&fixture, true);
  struct occlusion_culling culling;
  assert_true(occlusion_culling_init(&culling, &fixture.sheet, true));
  assert_null(culling.culled);
  assert_null(culling.buffer.bound);
  occlusion_culling_fini(&culling);
  sheet_fixture_fini(&fixture);
}

/* A soup in a unit cube. */
static void add_soup(struct scene *scene, uint64_t seed, int count,
                     double size) {
  struct random r = {seed};
  for (int i = 0; i < count; i++) {
    double xyz[9], middle[3];
    for (int k = 0; k < 3; k++)
      middle[k] = random_unit(&r);
    for (int k = 0; k < 9; k++)
      xyz[k] = middle[k % 3] + size * (random_unit(&r) - 0.5);
    build_polygon(scene, xyz, 3);
  }
}

/* Does a triangle hide the point of the page at that depth?  By the definition
 * in occlusion.h. */
static bool hides(const struct sheet *sheet, uint32_t t, struct geom_point p) {
  struct geom_triangle c = sheet_corners(sheet, t);
  struct occluder occluder;
  if (sheet_is_edge_on(sheet, t) || geom_orient2d(c.p[0], c.p[1], p) <= 0 ||
      geom_orient2d(c.p[1], c.p[2], p) <= 0 ||
      geom_orient2d(c.p[2], c.p[0], p) <= 0)
    return false;
  occluder_init(&occluder, sheet, t);
  return occluder_value(&occluder, p) < 0;
}

/* Is the point behind a triangle that is not culled? */
static bool is_behind(const struct sheet *sheet,
                      const struct occlusion_culling *culling,
                      struct geom_point p) {
  for (uint32_t t = 0; t < sheet->triangle.count; t++)
    if (!occlusion_culling_is_culled(culling, t) && hides(sheet, t, p))
      return true;
  return false;
}

/* The corners of culled triangles are behind triangles that are not culled. */
static void check_triangles(const struct sheet *sheet,
                            const struct occlusion_culling *culling) {
  assert_true(culling->count > sheet->triangle.count / 4);
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    struct geom_triangle c = sheet_corners(sheet, t);
    for (int k = 0; k < 3 && occlusion_culling_is_culled(culling, t); k++)
      assert_true(is_behind(sheet, culling, c.p[k]));
  }
}

/* So are the ends and the middle of segments that are called hidden: sides of
 * the triangles moved back, which are hidden the more often. */
static void check_segments(const struct sheet *sheet,
                           const struct occlusion_culling *culling) {
  size_t hidden = 0, other = 0;
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    struct geom_triangle c = sheet_corners(sheet, t);
    struct geom_point p = c.p[0], q = c.p[1];
    p.z -= p.z / 32;
    q.z -= q.z / 32;
    if (!occlusion_culling_hides(culling, p, q)) {
      other++;
      continue;
    }
    struct geom_point middle = {(p.x + q.x) / 2, (p.y + q.y) / 2,
                                (p.z + q.z) / 2};
    hidden++;
    assert_true(is_behind(sheet, culling, p));
    assert_true(is_behind(sheet, culling, q));
    assert_true(is_behind(sheet, culling, middle));
  }
  assert_true(hidden > sheet->triangle.count / 8);
  assert_true(other > sheet->triangle.count / 8);
}

/* The point of a segment, with each coordinate rounded. */
static struct geom_point point_at(struct geom_point p, struct geom_point q,
                                  int part) {
  double t = (double)part / OCCLUSION_PARTS;
  return (struct geom_point){(int32_t)floor(p.x + t * ((double)q.x - p.x)),
                             (int32_t)floor(p.y + t * ((double)q.y - p.y)),
                             p.z + (int64_t)floor(t * (double)(q.z - p.z))};
}

/* What is not in the rest of a segment, which runs backwards, is hidden. */
static void check_rests(const struct sheet *sheet,
                        const struct occlusion_culling *culling) {
  size_t partly = 0;
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    struct geom_triangle c = sheet_corners(sheet, t);
    struct geom_point p = c.p[0], q = c.p[1];
    q.z -= q.z / 4;
    struct segment_part rest = occlusion_culling_rest(culling, p, q),
                        back = occlusion_culling_rest(culling, q, p);
    bool hidden = occlusion_culling_hides(culling, p, q);
    assert_int_equal(hidden, rest.from >= rest.to);
    assert_int_equal(hidden, back.from >= back.to);
    if (hidden)
      continue;
    assert_in_range(rest.from + back.to - OCCLUSION_PARTS + 8, 0, 16);
    assert_in_range(rest.to + back.from - OCCLUSION_PARTS + 8, 0, 16);
    assert_true(rest.from >= 0 && rest.to <= OCCLUSION_PARTS);
    if (rest.from > 0) {
      assert_true(is_behind(sheet, culling, p));
      assert_true(is_behind(sheet, culling, point_at(p, q, rest.from / 2)));
      assert_true(is_behind(sheet, culling, point_at(p, q, rest.from - 1)));
    }
    if (rest.to < OCCLUSION_PARTS) {
      int half = (rest.to + OCCLUSION_PARTS) / 2;
      assert_true(is_behind(sheet, culling, q));
      assert_true(is_behind(sheet, culling, point_at(p, q, half)));
      assert_true(is_behind(sheet, culling, point_at(p, q, rest.to + 1)));
    }
    partly += rest.to - rest.from < OCCLUSION_PARTS;
  }
  assert_true(partly > sheet->triangle.count / 16);
}

static void what_is_culled_is_hidden(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 4; seed++) {
    struct sheet_fixture fixture;
    struct occlusion_culling culling;
    start(&fixture);
    if (seed % 2 == 0)
      scenes_view_eye(&fixture.options, vector_of(0.5, -1.5, 1.5),
                      vector_of(0.5, 0.5, 0.5), 40);
    add_soup(&fixture.scene, seed, 3000, 0.5);
    sheet_fixture_out(&fixture, true);
    assert_true(occlusion_culling_init(&culling, &fixture.sheet, seed > 2));
    check_triangles(&fixture.sheet, &culling);
    check_segments(&fixture.sheet, &culling);
    check_rests(&fixture.sheet, &culling);
    occlusion_culling_fini(&culling);
    sheet_fixture_fini(&fixture);
  }
}

/* The plane of a steep triangle, beside it. */
static void depths_of_any_size_are_steps(void **state) {
  (void)state;
  assert_int_equal(occlusion_steps_up(-1e13), -1);
  assert_int_equal(occlusion_steps_up(1e13), INT32_MAX);
  assert_int_equal(occlusion_steps_down(-1e13), -1);
}

/* ---- What is left, as a sheet -------------------------------------------- */

static void assert_same_point(const struct sheet *a, uint32_t p,
                              const struct sheet *b, uint32_t q) {
  struct geom_point s = a->point.item[p], t = b->point.item[q];
  assert_true(s.x == t.x && s.y == t.y && s.z == t.z);
}

static bool is_contour(const struct sheet *sheet, uint32_t p, uint32_t q) {
  for (size_t i = 0; i < sheet->contour.count; i++) {
    const uint32_t *point = sheet->contour.item[i].point;
    if ((point[0] == p && point[1] == q) || (point[0] == q && point[1] == p))
      return true;
  }
  return false;
}

/* Is the triangle beyond this side culled?  By its points. */
static bool is_culled_beyond(const struct sheet *whole,
                             const struct occlusion_culling *culling,
                             uint32_t triangle, int k) {
  const uint32_t *own = whole->triangle.item[triangle].point;
  for (uint32_t t = 0; t < whole->triangle.count; t++)
    for (int i = 0; i < 3 && occlusion_culling_is_culled(culling, t); i++) {
      const uint32_t *other = whole->triangle.item[t].point;
      if (other[i] == own[(k + 1) % 3] && other[(i + 1) % 3] == own[k])
        return true;
    }
  return false;
}

/* The triangles that are left in order, with their points and edges, and
 * contours where one beside them is missing. */
static void check_part_triangles(const struct sheet *whole,
                                 const struct occlusion_culling *culling,
                                 const struct potentially_visible *part) {
  const struct sheet *sheet = &part->sheet;
  uint32_t n = 0, torn = 0;
  for (uint32_t t = 0; t < whole->triangle.count; t++) {
    if (occlusion_culling_is_culled(culling, t))
      continue;
    assert_int_equal(part->triangle[n], t);
    assert_int_equal(sheet->triangle_flags[n], whole->triangle_flags[t]);
    const struct sheet_triangle *a = &whole->triangle.item[t],
                                *b = &sheet->triangle.item[n];
    const uint32_t *a_side = sheet_triangle_sides(whole, t),
                   *b_side = sheet_triangle_sides(sheet, n++);
    for (int k = 0; k < 3; k++) {
      assert_same_point(whole, a->point[k], sheet, b->point[k]);
      assert_int_equal(b_side[k] != SHEET_NONE ? part->edge[b_side[k]]
                                               : SHEET_NONE,
                       a_side[k]);
      if (is_culled_beyond(whole, culling, t, k)) {
        torn++;
        assert_true(is_contour(sheet, b->point[k], b->point[(k + 1) % 3]));
      }
    }
  }
  assert_int_equal(sheet->triangle.count, n);
  assert_true(torn > 0);
}

/* Edges are in order, and drawn unless they are hidden.  Returns how many
 * are. */
static size_t check_part_edges(const struct sheet *whole,
                               const struct occlusion_culling *culling,
                               const struct potentially_visible *part) {
  size_t drawn = 0;
  for (uint32_t e = 0; e < part->sheet.edge.count; e++) {
    const struct sheet_edge *b = &part->sheet.edge.item[e],
                            *a = &whole->edge.item[part->edge[e]];
    assert_true(e == 0 || part->edge[e - 1] < part->edge[e]);
    bool culled = false;
    for (int k = 0; k < 2; k++) {
      assert_same_point(whole, a->point[k], &part->sheet, b->point[k]);
      bool missing = a->triangle[k] != SHEET_NONE &&
                     occlusion_culling_is_culled(culling, a->triangle[k]);
      assert_int_equal(b->triangle[k] != SHEET_NONE
                           ? part->triangle[b->triangle[k]]
                           : SHEET_NONE,
                       missing ? SHEET_NONE : a->triangle[k]);
      culled |= missing;
    }
    assert_int_equal(b->edge_class,
                     culled || b->edge_class == 0 ? 0 : a->edge_class);
    drawn += b->edge_class != 0;
  }
  return drawn;
}

/* A plate over the left of meshes of squares. */
static void start_with_part(struct sheet_fixture *fixture,
                            struct occlusion_culling *culling,
                            struct potentially_visible *part) {
  enum { SQUARES = 24 };
  start(fixture);
  for (int layer = 0; layer < 8; layer++) {
    uint32_t first = (uint32_t)fixture->scene.point.count;
    for (int i = 0; i <= SQUARES; i++)
      for (int k = 0; k <= SQUARES; k++)
        build_point(&fixture->scene, (double)k / SQUARES, (double)i / SQUARES,
                    -0.1 * layer);
    build_grid(&fixture->scene, first, SQUARES, SQUARES, false);
  }
  build_parallelogram(&fixture->scene, vector_of(-0.1, -0.1, 0.5),
                      vector_of(0.7, 0, 0), vector_of(0, 1.2, 0));
  sheet_fixture_out(fixture, true);
  assert_true(occlusion_culling_init(culling, &fixture->sheet, false));
  assert_true(culling->count > 0);
  assert_true(potentially_visible_init(part, &fixture->sheet, culling));
}

static void what_is_left_is_a_sheet(void **state) {
  struct sheet_fixture fixture;
  struct occlusion_culling culling;
  struct potentially_visible part;
  (void)state;
  start_with_part(&fixture, &culling, &part);
  check_part_triangles(&fixture.sheet, &culling, &part);
  assert_true(check_part_edges(&fixture.sheet, &culling, &part) > 0);
  potentially_visible_fini(&part);
  occlusion_culling_fini(&culling);
  sheet_fixture_fini(&fixture);
}

/* A map of the part becomes one of the whole sheet: the states of its edges,
 * and an intersection that was found in it. */
static void maps_of_what_is_left_are_restored(void **state) {
  struct sheet_fixture fixture;
  struct occlusion_culling culling;
  struct potentially_visible part;
  struct map map;
  (void)state;
  start_with_part(&fixture, &culling, &part);
  struct sheet *whole = &fixture.sheet, *sheet = &part.sheet;
  size_t edges = whole->edge.count, points = whole->point.count;
  uint32_t last = (uint32_t)part.edges - 1, new = (uint32_t)part.edges;
  struct sheet_edge found = {
      .point = {(uint32_t)part.points, (uint32_t)part.points + 1},
      .triangle = {1, 2},
      .edge_class = RECTO_EDGE_INTERSECTION};
  for (int32_t k = 0; k < 2; k++)
    assert_true(ARRAY_PUSH(&sheet->point, ((struct geom_point){k, 7, 9})));
  assert_true(ARRAY_PUSH(&sheet->edge, found));
  map_init(&map);
  map.edge_count = sheet->edge.count;
  map.edge_state = mem_calloc(map.edge_count, 1);
  map.edge_state[last] = MAP_VISIBLE;
  map.edge_state[new] = MAP_MIXED;
  assert_true(ARRAY_PUSH(&map.mixed, ((struct map_mixed){.edge = new})));
  for (uint8_t side = MAP_SIDE_EDGE; side <= MAP_SIDE_CLIP; side++)
    assert_true(ARRAY_PUSH(&map.corner,
                           ((struct map_corner){.side = side, .id = last})));
  uint32_t in_whole = part.edge[last], triangle = part.triangle[2];
  assert_true(in_whole != last);
  assert_true(potentially_visible_restore(&part, whole, &map));
  assert_int_equal(whole->edge.count, edges + 1);
  assert_int_equal(map.edge_count, edges + 1);
  assert_int_equal(whole->edge.item[edges].triangle[1], triangle);
  assert_int_equal(whole->edge.item[edges].point[1], points + 1);
  assert_int_equal(whole->point.item[points + 1].x, 1);
  for (uint32_t e = 0; e <= edges; e++)
    assert_int_equal(map.edge_state[e], e == edges      ? MAP_MIXED
                                        : e == in_whole ? MAP_VISIBLE
                                                        : MAP_HIDDEN);
  assert_int_equal(map.mixed.item[0].edge, edges);
  for (int k = 0; k < 4; k++)
    assert_int_equal(map.corner.item[k].id, k < 2 ? in_whole : last);
  map_fini(&map);
  potentially_visible_fini(&part);
  occlusion_culling_fini(&culling);
  sheet_fixture_fini(&fixture);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_in_a_box_is_culled),
      cmocka_unit_test(what_is_in_front_is_not_culled),
      cmocka_unit_test(what_is_under_a_slope_is_culled),
      cmocka_unit_test(contact_is_not_culled),
      cmocka_unit_test(shallow_scenes_are_left_alone),
      cmocka_unit_test(what_is_culled_is_hidden),
      cmocka_unit_test(what_is_left_is_a_sheet),
      cmocka_unit_test(maps_of_what_is_left_are_restored),
      cmocka_unit_test(depths_of_any_size_are_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
