/* test_failures_meshes.c - meshes with common defects, and lines that must
 * not be drawn because of these. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/judged.h"
#include "tests/temporary.h"

static void run(struct pipeline *pipeline, const struct scene *scene,
                const recto_options *options) {
  pipeline_run(pipeline, scene, options, &solver_newell);
  if (pipeline->status != RECTO_OK)
    fail_msg("%s", pipeline->error.text);
}

static void run_named(struct pipeline *pipeline, struct scene *scene,
                      recto_options *options, const char *name) {
  pipeline_fill(scene, options, scenes_find(name));
  run(pipeline, scene, options);
}

static void end(struct pipeline *pipeline, struct scene *scene) {
  pipeline_fini(pipeline);
  scene_fini(scene);
}

/* ---- Degenerate faces ---------------------------------------------------- */

static void faces_without_area_change_nothing(void **state) {
  (void)state;
  struct scene flawed, plain;
  recto_options options;
  size_t flawed_length, plain_length;
  pipeline_fill(&flawed, &options, scenes_find("zero area"));
  scene_init(&plain);
  build_group(&plain, "cube");
  build_box(&plain, vector_of(-1, -1, -1), vector_of(1, 1, 1));
  char *one = pipeline_draw(&flawed, &options, &solver_newell, &flawed_length);
  char *two = pipeline_draw(&plain, &options, &solver_newell, &plain_length);
  assert_string_equal(one, two);
  mem_free(one);
  mem_free(two);
  scene_fini(&flawed);
  scene_fini(&plain);
}

static void faces_edge_on_hide_nothing(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  run_named(&pipeline, &scene, &options, "faces edge-on");
  /* The cube's front is in front of the middles of these faces; of its own
   * outline nothing is lost. */
  double cube = 0;
  for (size_t i = 0; i < pipeline.map.edge_count; i++) {
    const struct sheet_edge *edge = &pipeline.sheet.edge.item[i];
    struct geom_point a = pipeline.sheet.point.item[edge->point[0]];
    struct geom_point b = pipeline.sheet.point.item[edge->point[1]];
    bool front = a.z == b.z && (a.x != b.x || a.y != b.y);
    if (sheet_edge_group(&pipeline.sheet, edge) == 0 && front &&
        pipeline.map.edge_state[i] == MAP_VISIBLE)
      cube += hypot(b.x - a.x, b.y - a.y) / SHEET_UNITS_PER_MM;
  }
  const double side = 2 * pipeline.camera.s;
  assert_true(cube > 4 * side - 1e-4);
  end(&pipeline, &scene);
}

static void flawed_faces_are_drawn_as_the_judge_sees_them(void **state) {
  static const char *const name[] = {"faces edge-on",     "needles",
                                     "zero area",         "collinear vertices",
                                     "repeated vertices", "flaws mixed"};
  (void)state;
  for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, scenes_find(name[i]));
    judged_assert(&scene, &options, options.ink.edges, name[i]);
    scene_fini(&scene);
  }
}

/* ---- Seams --------------------------------------------------------------- */

static void a_seam_with_hanging_vertices_is_drawn_once(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  run_named(&pipeline, &scene, &options, "T-junctions");
  /* The outlines of both halves; the seam is a border of each, on one line.
   * Sides along x are 4 long, those of the slopes run along y and z. */
  double matrix[12];
  camera_matrix(&pipeline.camera, matrix);
  double x = hypot(matrix[0], matrix[4]);
  double up = hypot(matrix[1] + 0.25 * matrix[2], matrix[5] + 0.25 * matrix[6]);
  double down =
      hypot(matrix[1] - 0.25 * matrix[2], matrix[5] - 0.25 * matrix[6]);
  judged_assert_near(pipeline_length(&pipeline, RECTO_EDGES_ALL, false),
                     3 * 4 * x + 2 * 4 * up + 2 * 1 * down, 1e-4, "seam");
  end(&pipeline, &scene);
}

static void unwelded_is_drawn_as_welded(void **state) {
  (void)state;
  struct scene welded, unwelded;
  recto_options options;
  struct pipeline one, two;
  run_named(&one, &welded, &options, "icosahedron");
  run_named(&two, &unwelded, &options, "unwelded");
  assert_int_equal(one.topology.edge.count, 30);
  assert_int_equal(two.topology.edge.count, 30);
  assert_true(unwelded.point.count == 60);
  for (unsigned i = 1; i < RECTO_EDGES_ALL; i *= 2)
    judged_assert_near(pipeline_length(&one, i, false),
                       pipeline_length(&two, i, false), 1e-4, "class");
  end(&one, &welded);
  end(&two, &unwelded);
}

