/* test_multiview.c - the views of a sheet lie where first- and third-angle
 * projection have them, aligned and at one scale, and are the drawings that
 * each view is by itself. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/captions.h"
#include "recto.h"
#include "tests/memory_faults.h"
#include "tests/svg_text.h"
#include "view/preferred_scale.h"

/* A crooked tetrahedron, so that no two corners share a coordinate. */
static const double points[] = {0, 0, 0, 7, 1, 2, 3, 11, 1, 2, 4, 5};
static const uint32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
enum { POINTS = 4 };

/* A plate that is edge-on in the view from a side. */
static const double long_points[] = {0, 0, 0, 1000, 0, 0, 0, 9, 0, 0, 1, 0};

static recto_scene *make_scene_of(const double *at) {
  const recto_mesh mesh = {.points = at,
                           .point_count = POINTS,
                           .corners = corners,
                           .corner_count = 12};
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  return scene;
}

static void init_sheet(recto_options *options, recto_arrangement how,
                       const recto_sheet_view *view, size_t count) {
  recto_options_init(options);
  options->sheet.arrangement = how;
  options->sheet.view = view;
  options->sheet.view_count = count;
}

static recto_scene *make_scene(void) { return make_scene_of(points); }

static recto_drawing *draw_scene(recto_scene *scene,
                                 const recto_options *options) {
  recto_drawing *drawing;
  recto_error error;
  recto_status status = recto_scene_render(scene, options, &drawing, &error);
  if (status != RECTO_OK)
    print_message("%s\n", error.text);
  assert_int_equal(status, RECTO_OK);
  recto_scene_destroy(scene);
  return drawing;
}

static recto_drawing *draw(const recto_options *options) {
  return draw_scene(make_scene(), options);
}

/* ---- What is drawn ------------------------------------------------------- */

struct box {
  double low[2], high[2];
};

/* Whether a stroke is of the view: "1 front visible". */
static bool is_of_view(const recto_drawing *drawing, const recto_stroke *stroke,
                       const char *view) {
  recto_layer layer;
  assert_true(recto_drawing_layer(drawing, stroke->layer, &layer));
  const char *name = strchr(layer.label, ' ') + 1;
  return !stroke->is_text && strncmp(name, view, strlen(view)) == 0 &&
         name[strlen(view)] == ' ';
}

/* The box of a view's strokes. */
static struct box box_of(const recto_drawing *drawing, const char *view) {
  struct box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  recto_stroke stroke;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 0; is_of_view(drawing, &stroke, view) && k < stroke.count;
         k++)
      for (int axis = 0; axis < 2; axis++) {
        double x = stroke.points[2 * k + (size_t)axis];
        box.low[axis] = fmin(box.low[axis], x);
        box.high[axis] = fmax(box.high[axis], x);
      }
  assert_true(box.low[0] < box.high[0]);
  return box;
}

/* Where the view axis of the box's middle is. */
static double middle_of(struct box box, int axis) {
  return (box.low[axis] + box.high[axis]) / 2;
}

/* ---- Alignment ----------------------------------------------------------- */

static bool is_close(double a, double b) { return fabs(a - b) < 1e-5; }

/* Requires each point of the view's strokes to have the place along an axis of
 * the page that a corner has in the front view.  A tetrahedron's lines that are
 * visible from outside end at its corners, or where they cross on the page. */
static void assert_aligned(const recto_drawing *drawing, const char *view,
                           int axis) {
  recto_stroke stroke;
  size_t found = 0;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 0; is_of_view(drawing, &stroke, view) && k < stroke.count;
         k++) {
      bool is_corner = false;
      for (size_t p = 0; p < POINTS; p++) {
        double mm[2];
        assert_true(recto_drawing_project(drawing, points + 3 * p, mm, NULL));
        is_corner |= is_close(stroke.points[2 * k + (size_t)axis], mm[axis]);
      }
      assert_true(is_corner);
      found++;
    }
  assert_in_range(found, 3, 100);
}

static const recto_sheet_view six[] = {{.name = "front"}, {.name = "back"},
                                       {.name = "left"},  {.name = "right"},
                                       {.name = "top"},   {.name = "bottom"}};

static void corners_are_aligned_with_the_front_view(void **state) {
  (void)state;
  for (int how = RECTO_ARRANGEMENT_FIRST; how <= RECTO_ARRANGEMENT_THIRD;
       how++) {
    recto_options options;
    init_sheet(&options, (recto_arrangement)how, six, 6);
    recto_drawing *drawing = draw(&options);
    assert_aligned(drawing, "top", 0);
    assert_aligned(drawing, "bottom", 0);
    assert_aligned(drawing, "left", 1);
    assert_aligned(drawing, "right", 1);
    assert_aligned(drawing, "back", 1);
    recto_drawing_destroy(drawing);
  }
}

/* ---- Places -------------------------------------------------------------- */

/* Requires one view to be beside another, along an axis, 1: above it. */
static void assert_after(const recto_drawing *drawing, const char *first,
                         const char *second, int axis) {
  assert_true(box_of(drawing, first).high[axis] <
              box_of(drawing, second).low[axis]);
  assert_true(is_close(middle_of(box_of(drawing, first), 1 - axis),
                       middle_of(box_of(drawing, second), 1 - axis)));
}

