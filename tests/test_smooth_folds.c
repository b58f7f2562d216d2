/* test_smooth_folds.c - folds of a smooth surface that are thin, but long, and
 * short lines behind others are drawn: they are no noise. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

enum { SIDES = 64 };

/* A square of waves, two units wide, of SIDES x SIDES quads. */
static recto_scene *waves(void) {
  static double point[(SIDES + 1) * (SIDES + 1)][3];
  static uint32_t corner[SIDES * SIDES * 4];
  size_t corners = 0;
  for (uint32_t i = 0; i <= SIDES; i++)
    for (uint32_t j = 0; j <= SIDES; j++) {
      double *p = point[i * (SIDES + 1) + j];
      p[0] = 2.0 * i / SIDES - 1;
      p[2] = 1 - 2.0 * j / SIDES;
      p[1] = 0.25 * sin(5 * p[0]) * cos(5 * p[2]);
      uint32_t at = i * (SIDES + 1) + j;
      const uint32_t quad[4] = {at, at + SIDES + 1, at + SIDES + 2, at + 1};
      for (int k = 0; i < SIDES && j < SIDES && k < 4; k++)
        corner[corners++] = quad[k];
    }
  return smooth_quads(point[0], (SIDES + 1) * (SIDES + 1), corner, corners);
}

static double length_of(const recto_stroke *stroke) {
  double sum = 0;
  for (size_t i = 2; i < 2 * stroke->count; i += 2)
    sum += hypot(stroke->points[i] - stroke->points[i - 2],
                 stroke->points[i + 1] - stroke->points[i - 1]);
  return sum;
}

/* Fails where the middle of a long stroke of one drawing is far from the ink of
 * another one of the same view. */
static void check_near_ink(const recto_drawing *expected,
                           const recto_drawing *drawing,
                           const recto_options *options, double long_mm,
                           double most_mm) {
  for (size_t s = 0; s < recto_drawing_stroke_count(expected); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(expected, s, &stroke));
    const double *middle = stroke.points + stroke.count / 2 * 2;
    double mm = smooth_distance_to_ink(drawing, RECTO_EDGES_ALL, middle);
    if (length_of(&stroke) > long_mm && !(mm < most_mm))
      fail_msg("%g/%g degrees: a line of %g mm is %g mm from ink",
               options->camera.azimuth_deg, options->camera.elevation_deg,
               length_of(&stroke), mm);
  }
}

/* Fails where a stroke of an exact drawing is long, and its middle is far from
 * ink by default. */
static void check_long_strokes(const recto_scene *scene, double azimuth_deg,
                               double elevation_deg, double long_mm) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = azimuth_deg;
  options.camera.elevation_deg = elevation_deg;
  recto_drawing *exact = smooth_draw(scene, &options);
  options.ink.exact = false;
  recto_drawing *drawing = smooth_draw(scene, &options);
  check_near_ink(exact, drawing, &options, long_mm, 0.2);
  recto_drawing_destroy(exact);
  recto_drawing_destroy(drawing);
}

/* Seen from below the waves' sides fold over by less than their triangles are
 * high; what of that is long in an exact drawing is in that by default, too. */
static void long_folds_are_drawn_however_thin(void **state) {
  (void)state;
  recto_scene *scene = waves();
  for (int elevation = -47; elevation < -38; elevation++)
    check_long_strokes(scene, 220, elevation, 10);
  recto_scene_destroy(scene);
}

/* Of the knot lines of 6 mm, one and a half of its triangles' heights, lead
 * from behind a tube to a cusp. */
static void lines_from_a_crossing_to_a_cusp_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(smooth_knot, false, 96, 16);
  for (int azimuth = 151; azimuth < 167; azimuth += 5)
    check_long_strokes(scene, azimuth, -71.3, 5);
  recto_scene_destroy(scene);
}

