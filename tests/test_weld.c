/* test_weld.c - border vertices that lie close together become one, and no
 * others. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"
#include "scene/edges/edge_classes.h"
#include "scene/read.h"
#include "scene/topology/weld_equal.h"
#include "scene/weld/cluster.h"
#include "scene/weld/isolated_members.h"
#include "scene/weld/weld_near.h"
#include "tests/memory_faults.h"
#include "tests/scenes/build.h"
#include "tests/scenes/random.h"
#include "tests/valgrind.h"

/* ---- Clusters ------------------------------------------------------------ */

static double distance(const struct scene_point *a,
                       const struct scene_point *b) {
  return hypot(hypot(a->x - b->x, a->y - b->y), a->z - b->z);
}

static void add_point(struct scene *scene, double x, double y, double z) {
  struct scene_point point = {x, y, z};
  assert_true(ARRAY_PUSH(&scene->point, point));
}

/* Joins all points of the scene; returns a member for each. */
static struct cluster_member *join(const struct scene *scene, double length) {
  size_t count = scene->point.count;
  struct cluster_member *member = calloc(count, sizeof *member);
  assert_non_null(member);
  for (size_t i = 0; i < count; i++)
    member[i].point = (uint32_t)i;
  size_t joined = cluster_join(scene, length, member, count), seen = 0;
  for (size_t i = 0; i < count; i++)
    seen += member[i].representative != i;
  assert_int_equal(joined, seen);
  return member;
}

/* Fails where two points of one cluster are farther apart than the length. */
static void check_width(const struct scene *scene, double length,
                        const struct cluster_member *member) {
  const struct scene_point *point = scene->point.item;
  for (size_t i = 0; i < scene->point.count; i++) {
    assert_int_equal(member[member[i].representative].representative,
                     member[i].representative);
    for (size_t j = 0; j < i; j++)
      if (member[i].representative == member[j].representative)
        assert_true(distance(&point[i], &point[j]) <= length * (1 + 0x1p-40));
  }
}

static void points_within_the_length_are_one(void **state) {
  (void)state;
  struct scene scene;
  scene_init(&scene);
  add_point(&scene, 1, 2, 3);
  add_point(&scene, 1.5, 2, 3);
  add_point(&scene, 1, 2, 3.6);
  struct cluster_member *member = join(&scene, 0.5);
  assert_int_equal(member[1].representative, 0);
  assert_int_equal(member[2].representative, 2);
  free(member);
  scene_fini(&scene);
}

static void the_ends_of_a_chain_stay_apart(void **state) {
  (void)state;
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                  {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < 6; i++) {
    struct scene scene;
    scene_init(&scene);
    for (int k = 0; k < 3; k++)
      add_point(&scene, 0.99 * order[i][k], 0, 0);
    struct cluster_member *member = join(&scene, 1);
    check_width(&scene, 1, member);
    int clusters = 0;
    for (uint32_t k = 0; k < 3; k++)
      clusters += member[k].representative == k;
    assert_int_equal(clusters, 2);
    free(member);
    scene_fini(&scene);
  }
}

static void no_cluster_is_wider_than_the_length(void **state) {
  (void)state;
  struct random random = {11};
  for (int round = 0; round < 40; round++) {
    struct scene scene;
    scene_init(&scene);
    double flat = round % 3 == 0 ? 0 : 1;
    for (int i = 0; i < 300; i++)
      add_point(&scene, random_between(&random, -1, 1),
                random_between(&random, -1, 1),
                flat * random_between(&random, -1, 1));
    double length = ldexp(1, -random_int(&random, -2, 6));
    struct cluster_member *member = join(&scene, length);
    check_width(&scene, length, member);
    free(member);
    scene_fini(&scene);
  }
}