static void first_angle_has_views_on_the_far_side(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  recto_drawing *drawing = draw(&options);
  assert_after(drawing, "right", "front", 0);
  assert_after(drawing, "front", "left", 0);
  assert_after(drawing, "left", "back", 0);
  assert_after(drawing, "top", "front", 1);
  assert_after(drawing, "front", "bottom", 1);
  recto_drawing_destroy(drawing);
}

static void third_angle_has_views_on_the_near_side(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_THIRD, six, 6);
  recto_drawing *drawing = draw(&options);
  assert_after(drawing, "left", "front", 0);
  assert_after(drawing, "front", "right", 0);
  assert_after(drawing, "right", "back", 0);
  assert_after(drawing, "bottom", "front", 1);
  assert_after(drawing, "front", "top", 1);
  recto_drawing_destroy(drawing);
}

static void three_views_are_usual(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  recto_drawing *first = draw(&options);
  assert_after(first, "front", "left", 0);
  assert_after(first, "top", "front", 1);
  options.sheet.arrangement = RECTO_ARRANGEMENT_THIRD;
  recto_drawing *third = draw(&options);
  assert_after(third, "front", "right", 0);
  assert_after(third, "front", "top", 1);
  recto_drawing_destroy(first);
  recto_drawing_destroy(third);
}

static void other_views_stand_in_the_free_corner(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {
      {.name = "front"}, {.name = "top"}, {.name = "left"}, {.name = "iso"}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 4);
  recto_drawing *drawing = draw(&options);
  struct box iso = box_of(drawing, "iso");
  assert_true(iso.low[0] > box_of(drawing, "top").high[0]);
  assert_true(iso.high[1] < box_of(drawing, "left").low[1]);
  assert_true(
      is_close(middle_of(iso, 0), middle_of(box_of(drawing, "left"), 0)));
  recto_drawing_destroy(drawing);
}

/* Where the only view from a side is on the left, or that along the vertical
 * is on the other side, the corner between these is taken. */
static void the_free_corner_is_beside_the_aligned_views(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {
      {.name = "front"}, {.name = "top"}, {.name = "left"}, {.name = "iso"}};
  static const recto_sheet_view below[] = {
      {.name = "front"}, {.name = "bottom"}, {.name = "left"}, {.name = "iso"}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_THIRD, view, 4);
  recto_drawing *drawing = draw(&options);
  struct box iso = box_of(drawing, "iso");
  assert_true(iso.high[0] < box_of(drawing, "top").low[0]);
  assert_true(iso.low[1] > box_of(drawing, "left").high[1]);
  assert_true(
      is_close(middle_of(iso, 0), middle_of(box_of(drawing, "left"), 0)));
  recto_drawing_destroy(drawing);
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, below, 4);
  drawing = draw(&options);
  iso = box_of(drawing, "iso");
  assert_true(iso.low[0] > box_of(drawing, "bottom").high[0]);
  assert_true(iso.low[1] > box_of(drawing, "left").high[1]);
  recto_drawing_destroy(drawing);
}

static void all_views_lie_inside_the_margins(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {
      {.name = "front"}, {.name = "back"},     {.name = "left"},
      {.name = "right"}, {.name = "top"},      {.name = "bottom"},
      {.name = "iso"},   {.name = "dimetric"}, {.name = "trimetric"},
      {.name = NULL}};
  for (int turned = 0; turned < 2; turned++) {
    recto_options options;
    init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 10);
    options.page.may_turn = turned;
    options.camera.azimuth_deg = 70;
    recto_drawing *drawing = draw(&options);
    double page[2];
    recto_drawing_page(drawing, page);
    assert_true(page[0] == (turned ? 297 : 210));
    recto_stroke stroke;
    for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
      for (size_t k = 0; k < 2 * stroke.count; k++) {
        assert_true(stroke.points[k] >= 10);
        assert_true(stroke.points[k] <= page[k % 2] - 10);
      }
    recto_drawing_destroy(drawing);
  }
}

/* ---- The scale ----------------------------------------------------------- */

/* The tetrahedron is 7 units wide and 11 high. */
static double scale_of(const recto_drawing *drawing) {
  struct box box = box_of(drawing, "front");
  assert_true(is_close((box.high[0] - box.low[0]) / 7,
                       (box.high[1] - box.low[1]) / 11));
  return (box.high[1] - box.low[1]) / 11;
}

/* Side by side the views are 7 + 5 wide, above each other 11 + 5; the page has
 * 190 x 277 mm, of which a twelfth of 190 is between them. */
static void the_largest_scale_fills_the_page(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  recto_drawing *drawing = draw(&options);
  double gap = 190.0 / 12;
  assert_true(
      is_close(scale_of(drawing), fmin((190 - gap) / 12, (277 - gap) / 16)));
  assert_true(is_close(box_of(drawing, "front").low[0], 10));
  assert_true(is_close(box_of(drawing, "left").high[0], 200));
  assert_true(is_close(
      box_of(drawing, "left").low[0] - box_of(drawing, "front").high[0], gap));
  recto_drawing_destroy(drawing);
}

