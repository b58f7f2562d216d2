/* test_smooth_tubes.c - smooth contours of tubes are those of the surface: as
 * many strokes as it has visible pieces, and each where a piece is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

enum { SAMPLES = 1024, CONTOUR_STEPS = 2048, CONTOUR_MAX = 2 * CONTOUR_STEPS };

/* So fine that no gap between pieces is closed: below half a pen all are. */
#define PEN_MM 0.05

static const int tessellation[][2] = {{32, 16}, {64, 32}, {256, 128}};

/* A tube about a closed curve, which is nowhere along Z. */
struct tube {
  smooth_curve *centre;
  smooth_surface *surface, *turned; /* turned: of v and u */
  double radius;
  int turns; /* so many times as long as the torus, about */
};

static void turned_torus(double u, double v, double p[3]) {
  smooth_torus(v, u, p);
}

static void turned_knot(double u, double v, double p[3]) {
  smooth_knot(v, u, p);
}

static const struct tube tubes[] = {
    {smooth_circle, smooth_torus, turned_torus, SMOOTH_TORUS_RADIUS, 1},
    {smooth_trefoil, smooth_knot, turned_knot, SMOOTH_KNOT_RADIUS, 3}};

/* The height of a mesh's arcs over its chords, mm: along both parameters. */
static double sagitta_of(const struct tube *tube, int n, int m) {
  double most = 0;
  for (int i = 0; i < SAMPLES; i++) {
    double p[3], q[3], r[3], half = M_PI / n, u = 2 * M_PI * i / SAMPLES, d[3];
    tube->surface(u - half, 0, p);
    tube->surface(u, 0, q);
    tube->surface(u + half, 0, r);
    for (int k = 0; k < 3; k++)
      d[k] = q[k] - (p[k] + r[k]) / 2;
    most = fmax(most, sqrt(smooth_dot(d, d)));
  }
  return SMOOTH_SCALE_MM * (most + tube->radius * (1 - cos(M_PI / m)));
}

/* Whether nothing of a tube lies between a point of its contour and the viewer:
 * none of the spheres about its centres. */
static bool is_visible(double centre[SAMPLES][3], double radius,
                       const double p[3], const double back[3]) {
  for (int i = 0; i < SAMPLES; i++) {
    double to[3] = {centre[i][0] - p[0], centre[i][1] - p[1],
                    centre[i][2] - p[2]};
    double along = smooth_dot(to, back),
           square = smooth_dot(to, to) - along * along;
    double inside = radius * radius * (1 - 1e-4) - square;
    if (inside > 0 && along + sqrt(inside) > 0.03 * radius)
      return false;
  }
  return true;
}

/* The contour of a tube: at each u, two v; each is closed. */
struct tube_contour {
  double mm[2][CONTOUR_MAX][2];
  bool visible[2][CONTOUR_MAX];
  int count[2];
};

static double contour_angle(const struct tube *tube,
                            const struct smooth_axes *axes, double u) {
  double normal[3], binormal[3];
  smooth_frame(tube->centre, u, normal, binormal);
  return atan2(smooth_dot(normal, axes->back),
               smooth_dot(binormal, axes->back));
}

/* Samples are closer where the tube points to the viewer, and v turns. */
static void find_contour(struct tube_contour *contour, const struct tube *tube,
                         const struct smooth_axes *axes) {
  static double centre[SAMPLES][3];
  for (int i = 0; i < SAMPLES; i++)
    tube->centre(2 * M_PI * i / SAMPLES, centre[i]);
  for (int k = 0; k < 2; k++) {
    int i = 0;
    for (double u = 0; u < 2 * M_PI && i < CONTOUR_MAX; i++) {
      double v = contour_angle(tube, axes, u), p[3];
      double step = 2 * M_PI / CONTOUR_STEPS;
      tube->surface(u, v + k * M_PI, p);
      contour->mm[k][i][0] =
          SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->right);
      contour->mm[k][i][1] =
          SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->up);
      contour->visible[k][i] = is_visible(centre, tube->radius, p, axes->back);
      while (fabs(remainder(contour_angle(tube, axes, u + step) - v,
                            2 * M_PI)) > 0.1)
        step /= 2;
      u += step;
    }
    contour->count[k] = i;
    assert_true(i < CONTOUR_MAX);
  }
}

static double distance_between(const double p[2], const double q[2]) {
  return hypot(p[0] - q[0], p[1] - q[1]);
}

/* The distance from a sample of a contour to its visible samples that are not
 * of the same piece, from sample `from` to `to` of curve k; mm. */
