/* test_sheet.c - the sheet keeps its invariants, clipped or whole. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geom/predicate.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"
#include "view/camera_aim.h"
#include "view/layout.h"

/* ---- Invariants ---------------------------------------------------------- */

static void the_scenes_keep_every_invariant(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    for (int all_edges = 0; all_edges < 2; all_edges++) {
      struct sheet_fixture fixture;
      sheet_fixture_start(&fixture);
      entry->fill(&fixture.scene, &fixture.options);
      fixture.options.ink.edges = RECTO_EDGES_ALL;
      sheet_fixture_out(&fixture, all_edges);
      sheet_fixture_check(&fixture);
      sheet_fixture_fini(&fixture);
    }
}

/* Lays the scene out again as for drawings that need no sides; returns whether
 * these were left out.  Found afterwards, they are the same.
 * keeps_topology  it is used later, as by smooth contours */
static bool check_sides_left_out(const struct sheet_fixture *fixture,
                                 bool keeps_topology) {
  const struct sheet *made = &fixture->sheet;
  struct topology topology;
  struct sheet sheet;
  assert_int_equal(topology_init(&topology, &fixture->scene, NULL), RECTO_OK);
  topology.drop_sides = true;
  topology.drop_corners = topology.drop_edges = !keeps_topology;
  assert_int_equal(layout_sheet(&sheet, &fixture->scene, &topology,
                                &fixture->camera, &fixture->options,
                                fixture->all_edges, NULL),
                   RECTO_OK);
  bool are_left_out = sheet.sides.count < sheet.triangle.count;
  assert_true(sheet_find_sides(&sheet));
  assert_int_equal(sheet.triangle.count, made->triangle.count);
  for (size_t t = 0; t < sheet.triangle.count; t++) {
    assert_memory_equal(&sheet.triangle.item[t], &made->triangle.item[t],
                        sizeof *sheet.triangle.item);
    assert_memory_equal(&sheet.sides.item[t], &made->sides.item[t],
                        sizeof *sheet.sides.item);
  }
  assert_int_equal(sheet.edge.count, made->edge.count);
  for (size_t e = 0; e < sheet.edge.count; e++)
    assert_memory_equal(&sheet.edge.item[e], &made->edge.item[e],
                        sizeof *sheet.edge.item);
  sheet_fini(&sheet);
  topology_fini(&topology);
  return are_left_out;
}

/* Finds the sides of the sheet's triangles again. */
static void find_sides_again(struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  struct sheet_sides *made = malloc(n * sizeof *made);
  assert_non_null(made);
  memcpy(made, sheet->sides.item, n * sizeof *made);
  sheet->sides.count = 0;
  assert_true(sheet_find_sides(sheet));
  assert_memory_equal(sheet->sides.item, made, n * sizeof *made);
  free(made);
}

/* Of 5,000 triangles around one edge, or 5,000 folds around one point, each
 * side is compared with few edges, wherever the points of which very many have
 * a side are numbered. */
static void sides_at_one_point_are_found_with_few_comparisons(void **state) {
  (void)state;
  enum { TRIANGLES = 5000 };
  for (int kind = 0; kind < 4; kind++) {
    struct sheet_fixture fixture;
    uint32_t shared[2] = {0, 1}, first = kind < 2 ? 2 : 0;
    sheet_fixture_start(&fixture);
    if (kind >= 2)
      shared[0] = TRIANGLES + 1, shared[1] = TRIANGLES + 2;
    for (uint32_t i = 0; i < TRIANGLES + 3; i++) {
      double angle = 6 * (i - first) / (double)TRIANGLES;
      bool is_shared = i == shared[0] || i == shared[1];
      build_point(&fixture.scene, is_shared ? 0 : cos(angle),
                  is_shared ? 0 : sin(angle), is_shared ? i == shared[1] : 2);
    }
    for (uint32_t i = 0; i < TRIANGLES; i++)
      build_triangle(&fixture.scene, shared[0],
                     kind % 2 == 0 ? shared[1] : first + i + 1, first + i);
    sheet_fixture_out(&fixture, true);
    assert_int_equal(fixture.sheet.triangle.count, TRIANGLES);
    find_sides_again(&fixture.sheet);
    assert_true(fixture.sheet.sides_compared < 6 * TRIANGLES);
    sheet_fixture_fini(&fixture);
  }
}

static void sides_that_are_left_out_are_found(void **state) {
  (void)state;
  int left_out = 0, beside_topology = 0;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    for (int all_edges = 0; all_edges < 2; all_edges++) {
      struct sheet_fixture fixture;
      sheet_fixture_start(&fixture);
      entry->fill(&fixture.scene, &fixture.options);
      sheet_fixture_out(&fixture, all_edges);
      left_out += check_sides_left_out(&fixture, false);
      beside_topology += check_sides_left_out(&fixture, true);
      sheet_fixture_fini(&fixture);
    }
  assert_true(left_out > 10 && beside_topology == left_out);
}

static bool is_in_view(const struct sheet_fixture *fixture) {
  struct camera camera;
  return camera_aim(&camera, &fixture->scene, &fixture->options, NULL) ==
         RECTO_OK;
}

static void random_scenes_keep_every_invariant(void **state) {
  (void)state;
  int checked = 0;
  for (uint64_t seed = 1; seed <= 600; seed++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    scenes_small(&fixture.scene, &fixture.options, seed);
    fixture.options.ink.edges = (unsigned)seed & RECTO_EDGES_ALL;
    if (is_in_view(&fixture)) {
      sheet_fixture_out(&fixture, seed % 3 != 0);
      sheet_fixture_check(&fixture);
      checked++;
    }
    sheet_fixture_fini(&fixture);
  }
  assert_true(checked > 500);
}

/* A camera somewhere in the scene, so that the near plane and the page both
 * cut it. */
