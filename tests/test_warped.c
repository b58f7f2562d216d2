/* test_warped.c - faces that are not planar, cross themselves or fold back:
 * every exact solver draws them alike, and the judge, which triangulates them
 * by the same rule with its own code, agrees. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/verify.h"
#include "judge/triangulation.h"
#include "scene/triangulation/triangulate.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/scenes/solver_named.h"
#include "tests/valgrind.h"

/* ---- Scenes -------------------------------------------------------------- */

/* A face about a place, its corners off its plane. */
static void add_warped(struct scene *scene, struct random *random) {
  uint32_t corner[7], count = 4 + random_below(random, 4);
  struct vector middle =
      vector_of(3 * random_unit(random), 3 * random_unit(random),
                3 * random_unit(random));
  double warp = random_unit(random);
  for (uint32_t i = 0; i < count; i++) {
    double angle = 2 * acos(-1) * i / count, r = 1 + random_unit(random);
    struct vector off =
        vector_of(r * cos(angle), r * sin(angle), warp * random_unit(random));
    corner[i] = build_vector(scene, vector_add(middle, off));
  }
  build_face(scene, corner, count);
}

/* A face on a small lattice, which may cross itself, fold back, and have
 * corners of others. */
static void add_on_lattice(struct scene *scene, struct random *random,
                           int size) {
  uint32_t corner[7], count = 3 + random_below(random, 5);
  for (uint32_t i = 0; i < count; i++)
    corner[i] =
        build_point(scene, random_int(random, 0, size),
                    random_int(random, 0, size), random_int(random, 0, size));
  if (random_below(random, 3) == 0)
    corner[random_below(random, count)] =
        random_below(random, (uint32_t)scene->point.count);
  if (random_below(random, 3) == 0)
    corner[random_below(random, count)] = corner[random_below(random, count)];
  build_face(scene, corner, count);
}

static void make_scene(struct scene *scene, recto_options *options,
                       uint64_t seed) {
  struct random random = {seed};
  scene_init(scene);
  recto_options_init(options);
  options->ink.min_stroke_mm = 0;
  options->output.precision = 6;
  options->camera.azimuth_deg =
      45.0 * random_below(&random, 8) + (double)(seed % 3);
  options->camera.elevation_deg = random_below(&random, 3) * 30.0;
  options->camera.fov_deg = seed % 2 ? 40 : 0;
  build_group(scene, "faces");
  int faces = random_int(&random, 1, 5);
  for (int f = 0; f < faces; f++)
    if (seed % 2)
      add_warped(scene, &random);
    else
      add_on_lattice(scene, &random, 2 + (int)(seed % 7));
}

/* ---- One drawing --------------------------------------------------------- */

static const struct solver *const others[] = {&solver_newell, &solver_warnock,
                                              &solver_tiles, &solver_watkins};

static void check_methods(const struct scene *scene,
                          const recto_options *options, const char *name) {
  size_t length, other_length;
  char *text = pipeline_draw(scene, options, &solver_brute, &length);
  for (size_t s = 0; s < sizeof others / sizeof *others; s++) {
    char *other = pipeline_draw(scene, options, others[s], &other_length);
    if (other_length != length || memcmp(text, other, length) != 0)
      fail_msg("%s: %s disagrees", name, solver_name(others[s]));
    mem_free(other);
  }
  mem_free(text);
}

/* Verifies a drawing with the judge. */
static recto_status verify_drawn(const struct pipeline *p,
                                 const struct scene *scene,
                                 const recto_options *options,
                                 recto_error *error) {
  struct verify_counts counts;
  const struct verify verify = {scene,   0,           &p->camera, &p->sheet,
                                &p->map, &p->drawing, options,    NULL};
  return verify_drawing(&verify, p->report, &counts, error);
}

static void check_verdict(const struct scene *scene,
                          const recto_options *options, const char *name) {
  struct pipeline p;
  recto_error error;
  recto_options verified = *options;
  verified.verify = 3000;
  pipeline_run(&p, scene, &verified, &solver_tiles);
  if (p.status == RECTO_OK &&
      verify_drawn(&p, scene, &verified, &error) != RECTO_OK)
    fail_msg("%s: %s", name, error.text);
  pipeline_fini(&p);
}

