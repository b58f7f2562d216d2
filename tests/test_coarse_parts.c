/* test_coarse_parts.c - which parts of a mesh have so many creases that they
 * sample no smooth surface. */
#include "scene/edges/coarse_parts.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "scene/edges/edge_classes.h"
#include "tests/scenes/build.h"

enum { ROWS = 20, COLUMNS = 30 };

/* A box, or a surface with one crease. */
static void add_part(struct scene *scene, double x, bool is_coarse) {
  if (is_coarse) {
    build_box(scene, vector_of(x, 0, 0), vector_of(x + 1, 1, 1));
    return;
  }
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned r = 0; r <= ROWS; r++)
    for (unsigned c = 0; c <= COLUMNS; c++)
      (void)build_point(scene, x + c * 0.01, r * 0.1,
                        c > COLUMNS / 2 ? 0.01 * (c - COLUMNS / 2) : 0);
  build_grid(scene, first, ROWS, COLUMNS, true);
}

/* Parts, after a point that no face uses. */
static void check_parts(const bool *is_coarse, int parts) {
  struct scene scene;
  struct topology topology;
  recto_error error = {0};
  uint32_t first[3];
  scene_init(&scene);
  build_group(&scene, "parts");
  (void)build_point(&scene, -9, 0, 0);
  for (int p = 0; p < parts; p++) {
    first[p] = (uint32_t)scene.point.count;
    add_part(&scene, 5.0 * p, is_coarse[p]);
  }
  assert_int_equal(topology_init(&topology, &scene, &error), RECTO_OK);
  assert_true(topology_store_class_masks(&topology, &scene, 30, false));
  assert_true(topology_store_coarse_parts(&topology, &scene));
  assert_int_equal(topology.coarse[0], 0);
  for (int p = 0; p < parts; p++)
    for (size_t i = first[p];
         i < (p + 1 < parts ? first[p + 1] : scene.point.count); i++)
      assert_int_equal(topology.coarse[i], is_coarse[p]);
  topology_fini(&topology);
  scene_fini(&scene);
}

static void each_part_is_coarse_or_not(void **state) {
  (void)state;
  check_parts((const bool[]){false}, 1);
  check_parts((const bool[]){true}, 1);
  check_parts((const bool[]){true, false}, 2);
  check_parts((const bool[]){false, true, false}, 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_part_is_coarse_or_not),
  };
  return cmocka_run_group_tests_name("coarse_parts", tests, NULL, NULL);
}
