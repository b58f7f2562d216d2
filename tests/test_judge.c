/* test_judge.c - the judge accepts right drawings and rejects wrong ones.
 *
 * The drawings are built here: what is visible of a convex solid is known
 * without any solver. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "judge/ear_clipping.h"
#include "judge/grid.h"
#include "judge/judge.h"
#include "judge/svg/svg.h"
#include "tests/memory_faults.h"
#include "tests/polled.h"
#include "tests/scenes/judge_camera.h"
#include "tests/scenes/scenes.h"

/* An SVG file that is being written. */
struct page {
  char text[60000];
  size_t length;
  double contact;                  /* as in judge_options */
  const struct scene_point *given; /* as in judge_options */
  struct judge_removed removed;    /* as in judge_options */
  struct judge_camera camera;
};

static void write_text(struct page *page, const char *text) {
  size_t length = strlen(text);
  assert_true(page->length + length < sizeof page->text);
  memcpy(page->text + page->length, text, length + 1);
  page->length += length;
}

static void open_page(struct page *page) {
  page->length = 0;
  page->contact = -1;
  page->given = NULL;
  page->removed = (struct judge_removed){.planes = 0};
  write_text(page, "<?xml version=\"1.0\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\""
                   " height=\"100mm\" viewBox=\"0 0 100 100\">\n"
                   "<g inkscape:label=\"1 visible\" fill=\"none\""
                   " stroke=\"#000\">\n");
}

/* The image of a point, in the design's own words: one at camera coordinates
 * (x, y, -d) falls on W/2 + s x/d, H/2 + s y/d. */
static struct judge_point2 image_of(const struct page *page, struct vector p) {
  const double *m = page->camera.matrix;
  struct judge_point3 eye = page->camera.eye;
  double x = p.x - eye.x, y = p.y - eye.y, z = p.z - eye.z;
  double d = m[8] * x + m[9] * y + m[10] * z + m[11];
  return (struct judge_point2){(m[0] * x + m[1] * y + m[2] * z + m[3]) / d,
                               (m[4] * x + m[5] * y + m[6] * z + m[7]) / d};
}

/* Draws a straight line between the images of two points. */
static void draw_line(struct page *page, struct vector a, struct vector b) {
  const struct judge_point2 at[2] = {image_of(page, a), image_of(page, b)};
  char line[120];
  snprintf(line, sizeof line, "<path d=\"M%.3f %.3fL%.3f %.3f\"/>\n", at[0].x,
           100 - at[0].y, at[1].x, 100 - at[1].y);
  write_text(page, line);
}

static struct judge_verdict
judge_page(struct page *page, const struct scene *scene, unsigned edges) {
  struct judge_drawing drawing;
  struct judge_verdict verdict;
  struct judge_options options;
  judge_options_init(&options);
  options.edges = edges;
  options.contact = page->contact;
  options.given = page->given;
  options.removed = page->removed;
  write_text(page, "</g>\n</svg>\n");
  assert_null(judge_read_svg(&drawing, page->text, page->length));
  assert_true(
      judge_drawing(&verdict, &drawing, scene, &page->camera, &options));
  judge_drawing_fini(&drawing);
  return verdict;
}

static void look_from(struct page *page, double x, double y, double z) {
  judge_camera_look(&page->camera, judge_point3_of(x, y, z),
                    judge_point3_of(0, 0, 0), judge_point3_of(0, 0, 1), 30, 100,
                    100, 0);
}

/* ---- A cube -------------------------------------------------------------- */

