/* test_parallel_stages.c - the number of threads changes no byte of a drawing,
 * whichever stage they run.
 *
 * The models have so many faces that every stage is divided: most scenes of
 * other tests are too small for a second thread. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "base/parallel.h"
#include "recto.h"
#include "scene/topology/edge_join.h"
#include "scene/topology/edge_range.h"
#include "tests/obj_drawing.h"
#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"

/* ---- Models, as OBJ files in memory -------------------------------------- */

enum { SIDE = 240, FACES = 2 * SIDE * SIDE };

/* Points of a wavy surface over a unit square. */
static void write_points(FILE *to, int side, double height) {
  for (int y = 0; y <= side; y++)
    for (int x = 0; x <= side; x++) {
      double u = (double)x / side, v = (double)y / side;
      double wave = 40 * (u * (1 - u) - 0.2) * (v * (1 - v) - 0.1);
      fprintf(to, "v %.7g %.7g %.7g\n", u, v,
              height * wave * (x % 3 + y % 5 + 3));
    }
}

/* The corners of triangle `face` of a grid of side x side squares. */
static void corners_of_face(int face, int side, int corner[3]) {
  int square = face / 2, x = square % side, y = square / side;
  int first = y * (side + 1) + x + 1;
  corner[0] = first;
  corner[1] = face % 2 ? first + side + 2 : first + 1;
  corner[2] = face % 2 ? first + side + 1 : first + side + 2;
}

static void write_face(FILE *to, int face, int side) {
  int c[3];
  corners_of_face(face, side, c);
  fprintf(to, "f %d %d %d\n", c[0], c[1], c[2]);
}

static void write_surface(FILE *to) {
  write_points(to, SIDE, 0.02);
  for (int f = 0; f < FACES; f++)
    write_face(to, f, SIDE);
}

/* A smooth surface with hills that hide one another. */
static void write_hills(FILE *to) {
  for (int y = 0; y <= SIDE; y++)
    for (int x = 0; x <= SIDE; x++)
      fprintf(to, "v %d %d %.7g\n", x, y,
              20 * sin(x * 0.08) * sin(y * 0.1 + x * 0.01));
  for (int f = 0; f < FACES; f++)
    write_face(to, f, SIDE);
}

/* The faces are in random order, so that their edges are used far apart. */
static void write_shuffled(FILE *to) {
  static int order[FACES];
  struct random random = {5};
  write_points(to, SIDE, 0.02);
  for (int f = 0; f < FACES; f++)
    order[f] = f;
  for (int f = FACES - 1; f > 0; f--) {
    int other = random_int(&random, 0, f), face = order[f];
    order[f] = order[other];
    order[other] = face;
  }
  for (int f = 0; f < FACES; f++)
    write_face(to, order[f], SIDE);
}

/* Groups, indices of textures, negative indices, comments, polygons and bad
 * statements between the triangles. */
static void write_mixed(FILE *to) {
  write_points(to, SIDE, 0.02);
  for (int f = 0; f < FACES; f++) {
    int c[3];
    corners_of_face(f, SIDE, c);
    if (f % 9973 == 5000)
      fprintf(to, "g part%d\n# the next part\n", f);
    if (f % 7919 == 4000)
      fprintf(to, "f %d %d\nv 0.5 0.%d 1\n", c[0], c[1], f);
    if (f % 997 == 500)
      fprintf(to, "f %d/1 %d/2/3 %d//4\n", c[0], c[1], c[2]);
    else if (f % 991 == 500 && f % 2 == 0)
      fprintf(to, "f %d %d %d %d\n", c[0], c[1], c[2], c[2] - 1);
    else
      fprintf(to, f % 401 == 7 ? "f  %d %d\t%d\r\n" : "f %d %d %d\n", c[0],
              c[1], c[2]);
  }
}

/* Strips without normals, with one a point, and with one a face; and smoothing
 * groups. */
static void write_marked(FILE *to) {
  write_points(to, SIDE, 0.06);
  for (int n = 0; n < 16; n++)
    fprintf(to, "vn %d %d 3\n", n % 4 - 1, n / 4 - 1);
  for (int f = 0; f < FACES; f++) {
    int c[3], strip = f / (20 * SIDE) % 3;
    corners_of_face(f, SIDE, c);
    if (f % 500 == 0)
      fprintf(to, "s %d\n", f / 500 % 3);
    if (strip == 0)
      write_face(to, f, SIDE);
    for (int k = 0; strip > 0 && k < 3; k++)
      fprintf(to, "%s%d//%d%s", k == 0 ? "f " : " ", c[k],
              (strip == 1 ? c[k] : f) % 16 + 1, k == 2 ? "\n" : "");
  }
}

