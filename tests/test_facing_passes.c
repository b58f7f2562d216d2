/* test_facing_passes.c - what is found of all faces and edges of a mesh in few
 * bytes is what their points say. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "scene/diagnostics.h"
#include "tests/scenes/random.h"
#include "visibility/zero_set/facing.h"

enum { ROWS = 20, COLUMNS = 30, SEEDS = 40 };

struct mesh {
  struct scene scene;
  struct topology topology;
  struct camera camera;
};

static void add_triangle(struct scene *scene, uint32_t a, uint32_t b,
                         uint32_t c) {
  struct diagnostics silent = {.file = "mesh"};
  const uint32_t corner[3] = {a, b, c};
  assert_int_equal(scene_add_face(scene, corner, 3, 0, &silent, NULL),
                   RECTO_OK);
}

static void add_point(struct scene *scene, double x, double y, double z) {
  assert_true(ARRAY_PUSH(&scene->point, ((struct scene_point){x, y, z})));
}

/* A rough surface of triangles, squeezed to slivers along one axis, some of
 * which lie nearly along the view. */
static void build_rough(struct mesh *mesh, uint64_t seed) {
  struct random random = {seed};
  recto_error error = {0};
  double squeeze = pow(10, random_between(&random, -9, 0));
  double rough = pow(10, random_between(&random, -6, 0));
  memset(mesh, 0, sizeof *mesh);
  scene_init(&mesh->scene);
  for (unsigned y = 0; y <= ROWS; y++)
    for (unsigned x = 0; x <= COLUMNS; x++)
      add_point(&mesh->scene, x, y * squeeze,
                rough * random_between(&random, -1, 1));
  for (unsigned y = 0; y < ROWS; y++)
    for (unsigned x = 0; x < COLUMNS; x++) {
      uint32_t a = y * (COLUMNS + 1) + x, b = a + COLUMNS + 1;
      add_triangle(&mesh->scene, a, a + 1, b + 1);
      add_triangle(&mesh->scene, a, b + 1, b);
    }
  assert_int_equal(topology_init(&mesh->topology, &mesh->scene, &error),
                   RECTO_OK);
}

static void aim_anywhere(struct mesh *mesh, struct random *random) {
  double back[3], *to = mesh->camera.back;
  for (int k = 0; k < 3; k++)
    back[k] = random_between(random, -1, 1);
  if (random_below(random, 2) == 0)
    back[2] *= 1e-5; /* nearly edge-on */
  double length =
      sqrt(back[0] * back[0] + back[1] * back[1] + back[2] * back[2]);
  for (int k = 0; k < 3; k++) {
    to[k] = back[k] / length;
    mesh->camera.eye[k] = 100 * to[k];
  }
  mesh->camera.perspective = random_below(random, 2) == 0;
}

static void fini_mesh(struct mesh *mesh) {
  topology_fini(&mesh->topology);
  scene_fini(&mesh->scene);
}

static void find_facing(struct facing *facing, const struct mesh *mesh) {
  recto_error error = {0};
  if (facing_init(facing, &mesh->scene, &mesh->topology, &mesh->camera, 30,
                  &error) != RECTO_OK)
    fail_msg("%s", error.text);
}

static void signs_and_features_are_those_of_all_points(void **state) {
  (void)state;
  for (uint64_t seed = 0; seed < SEEDS; seed++) {
    struct random random = {seed + 1000};
    struct face_sizes sizes;
    struct facing plain, fast;
    struct mesh mesh;
    build_rough(&mesh, seed);
    aim_anywhere(&mesh, &random);
    find_facing(&plain, &mesh);
    mesh.topology.direction = face_directions_find(&mesh.scene, NULL, &sizes);
    assert_non_null(mesh.topology.direction);
    assert_true(
        topology_store_class_masks(&mesh.topology, &mesh.scene, 30, true));
    assert_non_null(mesh.topology.features);
    find_facing(&fast, &mesh);
    assert_memory_equal(plain.face_sign, fast.face_sign,
                        scene_face_count(&mesh.scene));
    assert_memory_equal(plain.class_masks, fast.class_masks,
                        mesh.topology.edge.count);
    assert_memory_equal(plain.odd_edge, fast.odd_edge,
                        (mesh.topology.edge.count + 63) / 64 * 8);
    facing_fini(&plain);
    facing_fini(&fast);
    fini_mesh(&mesh);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(signs_and_features_are_those_of_all_points),
  };
  return cmocka_run_group_tests_name("facing_passes", tests, NULL, NULL);
}