static double distance_to_others(const struct tube_contour *contour, int k,
                                 int from, int to, int sample) {
  double least = 1e9;
  for (int other = 0; other < 2; other++)
    for (int i = 0; i < contour->count[other]; i++) {
      int count = contour->count[k];
      bool own = other == k && (i - from % count + count) % count <= to - from;
      if (!own && contour->visible[other][i])
        least = fmin(least, distance_between(contour->mm[other][i],
                                             contour->mm[k][sample]));
    }
  return least;
}

/* Counts a run of samples of curve k, visible or hidden all of them. */
static int count_run(const struct tube_contour *contour, int k, int from,
                     int to, double least) {
  int count = contour->count[k];
  double away = 0;
  bool visible = contour->visible[k][from % count];
  if (least == 0)
    return visible;
  for (int i = from; i <= to && away <= least; i++)
    away = fmax(away, distance_to_others(contour, k, from, to, i % count));
  return away > least ? visible : visible - 1;
}

/* The number of connected visible pieces, but for those that are nowhere
 * farther from the others than `least`, mm; two are one if what is hidden
 * between them is nowhere farther than that from what is visible. */
static int count_pieces(const struct tube_contour *contour, double least) {
  int pieces = 0;
  for (int k = 0; k < 2; k++) {
    const bool *visible = contour->visible[k];
    int count = contour->count[k], first = 1;
    while (first < count && visible[first] == visible[first - 1])
      first++;
    if (first == count)
      pieces += visible[0];
    for (int i = first, from = first; first < count && i < first + count; i++)
      if (visible[i % count] != visible[(i + 1) % count]) {
        pieces += count_run(contour, k, from, i, least);
        from = i + 1;
      }
  }
  return pieces;
}

/* The distance from a point to the visible contour, mm; where one sample of it
 * is visible and the next is not, the end may be anywhere between. */
static double distance_to_visible(const struct tube_contour *contour,
                                  const double at[2]) {
  double least = 1e9;
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < contour->count[k]; i++) {
      int next = (i + 1) % contour->count[k];
      if (contour->visible[k][i] || contour->visible[k][next])
        least = fmin(least, smooth_distance_to_segment(at, contour->mm[k][i],
                                                       contour->mm[k][next]));
    }
  return least;
}

/* The farthest point of ink from the visible contour, and of that from ink:
 * mm. */
static void compare(const recto_drawing *drawing,
                    const struct tube_contour *contour, double *false_mm,
                    double *missing_mm) {
  *false_mm = *missing_mm = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < stroke.count; i += 1 + stroke.count / 256)
      *false_mm =
          fmax(*false_mm, distance_to_visible(contour, stroke.points + 2 * i));
  }
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < contour->count[k]; i += 4)
      if (contour->visible[k][i])
        *missing_mm =
            fmax(*missing_mm, smooth_distance_to_ink(drawing, RECTO_EDGES_ALL,
                                                     contour->mm[k][i]));
}

/* The longest side of a mesh's quadrilaterals, mm. */
static double side_of(const struct tube *tube, int n, int m) {
  double most = 0;
  for (int i = 0; i < SAMPLES; i++) {
    double p[3], q[3], u = 2 * M_PI * i / SAMPLES, d[3];
    tube->surface(u, 0, p);
    tube->surface(u + 2 * M_PI / n, 0, q);
    for (int k = 0; k < 3; k++)
      d[k] = q[k] - p[k];
    most = fmax(most, sqrt(smooth_dot(d, d)));
  }
  return SMOOTH_SCALE_MM * fmax(most, tube->radius * 2 * M_PI / m);
}

/* strokes_max  from one to so many strokes; 0: as many as visible pieces */
static void check_tube(const struct tube *tube, const recto_scene *scene, int n,
                       int m, const recto_options *options,
                       const struct smooth_axes *axes, double view,
                       int strokes_max) {
  static struct tube_contour contour;
  find_contour(&contour, tube, axes);
  recto_drawing *drawing = smooth_draw(scene, options);
  double sagitta = sagitta_of(tube, n, m), wrong, missing;
  int strokes = (int)recto_drawing_stroke_count(drawing);
  int most = strokes_max > 0 ? strokes_max : count_pieces(&contour, 0);
  double side = options->ink.exact ? 0 : side_of(tube, n, m);
  int least =
      strokes_max > 0 ? 1 : count_pieces(&contour, fmax(2 * sagitta, side));
  if (strokes < least || strokes > most)
    fail_msg("%d x %d, view %g: %d strokes, %d to %d visible pieces", n, m,
             view, strokes, least, most);
  compare(drawing, &contour, &wrong, &missing);
  if (wrong > sagitta + 0.05 || missing > fmax(sagitta + 0.05, side / 2))
    fail_msg("%d x %d, view %g: ink %g mm from the contour, the contour %g mm "
             "from ink, %g are the mesh's",
             n, m, view, wrong, missing, sagitta);
  recto_drawing_destroy(drawing);
}