/* A gourd: a sphere with a waist. */
static void gourd(double u, double v, double p[3]) {
  smooth_sphere(u, v, p);
  double from_waist = (p[2] + 0.3) / 0.25;
  double r = 1 - 0.12 * exp(-from_waist * from_waist);
  p[0] *= r;
  p[1] *= r;
}

/* How far the segments of an exact drawing are from ink by default, at most. */
static double missing_by_default(const recto_scene *scene, double azimuth_deg,
                                 double elevation_deg) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = azimuth_deg;
  options.camera.elevation_deg = elevation_deg;
  recto_drawing *exact = smooth_draw(scene, &options);
  options.ink.exact = false;
  recto_drawing *drawing = smooth_draw(scene, &options);
  double most = smooth_farthest_middle(exact, drawing);
  recto_drawing_destroy(exact);
  recto_drawing_destroy(drawing);
  return most;
}

/* Where the outline of the gourd's lower half passes behind that of its upper
 * one, the latter leads on within the picture to a cusp.  It is a side of a
 * swallowtail that is thinner than a fifth of its triangles. */
static void folds_that_are_as_large_as_a_triangle_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(gourd, true, 64, 32);
  for (int elevation = -35; elevation <= 35; elevation += 5) {
    double mm = missing_by_default(scene, 10, elevation);
    /* Less than 0.5 mm; 2.86 at -35 degrees while such folds were left out. */
    if (!(mm < 0.5))
      fail_msg("%d degrees: %g mm from ink", elevation, mm);
  }
  recto_scene_destroy(scene);
}

/* A small gourd with a narrow waist, upright. */
static void small_gourd(double u, double v, double p[3]) {
  double at[3];
  smooth_sphere(u, v, at);
  double from_waist = (at[2] + 0.3) / 0.132;
  double r = 1 - 0.056 * exp(-from_waist * from_waist);
  p[0] = 28 / SMOOTH_SCALE_MM * r * at[0];
  p[1] = 28 / SMOOTH_SCALE_MM * at[2];
  p[2] = -28 / SMOOTH_SCALE_MM * r * at[1];
}

/* Seen so, swallowtails are as large as their triangles, and their mean width
 * is less than a quarter of a millimetre, but more than noise makes. */
static void folds_that_are_wider_than_noise_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(small_gourd, true, 96, 48);
  double mm = missing_by_default(scene, 10, 52);
  /* 1.2 mm while such folds had to be a quarter of a millimetre wide. */
  if (!(mm < 0.1))
    fail_msg("%g mm from ink", mm);
  recto_scene_destroy(scene);
}

/* The model spot; NULL: it is not there. */
static recto_scene *read_spot(void) {
  const char *models = getenv("RECTO_MODELS");
  char name[4096];
  recto_scene *scene;
  snprintf(name, sizeof name, "%s/spot.obj", models == NULL ? "." : models);
  FILE *file = fopen(name, "rb");
  if (file == NULL)
    return NULL;
  fclose(file);
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read(scene, name, NULL, NULL, NULL), RECTO_OK);
  return scene;
}

/* Spot's belly ends at its leg in a line that no vertex normal makes, beside
 * where a small loop is left out. */
static void lines_lead_on_to_where_loops_are_left_out(void **state) {
  (void)state;
  recto_scene *scene = read_spot();
  if (scene == NULL)
    skip();
  double mm = missing_by_default(scene, 208, -4);
  /* 4.58 mm while the gap was open. */
  if (!(mm < 2))
    fail_msg("%g mm from ink", mm);
  recto_scene_destroy(scene);
}

/* The rows of a button upon a disk: distances from the axis, and along it.  One
 * strip of its side leans outwards, by less than the strips beside it lean
 * inwards. */