/* The squares in two strips of every other one, so that both sides of an edge
 * are used far apart: quadrilaterals that are not planar and fold, pairs of
 * triangles, faces with a repeated corner, and some of many corners. */
static void write_polygons(FILE *to) {
  write_points(to, SIDE, 0.06);
  for (int strip = 0; strip < 2; strip++)
    for (int s = strip; s < SIDE * SIDE; s += 2) {
      int c[3];
      corners_of_face(2 * s + 1, SIDE, c);
      if (s % 7 == 3) {
        write_face(to, 2 * s, SIDE);
        write_face(to, 2 * s + 1, SIDE);
      } else if (s % 1009 == 5 && s % SIDE < SIDE - 40) {
        fprintf(to, "f");
        for (int k = 0; k < 40; k++)
          fprintf(to, " %d", c[0] + k);
        for (int k = 40; k-- > 0;)
          fprintf(to, " %d", c[0] + k + SIDE + 1);
        fprintf(to, "\n");
      } else
        fprintf(to, "f %d %d %d %d\n", c[0], s % 11 == 7 ? c[0] : c[0] + 1,
                c[1], c[2]);
    }
}

/* Triangles that stand on sides of the surface come before it, so that edges of
 * three faces are used at both ends of the file. */
static void write_fins(FILE *to) {
  int fins = SIDE * SIDE / 4, first = SIDE * (SIDE - SIDE / 4 - 1);
  write_points(to, SIDE, 0.02);
  for (int f = 0; f < fins; f++)
    fprintf(to, "v %.7g %.7g 0.1\n", (f % SIDE + 0.5) / SIDE,
            0.75 + 0.25 * f / fins);
  for (int f = 0; f < fins; f++) {
    int c[3];
    corners_of_face(2 * (first + f), SIDE, c);
    fprintf(to, "f %d %d %d\n", c[0], c[1], (SIDE + 1) * (SIDE + 1) + f + 1);
  }
  for (int f = 0; f < FACES; f++)
    write_face(to, f, SIDE);
}

/* Triangles through one another, that share nothing. */
static void write_soup(FILE *to) {
  struct random random = {9};
  for (int f = 0; f < 70000; f++) {
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] = random_unit(&random);
    for (int k = 0; k < 3; k++)
      fprintf(to, "v %.6f %.6f %.6f\n",
              at[0] + random_between(&random, -0.03, 0.03),
              at[1] + random_between(&random, -0.03, 0.03),
              at[2] + random_between(&random, -0.03, 0.03));
  }
  for (int f = 0; f < 70000; f++)
    fprintf(to, "f %d %d %d\n", 3 * f + 1, 3 * f + 2, 3 * f + 3);
}

/* Points of a small triangle somewhere. */
static void write_small_triangle(FILE *to, struct random *random) {
  double at[3];
  for (int k = 0; k < 3; k++)
    at[k] = random_unit(random);
  for (int k = 0; k < 3; k++)
    fprintf(to, "v %.6f %.6f %.6f\n",
            at[0] + random_between(random, -0.003, 0.003),
            at[1] + random_between(random, -0.003, 0.003),
            at[2] + random_between(random, -0.003, 0.003));
}

/* The first half of the faces has exactly as many edges as there is room for in
 * its part of the array of all (edge_join.c), and the second half shares some.
 * Two triangles with a common edge, copies of the first, and single ones: that
 * some of these run the other way keeps them from being repeated parts. */
static void write_full(FILE *to) {
  enum {
    HALF = 4 * POLL_ITEMS,
    ROOM = 3 * HALF / 2 + 3 * HALF / 16 + POLL_ITEMS,
    ALONE = (ROOM - 5) / 3
  };
  _Static_assert(ROOM == 5 + 3 * ALONE, "no edges are left");
  struct random random = {4};
  for (int f = 0; f < ALONE + 2 + HALF / 9; f++)
    write_small_triangle(to, &random);
  fprintf(to, "f 1 2 3\nf 2 1 4\n");
  for (int f = 2; f < HALF - ALONE; f++)
    fprintf(to, "f 1 2 3\n");
  for (int f = 0, p = 5; f < ALONE; f++, p += 3) {
    int turn = random_unit(&random) < 0.5;
    fprintf(to, "f %d %d %d\n", p, p + 1 + turn, p + 2 - turn);
  }
  for (int f = 0, p = 5; f < HALF / 3; f++, p += 3)
    fprintf(to, "f %d %d %d\n", p + 1, p, 5 + 3 * ALONE + f);
  for (int f = HALF / 3; f < HALF; f++)
    fprintf(to, "f 1 2 3\n");
}