static void put_camera_inside(struct sheet_fixture *fixture,
                              struct random *random) {
  recto_options *o = &fixture->options;
  o->camera.kind = RECTO_CAMERA_EYE;
  o->camera.has_target = true;
  do {
    for (int k = 0; k < 3; k++) {
      o->camera.eye[k] = random_between(random, -4, 4);
      o->camera.target[k] = random_between(random, -4, 4);
      if (random_below(random, 3) == 0) /* on planes and points too */
        o->camera.eye[k] = floor(o->camera.eye[k]);
    }
  } while (fabs(o->camera.eye[0] - o->camera.target[0]) < 0.1);
  o->camera.up[0] = 0;
  o->camera.up[1] = 0.01;
  o->camera.up[2] = 1;
  o->camera.fov_deg = random_between(random, 20, 110);
  o->camera.fit = random_below(random, 2) ? RECTO_FIT_NONE : RECTO_FIT_PAGE;
}

static void clipped_scenes_keep_every_invariant(void **state) {
  (void)state;
  struct random random = {21};
  uint64_t near = 0, page = 0;
  for (uint64_t seed = 1; seed <= 1500; seed++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    scenes_small(&fixture.scene, &fixture.options, seed);
    put_camera_inside(&fixture, &random);
    fixture.options.ink.edges = RECTO_EDGES_ALL;
    if (is_in_view(&fixture)) {
      sheet_fixture_out(&fixture, true);
      sheet_fixture_check(&fixture);
      near += fixture.sheet.clipped_near;
      page += fixture.sheet.clipped_page;
    }
    sheet_fixture_fini(&fixture);
  }
  assert_true(near > 1000 && page > 1000); /* they were clipped indeed */
}

/* The near plane cuts off so little of a pyramid's apex that its edges end
 * in one place of the grid: that is one point, as the apex was. */
static void edges_of_a_point_that_are_cut_in_one_place_share_it(void **state) {
  static const double base[] = {-20, -20, 0, 20, -20, 0, 20, 20, 0, -20, 20, 0};
  (void)state;
  for (int cut = 0; cut < 2; cut++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    uint32_t apex = build_point(&fixture.scene, 1, 2, 30), corner[4];
    for (int k = 0; k < 4; k++)
      corner[k] = build_point(&fixture.scene, base[3 * k], base[3 * k + 1], 0);
    for (int k = 0; k < 4; k++)
      build_triangle(&fixture.scene, apex, corner[k], corner[(k + 1) % 4]);
    fixture.options.camera.azimuth_deg = 0;
    fixture.options.camera.elevation_deg = 0;
    fixture.options.camera.near_distance = cut * 1e-9;
    sheet_fixture_out(&fixture, true);
    assert_int_equal(fixture.sheet.point.count, 5);
    assert_int_equal(fixture.sheet.triangle.count, 4);
    assert_int_equal(fixture.sheet.clipped_near, 4 * cut);
    sheet_fixture_check(&fixture);
    sheet_fixture_fini(&fixture);
  }
}

static void an_eye_in_a_degenerate_position_is_handled(void **state) {
  (void)state;
  for (int place = SCENES_EYE_INSIDE; place <= SCENES_EYE_ON_LINE; place++)
    for (int fit = RECTO_FIT_PAGE; fit <= RECTO_FIT_NONE; fit++) {
      struct sheet_fixture fixture;
      sheet_fixture_start(&fixture);
      scenes_room(&fixture.scene, &fixture.options, (enum scenes_eye)place);
      fixture.options.camera.fit = (recto_fit)fit;
      fixture.options.ink.edges = RECTO_EDGES_ALL;
      sheet_fixture_out(&fixture, true);
      sheet_fixture_check(&fixture);
      assert_true(fixture.sheet.triangle.count > 0);
      assert_true(fixture.sheet.clipped_near > 0);
      sheet_fixture_fini(&fixture);
    }
}

/* ---- Where points fall --------------------------------------------------- */

/* The sheet point of a scene point, found by walking an edge. */
static struct geom_point where(const struct sheet_fixture *fixture,
                               uint32_t point) {
  for (size_t e = 0; e < fixture->sheet.edge.count; e++) {
    const struct sheet_edge *edge = &fixture->sheet.edge.item[e];
    const uint32_t *ends = fixture->topology.edge.item[edge->source].point;
    for (int k = 0; k < 2; k++)
      if (ends[k] == point)
        return fixture->sheet.point.item[edge->point[k]];
  }
  fail_msg("point %u is not on the sheet", (unsigned)point);
  return (struct geom_point){0, 0, 0};
}

static void fill_box(struct sheet_fixture *fixture) {
  sheet_fixture_start(fixture);
  build_box(&fixture->scene, vector_of(-3, -4, -5), vector_of(3, 4, 6));
}

static void points_are_snapped_to_the_nearest_grid_unit(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    fill_box(&fixture);
    fixture.options.camera.fov_deg = perspective ? 40 : 0;
    sheet_fixture_out(&fixture, true);
    const struct camera *c = &fixture.camera;
    double m[12];
    camera_matrix(c, m);
    for (uint32_t p = 0; p < 8; p++) {
      const struct scene_point *q = &fixture.scene.point.item[p];
      double h[3], view_d = 0;
      for (int r = 0; r < 3; r++)
        h[r] = m[4 * r] * q->x + m[4 * r + 1] * q->y + m[4 * r + 2] * q->z +
               m[4 * r + 3];
      const double to[3] = {q->x - c->eye[0], q->y - c->eye[1],
                            q->z - c->eye[2]};
      for (int k = 0; k < 3; k++)
        view_d -= c->back[k] * to[k];
      struct geom_point at = where(&fixture, p);
      assert_true(fabs(sheet_x_mm(&fixture.sheet, at.x) - h[0] / h[2]) <
                  0.5001 / SHEET_UNITS_PER_MM);
      assert_true(fabs(sheet_y_mm(&fixture.sheet, at.y) - h[1] / h[2]) <
                  0.5001 / SHEET_UNITS_PER_MM);
      double z = perspective
                     ? fixture.sheet.z_scale * (1 / view_d - 1 / c->d_max)
                     : fixture.sheet.z_scale * (c->d_max - view_d);
      assert_true(fabs((double)at.z - z) < 1);
    }
    assert_true(fixture.sheet.units_per_view == c->s * SHEET_UNITS_PER_MM);
    sheet_fixture_fini(&fixture);
  }
}

