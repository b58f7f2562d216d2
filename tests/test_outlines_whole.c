/* test_outlines_whole.c - along the outline of what is seen there are lines,
 * everywhere, and what is painted reaches it: of meshes of warped faces as of
 * others.
 *
 * The outline is that of a picture by the tests' own depth buffer
 * (judge/raster.h): pixels on which there is a face, beside one without. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/judge_input.h"
#include "scene/read.h"
#include "tests/judge/raster.h"
#include "tests/scenes/catmull_clark.h"
#include "tests/scenes/pipeline.h"
#include "tests/valgrind.h"

/* Pixels a side, and how near a line must be: 0.4 mm on a page of 200. */
enum { PIXELS = 1000, NEAR = 2 };

static const double page_mm = 200;

/* ---- Pictures ------------------------------------------------------------ */

struct picture {
  struct judge_raster faces;
  uint8_t *ink; /* one a pixel: a line goes through it */
};

static void mark(struct picture *picture, double x, double y) {
  double scale = PIXELS / page_mm;
  int column = (int)floor(x * scale), row = (int)floor(y * scale);
  if (column >= 0 && row >= 0 && column < PIXELS && row < PIXELS)
    picture->ink[row * PIXELS + column] = 1;
}

static void mark_lines(struct picture *picture, const struct drawing *drawing) {
  for (size_t s = 0; s < drawing->stroke.count; s++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[s];
    const struct drawing_point *p = drawing->point.item + stroke->point;
    for (uint32_t i = 1; i < stroke->count + stroke->closed; i++) {
      struct drawing_point a = p[i - 1], b = p[i < stroke->count ? i : 0];
      double length = hypot(b.x - a.x, b.y - a.y);
      int steps = (int)(length * 2 * PIXELS / page_mm) + 1;
      for (int k = 0; k <= steps; k++)
        mark(picture, a.x + (b.x - a.x) * k / steps,
             a.y + (b.y - a.y) * k / steps);
    }
  }
}

static bool is_empty(const struct picture *picture, int column, int row) {
  return picture->faces.face[row * PIXELS + column] == SCENE_NONE;
}

static bool is_outline(const struct picture *picture, int column, int row) {
  return !is_empty(picture, column, row) &&
         (is_empty(picture, column - 1, row) ||
          is_empty(picture, column + 1, row) ||
          is_empty(picture, column, row - 1) ||
          is_empty(picture, column, row + 1));
}

static bool has_ink_near(const struct picture *picture, int column, int row) {
  for (int y = row - NEAR; y <= row + NEAR; y++)
    for (int x = column - NEAR; x <= column + NEAR; x++)
      if (picture->ink[y * PIXELS + x])
        return true;
  return false;
}

/* How many pixels of the outline there are, and of these without a line. */
static size_t count_bare(const struct picture *picture, size_t *outline) {
  size_t bare = 0;
  *outline = 0;
  for (int row = NEAR; row < PIXELS - NEAR; row++)
    for (int column = NEAR; column < PIXELS - NEAR; column++)
      if (is_outline(picture, column, row)) {
        ++*outline;
        bare += !has_ink_near(picture, column, row);
      }
  return bare;
}

static void draw_faces(struct picture *picture, const struct scene *scene,
                       const struct pipeline *pipeline,
                       const recto_options *options) {
  struct judge_input input;
  assert_true(judge_input_init(&input, scene));
  struct judge_camera camera =
      judge_input_camera(&input, &pipeline->camera, options);
  judge_raster_init(&picture->faces, PIXELS, page_mm);
  judge_raster_scene(&picture->faces, &input.scene, &camera);
  judge_input_fini(&input);
}

/* ---- Checks -------------------------------------------------------------- */

/* Whether what is painted covers what the faces do, but for pixels beside the
 * outline. */