/* kinds  letters of those below that are drawn */
static const struct model {
  const char *name, *kinds;
  void (*write)(FILE *to);
} models[] = {
    {"surface", "lfe", write_surface}, {"shuffled", "lh", write_shuffled},
    {"mixed", "lfhe", write_mixed},    {"polygons", "l", write_polygons},
    {"fins", "l", write_fins},         {"soup", "l", write_soup},
    {"marked", "lh", write_marked},    {"full", "", write_full},
    {"hills", "s", write_hills}};

/* The model as text of OBJ, *length bytes, to be freed by the caller. */
static char *text_of_model(const struct model *model, size_t *length) {
  char *text;
  FILE *to = open_memstream(&text, length);
  assert_non_null(to);
  model->write(to);
  assert_int_equal(fclose(to), 0);
  return text;
}

/* ---- Drawings ------------------------------------------------------------ */

static void set_lines(recto_options *options) { (void)options; }

static void set_all_and_shade(recto_options *options) {
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.fill = RECTO_FILL_SHADE;
}

static void set_hidden(recto_options *options) {
  options->ink.hidden = RECTO_HIDDEN_LAYER;
  options->camera.azimuth_deg = 20;
  options->camera.elevation_deg = 5;
}

/* An eye close to the surface: faces are clipped. */
static void set_eye(recto_options *options) {
  options->camera.kind = RECTO_CAMERA_EYE;
  options->camera.fov_deg = 60;
  options->camera.eye[0] = 0.5;
  options->camera.eye[1] = -0.1;
  options->camera.eye[2] = 0.3;
}

static void set_smooth(recto_options *options) {
  options->ink.contours = RECTO_CONTOURS_SMOOTH;
  options->camera.elevation_deg = 25;
}

static const struct kind {
  char letter;
  const char *name;
  void (*set)(recto_options *options);
} kinds[] = {{'l', "lines", set_lines},
             {'f', "all edges, shaded", set_all_and_shade},
             {'h', "hidden lines", set_hidden},
             {'e', "an eye", set_eye},
             {'s', "smooth contours", set_smooth}};

static char *draw(const char *bytes, size_t count, const struct kind *kind,
                  int threads) {
  recto_options options;
  recto_options_init(&options);
  options.solver.threads = threads;
  kind->set(&options);
  return obj_drawing_svg(bytes, count, &options, NULL, NULL);
}

static void assert_drawn_alike(const char *name, const char *text,
                               size_t length, const struct kind *kind) {
  char *one = draw(text, length, kind, 1), *two = draw(text, length, kind, 2);
  assert_true(strlen(one) > 10000);
  if (strcmp(one, two) != 0)
    fail_msg("%s, %s: two threads draw differently", name, kind->name);
  free(one);
  free(two);
}

static void threads_change_no_byte(void **state) {
  (void)state;
  if (parallel_processors() < 2)
    skip();
  for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
    size_t length;
    char *text = text_of_model(&models[m], &length);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
      if (strchr(models[m].kinds, kinds[k].letter) == NULL)
        continue;
      assert_drawn_alike(models[m].name, text, length, &kinds[k]);
    }
    free(text);
  }
}

/* ---- Edges and sheets ---------------------------------------------------- */

/* Lays out a sheet of a scene in so many threads. */
static void lay_out(struct sheet_fixture *fixture, const struct scene *scene,
                    bool all_edges, int threads) {
  struct poll poll;
  sheet_fixture_start(fixture);
  fixture->scene = *scene;
  fixture->options.solver.threads = threads;
  poll_open(&poll, &fixture->options);
  sheet_fixture_out(fixture, all_edges);
  poll_close(&poll);
}

#define ASSERT_SAME_ITEMS(a, b, count)                                         \
  assert_memory_equal(a, b, (count) * sizeof *(a))

/* Drawings show but some of what edges and triangles know of each other. */
static void assert_laid_out_alike(const struct scene *scene, bool all_edges) {
  struct sheet_fixture one, two;
  lay_out(&one, scene, all_edges, 1);
  lay_out(&two, scene, all_edges, 2);
  assert_int_equal(one.topology.edge.count, two.topology.edge.count);
  ASSERT_SAME_ITEMS(one.topology.edge.item, two.topology.edge.item,
                    one.topology.edge.count);
  ASSERT_SAME_ITEMS(one.topology.corner_edge, two.topology.corner_edge,
                    scene->corner.count);
  assert_int_equal(one.sheet.edge.count, two.sheet.edge.count);
  ASSERT_SAME_ITEMS(one.sheet.edge.item, two.sheet.edge.item,
                    one.sheet.edge.count);
  assert_int_equal(one.sheet.triangle.count, two.sheet.triangle.count);
  ASSERT_SAME_ITEMS(one.sheet.triangle.item, two.sheet.triangle.item,
                    one.sheet.triangle.count);
  assert_int_equal(one.sheet.contour.count, two.sheet.contour.count);
  ASSERT_SAME_ITEMS(one.sheet.contour.item, two.sheet.contour.item,
                    one.sheet.contour.count);
  scene_init(&one.scene); /* it is the caller's */
  scene_init(&two.scene);
  sheet_fixture_fini(&one);
  sheet_fixture_fini(&two);
}

