/* test_smooth_borders.c - smooth contours of open surfaces end on the borders,
 * and the outline goes on from there: also where faces are warped,
 * run round in different ways, or occur twice. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

/* ---- Meshes -------------------------------------------------------------- */

/* The zone of a sphere from near its pole to its equator. */
static void bowl(double u, double v, double p[3]) {
  smooth_sphere(u, 0.5 + v * (M_PI - 0.5) / (2 * M_PI), p);
}

/* A square that ends along u and v. */
static void waves(double u, double v, double p[3]) {
  p[0] = u / M_PI - 1;
  p[1] = 0.2 * sin(2 * u) * cos(1.5 * v);
  p[2] = v / M_PI - 1;
}

/* The same with quads that turn over as a whole. */
static void folds(double u, double v, double p[3]) {
  p[0] = u / M_PI - 1;
  p[1] = 0.25 * sin(5 * p[0]) * cos(5 * (v / M_PI - 1));
  p[2] = 1 - v / M_PI;
}

/* Meshes of quads that end where v does. */
enum mesh_kind {
  OPEN,    /* it ends where u does, too */
  CLOSED,  /* it is closed along u */
  MIXED,   /* it is, and some quads run the other way round */
  DOUBLED, /* it is, and some quads are there twice */
};

/* A mesh of n x m quads. */
static recto_scene *open_scene(smooth_surface *at, enum mesh_kind kind,
                               uint32_t n, uint32_t m) {
  uint32_t row = kind == OPEN ? n + 1 : n;
  size_t points = (size_t)row * (m + 1), corners = 0;
  double *point = malloc(points * 3 * sizeof *point);
  uint32_t *corner = malloc((size_t)n * m * 8 * sizeof *corner);
  recto_scene *scene;
  assert_non_null(point);
  assert_non_null(corner);
  for (uint32_t j = 0; j <= m; j++)
    for (uint32_t i = 0; i < row; i++)
      at(2 * M_PI * i / n, 2 * M_PI * j / m, point + 3 * ((size_t)j * row + i));
  for (uint32_t j = 0; j < m; j++)
    for (uint32_t i = 0; i < n; i++) {
      uint32_t next = (i + 1) % row;
      bool turned = kind == MIXED && (i * i + 3 * j) % 7 < 3;
      corner[corners++] = j * row + i;
      corner[corners++] = turned ? (j + 1) * row + i : j * row + next;
      corner[corners++] = (j + 1) * row + next;
      corner[corners++] = turned ? j * row + next : (j + 1) * row + i;
      bool twice = kind == DOUBLED && (i * i + 3 * j) % 7 == 0;
      for (int k = 0; k < 4 && twice; k++, corners++)
        corner[corners] = corner[corners - 4];
    }
  scene = smooth_quads(point, points, corner, corners);
  free(point);
  free(corner);
  return scene;
}

/* ---- The outline --------------------------------------------------------- */

struct outline_distance {
  double most; /* from the middle of a side to ink, mm */
  double bare; /* the length that is farther from it than half a line, mm */
};

static void find_distance(const recto_drawing *drawing,
                          const recto_half_edge *p, const recto_half_edge *q,
                          struct outline_distance *found) {
  double x = q->x_mm - p->x_mm, y = q->y_mm - p->y_mm, length = hypot(x, y);
  int parts = 2 * (int)(2 * length) + 1;
  for (int i = 0; i < parts; i++) {
    double t = (i + 0.5) / parts;
    const double at[2] = {p->x_mm + t * x, p->y_mm + t * y};
    double distance = smooth_distance_to_ink(drawing, RECTO_EDGES_ALL, at);
    if (i == parts / 2)
      found->most = fmax(found->most, distance);
    found->bare += distance > 0.3 ? length / parts : 0;
  }
}

/* How far the outline of the visible faces is from ink. */
static struct outline_distance distance_of_outline(const recto_scene *scene,
                                                   recto_options *options) {
  struct outline_distance found = {0, 0};
  options->ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
  options->results = RECTO_RESULT_FACES;
  recto_drawing *drawing = smooth_draw(scene, options);
  size_t loops, halves;
  const recto_loop *loop = recto_drawing_loops(drawing, &loops);
  const recto_half_edge *half = recto_drawing_half_edges(drawing, &halves);
  for (size_t l = 0; l < loops; l++)
    for (uint32_t i = 0; i < loop[l].count; i++) {
      const recto_half_edge *p = &half[loop[l].half_edge + i];
      const recto_half_edge *q =
          &half[loop[l].half_edge + (i + 1) % loop[l].count];
      if (p->twin == RECTO_NONE)
        find_distance(drawing, p, q, &found);
    }
  recto_drawing_destroy(drawing);
  return found;
}