static struct vector corner_of(unsigned i) {
  return vector_of(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
}

/* Whether an edge of the cube is seen from (x, y, z), all beyond 1: it is
 * unless it lies on the far side in both of its fixed coordinates. */
static bool is_seen(unsigned a, unsigned b) { return (a & b) != 0; }

/* Draws the cube's edges for which wanted(number, seen) holds. */
static void draw_cube(struct page *page, bool (*wanted)(unsigned, bool)) {
  unsigned number = 0;
  for (unsigned a = 0; a < 8; a++)
    for (unsigned axis = 1; axis <= 4; axis *= 2)
      if (!(a & axis)) {
        if (wanted(number, is_seen(a, a | axis)))
          draw_line(page, corner_of(a), corner_of(a | axis));
        number++;
      }
}

static bool want_seen(unsigned number, bool seen) {
  (void)number;
  return seen;
}
static bool want_all(unsigned number, bool seen) {
  (void)number;
  (void)seen;
  return true;
}
static unsigned left_out;
static bool want_all_but_one(unsigned number, bool seen) {
  return seen && number != left_out;
}
static unsigned put_in;
static bool want_one_more(unsigned number, bool seen) {
  return seen || number == put_in;
}

static void fill_cube(struct scene *scene) {
  scene_init(scene);
  build_box(scene, vector_of(-1, -1, -1), vector_of(1, 1, 1));
}

static struct judge_verdict judge_cube(bool (*wanted)(unsigned, bool)) {
  struct page page;
  struct scene scene;
  fill_cube(&scene);
  open_page(&page);
  look_from(&page, 5, 6, 4);
  draw_cube(&page, wanted);
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  scene_fini(&scene);
  return verdict;
}

static void a_right_drawing_of_a_cube_is_accepted(void **state) {
  (void)state;
  struct judge_verdict verdict = judge_cube(want_seen);
  assert_true(verdict.drawn.samples > 1000);
  assert_true(verdict.visible.samples > 1000);
  assert_int_equal(verdict.false_ink.samples, 0);
  assert_int_equal(verdict.missing.samples, 0);
}

static void any_hidden_edge_drawn_is_false_ink(void **state) {
  (void)state;
  unsigned hidden = 0;
  for (put_in = 0; put_in < 12; put_in++) {
    struct judge_verdict verdict = judge_cube(want_one_more);
    hidden += verdict.false_ink.samples > 0;
    assert_int_equal(verdict.missing.samples, 0);
  }
  assert_int_equal(hidden, 3);
  struct judge_verdict verdict = judge_cube(want_all);
  assert_true(verdict.false_ink.samples > 500);
}

static void any_visible_edge_left_out_is_missing_ink(void **state) {
  (void)state;
  unsigned seen = 0;
  for (left_out = 0; left_out < 12; left_out++) {
    struct judge_verdict verdict = judge_cube(want_all_but_one);
    seen += verdict.missing.samples > 0;
    assert_int_equal(verdict.false_ink.samples, 0);
  }
  assert_int_equal(seen, 9);
}

static void ink_where_no_edge_is_is_false(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  fill_cube(&scene);
  open_page(&page);
  look_from(&page, 5, 6, 4);
  draw_cube(&page, want_seen);
  draw_line(&page, vector_of(1, -0.5, -0.5), vector_of(1, 0.5, 0.5));
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  assert_true(verdict.false_ink.samples > 100);
  assert_int_equal(verdict.missing.samples, 0);
  scene_fini(&scene);
}

static void half_an_edge_is_half_missing(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  fill_cube(&scene);
  open_page(&page);
  look_from(&page, 5, 6, 4);
  left_out = 11; /* from corner 6 to corner 7 */
  draw_cube(&page, want_all_but_one);
  draw_line(&page, corner_of(6), vector_of(0, 1, 1));
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  /* The half that is missing, by the judge's own sampling. */
  struct judge_point2 a = image_of(&page, vector_of(0, 1, 1)),
                      b = image_of(&page, vector_of(1, 1, 1));
  double missing_mm = 0.02 * (double)verdict.missing.samples;
  assert_int_equal(verdict.false_ink.samples, 0);
  assert_true(fabs(missing_mm - hypot(b.x - a.x, b.y - a.y)) < 0.1);
  scene_fini(&scene);
}

/* The progress a caller is given, and after how many calls it cancels. */
struct caller {
  unsigned polled, most;
  double share;
};

static bool hear(void *user, double share, const char *stage) {
  (void)stage;
  struct caller *caller = user;
  assert_true(share >= caller->share && share <= 1);
  caller->share = share;
  return ++caller->polled < caller->most;
}

static void progress_reaches_the_caller_who_may_cancel(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  struct judge_drawing drawing;
  fill_cube(&scene);
  open_page(&page);
  look_from(&page, 5, 6, 4);
  draw_cube(&page, want_seen);
  write_text(&page, "</g>\n</svg>\n");
  assert_null(judge_read_svg(&drawing, page.text, page.length));
  for (unsigned most = 2; most < 1000; most += 996) {
    struct caller caller = {.most = most};
    struct judge_options options;
    struct judge_verdict verdict;
    judge_options_init(&options);
    options.step_mm = 0.01;
    struct polled polled;
    polled_begin(&polled, hear, &caller);
    assert_int_equal(
        judge_drawing(&verdict, &drawing, &scene, &page.camera, &options),
        most != 2);
    polled_end(&polled);
    if (most == 2)
      assert_int_equal(caller.polled, 2);
    else
      assert_true(caller.polled > 100 && caller.share > 0.9);
  }
  judge_drawing_fini(&drawing);
  scene_fini(&scene);
}

static void a_matrix_says_the_same_as_a_camera(void **state) {
  (void)state;
  struct page page;
  struct judge_camera again;
  double matrix[12];
  look_from(&page, 5, 6, 4);
  for (int i = 0; i < 12; i++) {
    const double *row = page.camera.matrix + i - i % 4;
    matrix[i] = i % 4 < 3 ? 3 * row[i % 4]
                          : -3 * (row[0] * 5 + row[1] * 6 + row[2] * 4);
  }
  judge_camera_matrix(&again, matrix, 100, 100);
  assert_true(again.perspective);
  assert_true(fabs(again.eye.x - 5) < 1e-9);
  assert_true(fabs(again.eye.y - 6) < 1e-9);
  assert_true(fabs(again.eye.z - 4) < 1e-9);
}

/* ---- Other scenes -------------------------------------------------------- */

static void look_square_on(struct page *page) {
  /* Page mm = 50 + 10 x, 50 + 10 y, seen along -z. */
  static const double matrix[12] = {10, 0, 0, 50, 0, 10, 0, 50, 0, 0, 0, 1};
  judge_camera_matrix(&page->camera, matrix, 100, 100);
  assert_false(page->camera.perspective);
  assert_true(page->camera.back.z == 1);
}

static void draw_loop(struct page *page, const double *xyz, unsigned count) {
  for (unsigned i = 0; i < count; i++) {
    const double *a = xyz + 3 * i, *b = xyz + 3 * ((i + 1) % count);
    draw_line(page, vector_of(a[0], a[1], a[2]), vector_of(b[0], b[1], b[2]));
  }
}

static const double notched[8 * 3] = {-3, -3, 1, 3,  -3, 1, 3,  3, 1, 1,  3, 1,
                                      1,  -1, 1, -1, -1, 1, -1, 3, 1, -3, 3, 1};

static void what_lies_in_a_notch_is_visible(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  build_polygon(&scene, notched, 8);
  build_segment(&scene, build_point(&scene, -0.5, 1, 0),
                build_point(&scene, 0.5, 1, 0));
  build_segment(&scene, build_point(&scene, -2, -2, 0),
                build_point(&scene, 2, -2, 0));
  for (unsigned hidden_too = 0; hidden_too < 2; hidden_too++) {
    open_page(&page);
    look_square_on(&page);
    draw_loop(&page, notched, 8);
    draw_line(&page, vector_of(-0.5, 1, 0), vector_of(0.5, 1, 0));
    if (hidden_too)
      draw_line(&page, vector_of(-2, -2, 0), vector_of(2, -2, 0));
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.missing.samples, 0);
    assert_int_equal(verdict.false_ink.samples > 0, hidden_too);
  }
  scene_fini(&scene);
}

