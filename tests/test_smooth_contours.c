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

enum {
  VIEWS = 20,
  SAMPLES = 1024,
  CONTOUR_STEPS = 2048,
  CONTOUR_MAX = 2 * CONTOUR_STEPS
};

#define PAGE_MM 200.0
#define SCALE_MM 60.0 /* a model unit */
#define TUBE 0.4      /* the torus has radii 1 and 0.4 */
#define KNOT_TUBE 0.2

static const int tessellation[][2] = {{32, 16}, {64, 32}, {256, 128}};

/* A point of a surface at angles u and v. */
typedef void surface(double u, double v, double p[3]);

/* A point of a curve. */
typedef void curve(double u, double p[3]);

static void circle(double u, double p[3]) {
  p[0] = cos(u);
  p[1] = sin(u);
  p[2] = 0;
}

static void trefoil(double u, double p[3]) {
  p[0] = (2 + cos(3 * u)) * cos(2 * u) / 2.6;
  p[1] = (2 + cos(3 * u)) * sin(2 * u) / 2.6;
  p[2] = sin(3 * u) / 1.8;
}

/* Two directions across a curve, and each other. */
static void frame(curve *at, double u, double normal[3], double binormal[3]) {
  double p[3], q[3], t[3], length = 0;
  at(u - 1e-6, p);
  at(u + 1e-6, q);
  for (int k = 0; k < 3; k++) {
    t[k] = q[k] - p[k];
    length += t[k] * t[k];
  }
  for (int k = 0; k < 3; k++)
    t[k] /= sqrt(length);
  double across = hypot(t[0], t[1]);
  normal[0] = t[1] / across;
  normal[1] = -t[0] / across;
  normal[2] = 0;
  binormal[0] = -normal[1] * t[2];
  binormal[1] = normal[0] * t[2];
  binormal[2] = normal[1] * t[0] - normal[0] * t[1];
}

static void tube_about(curve *at, double radius, double u, double v,
                       double p[3]) {
  double normal[3], binormal[3];
  at(u, p);
  frame(at, u, normal, binormal);
  for (int k = 0; k < 3; k++)
    p[k] += radius * (cos(v) * normal[k] - sin(v) * binormal[k]);
}

static void torus(double u, double v, double p[3]) {
  tube_about(circle, TUBE, u, v, p);
}

static void knot(double u, double v, double p[3]) {
  tube_about(trefoil, KNOT_TUBE, u, v, p);
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
  options->camera.has_target = true; /* the origin */
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = SCALE_MM;
  options->page.width_mm = options->page.height_mm = PAGE_MM;
  options->ink.edges = RECTO_EDGE_SILHOUETTE;
  options->ink.contours = RECTO_CONTOURS_SMOOTH;
  options->ink.exact = true;
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

/* ---- Tubes --------------------------------------------------------------- */

/* A tube about a closed curve, which is nowhere along Z. */
struct tube {
  curve *centre;
  surface *surface;
  double radius;
  int turns; /* so many times as long as the torus, about */
};

static const struct tube tubes[] = {{circle, torus, TUBE, 1},
                                    {trefoil, knot, KNOT_TUBE, 3}};

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
    most = fmax(most, sqrt(dot(d, d)));
  }
  return SCALE_MM * (most + tube->radius * (1 - cos(M_PI / m)));
}

/* Whether nothing of a tube lies between a point of its contour and the viewer:
 * none of the spheres about its centres. */
