/* test_smooth_contours.c - smooth contours of meshes that sample a surface are
 * those of the surface: as many, where they are, and visible where they are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"

enum { VIEWS = 20, SAMPLES = 1024 };

#define PAGE_MM 200.0
#define SCALE_MM 60.0 /* a model unit */
#define TUBE 0.4      /* the torus has radii 1 and 0.4 */

static const int tessellation[][2] = {{32, 16}, {64, 32}, {256, 128}};

/* A point of a surface at angles u and v. */
typedef void surface(double u, double v, double p[3]);

static void torus(double u, double v, double p[3]) {
  p[0] = (1 + TUBE * cos(v)) * cos(u);
  p[1] = (1 + TUBE * cos(v)) * sin(u);
  p[2] = TUBE * sin(v);
}

static void sphere(double u, double v, double p[3]) {
  p[0] = sin(v / 2) * cos(u);
  p[1] = sin(v / 2) * sin(u);
  p[2] = cos(v / 2);
}

static void ellipsoid(double u, double v, double p[3]) {
  sphere(u, v, p);
  p[1] *= 0.7;
  p[2] *= 0.5;
}

/* ---- Drawing ------------------------------------------------------------- */

/* A mesh of n x m quads, cut in two.
 * poles  v runs from pole to pole; else it is closed as u is */
static recto_scene *make_scene(surface *at, bool poles, int n, int m) {
  size_t points = (size_t)n * (size_t)(m + 1), corners = 0;
  double *point = malloc(points * 3 * sizeof *point);
  uint32_t *corner = malloc(points * 6 * sizeof *corner);
  assert_non_null(point);
  assert_non_null(corner);
  for (int j = 0; j <= m; j++)
    for (int i = 0; i < n; i++)
      at(2 * M_PI * i / n, 2 * M_PI * j / m,
         point + 3 * ((size_t)j * (size_t)n + (size_t)i));
  for (int j = 0; j < m; j++)
    for (int i = 0; i < n; i++) {
      int next = (i + 1) % n, up = poles ? j + 1 : (j + 1) % m;
      uint32_t a = (uint32_t)(j * n + i), b = (uint32_t)(j * n + next);
      uint32_t c = (uint32_t)(up * n + next), d = (uint32_t)(up * n + i);
      bool first = poles && j == 0, last = poles && j == m - 1;
      const uint32_t two[6] = {a, b, c, a, c, d};
      /* At a pole, all points of a row are its first one. */
      for (int k = 0; k < 6; k++) {
        uint32_t p = two[k];
        if ((k < 3 && first) || (k >= 3 && last))
          continue;
        if (poles && p < (uint32_t)n)
          p = 0;
        if (poles && p >= (uint32_t)(m * n))
          p = (uint32_t)(m * n);
        corner[corners++] = p;
      }
    }
  const recto_mesh mesh = {.points = point,
                           .point_count = points,
                           .corners = corner,
                           .corner_count = corners,
                           .face_size = 3};
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  free(point);
  free(corner);
  return scene;
}

/* A view of every direction but those along the axes and almost so. */
static void init_view(recto_options *options, int view) {
  recto_options_init(options);
  options->camera.azimuth_deg = 17 + 37.3 * view;
  options->camera.elevation_deg = 71 * sin(1 + 2.4 * view);
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = SCALE_MM;
  options->page.width_mm = options->page.height_mm = PAGE_MM;
  options->ink.edges = RECTO_EDGE_SILHOUETTE;
  options->ink.contours = RECTO_CONTOURS_SMOOTH;
}

/* The directions on the page, and towards the viewer; up is +Y. */
struct axes {
  double right[3], up[3], back[3];
};

