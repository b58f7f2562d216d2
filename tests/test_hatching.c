/* test_hatching.c - whole models hatched, as read back from the files: the
 * length of line that the visible area requires. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "backends/writer.h"
#include "judge/judge.h"
#include "judge/svg/svg.h"
#include "scene/read.h"
#include "tests/hpgl_reader.h"
#include "tests/measure/measure.h"
#include "tests/scenes/pipeline.h"

static const double hpgl_units_per_mm = 40;

/* The length in mm of what runs along the page in an SVG file. */
static double level_ink_in_svg(const struct pipeline *pipeline,
                               const recto_options *options) {
  struct judge_drawing drawing;
  size_t length;
  double sum = 0;
  char *text = pipeline_svg(pipeline, options, &length);
  /* The judge's reader ignores the class hatch: renamed, it is read as ink. */
  for (char *name = text; (name = strstr(name, "\"hatch\"")) != NULL;)
    memcpy(name, "\"lines\"", 7);
  assert_null(judge_read_svg(&drawing, text, length));
  for (size_t s = 0; s < drawing.stroke.count; s++) {
    const struct judge_stroke *stroke = &drawing.stroke.item[s];
    const struct judge_point2 *p = drawing.point.item + stroke->point;
    for (uint32_t i = 0; i + 1 < stroke->count; i++)
      if (p[i].y == p[i + 1].y)
        sum += fabs(p[i + 1].x - p[i].x);
  }
  judge_drawing_fini(&drawing);
  mem_free(text);
  return sum;
}

static double level_ink_in_hpgl(const struct pipeline *pipeline) {
  const struct writer_options writing = {.device = "generic"};
  struct stream *stream = NULL;
  struct hpgl hpgl;
  size_t length;
  double sum = 0;
  assert_int_equal(stream_open_memory(&stream, NULL), RECTO_OK);
  assert_int_equal(
      writer_hpgl.write(&pipeline->drawing, &writing, stream, NULL), RECTO_OK);
  const char *text = stream_memory(stream, &length);
  assert_non_null(text);
  hpgl_read(&hpgl, text, length);
  assert_string_equal(hpgl.fault, "");
  for (size_t s = 0; s < hpgl.stroke.count; s++) {
    const struct hpgl_stroke *stroke = &hpgl.stroke.item[s];
    const struct hpgl_point *p = hpgl.point.item + stroke->point;
    for (uint32_t i = 0; i + 1 < stroke->count; i++)
      if (p[i].y == p[i + 1].y)
        sum += abs(p[i + 1].x - p[i].x) / hpgl_units_per_mm;
  }
  hpgl_free(&hpgl);
  stream_discard(stream);
  return sum;
}

static double visible_area(const struct map *map) {
  double area = 0;
  for (size_t f = 0; f < map->fragment.count; f++)
    area += measure_fragment_area(map, f);
  return area;
}

/* Hatches a model with level lines.  False where it is not there. */
static bool hatch(struct pipeline *pipeline, recto_options *options,
                  const char *folder, const char *name, double pitch) {
  char path[1000];
  struct scene scene;
  struct diagnostics silent = {.file = path};
  snprintf(path, sizeof path, "%.900s/%s.obj", folder ? folder : "none", name);
  scene_init(&scene);
  bool there = scene_read(&scene, path, NULL, &silent, NULL) == RECTO_OK;
  recto_options_init(options);
  options->camera.azimuth_deg = 30;
  options->camera.elevation_deg = 25;
  options->ink.fill = RECTO_FILL_HATCH;
  options->ink.edges = RECTO_EDGES_NONE;
  options->ink.hatch_pitch_mm = pitch;
  options->ink.hatch_angle_deg = 0;
  options->ink.min_stroke_mm = 0;
  if (there) {
    pipeline_run(pipeline, &scene, options, &solver_tiles);
    assert_int_equal(pipeline->status, RECTO_OK);
  } else {
    print_message("no %s\n", name);
  }
  scene_fini(&scene);
  return there;
}

/* Within 1 % of area over pitch.  The steps of HPGL are no fraction of the
 * pitch: a line stands up to half a step off, but is as long as it is. */
static void check_length(const char *folder, const char *name, double pitch) {
  struct pipeline pipeline;
  recto_options options;
  if (!hatch(&pipeline, &options, folder, name, pitch))
    return;
  double want = visible_area(&pipeline.map) / pitch;
  double svg = level_ink_in_svg(&pipeline, &options);
  double hpgl = level_ink_in_hpgl(&pipeline);
  assert_true(want > 1000);
  if (!(fabs(svg / want - 1) < 0.01 && fabs(hpgl / want - 1) < 0.01))
    fail_msg("%s: %.1f mm in SVG, %.1f mm in HPGL, not %.1f", name, svg, hpgl,
             want);
  pipeline_fini(&pipeline);
}

static void hatched_length_is_area_over_pitch(void **state) {
  static const double pitch[] = {1, 0.6};
  const char *source = getenv("srcdir"), *real = getenv("RECTO_MODELS");
  char examples[600];
  (void)state;
  snprintf(examples, sizeof examples, "%.500s/examples/models",
           source != NULL ? source : ".");
  check_length(examples, "gears", 1);
  for (int i = 0; i < 2; i++) {
    check_length(real, "fandisk", pitch[i]);
    check_length(real, "spot", pitch[i]);
  }
}

/* How many strokes of hatching there are; their length along the lines of the
 * page, moves from line to line left out. */