static void a_spike_covers_nothing(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  /* Out from a corner of the square, and back to it. */
  uint32_t corner[6] = {0, 1, 4, 1, 2, 3};
  build_point(&scene, -2, -2, 1);
  build_point(&scene, 0, -2, 1);
  build_point(&scene, 0, 0, 1);
  build_point(&scene, -2, 0, 1);
  build_point(&scene, 3, 3, 1);
  build_face(&scene, corner, 6);
  build_segment(&scene, build_point(&scene, 0.5, -1, 0),
                build_point(&scene, 3, 1, 0));
  static const double square[12] = {-2, -2, 1, 0, -2, 1, 0, 0, 1, -2, 0, 1};
  open_page(&page);
  look_square_on(&page);
  draw_loop(&page, square, 4);
  draw_line(&page, vector_of(0.5, -1, 0), vector_of(3, 1, 0));
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  assert_int_equal(verdict.false_ink.samples, 0);
  assert_int_equal(verdict.missing.samples, 0);
  scene_fini(&scene);
}

static void lines_where_faces_pierce_are_required(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  static const double flat[12] = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
  build_polygon(&scene, flat, 4);
  /* Through it along x = 0, from y = -2 to 2; its right half is behind. */
  static const double tilted[12] = {-1, -2, 1, 1, -2, -1, 1, 2, -1, -1, 2, 1};
  build_polygon(&scene, tilted, 4);
  for (unsigned with_line = 0; with_line < 2; with_line++) {
    open_page(&page);
    look_square_on(&page);
    draw_loop(&page, flat, 4);
    draw_line(&page, vector_of(-1, 2, 1), vector_of(-1, -2, 1));
    draw_line(&page, vector_of(-1, 2, 1), vector_of(0, 2, 0));
    draw_line(&page, vector_of(-1, -2, 1), vector_of(0, -2, 0));
    if (with_line)
      draw_line(&page, vector_of(0, -2, 0), vector_of(0, 2, 0));
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.false_ink.samples, 0);
    assert_int_equal(verdict.missing.samples == 0, with_line);
  }
  scene_fini(&scene);
}

/* Seen from above, half of the second face is behind the first. */
static void lines_in_a_shared_diagonal_are_required(void **state) {
  (void)state;
  for (int with_line = 0; with_line < 2; with_line++) {
    struct page page;
    struct scene scene;
    scene_init(&scene);
    static const double chevron[12] = {-1, 2, 0, 0, 0, 0, -1, -2, 0, 3, 0, 0};
    build_polygon(&scene, chevron, 4);
    uint32_t above = build_point(&scene, 0.5, 0.5, 2);
    build_quad(&scene, above, 1, build_point(&scene, 0.5, -0.5, -2), 3);
    open_page(&page);
    look_square_on(&page);
    draw_loop(&page, chevron, 4);
    draw_line(&page, vector_of(0, 0, 0), vector_of(0.5, 0.5, 2));
    draw_line(&page, vector_of(3, 0, 0), vector_of(0.5, 0.5, 2));
    if (with_line)
      draw_line(&page, vector_of(0, 0, 0), vector_of(3, 0, 0));
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.false_ink.samples, 0);
    assert_int_equal(verdict.missing.samples == 0, with_line);
    scene_fini(&scene);
  }
}

static void contact_does_not_hide(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  /* A wire below a plate by a third of the contact tolerance, and a wire
   * below it by a hundred times as much. */
  static const double plate[12] = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
  build_polygon(&scene, plate, 4);
  double touching = -8.5e-6 / 3;
  build_segment(&scene, build_point(&scene, -2, -1, touching),
                build_point(&scene, 2, -1, touching));
  build_segment(&scene, build_point(&scene, -2, 1, -1e-3),
                build_point(&scene, 2, 1, -1e-3));
  open_page(&page);
  page.contact = 8.5e-6;
  look_square_on(&page);
  draw_loop(&page, plate, 4);
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  assert_int_equal(verdict.false_ink.samples, 0);
  assert_in_range(verdict.missing.samples, 1900, 2100);
  assert_true(fabs(verdict.missing_at.at.y - 40) < 0.01);
  scene_fini(&scene);
}

/* A wire from a triangle's corner runs behind it, to a depth; drawn is a share
 * of it. */
static struct judge_verdict judge_wire(double depth, double share) {
  struct page page;
  struct scene scene;
  scene_init(&scene);
  static const double triangle[9] = {-3, -3, 0, 3, -3, 0, 0, 3, 0};
  build_polygon(&scene, triangle, 3);
  build_segment(&scene, 0, build_point(&scene, 0, 0, -depth));
  open_page(&page);
  page.contact = 0.05;
  look_square_on(&page);
  draw_loop(&page, triangle, 3);
  if (share > 0)
    draw_line(&page, vector_of(-3, -3, 0),
              vector_of(3 * share - 3, 3 * share - 3, -depth * share));
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  scene_fini(&scene);
  return verdict;
}

static void from_a_corner_contact_counts_at_the_far_end(void **state) {
  (void)state;
  struct judge_verdict verdict = judge_wire(0.2, 0);
  assert_int_equal(verdict.missing.samples, 0);
  assert_int_equal(verdict.undecided.samples, 0);
  assert_in_range(verdict.hidden.samples, 2000, 2200);
  verdict = judge_wire(0.2, 0.1);
  assert_in_range(verdict.false_ink.samples, 200, 220);
  verdict = judge_wire(0.01, 1);
  assert_int_equal(verdict.false_ink.samples, 0);
  verdict = judge_wire(0.01, 0.5);
  assert_in_range(verdict.missing.samples, 1000, 1100);
}