/* ---- Faces in pieces ----------------------------------------------------- */

static void a_face_in_pieces_shows_no_line_inside(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  run_named(&pipeline, &scene, &options, "white square");
  assert_int_equal(pipeline.drawing.stroke.count, 1);
  assert_true(pipeline.drawing.stroke.item[0].closed);
  assert_int_equal(pipeline.drawing.stroke.item[0].count, 4);
  judged_assert_near(pipeline_length(&pipeline, RECTO_EDGES_ALL, false), 160,
                     1e-5, "square");
  end(&pipeline, &scene);
}

static void no_split_is_drawn(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  run_named(&pipeline, &scene, &options, "split faces");
  /* The method did split; all that is drawn is border or intersection. */
  assert_true(
      report_get(pipeline.report, "newell", "splits_by_cycle", 0) +
          report_get(pipeline.report, "newell", "splits_by_intersection", 0) >
      0);
  for (size_t i = 0; i < pipeline.drawing.stroke.count; i++)
    assert_true((pipeline.drawing.stroke.item[i].edge_class &
                 (RECTO_EDGE_BORDER | RECTO_EDGE_INTERSECTION)) != 0);
  pipeline_fini(&pipeline);
  /* And each of its points lies on a border or an intersection. */
  judged_assert(&scene, &options, options.ink.edges, "split faces");
  scene_fini(&scene);
}

/* ---- Lines that coincide, or go straight on ------------------------------ */

static void a_box_seen_square_on_is_one_rectangle(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  run_named(&pipeline, &scene, &options, "box square-on");
  assert_int_equal(pipeline.drawing.stroke.count, 1);
  assert_true(pipeline.drawing.stroke.item[0].closed);
  assert_int_equal(pipeline.drawing.stroke.item[0].count, 4);
  judged_assert_near(pipeline_length(&pipeline, RECTO_EDGES_ALL, false), 180,
                     1e-5, "box");
  end(&pipeline, &scene);
}

struct segment {
  struct drawing_point a, b;
};

/* How far the point is from the segment's line, and where along it in mm. */
static double off_line(const struct segment *s, struct drawing_point p,
                       double *along) {
  double dx = s->b.x - s->a.x, dy = s->b.y - s->a.y, l = hypot(dx, dy);
  double x = p.x - s->a.x, y = p.y - s->a.y;
  *along = (x * dx + y * dy) / l;
  return fabs(x * dy - y * dx) / l;
}

/* The length in mm that two segments share. */
static double shared(const struct segment *s, const struct segment *t) {
  const double same = 4e-6; /* four grid units: the width of coincidence */
  double from, to;
  if (off_line(s, t->a, &from) > same || off_line(s, t->b, &to) > same)
    return 0;
  double length = hypot(s->b.x - s->a.x, s->b.y - s->a.y);
  return fmin(length, fmax(from, to)) - fmax(0, fmin(from, to));
}

static size_t list_segments(const struct drawing *drawing,
                            struct segment *segment, size_t room) {
  size_t count = 0;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const struct drawing_point *p = drawing->point.item + stroke->point;
    uint32_t segments = stroke->count - 1 + stroke->closed;
    for (uint32_t k = 0; k < segments; k++) {
      assert_true(count < room);
      segment[count++] = (struct segment){p[k], p[(k + 1) % stroke->count]};
    }
  }
  return count;
}

static void no_line_is_drawn_twice(void **state) {
  enum { room = 4000 };
  static struct segment segment[room];
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    run_named(&pipeline, &scene, &options, entry->name);
    size_t count = list_segments(&pipeline.drawing, segment, room);
    for (size_t i = 0; i < count; i++)
      for (size_t k = i + 1; k < count; k++) {
        const struct segment *s = &segment[i], *t = &segment[k];
        bool apart = fmin(s->a.x, s->b.x) > fmax(t->a.x, t->b.x) + 1e-3 ||
                     fmin(t->a.x, t->b.x) > fmax(s->a.x, s->b.x) + 1e-3;
        if (!apart && shared(s, t) > 1e-3 && shared(t, s) > 1e-3)
          fail_msg("%s: %.4f mm twice near %.4f %.4f", entry->name,
                   shared(s, t), t->a.x, t->a.y);
      }
    end(&pipeline, &scene);
  }
}