static void every_method_draws_them_alike(void **state) {
  (void)state;
  static const recto_fill fill[] = {RECTO_FILL_NONE, RECTO_FILL_PAINT,
                                    RECTO_FILL_HATCH};
  uint64_t count = is_under_valgrind() ? 20 : 600;
  for (uint64_t seed = 1; seed <= count; seed++) {
    struct scene scene;
    recto_options options;
    char name[32];
    make_scene(&scene, &options, seed);
    snprintf(name, sizeof name, "seed %u", (unsigned)seed);
    options.ink.fill = fill[seed / 2 % 3];
    options.ink.hidden = seed % 5 == 0 ? RECTO_HIDDEN_LAYER : RECTO_HIDDEN_NONE;
    if (scene_face_count(&scene) > 0)
      check_methods(&scene, &options, name);
    scene_fini(&scene);
  }
}

static void the_judge_finds_them_drawn_right(void **state) {
  (void)state;
  uint64_t count = is_under_valgrind() ? 20 : 600;
  for (uint64_t seed = 1; seed <= count; seed++) {
    struct scene scene;
    recto_options options;
    char name[32];
    make_scene(&scene, &options, seed);
    snprintf(name, sizeof name, "seed %u", (unsigned)seed);
    if (scene_face_count(&scene) > 0)
      check_verdict(&scene, &options, name);
    scene_fini(&scene);
  }
}

/* ---- Reported ------------------------------------------------------------ */

/* Corners of faces, 0 after each. */
struct reported {
  const char *name;
  double point[14][3];
  int corner[40];
};

static const struct reported reported[] = {
    {"a face there and back",
     {{1, 0, 1}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {1, 3, 1}, {1, 3, 0}},
     {1, 2, 3, 2, 0, 4, 2, 3, 0, 6, 5, 1, 0}},
    {"a way there and back of welded points",
     {{1, 0, 1},
      {1, 1, 1},
      {0, 0, 0},
      {1, 1, 1},
      {1, 1, 1},
      {1, 0, 1},
      {0, 0, 0},
      {0.9, 3, 0},
      {1, 0, 1},
      {1, 3, 1}},
     {1, 2, 3, 4, 0, 5, 6, 7, 0, 8, 10, 9, 0}},
    {"faces that fold back",
     {{0, 0, 0},
      {2, 0, 0},
      {0, 1, 0},
      {0, 0, 1},
      {2, 0, 1},
      {2, 5, 7},
      {0, 0, 0},
      {2, 0, 0},
      {0, 1, 0},
      {2, 1, 0},
      {0, 0, 1},
      {2, 0, 1},
      {0, 1, 1},
      {3, 1, 5}},
     {8, 9, 7, 0,  10, 13, 1, 0, 6, 10, 12, 8, 0,  7,  9, 13, 11,
      0, 4, 5, 14, 3,  5,  0, 2, 5, 4,  0,  8, 12, 13, 9, 0}},
    {"a warped quadrilateral",
     {{0, 2, 0}, {1, 2, 2}, {1, 1, 1}, {2, 1, 2}},
     {1, 2, 3, 4, 0}},
    {"a spike",
     {{1, 0, 0}, {0, 3, 1}, {1, 3, 1}, {1, 3, 0}, {1, 3, 1}, {0, 2, 1}},
     {1, 2, 3, 0, 4, 5, 4, 6, 0}},
};

static void scenes_of_earlier_errors_are_drawn_right(void **state) {
  (void)state;
  for (size_t r = 0; r < sizeof reported / sizeof *reported; r++)
    for (int elevation = -90; elevation <= 90; elevation += 30) {
      struct scene scene;
      recto_options options;
      uint32_t corner[8];
      size_t count = 0;
      make_scene(&scene, &options, 1);
      scene_fini(&scene);
      scene_init(&scene);
      options.camera.elevation_deg = elevation;
      build_group(&scene, "reported");
      for (size_t p = 0; p < 14; p++)
        build_point(&scene, reported[r].point[p][0], reported[r].point[p][1],
                    reported[r].point[p][2]);
      for (int c = 0; c < 40; c++) {
        if (reported[r].corner[c] > 0)
          corner[count++] = (uint32_t)reported[r].corner[c] - 1;
        else if (count > 0) {
          build_face(&scene, corner, count);
          count = 0;
        }
      }
      check_methods(&scene, &options, reported[r].name);
      check_verdict(&scene, &options, reported[r].name);
      scene_fini(&scene);
    }
}

/* ---- The judge ----------------------------------------------------------- */

/* A sheet of one warped face, which folds at its diagonal. */
static void make_fold(struct scene *scene, recto_options *options) {
  make_scene(scene, options, 1);
  scene_fini(scene);
  scene_init(scene);
  build_group(scene, "fold");
  options->camera.azimuth_deg = 91;
  options->camera.elevation_deg = 2;
  options->camera.fov_deg = 0;
  options->ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
  options->verify = 1000;
  build_polygon(scene, (const double[]){0, 0, 0, 3, 0, 0, 3, 2, 3, 0, 0, 3}, 4);
}