static void depth_fills_its_range(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    fill_box(&fixture);
    fixture.options.camera.fov_deg = perspective ? 40 : 0;
    sheet_fixture_out(&fixture, false);
    int64_t low = SHEET_Z_MAX, high = 0;
    for (size_t p = 0; p < fixture.sheet.point.count; p++) {
      int64_t z = fixture.sheet.point.item[p].z;
      low = z < low ? z : low;
      high = z > high ? z : high;
    }
    assert_int_equal(low, 0);
    assert_int_equal(high, SHEET_Z_MAX);
    sheet_fixture_fini(&fixture);
  }
}

/* Rounding puts a corner at most half a unit off, so a face's fourth corner is
 * within a few units of the plane of the other three. */
static void planes_stay_planes(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    fill_box(&fixture);
    fixture.options.camera.fov_deg = perspective ? 60 : 0;
    sheet_fixture_out(&fixture, true);
    for (uint32_t f = 0; f < 6; f++) {
      const uint32_t *corner =
          fixture.scene.corner.item + scene_face_start(&fixture.scene, f);
      struct geom_point p[4];
      for (int k = 0; k < 4; k++)
        p[k] = where(&fixture, corner[k]);
      struct geom_plane plane = geom_plane_of(p[0], p[1], p[2]);
      double off = (double)geom_plane_value(&plane, p[3]) / (double)plane.nz;
      double slope = 1 + fabs((double)plane.nx / (double)plane.nz) +
                     fabs((double)plane.ny / (double)plane.nz);
      assert_true(fabs(off) <= 4 * slope);
    }
    sheet_fixture_fini(&fixture);
  }
}

static void a_flat_scene_square_on_is_fine(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    build_parallelogram(&fixture.scene, vector_of(0, 0, 7), vector_of(3, 0, 0),
                        vector_of(0, 2, 0));
    fixture.options.camera.azimuth_deg = fixture.options.camera.elevation_deg =
        0;
    fixture.options.camera.fov_deg = perspective ? 40 : 0;
    sheet_fixture_out(&fixture, true);
    sheet_fixture_check(&fixture);
    assert_true(isfinite(fixture.sheet.z_scale) && fixture.sheet.z_scale > 0);
    assert_int_equal(fixture.sheet.triangle.count, 2);
    sheet_fixture_fini(&fixture);
  }
}

/* A contact length in depth units must be a number that int64 can hold. */
static void a_noisy_flat_scene_does_not_blow_depth_up(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_parallelogram(&fixture.scene, vector_of(0, 0, 0), vector_of(3, 0, 0),
                      vector_of(0, 2, 0));
  scenes_turn(&fixture.scene, vector_of(1, 2, 3), 1);
  fixture.options.camera.azimuth_deg = 0;
  fixture.options.camera.elevation_deg = 0;
  struct scene_point *p = fixture.scene.point.item;
  struct vector u =
      vector_of(p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z);
  struct vector v =
      vector_of(p[3].x - p[0].x, p[3].y - p[0].y, p[3].z - p[0].z);
  struct vector n = vector_cross(u, v);
  fixture.options.camera.kind = RECTO_CAMERA_EYE;
  fixture.options.camera.eye[0] = n.x;
  fixture.options.camera.eye[1] = n.y;
  fixture.options.camera.eye[2] = n.z;
  fixture.options.camera.has_target = true;
  fixture.options.camera.target[0] = fixture.options.camera.target[1] =
      fixture.options.camera.target[2] = 0;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_true(fixture.camera.contact * fixture.sheet.z_scale < 0x1p62);
  sheet_fixture_fini(&fixture);
}

/* ---- Areas --------------------------------------------------------------- */

/* A polygon's area from the corners that its edges have on the sheet. */
static int64_t outline_area(const struct sheet_fixture *fixture,
                            uint32_t face) {
  const struct scene *scene = &fixture->scene;
  uint32_t start = scene_face_start(scene, face);
  uint32_t count = scene_face_start(scene, face + 1) - start;
  int64_t area = 0;
  for (uint32_t c = 1; c + 1 < count; c++)
    area += geom_orient2d(where(fixture, scene->corner.item[start]),
                          where(fixture, scene->corner.item[start + c]),
                          where(fixture, scene->corner.item[start + c + 1]));
  return llabs(area);
}

static void triangles_of_a_polygon_have_its_area_exactly(void **state) {
  (void)state;
  for (int corners = 5; corners < 40; corners += 3) {
    struct sheet_fixture fixture;
    double xyz[3 * 40];
    sheet_fixture_start(&fixture);
    for (int c = 0; c < corners; c++) { /* a star, tilted */
      double r = c % 2 ? 3 : 7, angle = 2 * acos(-1) * c / corners;
      xyz[3 * c] = r * cos(angle);
      xyz[3 * c + 1] = r * sin(angle);
      xyz[3 * c + 2] = 0.5 * xyz[3 * c] - 0.25 * xyz[3 * c + 1];
    }
    build_polygon(&fixture.scene, xyz, (size_t)corners);
    fixture.options.camera.azimuth_deg = fixture.options.camera.elevation_deg =
        0;
    sheet_fixture_out(&fixture, true);
    sheet_fixture_check(&fixture);
    assert_int_equal(fixture.sheet.triangle.count, corners - 2);
    assert_int_equal(sheet_fixture_area(&fixture, 0),
                     outline_area(&fixture, 0));
    sheet_fixture_fini(&fixture);
  }
}

