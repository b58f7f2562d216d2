/* test_subdivide.c - subdivided meshes keep the invariants of the coarse ones.
 * */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "scene/topology/topology.h"
#include "tests/scenes/scenes.h"
#include "tests/scenes/subdivide.h"

/* Fills a scene of the list and makes a finer one of it. */
static void refine(struct scene *coarse, struct scene *fine, const char *name,
                   enum subdivide_rule rule) {
  recto_options options;
  recto_options_init(&options);
  scene_init(coarse);
  scene_init(fine);
  scenes_find(name)->fill(coarse, &options);
  scenes_subdivide(fine, coarse, rule);
}

static unsigned count_borders(const struct scene *scene) {
  struct topology topology;
  unsigned borders = 0;
  assert_int_equal(topology_init(&topology, scene, NULL), RECTO_OK);
  for (size_t i = 0; i < topology.edge.count; i++)
    borders += topology.edge.item[i].uses != 2;
  topology_fini(&topology);
  return borders;
}

static void each_triangle_becomes_four(void **state) {
  (void)state;
  struct scene coarse, fine;
  refine(&coarse, &fine, "icosahedron", SUBDIVIDE_LOOP);
  assert_int_equal(scene_face_count(&fine), 80);
  assert_int_equal(fine.point.count, 12 + 30);
  scene_fini(&coarse);
  scene_fini(&fine);
}

static void a_closed_mesh_stays_closed(void **state) {
  (void)state;
  for (int rule = SUBDIVIDE_MIDPOINT; rule <= SUBDIVIDE_LOOP; rule++) {
    struct scene coarse, fine;
    refine(&coarse, &fine, "self-intersecting", (enum subdivide_rule)rule);
    assert_int_equal(count_borders(&fine), 0);
    scene_fini(&coarse);
    scene_fini(&fine);
  }
}

static void midpoints_change_no_place(void **state) {
  (void)state;
  struct scene coarse, fine;
  refine(&coarse, &fine, "paraboloid", SUBDIVIDE_MIDPOINT);
  for (size_t i = 0; i < coarse.point.count; i++) {
    assert_true(fine.point.item[i].x == coarse.point.item[i].x);
    assert_true(fine.point.item[i].z == coarse.point.item[i].z);
  }
  /* The middle of the first face's first side is the first new point. */
  const struct scene_point *a = &coarse.point.item[coarse.corner.item[0]];
  const struct scene_point *b = &coarse.point.item[coarse.corner.item[1]];
  const struct scene_point *m = &fine.point.item[coarse.point.count];
  assert_true(m->x == (a->x + b->x) / 2 && m->z == (a->z + b->z) / 2);
  scene_fini(&coarse);
  scene_fini(&fine);
}

static void a_border_depends_on_itself_alone(void **state) {
  (void)state;
  /* The border of a square sheet stays in the square's sides: its middle
   * points move along them, its corners inward along the border's curve. */
  struct scene coarse, fine;
  refine(&coarse, &fine, "white square", SUBDIVIDE_LOOP);
  assert_int_equal(count_borders(&fine), 2 * count_borders(&coarse));
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < fine.point.count; i++) {
    low = fmin(low, fine.point.item[i].x);
    high = fmax(high, fine.point.item[i].x);
    assert_true(fine.point.item[i].z == 0);
  }
  assert_true(low == 5 && high == 45);
  scene_fini(&coarse);
  scene_fini(&fine);
}

static void loop_draws_a_solid_inward(void **state) {
  (void)state;
  struct scene coarse, fine;
  refine(&coarse, &fine, "icosahedron", SUBDIVIDE_LOOP);
  double before = 0, after = 0;
  for (size_t i = 0; i < 12; i++) {
    const struct scene_point *p = &coarse.point.item[i];
    const struct scene_point *q = &fine.point.item[i];
    before = hypot(hypot(p->x, p->y), p->z);
    after = hypot(hypot(q->x, q->y), q->z);
    assert_true(after < before);
    /* Five neighbours, weight 3/40 each, at cos 63.4 degrees. */
    assert_true(fabs(after / before - (0.625 + 0.375 / sqrt(5))) < 1e-12);
  }
  scene_fini(&coarse);
  scene_fini(&fine);
}

static void groups_go_with_their_faces(void **state) {
  (void)state;
  struct scene coarse, fine;
  refine(&coarse, &fine, "doubled mesh", SUBDIVIDE_MIDPOINT);
  assert_int_equal(fine.group.count, coarse.group.count);
  /* Quads: two triangles, eight quarters. */
  assert_int_equal(scene_face_count(&fine), 8 * scene_face_count(&coarse));
  for (uint32_t i = 0; i < scene_face_count(&fine); i++)
    assert_int_equal(scene_face_group(&fine, i),
                     scene_face_group(&coarse, i / 8));
  scene_fini(&coarse);
  scene_fini(&fine);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_triangle_becomes_four),
      cmocka_unit_test(a_closed_mesh_stays_closed),
      cmocka_unit_test(midpoints_change_no_place),
      cmocka_unit_test(a_border_depends_on_itself_alone),
      cmocka_unit_test(loop_draws_a_solid_inward),
      cmocka_unit_test(groups_go_with_their_faces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