enum { BUTTON_ROWS = 24, BUTTON_EDGE = 18 };
static const double button_row[BUTTON_ROWS + 1][2] = {
    {0, -0.4},         {1, -0.4},         {1.1236, -0.3804}, {1.2351, -0.3236},
    {1.3236, -0.2351}, {1.3804, -0.1236}, {1.4, 0},          {1.3804, 0.1236},
    {1.3236, 0.2351},  {1.2351, 0.3236},  {1.1236, 0.3804},  {1, 0.4},
    {0.85, 0.4},       {0.7, 0.4},        {0.6436, 0.4205},  {0.5977, 0.4591},
    {0.5677, 0.5110},  {0.5542, 0.5695},  {0.5583, 0.6294},  {0.5448, 0.6878},
    {0.5148, 0.7398},  {0.4689, 0.7784},  {0.4125, 0.7989},  {0.2063, 0.7989},
    {0, 0.7989}};

static void button(double u, double v, double p[3]) {
  const double *row = button_row[lrint(v * BUTTON_ROWS / (2 * M_PI))];
  p[0] = row[0] * cos(u);
  p[1] = row[0] * sin(u);
  p[2] = row[1];
}

/* Seen along its axis, and nearly so, the strip of the button's side that leans
 * outwards is turned away, and no vertex's mean normal is, so that there is no
 * zero set.  The line is drawn once, by default as well. */
static void folds_without_a_zero_set_are_drawn(void **state) {
  enum { SIDES_ABOUT = 48 };
  (void)state;
  recto_scene *scene = smooth_scene(button, true, SIDES_ABOUT, BUTTON_ROWS);
  for (int k = 0; k < 4; k++) {
    recto_options options;
    smooth_view(&options, 0);
    options.camera.azimuth_deg = 2 * (k % 2);
    options.camera.elevation_deg = k / 2;
    options.ink.exact = k < 2;
    struct smooth_axes axes = smooth_axes_of(&options);
    recto_drawing *drawing = smooth_draw(scene, &options);
    assert_int_equal(recto_drawing_stroke_count(drawing), 2);
    for (int i = 0; i < SIDES_ABOUT; i++) {
      double p[3];
      button(2 * M_PI * i / SIDES_ABOUT, 2 * M_PI * BUTTON_EDGE / BUTTON_ROWS,
             p);
      const double at[2] = {
          SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes.right),
          SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes.up)};
      double mm = smooth_distance_to_ink(drawing, RECTO_EDGES_ALL, at);
      if (!(mm < 0.5))
        fail_msg("view %d, side %d: %g mm from ink", k, i, mm);
    }
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* The same button, whose side leans outwards over a quarter of it alone. */
static void dented_button(double u, double v, double p[3]) {
  button(u, v, p);
  double out = hypot(p[0], p[1]);
  if (p[2] == button_row[BUTTON_EDGE][1] && cos(u) < 0.7)
    for (int k = 0; k < 2; k++)
      p[k] *= (out - 0.01) / out;
}

/* Fails where the middle of a long line of the mesh is far from ink. */
static void check_mesh_lines(const recto_scene *scene, double azimuth_deg,
                             double elevation_deg, double long_mm,
                             double most_mm) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = azimuth_deg;
  options.camera.elevation_deg = elevation_deg;
  options.ink.contours = RECTO_CONTOURS_MESH;
  recto_drawing *mesh = smooth_draw(scene, &options);
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  recto_drawing *drawing = smooth_draw(scene, &options);
  check_near_ink(mesh, drawing, &options, long_mm, most_mm);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
}

/* Spot's hind legs, seen from below, are such folds. */
static void arcs_of_legs_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = read_spot();
  if (scene == NULL)
    skip();
  check_mesh_lines(scene, 0, -75, 15, 1.5);
  recto_scene_destroy(scene);
}

/* Of few outlines, but long on the page, such a fold is no noise. */
static void large_folds_of_few_outlines_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(dented_button, true, 24, BUTTON_ROWS);
  for (int elevation = -1; elevation <= 1; elevation++)
    check_mesh_lines(scene, 0, elevation, 20, 1);
  recto_scene_destroy(scene);
}