static int64_t page_area(const struct sheet_fixture *fixture) {
  return 8 * (int64_t)sheet_fixture_half(fixture, 0) *
         sheet_fixture_half(fixture, 1);
}

/* A sheet of n x n quads far larger than the page. */
static void fill_large_grid(struct sheet_fixture *fixture, unsigned n,
                            bool triangles) {
  sheet_fixture_start(fixture);
  build_group(&fixture->scene, "grid");
  for (unsigned row = 0; row <= n; row++)
    for (unsigned column = 0; column <= n; column++)
      build_point(&fixture->scene, 600.0 * column / n - 301.7,
                  600.0 * row / n - 297.1, 10 * sin(row) * cos(column));
  build_grid(&fixture->scene, 0, n, n, triangles);
  fixture->options.camera.fit = RECTO_FIT_NONE;
  fixture->options.camera.azimuth_deg = fixture->options.camera.elevation_deg =
      0;
}

/* Neither a gap nor an overlap of a single unit, however the page cuts. */
static void a_grid_beyond_the_page_fills_the_page_exactly(void **state) {
  (void)state;
  for (int triangles = 0; triangles < 2; triangles++)
    for (unsigned n = 1; n <= 41; n += 8) {
      struct sheet_fixture fixture;
      fill_large_grid(&fixture, n, triangles);
      sheet_fixture_out(&fixture, true);
      sheet_fixture_check(&fixture);
      assert_true(fixture.sheet.clipped_page > 0);
      if (n == 1)
        assert_int_equal(fixture.sheet.clipped_near, 0);
      assert_int_equal(sheet_fixture_area(&fixture, SHEET_NONE),
                       page_area(&fixture));
      sheet_fixture_fini(&fixture);
    }
}

static void a_polygon_around_the_page_is_cut_to_the_page(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  const double xyz[] = {-900, -800, 1, 0, -500, 1, 900,  -700, 1, 800,  300, 1,
                        200,  900,  1, 0, 400,  1, -200, 900,  1, -700, 500, 1};
  build_polygon(&fixture.scene, xyz, 8);
  fixture.options.camera.fit = RECTO_FIT_NONE;
  fixture.options.camera.azimuth_deg = fixture.options.camera.elevation_deg = 0;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.clipped_page, 1);
  assert_int_equal(sheet_fixture_area(&fixture, SHEET_NONE),
                   page_area(&fixture));
  assert_int_equal(fixture.sheet.edge.count, 0); /* they are all beyond it */
  sheet_fixture_fini(&fixture);
}

static void a_floor_to_the_horizon_is_cut_by_both(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_group(&fixture.scene, "floor");
  for (int row = 0; row <= 20; row++)
    for (int column = 0; column <= 20; column++)
      build_point(&fixture.scene, 20.0 * column - 200, 0, 10.0 * row - 100);
  build_grid(&fixture.scene, 0, 20, 20, false);
  fixture.options.camera.kind = RECTO_CAMERA_EYE;
  fixture.options.camera.eye[1] = 1.5;
  fixture.options.camera.has_target = true;
  fixture.options.camera.target[1] = 1.5;
  fixture.options.camera.target[2] = -100;
  fixture.options.camera.fov_deg = 60;
  fixture.options.camera.fit = RECTO_FIT_NONE;
  fixture.options.camera.near_distance = 1;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_true(fixture.sheet.clipped_near > 0 && fixture.sheet.clipped_page > 0);
  for (size_t p = 0; p < fixture.sheet.point.count; p++)
    assert_true(fixture.sheet.point.item[p].y < 0); /* below the horizon */
  /* The floor's far border is 100 away, 1.5 down, and wider than the page. */
  double s = fixture.camera.s, half = sheet_fixture_half(&fixture, 1);
  double border = s * 1.5 / 100 * SHEET_UNITS_PER_MM;
  double area = 2 * (half - border) * 2 * sheet_fixture_half(&fixture, 0);
  double found = (double)sheet_fixture_area(&fixture, SHEET_NONE);
  assert_true(fabs(found - area) < 1e-6 * area);
  sheet_fixture_fini(&fixture);
}

/* ---- Clipping ------------------------------------------------------------ */

static void a_drawing_that_fits_the_page_is_never_cut(void **state) {
  (void)state;
  struct random random = {33};
  for (int i = 0; i < 300; i++) {
    struct sheet_fixture fixture;
    fill_box(&fixture);
    fixture.options.page.margin_mm = 0;
    fixture.options.page.width_mm = random_int(&random, 10, 2000);
    fixture.options.page.height_mm = random_between(&random, 10, 2000);
    fixture.options.camera.azimuth_deg = random_between(&random, 0, 360);
    fixture.options.camera.elevation_deg = random_between(&random, -90, 90);
    fixture.options.camera.fov_deg =
        i % 2 ? random_between(&random, 1, 150) : 0;
    sheet_fixture_out(&fixture, true);
    sheet_fixture_check(&fixture);
    assert_int_equal(fixture.sheet.clipped_page, 0);
    assert_int_equal(fixture.sheet.clipped_near, 0);
    assert_int_equal(fixture.sheet.triangle.count, 12);
    assert_int_equal(fixture.sheet.edge.count, 12);
    sheet_fixture_fini(&fixture);
  }
}

static void a_cut_edge_is_cut_once_for_all_who_use_it(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  fill_large_grid(&fixture, 29, true);
  fixture.options.ink.edges = RECTO_EDGES_ALL;
  sheet_fixture_out(&fixture, true);
  size_t cut = 0;
  for (size_t e = 0; e < fixture.sheet.edge.count; e++) {
    const struct sheet_edge *edge = &fixture.sheet.edge.item[e];
    const struct topology_edge *source =
        &fixture.topology.edge.item[edge->source];
    if (source->uses < 2)
      continue;
    assert_int_not_equal(edge->triangle[1], SHEET_NONE);
    for (int k = 0; k < 2; k++) { /* see also check_sides in sheet_fixture.c */
      struct geom_point p = fixture.sheet.point.item[edge->point[k]];
      cut += abs(p.x) == sheet_fixture_half(&fixture, 0) ||
             abs(p.y) == sheet_fixture_half(&fixture, 1);
    }
  }
  assert_true(cut > 20);
  sheet_fixture_fini(&fixture);
}

