/* test_ink_tone_hatch.c - tone hatching: where lines are, how much they cover,
 * and that they continue from face to face. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "ink/hatch/hatch_runs.h"
#include "ink/tone.h"
#include "tests/ink_faults.h"
#include "tests/ink_fixture.h"
#include "tests/scenes/pipeline.h"

static double pi(void) { return acos(-1); }

/* ---- Runs ---------------------------------------------------------------- */

enum { INK, BLANK };

/* A piece of line 0.
 * tone_ends  which of its ends the tone determines: 1 its start, 2 its end */
static void add_piece(struct hatch_runs *runs, int kind, double u0, double u1,
                      int tone_ends) {
  struct hatch_piece piece = {.u0 = u0,
                              .u1 = u1,
                              .width_mm = 1,
                              .blank = kind == BLANK,
                              .tone_start = tone_ends & 1,
                              .tone_end = tone_ends & 2};
  assert_true(ARRAY_PUSH(&runs->piece, piece));
}

static struct hatch_runs start_runs(void) {
  return (struct hatch_runs){.max_gap = 0.1, .min_length = 2};
}

static void assert_run(struct hatch_runs *runs, double u0, double u1) {
  struct hatch_run run;
  assert_true(hatch_runs_next(runs, &run));
  assert_true(run.u0 == u0 && run.u1 == u1);
}

static void assert_no_run(struct hatch_runs *runs) {
  struct hatch_run run;
  assert_false(hatch_runs_next(runs, &run));
  ARRAY_FREE(&runs->piece);
}

static void pieces_that_meet_are_one_run(void **state) {
  struct hatch_runs runs = start_runs();
  (void)state;
  add_piece(&runs, INK, 5, 9, 0);
  add_piece(&runs, INK, 0, 3, 0);
  add_piece(&runs, INK, 3.05, 5, 0);
  add_piece(&runs, INK, 9.5, 12, 0);
  assert_true(hatch_runs_sort(&runs));
  assert_run(&runs, 0, 9);
  assert_run(&runs, 9.5, 12);
  assert_no_run(&runs);
}

static void pieces_of_different_lines_never_meet(void **state) {
  (void)state;
  for (int what = 0; what < 4; what++) {
    struct hatch_runs runs = start_runs();
    add_piece(&runs, INK, 0, 3, 0);
    add_piece(&runs, INK, 3, 6, 0);
    struct hatch_piece *piece = &runs.piece.item[1];
    piece->pen = what == 0;
    piece->direction = what == 1;
    piece->tone_steps = what == 2;
    piece->line = what == 3;
    assert_true(hatch_runs_sort(&runs));
    assert_run(&runs, 0, 3);
    assert_run(&runs, 3, 6);
    assert_no_run(&runs);
  }
}

static void short_runs_between_changes_of_tone_are_left_out(void **state) {
  struct hatch_runs runs = start_runs();
  (void)state;
  add_piece(&runs, INK, 0, 1, 3);   /* too short */
  add_piece(&runs, INK, 5, 6, 1);   /* at the face's end */
  add_piece(&runs, INK, 10, 13, 3); /* long enough */
  assert_true(hatch_runs_sort(&runs));
  assert_run(&runs, 5, 6);
  assert_run(&runs, 10, 13);
  assert_no_run(&runs);
}

static void short_gaps_in_a_face_are_closed(void **state) {
  struct hatch_runs runs = start_runs();
  (void)state;
  /* Over two faces. */
  add_piece(&runs, INK, 0, 3, 2);
  add_piece(&runs, BLANK, 3, 3.5, 1);
  add_piece(&runs, BLANK, 3.5, 4, 2);
  add_piece(&runs, INK, 4, 8, 1);
  /* Nothing is known about what lies between. */
  add_piece(&runs, INK, 9, 12, 1);
  /* Too long a gap. */
  add_piece(&runs, INK, 20, 23, 2);
  add_piece(&runs, BLANK, 23, 24.5, 1);
  add_piece(&runs, BLANK, 24.5, 26, 2);
  add_piece(&runs, INK, 26, 29, 1);
  assert_true(hatch_runs_sort(&runs));
  assert_run(&runs, 0, 8);
  assert_run(&runs, 9, 12);
  assert_run(&runs, 20, 23);
  assert_run(&runs, 26, 29);
  assert_no_run(&runs);
}

