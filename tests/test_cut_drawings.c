/* test_cut_drawings.c - drawings of scenes that are cut: all exact methods give
 * the same bytes, the judge finds no fault and finds planted ones, outlines
 * have no gaps, and results name the caller's faces and points. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box_mesh.h"
#include "recto.h"
#include "svg_text.h"

static recto_scene *read_model(const char *name) {
  char path[512];
  const char *folder = getenv("srcdir");
  recto_scene *scene;
  snprintf(path, sizeof path, "%s/examples/models/%s.obj",
           folder != NULL ? folder : ".", name);
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_read(scene, path, NULL, NULL, NULL), RECTO_OK);
  return scene;
}

static recto_plane plane_of(double x, double y, double z, double offset) {
  return (recto_plane){.normal = {x, y, z}, .offset = offset};
}

/* ---- Models -------------------------------------------------------------- */

static const struct view {
  const char *model;
  double azimuth, elevation;
  recto_plane plane[3];
  size_t planes;
} views[] = {
    {"castle", 45, 35.26, {{.normal = {1, 0, 0}}}, 1},
    {"castle", 0, 0, {{.normal = {1, 0, 0}}}, 1},
    {"castle", 20, 30, {{.normal = {0, 0, 1}}, {.normal = {1, 0.2, 0}}}, 2},
    {"gears", 45, 35.26, {{.normal = {1, 0, 0}}, {.normal = {0, 0, 1}}}, 2},
    {"vase", 45, 35.26, {{.normal = {1, 0, 0}}}, 1},
    {"knot", 45, 35.26, {{.normal = {0, 0, 1}}}, 1},
    {"star", 45, 35.26, {{.normal = {0, 0, 1}}}, 1},
    {"star",
     10,
     20,
     {{.normal = {0, 0, 1}, .offset = 0.2},
      {.normal = {0, 1, 0}, .offset = 1},
      {.normal = {1, 0, 0}}},
     3},
    {"star", /* a plane given twice */
     45,
     35.26,
     {{.normal = {0, 0, 1}, .offset = 0.2},
      {.normal = {-1, 2, 0.5}, .offset = 0.1},
      {.normal = {-1, 2, 0.5}, .offset = 0.1}},
     3},
    {"wave", 45, 35.26, {{.normal = {1, 0, 0}}}, 1},
};
enum { VIEWS = sizeof views / sizeof views[0] };

static void options_of(recto_options *options, const struct view *view) {
  recto_options_init(options);
  options->camera.azimuth_deg = view->azimuth;
  options->camera.elevation_deg = view->elevation;
  options->mesh.cut = view->plane;
  options->mesh.cut_count = view->planes;
}

static void exact_methods_agree_and_the_judge_finds_no_fault(void **state) {
  (void)state;
  static const recto_method method[] = {
      RECTO_METHOD_NEWELL, RECTO_METHOD_WATKINS, RECTO_METHOD_WARNOCK,
      RECTO_METHOD_TILES};
  for (int i = 0; i < VIEWS; i++) {
    recto_scene *scene = read_model(views[i].model);
    recto_error error;
    char *first = NULL;
    for (int fill = 0; fill < 2; fill++) {
      for (size_t m = 0; m < sizeof method / sizeof method[0]; m++) {
        recto_drawing *drawing;
        recto_options options;
        options_of(&options, &views[i]);
        options.solver.method = method[m];
        options.ink.fill = fill ? RECTO_FILL_HATCH : RECTO_FILL_NONE;
        options.ink.edges = fill ? RECTO_EDGES_ALL : RECTO_EDGES_DEFAULT;
        options.verify = m == 0 ? 3000 : 0;
        if (recto_scene_render(scene, &options, &drawing, &error) != RECTO_OK)
          fail_msg("%s, view %d: %s", views[i].model, i, error.text);
        char *bytes = svg_text_of(drawing, &options);
        if (m > 0 && strcmp(first, bytes) != 0)
          fail_msg("%s: %s differs", views[i].model,
                   recto_method_name(method[m]));
        recto_drawing_destroy(drawing);
        if (m == 0) {
          free(first);
          first = bytes;
        } else {
          free(bytes);
        }
      }
    }
    free(first);
    recto_scene_destroy(scene);
  }
}