/* In how many views a side of it is by more than 0.2 mm. */
static int count_off(smooth_surface *at, enum mesh_kind kind, uint32_t n,
                     uint32_t m) {
  recto_scene *scene = open_scene(at, kind, n, m);
  recto_options options;
  int off = 0;
  for (int view = 0; view < 2 * SMOOTH_VIEWS; view++) {
    smooth_view(&options, view);
    off += distance_of_outline(scene, &options).most > 0.2;
  }
  recto_scene_destroy(scene);
  return off;
}

/* How much of it no line covers in a view by options as they are, mm. */
static double bare_length(const recto_scene *scene, double azimuth_deg,
                          double elevation_deg) {
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = azimuth_deg;
  options.camera.elevation_deg = elevation_deg;
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  return distance_of_outline(scene, &options).bare;
}

/* A contour that ends on the rim goes on in it. */
static void a_bowl_has_its_whole_outline(void **state) {
  (void)state;
  /* 9 where the rim ends on the wrong side of a contour; 1 where the mesh hides
   * the edge on which a contour ends. */
  assert_int_equal(count_off(bowl, CLOSED, 48, 12), 0);
}

static void a_torus_of_mixed_faces_has_its_whole_outline(void **state) {
  (void)state;
  /* 1 where edges whose faces run along them the same way are none of it. */
  assert_int_equal(count_off(smooth_torus, MIXED, 64, 32), 0);
}

/* Edges of three faces are borders, on which contours of all three end. */
static void a_torus_with_faces_twice_has_its_whole_outline(void **state) {
  (void)state;
  /* 7 where they end for the edge's first two faces alone, 19 where for none:
   * then borders end on the wrong side of a contour. */
  assert_in_range(count_off(smooth_torus, DOUBLED, 64, 32), 0, 4);
}

/* Their warped quads fold over along their diagonals, which are no edges. */
static void waves_of_warped_faces_have_their_whole_outline(void **state) {
  (void)state;
  /* 7 without the diagonals; 4 where the mesh hides the edge on which a contour
   * ends. */
  assert_in_range(count_off(waves, OPEN, 24, 24), 0, 3);
}

/* Where quads turn over, a corner of the outline may have contours in the faces
 * about its edge that are farther away than these are wide. */
static void the_outline_of_folds_is_covered(void **state) {
  (void)state;
  recto_scene *scene = open_scene(folds, OPEN, 16, 16);
  /* 21 where it is moved there all the same. */
  assert_true(bare_length(scene, 100, 20) < 0.5);
  recto_scene_destroy(scene);
}

/* Where the mesh folds over its border beside a contour's end, the border is
 * drawn up to that end: along several edges, and back along the contour,
 * too. */
static void borders_reach_the_contours_that_end_on_them(void **state) {
  static const struct {
    uint32_t n;
    double azimuth_deg, elevation_deg, most_mm;
  } view[] = {
      /* 1.67, 0.78, 0.48 and 0.92 mm where they do not. */
      {64, 200, 15, 0.1},
      {64, 7, -10, 0.1},
      {64, 79, -10, 0.1},
      {64, 103, -10, 0.1},
      /* 7.09 mm; 3.42 of it is where the mesh is coarse. */
      {32, 7, 48, 4},
  };
  (void)state;
  for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
    recto_scene *scene = open_scene(folds, OPEN, view[v].n, view[v].n);
    double mm = bare_length(scene, view[v].azimuth_deg, view[v].elevation_deg);
    if (!(mm < view[v].most_mm))
      fail_msg("%g/%g degrees: %g mm are bare", view[v].azimuth_deg,
               view[v].elevation_deg, mm);
    recto_scene_destroy(scene);
  }
}

/* A square that is bent about both diagonals. */
static void saddle(double u, double v, double p[3]) {
  p[0] = u / M_PI - 1;
  p[2] = 1 - v / M_PI;
  p[1] = 0.4 * sin(3 * p[0] * p[2] + p[0]);
}