static void a_preferred_scale_is_rounded_down(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.camera.fit = RECTO_FIT_PREFERRED;
  recto_drawing *drawing = draw(&options);
  assert_true(is_close(scale_of(drawing), 10));
  /* What is left is divided evenly, and as much is between rows. */
  double gap = (190 - 10 * 12.0) / 3;
  struct box front = box_of(drawing, "front");
  assert_true(is_close(box_of(drawing, "left").low[0] - front.high[0], gap));
  assert_true(is_close(front.low[1] - box_of(drawing, "top").high[1], gap));
  assert_true(is_close(front.low[0] - 10, gap));
  recto_drawing_destroy(drawing);
  options.camera.unit_mm = 1000;
  drawing = draw(&options);
  assert_true(is_close(scale_of(drawing), 10)); /* 1:100 */
  recto_drawing_destroy(drawing);
  options.camera.unit_mm = 25.4;
  drawing = draw(&options);
  assert_true(is_close(scale_of(drawing), 25.4 / 2));
  recto_drawing_destroy(drawing);
}

static void a_given_scale_is_kept(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_THIRD, NULL, 0);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 7.5;
  recto_drawing *drawing = draw(&options);
  assert_true(is_close(scale_of(drawing), 7.5));
  recto_drawing_destroy(drawing);
}

static void preferred_scales_are_those_of_the_standard(void **state) {
  (void)state;
  static const double pair[][2] = {
      {1, 1},           {1.9, 1},       {2, 2},         {49, 20},
      {0.99, 0.5},      {0.5, 0.5},     {0.3, 0.2},     {0.1, 0.1},
      {0.07, 0.05},     {0.012, 0.01},  {5e9, 5e9},     {1e-9, 1e-9},
      {1e-300, 1e-300}, {9e300, 5e300}, {1 - 1e-15, 1}, {1 - 1e-9, 0.5}};
  for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
    double relative = preferred_scale(pair[i][0]) / pair[i][1] - 1;
    assert_true(fabs(relative) < 1e-15);
  }
}

/* A unit so large or so small that there is no such scale. */
static void a_scale_out_of_range_is_the_largest_that_fits(void **state) {
  (void)state;
  static const double unit_mm[] = {DBL_MAX, DBL_MIN};
  assert_true(preferred_scale_of(1, DBL_MAX) == 1);
  assert_true(preferred_scale_of(30, DBL_MIN) == 30);
  assert_true(preferred_scale_of(1e-300, 1e10) == 1e-300);
  assert_true(preferred_scale_of(30, 10) == 20);
  for (int i = 0; i < 2; i++) {
    recto_options options;
    init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
    options.camera.fit = RECTO_FIT_PREFERRED;
    options.camera.unit_mm = unit_mm[i];
    recto_drawing *drawing = draw(&options);
    assert_true(scale_of(drawing) > 5 && scale_of(drawing) < 15);
    recto_drawing_destroy(drawing);
  }
}

static void a_single_view_may_have_a_preferred_scale(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.camera.fit = RECTO_FIT_PREFERRED;
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  recto_drawing *drawing = draw(&options);
  double a[2], b[2];
  assert_true(recto_drawing_project(drawing, points, a, NULL));
  assert_true(recto_drawing_project(drawing, points + 3, b, NULL));
  assert_true(is_close(b[0] - a[0], 7 * 20)); /* 190 / 7 is 27 */
  recto_drawing_destroy(drawing);
}

/* ---- Each view as by itself ---------------------------------------------- */

static void a_view_is_what_it_is_by_itself(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 8;
  options.ink.hidden = RECTO_HIDDEN_DASHED;
  recto_drawing *sheet = draw(&options);
  recto_options_init(&options);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 8;
  options.ink.hidden = RECTO_HIDDEN_DASHED;
  options.camera.azimuth_deg = 0;
  options.camera.elevation_deg = 90;
  recto_drawing *alone = draw(&options);
  struct box box = box_of(sheet, "top");
  recto_stroke here, there;
  size_t k = 0;
  for (size_t i = 0; recto_drawing_stroke(sheet, i, &here); i++) {
    if (!is_of_view(sheet, &here, "top"))
      continue;
    assert_true(recto_drawing_stroke(alone, k++, &there));
    assert_int_equal(here.count, there.count);
    assert_int_equal(here.edge_class, there.edge_class);
    assert_int_equal(here.hidden, there.hidden);
    for (size_t p = 0; p < 2 * here.count; p++)
      assert_true(is_close(here.points[p] - middle_of(box, (int)(p % 2)),
                           there.points[p] - (p % 2 ? 148.5 : 105)));
  }
  assert_int_equal(k, recto_drawing_stroke_count(alone));
  recto_drawing_destroy(sheet);
  recto_drawing_destroy(alone);
}

static size_t count_hidden(const recto_drawing *drawing, const char *view) {
  recto_stroke stroke;
  size_t count = 0;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    count += stroke.hidden && is_of_view(drawing, &stroke, view);
  return count;
}