static void a_near_plane_cuts_and_leaves_no_line(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    fill_box(&fixture);
    fixture.options.camera.azimuth_deg = 20;
    fixture.options.camera.elevation_deg = 0;
    fixture.options.camera.fov_deg = perspective ? 30 : 0;
    struct camera camera;
    fixture.options.camera.fit =
        perspective ? RECTO_FIT_SPHERE : RECTO_FIT_PAGE;
    assert_int_equal(
        camera_aim(&camera, &fixture.scene, &fixture.options, NULL), RECTO_OK);
    fixture.options.camera.near_distance = perspective ? camera.d_min + 6 : 6;
    fixture.options.ink.edges = RECTO_EDGES_ALL;
    sheet_fixture_out(&fixture, true);
    sheet_fixture_check(&fixture);
    assert_true(fixture.sheet.clipped_near >= 4);
    assert_int_equal(fixture.sheet.clipped_page, 0);
    size_t at_cut = 0;
    for (size_t e = 0; e < fixture.sheet.edge.count; e++) {
      const uint32_t *p = fixture.sheet.edge.item[e].point;
      bool first = fixture.sheet.point.item[p[0]].z == SHEET_Z_MAX;
      bool second = fixture.sheet.point.item[p[1]].z == SHEET_Z_MAX;
      assert_false(first && second);
      at_cut += first || second;
    }
    assert_true(at_cut >= 3);
    sheet_fixture_fini(&fixture);
  }
}

/* The side of a box that lies in the near plane itself stays whole. */
static void a_face_in_the_near_plane_stays(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_box(&fixture.scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  build_box(&fixture.scene, vector_of(2, 0, 0), vector_of(3, 1, 2));
  fixture.options.camera.azimuth_deg = fixture.options.camera.elevation_deg = 0;
  fixture.options.camera.near_distance = 1; /* the nearest point is at z = 2 */
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  size_t front = 0;
  for (size_t t = 0; t < fixture.sheet.triangle.count; t++) {
    const uint32_t *p = fixture.sheet.triangle.item[t].point;
    front += fixture.sheet.point.item[p[0]].z == SHEET_Z_MAX &&
             fixture.sheet.point.item[p[1]].z == SHEET_Z_MAX &&
             fixture.sheet.point.item[p[2]].z == SHEET_Z_MAX &&
             !sheet_is_edge_on(&fixture.sheet, t);
  }
  assert_int_equal(front, 2); /* of the lower box: a quad */
  sheet_fixture_fini(&fixture);
}

/* Whether a face is cut by its first corner or by its last must not matter. */
static void the_order_of_corners_changes_no_point(void **state) {
  (void)state;
  struct random random = {41};
  for (int i = 0; i < 200; i++) {
    struct sheet_fixture fixture[2];
    double xyz[9];
    for (int k = 0; k < 9; k++)
      xyz[k] = random_between(&random, -300, 300);
    for (int turn = 0; turn < 2; turn++) {
      sheet_fixture_start(&fixture[turn]);
      struct scene *scene = &fixture[turn].scene;
      build_group(scene, "one");
      for (int c = 0; c < 3; c++)
        build_point(scene, xyz[3 * c], xyz[3 * c + 1], xyz[3 * c + 2]);
      if (turn)
        build_triangle(scene, 2, 1, 0);
      else
        build_triangle(scene, 0, 1, 2);
      fixture[turn].options.camera.fit = RECTO_FIT_NONE;
      fixture[turn].options.ink.edges = RECTO_EDGES_ALL;
      sheet_fixture_out(&fixture[turn], true);
    }
    assert_int_equal(sheet_fixture_area(&fixture[0], 0),
                     sheet_fixture_area(&fixture[1], 0));
    for (size_t e = 0; e < fixture[0].sheet.edge.count; e++)
      for (size_t f = 0; f < fixture[1].sheet.edge.count; f++) {
        const struct sheet_edge *a = &fixture[0].sheet.edge.item[e];
        const struct sheet_edge *b = &fixture[1].sheet.edge.item[f];
        if (memcmp(fixture[0].topology.edge.item[a->source].point,
                   fixture[1].topology.edge.item[b->source].point, 8) != 0)
          continue;
        for (int k = 0; k < 2; k++)
          assert_memory_equal(&fixture[0].sheet.point.item[a->point[k]],
                              &fixture[1].sheet.point.item[b->point[k]],
                              sizeof(struct geom_point));
      }
    sheet_fixture_fini(&fixture[0]);
    sheet_fixture_fini(&fixture[1]);
  }
}

/* ---- Wires --------------------------------------------------------------- */

static void wires_are_edges_segment_by_segment(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_group(&fixture.scene, "wire");
  uint32_t corner[5];
  for (uint32_t c = 0; c < 5; c++)
    corner[c] = build_point(&fixture.scene, c, c % 2, c % 3);
  for (int w = 0; w < 2; w++)
    assert_int_equal(scene_add_wire(&fixture.scene, corner, 5, 0, NULL, NULL),
                     RECTO_OK);
  sheet_fixture_out(&fixture, false);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.edge.count, 8);
  for (uint32_t e = 0; e < 8; e++) {
    const struct sheet_edge *edge = &fixture.sheet.edge.item[e];
    assert_int_equal(edge->edge_class, RECTO_EDGE_WIRE);
    assert_int_equal(edge->source, e / 4);
    assert_int_equal(edge->part, e % 4);
    if (e % 4 > 0)
      assert_int_equal(edge->point[0], edge[-1].point[1]);
  }
  sheet_fixture_fini(&fixture);
}