/* A check of a drawing against other planes than it was made with, or without
 * any, finds false and missing lines. */
static void the_judge_knows_where_the_cut_is(void **state) {
  (void)state;
  const char *path = "test_cut_drawings.svg";
  recto_scene *scene = read_model("gears");
  recto_drawing *drawing;
  recto_options options;
  recto_verdict right, wrong;
  options_of(&options, &views[3]);
  options.ink.pen_mm = 0.05;
  options.page.may_turn = false;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  assert_int_equal(recto_drawing_write(drawing, path, NULL, &options, NULL),
                   RECTO_OK);
  assert_int_equal(recto_scene_check(scene, path, &options, &right, NULL),
                   RECTO_OK);
  assert_true(right.drawn_mm > 1000 && right.false_mm == 0 &&
              right.missing_mm < 1e-3 * right.visible_mm);
  /* Turned over, the planes remove the opposite quarter: the camera is aimed at
   * the same box. */
  recto_plane other[2] = {views[3].plane[0], views[3].plane[1]};
  other[0].offset = 2;
  options.mesh.cut = other;
  assert_int_equal(recto_scene_check(scene, path, &options, &wrong, NULL),
                   RECTO_OK);
  assert_true(wrong.false_mm > 20 && wrong.missing_mm > 20);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  remove(path);
}

/* ---- Outlines ------------------------------------------------------------ */

/* The length of the borders of the visible faces beside which nothing is seen:
 * all of it lies under strokes. */