static size_t find_lines(const struct drawing *drawing, double *length) {
  size_t count = 0;
  *length = 0;
  for (size_t s = 0; s < drawing->stroke.count; s++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[s];
    const struct drawing_point *p = drawing->point.item + stroke->point;
    if (stroke->edge_class != 0)
      continue;
    count++;
    for (uint32_t i = 0; i + 1 < stroke->count; i += 2)
      *length += hypot(p[i + 1].x - p[i].x, p[i + 1].y - p[i].y);
  }
  return count;
}

/* The lines of the page turned by some angle. */
static void the_angle_of_hatching_changes_no_length(void **state) {
  const char *source = getenv("srcdir");
  char path[600];
  struct scene scene;
  struct diagnostics silent = {.file = path};
  (void)state;
  snprintf(path, sizeof path, "%.500s/examples/models/gears.obj",
           source != NULL ? source : ".");
  scene_init(&scene);
  assert_int_equal(scene_read(&scene, path, NULL, &silent, NULL), RECTO_OK);
  for (double angle = -80; angle < 90; angle += 62) {
    struct pipeline pipeline;
    recto_options options;
    double along;
    recto_options_init(&options);
    options.ink.fill = RECTO_FILL_HATCH;
    options.ink.edges = RECTO_EDGES_NONE;
    options.ink.hatch_angle_deg = angle;
    options.ink.min_stroke_mm = 0;
    pipeline_run(&pipeline, &scene, &options, &solver_tiles);
    find_lines(&pipeline.drawing, &along);
    double want = visible_area(&pipeline.map) / options.ink.hatch_pitch_mm;
    if (!(fabs(along / want - 1) < 0.01))
      fail_msg("%g degrees: %.1f mm, not %.1f", angle, along, want);
    pipeline_fini(&pipeline);
  }
  scene_fini(&scene);
}

/* The strokes of a model that is drawn with its lines, and how long they are
 * without the moves from line to line. */
static size_t count_strokes(const struct scene *scene, double pitch_mm,
                            double *length) {
  struct pipeline pipeline;
  recto_options options;
  size_t count;
  recto_options_init(&options);
  options.ink.fill = RECTO_FILL_HATCH;
  options.solver.pitch_mm = pitch_mm;
  pipeline_run(&pipeline, scene, &options, &solver_watkins);
  assert_int_equal(pipeline.status, RECTO_OK);
  count = find_lines(&pipeline.drawing, length);
  pipeline_fini(&pipeline);
  return count;
}

/* The lines of the scan leave no more pieces than a few times what there are
 * without them. */
static void scan_lines_do_not_cut_hatching_up(void **state) {
  const char *source = getenv("srcdir"), *real = getenv("RECTO_MODELS");
  char path[2][600];
  (void)state;
  snprintf(path[0], sizeof path[0], "%.500s/examples/models/gears.obj",
           source != NULL ? source : ".");
  snprintf(path[1], sizeof path[1], "%.500s/spot.obj",
           real != NULL ? real : "none");
  for (int k = 0; k < 2; k++) {
    struct scene scene;
    struct diagnostics silent = {.file = path[k]};
    double exact, length;
    scene_init(&scene);
    if (scene_read(&scene, path[k], NULL, &silent, NULL) == RECTO_OK) {
      size_t few = count_strokes(&scene, 0, &exact);
      size_t count = count_strokes(&scene, 0.3, &length);
      if (!(count < 4 * few && fabs(length / exact - 1) < 0.02))
        fail_msg("%s: %zu strokes and %.0f mm, not %zu and %.0f", path[k],
                 count, length, few, exact);
    }
    scene_fini(&scene);
  }
}

/* Two faces in one plane, and above the lower one a third that goes back from
 * the higher one: of the higher one's side, a part is a line, and the pen may
 * not go along the other, between the two. */
static recto_scene *scene_with_half_a_line(void) {
  static const double points[] = {0, 0, 0, 4, 0, 0, 4, 2, 0, 4,  4, 0, 0, 4,
                                  0, 8, 0, 0, 8, 2, 0, 4, 2, -2, 4, 4, -2};
  static const uint32_t corners[] = {2, 3, 4, 0, 1, 1, 5, 6, 2, 2, 7, 8, 3};
  static const uint32_t offsets[] = {0, 5, 9, 13};
  const recto_mesh mesh = {.points = points,
                           .point_count = 9,
                           .corners = corners,
                           .corner_count = 13,
                           .face_offsets = offsets,
                           .face_count = 3};
  recto_scene *scene = NULL;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  return scene;
}

static void the_pen_goes_along_drawn_parts_of_sides_alone(void **state) {
  recto_scene *scene = scene_with_half_a_line();
  recto_drawing *drawing = NULL;
  recto_options options;
  recto_stroke stroke;
  double x = 0, low = 0;
  size_t along = 0, lines = 0;
  (void)state;
  recto_options_init(&options);
  options.ink.fill = RECTO_FILL_HATCH;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    if (stroke.edge_class == RECTO_EDGE_CREASE) {
      lines++;
      x = stroke.points[0];
      low = fmin(stroke.points[1], stroke.points[3]);
    }
  assert_int_equal(lines, 1);
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 1; stroke.edge_class == 0 && k < stroke.count; k++) {
      const double *p = stroke.points + 2 * (k - 1);
      along += fabs(p[0] - x) < 0.01 && fabs(p[2] - x) < 0.01 &&
               fmin(p[1], p[3]) < low - 0.01;
    }
  assert_int_equal(along, 0);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_pen_goes_along_drawn_parts_of_sides_alone),
      cmocka_unit_test(hatched_length_is_area_over_pitch),
      cmocka_unit_test(scan_lines_do_not_cut_hatching_up),
      cmocka_unit_test(the_angle_of_hatching_changes_no_length),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