static void wires_are_cut_at_the_page(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_group(&fixture.scene, "wire");
  build_segment(&fixture.scene, build_point(&fixture.scene, -500, 0, 0),
                build_point(&fixture.scene, 500, 0, 0));
  build_segment(&fixture.scene, build_point(&fixture.scene, -500, 400, 0),
                build_point(&fixture.scene, 500, 400, 0)); /* beyond it */
  fixture.options.camera.fit = RECTO_FIT_NONE;
  fixture.options.camera.has_target = true;
  fixture.options.camera.azimuth_deg = fixture.options.camera.elevation_deg = 0;
  sheet_fixture_out(&fixture, false);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.edge.count, 1);
  const uint32_t *p = fixture.sheet.edge.item[0].point;
  assert_int_equal(fixture.sheet.point.item[p[0]].x,
                   -sheet_fixture_half(&fixture, 0));
  assert_int_equal(fixture.sheet.point.item[p[1]].x,
                   sheet_fixture_half(&fixture, 0));
  sheet_fixture_fini(&fixture);
}

/* The depths are those of the face; the wire, whose ends are not on the page,
 * is set to their end, and yet farther than all of the face by far. */
static void what_is_behind_all_faces_does_not_touch_them(void **state) {
  static const double face[] = {-500, -500, -1, 500, -500, 1, 0, 500, 0};
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_polygon(&fixture.scene, face, 3);
  build_segment(&fixture.scene, build_point(&fixture.scene, -500, 0, -9),
                build_point(&fixture.scene, 500, 0, -9));
  scenes_view_page(&fixture.options, 20, 20);
  sheet_fixture_out(&fixture, false);
  const struct sheet *sheet = &fixture.sheet;
  const struct sheet_edge *wire = &sheet->edge.item[sheet->edge.count - 1];
  assert_int_equal(wire->edge_class, RECTO_EDGE_WIRE);
  for (size_t t = 0; t < sheet->triangle.count; t++)
    for (int k = 0; k < 3; k++)
      assert_true(sheet->point.item[sheet->triangle.item[t].point[k]].z >
                  sheet->point.item[wire->point[0]].z + SHEET_Z_MAX / 4);
  sheet_fixture_fini(&fixture);
}

/* A wall that is seen edge-on, and that the near plane cuts, stands in a floor
 * that fills the page, and all of whose depths are equal. */
static void what_is_left_of_a_wall_pierces_the_floor(void **state) {
  static const double floor[] = {-500, -500, 0, 500, -500, 0, 0, 500, 0},
                      wall[] = {-500, 10, -9, 500,  10, -9,
                                500,  10, 9,  -500, 10, 9};
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    build_polygon(&fixture.scene, floor, 3);
    build_polygon(&fixture.scene, wall, 4);
    scenes_view_page(&fixture.options, 20, 20);
    fixture.options.camera.fov_deg = perspective ? 1 : 0;
    fixture.options.camera.near_distance = 995;
    sheet_fixture_out(&fixture, false);
    const struct sheet *sheet = &fixture.sheet;
    int64_t nearest = 0, at_floor = 0;
    for (size_t t = 0; t < sheet->triangle.count; t++)
      for (int k = 0; k < 3; k++) {
        const struct sheet_triangle *triangle = &sheet->triangle.item[t];
        int64_t z = sheet->point.item[triangle->point[k]].z;
        if (triangle->face == 0)
          at_floor = z;
        else if (z > nearest)
          nearest = z;
      }
    assert_true(nearest > at_floor + SHEET_Z_MAX / 8);
    sheet_fixture_fini(&fixture);
  }
}

/* A long face is off its plane by a little, compared with its length, but by
 * far more than contact: it may hide its own edges. */
static void only_planar_faces_are_marked_coplanar(void **state) {
  (void)state;
  for (int bent = 0; bent < 2; bent++) {
    const double face[] = {
        1, 0, 0, 0.5, 2, bent ? 1.5 : 0, 0.5, 1, bent ? 1.5 : 0, 0, 1000, 0};
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    build_polygon(&fixture.scene, face, 4);
    fixture.options.camera.elevation_deg = 60;
    sheet_fixture_out(&fixture, false);
    assert_int_equal(fixture.sheet.triangle.count, 2);
    for (int t = 0; t < 2; t++)
      assert_int_equal(!(fixture.sheet.triangle_flags[t] & SHEET_COPLANAR),
                       bent);
    sheet_fixture_fini(&fixture);
  }
}

/* The page cuts off corners of both triangles of a bent face; a triangle of
 * which one piece is left is none of several. */
static void what_clipping_leaves_of_a_triangle_is_marked(void **state) {
  static const double face[] = {10, -9, 0, 40, 10, 3, 10, 29, 0, -20, 10, 3},
                      corner[] = {10, 10, 9, 90, 10, 9, 10, 90, 9};
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  build_polygon(&fixture.scene, face, 4);
  build_polygon(&fixture.scene, corner, 3);
  scenes_view_page(&fixture.options, 20, 20);
  sheet_fixture_out(&fixture, false);
  const struct sheet *sheet = &fixture.sheet;
  int first[2] = {0, 0}, pieces[2] = {0, 0};
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    uint32_t f = sheet->triangle.item[t].face;
    first[f] += (sheet->triangle_flags[t] & SHEET_FIRST_PIECE) != 0;
    pieces[f] += (sheet->triangle_flags[t] & SHEET_PIECE) != 0;
    assert_int_equal(sheet_is_coplanar(sheet, 0, t), f == 0 && first[0] == 1);
  }
  assert_int_equal(first[0], 2);
  assert_true(pieces[0] >= 4);
  assert_int_equal(first[1], pieces[1] > 0);
  sheet_fixture_fini(&fixture);
}

/* Of the second triangle of a bent face, a strip is left behind the near plane
 * that is thinner than the grid: it lies where the triangle lies, so that the
 * face does not fold there. */