/* Two plates, of which one is turned about the middle by so little that only
 * the page's grid says where they pierce each other, or whether.  A wire behind
 * them crosses these lines and makes no difference, unless it is drawn. */
static void without_contact_the_grid_may_pierce_what_touches(void **state) {
  (void)state;
  for (int deep = 0; deep < 2; deep++) {
    double tilt = deep ? 1e-2 : 1e-7;
    struct page page;
    struct scene scene;
    struct judge_verdict verdict;
    scene_init(&scene);
    static const double flat[12] = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
    build_polygon(&scene, flat, 4);
    const double tilted[12] = {-1, -2, tilt,  1,  -2, -tilt,
                               1,  2,  -tilt, -1, 2,  tilt};
    build_polygon(&scene, tilted, 4);
    const struct vector wire[2] = {{0.34, -2, -1}, {0.66, 2, -1}};
    build_segment(&scene, build_vector(&scene, wire[0]),
                  build_vector(&scene, wire[1]));
    for (int drawn = 0; drawn < 4; drawn++) {
      open_page(&page);
      page.contact = 0;
      look_square_on(&page);
      draw_loop(&page, flat, 4);
      draw_loop(&page, tilted, 4);
      if (drawn == 1 || drawn == 2) /* where they cross; where they do not */
        draw_line(&page, vector_of(0.5 * (drawn - 1), -2, 0),
                  vector_of(0.5 * (drawn - 1), 2, 0));
      if (drawn == 3)
        draw_line(&page, wire[0], wire[1]);
      verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
      assert_int_equal(verdict.missing.samples > 0, deep && drawn != 1);
      assert_int_equal(verdict.false_ink.samples > 0, deep || drawn == 3);
    }
    scene_fini(&scene);
  }
}

/* A quadrilateral of two triangles that is planar within a tenth of a unit.
 * Where one is in front of the other one's side it is two thirds of a unit
 * nearer. */
static void a_face_planar_within_contact_hides_none_of_its_edges(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  static const double quad[12] = {0, 0, -8, 0.1, 0, 2, 0, 1, 3, 0.1, 1.5, 2};
  scene_init(&scene);
  build_polygon(&scene, quad, 4);
  for (int contact = 0; contact < 2; contact++) {
    open_page(&page);
    page.contact = contact ? 0.25 : 0.01;
    look_square_on(&page);
    draw_loop(&page, quad, 4);
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.false_ink.samples > 0, !contact);
  }
  scene_fini(&scene);
}

/* A rectangle 1e-17 wide, with another one behind it that faces away: four
 * edges, of which two pairs coincide once the scene is translated. */
static void edges_that_translation_joins_are_distinct(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  struct scene_point given[8];
  scene_init(&scene);
  static const double front[12] = {0,      -3, 0, 0,      3,  0,
                                   -1e-17, 3,  0, -1e-17, -3, 0};
  static const double back[12] = {0,      3,  0, 0,      -3, 0,
                                  -1e-17, -3, 0, -1e-17, 3,  0};
  build_polygon(&scene, front, 4);
  build_polygon(&scene, back, 4);
  assert_int_equal(scene.point.count, 8);
  for (int i = 0; i < 8; i++) {
    given[i] = scene.point.item[i];
    scene.point.item[i].x += 1;
  }
  for (int translated = 0; translated < 2; translated++) {
    open_page(&page);
    page.given = translated ? given : NULL;
    look_square_on(&page);
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.missing.samples > 0, !translated);
  }
  scene_fini(&scene);
}

/* Just in front of the eye's plane a wire ends, far beside the eye. */
static void an_image_of_any_length_is_accurate_on_the_page(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  build_segment(&scene, build_point(&scene, 5, 1e3, 333),
                build_point(&scene, 1, 0, 0.1));
  open_page(&page);
  look_from(&page, 5, 0, 0);
  const double share = 1e-3;
  draw_line(&page, vector_of(1, 0, 0.1),
            vector_of(1 + 4 * share, 1e3 * share, 0.1 + 332.9 * share));
  struct judge_verdict verdict = judge_page(&page, &scene, RECTO_EDGES_DEFAULT);
  assert_true(verdict.drawn.samples > 1000);
  assert_int_equal(verdict.false_ink.samples, 0);
  scene_fini(&scene);
}

static double area_of(const struct scene *scene, const uint32_t *corner,
                      const uint32_t *number, uint32_t count) {
  double area = 0;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t a = number != NULL ? number[i] : i;
    uint32_t b = number != NULL ? number[(i + 1) % count] : (i + 1) % count;
    const struct scene_point *p = &scene->point.item[corner[a]];
    const struct scene_point *q = &scene->point.item[corner[b]];
    area += (p->x * q->y - q->x * p->y) / 2;
  }
  return area;
}

/* Points and notches of all sizes: as many triangles as there must be, none of
 * them turned round, and of the same area. */
static void ears_cover_a_face_of_any_number_of_corners(void **state) {
  (void)state;
  enum { MOST = 2000 };
  struct judge_ears ears = {0};
  for (uint32_t count = 3; count <= MOST; count = count * 3 / 2) {
    struct scene scene;
    uint32_t corner[MOST], random = count;
    scene_init(&scene);
    for (uint32_t i = 0; i < count; i++) {
      double angle = 2 * acos(-1) * i / count;
      random = random * 1664525 + 1013904223;
      double radius = 1 + (random >> 16) / 65536.0 * (i % 3);
      corner[i] =
          build_point(&scene, radius * cos(angle), radius * sin(angle), 0);
    }
    assert_true(judge_clip_ears(&ears, &scene, corner, count));
    assert_int_equal(ears.ear.count, count - 2);
    double sum = 0;
    for (size_t i = 0; i < ears.ear.count; i++) {
      double area = area_of(&scene, corner, ears.ear.item[i].corner, 3);
      assert_true(area > 0);
      sum += area;
    }
    assert_true(fabs(sum - area_of(&scene, corner, NULL, count)) < 1e-9);
    scene_fini(&scene);
  }
  judge_ears_fini(&ears);
}