static void radii_are_kept(void **state) {
  (void)state;
  struct random random = {12};
  struct cluster_member member[200];
  struct scene scene;
  scene_init(&scene);
  for (uint32_t i = 0; i < 200; i++) {
    add_point(&scene, random_between(&random, 0, 4), 0, 0);
    member[i] = (struct cluster_member){
        .point = i, .halvings = (uint8_t)random_int(&random, 0, 5)};
    if (i % 7 == 0)
      member[i].halvings = CLUSTER_ALONE;
  }
  assert_true(cluster_join(&scene, 1, member, 200) > 50);
  check_width(&scene, 1, member);
  for (uint32_t i = 0; i < 200; i++)
    for (uint32_t j = 0; j < i; j++) {
      if (member[i].representative != member[j].representative)
        continue;
      assert_int_not_equal(member[i].halvings, CLUSTER_ALONE);
      assert_int_not_equal(member[j].halvings, CLUSTER_ALONE);
      /* The later one came within its own radius. */
      assert_true(distance(&scene.point.item[i], &scene.point.item[j]) <=
                  ldexp(1, -member[i].halvings) * (1 + 0x1p-40));
    }
  scene_fini(&scene);
}

/* Groups of points within 0.4 of places that are 2 apart at least, in an order
 * that depends on the seed. */
static void add_groups(struct scene *scene, uint64_t seed) {
  enum { COUNT = 5 * 5 * 5 * 4 };
  struct random random = {3}, shuffle = {seed};
  struct scene_point point[COUNT];
  for (int i = 0; i < COUNT; i++) {
    int group = i / 4;
    point[i] = (struct scene_point){
        2 * (group % 5) + random_between(&random, -0.2, 0.2),
        2 * (group / 5 % 5) + random_between(&random, -0.2, 0.2),
        2 * (group / 25) + random_between(&random, -0.2, 0.2)};
  }
  for (uint32_t i = COUNT - 1; i > 0; i--) {
    uint32_t j = random_below(&shuffle, i + 1);
    struct scene_point other = point[i];
    point[i] = point[j];
    point[j] = other;
  }
  for (int i = 0; i < COUNT; i++)
    add_point(scene, point[i].x, point[i].y, point[i].z);
}

static int compare_points(const void *a, const void *b) {
  return memcmp(a, b, sizeof(struct scene_point));
}

static void groups_that_are_apart_are_one_in_any_order(void **state) {
  (void)state;
  struct scene_point first[125], other[125];
  for (uint64_t seed = 0; seed < 20; seed++) {
    struct scene_point *at = seed == 0 ? first : other;
    struct scene scene;
    scene_init(&scene);
    add_groups(&scene, seed);
    struct cluster_member *member = join(&scene, 1);
    size_t count = 0;
    for (uint32_t i = 0; i < scene.point.count; i++)
      if (member[i].representative == i) {
        assert_true(count < 125);
        at[count++] = scene.point.item[i];
      }
    assert_int_equal(count, 125);
    qsort(at, count, sizeof *at, compare_points);
    if (seed > 0)
      assert_memory_equal(first, other, sizeof first);
    free(member);
    scene_fini(&scene);
  }
}

static void points_on_the_borders_of_cells_are_found(void **state) {
  (void)state;
  for (int step = 1; step < 20; step++) {
    struct scene scene;
    scene_init(&scene);
    const double length = 8e-5;
    for (int i = 0; i < 200; i++)
      for (int k = 0; k < 2; k++)
        add_point(&scene, i * length * step / 4, i, k * length / 2);
    struct cluster_member *member = join(&scene, length);
    for (uint32_t i = 0; i < scene.point.count; i += 2)
      assert_int_equal(member[i + 1].representative, member[i].representative);
    free(member);
    scene_fini(&scene);
  }
}

static void a_million_points_within_the_length_are_one_cluster(void **state) {
  (void)state;
  struct random random = {13};
  struct scene scene;
  scene_init(&scene);
  uint32_t count = is_under_valgrind() ? 2000 : 1000000;
  for (uint32_t i = 0; i < count; i++)
    add_point(&scene, random_between(&random, 0, 1),
              random_between(&random, 0, 1), random_between(&random, 0, 1));
  free(join(&scene, 0.4));
  struct cluster_member *member = join(&scene, 10);
  for (uint32_t i = 0; i < count; i++)
    assert_int_equal(member[i].representative, member[0].representative);
  free(member);
  scene_fini(&scene);
}

static void unusual_lengths_and_positions_are_handled(void **state) {
  (void)state;
  static const double lengths[] = {0x1p-900, 0x1p-300, 1e-9, 1, 0x1p200};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
    struct scene scene;
    scene_init(&scene);
    add_point(&scene, 0, -0.0, 0);
    add_point(&scene, -0.0, 0, 0x1p-1074);
    add_point(&scene, 0x1p100, 0x1p-100, 1);
    add_point(&scene, -0x1p100, 0x1p100, 0x1p100);
    add_point(&scene, -0x1p100, 0x1p100, 0x1p100);
    struct cluster_member *member = join(&scene, lengths[i]);
    check_width(&scene, lengths[i], member);
    assert_int_equal(member[4].representative, member[3].representative);
    free(member);
    scene_fini(&scene);
  }
}

