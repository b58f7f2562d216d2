/* test_large_faces.c - the normal of a face with many corners is found once for
 * all of its edges: another one is found only where two such faces are not
 * enough. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene/topology/large_faces.h"

/* Adds a regular polygon in the plane z = 0. */
static void add_polygon(struct scene *scene, int corners) {
  for (int i = 0; i < corners; i++) {
    double turn = 2 * M_PI * i / corners;
    const struct scene_point p = {cos(turn), sin(turn), 0};
    assert_true(ARRAY_PUSH(&scene->corner, (uint32_t)scene->point.count));
    assert_true(ARRAY_PUSH(&scene->point, p));
  }
  assert_true(scene_end_face(scene, 0));
}

/* Enlarges the scene, which the normals that are found from then on show. */
static void enlarge(struct scene *scene) {
  for (size_t i = 0; i < scene->point.count; i++) {
    scene->point.item[i].x *= 2;
    scene->point.item[i].y *= 2;
  }
}

static double area_of(const struct scene *scene, uint32_t face) {
  double normal[3];
  newell_normal_of_face(scene, face, normal);
  return normal[2];
}

static void check_area(struct large_face_normals *normals,
                       const struct scene *scene, uint32_t face, double area) {
  double normal[3];
  face_normal_by(normals, scene, face, normal);
  assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == area);
}

static void normals_of_two_large_faces_are_kept(void **state) {
  (void)state;
  struct large_face_normals normals = large_face_normals_start();
  struct scene scene;
  double before[4], after[4];
  scene_init(&scene);
  for (int i = 0; i < 4; i++)
    add_polygon(&scene, i == 0 ? SMALL_FACE_MAX : 100 + i);
  for (uint32_t i = 0; i < 4; i++)
    before[i] = area_of(&scene, i);
  for (uint32_t i = 0; i < 3; i++)
    check_area(&normals, &scene, i, before[i]);
  enlarge(&scene);
  for (uint32_t i = 0; i < 4; i++)
    after[i] = area_of(&scene, i);
  check_area(&normals, &scene, 0, after[0]);
  check_area(&normals, &scene, 1, before[1]);
  check_area(&normals, &scene, 2, before[2]);
  check_area(&normals, &scene, 3, after[3]);
  check_area(&normals, &scene, 2, before[2]);
  check_area(&normals, &scene, 1, after[1]);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(normals_of_two_large_faces_are_kept),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