/* Draws tubes of the first tessellations.
 * turned  all faces are turned inwards */
static void check_tubes(bool exact, bool turned, size_t tessellations) {
  for (size_t i = 0; i < 2; i++)
    for (size_t t = 0; t < tessellations; t++) {
      int n = tubes[i].turns * tessellation[t][0], m = tessellation[t][1];
      recto_scene *scene = turned ? smooth_scene(tubes[i].turned, false, m, n)
                                  : smooth_scene(tubes[i].surface, false, n, m);
      for (int view = 0; view < SMOOTH_VIEWS; view++) {
        recto_options options;
        smooth_view(&options, view);
        options.ink.exact = exact;
        options.ink.pen_mm = PEN_MM;
        struct smooth_axes axes = smooth_axes_of(&options);
        check_tube(&tubes[i], scene, n, m, &options, &axes, view, 0);
      }
      recto_scene_destroy(scene);
    }
}

/* As many strokes as visible pieces, but for what is nearer to another one than
 * two arcs of the mesh are to their chords. */
static void the_contours_of_tubes_are_their_visible_pieces(void **state) {
  (void)state;
  check_tubes(true, false, 3);
}

/* By default, but for what is nearer to another one than a side of the mesh is
 * long: loops that are thinner than that are left out. */
static void loops_thinner_than_triangles_are_left_out(void **state) {
  (void)state;
  check_tubes(false, false, 3);
}

/* It does not matter which way faces are turned. */
static void tubes_may_be_inside_out(void **state) {
  (void)state;
  check_tubes(true, true, 2);
}

/* ---- A torus along its plane --------------------------------------------- */

/* From a direction near the plane of the torus, which is that of X and Y. */
static void view_along_plane(recto_options *options, double turned_deg,
                             double raised_deg) {
  double turned = turned_deg * (M_PI / 180), raised = raised_deg * (M_PI / 180);
  const double back[3] = {cos(turned) * cos(raised), sin(turned) * cos(raised),
                          sin(raised)};
  smooth_view(options, 0);
  options->camera.azimuth_deg = atan2(back[0], back[2]) * (180 / M_PI);
  options->camera.elevation_deg = asin(back[1]) * (180 / M_PI);
  options->ink.exact = false;
}

/* Seen along its plane the contours of its near and of its far half coincide,
 * and are one stroke; from 1 degree on they are two, and between the two as the
 * mesh and the pen tell them apart. */
static void the_contour_of_a_torus_along_its_plane_is_one_stroke(void **state) {
  static const double turned[] = {17, 30, 54.3, 123.4, 271.3};
  static const double raised[] = {0, 0.01, -0.01, 0.1, -0.1, 1, -1, 5, -5};
  (void)state;
  for (size_t t = 0; t < 3; t++) {
    int n = tessellation[t][0], m = tessellation[t][1];
    recto_scene *scene = smooth_scene(smooth_torus, false, n, m);
    for (size_t i = 0; i < sizeof turned / sizeof *turned; i++)
      for (size_t k = 0; k < sizeof raised / sizeof *raised; k++) {
        recto_options options;
        /* Exactly along the plane the contour has no parameter at its ends. */
        view_along_plane(&options, turned[i],
                         raised[k] == 0 ? 1e-4 : raised[k]);
        struct smooth_axes axes = smooth_axes_of(&options);
        view_along_plane(&options, turned[i], raised[k]);
        check_tube(&tubes[0], scene, n, m, &options, &axes,
                   turned[i] + raised[k], fabs(raised[k]) < 0.05 ? 1 : 2);
      }
    recto_scene_destroy(scene);
  }
}

/* A torus with bumps all around. */
static void bumpy_torus(double u, double v, double p[3]) {
  double r = 0.4 * (1 + 0.12 * sin(9 * u) * cos(4 * v));
  p[0] = (1 + r * cos(v)) * cos(u);
  p[1] = (1 + r * cos(v)) * sin(u);
  p[2] = r * sin(v);
}

/* How far along a segment from a another one crosses it, mm; -1: it does
 * not. */