/* ---- Scenes -------------------------------------------------------------- */

enum { AROUND = 40, ACROSS = 20, TRIANGLES = 2 * AROUND * ACROSS };
static const struct precision exact = {0, 0};
static const struct precision single = {0, PRECISION_SINGLE};

/* A corner of a torus, of radius 3 and 1, moved by as much noise per axis. */
static struct scene_point torus_point(int i, int j, double noise,
                                      struct random *random) {
  const double turn = 8 * atan(1);
  double u = turn * (i % AROUND) / AROUND, v = turn * (j % ACROSS) / ACROSS;
  double r = 3 + cos(v);
  return (struct scene_point){
      r * cos(u) + random_between(random, -noise, noise),
      r * sin(u) + random_between(random, -noise, noise),
      sin(v) + random_between(random, -noise, noise)};
}

/* Adds a torus of which each triangle has corners of its own. */
static void add_torus(struct scene *scene, double noise) {
  struct random random = {21};
  for (int t = 0; t < TRIANGLES; t++) {
    int i = t / 2 / ACROSS, j = t / 2 % ACROSS;
    const int corner[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}},
                                 {{0, 0}, {1, 1}, {0, 1}}};
    double xyz[9];
    for (int k = 0; k < 3; k++) {
      struct scene_point p = torus_point(
          i + corner[t % 2][k][0], j + corner[t % 2][k][1], noise, &random);
      xyz[3 * k] = p.x;
      xyz[3 * k + 1] = p.y;
      xyz[3 * k + 2] = p.z;
    }
    build_polygon(scene, xyz, 3);
  }
}

struct fixture {
  struct scene scene;
  struct welded welded;
  struct topology topology;
};

static void weld(struct fixture *fixture, double length,
                 struct precision precision) {
  const struct weld_request request = {.length = length, .unstated = precision};
  recto_error error;
  assert_int_equal(weld_near(&fixture->welded, &fixture->topology,
                             &fixture->scene, &request, &error),
                   RECTO_OK);
}

static void unweld(struct fixture *fixture) {
  topology_fini(&fixture->topology);
  welded_fini(&fixture->welded);
}

static void end(struct fixture *fixture) {
  unweld(fixture);
  scene_fini(&fixture->scene);
}

/* How many edges have that edge_class at a crease angle of 30 degrees. */
static size_t count_edges_of_class(const struct fixture *fixture,
                                   unsigned edge_class) {
  size_t count = 0;
  for (uint32_t e = 0; e < fixture->topology.edge.count; e++)
    count += (topology_class_mask(&fixture->topology, &fixture->welded.scene, e,
                                  30) &
              edge_class) != 0;
  return count;
}

static void noise_of_rounding_leaves_no_border(void **state) {
  (void)state;
  static const struct {
    double noise, length;
    struct precision precision;
  } row[] = {
      {0, -1, {0, 0}},
      {1e-7, -1, {0, PRECISION_SINGLE}},
      {1e-6, -1, {0, PRECISION_SINGLE}},
      {1e-6, -1, {0.5e-6, PRECISION_DOUBLE}},
      {1e-6, -1, {0, 0.5e-5}},
      {1e-6, -1, {0, 0.5e-6}},
      {1e-6, 1e-5, {0, 0}},
      {1e-4, 4e-4, {0, PRECISION_SINGLE}},
  };
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    struct fixture f;
    scene_init(&f.scene);
    add_torus(&f.scene, row[i].noise);
    weld(&f, row[i].length, row[i].precision);
    assert_int_equal(f.topology.edge.count, 3 * TRIANGLES / 2);
    assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_BORDER), 0);
    assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_CREASE), 0);
    assert_int_equal(f.welded.lost, 0);
    end(&f);
  }
}

static void exact_coordinates_are_left_alone(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  add_torus(&f.scene, 1e-7);
  weld(&f, -1, exact);
  assert_int_equal(f.welded.joined, 0);
  unweld(&f);
  weld(&f, 0, single);
  assert_int_equal(f.welded.joined, 0);
  end(&f);
}