/* ---- Tones --------------------------------------------------------------- */

static const double square[] = {10, 10, 90, 10, 90, 90, 10, 90};
static const double facing[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

/* The share of ambient light in these tests, and the greatest tone. */
#define AMBIENT 0.3
#define GREATEST_TONE (1 - AMBIENT)

/* A single light, so that the tone is a plain function of the angle to it. */
static void light_alone(recto_options *options) {
  options->ink.has_ambient = options->ink.has_fill_light = true;
  options->ink.ambient = AMBIENT;
  options->ink.fill_light = 0;
}

/* A face seen square-on that the light leaves dark by so much. */
static void light_for_tone(recto_options *options, double tone) {
  double cosine = 1 - tone / GREATEST_TONE;
  light_alone(options);
  options->ink.fill = RECTO_FILL_HATCH;
  options->ink.light[0] = sqrt(1 - cosine * cosine);
  options->ink.light[2] = cosine;
}

static void draw_tone(struct ink_fixture *k, double tone) {
  ink_fixture_start(k);
  light_for_tone(&k->options, tone);
  ink_fixture_fragment(k, ink_fixture_face(k, 0, facing, 4),
                       INK_FIXTURE_XY(square));
  ink_fixture_draw(k);
}

static void one_even_face_is_hatched_at_one_pitch(void **state) {
  (void)state;
  struct ink_fixture k;
  draw_tone(&k, 0.1);
  double pitch = k.options.ink.pen_mm / (410.0 / TONE_STEPS), first = NAN;
  assert_in_range(k.drawing.stroke.count, 35, 39); /* 113 mm of diagonal */
  for (size_t s = 0; s < k.drawing.stroke.count; s++) {
    const struct drawing_point *p =
        k.drawing.point.item + k.drawing.stroke.item[s].point;
    double v = (p[0].y - p[0].x) / sqrt(2) / pitch;
    assert_int_equal(k.drawing.stroke.item[s].count, 2);
    first = s == 0 ? v : first;
    assert_true(fabs(v - first - (double)s) < 0.01);
  }
  ink_fixture_end(&k);
}

static void white_and_dark_are_hatched_by_no_and_three_layers(void **state) {
  struct ink_fixture k;
  (void)state;
  draw_tone(&k, 0);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
  draw_tone(&k, GREATEST_TONE);
  int layers[3] = {0, 0, 0};
  for (size_t s = 0; s < k.drawing.stroke.count; s++) {
    const struct drawing_point *p =
        k.drawing.point.item + k.drawing.stroke.item[s].point;
    double turn = atan2(p[1].y - p[0].y, p[1].x - p[0].x) * 180 / pi() - 45;
    int layer = (int)lround((turn + 360) / 60) % 3;
    assert_true(fabs(turn - 60 * round(turn / 60)) < 0.001);
    layers[layer]++;
  }
  for (int i = 0; i < 3; i++)
    assert_in_range(layers[i], i == 0 ? 136 : 118, i == 0 ? 139 : 122);
  ink_fixture_end(&k);
}

/* Ends of strokes stay inside the face by the pen's share of its cap. */
static void strokes_end_before_the_face_does(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  light_for_tone(&k.options, 0.2);
  k.options.ink.hatch_angle_deg = 0;
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, facing, 4),
                       INK_FIXTURE_XY(square));
  ink_fixture_draw(&k);
  double inset = pi() / 8 * k.options.ink.pen_mm;
  for (size_t s = 0; s < k.drawing.stroke.count; s++) {
    const struct drawing_point *p =
        k.drawing.point.item + k.drawing.stroke.item[s].point;
    assert_true(fabs(fmin(p[0].x, p[1].x) - 10 - inset) < 1e-9);
    assert_true(fabs(fmax(p[0].x, p[1].x) - 90 + inset) < 1e-9);
  }
  ink_fixture_end(&k);
}