static void a_view_has_hidden_lines_of_its_own(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {
      {.name = "back"},
      {.name = "left", .has_hidden = true, .hidden = RECTO_HIDDEN_LAYER},
      {.name = "right", .has_hidden = true, .hidden = RECTO_HIDDEN_NONE}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 3);
  options.ink.hidden = RECTO_HIDDEN_DASHED;
  recto_drawing *drawing = draw(&options);
  assert_in_range(count_hidden(drawing, "back"), 4, 1000);
  assert_in_range(count_hidden(drawing, "left"), 1, 2);
  assert_int_equal(count_hidden(drawing, "right"), 0);
  recto_layer layer;
  bool found = false;
  for (size_t i = 0; recto_drawing_layer(drawing, i, &layer); i++)
    found |= strcmp(layer.label, "2 left hidden") == 0;
  assert_true(found);
  recto_drawing_destroy(drawing);
}

static void another_view_may_be_larger(void **state) {
  (void)state;
  recto_sheet_view view[] = {
      {.name = "front"}, {.name = "iso"}, {.name = NULL, .scale = 2.5}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 3);
  recto_drawing *drawing = draw(&options); /* the camera is isometric too */
  struct box iso = box_of(drawing, "iso"), large = box_of(drawing, "view");
  assert_true(
      is_close(large.high[0] - large.low[0], 2.5 * (iso.high[0] - iso.low[0])));
  recto_drawing_destroy(drawing);
}

static void every_view_is_verified(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  options.verify = 500;
  recto_drawing *drawing = draw(&options);
  unsigned drawn = 0;
  assert_int_equal(
      sscanf(recto_drawing_verdict(drawing), "verified: %u drawn", &drawn), 1);
  assert_in_range(drawn, 6 * 400, 6 * 500);
  recto_drawing_destroy(drawing);
}

/* ---- Stats, progress, preparation ---------------------------------------- */

struct progress {
  double share;
  int calls, cancel_at;
};

static bool note_progress(void *user, double share, const char *stage) {
  struct progress *progress = user;
  (void)stage;
  assert_true(share >= progress->share && share <= 1);
  progress->share = share;
  return ++progress->calls != progress->cancel_at;
}

static void progress_grows_and_cancels(void **state) {
  (void)state;
  recto_scene *scene = make_scene();
  recto_drawing *drawing;
  struct progress progress = {0, 0, 0};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  options.progress = note_progress;
  options.user = &progress;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  int calls = progress.calls;
  assert_in_range(calls, 20, 10000);
  for (int at = 1; at <= calls; at++) {
    progress = (struct progress){0, 0, at};
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_ERROR_CANCELLED);
    assert_null(drawing);
    assert_int_equal(progress.calls, at);
  }
  recto_scene_destroy(scene);
}

static char *draw_text(const recto_scene *scene, const recto_options *options) {
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  char *text = svg_text_of(drawing, options);
  assert_non_null(text);
  recto_drawing_destroy(drawing);
  return text;
}

static void a_prepared_scene_gives_the_same_bytes(void **state) {
  (void)state;
  recto_scene *scene = make_scene();
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  options.ink.fill = RECTO_FILL_PAINT;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  char *before = draw_text(scene, &options);
  assert_int_equal(recto_scene_prepare(scene, &options, NULL), RECTO_OK);
  char *after = draw_text(scene, &options);
  assert_string_equal(before, after);
  assert_non_null(strstr(before, " id=\"front-layer1\""));
  assert_non_null(strstr(before, " id=\"bottom-fills\""));
  assert_non_null(strstr(before, "inkscape:label=\"2 back hidden\""));
  free(before);
  free(after);
  recto_scene_destroy(scene);
}

static void stats_have_a_part_for_each_view(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_THIRD, six, 6);
  recto_drawing *drawing = draw(&options);
  const char *stats = recto_drawing_stats(drawing);
  for (size_t i = 0; i < 6; i++) {
    char name[32];
    snprintf(name, sizeof name, "    \"%s\": {\n      \"scene\"", six[i].name);
    assert_non_null(strstr(stats, name));
  }
  assert_non_null(strstr(stats, "\"projection\": \"third-angle\""));
  recto_drawing_destroy(drawing);
}

/* ---- Warnings, names ----------------------------------------------------- */

struct warnings {
  int count;
  char text[4][128];
};

static void note_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  struct warnings *warnings = user;
  (void)file;
  (void)line;
  assert_in_range(warnings->count, 0, 3);
  snprintf(warnings->text[warnings->count++], 128, "%s", text);
}

static bool go_on(void *user, double share, const char *stage) {
  (void)user;
  (void)share;
  (void)stage;
  return true;
}

/* Of a view that is edge-on nothing is requested but what it does not have. */
static void a_view_without_lines_is_warned_of(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {{.name = "front"},
                                          {.name = "iso", .scale = 1e9}};
  struct warnings warnings = {0};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 2);
  options.warning = note_warning;
  options.progress = go_on;
  options.user = &warnings;
  recto_drawing_destroy(draw(&options));
  assert_int_equal(warnings.count, 1);
  assert_string_equal(warnings.text[0], "the view front is empty");
  warnings.count = 0;
  options.ink.edges = RECTO_EDGE_WIRE;
  recto_drawing_destroy(draw(&options));
  assert_int_equal(warnings.count, 1);
  assert_non_null(strstr(warnings.text[0], "the drawing is empty: nothing"));
}