static void closed_shells_are_not_pinched(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  build_box(&f.scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  build_box(&f.scene, vector_of(1.001, 0, 0), vector_of(2, 1, 1));
  weld(&f, 0.1, single);
  assert_int_equal(f.welded.joined, 0);
  assert_int_equal(f.topology.edge.count, 24);
  end(&f);
}

static void what_is_far_widens_nothing_near(void **state) {
  (void)state;
  struct fixture f;
  const double far = 1e8;
  const double ground[] = {-far, -far, -2, far,  -far, -2,
                           far,  far,  -2, -far, far,  -2};
  scene_init(&f.scene);
  add_torus(&f.scene, 1e-6);
  weld(&f, -1, single);
  double length = f.welded.length;
  unweld(&f);
  build_polygon(&f.scene, ground, 4);
  weld(&f, -1, single);
  assert_true(f.welded.length == length);
  assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_BORDER), 4);
  end(&f);
}

static void small_parts_of_a_large_scene_keep_their_gaps(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  /* Nearly all is far away and large, so rounding explains 100 units. */
  for (int i = 0; i < 200; i++) {
    double x = 1e8 + 2e4 * i;
    const double plate[] = {x, 0, 0, x + 1e4, 0, 0, x, 1e4, 0};
    build_polygon(&f.scene, plate, 3);
  }
  const double one[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double two[] = {1.01, 0, 0, 1.01, 1, 0, 0.01, 1, 0};
  build_polygon(&f.scene, one, 3);
  build_polygon(&f.scene, two, 3);
  weld(&f, -1, single);
  assert_true(f.welded.length > 100);
  assert_int_equal(f.welded.joined, 0);
  end(&f);
}

static void needles_lose_their_short_side(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  /* A square of two triangles, and between them a third without area but for
   * rounding. */
  const double left[] = {0, 0, 0, 1, 1, 0, 0, 1, 0};
  const double right[] = {0, 0, 0, 1, 0, 0, 1.000001, 1, 0};
  const double needle[] = {0, 0, 0, 1, 1.000001, 0, 1.000001, 1.000001, 0};
  build_polygon(&f.scene, left, 3);
  build_polygon(&f.scene, needle, 3);
  build_polygon(&f.scene, right, 3);
  weld(&f, -1, (struct precision){1e-6, 0});
  assert_int_equal(f.welded.lost, 1);
  assert_int_equal(scene_face_count(&f.welded.scene), 2);
  assert_int_equal(f.topology.edge.count, 5);
  assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_BORDER), 4);
  end(&f);
}

static void a_length_beyond_the_model_leaves_nothing(void **state) {
  (void)state;
  static const double lengths[] = {100, 1e300};
  for (int i = 0; i < 2; i++) {
    struct fixture f;
    scene_init(&f.scene);
    add_torus(&f.scene, 1e-3);
    weld(&f, lengths[i], single);
    assert_int_equal(scene_face_count(&f.welded.scene), 0);
    assert_int_equal(f.welded.lost, TRIANGLES);
    assert_int_equal(f.topology.edge.count, 0);
    end(&f);
  }
}

static void polylines_follow_their_points(void **state) {
  (void)state;
  struct fixture f;
  recto_error error;
  scene_init(&f.scene);
  const double left[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double right[] = {1e-3, 0, 0, 1, -1e-3, 0, 0, -1, 0};
  build_polygon(&f.scene, left, 3);
  build_polygon(&f.scene, right, 3);
  const uint32_t line[] = {3, 4}, gone[] = {0, 3};
  assert_int_equal(scene_add_wire(&f.scene, line, 2, 0, NULL, &error),
                   RECTO_OK);
  assert_int_equal(scene_add_wire(&f.scene, gone, 2, 0, NULL, &error),
                   RECTO_OK);
  weld(&f, 0.01, single);
  assert_int_equal(f.welded.joined, 2);
  assert_int_equal(scene_wire_count(&f.welded.scene), 1);
  assert_int_equal(f.welded.scene.wire_corner.item[0], 0);
  assert_int_equal(f.topology.edge.count, 5);
  end(&f);
}

static void each_file_is_welded_by_its_own_precision(void **state) {
  (void)state;
  struct fixture f;
  recto_error error;
  scene_init(&f.scene);
  add_torus(&f.scene, 1e-6);
  assert_int_equal(scene_state_precision(&f.scene, 0, single, &error),
                   RECTO_OK);
  size_t first = f.scene.point.count;
  const double one[] = {10, 0, 0, 11, 0, 0, 10, 1, 0};
  const double two[] = {10, -1e-7, 0, 11, -1e-7, 0, 10, -1, 0};
  build_polygon(&f.scene, one, 3);
  build_polygon(&f.scene, two, 3);
  assert_int_equal(scene_state_precision(&f.scene, first, exact, &error),
                   RECTO_OK);
  weld(&f, -1, single);
  assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_BORDER), 6);
  end(&f);
}