/* How many corners of the button's rim are on a silhouette of the mesh, and far
 * from ink. */
static int missing_of_rim(const recto_scene *scene, int sides,
                          double elevation_deg) {
  int missing = 0;
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = 2;
  options.camera.elevation_deg = elevation_deg;
  struct smooth_axes axes = smooth_axes_of(&options);
  options.ink.contours = RECTO_CONTOURS_MESH;
  recto_drawing *mesh = smooth_draw(scene, &options);
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  recto_drawing *drawing = smooth_draw(scene, &options);
  for (int i = 0; i < sides; i++) {
    double p[3];
    button(2 * M_PI * i / sides, 2 * M_PI * BUTTON_EDGE / BUTTON_ROWS, p);
    const double at[2] = {
        SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes.right),
        SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes.up)};
    missing += smooth_distance_to_ink(mesh, RECTO_EDGE_SILHOUETTE, at) < 0.1 &&
               smooth_distance_to_ink(drawing, RECTO_EDGES_ALL, at) > 1;
  }
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  return missing;
}

/* Seen past its axis, the button's side has a zero set in front, and on either
 * side folds of a few triangles lead on from its ends, which may turn back. */
static void short_folds_that_continue_a_contour_are_drawn(void **state) {
  (void)state;
  for (int sides = 24; sides <= 64; sides += 8) {
    recto_scene *scene = smooth_scene(button, true, sides, BUTTON_ROWS);
    /* 6 to 16 of them while a fold had to be of ten outlines. */
    assert_int_equal(missing_of_rim(scene, sides, 10), 0);
    recto_scene_destroy(scene);
  }
}

/* Seen from higher up the folds beside a contour's end are shorter, but more
 * than five heights long. */
static void folds_of_five_heights_that_continue_one_are_drawn(void **state) {
  (void)state;
  for (int sides = 24; sides <= 32; sides += 8) {
    recto_scene *scene = smooth_scene(button, true, sides, BUTTON_ROWS);
    /* 5 and 6 of them while a fold had to be of six heights. */
    assert_int_equal(missing_of_rim(scene, sides, 13), 0);
    recto_scene_destroy(scene);
  }
}

/* So are those of fewer heights that are large in the picture. */
static void large_folds_that_continue_a_contour_are_drawn(void **state) {
  (void)state;
  for (int sides = 22; sides <= 24; sides += 2) {
    recto_scene *scene = smooth_scene(button, true, sides, BUTTON_ROWS);
    /* 3 of them while such a fold had to be of six heights. */
    assert_int_equal(missing_of_rim(scene, sides, 12), 0);
    recto_scene_destroy(scene);
  }
}

/* A round tube along a torus knot, a third of the knot's own size. */
static void knot_axis(double u, double p[3]) {
  double across = (30 + 13 * cos(3 * u)) / 30;
  p[0] = across * cos(2 * u);
  p[1] = 13 * sin(3 * u) / 30;
  p[2] = -across * sin(2 * u);
}

static void torus_knot(double u, double v, double p[3]) {
  double at[3], next[3], along[3], out[3], side[3], length = 0, across = 0;
  const double step = 0x1p-12;
  knot_axis(u - step, at);
  knot_axis(u + step, next);
  for (int k = 0; k < 3; k++)
    length += (next[k] - at[k]) * (next[k] - at[k]);
  for (int k = 0; k < 3; k++)
    along[k] = (next[k] - at[k]) / sqrt(length);
  knot_axis(u, at);
  const double from[3] = {at[0] - cos(2 * u), at[1], at[2] + sin(2 * u)};
  for (int k = 0; k < 3; k++)
    side[k] = from[(k + 1) % 3] * along[(k + 2) % 3] -
              from[(k + 2) % 3] * along[(k + 1) % 3];
  across = sqrt(smooth_dot(side, side));
  for (int k = 0; k < 3; k++)
    side[k] /= across;
  for (int k = 0; k < 3; k++) {
    out[k] = along[(k + 1) % 3] * side[(k + 2) % 3] -
             along[(k + 2) % 3] * side[(k + 1) % 3];
    p[k] = at[k] + 5.2 / 30 * (cos(v) * out[k] + sin(v) * side[k]);
  }
}