static void smooth_edges_are_requested_only_by_all(void **state) {
  (void)state;
  struct page page;
  struct scene scene;
  scene_init(&scene);
  uint32_t first = build_point(&scene, -3, -3, 0);
  build_point(&scene, 3, -3, 0);
  build_point(&scene, 3, 3, 0);
  build_point(&scene, -3, 3, 0);
  build_triangle(&scene, first, first + 1, first + 2);
  build_triangle(&scene, first, first + 2, first + 3);
  static const double square[12] = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
  for (unsigned all = 0; all < 2; all++) {
    open_page(&page);
    look_square_on(&page);
    draw_loop(&page, square, 4);
    struct judge_verdict verdict =
        judge_page(&page, &scene, all ? RECTO_EDGES_ALL : RECTO_EDGES_DEFAULT);
    assert_int_equal(verdict.missing.samples > 0, all);
    assert_int_equal(verdict.false_ink.samples, 0);
  }
  scene_fini(&scene);
}

/* ---- The reader ---------------------------------------------------------- */

static const char *read_text(struct judge_drawing *drawing, const char *text) {
  return judge_read_svg(drawing, text, strlen(text));
}

#define ROOT "<svg width=\"20mm\" height=\"10mm\" viewBox=\"0 0 20 10\">"

#define PEN "<g fill=\"none\" stroke=\"#000\">"

static void paths_and_polylines_are_read(void **state) {
  (void)state;
  struct judge_drawing drawing;
  assert_null(read_text(
      &drawing,
      "<?xml version=\"1.0\"?><!-- <g> --><!DOCTYPE svg [<!ENTITY a "
      "\">\">]>" ROOT "<g inkscape:label=\"1 visible\" stroke='#000'>"
      "<path d=\"M1 2L3 4.5L-.5 0Z\"/><path d=\"M1 1L2 2M3 3L4 4\"/></g>"
      "<g inkscape:label=\"2 hidden\" stroke=\"#000\">"
      "<polyline points=\"0,0 5,5\"/></g>"
      "<path fill=\"#808080\" d=\"M0 0L1 0L1 1Z\"/></svg>"));
  assert_true(drawing.width_mm == 20 && drawing.height_mm == 10);
  assert_int_equal(drawing.stroke.count, 4);
  assert_int_equal(drawing.stroke.item[0].count, 4);
  assert_int_equal(drawing.stroke.item[1].count, 2);
  assert_int_equal(drawing.stroke.item[2].role, JUDGE_INK);
  assert_int_equal(drawing.stroke.item[3].role, JUDGE_HIDDEN);
  assert_true(drawing.point.item[1].x == 3);
  assert_true(drawing.point.item[1].y == 5.5);
  assert_true(drawing.point.item[2].x == -0.5);
  assert_true(drawing.point.item[3].x == 1);
  judge_drawing_fini(&drawing);
}

/* By its class, or by a layer's name that says no more; what has the class of a
 * visible line is one, whatever the user calls his groups. */
static void a_group_called_hidden_is_none_of_hidden_lines(void **state) {
  (void)state;
  static const struct {
    const char *label, *words;
    enum judge_role role;
  } row[] = {{"2 hidden", "", JUDGE_HIDDEN},
             {"hidden", "", JUDGE_HIDDEN},
             {"2 other", " class=\"hidden\"", JUDGE_HIDDEN},
             {"2 other", " class=\"thin hidden\"", JUDGE_HIDDEN},
             {"2 hidden", " class=\"crease\"", JUDGE_INK},
             {"2 crease, hidden", " class=\"crease\"", JUDGE_INK},
             {"2 hidden door", "", JUDGE_INK},
             {"2 unhidden", "", JUDGE_INK},
             {"2 wall", " class=\"hiddenwall\"", JUDGE_INK}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct judge_drawing drawing;
    char text[400];
    snprintf(text, sizeof text,
             ROOT "<g inkscape:label=\"%s\" stroke=\"#000\">"
                  "<g%s><path d=\"M0 0L1 1\"/></g></g></svg>",
             row[i].label, row[i].words);
    assert_null(read_text(&drawing, text));
    assert_int_equal(drawing.stroke.count, 1);
    if (drawing.stroke.item[0].role != row[i].role)
      fail_msg("%s, %s", row[i].label, row[i].words);
    judge_drawing_fini(&drawing);
  }
}

static void hatching_and_seams_are_no_lines_of_the_scene(void **state) {
  (void)state;
  struct judge_drawing drawing;
  assert_null(read_text(&drawing,
                        ROOT PEN "<g class=\"seam\"><path d=\"M0 0L1 1\"/></g>"
                                 "<g class=\"hatch\"><path d=\"M0 0L1 1\"/></g>"
                                 "<g class=\"wire\"><path d=\"M1 1L2 2\"/></g>"
                                 "</g></svg>"));
  assert_int_equal(drawing.stroke.count, 1);
  assert_true(drawing.point.item[0].x == 1);
  judge_drawing_fini(&drawing);
}

/* The points of the one stroke of a text, pairs x, y, y down as in the file. */
static void assert_points(const char *text, const double *xy, uint32_t count) {
  struct judge_drawing drawing;
  const char *fault = read_text(&drawing, text);
  if (fault != NULL)
    fail_msg("%s: %s", text, fault);
  if (drawing.stroke.count != 1 || drawing.stroke.item[0].count != count)
    fail_msg("%s: %lu strokes", text, (unsigned long)drawing.stroke.count);
  for (uint32_t i = 0; i < count; i++) {
    struct judge_point2 p = drawing.point.item[i];
    if (fabs(p.x - xy[2 * i]) > 1e-12 ||
        fabs(drawing.height_mm - p.y - xy[2 * i + 1]) > 1e-12)
      fail_msg("%s: point %u is %g %g", text, i, p.x, drawing.height_mm - p.y);
  }
  judge_drawing_fini(&drawing);
}