static void exhausted_memory_is_reported(void **state) {
  (void)state;
  struct fixture f;
  const struct weld_request request = {.length = -1, .unstated = single};
  recto_error error;
  scene_init(&f.scene);
  add_torus(&f.scene, 1e-6);
  struct memory_faults faults = {.least = 1};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(
        &faults, weld_near(&f.welded, &f.topology, &f.scene, &request, &error));
  }
  assert_int_equal(count_edges_of_class(&f, RECTO_EDGE_BORDER), 0);
  end(&f);
}

/* ---- Suspicion ----------------------------------------------------------- */

static bool is_suspicious(struct fixture *f, double length) {
  weld(f, length, single);
  bool found = welded_is_suspicious(&f->welded, &f->topology);
  unweld(f);
  return found;
}

static void torn_surfaces_are_suspicious(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  add_torus(&f.scene, 1e-4);
  assert_true(is_suspicious(&f, -1));
  assert_false(is_suspicious(&f, 4e-4));
  scene_fini(&f.scene);
}

static void open_grids_are_not_suspicious(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  /* Strips of one quadrangle across: most of their edges are borders. */
  for (int i = 0; i < 200; i++) {
    double x = i % 20, y = 1.5 * (i / 20);
    const double xyz[] = {x, y, 0, x + 1, y, 0, x + 1, y + 1, 0, x, y + 1, 0};
    build_polygon(&f.scene, xyz, 4);
  }
  assert_false(is_suspicious(&f, -1));
  scene_fini(&f.scene);
}

/* Triangles of a grid of unit squares, each corner moved by up to `noise`; all
 * of their points are on borders. */
static void add_torn_grid(struct scene *scene, int squares, double noise) {
  static const int corner[6][2] = {{0, 0}, {1, 0}, {1, 1},
                                   {0, 0}, {1, 1}, {0, 1}};
  struct random random = {22};
  for (int i = 0; i < 2 * squares * squares; i++) {
    double xyz[9];
    for (int k = 0; k < 9; k++)
      xyz[k] = random_between(&random, -noise, noise);
    for (int k = 0; k < 3; k++) {
      xyz[3 * k] += i / 2 % squares + corner[i % 2 * 3 + k][0];
      xyz[3 * k + 1] += i / 2 / squares + corner[i % 2 * 3 + k][1];
    }
    build_polygon(scene, xyz, 3);
  }
}

/* Of so many points a sample is looked at. */
static void large_scenes_are_suspicious_as_small_ones_are(void **state) {
  (void)state;
  for (int torn = 0; torn <= 1; torn++) {
    struct fixture f;
    scene_init(&f.scene);
    add_torn_grid(&f.scene, 120, torn ? 1e-4 : 0.4);
    assert_true(3 * scene_face_count(&f.scene) > 1 << 16);
    assert_int_equal(is_suspicious(&f, -1), torn);
    scene_fini(&f.scene);
  }
}

static void soups_of_triangles_are_not_suspicious(void **state) {
  (void)state;
  struct fixture f;
  struct random random = {31};
  scene_init(&f.scene);
  for (int i = 0; i < 2000; i++) {
    double xyz[9];
    for (int k = 0; k < 9; k++)
      xyz[k] = random_between(&random, 0, 1);
    build_polygon(&f.scene, xyz, 3);
  }
  assert_false(is_suspicious(&f, -1));
  scene_fini(&f.scene);
}

/* ---- Drawings ------------------------------------------------------------ */