static struct axes axes_of(const recto_options *options) {
  double a = options->camera.azimuth_deg * (M_PI / 180);
  double e = options->camera.elevation_deg * (M_PI / 180);
  return (struct axes){{cos(a), 0, -sin(a)},
                       {-sin(a) * sin(e), cos(e), -cos(a) * sin(e)},
                       {sin(a) * cos(e), sin(e), cos(a) * cos(e)}};
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static recto_drawing *draw(const recto_scene *scene,
                           const recto_options *options) {
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  return drawing;
}

/* ---- One convex outline -------------------------------------------------- */

/* How far the one stroke is from the contour of an ellipsoid, at most, mm: on
 * the page the contour is where the support function has its supports. */
static double distance_to_outline(const recto_drawing *drawing,
                                  const struct axes *axes,
                                  const double radius[3]) {
  recto_stroke stroke;
  double most = 0;
  assert_true(recto_drawing_stroke(drawing, 0, &stroke));
  assert_true(stroke.closed);
  for (size_t i = 0; i < stroke.count; i++) {
    double x = stroke.points[2 * i] - PAGE_MM / 2;
    double y = stroke.points[2 * i + 1] - PAGE_MM / 2;
    double inside = 1e9;
    for (int k = 0; k < SAMPLES; k++) {
      double angle = 2 * M_PI * k / SAMPLES, d[3];
      for (int c = 0; c < 3; c++)
        d[c] = radius[c] *
               (cos(angle) * axes->right[c] + sin(angle) * axes->up[c]);
      double support = SCALE_MM * sqrt(dot(d, d));
      inside = fmin(inside, support - (cos(angle) * x + sin(angle) * y));
    }
    most = fmax(most, fabs(inside));
  }
  return most;
}

static void check_outlines(surface *at, const double radius[3]) {
  for (size_t t = 0; t < 3; t++) {
    int n = tessellation[t][0], m = tessellation[t][1];
    recto_scene *scene = make_scene(at, true, n, m);
    /* What an arc is above its chord, along both parameters. */
    double sagitta = SCALE_MM * 2 * (1 - cos(M_PI / n));
    for (int view = 0; view < VIEWS; view++) {
      recto_options options;
      init_view(&options, view);
      struct axes axes = axes_of(&options);
      recto_drawing *drawing = draw(scene, &options);
      assert_int_equal(recto_drawing_stroke_count(drawing), 1);
      double distance = distance_to_outline(drawing, &axes, radius);
      if (!(distance <= sagitta + 0.01))
        fail_msg("%d x %d, view %d: off by %g mm, %g are the mesh's", n, m,
                 view, distance, sagitta);
      recto_drawing_destroy(drawing);
    }
    recto_scene_destroy(scene);
  }
}

static void the_contour_of_a_sphere_is_one_stroke(void **state) {
  (void)state;
  check_outlines(sphere, (const double[3]){1, 1, 1});
}

static void the_contour_of_an_ellipsoid_is_one_stroke(void **state) {
  (void)state;
  check_outlines(ellipsoid, (const double[3]){1, 0.7, 0.5});
}

/* ---- The torus ----------------------------------------------------------- */

/* Whether nothing of the torus lies between a point of its contour and the
 * viewer. */
static bool is_visible(const double p[3], const double back[3]) {
  for (double t = 0.001; t < 3.2; t += t < 0.02 ? 0.001 : 0.004) {
    double q[3] = {p[0] + t * back[0], p[1] + t * back[1], p[2] + t * back[2]};
    if (hypot(hypot(q[0], q[1]) - 1, q[2]) < TUBE - 1e-10)
      return false;
  }
  return true;
}

/* The contour of the torus: at each u, two v; each is closed. */
struct torus_contour {
  double mm[2][SAMPLES][2];
  bool visible[2][SAMPLES];
};

static void find_contour(struct torus_contour *contour,
                         const struct axes *axes) {
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < SAMPLES; i++) {
      double u = 2 * M_PI * i / SAMPLES, p[3];
      double v = atan2(-(cos(u) * axes->back[0] + sin(u) * axes->back[1]),
                       axes->back[2]) +
                 k * M_PI;
      torus(u, v, p);
      contour->mm[k][i][0] = PAGE_MM / 2 + SCALE_MM * dot(p, axes->right);
      contour->mm[k][i][1] = PAGE_MM / 2 + SCALE_MM * dot(p, axes->up);
      contour->visible[k][i] = is_visible(p, axes->back);
    }
}

/* The number of connected visible pieces longer than `least`, mm. */
static size_t count_pieces(const struct torus_contour *contour, double least) {
  size_t pieces = 0;
  for (int k = 0; k < 2; k++) {
    const bool *visible = contour->visible[k];
    int start = 0;
    while (start < SAMPLES && visible[start])
      start++;
    pieces += start == SAMPLES; /* all of it is */
    double length = 0;
    for (int i = 0; start < SAMPLES && i <= SAMPLES; i++) {
      int at = (start + i) % SAMPLES, last = (at + SAMPLES - 1) % SAMPLES;
      if (visible[at] && visible[last])
        length += hypot(contour->mm[k][at][0] - contour->mm[k][last][0],
                        contour->mm[k][at][1] - contour->mm[k][last][1]);
      if (visible[at])
        continue;
      pieces += length > least;
      length = 0;
    }
  }
  return pieces;
}

static double distance_to_segment(const double at[2], const double p[2],
                                  const double q[2]) {
  double x = q[0] - p[0], y = q[1] - p[1], square = x * x + y * y;
  double t = ((at[0] - p[0]) * x + (at[1] - p[1]) * y) / square;
  t = square > 0 ? fmin(fmax(t, 0), 1) : 0;
  return hypot(p[0] + t * x - at[0], p[1] + t * y - at[1]);
}

