/* test_scenes.c - the test scenes are what their names say. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/near.h"
#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

/* Fills a scene of the list; the caller ends it with scene_fini. */
static void fill(struct scene *scene, const struct scenes_entry *entry) {
  recto_options options;
  recto_options_init(&options);
  scene_init(scene);
  entry->fill(scene, &options);
}

static void every_scene_keeps_the_invariants(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    fill(&scene, entry);
    uint32_t faces = scene_face_count(&scene);
    assert_true(faces + scene_wire_count(&scene) > 0);
    for (size_t i = 0; i < scene.point.count; i++) {
      assert_true(isfinite(scene.point.item[i].x));
      assert_true(isfinite(scene.point.item[i].y));
      assert_true(isfinite(scene.point.item[i].z));
    }
    for (size_t i = 0; i < scene.corner.count; i++)
      assert_true(scene.corner.item[i] < scene.point.count);
    for (uint32_t i = 0; i < faces; i++) {
      assert_true(
          scene_face_start(&scene, i + 1) - scene_face_start(&scene, i) >= 3);
      assert_true(scene_face_group(&scene, i) < scene.group.count);
    }
    scene_fini(&scene);
  }
}

static void names_are_unique_and_found(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    assert_ptr_equal(scenes_find(entry->name), entry);
}

static void assert_same(const struct scene *a, const struct scene *b) {
  assert_int_equal(a->point.count, b->point.count);
  assert_int_equal(a->corner.count, b->corner.count);
  assert_int_equal(scene_face_count(a), scene_face_count(b));
  if (a->point.count > 0)
    assert_memory_equal(a->point.item, b->point.item,
                        a->point.count * sizeof *a->point.item);
  if (a->corner.count > 0)
    assert_memory_equal(a->corner.item, b->corner.item,
                        a->corner.count * sizeof *a->corner.item);
}

static void filling_twice_gives_the_same_scene(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene a, b;
    fill(&a, entry);
    fill(&b, entry);
    assert_same(&a, &b);
    scene_fini(&a);
    scene_fini(&b);
  }
}

static void a_seed_names_one_small_scene(void **state) {
  (void)state;
  unsigned different = 0;
  for (uint64_t seed = 0; seed < 200; seed++) {
    struct scene a, b, c;
    recto_options options;
    recto_options_init(&options);
    scene_init(&a);
    scene_init(&b);
    scene_init(&c);
    scenes_small(&a, &options, seed);
    scenes_small(&b, &options, seed);
    scenes_small(&c, &options, seed + 1);
    assert_same(&a, &b);
    assert_in_range(scene_face_count(&a), 2, 12);
    different += a.point.count != c.point.count ||
                 memcmp(a.point.item, c.point.item,
                        a.point.count * sizeof *a.point.item) != 0;
    scene_fini(&a);
    scene_fini(&b);
    scene_fini(&c);
  }
  assert_true(different > 190);
}

/* ---- Shape --------------------------------------------------------------- */

/* How many directed sides a -> b the scene has. */
static unsigned count_sides(const struct scene *scene, uint32_t a, uint32_t b) {
  unsigned count = 0;
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene_face_start(scene, i);
    uint32_t corners = scene_face_start(scene, i + 1) - start;
    for (uint32_t k = 0; k < corners; k++)
      count += scene->corner.item[start + k] == a &&
               scene->corner.item[start + (k + 1) % corners] == b;
  }
  return count;
}

/* Every side has a twin in the opposite direction. */
static bool is_closed(const struct scene *scene) {
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene_face_start(scene, i);
    uint32_t corners = scene_face_start(scene, i + 1) - start;
    for (uint32_t k = 0; k < corners; k++) {
      uint32_t a = scene->corner.item[start + k];
      uint32_t b = scene->corner.item[start + (k + 1) % corners];
      if (count_sides(scene, a, b) != count_sides(scene, b, a))
        return false;
    }
  }
  return true;
}

/* Six times the volume a closed mesh encloses: positive where its faces run
 * counter-clockwise seen from outside. */
static double volume_6(const struct scene *scene) {
  double volume = 0;
  for (uint32_t i = 0; i < scene_face_count(scene); i++) {
    uint32_t start = scene_face_start(scene, i);
    for (uint32_t k = start + 2; k < scene_face_start(scene, i + 1); k++) {
      const struct scene_point *p = scene->point.item;
      struct scene_point a = p[scene->corner.item[start]];
      struct scene_point b = p[scene->corner.item[k - 1]];
      struct scene_point c = p[scene->corner.item[k]];
      volume += vector_dot(
          vector_of(a.x, a.y, a.z),
          vector_cross(vector_of(b.x, b.y, b.z), vector_of(c.x, c.y, c.z)));
    }
  }
  return volume;
}