static void check_fills(const struct picture *picture,
                        const struct drawing *drawing, const char *name) {
  struct judge_raster painted;
  judge_raster_init(&painted, PIXELS, page_mm);
  for (size_t f = 0; f < drawing->fill.count; f++) {
    const struct drawing_fill *fill = &drawing->fill.item[f];
    uint32_t *count = calloc(fill->loops, sizeof *count);
    struct judge_point2 *place = NULL;
    size_t places = 0;
    for (uint32_t l = 0; l < fill->loops; l++) {
      const struct drawing_loop *loop = &drawing->loop.item[fill->loop + l];
      count[l] = loop->count;
      place = realloc(place, (places + loop->count) * sizeof *place);
      for (uint32_t i = 0; i < loop->count; i++) {
        struct drawing_point p = drawing->point.item[loop->point + i];
        place[places++] = (struct judge_point2){p.x, p.y};
      }
    }
    judge_raster_region(&painted, place, count, fill->loops, 0);
    free(place);
    free(count);
  }
  struct judge_raster whole = picture->faces;
  for (size_t i = 0; i < (size_t)PIXELS * PIXELS; i++)
    if (whole.face[i] != SCENE_NONE)
      whole.face[i] = 0;
  size_t differ = judge_raster_differ(&whole, &painted);
  differ += judge_raster_differ(&painted, &whole);
  if (differ > 0)
    fail_msg("%s: %lu pixels are painted wrong", name, (unsigned long)differ);
  judge_raster_fini(&painted);
}

static void check_view(const struct scene *scene, const recto_options *options,
                       const char *name) {
  struct pipeline pipeline;
  struct picture picture;
  size_t outline;
  pipeline_run(&pipeline, scene, options, &solver_tiles);
  if (pipeline.status != RECTO_OK)
    fail_msg("%s: %s", name, pipeline.error.text);
  draw_faces(&picture, scene, &pipeline, options);
  picture.ink = calloc((size_t)PIXELS * PIXELS, 1);
  mark_lines(&picture, &pipeline.drawing);
  size_t bare = count_bare(&picture, &outline);
  assert_true(outline > PIXELS);
  if (bare > 0)
    fail_msg("%s: no line along %lu of %lu pixels of the outline", name,
             (unsigned long)bare, (unsigned long)outline);
  if (options->ink.fill == RECTO_FILL_PAINT)
    check_fills(&picture, &pipeline.drawing, name);
  free(picture.ink);
  judge_raster_fini(&picture.faces);
  pipeline_fini(&pipeline);
}

/* In perspective, from a corner and from the front; with those classes alone of
 * which outlines are made. */
static void check_views(const struct scene *scene, const char *name,
                        recto_fill fill) {
  static const double view[][3] = {{30, 20, 40}, {45, 35, 0}, {0, 0, 0}};
  for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
    recto_options options;
    char what[64];
    snprintf(what, sizeof what, "%.40s, view %u", name, (unsigned)v);
    recto_options_init(&options);
    options.page.width_mm = options.page.height_mm = page_mm;
    options.ink.edges =
        RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER | RECTO_EDGE_INTERSECTION;
    options.camera.azimuth_deg = view[v][0];
    options.camera.elevation_deg = view[v][1];
    options.camera.fov_deg = view[v][2];
    options.ink.fill = fill;
    check_view(scene, &options, what);
  }
}

/* So many times smoother, each time checked. */
static void check_steps(struct scene *scene, const char *name, int steps,
                        recto_fill fill) {
  char what[40];
  for (int step = 0;; step++) {
    snprintf(what, sizeof what, "%.25s, %d steps", name, step);
    check_views(scene, what, fill);
    if (step == steps)
      return;
    struct scene coarse = *scene;
    scene_init(scene);
    scenes_catmull_clark(scene, &coarse);
    scene_fini(&coarse);
  }
}

/* ---- Meshes -------------------------------------------------------------- */

/* A closed surface of warped quadrilaterals: a ring whose points stand out and
 * lie in by turns, and so twisted that none of its faces is planar. */