static double crossing_along(const double *a, const double *b, const double *c,
                             const double *d) {
  double x = b[0] - a[0], y = b[1] - a[1], u = d[0] - c[0], v = d[1] - c[1];
  double area = x * v - y * u, s = c[0] - a[0], t = c[1] - a[1];
  double at = (s * v - t * u) / area, of = (s * y - t * x) / area;
  bool is_crossed = area != 0 && at >= 0 && at <= 1 && of >= 0 && of <= 1;
  return is_crossed ? at * hypot(x, y) : -1;
}

/* Where the nearest stroke but s crosses a segment from a to b. */
static double nearest_crossing(const recto_drawing *drawing, size_t s,
                               const double *a, const double *b) {
  double nearest = INFINITY;
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke other;
    assert_true(recto_drawing_stroke(drawing, i, &other));
    for (size_t k = 0; i != s && k + 1 < other.count; k++) {
      const double *c = other.points + 2 * k;
      double mm = crossing_along(a, b, c, c + 2);
      nearest = mm >= 0 ? fmin(nearest, mm) : nearest;
    }
  }
  return nearest;
}

/* How far a stroke goes on at its end `k`, 0 or 1, beyond where another one
 * crosses it; 0: none does over two millimetres. */
static double length_beyond_crossing(const recto_drawing *drawing, size_t s,
                                     int k) {
  recto_stroke stroke;
  double length = 0;
  assert_true(recto_drawing_stroke(drawing, s, &stroke));
  for (size_t i = 0; i + 1 < stroke.count && length < 2; i++) {
    const double *a = stroke.points + 2 * (k == 0 ? i : stroke.count - 1 - i);
    const double *b = k == 0 ? a + 2 : a - 2;
    double mm = nearest_crossing(drawing, s, a, b);
    if (mm < INFINITY)
      return length + mm;
    length += hypot(b[0] - a[0], b[1] - a[1]);
  }
  return 0;
}

/* How many ends of strokes go on beyond a crossing, in so many views. */
static int ends_beyond_crossings(const recto_scene *scene, int views) {
  int beyond = 0;
  for (int view = 0; view < views; view++) {
    recto_options options;
    smooth_view(&options, view % SMOOTH_VIEWS);
    options.camera.azimuth_deg += view / SMOOTH_VIEWS * 7;
    options.ink.exact = false;
    recto_drawing *drawing = smooth_draw(scene, &options);
    for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++)
      for (int k = 0; k < 2; k++) {
        double mm = length_beyond_crossing(drawing, s, k);
        beyond += mm > 0.1 && mm < 2;
      }
    recto_drawing_destroy(drawing);
  }
  return beyond;
}

/* What is seen of a line beyond where it passes behind another one ends in a
 * cusp less than a triangle's height away. */
static void lines_end_where_they_pass_behind_others(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(bumpy_torus, false, 96, 36);
  int beyond = ends_beyond_crossings(scene, 2 * SMOOTH_VIEWS);
  /* 9, which are in front; 20 while samples alone decided. */
  if (beyond > 12)
    fail_msg("%d ends are beyond a crossing", beyond);
  recto_scene_destroy(scene);
}

/* A coil of six turns, up and down again. */
static void coil_centre(double u, double p[3]) {
  double radius = 1 + 0.25 * cos(u);
  p[0] = radius * cos(6 * u);
  p[1] = radius * sin(6 * u);
  p[2] = 0.9 * sin(u);
}

static void coil(double u, double v, double p[3]) {
  double normal[3], binormal[3];
  coil_centre(u, p);
  smooth_frame(coil_centre, u, normal, binormal);
  for (int k = 0; k < 3; k++)
    p[k] += 0.11 * (cos(v) * normal[k] + sin(v) * binormal[k]);
}

/* Its turns pass in front of each other.  The mesh is within the surface: its
 * outline passes behind a turn later than the contour does. */
static void outlines_end_where_surfaces_cover_them(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(coil, false, 186, 16);
  int beyond = ends_beyond_crossings(scene, SMOOTH_VIEWS);
  /* 11; 134 where outlines do not. */
  if (beyond > 20)
    fail_msg("%d ends are beyond a crossing", beyond);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_contours_of_tubes_are_their_visible_pieces),
      cmocka_unit_test(loops_thinner_than_triangles_are_left_out),
      cmocka_unit_test(tubes_may_be_inside_out),
      cmocka_unit_test(the_contour_of_a_torus_along_its_plane_is_one_stroke),
      cmocka_unit_test(lines_end_where_they_pass_behind_others),
      cmocka_unit_test(outlines_end_where_surfaces_cover_them),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