/* The distance from a point to the visible contour, mm; where one sample of it
 * is visible and the next is not, the end may be anywhere between. */
static double distance_to_visible(const struct torus_contour *contour,
                                  const double at[2]) {
  double least = 1e9;
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < SAMPLES; i++) {
      int next = (i + 1) % SAMPLES;
      if (contour->visible[k][i] || contour->visible[k][next])
        least = fmin(least, distance_to_segment(at, contour->mm[k][i],
                                                contour->mm[k][next]));
    }
  return least;
}

/* The distance from a point to the strokes, mm. */
static double distance_to_ink(const recto_drawing *drawing,
                              const double at[2]) {
  double least = 1e9;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i + 1 < stroke.count + stroke.closed; i++)
      least = fmin(least, distance_to_segment(
                              at, stroke.points + 2 * i,
                              stroke.points + 2 * ((i + 1) % stroke.count)));
  }
  return least;
}

/* The farthest point of ink from the visible contour, and of that from ink:
 * mm. */
static void compare(const recto_drawing *drawing,
                    const struct torus_contour *contour, double *false_mm,
                    double *missing_mm) {
  *false_mm = *missing_mm = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < stroke.count; i++)
      *false_mm =
          fmax(*false_mm, distance_to_visible(contour, stroke.points + 2 * i));
  }
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < SAMPLES; i += 4)
      if (contour->visible[k][i])
        *missing_mm =
            fmax(*missing_mm, distance_to_ink(drawing, contour->mm[k][i]));
}

static void the_contours_of_a_torus_are_its_visible_pieces(void **state) {
  (void)state;
  static struct torus_contour contour;
  for (size_t t = 0; t < 3; t++) {
    int n = tessellation[t][0], m = tessellation[t][1];
    recto_scene *scene = make_scene(torus, false, n, m);
    double sagitta = SCALE_MM * ((1 + TUBE) * (1 - cos(M_PI / n)) +
                                 TUBE * (1 - cos(M_PI / m)));
    double edge = SCALE_MM * (1 + TUBE) * 2 * M_PI / n;
    for (int view = 0; view < VIEWS; view++) {
      recto_options options;
      init_view(&options, view);
      struct axes axes = axes_of(&options);
      find_contour(&contour, &axes);
      recto_drawing *drawing = draw(scene, &options);
      size_t strokes = recto_drawing_stroke_count(drawing);
      size_t pieces = count_pieces(&contour, 0);
      double wrong, missing;
      compare(drawing, &contour, &wrong, &missing);
      if (strokes > pieces || strokes < count_pieces(&contour, 2 * edge))
        fail_msg("%d x %d, view %d: %zu strokes, %zu visible pieces", n, m,
                 view, strokes, pieces);
      /* Cusps are found to a few segments, which run towards the viewer. */
      if (wrong > 3 * sagitta + 0.2 || missing > 1.5 * sagitta + 0.15)
        fail_msg("%d x %d, view %d: ink %g mm from the contour, the contour %g "
                 "mm from ink, %g are the mesh's",
                 n, m, view, wrong, missing, sagitta);
      recto_drawing_destroy(drawing);
    }
    recto_scene_destroy(scene);
  }
}

/* ---- Visible faces ------------------------------------------------------- */

/* How far the outline of the visible faces is from ink at a side's middle, mm;
 * 0 where there are faces on both sides, which meet. */
static double distance_of_side(const recto_drawing *drawing,
                               const recto_half_edge *half, size_t from,
                               size_t to) {
  const recto_half_edge *p = &half[from], *q = &half[to];
  if (p->twin != RECTO_NONE) {
    const recto_half_edge *twin = &half[p->twin];
    assert_int_equal(twin->twin, from);
    assert_true(fabs(twin->x_mm - q->x_mm) < 1e-8);
    assert_true(fabs(twin->y_mm - q->y_mm) < 1e-8);
    return 0;
  }
  const double at[2] = {(p->x_mm + q->x_mm) / 2, (p->y_mm + q->y_mm) / 2};
  return distance_to_ink(drawing, at);
}

/* But for three sides of some thousands: the far contour of a view passes
 * beyond the near one, but not beyond the mesh's outline. */
static void visible_faces_end_at_the_contour(void **state) {
  (void)state;
  recto_scene *scene = make_scene(torus, false, 32, 16);
  int off = 0;
  for (int view = 0; view < VIEWS; view++) {
    recto_options options;
    init_view(&options, view);
    options.results = RECTO_RESULT_FACES;
    recto_drawing *drawing = draw(scene, &options);
    size_t loops, halves;
    const recto_loop *loop = recto_drawing_loops(drawing, &loops);
    const recto_half_edge *half = recto_drawing_half_edges(drawing, &halves);
    for (size_t l = 0; l < loops; l++)
      for (uint32_t i = 0; i < loop[l].count; i++)
        off += distance_of_side(drawing, half, loop[l].half_edge + i,
                                loop[l].half_edge + (i + 1) % loop[l].count) >
               0.002;
    recto_drawing_destroy(drawing);
  }
  assert_true(off <= 3);
  recto_scene_destroy(scene);
}