static void neighbours_of_one_tone_share_their_lines(void **state) {
  const double left[] = {10, 10, 50, 10, 50, 50};
  const double right[] = {10, 10, 50, 50, 10, 50};
  struct ink_fixture k;
  (void)state;
  for (int ids = 0; ids < 2; ids++) {
    ink_fixture_start(&k);
    light_for_tone(&k.options, 0.2);
    k.options.ink.hatch_angle_deg = 0;
    k.options.ink.ids = ids;
    ink_fixture_fragment(&k, ink_fixture_face(&k, 0, facing, 4),
                         INK_FIXTURE_XY(left));
    ink_fixture_fragment(&k, ink_fixture_face(&k, 0, facing, 4),
                         INK_FIXTURE_XY(right));
    ink_fixture_draw(&k);
    size_t lines = 0, inside = 0;
    for (size_t s = 0; s < k.drawing.stroke.count; s++) {
      double length = ink_fixture_stroke_length(&k, s);
      lines += length > 39;
      inside += length < 39;
    }
    /* 40 mm, 1.5 mm apart. */
    assert_in_range(lines, ids ? 0 : 26, ids ? 0 : 27);
    assert_in_range(inside, ids ? 52 : 0, ids ? 54 : 0);
    ink_fixture_end(&k);
  }
}

static void each_pen_hatches_its_groups(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  light_for_tone(&k.options, 0.2);
  k.options.ink.pens = 2;
  ink_fixture_group(&k, "other");
  ink_fixture_fragment(&k, ink_fixture_face(&k, 0, facing, 4),
                       INK_FIXTURE_XY(square));
  ink_fixture_fragment(&k, ink_fixture_face(&k, 1, facing, 4),
                       INK_FIXTURE_XY(square));
  ink_fixture_draw(&k);
  size_t half = k.drawing.stroke.count / 2;
  assert_int_equal(k.drawing.layer.count, 2);
  for (size_t s = 0; s < 2 * half; s++) {
    assert_int_equal(k.drawing.stroke.item[s].layer, s >= half);
    assert_int_equal(k.drawing.stroke.item[s].group, s >= half);
  }
  ink_fixture_end(&k);
}

/* ---- Curved -------------------------------------------------------------- */

/* A ball of radius 1 in n rings of 2 n quadrangles. */
static void build_ball(struct scene *scene, unsigned n) {
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned j = 0; j <= n; j++)
    for (unsigned i = 0; i < 2 * n; i++) {
      double polar = pi() * j / n, around = pi() * i / n;
      build_point(scene, sin(polar) * cos(around), sin(polar) * sin(around),
                  cos(polar));
    }
  for (unsigned j = 0; j < n; j++)
    for (unsigned i = 0; i < 2 * n; i++) {
      uint32_t a = first + j * 2 * n, k = (i + 1) % (2 * n);
      if (j == 0)
        build_triangle(scene, first, a + 2 * n + i, a + 2 * n + k);
      else if (j + 1 == n)
        build_triangle(scene, a + i, first + n * 2 * n, a + k);
      else
        build_quad(scene, a + i, a + 2 * n + i, a + 2 * n + k, a + k);
    }
}

/* Draws a ball of 80 mm on a page of 100 mm, nothing but its hatching. */
static void draw_ball(struct pipeline *p, unsigned n, recto_options *options) {
  struct scene scene;
  scene_init(&scene);
  build_group(&scene, "ball");
  build_ball(&scene, n);
  options->page.width_mm = options->page.height_mm = 100;
  options->camera.azimuth_deg = options->camera.elevation_deg = 0;
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = 40;
  options->ink.edges = RECTO_EDGES_NONE;
  options->ink.fill = RECTO_FILL_HATCH;
  options->camera.up[1] = 1;
  pipeline_run(p, &scene, options, &solver_tiles);
  assert_int_equal(p->status, RECTO_OK);
  scene_fini(&scene);
}