/* All views warn of it; the near plane cuts some alone. */
static void a_warning_of_several_views_is_given_once(void **state) {
  (void)state;
  const recto_pen pens[] = {{.colour = 0}, {.colour = 1, .has_colour = true}};
  struct warnings warnings = {0};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  options.ink.pen = pens;
  options.ink.pen_count = 2;
  options.warning = note_warning;
  options.progress = go_on;
  options.user = &warnings;
  recto_drawing_destroy(draw(&options));
  assert_int_equal(warnings.count, 1);
  assert_non_null(strstr(warnings.text[0], "pen"));
}

/* As `--view front --detail` has it. */
static void a_view_alone_is_named_by_its_direction(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {{.name = NULL}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, view, 1);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  recto_drawing *drawing = draw(&options);
  recto_layer layer;
  assert_true(recto_drawing_layer(drawing, 0, &layer));
  assert_string_equal(layer.label, "1 front visible");
  recto_drawing_destroy(drawing);
  options.camera.azimuth_deg = 1;
  drawing = draw(&options);
  assert_true(recto_drawing_layer(drawing, 0, &layer));
  assert_string_equal(layer.label, "1 view visible");
  recto_drawing_destroy(drawing);
}

static void scales_are_written_as_ratios(void **state) {
  (void)state;
  static const struct {
    double scale;
    const char *text;
  } pair[] = {{1, "1:1"},
              {2, "2:1"},
              {0.5, "1:2"},
              {2.5, "2.5:1"},
              {4.0 / 3, "4:3"},
              {0.75, "3:4"},
              {50.0 / 3, "50:3"},
              {20.0 / 11, "20:11"},
              {0.1, "1:10"},
              {3.14159265, "3.142:1"},
              {1e-6, "1:1000000"},
              {1e9, "1000000000:1"},
              {INFINITY, "2e+308:1"},
              {5e-324, "1:2e+308"}};
  for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
    char text[CAPTIONS_SCALE_SIZE];
    captions_write_scale(text, pair[i].scale);
    assert_string_equal(text, pair[i].text);
  }
}

/* ---- Details ------------------------------------------------------------- */

static double distance_to_segment(const double p[2], const double *a) {
  double ux = a[2] - a[0], uy = a[3] - a[1];
  double t = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy);
  t = fmin(fmax(t, 0), 1);
  return hypot(a[0] + t * ux - p[0], a[1] + t * uy - p[1]);
}

/* How far a point is from the lines of a view. */
static double distance_to_view(const recto_drawing *drawing, const char *view,
                               const double p[2]) {
  recto_stroke stroke;
  double least = INFINITY;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 0; is_of_view(drawing, &stroke, view) && k < stroke.count;
         k++) {
      const double *a = stroke.points + 2 * k, *b = a + 2;
      if (k + 1 == stroke.count)
        b = stroke.closed ? stroke.points : a;
      const double side[4] = {a[0], a[1], b[0], b[1]};
      if (a != b)
        least = fmin(least, distance_to_segment(p, side));
    }
  return least;
}

/* Strokes of text: the mark, and the larger circle. */
static struct box box_of_circle(const recto_drawing *drawing, int number) {
  recto_stroke stroke;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    if (stroke.is_text && stroke.closed && number-- == 0) {
      struct box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
      for (size_t k = 0; k < 2 * stroke.count; k++) {
        box.low[k % 2] = fmin(box.low[k % 2], stroke.points[k]);
        box.high[k % 2] = fmax(box.high[k % 2], stroke.points[k]);
      }
      return box;
    }
  fail();
  return (struct box){{0, 0}, {0, 0}};
}

static void a_detail_is_the_circle_enlarged(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 8;
  recto_drawing *plain = draw(&options);
  struct box top = box_of(plain, "top");
  recto_drawing_destroy(plain);
  const recto_detail detail = {.x_mm = top.low[0],
                               .y_mm = middle_of(top, 1),
                               .radius_mm = 11,
                               .scale = 3};
  options.sheet.detail = &detail;
  options.sheet.detail_count = 1;
  recto_drawing *drawing = draw(&options);
  struct box same = box_of(drawing, "top");
  assert_true(is_close(same.low[0], top.low[0]));
  struct box mark = box_of_circle(drawing, 0),
             large = box_of_circle(drawing, 1);
  assert_true(fabs(middle_of(mark, 0) - detail.x_mm) < 0.01);
  assert_true(fabs(middle_of(mark, 1) - detail.y_mm) < 0.01);
  assert_true(fabs(mark.high[0] - mark.low[0] - 22) < 0.02);
  assert_true(fabs(large.high[0] - large.low[0] - 66) < 0.02);
  double centre[2] = {large.high[0] - 33, middle_of(large, 1)};
  recto_stroke stroke;
  size_t found = 0;
  double pen_mm = 0.3;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 0;
         is_of_view(drawing, &stroke, "detail-A") && k < stroke.count; k++) {
      const double *p = stroke.points + 2 * k;
      assert_true(hypot(p[0] - centre[0], p[1] - centre[1]) +
                      stroke.width_mm / 2 <
                  33 + pen_mm / 2 + 0.01);
      const double shown[2] = {detail.x_mm + (p[0] - centre[0]) / 3,
                               detail.y_mm + (p[1] - centre[1]) / 3};
      assert_true(distance_to_view(drawing, "top", shown) < 0.005);
      found++;
    }
  assert_in_range(found, 2, 100);
  recto_drawing_destroy(drawing);
}