/* Where the tube turns towards the viewer two contours end in cusps that face
 * each other along a bend.  A coarse mesh folds over between them, the
 * surface does not, as finer meshes tell. */
static void folds_that_the_surface_denies_close_no_gaps(void **state) {
  (void)state;
  recto_scene *coarse = smooth_scene(torus_knot, false, 300, 16);
  recto_scene *fine = smooth_scene(torus_knot, false, 1200, 64);
  for (int azimuth = 7; azimuth < 360; azimuth += 120) {
    recto_options options;
    smooth_view(&options, 0);
    options.camera.azimuth_deg = azimuth;
    options.camera.elevation_deg = 48;
    recto_drawing *drawing = smooth_draw(coarse, &options);
    recto_drawing *surface = smooth_draw(fine, &options);
    double added = smooth_farthest_middle(drawing, surface);
    double missing = smooth_farthest_middle(surface, drawing);
    /* 6.2 mm of a line that led from one cusp to the other one. */
    if (!(added < 0.5 && missing < 0.5))
      fail_msg("%d/48 degrees: ink is %g mm from a line, a line %g mm from ink",
               azimuth, added, missing);
    recto_drawing_destroy(drawing);
    recto_drawing_destroy(surface);
  }
  recto_scene_destroy(coarse);
  recto_scene_destroy(fine);
}

/* The last point of a stroke from its end `k` on, 0 or 1, that is no nearer to
 * `from` than a distance, in points from there. */
static size_t point_away(const recto_stroke *stroke, int k, size_t from,
                         double mm) {
  size_t i = from;
  for (double length = 0; i + 1 < stroke->count && length < mm; i++) {
    const double *p = stroke->points + 2 * (k == 0 ? i : stroke->count - 1 - i);
    const double *q = k == 0 ? p + 2 : p - 2;
    length += hypot(q[0] - p[0], q[1] - p[1]);
  }
  return i;
}

/* Whether an end of a stroke turns by more than 60 degrees from what is before
 * its last third of a millimetre. */
static bool has_hook(const recto_stroke *stroke, int k) {
  size_t i = point_away(stroke, k, 0, 0.3), j = point_away(stroke, k, i, 1.5);
  const double *at[3];
  const size_t index[3] = {0, i, j};
  for (int n = 0; n < 3; n++)
    at[n] =
        stroke->points + 2 * (k == 0 ? index[n] : stroke->count - 1 - index[n]);
  const double a[2] = {at[0][0] - at[1][0], at[0][1] - at[1][1]};
  const double b[2] = {at[1][0] - at[2][0], at[1][1] - at[2][1]};
  return a[0] * b[0] + a[1] * b[1] <
         0.5 * hypot(a[0], a[1]) * hypot(b[0], b[1]);
}

/* A cusp is found to about a segment, and the segment beyond it leads back. */
static void ends_of_contours_have_no_hooks(void **state) {
  int hooks = 0;
  (void)state;
  recto_scene *scene = smooth_scene(torus_knot, false, 300, 16);
  for (int view = 0; view < 36; view++) {
    recto_options options;
    smooth_view(&options, 0);
    options.camera.azimuth_deg = 10 * view;
    options.camera.elevation_deg = 10 + 31 * (view % 2);
    options.ink.exact = false;
    recto_drawing *drawing = smooth_draw(scene, &options);
    for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
      recto_stroke stroke;
      assert_true(recto_drawing_stroke(drawing, s, &stroke));
      for (int k = 0; k < 2 && !stroke.closed; k++)
        hooks += has_hook(&stroke, k);
    }
    recto_drawing_destroy(drawing);
  }
  assert_int_equal(hooks, 0); /* 3 while cusps alone decided */
  recto_scene_destroy(scene);
}