/* Triangles of two warped quads may fold over at the edge between these where
 * the quads as a whole do not. */
static void folds_between_warped_quads_are_outlines(void **state) {
  (void)state;
  recto_scene *scene = open_scene(saddle, OPEN, 56, 56);
  /* 5.2 and 1.7 where only edges between quads that are seen from different
   * sides, and diagonals, are outlines. */
  assert_true(bare_length(scene, 31, 22) < 0.3);
  recto_scene_destroy(scene);
  scene = open_scene(folds, OPEN, 32, 32);
  assert_true(bare_length(scene, 199, 48) < 0.3);
  recto_scene_destroy(scene);
}

/* Their contours turn back shortly before they end on a border, so that the
 * last segment says nothing of the side on which the border goes on. */
static void borders_go_on_where_contours_turn_back(void **state) {
  static const double view[][2] = {
      {79, -10}, {79, 19}, {103, -10}, {103, 19}, {295, 48}};
  (void)state;
  recto_scene *scene = open_scene(waves, OPEN, 48, 48);
  for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
    double mm = bare_length(scene, view[v][0], view[v][1]);
    /* 1.37 to 2.92 where that segment is asked. */
    if (!(mm < 0.3))
      fail_msg("%g/%g degrees: %g mm are bare", view[v][0], view[v][1], mm);
  }
  recto_scene_destroy(scene);
}

/* A strip of quads around the Y axis that turns over by a half. */
static recto_scene *open_moebius_band(void) {
  enum { AROUND = 60, ACROSS = 4, ROW = ACROSS + 1 };
  double point[AROUND * ROW][3];
  uint32_t corner[AROUND * ACROSS * 4];
  size_t corners = 0;
  for (uint32_t i = 0; i < AROUND; i++)
    for (uint32_t j = 0; j < ROW; j++) {
      double u = 2 * M_PI * i / AROUND, s = 0.8 * j / ACROSS - 0.4;
      double *p = point[i * ROW + j];
      p[0] = (1 + s * cos(u / 2)) * cos(u);
      p[1] = s * sin(u / 2);
      p[2] = -(1 + s * cos(u / 2)) * sin(u);
      for (uint32_t k = 0; k < 4 && j < ACROSS; k++) {
        bool next = k == 1 || k == 2, over = next && i == AROUND - 1;
        uint32_t at = j + k / 2;
        corner[corners++] =
            (i + next) % AROUND * ROW + (over ? ACROSS - at : at);
      }
    }
  return smooth_quads(point[0], AROUND * ROW, corner, corners);
}

/* A contour that ends on the border turns back there over less than its
 * triangle's height. */
static void the_contour_of_a_band_reaches_its_border(void **state) {
  (void)state;
  recto_scene *scene = open_moebius_band();
  /* 7.4 where the zigzag at its end decides that it is hidden. */
  assert_true(bare_length(scene, 0, 90) < 0.5);
  recto_scene_destroy(scene);
}

/* A contour that turns back in a cusp near its border does not draw the outline
 * beyond, nor does what is led from there to it cross another border. */
static void the_outline_of_a_band_goes_on_beyond_cusps(void **state) {
  /* 3.6, 3.2 and 14.0 without both; the first 1.2 where cusps are no ends, and
   * 3.3 where borders are crossed. */
  static const double view[][3] = {
      {128.9, 66.8, 0.3}, {352.7, -40.6, 0.3}, {180, 50, 5}};
  (void)state;
  recto_scene *scene = open_moebius_band();
  for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
    double mm = bare_length(scene, view[v][0], view[v][1]);
    if (!(mm < view[v][2]))
      fail_msg("%g/%g degrees: %g mm are bare", view[v][0], view[v][1], mm);
  }
  recto_scene_destroy(scene);
}

/* A strip about the Y axis, straight across. */
static void ramp(double u, double v, double p[3]) {
  double turn = 2.5 * u, radius = 0.4 + 0.6 * v / (2 * M_PI);
  p[0] = radius * cos(turn);
  p[1] = 0.8 * (u / M_PI - 1);
  p[2] = -radius * sin(turn);
}

/* Where its lines across are seen end-on its contour is a dot, at which no line
 * ends and which draws nothing of the outline. */