static void a_straight_edge_is_two_points(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline divided, plain;
  run_named(&divided, &scene, &options, "collinear edges");
  struct scene box;
  scene_init(&box);
  build_box(&box, vector_of(0, 0, 0), vector_of(3, 2, 1));
  run(&plain, &box, &options);
  assert_int_equal(divided.drawing.point.count, plain.drawing.point.count);
  judged_assert_near(pipeline_length(&divided, RECTO_EDGES_ALL, false),
                     pipeline_length(&plain, RECTO_EDGES_ALL, false), 1e-4,
                     "length");
  end(&divided, &scene);
  end(&plain, &box);
}

static void no_stroke_has_a_point_within_a_straight(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    run_named(&pipeline, &scene, &options, entry->name);
    for (size_t i = 0; i < pipeline.drawing.stroke.count; i++) {
      const struct drawing_stroke *stroke = &pipeline.drawing.stroke.item[i];
      const struct drawing_point *p =
          pipeline.drawing.point.item + stroke->point;
      for (uint32_t k = 2; k < stroke->count; k++) {
        struct segment whole = {p[k - 2], p[k]};
        double along, length = hypot(p[k].x - p[k - 2].x, p[k].y - p[k - 2].y);
        double off = off_line(&whole, p[k - 1], &along);
        if (length > 0 && off < 1e-7 && along > 0 && along < length)
          fail_msg("%s: idle point at %.6f %.6f", entry->name, p[k - 1].x,
                   p[k - 1].y);
      }
    }
    end(&pipeline, &scene);
  }
}

/* ---- Faulty files -------------------------------------------------------- */

struct heard {
  unsigned count;
  unsigned long line; /* of the first */
  char file[256];
};

static void hear(void *user, const char *file, unsigned long line,
                 const char *text) {
  struct heard *heard = user;
  assert_true(text[0] != '\0');
  if (heard->count++ > 0)
    return;
  heard->line = line;
  snprintf(heard->file, sizeof heard->file, "%s", file);
}

static void one_bad_element_spoils_nothing_else(void **state) {
  for (const struct scenes_faulty *faulty = scenes_faulty_list; faulty->name;
       faulty++) {
    struct scene scene;
    struct heard heard = {0};
    struct diagnostics diagnostics = {.warning = hear, .user = &heard};
    struct pipeline pipeline;
    recto_options options;
    scene_init(&scene);
    const char *path =
        temporary_file(state, "faulty.obj", faulty->text, strlen(faulty->text));
    diagnostics.file = path;
    assert_int_equal(scene_read(&scene, path, NULL, &diagnostics, NULL),
                     RECTO_OK);
    diagnostics_finish(&diagnostics);
    if (scene_face_count(&scene) != faulty->faces)
      fail_msg("%s: %u faces are left, not %u", faulty->name,
               scene_face_count(&scene), faulty->faces);
    bool warns = faulty->line > 0 && faulty->fault != SCENE_FAULT_WARPED;
    if (warns != (heard.count > 0) || (warns && heard.line != faulty->line))
      fail_msg("%s: %u warnings, the first of line %lu", faulty->name,
               heard.count, heard.line);
    if (warns)
      assert_string_equal(heard.file, path);
    if (faulty->fault < SCENE_FAULT_COUNT &&
        faulty->fault != SCENE_FAULT_WARPED)
      assert_true(diagnostics.count[faulty->fault] > 0);
    recto_options_init(&options);
    run(&pipeline, &scene, &options);
    assert_true(pipeline_length(&pipeline, RECTO_EDGES_ALL, false) > 100);
    end(&pipeline, &scene);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faces_without_area_change_nothing),
      cmocka_unit_test(faces_edge_on_hide_nothing),
      cmocka_unit_test(flawed_faces_are_drawn_as_the_judge_sees_them),
      cmocka_unit_test(a_seam_with_hanging_vertices_is_drawn_once),
      cmocka_unit_test(unwelded_is_drawn_as_welded),
      cmocka_unit_test(a_face_in_pieces_shows_no_line_inside),
      cmocka_unit_test(no_split_is_drawn),
      cmocka_unit_test(a_box_seen_square_on_is_one_rectangle),
      cmocka_unit_test(no_line_is_drawn_twice),
      cmocka_unit_test(a_straight_edge_is_two_points),
      cmocka_unit_test(no_stroke_has_a_point_within_a_straight),
      cmocka_unit_test_setup_teardown(one_bad_element_spoils_nothing_else,
                                      temporary_set_up, temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