static void make_ring(struct scene *scene, uint32_t around, uint32_t across) {
  const double turn = 2 * acos(-1);
  build_group(scene, "ring");
  for (uint32_t i = 0; i < around; i++)
    for (uint32_t k = 0; k < across; k++) {
      double u = turn * i / around, v = turn * k / across + u;
      double r = (i + k) % 2 ? 1.15 : 0.9;
      build_point(scene, (3 + r * cos(v)) * cos(u), r * sin(v),
                  (3 + r * cos(v)) * sin(u));
    }
  for (uint32_t i = 0; i < around; i++)
    for (uint32_t k = 0; k < across; k++) {
      uint32_t next = (i + 1) % around, beside = (k + 1) % across;
      /* Once round the ring, v has gone round too. */
      build_quad(scene, i * across + k, next * across + k,
                 next * across + beside, i * across + beside);
    }
}

static void a_ring_of_warped_faces_has_its_whole_outline(void **state) {
  (void)state;
  struct scene scene;
  scene_init(&scene);
  make_ring(&scene, 12, 6);
  bool few = is_under_valgrind();
  check_steps(&scene, "ring", few ? 0 : 3, RECTO_FILL_PAINT);
  scene_fini(&scene);
}

/* Smoothed, it has no creases: warp makes none. */
static void a_smooth_ring_has_no_creases(void **state) {
  (void)state;
  struct scene coarse, fine[3];
  scene_init(&coarse);
  make_ring(&coarse, 12, 6);
  for (int step = 0; step < 3; step++) {
    scene_init(&fine[step]);
    scenes_catmull_clark(&fine[step], step > 0 ? &fine[step - 1] : &coarse);
  }
  recto_options options;
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGE_CREASE;
  struct pipeline pipeline;
  pipeline_run(&pipeline, &fine[2], &options, &solver_tiles);
  assert_int_equal(pipeline.status, RECTO_OK);
  assert_true(pipeline.sheet.warped > 1000);
  assert_int_equal(pipeline.drawing.stroke.count, 0);
  pipeline_fini(&pipeline);
  scene_fini(&coarse);
  for (int step = 0; step < 3; step++)
    scene_fini(&fine[step]);
}

static void check_model(const char *folder, const char *name, int steps,
                        recto_fill fill) {
  char path[1000];
  struct scene scene;
  struct diagnostics silent = {.file = path};
  if (folder == NULL || is_under_valgrind())
    skip();
  snprintf(path, sizeof path, "%.900s/%s.obj", folder, name);
  scene_init(&scene);
  if (scene_read(&scene, path, NULL, &silent, NULL) != RECTO_OK) {
    scene_fini(&scene);
    print_message("no %s\n", name);
    skip();
  }
  check_steps(&scene, name, steps, fill);
  scene_fini(&scene);
}

static void suzanne_has_her_whole_outline(void **state) {
  (void)state;
  check_model(getenv("RECTO_MODELS"), "suzanne", 3, RECTO_FILL_NONE);
}

static void the_teapot_has_its_whole_outline(void **state) {
  (void)state;
  check_model(getenv("RECTO_MODELS"), "teapot", 0, RECTO_FILL_NONE);
}

static void the_example_models_have_their_whole_outlines(void **state) {
  (void)state;
  static const char *const names[] = {"castle", "gears", "knot"};
  const char *source = getenv("srcdir");
  char folder[600];
  snprintf(folder, sizeof folder, "%.500s/examples/models",
           source != NULL ? source : ".");
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    check_model(folder, names[i], 0, RECTO_FILL_NONE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_ring_of_warped_faces_has_its_whole_outline),
      cmocka_unit_test(a_smooth_ring_has_no_creases),
      cmocka_unit_test(suzanne_has_her_whole_outline),
      cmocka_unit_test(the_teapot_has_its_whole_outline),
      cmocka_unit_test(the_example_models_have_their_whole_outlines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