static void outlines_have_no_gaps(void **state) {
  (void)state;
  for (int i = 0; i < VIEWS; i++) {
    recto_scene *scene = read_model(views[i].model);
    recto_drawing *drawing;
    recto_options options;
    double outline = 0, bare = 0;
    size_t count;
    options_of(&options, &views[i]);
    options.results = RECTO_RESULT_FACES;
    options.ink.exact = true;
    options.ink.min_stroke_mm = 0;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    const recto_half_edge *half = recto_drawing_half_edges(drawing, &count);
    size_t loops;
    const recto_loop *loop = recto_drawing_loops(drawing, &loops);
    for (size_t l = 0; l < loops; l++)
      for (uint32_t k = 0; k < loop[l].count; k++) {
        const recto_half_edge *a = &half[loop[l].half_edge + k];
        const recto_half_edge *b =
            &half[loop[l].half_edge + (k + 1) % loop[l].count];
        if (a->twin != RECTO_NONE)
          continue;
        double x = (a->x_mm + b->x_mm) / 2, y = (a->y_mm + b->y_mm) / 2;
        double length = hypot(b->x_mm - a->x_mm, b->y_mm - a->y_mm);
        double nearest = INFINITY;
        recto_stroke stroke;
        for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
          for (size_t n = 1; n < stroke.count + stroke.closed; n++) {
            const double *p = stroke.points + 2 * (n - 1);
            const double *q = stroke.points + 2 * (n % stroke.count);
            double dx = q[0] - p[0], dy = q[1] - p[1];
            double t = ((x - p[0]) * dx + (y - p[1]) * dy) /
                       fmax(dx * dx + dy * dy, 1e-300);
            t = fmin(fmax(t, 0), 1);
            nearest =
                fmin(nearest, hypot(x - p[0] - t * dx, y - p[1] - t * dy));
          }
        outline += length;
        bare += nearest > 1e-3 ? length : 0;
      }
    assert_true(outline > 100);
    if (bare > 1e-5 * outline)
      fail_msg("%s, view %d: %g of %g mm are bare", views[i].model, i, bare,
               outline);
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
}

/* ---- Results ------------------------------------------------------------- */

static void results_name_what_the_caller_knows(void **state) {
  (void)state;
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  recto_scene *scene = box_scene(&mesh);
  const double line[2][3] = {{0.5, 0.5, -1}, {0.5, 0.5, 3}};
  uint32_t point[2];
  for (int k = 0; k < 2; k++)
    assert_int_equal(recto_scene_add_point(scene, line[k], &point[k], NULL),
                     RECTO_OK);
  assert_int_equal(recto_scene_add_polyline(scene, point, 2, NULL), RECTO_OK);
  const recto_plane plane[2] = {plane_of(1, 0, 0, 0.25),
                                plane_of(0, 0, 2, 1.5)};
  recto_drawing *drawing;
  recto_options options;
  recto_options_init(&options);
  options.results = RECTO_RESULTS_ALL;
  options.ink.edges = RECTO_EDGES_ALL;
  options.mesh.cut = plane;
  options.mesh.cut_count = 2;
  for (int prepared = 0; prepared < 3; prepared++) {
    /* The second time with what was prepared, the third with other planes. */
    if (prepared == 1)
      assert_int_equal(recto_scene_prepare(scene, &options, NULL), RECTO_OK);
    options.mesh.cut_count = prepared == 2 ? 1 : 2;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    recto_edge edge;
    size_t sections = 0, made = 0, wires = 0;
    for (size_t e = 0; recto_drawing_edge(drawing, e, &edge); e++) {
      sections += edge.edge_class == RECTO_EDGE_SECTION;
      if (edge.edge_class == RECTO_EDGE_WIRE) {
        wires++;
        assert_int_equal(edge.number, 0);
      }
      for (int k = 0; k < 2; k++) {
        made += edge.points[k] == RECTO_NONE;
        assert_true(edge.points[k] == RECTO_NONE || edge.points[k] < 10);
        assert_true(edge.faces[k] == RECTO_NONE || edge.faces[k] < 6);
      }
      for (size_t i = 0; i < edge.interval_count; i++)
        assert_true(edge.intervals[i].t0 >= 0 && edge.intervals[i].t1 <= 1 &&
                    edge.intervals[i].t0 < edge.intervals[i].t1);
    }
    /* Two cut faces have a side in common; one plane has one cut face. */
    assert_int_equal(sections, prepared == 2 ? 4 : 7);
    assert_true(made > sections);
    assert_int_equal(wires, prepared == 2 ? 0 : 1);
    recto_fragment part;
    size_t cut_faces = 0;
    for (size_t f = 0; recto_drawing_fragment(drawing, f, &part); f++) {
      cut_faces += part.face == RECTO_NONE;
      assert_true(part.face == RECTO_NONE || part.face < 6);
      assert_true(part.group < recto_drawing_group_count(drawing));
    }
    assert_true(cut_faces > 0);
    recto_stroke stroke;
    for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
      assert_true(stroke.face == RECTO_NONE || stroke.face < 6);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* ---- Hatching ------------------------------------------------------------ */

/* The angle of a stroke of hatching, 0 to 180 degrees. */
static double hatch_angle(const recto_stroke *stroke) {
  double x = stroke->points[2] - stroke->points[0];
  double y = stroke->points[3] - stroke->points[1];
  double angle = atan2(y, x) * 180 / 3.14159265358979323846;
  return fmod(angle + 360.5, 180) - 0.5;
}

/* Three slabs in a row, cut across: three groups, of which the middle one is
 * beside both others. */
static recto_scene *slabs(void) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  for (int i = 0; i < 3; i++) {
    static const char *const name[] = {"a", "b", "c"};
    assert_int_equal(recto_scene_add_group(scene, name[i], NULL), RECTO_OK);
    double point[24];
    for (int k = 0; k < 24; k++)
      point[k] = box_cube[k / 3][k % 3] + (k % 3 == 0 ? i : 0);
    recto_mesh mesh = box_mesh(point, 8);
    mesh.face_groups = NULL;
    assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  }
  return scene;
}

static void neighbours_are_hatched_differently(void **state) {
  (void)state;
  recto_scene *scene = slabs();
  const recto_plane plane = plane_of(0, 0, 1, 0.5);
  const recto_cut_hatch own[] = {
      {.group = "b", .angle_deg = 20, .pitch_mm = 7}};
  for (int with = 0; with < 2; with++) {
    recto_drawing *drawing;
    recto_options options;
    double angle[3] = {-1, -1, -1};
    size_t count[3] = {0, 0, 0};
    recto_options_init(&options);
    options.camera.azimuth_deg = 0;
    options.camera.elevation_deg = 0;
    options.mesh.cut = &plane;
    options.mesh.cut_count = 1;
    options.mesh.cut_hatch = own;
    options.mesh.cut_hatch_count = with ? 1 : 0;
    options.ink.order = RECTO_ORDER_NONE;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    recto_stroke stroke;
    for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
      if (stroke.edge_class == 0) {
        assert_true(stroke.group < 3 && stroke.face == RECTO_NONE);
        if (angle[stroke.group] < 0)
          angle[stroke.group] = hatch_angle(&stroke);
        assert_true(fabs(angle[stroke.group] - hatch_angle(&stroke)) < 0.1);
        count[stroke.group]++;
      }
    assert_true(count[0] > 0 && count[1] > 0 && count[2] > 0);
    assert_true(fabs(angle[0] - angle[1]) > 5 && fabs(angle[1] - angle[2]) > 5);
    assert_true(fabs(angle[0] - 45) < 0.1);
    if (with)
      assert_true(fabs(angle[1] - 20) < 0.1);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

static size_t count_hatching(const recto_scene *scene,
                             const recto_options *options) {
  recto_drawing *drawing;
  recto_stroke stroke;
  size_t count = 0;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
    count += stroke.edge_class == 0;
  recto_drawing_destroy(drawing);
  return count;
}

static double distance_to_segment(const double p[2], const double *a,
                                  const double *b) {
  double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
  double t = square > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / square : 0;
  t = fmin(fmax(t, 0), 1);
  return hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

static double distance_to_lines(const recto_drawing *drawing,
                                const double p[2]) {
  recto_stroke stroke;
  double least = INFINITY;
  for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
    for (size_t i = 1; i < stroke.count + stroke.closed; i++)
      if (stroke.edge_class != 0)
        least = fmin(
            least, distance_to_segment(p, stroke.points + 2 * (i - 1),
                                       stroke.points + 2 * (i % stroke.count)));
  return least;
}

/* Moves from a hatch line to the next run along lines that are drawn, not along
 * bridges or where surfaces end on a cut face. */
static void moves_of_hatching_run_along_lines(void **state) {
  (void)state;
  recto_scene *scene = read_model("gears");
  const recto_plane plane = plane_of(1, 0, 0, 0);
  recto_drawing *drawing;
  recto_stroke stroke;
  recto_options options;
  size_t moves = 0;
  recto_options_init(&options);
  options.camera.azimuth_deg = 90;
  options.camera.elevation_deg = 0;
  options.mesh.cut = &plane;
  options.mesh.cut_count = 1;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  for (size_t s = 0; recto_drawing_stroke(drawing, s, &stroke); s++)
    for (size_t i = 1; stroke.edge_class == 0 && i + 2 < stroke.count; i += 2) {
      const double *a = stroke.points + 2 * i, *b = a + 2;
      const double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
      double away = distance_to_lines(drawing, middle);
      moves++;
      if (!(away < options.ink.pen_mm))
        fail_msg("the move at %g,%g mm is %g mm from any line", middle[0],
                 middle[1], away);
    }
  assert_true(moves > 100);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void cut_faces_are_hatched_solid_or_not(void **state) {
  (void)state;
  recto_scene *scene = slabs();
  const recto_plane plane = plane_of(0, 0, 1, 0.5);
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = 0;
  options.camera.elevation_deg = 0;
  options.mesh.cut = &plane;
  options.mesh.cut_count = 1;
  size_t hatched = count_hatching(scene, &options);
  options.mesh.cut_fill = RECTO_CUT_FILL_NONE;
  assert_int_equal(count_hatching(scene, &options), 0);
  /* --fill hatch leaves cut faces out; there is nothing else to see. */
  options.ink.fill = RECTO_FILL_HATCH;
  assert_int_equal(count_hatching(scene, &options), 0);
  options.ink.light[2] = 1;
  assert_int_equal(count_hatching(scene, &options), 0);
  options.ink.fill = RECTO_FILL_NONE;
  options.mesh.cut_fill = RECTO_CUT_FILL_SOLID;
  options.ink.pen_mm = 0.2;
  options.ink.hatch_pitch_mm = 2;
  assert_true(count_hatching(scene, &options) > 0 && hatched > 0);
  recto_drawing *drawing;
  recto_error error;
  const recto_cut_hatch none = {.group = "wheel", .angle_deg = 1};
  options.mesh.cut_hatch = &none;
  options.mesh.cut_hatch_count = 1;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, "wheel"));
  const recto_cut_hatch bad = {.group = "a", .angle_deg = NAN};
  options.mesh.cut_hatch = &bad;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

/* A plane given twice leaves what it leaves alone, also where it lies in sides
 * that several boxes share. */
static void planes_that_are_one_cut_as_one(void **state) {
  (void)state;
  const recto_plane plane[2] = {plane_of(1, 0, 0, 1), plane_of(2, 0, 0, 2)};
  static const double box[4][2][3] = {{{0, 0, 0}, {1, 1, 1}},
                                      {{1, 0, 0}, {2, 1, 1}},
                                      {{0, 1, 0}, {2, 2, 1}},
                                      {{0, 0, 1}, {2, 2, 2}}};
  char *bytes[2];
  recto_scene *scene = box_scene(NULL);
  for (int i = 0; i < 4; i++) {
    const char *const name[] = {"abcd" + i};
    double point[24];
    for (int k = 0; k < 24; k++)
      point[k] = box[i][(int)box_cube[k / 3][k % 3]][k % 3];
    recto_mesh mesh = box_mesh(point, 8);
    mesh.face_groups = NULL;
    mesh.group_names = name;
    mesh.group_count = 1;
    assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  }
  for (int twice = 0; twice < 2; twice++) {
    recto_drawing *drawing;
    recto_options options;
    recto_options_init(&options);
    options.camera.azimuth_deg = 255;
    options.camera.elevation_deg = -25;
    options.ink.edges = RECTO_EDGES_ALL;
    options.mesh.cut = plane;
    options.mesh.cut_count = twice ? 2 : 1;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    bytes[twice] = svg_text_of(drawing, &options);
    recto_drawing_destroy(drawing);
  }
  assert_string_equal(bytes[0], bytes[1]);
  free(bytes[0]);
  free(bytes[1]);
  recto_scene_destroy(scene);
}

/* The top hides the vertical edge of the cut face, which begins in a corner of
 * the top that the cut makes, also where they are in contact. */
static void the_judge_knows_the_corners_that_a_cut_makes(void **state) {
  (void)state;
  const recto_plane plane = plane_of(0, -1, 0, -0.25);
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  recto_scene *scene = box_scene(&mesh);
  recto_drawing *drawing;
  recto_options options;
  recto_error error = {0};
  recto_options_init(&options);
  options.camera.azimuth_deg = 319;
  options.camera.elevation_deg = 68;
  options.ink.edges = RECTO_EDGES_ALL;
  options.solver.contact = 0.002;
  options.mesh.cut = &plane;
  options.mesh.cut_count = 1;
  options.verify = 1000;
  if (recto_scene_render(scene, &options, &drawing, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void bad_planes_are_refused(void **state) {
  (void)state;
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  recto_scene *scene = box_scene(&mesh);
  const recto_plane bad[] = {plane_of(0, 0, 0, 1), plane_of(NAN, 0, 0, 1),
                             plane_of(1, INFINITY, 0, 1),
                             plane_of(1, 0, 0, NAN), plane_of(1, 0, 0, 7)};
  recto_drawing *drawing;
  recto_options options;
  recto_error error;
  recto_options_init(&options);
  options.mesh.cut_count = 1;
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    options.mesh.cut = &bad[i];
    assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                     RECTO_ERROR_ARGUMENT);
    assert_null(drawing);
    assert_true(error.text[0] != '\0');
  }
  const recto_plane all = plane_of(1, 0, 0, -1);
  options.mesh.cut = &all;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_EMPTY);
  /* A face of the box is on both, but nothing is between them. */
  const recto_plane facing[] = {plane_of(1, 0, 0, 1), plane_of(-3, 0, 0, -3)};
  options.mesh.cut = facing;
  options.mesh.cut_count = 2;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  options.mesh.cut = NULL;
  options.mesh.cut_count = 1;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  options.mesh.cut = bad;
  options.mesh.cut_count = RECTO_CUT_MAX + 1;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

/* A box of extreme size is cut as the unit box is. */
static void sizes_do_not_matter(void **state) {
  (void)state;
  static const double size[] = {1, 0x1p900, 0x1p-900};
  char *first = NULL;
  for (size_t i = 0; i < sizeof size / sizeof size[0]; i++) {
    double point[24];
    for (int k = 0; k < 24; k++)
      point[k] = box_cube[k / 3][k % 3] * size[i];
    const recto_mesh mesh = box_mesh(point, 8);
    recto_scene *scene = box_scene(&mesh);
    const recto_plane plane = plane_of(1, 1, 0.5, 0.75 * size[i]);
    recto_drawing *drawing;
    recto_options options;
    recto_options_init(&options);
    options.mesh.cut = &plane;
    options.mesh.cut_count = 1;
    options.verify = 1000;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    char *bytes = svg_text_of(drawing, &options);
    if (i == 0)
      first = bytes;
    else {
      assert_string_equal(bytes, first);
      free(bytes);
    }
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
  free(first);
}

/* A section is a cut by a plane parallel to the page; one that has nothing
 * before it cuts nothing.  The cube is from 0 to 1, and y is up. */
static void a_section_is_a_cut_parallel_to_the_page(void **state) {
  (void)state;
  static const double depth[] = {0.25, 0, -3};
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  recto_scene *scene = box_scene(&mesh);
  for (int perspective = 0; perspective < 2; perspective++)
    for (size_t i = 0; i < sizeof depth / sizeof depth[0]; i++) {
      char *bytes[2];
      for (int shorthand = 0; shorthand < 2; shorthand++) {
        const recto_plane plane = plane_of(0, 0, 3, 3 * (1 - depth[i]));
        recto_drawing *drawing;
        recto_options options;
        recto_options_init(&options);
        options.camera.azimuth_deg = options.camera.elevation_deg = 0;
        options.camera.fov_deg = perspective ? 30 : 0;
        options.camera.has_target = true;
        for (int k = 0; k < 3; k++)
          options.camera.target[k] = 0.5;
        options.camera.has_section = shorthand;
        options.camera.section = depth[i];
        options.mesh.cut = &plane;
        options.mesh.cut_count = !shorthand && depth[i] > 0;
        options.verify = 1000;
        assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                         RECTO_OK);
        bytes[shorthand] = svg_text_of(drawing, &options);
        assert_true((strstr(bytes[shorthand], "hatch") != NULL) ==
                    (depth[i] > 0));
        recto_drawing_destroy(drawing);
      }
      assert_string_equal(bytes[0], bytes[1]);
      free(bytes[0]);
      free(bytes[1]);
    }
  recto_scene_destroy(scene);
}

/* A prepared scene serves for other views; a section of one view is cut
 * anew. */
static void a_prepared_scene_is_cut_for_each_section(void **state) {
  (void)state;
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  char *bytes[2];
  for (int prepared = 0; prepared < 2; prepared++) {
    recto_scene *scene = box_scene(&mesh);
    recto_drawing *drawing;
    recto_options options;
    recto_options_init(&options);
    options.camera.has_section = true;
    options.camera.section = 0.4;
    if (prepared)
      assert_int_equal(recto_scene_prepare(scene, &options, NULL), RECTO_OK);
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    bytes[prepared] = svg_text_of(drawing, &options);
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
  assert_string_equal(bytes[0], bytes[1]);
  free(bytes[0]);
  free(bytes[1]);
}

static void a_section_excludes_other_planes_and_views(void **state) {
  (void)state;
  const recto_mesh mesh = box_mesh(box_cube[0], 8);
  recto_scene *scene = box_scene(&mesh);
  const recto_plane plane = plane_of(1, 0, 0, 0.5);
  for (int fault = 0; fault < 3; fault++) {
    recto_drawing *drawing = NULL;
    recto_options options;
    recto_options_init(&options);
    options.camera.has_section = true;
    options.camera.section = fault == 2 ? 9 : 0.4;
    options.mesh.cut = &plane;
    options.mesh.cut_count = fault == 0;
    if (fault == 1)
      options.sheet.arrangement = RECTO_ARRANGEMENT_FIRST;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     fault == 2 ? RECTO_ERROR_EMPTY : RECTO_ERROR_ARGUMENT);
    assert_null(drawing);
  }
  recto_scene_destroy(scene);
}

static void count_warnings(void *user, const char *file, unsigned long line,
                           const char *text) {
  (void)file;
  (void)line;
  *(int *)user += strstr(text, "not closed") != NULL;
}

static void lines_that_are_not_closed_are_warned_about(void **state) {
  (void)state;
  recto_mesh mesh = box_mesh(box_cube[0], 8);
  const recto_plane plane = plane_of(0, 0, 1, 0.5);
  for (int open = 0; open < 2; open++) {
    mesh.corner_count = open ? 20 : 24; /* the last side is left out */
    recto_scene *scene = box_scene(&mesh);
    recto_drawing *drawing;
    recto_options options;
    int warnings = 0;
    recto_options_init(&options);
    options.mesh.cut = &plane;
    options.mesh.cut_count = 1;
    options.warning = count_warnings;
    options.user = &warnings;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_OK);
    assert_int_equal(warnings, open);
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_methods_agree_and_the_judge_finds_no_fault),
      cmocka_unit_test(the_judge_knows_where_the_cut_is),
      cmocka_unit_test(outlines_have_no_gaps),
      cmocka_unit_test(results_name_what_the_caller_knows),
      cmocka_unit_test(neighbours_are_hatched_differently),
      cmocka_unit_test(moves_of_hatching_run_along_lines),
      cmocka_unit_test(cut_faces_are_hatched_solid_or_not),
      cmocka_unit_test(planes_that_are_one_cut_as_one),
      cmocka_unit_test(the_judge_knows_the_corners_that_a_cut_makes),
      cmocka_unit_test(bad_planes_are_refused),
      cmocka_unit_test(sizes_do_not_matter),
      cmocka_unit_test(a_section_is_a_cut_parallel_to_the_page),
      cmocka_unit_test(a_prepared_scene_is_cut_for_each_section),
      cmocka_unit_test(a_section_excludes_other_planes_and_views),
      cmocka_unit_test(lines_that_are_not_closed_are_warned_about),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