static void the_borders_of_a_ramp_go_on_at_dots(void **state) {
  (void)state;
  recto_scene *scene = open_scene(ramp, OPEN, 80, 4);
  /* 42 and 28 mm where it does. */
  assert_true(bare_length(scene, 60, 0) < 0.5);
  assert_true(bare_length(scene, 120, 0) < 0.5);
  recto_scene_destroy(scene);
}

/* Its contour ends on the rim next to an edge of which the last bit is hidden,
 * and goes on along a crease in a fold that is made straight. */
static void the_rim_of_the_teapot_reaches_its_contour(void **state) {
  (void)state;
  const char *folder = getenv("RECTO_MODELS");
  char path[1000];
  recto_scene *scene;
  recto_options options;
  if (folder == NULL)
    skip();
  snprintf(path, sizeof path, "%.900s/teapot.obj", folder);
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  if (recto_scene_read(scene, path, NULL, NULL, NULL) != RECTO_OK) {
    recto_scene_destroy(scene);
    print_message("no teapot\n");
    skip();
  }
  recto_options_init(&options);
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  recto_drawing *drawing = smooth_draw(scene, &options);
  /* 10 where zigzags at the ends of contours stay, 14 where the straight line
   * counts as within the surface, too. */
  assert_in_range(
      smooth_loose_ends(drawing, RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER,
                        RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER, 0.3),
      0, 8);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* A wall that folds over just before its border, EAVES_COLUMNS x EAVES_ROWS
 * quads, each step of the latter away from the viewer: one strip leans back, by
 * so little that the mean normals of all vertices face the viewer. */
enum { EAVES_COLUMNS = 40, EAVES_ROWS = 7 };

static recto_scene *eaves(void) {
  static const double step[EAVES_ROWS] = {0.4,  0.4,   0.4, 0.4,
                                          0.15, -0.06, 0.15};
  enum { POINTS = (EAVES_COLUMNS + 1) * (EAVES_ROWS + 1) };
  static double point[POINTS][3];
  static uint32_t corner[EAVES_COLUMNS * EAVES_ROWS * 4];
  size_t corners = 0;
  for (uint32_t i = 0; i <= EAVES_COLUMNS; i++) {
    double x = -1;
    for (uint32_t j = 0; j <= EAVES_ROWS; j++) {
      uint32_t at = i * (EAVES_ROWS + 1) + j;
      const uint32_t quad[4] = {at, at + 1, at + EAVES_ROWS + 2,
                                at + EAVES_ROWS + 1};
      point[at][0] = x;
      point[at][1] = 0.4 * i - 8;
      point[at][2] = -(double)j;
      for (int k = 0; i < EAVES_COLUMNS && j < EAVES_ROWS && k < 4; k++)
        corner[corners++] = quad[k];
      x += j < EAVES_ROWS ? step[j] : 0;
    }
  }
  return smooth_quads(point[0], POINTS, corner, corners);
}

/* The border is nearer to the fold than triangles are high. */
static void a_long_fold_beside_a_border_is_drawn(void **state) {
  (void)state;
  recto_scene *scene = eaves();
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
  recto_drawing *drawing = smooth_draw(scene, &options);
  int silhouettes = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    silhouettes += stroke.edge_class == RECTO_EDGE_SILHOUETTE;
  }
  assert_int_equal(silhouettes, 1);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_bowl_has_its_whole_outline),
      cmocka_unit_test(a_torus_of_mixed_faces_has_its_whole_outline),
      cmocka_unit_test(a_torus_with_faces_twice_has_its_whole_outline),
      cmocka_unit_test(waves_of_warped_faces_have_their_whole_outline),
      cmocka_unit_test(the_outline_of_folds_is_covered),
      cmocka_unit_test(borders_reach_the_contours_that_end_on_them),
      cmocka_unit_test(borders_go_on_where_contours_turn_back),
      cmocka_unit_test(folds_between_warped_quads_are_outlines),
      cmocka_unit_test(the_contour_of_a_band_reaches_its_border),
      cmocka_unit_test(the_outline_of_a_band_goes_on_beyond_cusps),
      cmocka_unit_test(the_borders_of_a_ramp_go_on_at_dots),
      cmocka_unit_test(the_rim_of_the_teapot_reaches_its_contour),
      cmocka_unit_test(a_long_fold_beside_a_border_is_drawn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