/* The scene's triangles, each with corners of its own, moved by noise. */
static recto_scene *tear(const struct scene *scene, double noise) {
  struct random random = {41};
  recto_scene *torn;
  recto_error error;
  assert_int_equal(recto_scene_create(&torn, &error), RECTO_OK);
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    uint32_t start = scene_face_start(scene, f), corner[64];
    uint32_t count = scene_face_start(scene, f + 1) - start;
    assert_true(count <= 64);
    for (uint32_t k = 0; k < count; k++) {
      const struct scene_point *p =
          &scene->point.item[scene->corner.item[start + k]];
      const double at[3] = {p->x, p->y, p->z};
      double xyz[3];
      for (int axis = 0; axis < 3; axis++)
        xyz[axis] =
            (double)(float)(at[axis] + random_between(&random, -noise, noise));
      assert_int_equal(recto_scene_add_point(torn, xyz, &corner[k], &error),
                       RECTO_OK);
    }
    assert_int_equal(recto_scene_add_face(torn, corner, count, &error),
                     RECTO_OK);
  }
  return torn;
}

static void count_strokes(const recto_scene *scene, double length,
                          size_t count[RECTO_EDGE_CLASS_COUNT]) {
  recto_options options;
  recto_drawing *drawing;
  recto_error error;
  recto_options_init(&options);
  options.mesh.weld = length;
  options.mesh.crease_start_deg = options.mesh.crease_deg;
  options.camera.up[1] = 1;
  options.ink.ids = true;
  options.solver.threads = 1;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_OK);
  memset(count, 0, RECTO_EDGE_CLASS_COUNT * sizeof *count);
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    for (int k = 0; k < RECTO_EDGE_CLASS_COUNT; k++)
      count[k] += (unsigned)stroke.edge_class == 1u << k;
  }
  recto_drawing_destroy(drawing);
}

static void a_noisy_teapot_is_drawn_as_a_clean_one(void **state) {
  (void)state;
  static const struct {
    double noise, length;
  } row[] = {{0, -1}, {1e-7, -1}, {1e-6, -1}, {1e-4, 4e-4}};
  const char *models = getenv("RECTO_MODELS");
  char path[4096];
  snprintf(path, sizeof path, "%s/teapot.obj", models ? models : "");
  struct scene scene;
  struct diagnostics diagnostics = {.file = path};
  recto_error error;
  scene_init(&scene);
  if (models == NULL ||
      scene_read(&scene, path, NULL, &diagnostics, &error) != RECTO_OK) {
    print_message("no teapot.obj where RECTO_MODELS says\n");
    scene_fini(&scene);
    skip();
  }
  size_t clean[RECTO_EDGE_CLASS_COUNT];
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    size_t count[RECTO_EDGE_CLASS_COUNT];
    recto_scene *torn = tear(&scene, row[i].noise);
    count_strokes(torn, row[i].length, i == 0 ? clean : count);
    recto_scene_destroy(torn);
    if (i == 0)
      continue;
    for (int k = 0; k < RECTO_EDGE_CLASS_COUNT; k++) {
      assert_int_equal(count[k] == 0, clean[k] == 0);
      assert_true(count[k] <= clean[k] + clean[k] / 10);
      assert_true(count[k] >= clean[k] - clean[k] / 10);
    }
    assert_int_equal(count[1], clean[1]); /* borders */
  }
  scene_fini(&scene);
}

/* ---- Many points --------------------------------------------------------- */

/* So many that those that are alone are left out first. */
enum { MANY_POINTS = 50000 };

/* Every third point lies where another of these does, 7 * 3 before it. */
static void equal_points_among_many_are_found(void **state) {
  (void)state;
  enum { BEFORE = 21 };
  struct random random = {31};
  struct scene scene;
  scene_init(&scene);
  uint32_t *listed = calloc(MANY_POINTS, sizeof *listed), *weld;
  assert_non_null(listed);
  size_t count = 0;
  for (uint32_t i = 0; i < MANY_POINTS; i++) {
    if (i % 3 == 0 && i % (2 * BEFORE) >= BEFORE)
      assert_true(ARRAY_PUSH(&scene.point, scene.point.item[i - BEFORE]));
    else
      add_point(&scene, random_unit(&random), random_unit(&random), 0);
    if (i % 5 > 0)
      listed[count++] = i;
  }
  assert_true(weld_equal(&scene, listed, count, &weld));
  assert_non_null(weld);
  for (uint32_t i = 0; i < MANY_POINTS; i++) {
    bool is_second = i % 3 == 0 && i % (2 * BEFORE) >= BEFORE;
    bool is_welded = is_second && i % 5 > 0 && (i - BEFORE) % 5 > 0;
    assert_int_equal(weld[i], is_welded ? i - BEFORE : i);
  }
  free(weld);
  free(listed);
  scene_fini(&scene);
}