/* How many edges of a scene several faces have, as so many ranges count
 * them. */
static size_t count_shared(const struct scene *scene, int ranges) {
  struct edge_range all = {.scene = scene, .end_face = scene_face_count(scene)};
  all.corner_edge = calloc(scene->corner.count, sizeof *all.corner_edge);
  assert_non_null(all.corner_edge);
  assert_true(ranges > 1 ? edge_join_find(&all, ranges)
                         : edge_range_find(&all, false));
  size_t shared = all.shared;
  free(all.corner_edge);
  edge_range_fini(&all);
  return shared;
}

static void threads_change_no_edge(void **state) {
  (void)state;
  if (parallel_processors() < 2)
    skip();
  for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
    size_t length;
    char *text = text_of_model(&models[m], &length);
    recto_scene *scene;
    assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
    assert_int_equal(
        recto_scene_read_memory(scene, text, length, "obj", NULL, NULL, NULL),
        RECTO_OK);
    assert_laid_out_alike(&scene->scene, false);
    assert_laid_out_alike(&scene->scene, true);
    size_t shared = count_shared(&scene->scene, 1);
    assert_int_equal(shared, count_shared(&scene->scene, 2));
    assert_int_equal(shared, count_shared(&scene->scene, 5));
    recto_scene_destroy(scene);
    free(text);
  }
}

/* ---- What is wrong with a file ------------------------------------------- */

/* Few faults between long runs of plain statements, of which `worst`, a
 * statement or NULL, ends the reading.  The decimals of the points show their
 * precision. */
static void write_faulty(FILE *to, const char *worst) {
  int side = 400, faces = 2 * side * side;
  for (int i = 0; i <= side * (side + 2); i++) {
    if (i == 60007)
      fprintf(to, "v 0 nan 0\nv 1 2\n# two points that cannot be used\n");
    fprintf(to, "v %.5f %.5f %.4f\n", (i % (side + 1)) / 400.0,
            (i / (side + 1)) / 400.0, 0.1 * (i % 7));
  }
  fprintf(to, "g first\n");
  for (int f = 0; f < faces; f++) {
    if (f % 80000 == 70007)
      fprintf(to, "f 1 2\nf 1 2 %d\ng part%d\n", 1 << 29, f);
    if (f % 80000 == 60000)
      fprintf(to, "f 3 5 9 \\\n 7\n");
    if (f == 290000 && worst != NULL)
      fputs(worst, to);
    write_face(to, f, side);
  }
}

static void note_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  FILE *to = user;
  fprintf(to, "%s %lu %s\n", file, line, text);
}

/* All that reading says: the warnings and the error. */
static char *read_faulty(const char *bytes, size_t count, int threads) {
  char *said;
  size_t length;
  FILE *to = open_memstream(&said, &length);
  recto_options options;
  recto_scene *scene;
  recto_error error = {.code = RECTO_OK};
  assert_non_null(to);
  recto_options_init(&options);
  options.solver.threads = threads;
  options.warning = note_warning;
  options.user = to;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  recto_status status = recto_scene_read_memory(scene, bytes, count, "obj",
                                                NULL, &options, &error);
  assert_int_equal(status, error.code);
  fprintf(to, "%d %lu %s\n", (int)error.code, error.line, error.text);
  recto_scene_destroy(scene);
  fclose(to);
  return said;
}

static void threads_change_no_message(void **state) {
  static const char *const worst[] = {NULL, "f 1 2 3\001\n", "v 1 2 x\001\n"};
  (void)state;
  if (parallel_processors() < 2)
    skip();
  for (size_t w = 0; w < sizeof worst / sizeof *worst; w++) {
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    assert_non_null(to);
    write_faulty(to, worst[w]);
    fclose(to);
    char *one = read_faulty(text, length, 1),
         *two = read_faulty(text, length, 2);
    assert_non_null(strstr(one, " 230815 "));
    assert_string_equal(one, two);
    if (worst[w] == NULL)
      assert_drawn_alike("faulty", text, length, &kinds[0]);
    free(one);
    free(two);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_change_no_edge),
      cmocka_unit_test(threads_change_no_byte),
      cmocka_unit_test(threads_change_no_message),
  };
  return cmocka_run_group_tests_name("parallel stages", tests, NULL, NULL);
}
