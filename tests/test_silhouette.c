/* test_silhouette.c - the classes of edges in a view. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"

/* A camera in front: x right, y up, z towards the viewer. */
static void start_in_front(struct sheet_fixture *fixture) {
  sheet_fixture_start(fixture);
  fixture->options.camera.azimuth_deg = fixture->options.camera.elevation_deg =
      0;
  fixture->options.ink.edges = RECTO_EDGES_ALL;
}

static void start_from_corner(struct sheet_fixture *fixture) {
  sheet_fixture_start(fixture);
  fixture->options.camera.azimuth_deg = 33;
  fixture->options.camera.elevation_deg = 21;
  fixture->options.ink.edges = RECTO_EDGES_ALL;
}

/* ---- Solids -------------------------------------------------------------- */

static void a_box_from_a_corner_has_six_silhouettes(void **state) {
  (void)state;
  for (int perspective = 0; perspective < 2; perspective++) {
    struct sheet_fixture fixture;
    start_from_corner(&fixture);
    fixture.options.camera.fov_deg = perspective ? 30 : 0;
    build_box(&fixture.scene, vector_of(0, 0, 0), vector_of(1, 2, 3));
    sheet_fixture_out(&fixture, true);
    sheet_fixture_check(&fixture);
    assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_SILHOUETTE), 6);
    assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_CREASE), 6);
    assert_int_equal(fixture.sheet.contour.count, 6);
    sheet_fixture_fini(&fixture);
  }
}

/* Front and back are outlines, the four sides are seen edge-on. */
static void a_box_square_on_has_the_outlines_of_its_ends(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_in_front(&fixture);
  build_box(&fixture.scene, vector_of(0, 0, 0), vector_of(1, 2, 3));
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_SILHOUETTE), 8);
  assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_CREASE),
                   4); /* end-on */
  sheet_fixture_fini(&fixture);
}

/* At every point of a closed surface without seams silhouettes come in pairs:
 * they are closed loops. */
static void silhouettes_of_a_closed_surface_are_closed(void **state) {
  (void)state;
  for (unsigned rings = 4; rings <= 30; rings += 13)
    for (double azimuth = 0; azimuth < 360; azimuth += 41) {
      struct sheet_fixture fixture;
      start_from_corner(&fixture);
      scenes_globe(&fixture.scene, &fixture.options, rings);
      fixture.options.camera.azimuth_deg = azimuth;
      fixture.options.ink.edges = RECTO_EDGE_SILHOUETTE;
      sheet_fixture_out(&fixture, false);
      sheet_fixture_check(&fixture);
      assert_true(fixture.sheet.edge.count > 0);
      uint8_t *degree = calloc(fixture.sheet.point.count, 1);
      for (size_t e = 0; e < fixture.sheet.edge.count; e++)
        for (int k = 0; k < 2; k++)
          degree[fixture.sheet.edge.item[e].point[k]]++;
      for (size_t p = 0; p < fixture.sheet.point.count; p++)
        assert_int_equal(degree[p] % 2, 0);
      free(degree);
      sheet_fixture_fini(&fixture);
    }
}

/* ---- The two faces of an edge -------------------------------------------- */

/* Two triangles at the edge from (0, 0, 0) to (0, 4, 0), their third corners
 * where requested; returns the class of that edge. */
static unsigned class_of_hinge(struct vector left, struct vector right,
                               bool turned, unsigned edges) {
  struct sheet_fixture fixture;
  start_in_front(&fixture);
  fixture.options.ink.edges = edges;
  build_group(&fixture.scene, "hinge");
  build_point(&fixture.scene, 0, 0, 0);
  build_point(&fixture.scene, 0, 4, 0);
  build_vector(&fixture.scene, left);
  build_vector(&fixture.scene, right);
  build_triangle(&fixture.scene, 0, 1, 2);
  if (turned)
    build_triangle(&fixture.scene, 0, 1, 3);
  else
    build_triangle(&fixture.scene, 1, 0, 3);
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.topology.edge.item[0].uses, 2);
  assert_int_equal(fixture.sheet.edge.item[0].source, 0);
  unsigned edge_class = fixture.sheet.edge.item[0].edge_class;
  sheet_fixture_fini(&fixture);
  return edge_class;
}