/* Some have another at just their radius or a little less, in any direction, so
 * also across the sides of cells.
 * length   halved as often as the member's number says, none to twice
 * lengths  in the side of a cell */
static void keep_members_near_another(double length, int lengths) {
  struct random random = {32};
  struct scene scene;
  scene_init(&scene);
  struct cluster_member *member = calloc(MANY_POINTS, sizeof *member);
  assert_non_null(member);
  for (uint32_t i = 0; i < MANY_POINTS; i++) {
    double at[3] = {random_unit(&random), random_unit(&random),
                    random_unit(&random)};
    if (i % 50 == 1) {
      const struct scene_point *p = &scene.point.item[i - 1];
      memcpy(at, (double[]){p->x, p->y, p->z}, sizeof at);
      double radius = ldexp(length, -(int)(i / 50 % 3)) * (1 - 0x1p-20);
      at[random_below(&random, 3)] += i % 4 > 1 ? radius : -radius;
    }
    add_point(&scene, at[0], at[1], at[2]);
    member[i].point = i;
    member[i].halvings = i % 50 == 2 ? CLUSTER_ALONE : (uint8_t)(i / 50 % 3);
  }
  size_t count = MANY_POINTS, pairs = 0;
  assert_true(isolated_members_drop(&scene, length, lengths, member, &count));
  assert_true(count < MANY_POINTS / 10);
  for (size_t i = 0; i < count; i++) {
    assert_true(i == 0 || member[i - 1].point < member[i].point);
    assert_int_not_equal(member[i].halvings, CLUSTER_ALONE);
    pairs += member[i].point % 50 < 2;
  }
  assert_int_equal(pairs, 2 * MANY_POINTS / 50);
  free(member);
  scene_fini(&scene);
}

static void members_near_another_are_kept(void **state) {
  (void)state;
  keep_members_near_another(0x1p-20, 64);
  keep_members_near_another(0x1p-20, 4);
}

/* A quarter of the others lie at the sides of cells that are four times as wide
 * as their radius, along each axis. */
static void members_at_sides_of_cells_are_dropped(void **state) {
  (void)state;
  keep_members_near_another(0x1p-10, 4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points_within_the_length_are_one),
      cmocka_unit_test(the_ends_of_a_chain_stay_apart),
      cmocka_unit_test(no_cluster_is_wider_than_the_length),
      cmocka_unit_test(radii_are_kept),
      cmocka_unit_test(groups_that_are_apart_are_one_in_any_order),
      cmocka_unit_test(points_on_the_borders_of_cells_are_found),
      cmocka_unit_test(a_million_points_within_the_length_are_one_cluster),
      cmocka_unit_test(unusual_lengths_and_positions_are_handled),
      cmocka_unit_test(noise_of_rounding_leaves_no_border),
      cmocka_unit_test(exact_coordinates_are_left_alone),
      cmocka_unit_test(closed_shells_are_not_pinched),
      cmocka_unit_test(what_is_far_widens_nothing_near),
      cmocka_unit_test(small_parts_of_a_large_scene_keep_their_gaps),
      cmocka_unit_test(needles_lose_their_short_side),
      cmocka_unit_test(a_length_beyond_the_model_leaves_nothing),
      cmocka_unit_test(polylines_follow_their_points),
      cmocka_unit_test(each_file_is_welded_by_its_own_precision),
      cmocka_unit_test(exhausted_memory_is_reported),
      cmocka_unit_test(torn_surfaces_are_suspicious),
      cmocka_unit_test(large_scenes_are_suspicious_as_small_ones_are),
      cmocka_unit_test(open_grids_are_not_suspicious),
      cmocka_unit_test(soups_of_triangles_are_not_suspicious),
      cmocka_unit_test(a_noisy_teapot_is_drawn_as_a_clean_one),
      cmocka_unit_test(equal_points_among_many_are_found),
      cmocka_unit_test(members_near_another_are_kept),
      cmocka_unit_test(members_at_sides_of_cells_are_dropped),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