static void a_strip_thinner_than_the_grid_makes_no_fold(void **state) {
  (void)state;
  for (int strip = 0; strip < 2; strip++) {
    static const double face[] = {5, 5, 0, 5, 15, 0, 15, 15, -3, 15, 5, 1};
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    build_polygon(&fixture.scene, face, 4);
    scenes_view_page(&fixture.options, 20, 20);
    fixture.options.ink.edges = RECTO_EDGE_SILHOUETTE;
    fixture.options.camera.near_distance = strip ? 1000 - 1e-9 : 0;
    sheet_fixture_out(&fixture, false);
    for (size_t e = 0; e < fixture.sheet.edge.count; e++)
      assert_int_not_equal(fixture.sheet.edge.item[e].source, SHEET_NONE);
    sheet_fixture_fini(&fixture);
  }
}

/* Triangles so thin that rounding turns them, along the back of a comb, are no
 * folds of its planar face. */
static void triangles_that_rounding_turns_make_no_fold(void **state) {
  enum { TEETH = 1000, CORNERS = 2 * TEETH + 2 };
  static double face[3 * CORNERS];
  struct sheet_fixture fixture;
  (void)state;
  for (int i = 0; i < 2 * TEETH; i++) {
    face[3 * i] = 0.5 * i;
    face[3 * i + 1] = i % 2 * 20;
  }
  face[3 * (2 * TEETH)] = TEETH;
  face[3 * (2 * TEETH) + 1] = face[3 * (2 * TEETH + 1) + 1] = -0.0005;
  sheet_fixture_start(&fixture);
  build_polygon(&fixture.scene, face, CORNERS);
  fixture.options.ink.edges = RECTO_EDGE_SILHOUETTE;
  sheet_fixture_out(&fixture, false);
  assert_true(fixture.sheet.triangle.count > TEETH);
  for (size_t e = 0; e < fixture.sheet.edge.count; e++)
    assert_int_not_equal(fixture.sheet.edge.item[e].source, SHEET_NONE);
  sheet_fixture_fini(&fixture);
}

static void wires_not_requested_are_left_out(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_group(&fixture.scene, "wire");
  build_segment(&fixture.scene, build_point(&fixture.scene, 0, 0, 0),
                build_point(&fixture.scene, 1, 0, 0));
  fixture.options.ink.edges = RECTO_EDGES_ALL & ~(unsigned)RECTO_EDGE_WIRE;
  sheet_fixture_out(&fixture, true);
  assert_int_equal(fixture.sheet.edge.count, 0);
  sheet_fixture_fini(&fixture);
}

/* ---- Diagonals, welds, warps --------------------------------------------- */

static void diagonals_are_no_edges(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_parallelogram(&fixture.scene, vector_of(0, 0, 0), vector_of(3, 0, 0),
                      vector_of(0, 2, 0));
  fixture.options.ink.edges = RECTO_EDGES_ALL;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.edge.count, 4);
  assert_int_equal(fixture.sheet.triangle.count, 2);
  size_t without = 0;
  for (size_t t = 0; t < 2; t++)
    for (int k = 0; k < 3; k++)
      without += fixture.sheet.sides.item[t].edge[k] == SHEET_NONE;
  assert_int_equal(without, 2);
  sheet_fixture_fini(&fixture);
}

static void welded_points_are_one_on_the_sheet(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  scenes_unwelded(&fixture.scene, &fixture.options);
  fixture.options.ink.edges = RECTO_EDGES_ALL;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  size_t standing = 0;
  for (uint32_t p = 0; p < fixture.scene.point.count; p++)
    standing += fixture.topology.weld[p] == p;
  assert_int_equal(fixture.sheet.point.count, standing);
  sheet_fixture_fini(&fixture);
}

static void warped_faces_are_counted_and_drawn(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  const double xyz[] = {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0};
  build_polygon(&fixture.scene, xyz, 4);
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.warped, 1);
  assert_int_equal(fixture.sheet.triangle.count, 2);
  assert_int_equal(fixture.sheet.edge.count, 4);
  sheet_fixture_fini(&fixture);
}

/* ---- Scale --------------------------------------------------------------- */

static void powers_of_two_change_no_bit_of_the_sheet(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct sheet_fixture fixture[2];
    for (int i = 0; i < 2; i++) {
      const double factor = i ? 0x1p+30 : 1;
      recto_options *o = &fixture[i].options;
      sheet_fixture_start(&fixture[i]);
      entry->fill(&fixture[i].scene, o);
      scenes_scale(&fixture[i].scene, factor, vector_of(0, 0, 0));
      for (int k = 0; k < 3; k++) {
        o->camera.eye[k] *= factor;
        o->camera.target[k] *= factor;
      }
      o->camera.near_distance *= factor;
      o->camera.section *= factor;
      o->camera.scale /= factor;
      o->camera.fit =
          o->camera.fit == RECTO_FIT_NONE ? RECTO_FIT_PAGE : o->camera.fit;
      sheet_fixture_out(&fixture[i], true);
    }
    const struct sheet *a = &fixture[0].sheet, *b = &fixture[1].sheet;
    assert_int_equal(a->point.count, b->point.count);
    assert_int_equal(a->triangle.count, b->triangle.count);
    assert_int_equal(a->edge.count, b->edge.count);
    assert_int_equal(a->contour.count, b->contour.count);
    assert_memory_equal(a->point.item, b->point.item,
                        a->point.count * sizeof *a->point.item);
    if (a->triangle.count > 0)
      assert_memory_equal(a->triangle.item, b->triangle.item,
                          a->triangle.count * sizeof *a->triangle.item);
    if (a->edge.count > 0)
      assert_memory_equal(a->edge.item, b->edge.item,
                          a->edge.count * sizeof *a->edge.item);
    sheet_fixture_fini(&fixture[0]);
    sheet_fixture_fini(&fixture[1]);
  }
}