static void winding_does_not_matter(void **state) {
  (void)state;
  const unsigned all = RECTO_EDGES_ALL;
  for (int turned = 0; turned < 2; turned++) {
    /* one on either side, flat and bent */
    assert_int_equal(
        class_of_hinge(vector_of(-3, 1, 0), vector_of(3, 1, 0), turned, all),
        RECTO_EDGE_SMOOTH);
    assert_int_equal(
        class_of_hinge(vector_of(-3, 1, -3), vector_of(3, 1, -3), turned, all),
        RECTO_EDGE_CREASE);
    /* both on one side */
    assert_int_equal(
        class_of_hinge(vector_of(3, 1, 3), vector_of(3, 1, -3), turned, all),
        RECTO_EDGE_SILHOUETTE);
    assert_int_equal(
        class_of_hinge(vector_of(-3, 1, 3), vector_of(-2, 1, -3), turned, all),
        RECTO_EDGE_SILHOUETTE);
    /* one of them edge-on */
    assert_int_equal(
        class_of_hinge(vector_of(0, 1, 3), vector_of(3, 1, 0), turned, all),
        RECTO_EDGE_SILHOUETTE);
    assert_int_equal(
        class_of_hinge(vector_of(-3, 1, 0), vector_of(0, 1, -3), turned, all),
        RECTO_EDGE_SILHOUETTE);
    /* both of them */
    assert_int_equal(
        class_of_hinge(vector_of(0, 1, 3), vector_of(0, 1, -3), turned, all),
        RECTO_EDGE_SMOOTH);
  }
}

static void the_first_requested_class_is_the_edge_s(void **state) {
  (void)state;
  const struct vector over = vector_of(3, 1, 3), under = vector_of(3, 1, -3);
  const struct vector left = vector_of(-3, 1, -3), right = vector_of(3, 1, -3);
  /* a silhouette that is a crease, too */
  assert_int_equal(class_of_hinge(over, under, false, RECTO_EDGES_ALL),
                   RECTO_EDGE_SILHOUETTE);
  assert_int_equal(class_of_hinge(over, under, false, RECTO_EDGE_CREASE),
                   RECTO_EDGE_CREASE);
  assert_int_equal(class_of_hinge(over, under, false, RECTO_EDGE_SMOOTH), 0);
  /* a crease alone */
  assert_int_equal(class_of_hinge(left, right, false, RECTO_EDGE_SILHOUETTE),
                   0);
  /* a silhouette is smooth no more */
  assert_int_equal(class_of_hinge(vector_of(3, 1, 0.1), vector_of(3, 1, 0),
                                  true, RECTO_EDGE_SMOOTH),
                   0);
}

/* Shuffled faces, turned at random, have the same edges of the same classes. */
struct known {
  struct geom_point end[2];
  uint16_t edge_class;
};

static int compare_known(const void *one, const void *other) {
  return memcmp(one, other, sizeof(struct known));
}

static struct known *list_known(const struct sheet_fixture *fixture) {
  const struct sheet *sheet = &fixture->sheet;
  struct known *known = calloc(sheet->edge.count + 1, sizeof *known);
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    const struct geom_point *p = &sheet->point.item[edge->point[0]];
    const struct geom_point *q = &sheet->point.item[edge->point[1]];
    bool swap = memcmp(p, q, sizeof *p) > 0;
    known[e].end[0] = swap ? *q : *p;
    known[e].end[1] = swap ? *p : *q;
    known[e].edge_class = edge->edge_class;
  }
  qsort(known, sheet->edge.count, sizeof *known, compare_known);
  return known;
}

static void turn_faces(struct scene *scene, struct random *random) {
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    uint32_t *first = scene->corner.item + scene_face_start(scene, f);
    uint32_t *last = scene->corner.item + scene_face_start(scene, f + 1) - 1;
    if (random_below(random, 2))
      continue;
    for (; first < last; first++, last--) {
      uint32_t corner = *first;
      *first = *last;
      *last = corner;
    }
  }
}

static void order_and_winding_of_faces_change_no_class(void **state) {
  (void)state;
  struct random random = {51};
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct sheet_fixture fixture[2];
    for (int i = 0; i < 2; i++) {
      sheet_fixture_start(&fixture[i]);
      if (i == 0) {
        entry->fill(&fixture[0].scene, &fixture[0].options);
        fixture[0].options.ink.edges = RECTO_EDGES_ALL;
      } else {
        fixture[1].options = fixture[0].options;
        scenes_copy(&fixture[1].scene, &fixture[0].scene, 99);
        turn_faces(&fixture[1].scene, &random);
      }
      sheet_fixture_out(&fixture[i], false);
      sheet_fixture_check(&fixture[i]);
    }
    struct known *a = list_known(&fixture[0]), *b = list_known(&fixture[1]);
    assert_int_equal(fixture[0].sheet.edge.count, fixture[1].sheet.edge.count);
    assert_memory_equal(a, b, (fixture[0].sheet.edge.count + 1) * sizeof *a);
    free(a);
    free(b);
    sheet_fixture_fini(&fixture[0]);
    sheet_fixture_fini(&fixture[1]);
  }
}