static void assert_refused(const recto_options *options, const char *words);

static void assert_detail_refused(recto_detail detail, const char *words) {
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.sheet.detail = &detail;
  options.sheet.detail_count = 1;
  assert_refused(&options, words);
}

static void details_that_make_no_sense_are_refused(void **state) {
  (void)state;
  assert_detail_refused((recto_detail){50, 200, 10, 0, {0, 0}}, "out of range");
  assert_detail_refused((recto_detail){50, 200, 10, -1, {0, 0}},
                        "out of range");
  assert_detail_refused((recto_detail){50, 200, 0, 2, {0, 0}}, "out of range");
  assert_detail_refused((recto_detail){NAN, 200, 1, 2, {0, 0}}, "out of range");
  assert_detail_refused((recto_detail){3, 200, 10, 2, {0, 0}},
                        "A, of 10 mm about 3,200, is not on the page");
  assert_detail_refused((recto_detail){50, 290, 10, 2, {0, 0}},
                        "is not on the page");
  assert_detail_refused((recto_detail){190, 20, 5, 2, {0, 0}},
                        "shows nothing of any view");
  assert_detail_refused((recto_detail){50, 200, 10, 50, {0, 0}},
                        "A, of 500 mm, has no room");
  const recto_detail nine[9] = {{50, 200, 1, 2, {0, 0}}};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.sheet.detail = nine;
  options.sheet.detail_count = 9;
  assert_refused(&options, "9 details");
  options.sheet.detail_count = 1;
  options.sheet.arrangement = RECTO_ARRANGEMENT_NONE;
  assert_refused(&options, "arranged");
}

/* ---- Text ---------------------------------------------------------------- */

static struct box box_of_text(const recto_drawing *drawing, size_t from,
                              size_t to) {
  struct box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  recto_stroke stroke;
  size_t found = 0;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++) {
    if (!stroke.is_text)
      continue;
    assert_int_equal(stroke.edge_class, 0);
    recto_layer layer;
    assert_true(recto_drawing_layer(drawing, stroke.layer, &layer));
    assert_string_equal(layer.label, "1 text");
    assert_int_equal(layer.pen, 1);
    for (size_t k = 0; found >= from && found < to && k < 2 * stroke.count;
         k++) {
      box.low[k % 2] = fmin(box.low[k % 2], stroke.points[k]);
      box.high[k % 2] = fmax(box.high[k % 2], stroke.points[k]);
    }
    found++;
  }
  return box;
}

/* "LL" has two strokes a letter; the page's shorter side of 210 mm makes the
 * title 5 mm high and names 3.5 mm. */
static void text_is_below_what_it_names(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.output.title = "LL";
  recto_drawing *drawing = draw(&options);
  struct box title = box_of_text(drawing, 0, 100);
  assert_true(is_close(title.high[1] - title.low[1], 5));
  assert_true(is_close(title.low[1], 12));
  assert_in_range((int)title.low[0], 95, 105);
  assert_true(title.high[1] < box_of(drawing, "top").low[1]);
  recto_drawing_destroy(drawing);

  options.sheet.names = true;
  options.output.title = "";
  drawing = draw(&options);
  struct box name = box_of_text(drawing, 0, 12),
             front = box_of(drawing, "front");
  assert_true(is_close(name.high[1] - name.low[1], 3.5));
  assert_true(is_close(front.low[1] - name.high[1], 3.5));
  assert_true(fabs(middle_of(name, 0) - middle_of(front, 0)) < 1);
  assert_true(name.low[1] > box_of(drawing, "top").high[1]);
  recto_drawing_destroy(drawing);
}

static size_t count_text(const recto_drawing *drawing) {
  recto_stroke stroke;
  size_t count = 0;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    count += stroke.is_text;
  return count;
}

static void init_long_sheet(recto_options *options,
                            const recto_sheet_view *view, size_t count) {
  init_sheet(options, RECTO_ARRANGEMENT_FIRST, view, count);
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = 0.08;
  options->sheet.names = true;
  options->page.width_mm = 297;
  options->page.height_mm = 210;
}

/* The columns of views that are edge-on are as wide as their names, and so are
 * those of small views with names that tell a scale. */