static void every_way_to_write_a_line_is_read(void **state) {
  (void)state;
  static const double square[] = {1, 1, 3, 1, 3, 4, 1, 4, 1, 1};
  static const char *const way[] = {
      "<path d=\"M1 1 3 1 3 4 1 4Z\"/>",
      "<path d=\"m1,1l2,0 0,3-2,0z\"/>",
      "<path d=\"M1 1H3V4H1Z\"/>",
      "<path d=\"m1 1h2v3h-2v-3\"/>",
      "<path d=\"M1e0 10E-1L.3e+1 1.0 3,4 1 4z\"/>",
      "<path d=\"m.5.5m.5.5l2 0 0 3 -2 0 0 -3\"/>",
      "<polygon points=\"1,1 3,1 3,4 1,4\"/>",
      "<polyline points=\"1 1 3 1 3 4 1 4 1 1\"/>",
      "<rect x=\"1\" y=\"1\" width=\"2\" height=\"3\"/>",
      "<g transform=\"translate(1 1)\"><rect width=\"2\" height=\"3\"/></g>",
      "<g transform=\"translate(1)\"><g transform=\"translate(0,1) scale(2 "
      "3)\">"
      "<path d=\"M0 0L1 0L1 1L0 1Z\"/></g></g>",
  };
  for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
    char text[400];
    snprintf(text, sizeof text, ROOT PEN "%s</g></svg>", way[i]);
    assert_points(text, square, 5);
  }
}

static void pages_of_any_unit_are_read(void **state) {
  (void)state;
  static const double line[] = {1, 2, 5, 6};
  static const char *const way[] = {
      "<svg width=\"2cm\" height=\"1cm\" viewBox=\"0 0 20 10\">" PEN
      "<line x1=\"1\" y1=\"2\" x2=\"5\" y2=\"6\"/></g></svg>",
      "<svg width=\"20mm\" height=\"10mm\" viewBox=\"10 20 40 20\">" PEN
      "<line x1=\"12\" y1=\"24\" x2=\"20\" y2=\"32\"/></g></svg>",
      "<svg width=\"20mm\" height=\"30mm\" viewBox=\"0 -10 20 10\">" PEN
      "<line x1=\"1\" y1=\"-18\" x2=\"5\" y2=\"-14\"/></g></svg>",
      "<svg width=\"20mm\" height=\"30mm\" viewBox=\"0 0 10 10\""
      " preserveAspectRatio=\"none\">" PEN
      "<path d=\"M.5.66666666666666667L2.5 2\"/></g></svg>",
      "<svg width=\"96\" height=\"192px\"><g style=\"stroke : red;fill:none\""
      " transform=\"scale(3.7795275590551181)\"><path d=\"M1 2L5 "
      "6\"/></g></svg>",
  };
  for (size_t i = 0; i < sizeof way / sizeof *way; i++)
    assert_points(way[i], line, 2);
}

static void transforms_turn_and_skew(void **state) {
  (void)state;
  static const struct {
    const char *transform;
    double x, y; /* of 2, 1 */
  } of[] = {{"rotate(90)", -1, 2},
            {"rotate(90 1 1)", 1, 2},
            {"rotate(-90)", 1, -2},
            {"skewX(45)", 3, 1},
            {"skewY(45)", 2, 3},
            {"scale(3)", 6, 3},
            {"matrix(1 2 3 4 5 6)", 10, 14},
            {"translate(1,2)scale(2),rotate(180)", -3, 0}};
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    char text[300];
    const double line[] = {of[i].x, of[i].y, of[i].x, of[i].y};
    snprintf(text, sizeof text,
             ROOT PEN "<path transform=\"%s\" d=\"M2 1L2 1\"/></g></svg>",
             of[i].transform);
    assert_points(text, line, 2);
  }
}

/* The greatest distance of the points, and of the middles between them, from
 * the circle of radius 3 about 5, 5, whose arc they are. */
static double off_circle(const struct judge_drawing *drawing, double *length) {
  double off = 0;
  *length = 0;
  for (size_t i = 1; i < drawing->point.count; i++) {
    struct judge_point2 a = drawing->point.item[i - 1];
    struct judge_point2 b = drawing->point.item[i];
    off = fmax(off, fabs(hypot(a.x - 5, a.y - 5) - 3));
    off = fmax(off, fabs(hypot((a.x + b.x) / 2 - 5, (a.y + b.y) / 2 - 5) - 3));
    *length += hypot(b.x - a.x, b.y - a.y);
  }
  return off;
}

static void curves_are_followed(void **state) {
  (void)state;
  static const struct {
    const char *element;
    double turn; /* quarters of the circle */
  } of[] = {
      {"<circle cx=\"5\" cy=\"5\" r=\"3\"/>", 4},
      {"<ellipse cx=\"5\" cy=\"5\" rx=\"3\" ry=\"3\"/>", 4},
      {"<path d=\"M8 5A3 3 0 0 1 5 8\"/>", 1},
      {"<path d=\"M8 5a3 3 0 01-3 3\"/>", 1},
      {"<path d=\"M8 5A3 3 30 1 0 5 8\"/>", 3},
      {"<path d=\"M2 5A1 1 0 0 1 8 5\"/>", 2}, /* grown */
      {"<path d=\"M8 5C8 6.6568542 6.6568542 8 5 8S2 6.6568542 2 5\"/>", 2},
      {"<path d=\"M8 5c0 1.6568542-1.3431458 3-3 3s-3-1.3431458-3-3\"/>", 2}};
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    char text[300];
    struct judge_drawing drawing;
    double length;
    snprintf(text, sizeof text, ROOT PEN "%s</g></svg>", of[i].element);
    assert_null(read_text(&drawing, text));
    if (off_circle(&drawing, &length) > 0.002 ||
        fabs(length - of[i].turn * 1.5 * acos(-1)) > 0.005)
      fail_msg("%s: off by %g, %g long", text, off_circle(&drawing, &length),
               length);
    judge_drawing_fini(&drawing);
  }
  /* A parabola, and the same mirrored: y = x^2 / 4 about 4. */
  struct judge_drawing drawing;
  assert_null(read_text(&drawing,
                        ROOT PEN "<path d=\"M0 0Q2 0 4 4T8 16\"/></g></svg>"));
  for (size_t i = 0; i < drawing.point.count; i++) {
    struct judge_point2 p = drawing.point.item[i];
    double y = 10 - p.y;
    assert_true(p.x > 4 ? y >= 4 - 1e-12 : fabs(y - p.x * p.x / 4) < 1e-12);
  }
  judge_drawing_fini(&drawing);
}