/* ---- Faults -------------------------------------------------------------- */

static void every_failed_allocation_is_reported(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  fill_large_grid(&fixture, 5, false); /* clipped, and of quads */
  build_segment(&fixture.scene, 0, 35);
  fixture.options.ink.edges = RECTO_EDGES_ALL;
  sheet_fixture_out(&fixture, true);
  struct memory_faults faults = {.least = 15};
  while (memory_faults_go_on(&faults)) {
    struct sheet sheet;
    recto_error error = {0};
    memory_faults_begin(&faults);
    recto_status status =
        layout_sheet(&sheet, &fixture.scene, &fixture.topology, &fixture.camera,
                     &fixture.options, true, &error);
    memory_faults_end(&faults, status);
    if (status == RECTO_OK) {
      sheet_fini(&sheet);
    } else {
      assert_int_equal(error.code, RECTO_ERROR_MEMORY);
      assert_null(sheet.point.item);
      assert_null(sheet.triangle_flags);
    }
  }
  sheet_fixture_fini(&fixture);
}

/* ---- Sides that the topology left out ------------------------------------ */

/* A page that clips needs them: the sheet is the same as with them. */
static void sides_that_were_left_out_are_found(void **state) {
  (void)state;
  struct sheet_fixture fixture[2];
  recto_error error = {0};
  for (int i = 0; i < 2; i++) {
    struct sheet_fixture *f = &fixture[i];
    sheet_fixture_start(f);
    f->options.camera.fit = RECTO_FIT_SCALE;
    f->options.camera.scale = 20;
    for (int p = 0; p < 9; p++)
      build_point(&f->scene, 5 * (p % 3), 0.1 * p * p, 5 * (p / 3));
    build_group(&f->scene, "grid");
    for (uint32_t p = 0; p < 5; p += p == 1 ? 2 : 1) {
      build_triangle(&f->scene, p, p + 1, p + 4);
      build_triangle(&f->scene, p, p + 4, p + 3);
    }
    sheet_fixture_out(f, true);
    assert_true(f->sheet.clipped_page > 0);
  }
  struct sheet *sheet = &fixture[1].sheet, *whole = &fixture[0].sheet;
  sheet_fini(sheet);
  topology_fini(&fixture[1].topology);
  assert_int_equal(
      topology_init_edges(&fixture[1].topology, &fixture[1].scene, &error),
      RECTO_OK);
  assert_null(fixture[1].topology.corner_edge);
  assert_int_equal(layout_sheet(sheet, &fixture[1].scene, &fixture[1].topology,
                                &fixture[1].camera, &fixture[1].options, true,
                                &error),
                   RECTO_OK);
  assert_int_equal(sheet->edge.count, whole->edge.count);
  assert_int_equal(sheet->triangle.count, whole->triangle.count);
  assert_memory_equal(sheet->edge.item, whole->edge.item,
                      sheet->edge.count * sizeof *sheet->edge.item);
  assert_memory_equal(sheet->triangle.item, whole->triangle.item,
                      sheet->triangle.count * sizeof *sheet->triangle.item);
  for (int i = 0; i < 2; i++)
    sheet_fixture_fini(&fixture[i]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_scenes_keep_every_invariant),
      cmocka_unit_test(sides_at_one_point_are_found_with_few_comparisons),
      cmocka_unit_test(sides_that_are_left_out_are_found),
      cmocka_unit_test(random_scenes_keep_every_invariant),
      cmocka_unit_test(clipped_scenes_keep_every_invariant),
      cmocka_unit_test(edges_of_a_point_that_are_cut_in_one_place_share_it),
      cmocka_unit_test(an_eye_in_a_degenerate_position_is_handled),
      cmocka_unit_test(points_are_snapped_to_the_nearest_grid_unit),
      cmocka_unit_test(depth_fills_its_range),
      cmocka_unit_test(planes_stay_planes),
      cmocka_unit_test(a_flat_scene_square_on_is_fine),
      cmocka_unit_test(a_noisy_flat_scene_does_not_blow_depth_up),
      cmocka_unit_test(triangles_of_a_polygon_have_its_area_exactly),
      cmocka_unit_test(a_grid_beyond_the_page_fills_the_page_exactly),
      cmocka_unit_test(a_polygon_around_the_page_is_cut_to_the_page),
      cmocka_unit_test(a_floor_to_the_horizon_is_cut_by_both),
      cmocka_unit_test(a_drawing_that_fits_the_page_is_never_cut),
      cmocka_unit_test(a_cut_edge_is_cut_once_for_all_who_use_it),
      cmocka_unit_test(a_near_plane_cuts_and_leaves_no_line),
      cmocka_unit_test(a_face_in_the_near_plane_stays),
      cmocka_unit_test(the_order_of_corners_changes_no_point),
      cmocka_unit_test(wires_are_edges_segment_by_segment),
      cmocka_unit_test(wires_are_cut_at_the_page),
      cmocka_unit_test(what_is_behind_all_faces_does_not_touch_them),
      cmocka_unit_test(what_is_left_of_a_wall_pierces_the_floor),
      cmocka_unit_test(only_planar_faces_are_marked_coplanar),
      cmocka_unit_test(what_clipping_leaves_of_a_triangle_is_marked),
      cmocka_unit_test(a_strip_thinner_than_the_grid_makes_no_fold),
      cmocka_unit_test(triangles_that_rounding_turns_make_no_fold),
      cmocka_unit_test(wires_not_requested_are_left_out),
      cmocka_unit_test(diagonals_are_no_edges),
      cmocka_unit_test(welded_points_are_one_on_the_sheet),
      cmocka_unit_test(warped_faces_are_counted_and_drawn),
      cmocka_unit_test(powers_of_two_change_no_bit_of_the_sheet),
      cmocka_unit_test(every_failed_allocation_is_reported),
      cmocka_unit_test(sides_that_were_left_out_are_found),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