enum { STRIPS = 6 }; /* 15 degrees each */

/* A flat square to the eye, of two triangles, `width` wide and 2 high, which
 * goes over into a fillet of quadrangles on its right. */
static void build_filleted_flat(struct scene *scene, double width) {
  const double radius = 0.3;
  for (int top = 0; top < 2; top++) {
    build_point(scene, -width, 2 * top - 1, 0);
    for (int i = 0; i <= STRIPS; i++) {
      double angle = pi() / 2 * i / STRIPS;
      build_point(scene, radius * sin(angle), 2 * top - 1,
                  radius * (cos(angle) - 1));
    }
  }
  const uint32_t up = STRIPS + 2;
  build_triangle(scene, 0, 1, up);
  build_triangle(scene, 1, up + 1, up);
  for (uint32_t i = 1; i <= STRIPS; i++)
    build_quad(scene, i, i + 1, up + i + 1, up + i);
}

/* The tones of a flat so many strips wide and its fillet. */
static void find_tones(struct tones *tones, struct scene *scene,
                       double strips) {
  struct pipeline p;
  recto_options options;
  recto_options_init(&options);
  scene_init(scene);
  build_group(scene, "part");
  build_filleted_flat(scene, strips * 0.6 * sin(pi() / 4 / STRIPS));
  options.page.width_mm = options.page.height_mm = 100;
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.camera.up[1] = 1;
  options.ink.fill = RECTO_FILL_HATCH;
  light_for_tone(&options, 0.2);
  pipeline_run(&p, scene, &options, &solver_tiles);
  assert_int_equal(p.status, RECTO_OK);
  assert_true(tones_init(tones, &p.sheet, scene, &options));
  pipeline_fini(&p);
}

static void flats_beside_fillets_have_one_tone(void **state) {
  struct scene scene;
  struct tones tones;
  (void)state;
  find_tones(&tones, &scene, 4);
  for (uint32_t f = 0; f < 2 + STRIPS; f++) {
    struct tone tone = tones_of_face(&tones, f);
    assert_int_equal(tone.uniform, f < 2);
    assert_true(f >= 2 || fabs(tone.max - 0.2) < 1.0 / TONE_STEPS);
  }
  /* The fillet begins with it; its corners 0 and 3 are the flat's. */
  const float *corner = tones.corner + scene_face_start(&scene, 2);
  assert_true(fabs(corner[0] - 0.2) < 1e-6 && fabs(corner[3] - 0.2) < 1e-6);
  assert_true(fabs(corner[1] - 0.2) > 0.01);
  tones_fini(&tones);
  scene_fini(&scene);
}

/* What is as wide as the strips beside it is a strip of a curved surface. */
static void facets_are_no_flats(void **state) {
  struct scene scene;
  struct tones tones;
  (void)state;
  find_tones(&tones, &scene, 1);
  for (uint32_t f = 0; f < 2 + STRIPS; f++)
    assert_false(tones_of_face(&tones, f).uniform);
  tones_fini(&tones);
  scene_fini(&scene);
}

static double length_of(const struct drawing *d, size_t s) {
  const struct drawing_point *p = d->point.item + d->stroke.item[s].point;
  return hypot(p[1].x - p[0].x, p[1].y - p[0].y);
}

/* Lit from the eye the ball's tone is 0.7 (1 - sqrt(1 - r^2)) at radius r: 0.7
 * thirds of its disc.  Where it is below the full coverage of a direction,
 * lines of one direction make it. */