static void what_is_not_stroked_is_no_ink(void **state) {
  (void)state;
  struct judge_drawing drawing;
  assert_null(read_text(
      &drawing, ROOT
      "<defs><g stroke=\"#000\"><path d=\"M1 1L2 2\"/></g></defs>"
      "<clipPath><rect stroke=\"#000\" width=\"1\" height=\"1\"/></clipPath>"
      "<path d=\"M1 1L2 2\"/><path stroke=\"none\" d=\"M1 1L2 2\"/>"
      "<g stroke=\"#000\"><path style=\"stroke:none\" d=\"M1 1L2 2\"/>"
      "<g display=\"none\"><path d=\"M1 1L2 2\"/></g>"
      "<path visibility=\"hidden\" d=\"M1 1L2 2\"/><text>M1</text></g>"
      "<g stroke=\"#000\"><path stroke-dasharray=\"1 1\" d=\"M1 1L2 2\"/>"
      "</g></svg>"));
  assert_int_equal(drawing.stroke.count, 1);
  assert_int_equal(drawing.stroke.item[0].role, JUDGE_HIDDEN);
  judge_drawing_fini(&drawing);
  /* With a style sheet, which is not read, what says nothing may be ink. */
  assert_null(read_text(&drawing,
                        ROOT "<style>path { stroke: red }</style>"
                             "<path d=\"M1 1L2 2\"/>"
                             "<path fill=\"red\" d=\"M1 1L2 2\"/></svg>"));
  assert_int_equal(drawing.stroke.count, 1);
  judge_drawing_fini(&drawing);
}

static void what_is_not_such_a_file_is_refused(void **state) {
  (void)state;
  static const char *const wrong[] = {
      "",
      "no tags",
      "<svg width=\"100%\" height=\"10\" viewBox=\"0 0 20 10\"></svg>",
      "<svg height=\"10mm\" viewBox=\"0 0 20 10\"></svg>",
      "<svg width=\"20mm\" height=\"10mm\" viewBox=\"0 0 20\"></svg>",
      "<svg width=\"20mm\" height=\"10mm\" viewBox=\"0 0 20 0\"></svg>",
      "<path d=\"M0 0\"/>" ROOT "</svg>",
      ROOT,
      ROOT PEN "</svg>",
      ROOT PEN "<path d=\"M0 0L1 1",
      ROOT "<!-- </svg>",
      ROOT "</svg></svg>",
      ROOT ROOT "</svg></svg>",
      ROOT PEN "<path d=\"M0 0C1 1 2 2 3\"/></g></svg>",
      ROOT PEN "<path d=\"M0 0A1 1 0 2 0 3 3\"/></g></svg>",
      ROOT PEN "<path d=\"M0 0Z1 1\"/></g></svg>",
      ROOT PEN "<path d=\"M0 0B1 1\"/></g></svg>",
      ROOT PEN "<path d=\"L1 1\"/></g></svg>",
      ROOT PEN "<path d=\"M1\"/></g></svg>",
      ROOT PEN "<path d=\"M1 x\"/></g></svg>",
      ROOT PEN "<path/></g></svg>",
      ROOT PEN "<polyline points=\"1,\"/></g></svg>",
      ROOT PEN "<polyline/></g></svg>",
      ROOT PEN "<use href=\"#a\"/></g></svg>",
      ROOT PEN "<path transform=\"turn(1)\" d=\"M1 1\"/></g></svg>",
      ROOT PEN "<path transform=\"scale(1 2 3)\" d=\"M1 1\"/></g></svg>",
      ROOT PEN "<path transform=\"scale(1\" d=\"M1 1\"/></g></svg>",
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    struct judge_drawing drawing;
    if (read_text(&drawing, wrong[i]) == NULL)
      fail_msg("was read: %s", wrong[i]);
    judge_drawing_fini(&drawing);
  }
}

/* Whatever bytes a file is cut to or has changed: it ends, and memory that
 * runs out is reported. */
static void any_bytes_and_no_memory_are_survived(void **state) {
  (void)state;
  static const char text[] = ROOT
      "<!-- c --><g transform=\"rotate(3 1 2) skewX(2)\" stroke=\"#000\">"
      "<path d=\"M1 2C3 4 5 6 7 8S1 1 2 2Q4 4 1 1T3 3A2 1 20 0 1 4 4Z\"/>"
      "<circle cx=\"5\" cy=\"5\" r=\"3\"/><polygon points=\"1,1 2,3 4,5\"/>"
      "</g></svg>";
  char copy[sizeof text];
  struct judge_drawing drawing;
  for (size_t cut = 0; cut < sizeof text - 1; cut++) {
    char *part = malloc(cut + 1); /* no more, for the checkers of memory */
    assert_non_null(part);
    memcpy(part, text, cut);
    assert_non_null(judge_read_svg(&drawing, part, cut));
    judge_drawing_fini(&drawing);
    free(part);
    for (int c = 1; c < 128; c += 3) {
      memcpy(copy, text, sizeof text);
      copy[cut] = (char)c;
      (void)judge_read_svg(&drawing, copy, sizeof text - 1);
      judge_drawing_fini(&drawing);
    }
  }
  struct memory_faults faults = {.least = 3};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    const char *fault = read_text(&drawing, text);
    memory_faults_end(&faults, memory_faults_status(fault == NULL));
    if (fault != NULL)
      assert_string_equal(fault, "memory ran out");
    judge_drawing_fini(&drawing);
  }
}