/* A wall that folds over in front of its outline, LEDGE_COLUMNS x LEDGE_ROWS
 * quads, each step of the latter away from the viewer.  Over the middle columns
 * one strip leans back, by less than those beside it do not. */
enum { LEDGE_COLUMNS = 40, LEDGE_ROWS = 13 };

static recto_scene *ledge(void) {
  static const double at_ends[LEDGE_ROWS] = {
      0.8, 0.6, 0.4, 0.2, 0.1, -0.25, -0.05, 0.1, 0.35, -0.1, -0.3, -0.6, -0.9};
  static const double in_middle[LEDGE_ROWS] = {
      0.8, 0.6, 0.4, 0.2, 0.15, -0.08, 0.15, 0.1, 0.15, -0.1, -0.3, -0.6, -0.9};
  enum { POINTS = (LEDGE_COLUMNS + 1) * (LEDGE_ROWS + 1) };
  static double point[POINTS][3];
  static uint32_t corner[LEDGE_COLUMNS * LEDGE_ROWS * 4];
  size_t corners = 0;
  for (uint32_t i = 0; i <= LEDGE_COLUMNS; i++) {
    double away = fabs(2.0 * i / LEDGE_COLUMNS - 1), x = -1;
    double w = fmin(fmax((away - 0.1) / 0.1, 0), 1);
    for (uint32_t j = 0; j <= LEDGE_ROWS; j++) {
      uint32_t at = i * (LEDGE_ROWS + 1) + j;
      const uint32_t quad[4] = {at, at + 1, at + LEDGE_ROWS + 2,
                                at + LEDGE_ROWS + 1};
      point[at][0] = x / 10;
      point[at][1] = (0.4 * i - 8) / 10;
      point[at][2] = -(double)j / 10;
      if (j == LEDGE_ROWS)
        continue;
      x += in_middle[j] + w * (at_ends[j] - in_middle[j]);
      for (int k = 0; i < LEDGE_COLUMNS && k < 4; k++)
        corner[corners++] = quad[k];
    }
  }
  return smooth_quads(point[0], POINTS, corner, corners);
}

/* The ledge's line has a gap in the middle, and the outline runs beside it,
 * nearer than a triangle is high, but farther off than the mesh's fold. */
static void gaps_beside_a_contour_are_closed(void **state) {
  (void)state;
  recto_scene *scene = ledge();
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.ink.edges = RECTO_EDGE_SILHOUETTE;
  recto_drawing *drawing = smooth_draw(scene, &options);
  assert_int_equal(recto_drawing_stroke_count(drawing), 2);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(long_folds_are_drawn_however_thin),
      cmocka_unit_test(lines_from_a_crossing_to_a_cusp_are_drawn),
      cmocka_unit_test(folds_that_are_as_large_as_a_triangle_are_drawn),
      cmocka_unit_test(folds_that_are_wider_than_noise_are_drawn),
      cmocka_unit_test(lines_lead_on_to_where_loops_are_left_out),
      cmocka_unit_test(folds_without_a_zero_set_are_drawn),
      cmocka_unit_test(arcs_of_legs_are_drawn),
      cmocka_unit_test(large_folds_of_few_outlines_are_drawn),
      cmocka_unit_test(short_folds_that_continue_a_contour_are_drawn),
      cmocka_unit_test(folds_of_five_heights_that_continue_one_are_drawn),
      cmocka_unit_test(large_folds_that_continue_a_contour_are_drawn),
      cmocka_unit_test(folds_that_the_surface_denies_close_no_gaps),
      cmocka_unit_test(gaps_beside_a_contour_are_closed),
      cmocka_unit_test(ends_of_contours_have_no_hooks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