static void names_lie_beside_each_other_inside_the_margins(void **state) {
  (void)state;
  static const recto_sheet_view view[] = {{.name = "left"},
                                          {.name = "right"},
                                          {.name = "front"},
                                          {.name = "dimetric", .scale = 0.01},
                                          {.name = "trimetric", .scale = 0.01}};
  enum { VIEWS = 5 };
  struct box name[VIEWS];
  recto_options options;
  init_long_sheet(&options, view, VIEWS);
  recto_drawing *drawing = draw_scene(make_scene_of(long_points), &options);
  size_t from = 0;
  for (size_t i = 0; i < VIEWS; i++) {
    init_long_sheet(&options, &view[i], 1);
    recto_drawing *alone = draw_scene(make_scene_of(long_points), &options);
    size_t strokes = count_text(alone);
    recto_drawing_destroy(alone);
    name[i] = box_of_text(drawing, from, from + strokes);
    from += strokes;
    assert_true(name[i].low[0] >= 10 && name[i].high[0] <= 287);
    for (size_t k = 0; k < i; k++)
      assert_true(name[i].low[0] > name[k].high[0] ||
                  name[i].high[0] < name[k].low[0] ||
                  name[i].low[1] > name[k].high[1] ||
                  name[i].high[1] < name[k].low[1]);
  }
  assert_int_equal(from, count_text(drawing));
  recto_drawing_destroy(drawing);
}

static double gap_of_strokes(const recto_stroke *a, const recto_stroke *b) {
  double least = INFINITY;
  for (size_t i = 0; i + 1 < a->count + a->closed; i++)
    for (size_t part = 0; part <= 20; part++) {
      const double *from = a->points + 2 * i;
      const double *to = a->points + 2 * ((i + 1) % a->count);
      const double p[2] = {from[0] + (to[0] - from[0]) * (double)part / 20,
                           from[1] + (to[1] - from[1]) * (double)part / 20};
      for (size_t k = 0; k + 1 < b->count + b->closed; k++) {
        const double *c = b->points + 2 * k;
        const double *d = b->points + 2 * ((k + 1) % b->count);
        const double side[4] = {c[0], c[1], d[0], d[1]};
        least = fmin(least, distance_to_segment(p, side));
      }
    }
  return least;
}

/* The letter is drawn last: an A is three strokes. */
static void a_letter_is_clear_of_the_lines(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 8;
  options.sheet.names = true;
  for (int fill = 0; fill < 2; fill++) {
    options.sheet.detail_count = 0;
    options.ink.fill = fill ? RECTO_FILL_HATCH : RECTO_FILL_NONE;
    recto_drawing *plain = draw(&options);
    struct box top = box_of(plain, "top");
    recto_drawing_destroy(plain);
    for (int k = 0; k <= 10; k++) {
      const recto_detail detail = {.x_mm = top.low[0] +
                                           k * (top.high[0] - top.low[0]) / 10,
                                   .y_mm = middle_of(top, 1),
                                   .radius_mm = 4,
                                   .scale = 2};
      options.sheet.detail = &detail;
      options.sheet.detail_count = 1;
      recto_drawing *drawing = draw(&options);
      size_t count = recto_drawing_stroke_count(drawing);
      recto_stroke letter, other;
      for (size_t i = count - 3; i < count; i++) {
        assert_true(recto_drawing_stroke(drawing, i, &letter));
        assert_true(letter.is_text);
        for (size_t n = 0; n < count - 3; n++) {
          assert_true(recto_drawing_stroke(drawing, n, &other));
          assert_true(gap_of_strokes(&letter, &other) > 0.3);
        }
      }
      recto_drawing_destroy(drawing);
    }
  }
}

static void only_sheets_have_text(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.output.title = "LL";
  recto_drawing *drawing = draw(&options);
  recto_stroke stroke;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    assert_false(stroke.is_text);
  recto_drawing_destroy(drawing);
}

/* ---- Errors -------------------------------------------------------------- */

static void assert_refused(const recto_options *options, const char *words) {
  recto_scene *scene = make_scene();
  recto_drawing *drawing;
  recto_error error;
  assert_int_equal(recto_scene_render(scene, options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_null(drawing);
  if (strstr(error.text, words) == NULL)
    fail_msg("\"%s\" is not in: %s", words, error.text);
  recto_scene_destroy(scene);
}

static void assert_view_refused(recto_sheet_view view, const char *words) {
  const recto_sheet_view two[] = {{.name = "front"}, view};
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, two, 2);
  assert_refused(&options, words);
}

static void views_that_make_no_sense_are_refused(void **state) {
  (void)state;
  assert_view_refused((recto_sheet_view){.name = "frnt"}, "no view \"frnt\"");
  assert_view_refused((recto_sheet_view){.name = "front"}, "front is on");
  assert_view_refused((recto_sheet_view){.name = "top", .scale = 2},
                      "top is aligned");
  assert_view_refused((recto_sheet_view){.name = "iso", .scale = -1},
                      "out of range");
  assert_view_refused((recto_sheet_view){.name = "iso", .scale = NAN},
                      "out of range");
  assert_view_refused((recto_sheet_view){.name = "iso", .hidden = 9},
                      "out of range");
}

static void what_contradicts_a_sheet_is_refused(void **state) {
  (void)state;
  recto_options options, sheet;
  init_sheet(&sheet, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options = sheet;
  options.camera.fov_deg = 30;
  assert_refused(&options, "parallel projections");
  options = sheet;
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.eye[0] = 99;
  assert_refused(&options, "parallel projections");
  options = sheet;
  options.camera.fit = RECTO_FIT_NONE;
  assert_refused(&options, "fit its page");
  options = sheet;
  options.results = RECTO_RESULT_EDGES;
  assert_refused(&options, "results of one view");
  options = sheet;
  options.sheet.arrangement = (recto_arrangement)3;
  assert_refused(&options, "out of range");
  init_sheet(&options, RECTO_ARRANGEMENT_NONE, six, 6);
  assert_refused(&options, "arranged");
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 6);
  assert_refused(&options, "a list of the options");
}

static void titles_that_cannot_be_drawn_are_refused(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.output.title = "\343\201\202";
  assert_refused(&options, "the font has no \"\343\201\202\" (U+3042)");
  options.output.title = "\377";
  assert_refused(&options, "no text in UTF-8");
  options.output.title =
      "WWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWW";
  assert_refused(&options, "mm wide, and the page has 190 mm");
}

static void views_that_do_not_fit_are_refused(void **state) {
  (void)state;
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 14.52; /* 174.17 / 12 is 14.514 */
  assert_refused(&options, "do not fit: at this scale they are 174.2 x 232.3 "
                           "mm, and the page has 174.2 x 261.2 mm");
  options.camera.scale = 14.51;
  recto_drawing_destroy(draw(&options));
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, six, 6);
  options.page.width_mm = options.page.height_mm = 1;
  options.page.margin_mm = 0;
  recto_drawing_destroy(draw(&options));
}