static void lines_over_a_ball_cover_the_share_of_its_tone(void **state) {
  struct pipeline p;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  options.ink.light[2] = 1;
  light_alone(&options);
  draw_ball(&p, 40, &options);
  double ink = 0, angle;
  for (size_t s = 0; s < p.drawing.stroke.count; s++) {
    const struct drawing_point *q =
        p.drawing.point.item + p.drawing.stroke.item[s].point;
    angle = atan2(q[1].y - q[0].y, q[1].x - q[0].x) * 180 / pi();
    if (fabs(remainder(angle - 45, 180)) < 1)
      ink += (length_of(&p.drawing, s) + pi() / 4 * options.ink.pen_mm) *
             options.ink.pen_mm;
  }
  /* The first direction's share: the tone, up to the full coverage. */
  double full = 1 - sqrt(0.4), expected = 0;
  enum { RINGS = 10000 };
  for (int i = 0; i < RINGS; i++) {
    double r = (i + 0.5) / RINGS;
    double tone = GREATEST_TONE * (1 - sqrt(1 - r * r));
    expected += fmin(tone, full) * 2 * pi() * r / RINGS * 40 * 40;
  }
  assert_true(fabs(ink / expected - 1) < 0.03);
  pipeline_fini(&p);
}

static void lines_run_over_many_faces(void **state) {
  struct pipeline p;
  recto_options options;
  size_t before = 0;
  (void)state;
  for (unsigned n = 20; n <= 80; n *= 2) {
    recto_options_init(&options);
    options.ink.light[0] = -1;
    options.ink.light[2] = 1;
    draw_ball(&p, n, &options);
    assert_true(p.drawing.stroke.count < 700);
    assert_true(before == 0 || p.drawing.stroke.count < before + before / 2);
    before = p.drawing.stroke.count;
    pipeline_fini(&p);
  }
}

/* ---- The shared scenes --------------------------------------------------- */

static void every_scene_is_hatched_on_its_page(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    struct pipeline p;
    recto_options options;
    scene_init(&scene);
    pipeline_fill(&scene, &options, entry);
    options.ink.edges = RECTO_EDGES_NONE;
    options.ink.fill = RECTO_FILL_HATCH;
    options.ink.light[0] = -0.3;
    options.ink.light[2] = 1;
    options.ink.pen_mm = options.page.width_mm / 400;
    pipeline_run(&p, &scene, &options, &solver_tiles);
    for (size_t i = 0; p.status == RECTO_OK && i < p.drawing.point.count; i++) {
      struct drawing_point q = p.drawing.point.item[i];
      assert_true(q.x >= 0 && q.x <= options.page.width_mm);
      assert_true(q.y >= 0 && q.y <= options.page.height_mm);
    }
    pipeline_fini(&p);
    scene_fini(&scene);
  }
}

/* ---- Memory -------------------------------------------------------------- */

static void hatching_fails_cleanly_when_memory_runs_out(void **state) {
  struct pipeline p;
  struct scene scene;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  options.ink.light[2] = 1;
  draw_ball(&p, 6, &options);
  scene_init(&scene);
  build_group(&scene, "ball");
  build_ball(&scene, 6);
  assert_true(scene_list_groups(&scene));
  p.sheet.face_group = scene.face_group.item;
  for (int lit = 0; lit < 2; lit++) {
    options.ink.light[2] = lit;
    ink_fail_each_allocation(&p, &scene, &options);
  }
  scene_fini(&scene);
  pipeline_fini(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pieces_that_meet_are_one_run),
      cmocka_unit_test(pieces_of_different_lines_never_meet),
      cmocka_unit_test(short_runs_between_changes_of_tone_are_left_out),
      cmocka_unit_test(short_gaps_in_a_face_are_closed),
      cmocka_unit_test(one_even_face_is_hatched_at_one_pitch),
      cmocka_unit_test(white_and_dark_are_hatched_by_no_and_three_layers),
      cmocka_unit_test(strokes_end_before_the_face_does),
      cmocka_unit_test(neighbours_of_one_tone_share_their_lines),
      cmocka_unit_test(each_pen_hatches_its_groups),
      cmocka_unit_test(lines_over_a_ball_cover_the_share_of_its_tone),
      cmocka_unit_test(lines_run_over_many_faces),
      cmocka_unit_test(flats_beside_fillets_have_one_tone),
      cmocka_unit_test(facets_are_no_flats),
      cmocka_unit_test(every_scene_is_hatched_on_its_page),
      cmocka_unit_test(hatching_fails_cleanly_when_memory_runs_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