/* ---- What is not smooth -------------------------------------------------- */

/* From the tip down its side, which ends at three quarters of v, to the middle
 * of its base. */
static void cone(double u, double v, double p[3]) {
  double t = v / (2 * M_PI), side = fmin(t / 0.75, 1);
  double radius = 0.5 * (t > 0.75 ? (1 - t) / 0.25 : side);
  p[0] = radius * cos(u);
  p[1] = 1 - 2 * side;
  p[2] = radius * sin(u);
}

static void the_contour_of_a_cone_starts_at_its_tip(void **state) {
  (void)state;
  recto_scene *scene = make_scene(cone, true, 64, 8);
  recto_options options;
  init_view(&options, 0);
  options.camera.elevation_deg = 10;
  struct axes axes = axes_of(&options);
  const double tip[3] = {0, 1, 0};
  const double at[2] = {PAGE_MM / 2 + SCALE_MM * dot(tip, axes.right),
                        PAGE_MM / 2 + SCALE_MM * dot(tip, axes.up)};
  recto_drawing *drawing = draw(scene, &options);
  assert_true(distance_to_ink(drawing, at) < 0.1);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static double position_sum(const recto_drawing *drawing) {
  double sum = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < 2 * stroke.count; i++)
      sum += (double)(i + 1 + stroke.hidden) * stroke.points[i];
  }
  return sum;
}

static void a_part_of_creases_is_drawn_by_its_own_edges(void **state) {
  (void)state;
  recto_scene *scene = make_scene(torus, false, 9, 5);
  recto_options options;
  init_view(&options, 5);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  recto_drawing *smooth = draw(scene, &options);
  options.ink.contours = RECTO_CONTOURS_MESH;
  recto_drawing *mesh = draw(scene, &options);
  assert_int_equal(recto_drawing_stroke_count(smooth),
                   recto_drawing_stroke_count(mesh));
  assert_true(position_sum(smooth) == position_sum(mesh));
  recto_drawing_destroy(smooth);
  recto_drawing_destroy(mesh);
  recto_scene_destroy(scene);
}

/* ---- Methods ------------------------------------------------------------- */

static void smooth_contours_are_the_same_by_all_methods(void **state) {
  (void)state;
  recto_scene *scene = make_scene(torus, false, 48, 24);
  double sum[RECTO_METHOD_COUNT];
  recto_options options;
  init_view(&options, 3);
  options.camera.fov_deg = 40;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  for (int method = 0; method < RECTO_METHOD_COUNT; method++) {
    options.solver.method = (recto_method)method;
    recto_drawing *drawing = draw(scene, &options);
    sum[method] = position_sum(drawing);
    assert_true(sum[method] == sum[0]);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* Whatever the crease angle, a body of few faces keeps its outline: a double
 * pyramid of 3 to 8 sides, of which a contour may enclose two vertices. */
static void bodies_of_few_faces_keep_their_outline(void **state) {
  (void)state;
  for (int sides = 3; sides <= 8; sides++) {
    recto_scene *scene = make_scene(sphere, true, sides, 2);
    for (int crease = 90; crease <= 180; crease += 15)
      for (int view = 0; view < VIEWS; view++) {
        recto_options options;
        init_view(&options, view);
        options.mesh.crease_deg = crease;
        recto_drawing *drawing = draw(scene, &options);
        assert_true(recto_drawing_stroke_count(drawing) > 0);
        recto_drawing_destroy(drawing);
      }
    recto_scene_destroy(scene);
  }
}

static void smooth_contours_are_not_verified(void **state) {
  (void)state;
  recto_scene *scene = make_scene(torus, false, 12, 8);
  recto_options options;
  recto_drawing *drawing;
  init_view(&options, 0);
  options.verify = 100;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_contour_of_a_sphere_is_one_stroke),
      cmocka_unit_test(the_contour_of_an_ellipsoid_is_one_stroke),
      cmocka_unit_test(the_contours_of_a_torus_are_its_visible_pieces),
      cmocka_unit_test(visible_faces_end_at_the_contour),
      cmocka_unit_test(the_contour_of_a_cone_starts_at_its_tip),
      cmocka_unit_test(a_part_of_creases_is_drawn_by_its_own_edges),
      cmocka_unit_test(smooth_contours_are_the_same_by_all_methods),
      cmocka_unit_test(bodies_of_few_faces_keep_their_outline),
      cmocka_unit_test(smooth_contours_are_not_verified),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