/* A report that runs out of memory loses entries, not the drawing, so that a
 * run which succeeds need not be the last one. */
static void where_memory_runs_out_there_is_no_drawing(void **state) {
  (void)state;
  recto_scene *scene = make_scene();
  recto_options options;
  init_sheet(&options, RECTO_ARRANGEMENT_FIRST, NULL, 0);
  options.ink.fill = RECTO_FILL_PAINT;
  options.ink.ids = true;
  options.sheet.names = true;
  options.output.title = "LL";
  const recto_detail detail = {60, 200, 8, 2, {0, 0}};
  options.sheet.detail = &detail;
  options.sheet.detail_count = 1;
  options.camera.fit = RECTO_FIT_PREFERRED;
  options.verify = 100;
  options.solver.threads = 1;
  struct memory_faults faults = {.least = 200, .in_a_row = 100};
  while (memory_faults_go_on(&faults)) {
    recto_drawing *drawing;
    memory_faults_begin(&faults);
    recto_status status = recto_scene_render(scene, &options, &drawing, NULL);
    memory_faults_end(&faults, status);
    assert_true(status == RECTO_OK ? drawing != NULL : drawing == NULL);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corners_are_aligned_with_the_front_view),
      cmocka_unit_test(first_angle_has_views_on_the_far_side),
      cmocka_unit_test(third_angle_has_views_on_the_near_side),
      cmocka_unit_test(three_views_are_usual),
      cmocka_unit_test(other_views_stand_in_the_free_corner),
      cmocka_unit_test(all_views_lie_inside_the_margins),
      cmocka_unit_test(the_largest_scale_fills_the_page),
      cmocka_unit_test(a_preferred_scale_is_rounded_down),
      cmocka_unit_test(a_given_scale_is_kept),
      cmocka_unit_test(preferred_scales_are_those_of_the_standard),
      cmocka_unit_test(a_scale_out_of_range_is_the_largest_that_fits),
      cmocka_unit_test(a_single_view_may_have_a_preferred_scale),
      cmocka_unit_test(a_view_is_what_it_is_by_itself),
      cmocka_unit_test(a_view_has_hidden_lines_of_its_own),
      cmocka_unit_test(another_view_may_be_larger),
      cmocka_unit_test(every_view_is_verified),
      cmocka_unit_test(progress_grows_and_cancels),
      cmocka_unit_test(a_prepared_scene_gives_the_same_bytes),
      cmocka_unit_test(stats_have_a_part_for_each_view),
      cmocka_unit_test(the_free_corner_is_beside_the_aligned_views),
      cmocka_unit_test(a_view_without_lines_is_warned_of),
      cmocka_unit_test(a_warning_of_several_views_is_given_once),
      cmocka_unit_test(a_view_alone_is_named_by_its_direction),
      cmocka_unit_test(scales_are_written_as_ratios),
      cmocka_unit_test(names_lie_beside_each_other_inside_the_margins),
      cmocka_unit_test(a_letter_is_clear_of_the_lines),
      cmocka_unit_test(views_that_make_no_sense_are_refused),
      cmocka_unit_test(what_contradicts_a_sheet_is_refused),
      cmocka_unit_test(a_detail_is_the_circle_enlarged),
      cmocka_unit_test(details_that_make_no_sense_are_refused),
      cmocka_unit_test(text_is_below_what_it_names),
      cmocka_unit_test(only_sheets_have_text),
      cmocka_unit_test(titles_that_cannot_be_drawn_are_refused),
      cmocka_unit_test(views_that_do_not_fit_are_refused),
      cmocka_unit_test(where_memory_runs_out_there_is_no_drawing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