static void a_missing_fold_is_found(void **state) {
  (void)state;
  int folded = 0;
  for (int azimuth = 0; azimuth < 360; azimuth += 5) {
    struct scene scene;
    recto_options options;
    struct pipeline p;
    recto_error error;
    make_fold(&scene, &options);
    options.camera.azimuth_deg = azimuth;
    pipeline_run(&p, &scene, &options, &solver_brute);
    assert_int_equal(p.status, RECTO_OK);
    assert_int_equal(verify_drawn(&p, &scene, &options, &error), RECTO_OK);
    size_t kept = 0;
    for (size_t s = 0; s < p.drawing.stroke.count; s++)
      if (p.drawing.stroke.item[s].edge_class != RECTO_EDGE_SILHOUETTE)
        p.drawing.stroke.item[kept++] = p.drawing.stroke.item[s];
    if (kept < p.drawing.stroke.count) {
      p.drawing.stroke.count = kept;
      folded++;
      assert_int_equal(verify_drawn(&p, &scene, &options, &error),
                       RECTO_ERROR_VERIFY);
      assert_non_null(strstr(error.text, "no line is drawn"));
    }
    pipeline_fini(&p);
    scene_fini(&scene);
  }
  assert_in_range(folded, 1, 71);
}

/* The places of a triangle, least first. */
struct places {
  struct scene_point at[3];
};

static int compare_points(const void *a, const void *b) {
  const struct scene_point *p = a, *q = b;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->z < q->z ? -1 : p->z > q->z;
}

static int compare_places(const void *a, const void *b) {
  const struct places *s = a, *t = b;
  for (int k = 0; k < 3; k++) {
    int order = compare_points(&s->at[k], &t->at[k]);
    if (order != 0)
      return order;
  }
  return 0;
}

static struct places places_of(const struct scene_point *point,
                               const uint32_t corner[3]) {
  struct places places = {
      {point[corner[0]], point[corner[1]], point[corner[2]]}};
  qsort(places.at, 3, sizeof *places.at, compare_points);
  return places;
}

enum { MOST = 12 };

static size_t cut_both_ways(const struct scene_point *point, uint32_t count,
                            struct places *one, struct places *other) {
  struct triangulation t = {0};
  struct judge_triangulation cuts = {0};
  uint32_t corner[MOST];
  for (uint32_t c = 0; c < count; c++)
    corner[c] = c;
  assert_true(triangulate(&t, point, corner, count));
  assert_true(judge_triangulation_make(&cuts, point, corner, count));
  assert_int_equal(t.triangle.count, cuts.triangle.count);
  size_t triangles = t.triangle.count;
  for (size_t i = 0; i < triangles; i++) {
    one[i] = places_of(point, t.triangle.item[i].corner);
    other[i] = places_of(point, cuts.triangle.item[i].corner);
  }
  qsort(one, triangles, sizeof *one, compare_places);
  qsort(other, triangles, sizeof *other, compare_places);
  triangulation_fini(&t);
  judge_triangulation_fini(&cuts);
  return triangles;
}

static void the_judge_cuts_faces_by_the_same_rule(void **state) {
  (void)state;
  struct random random = {5};
  for (int i = 0; i < 20000; i++) {
    struct scene_point point[MOST];
    struct places one[MOST], other[MOST];
    uint32_t count = 3 + random_below(&random, MOST - 2);
    int size = random_int(&random, 1, 9);
    double unit = i % 2 ? 1 : 0.1;
    for (uint32_t c = 0; c < count; c++)
      point[c] =
          (struct scene_point){random_int(&random, 0, size) * unit + 3,
                               random_int(&random, 0, size) * unit,
                               i % 3 ? random_int(&random, 0, size) / 3.0 : 0};
    size_t triangles = cut_both_ways(point, count, one, other);
    for (size_t k = 0; k < triangles; k++)
      if (compare_places(&one[k], &other[k]) != 0)
        fail_msg("polygon %d of %u corners", i, (unsigned)count);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scenes_of_earlier_errors_are_drawn_right),
      cmocka_unit_test(every_method_draws_them_alike),
      cmocka_unit_test(the_judge_finds_them_drawn_right),
      cmocka_unit_test(a_missing_fold_is_found),
      cmocka_unit_test(the_judge_cuts_faces_by_the_same_rule),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