/* ---- Borders, groups, outlines ------------------------------------------- */

static void a_lone_face_has_borders(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_from_corner(&fixture);
  build_parallelogram(&fixture.scene, vector_of(0, 0, 0), vector_of(3, 0, 0),
                      vector_of(0, 2, 0));
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_BORDER), 4);
  assert_int_equal(fixture.sheet.contour.count, 4);
  sheet_fixture_fini(&fixture);
}

static void
where_groups_meet_is_an_edge_of_the_first_face_s_group(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_from_corner(&fixture);
  build_group(&fixture.scene, "one");
  for (int p = 0; p < 6; p++)
    build_point(&fixture.scene, p / 2, p % 2, 0);
  build_quad(&fixture.scene, 0, 2, 3, 1);
  build_group(&fixture.scene, "two");
  build_quad(&fixture.scene, 2, 4, 5, 3);
  fixture.options.ink.edges = RECTO_EDGE_GROUP;
  sheet_fixture_out(&fixture, false);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.edge.count, 1);
  assert_int_equal(fixture.sheet.edge.item[0].edge_class, RECTO_EDGE_GROUP);
  assert_int_equal(sheet_edge_group(&fixture.sheet, fixture.sheet.edge.item),
                   0);
  sheet_fixture_fini(&fixture);
}

/* For any request, the same edges are drawn with outlines as without. */
static void outlines_add_edges_that_are_not_drawn(void **state) {
  (void)state;
  for (unsigned edges = 0; edges <= RECTO_EDGES_ALL; edges += 5) {
    struct sheet_fixture fixture[2];
    for (int all_edges = 0; all_edges < 2; all_edges++) {
      start_from_corner(&fixture[all_edges]);
      build_box(&fixture[all_edges].scene, vector_of(0, 0, 0),
                vector_of(1, 2, 3));
      build_parallelogram(&fixture[all_edges].scene, vector_of(4, 0, 0),
                          vector_of(1, 0, 0), vector_of(0, 1, 1));
      fixture[all_edges].options.ink.edges = edges;
      sheet_fixture_out(&fixture[all_edges], all_edges);
      sheet_fixture_check(&fixture[all_edges]);
    }
    assert_int_equal(sheet_fixture_count(&fixture[0], 0), 0);
    assert_int_equal(fixture[1].sheet.edge.count, 16);
    for (unsigned bit = 1; bit <= RECTO_EDGE_SMOOTH; bit *= 2)
      assert_int_equal(sheet_fixture_count(&fixture[0], bit),
                       sheet_fixture_count(&fixture[1], bit));
    assert_int_equal(fixture[0].sheet.contour.count,
                     fixture[1].sheet.contour.count);
    sheet_fixture_fini(&fixture[0]);
    sheet_fixture_fini(&fixture[1]);
  }
}

/* How many drawn or undrawn edges are diagonals. */
static size_t count_folds(const struct sheet *sheet) {
  size_t folds = 0;
  for (size_t e = 0; e < sheet->edge.count; e++)
    folds += sheet->edge.item[e].source == SHEET_NONE;
  return folds;
}

/* A warped face folds at its diagonal: that is a silhouette then and a contour,
 * and else it is no edge at all. */