static bool is_visible(double centre[SAMPLES][3], double radius,
                       const double p[3], const double back[3]) {
  for (int i = 0; i < SAMPLES; i++) {
    double to[3] = {centre[i][0] - p[0], centre[i][1] - p[1],
                    centre[i][2] - p[2]};
    double along = dot(to, back), square = dot(to, to) - along * along;
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

static double contour_angle(const struct tube *tube, const struct axes *axes,
                            double u) {
  double normal[3], binormal[3];
  frame(tube->centre, u, normal, binormal);
  return atan2(dot(normal, axes->back), dot(binormal, axes->back));
}

/* Samples are closer where the tube points to the viewer, and v turns. */
static void find_contour(struct tube_contour *contour, const struct tube *tube,
                         const struct axes *axes) {
  static double centre[SAMPLES][3];
  for (int i = 0; i < SAMPLES; i++)
    tube->centre(2 * M_PI * i / SAMPLES, centre[i]);
  for (int k = 0; k < 2; k++) {
    int i = 0;
    for (double u = 0; u < 2 * M_PI && i < CONTOUR_MAX; i++) {
      double v = contour_angle(tube, axes, u), p[3];
      double step = 2 * M_PI / CONTOUR_STEPS;
      tube->surface(u, v + k * M_PI, p);
      contour->mm[k][i][0] = PAGE_MM / 2 + SCALE_MM * dot(p, axes->right);
      contour->mm[k][i][1] = PAGE_MM / 2 + SCALE_MM * dot(p, axes->up);
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

static double distance_to_segment(const double at[2], const double p[2],
                                  const double q[2]) {
  double x = q[0] - p[0], y = q[1] - p[1], square = x * x + y * y;
  double t = ((at[0] - p[0]) * x + (at[1] - p[1]) * y) / square;
  t = square > 0 ? fmin(fmax(t, 0), 1) : 0;
  return hypot(p[0] + t * x - at[0], p[1] + t * y - at[1]);
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
            fmax(*missing_mm, distance_to_ink(drawing, contour->mm[k][i]));
}

static void check_tube(const struct tube *tube, const recto_scene *scene, int n,
                       int m, int view) {
  static struct tube_contour contour;
  recto_options options;
  init_view(&options, view);
  struct axes axes = axes_of(&options);
  find_contour(&contour, tube, &axes);
  recto_drawing *drawing = draw(scene, &options);
  double sagitta = sagitta_of(tube, n, m), wrong, missing;
  int strokes = (int)recto_drawing_stroke_count(drawing);
  int most = count_pieces(&contour, 0);
  int least = count_pieces(&contour, 2 * sagitta);
  if (strokes < least || strokes > most)
    fail_msg("%d x %d, view %d: %d strokes, %d to %d visible pieces", n, m,
             view, strokes, least, most);
  compare(drawing, &contour, &wrong, &missing);
  /* Cusps are found to a few segments, which run towards the viewer. */
  if (wrong > 3 * sagitta + 0.05 || missing > 1.6 * sagitta + 0.05)
    fail_msg("%d x %d, view %d: ink %g mm from the contour, the contour %g mm "
             "from ink, %g are the mesh's",
             n, m, view, wrong, missing, sagitta);
  recto_drawing_destroy(drawing);
}

/* As many strokes as visible pieces, but for what is nearer to another one than
 * two arcs of the mesh are to their chords. */
static void the_contours_of_tubes_are_their_visible_pieces(void **state) {
  (void)state;
  for (size_t i = 0; i < 2; i++)
    for (size_t t = 0; t < 3; t++) {
      int n = tubes[i].turns * tessellation[t][0], m = tessellation[t][1];
      recto_scene *scene = make_scene(tubes[i].surface, false, n, m);
      for (int view = 0; view < VIEWS; view++)
        check_tube(&tubes[i], scene, n, m, view);
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

/* ---- Other lines --------------------------------------------------------- */

/* The distance from a point to silhouettes, mm. */
static double distance_to_silhouettes(const recto_drawing *drawing,
                                      const double at[2]) {
  double least = 1e9;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; stroke.edge_class == RECTO_EDGE_SILHOUETTE &&
                       i + 1 < stroke.count + stroke.closed;
         i++)
      least = fmin(least, distance_to_segment(
                              at, stroke.points + 2 * i,
                              stroke.points + 2 * ((i + 1) % stroke.count)));
  }
  return least;
}

/* Two sides of a triangle pass behind a sphere. */
static void lines_end_at_the_contour_in_front_of_them(void **state) {
  (void)state;
  const double point[9] = {-1.3, -0.3, -1.1, 1.3, -0.2, -1.1, -1.3, 0.6, -1.1};
  const uint32_t corner[3] = {0, 1, 2};
  const recto_mesh mesh = {.points = point,
                           .point_count = 3,
                           .corners = corner,
                           .corner_count = 3,
                           .face_size = 3};
  recto_scene *scene = make_scene(sphere, true, 32, 16);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  for (int view = 0; view < VIEWS; view++) {
    recto_options options;
    init_view(&options, view);
    options.camera.azimuth_deg = view - 10;
    options.camera.elevation_deg = 2 * view - 20;
    options.ink.edges |= RECTO_EDGE_BORDER;
    recto_drawing *drawing = draw(scene, &options);
    int ends = 0;
    for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
      recto_stroke stroke;
      assert_true(recto_drawing_stroke(drawing, s, &stroke));
      for (size_t i = 0; i < 2 && stroke.edge_class == RECTO_EDGE_BORDER; i++)
        ends +=
            distance_to_silhouettes(
                drawing, stroke.points + 2 * i * (stroke.count - 1)) < 0.002;
    }
    assert_int_equal(ends, 4);
    recto_drawing_destroy(drawing);
  }
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
      cmocka_unit_test(the_contours_of_tubes_are_their_visible_pieces),
      cmocka_unit_test(visible_faces_end_at_the_contour),
      cmocka_unit_test(lines_end_at_the_contour_in_front_of_them),
      cmocka_unit_test(the_contour_of_a_cone_starts_at_its_tip),
      cmocka_unit_test(a_part_of_creases_is_drawn_by_its_own_edges),
      cmocka_unit_test(smooth_contours_are_the_same_by_all_methods),
      cmocka_unit_test(bodies_of_few_faces_keep_their_outline),
      cmocka_unit_test(smooth_contours_are_not_verified),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