static void solids_are_closed_and_turned_outward(void **state) {
  static const char *const name[] = {
      "cube",          "icosahedron",
      "crossed boxes", "self-intersecting",
      "globe",         "collinear edges",
      "honeycomb",     "Menger sponge",
      "lattice",       "cube stack",
      "box on table",  "pipe along its axis",
      "box square-on",
  };
  (void)state;
  for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
    struct scene scene;
    fill(&scene, scenes_find(name[i]));
    if (!is_closed(&scene))
      fail_msg("%s is not closed", name[i]);
    if (!(volume_6(&scene) > 0))
      fail_msg("%s is inside out", name[i]);
    scene_fini(&scene);
  }
}

static void an_icosahedron_has_twenty_faces(void **state) {
  (void)state;
  struct scene scene;
  fill(&scene, scenes_find("icosahedron"));
  assert_int_equal(scene_face_count(&scene), 20);
  scene_fini(&scene);
}

static void a_menger_sponge_has_the_faces_it_should(void **state) {
  (void)state;
  /* Outer faces of level n: 2 * 20^n + 4 * 8^n. */
  static const uint32_t faces[] = {6, 72, 1056};
  for (unsigned level = 0; level < 3; level++) {
    struct scene scene;
    recto_options options;
    recto_options_init(&options);
    scene_init(&scene);
    scenes_menger(&scene, &options, level);
    assert_int_equal(scene_face_count(&scene), faces[level]);
    scene_fini(&scene);
  }
}

/* ---- Whole scenes -------------------------------------------------------- */

static void turning_keeps_lengths(void **state) {
  (void)state;
  struct scene scene;
  fill(&scene, scenes_find("cube"));
  struct scene_point before = scene.point.item[0];
  scenes_turn(&scene, vector_of(1, 2, 3), 0.3);
  struct scene_point after = scene.point.item[0];
  assert_within(hypot(hypot(after.x, after.y), after.z), sqrt(0.75), 1e-15);
  assert_true(fabs(after.x - before.x) > 0.01);
  /* What lies on the axis stays. */
  assert_within(after.x + 2 * after.y + 3 * after.z,
                before.x + 2 * before.y + 3 * before.z, 1e-15);
  scene_fini(&scene);
}

static void a_shuffled_copy_has_the_same_faces_in_another_order(void **state) {
  (void)state;
  struct scene scene, copy, shuffled;
  fill(&scene, scenes_find("two colours"));
  scene_init(&copy);
  scene_init(&shuffled);
  scenes_copy(&copy, &scene, 0);
  scenes_copy(&shuffled, &scene, 7);
  assert_same(&scene, &copy);
  assert_int_equal(scene_face_count(&shuffled), scene_face_count(&scene));
  assert_memory_not_equal(shuffled.corner.item, scene.corner.item,
                          scene.corner.count * sizeof *scene.corner.item);
  uint64_t sum = 0, sum_shuffled = 0;
  for (uint32_t i = 0; i < scene.corner.count; i++) {
    sum += scene.corner.item[i] * (1 + scene_face_group(&scene, i / 4));
    sum_shuffled +=
        shuffled.corner.item[i] * (1 + scene_face_group(&shuffled, i / 4));
  }
  assert_int_equal(sum, sum_shuffled);
  scene_fini(&scene);
  scene_fini(&copy);
  scene_fini(&shuffled);
}

static void random_numbers_are_the_published_ones(void **state) {
  (void)state;
  /* The first outputs of splitmix64 from seed 0 and 1234567. */
  struct random zero = {0}, other = {1234567};
  assert_true(random_next(&zero) == UINT64_C(0xe220a8397b1dcdaf));
  assert_true(random_next(&zero) == UINT64_C(0x6e789e6aa1b965f4));
  assert_true(random_next(&other) == UINT64_C(6457827717110365317));
  assert_true(random_next(&other) == UINT64_C(3203168211198807973));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_scene_keeps_the_invariants),
      cmocka_unit_test(names_are_unique_and_found),
      cmocka_unit_test(filling_twice_gives_the_same_scene),
      cmocka_unit_test(a_seed_names_one_small_scene),
      cmocka_unit_test(solids_are_closed_and_turned_outward),
      cmocka_unit_test(an_icosahedron_has_twenty_faces),
      cmocka_unit_test(a_menger_sponge_has_the_faces_it_should),
      cmocka_unit_test(turning_keeps_lengths),
      cmocka_unit_test(a_shuffled_copy_has_the_same_faces_in_another_order),
      cmocka_unit_test(random_numbers_are_the_published_ones),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