static void a_fold_at_a_diagonal_is_a_silhouette(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_in_front(&fixture);
  const double xyz[] = {0, 0, 0, 3, 0, 0, 3, 3, 2, 0, 3, 0};
  build_polygon(&fixture.scene, xyz, 4);
  int folded = 0;
  for (int turn = 0; turn < 4 * 26; turn++) {
    struct sheet_fixture turned = fixture;
    bool requested = turn & 1, all_edges = turn & 2;
    turned.options.camera.azimuth_deg = 7 * (turn / 4);
    turned.options.ink.edges =
        RECTO_EDGE_BORDER | (requested ? RECTO_EDGE_SILHOUETTE : 0);
    sheet_fixture_out(&turned, all_edges);
    if (all_edges)
      sheet_fixture_check(&turned);
    const struct sheet *sheet = &turned.sheet;
    bool fold =
        (sheet->triangle_flags[0] ^ sheet->triangle_flags[1]) & SHEET_FLIPPED;
    folded += fold;
    assert_int_equal(sheet->contour.count, 4 + fold);
    assert_int_equal(count_folds(sheet), fold && (requested || all_edges));
    assert_int_equal(sheet_fixture_count(&turned, RECTO_EDGE_SILHOUETTE),
                     fold && requested);
    sheet_fini(&turned.sheet);
    topology_fini(&turned.topology);
  }
  assert_in_range(folded, 1, 4 * 26 - 1);
  sheet_fixture_fini(&fixture);
}

/* A wall of which rounding moved the corners, seen from its edge: no two of
 * its triangles part the front from the back. */
static void rounding_makes_no_fold(void **state) {
  (void)state;
  const double off = 1e-7;
  struct sheet_fixture fixture;
  start_in_front(&fixture);
  const double xyz[] = {0, 0, 0,    0, 3, off, 0, 5,   1,    off, 5,
                        3, 0, -off, 4, 0, -1,  2, off, -0.5, 1};
  build_polygon(&fixture.scene, xyz, 7);
  build_parallelogram(&fixture.scene, vector_of(2, 0, 0), vector_of(1, 0, 0),
                      vector_of(0, 0, 1));
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(count_folds(&fixture.sheet), 0);
  sheet_fixture_fini(&fixture);
}

/* The sides of a warped face are silhouettes by the triangles that meet there,
 * and creases by the faces' normals on the whole: a surface of gently warped
 * quadrilaterals has no creases, and every point of its outline lies on a
 * silhouette or a border. */
static void warp_alone_makes_no_crease(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_from_corner(&fixture);
  build_group(&fixture.scene, "saddle");
  for (int row = 0; row <= 12; row++)
    for (int column = 0; column <= 12; column++)
      build_point(&fixture.scene, column - 6, row - 6,
                  0.03 * (column - 6) * (row - 6) +
                      ((row + column) % 2 ? 0.12 : -0.12));
  build_grid(&fixture.scene, 0, 12, 12, false);
  fixture.options.mesh.crease_deg = 20;
  sheet_fixture_out(&fixture, true);
  sheet_fixture_check(&fixture);
  assert_int_equal(fixture.sheet.warped, 144);
  assert_int_equal(sheet_fixture_count(&fixture, RECTO_EDGE_CREASE), 0);
  sheet_fixture_fini(&fixture);
}

/* Of a smooth surface that leaves the page, no edge becomes a silhouette
 * because its face does. */
static void clipping_makes_no_silhouettes(void **state) {
  (void)state;
  struct sheet_fixture fixture;
  start_in_front(&fixture);
  build_group(&fixture.scene, "grid");
  for (int row = 0; row <= 30; row++)
    for (int column = 0; column <= 30; column++)
      build_point(&fixture.scene, 10 * column - 151.3, 10 * row - 147.9,
                  0.01 * row * column);
  build_grid(&fixture.scene, 0, 30, 30, true);
  fixture.options.camera.fit = RECTO_FIT_NONE;
  fixture.options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
  sheet_fixture_out(&fixture, false);
  sheet_fixture_check(&fixture);
  assert_true(fixture.sheet.clipped_page > 0);
  assert_int_equal(fixture.sheet.edge.count, 0);
  sheet_fixture_fini(&fixture);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_from_a_corner_has_six_silhouettes),
      cmocka_unit_test(a_box_square_on_has_the_outlines_of_its_ends),
      cmocka_unit_test(silhouettes_of_a_closed_surface_are_closed),
      cmocka_unit_test(winding_does_not_matter),
      cmocka_unit_test(the_first_requested_class_is_the_edge_s),
      cmocka_unit_test(order_and_winding_of_faces_change_no_class),
      cmocka_unit_test(a_lone_face_has_borders),
      cmocka_unit_test(where_groups_meet_is_an_edge_of_the_first_face_s_group),
      cmocka_unit_test(outlines_add_edges_that_are_not_drawn),
      cmocka_unit_test(a_fold_at_a_diagonal_is_a_silhouette),
      cmocka_unit_test(rounding_makes_no_fold),
      cmocka_unit_test(warp_alone_makes_no_crease),
      cmocka_unit_test(clipping_makes_no_silhouettes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