/* ---- The grid of segments ------------------------------------------------ */

/* Of two boxes, one above the other, a quarter is cut out.  Between them the
 * planes of the cut meet outside of the model. */
static void a_line_of_the_cut_beside_the_model_is_absent(void **state) {
  (void)state;
  for (int within = 0; within < 2; within++) {
    struct page page;
    struct scene scene;
    scene_init(&scene);
    build_box(&scene, vector_of(-1, -1, -2), vector_of(1, 1, -1));
    build_box(&scene, vector_of(-1, -1, 1), vector_of(1, 1, 2));
    look_from(&page, 9, 9, 1);
    open_page(&page);
    page.removed =
        (struct judge_removed){.plane = {{judge_point3_of(1, 0, 0), 0.25},
                                         {judge_point3_of(0, 1, 0), 0.25}},
                               .planes = 2};
    double z = within ? 1.25 : 0.25;
    draw_line(&page, vector_of(0.25, 0.25, z), vector_of(0.25, 0.25, z + 0.5));
    struct judge_verdict verdict =
        judge_page(&page, &scene, RECTO_EDGE_SECTION);
    if (within) {
      assert_int_equal(verdict.false_ink.samples, 0);
    } else {
      assert_true(verdict.false_ink.samples > 0);
      assert_true(verdict.false_at.on_edge && verdict.false_at.is_absent);
    }
    scene_fini(&scene);
  }
}

/* Whatever the reach, all segments within reach of a point are found
 * there, in a space that grows with the segments alone. */
static void a_wide_reach_takes_no_more_space(void **state) {
  enum { SEGMENTS = 300 };
  const double page = 100, reach[] = {0.01, 1, 30, 300, 1e9};
  struct judge_segment segment[SEGMENTS];
  (void)state;
  for (uint32_t i = 0; i < SEGMENTS; i++) {
    double x = i * 37 % 100, y = i * 61 % 100;
    segment[i] = (struct judge_segment){{x, y}, {x + 0.3, y + 0.2}};
  }
  for (size_t r = 0; r < sizeof reach / sizeof reach[0]; r++) {
    struct judge_grid grid;
    assert_true(judge_grid_init(&grid, segment, SEGMENTS, page, page,
                                page / 400, reach[r]));
    uint32_t cells = grid.columns * grid.rows;
    assert_true(grid.start[cells] <= 25 * SEGMENTS);
    for (uint32_t i = 0; i < SEGMENTS; i++) {
      struct judge_point2 at = {i * 17 % 101, i * 29 % 101};
      uint32_t count, within = 0, found = 0;
      double t;
      for (uint32_t k = 0; k < SEGMENTS; k++)
        within += judge_distance(&segment[k], at, &t) <= reach[r];
      const uint32_t *near = judge_grid_near(&grid, at, &count);
      for (uint32_t k = 0; k < count; k++)
        found += judge_distance(&segment[near[k]], at, &t) <= reach[r];
      assert_int_equal(found, within);
    }
    judge_grid_fini(&grid);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_right_drawing_of_a_cube_is_accepted),
      cmocka_unit_test(any_hidden_edge_drawn_is_false_ink),
      cmocka_unit_test(any_visible_edge_left_out_is_missing_ink),
      cmocka_unit_test(ink_where_no_edge_is_is_false),
      cmocka_unit_test(half_an_edge_is_half_missing),
      cmocka_unit_test(progress_reaches_the_caller_who_may_cancel),
      cmocka_unit_test(a_matrix_says_the_same_as_a_camera),
      cmocka_unit_test(what_lies_in_a_notch_is_visible),
      cmocka_unit_test(a_spike_covers_nothing),
      cmocka_unit_test(lines_where_faces_pierce_are_required),
      cmocka_unit_test(lines_in_a_shared_diagonal_are_required),
      cmocka_unit_test(contact_does_not_hide),
      cmocka_unit_test(from_a_corner_contact_counts_at_the_far_end),
      cmocka_unit_test(without_contact_the_grid_may_pierce_what_touches),
      cmocka_unit_test(a_face_planar_within_contact_hides_none_of_its_edges),
      cmocka_unit_test(edges_that_translation_joins_are_distinct),
      cmocka_unit_test(an_image_of_any_length_is_accurate_on_the_page),
      cmocka_unit_test(ears_cover_a_face_of_any_number_of_corners),
      cmocka_unit_test(smooth_edges_are_requested_only_by_all),
      cmocka_unit_test(paths_and_polylines_are_read),
      cmocka_unit_test(a_group_called_hidden_is_none_of_hidden_lines),
      cmocka_unit_test(hatching_and_seams_are_no_lines_of_the_scene),
      cmocka_unit_test(every_way_to_write_a_line_is_read),
      cmocka_unit_test(pages_of_any_unit_are_read),
      cmocka_unit_test(transforms_turn_and_skew),
      cmocka_unit_test(curves_are_followed),
      cmocka_unit_test(what_is_not_stroked_is_no_ink),
      cmocka_unit_test(any_bytes_and_no_memory_are_survived),
      cmocka_unit_test(what_is_not_such_a_file_is_refused),
      cmocka_unit_test(a_wide_reach_takes_no_more_space),
      cmocka_unit_test(a_line_of_the_cut_beside_the_model_is_absent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
