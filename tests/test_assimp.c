/* test_assimp.c - models read through Assimp keep their polygons, transforms
 * and names. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/temporary.h"

/* A pyramid's base, the same with a corner more in a side, and three corners
 * on one line. */
static const char off[] =
    "OFF\n6 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 -2\n0.5 0 0\n"
    "4 0 1 2 3\n5 0 5 1 2 3\n3 0 5 1\n";

static void read_file(struct reading *r, const char *path, const char *format) {
  reading_init(r);
  r->status = scene_read(&r->scene, path, format, &r->diagnostics, &r->error);
}

static void assert_read(const struct reading *r) {
  if (r->status != RECTO_OK)
    fail_msg("%s: %s", r->error.file, r->error.text);
  assert_null(reading_fault(&r->scene));
}

static void polygons_stay_polygons(void **state) {
  struct reading r;
  read_file(&r, temporary_file(state, "a.off", off, sizeof off - 1), NULL);
  assert_read(&r);
  assert_int_equal(scene_face_count(&r.scene), 2);
  assert_int_equal(scene_face_start(&r.scene, 1), 4);
  assert_int_equal(scene_face_start(&r.scene, 2), 9);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_ZERO_AREA], 1);
  const struct scene_point *p = &r.scene.point.item[r.scene.corner.item[5]];
  assert_true(p->x == 0.5 && p->y == 0 && p->z == 0);
  reading_fini(&r);
}

static void bytes_come_through_a_pipe_too(void **state) {
  struct reading r;
  read_file(&r, temporary_file(state, "plain", off, sizeof off - 1), "off");
  assert_read(&r);
  assert_int_equal(scene_face_count(&r.scene), 2);
  reading_fini(&r);
}

static void bytes_of_no_format_name_no_file_that_is_not_there(void **state) {
  struct reading r;
  read_file(&r, temporary_file(state, "plain", "none", 4), "glb");
  assert_int_equal(r.status, RECTO_ERROR_FORMAT);
  assert_null(strstr(r.error.text, "$$$"));
  reading_fini(&r);
}

/* A box of Collada: a node turned, moved and scaled within another. */
static const char dae[] =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\""
    " version=\"1.4.1\">\n"
    "<asset><up_axis>Y_UP</up_axis></asset>\n"
    "<library_geometries><geometry id=\"g\" name=\"quad\"><mesh>\n"
    "<source id=\"p\"><float_array id=\"pa\" count=\"12\">"
    "0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>"
    "<accessor source=\"#pa\" count=\"4\" stride=\"3\">"
    "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
    "<param name=\"Z\" type=\"float\"/></accessor></technique_common>"
    "</source>\n"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/>"
    "</vertices>\n"
    "<polylist count=\"1\"><input semantic=\"VERTEX\" source=\"#v\""
    " offset=\"0\"/><vcount>4</vcount><p>0 1 2 3</p></polylist>\n"
    "</mesh></geometry></library_geometries>\n"
    "<library_visual_scenes><visual_scene id=\"s\">\n"
    "<node id=\"outer\" name=\"outer\"><translate>10 0 0</translate>\n"
    "<node id=\"one\" name=\"one\"><scale>2 2 2</scale>"
    "<instance_geometry url=\"#g\"/></node>\n"
    "<node id=\"two\" name=\"two\"><translate>0 0 5</translate>"
    "<instance_geometry url=\"#g\"/></node>\n"
    "</node></visual_scene></library_visual_scenes>\n"
    "<scene><instance_visual_scene url=\"#s\"/></scene>\n</COLLADA>\n";

static void nodes_are_groups_with_their_transforms(void **state) {
  struct reading r;
  read_file(&r, temporary_file(state, "a.dae", dae, sizeof dae - 1), NULL);
  assert_read(&r);
  assert_int_equal(scene_face_count(&r.scene), 2);
  assert_int_equal(r.scene.group.count, 2);
  assert_memory_equal(r.scene.group.item[0].name, "one", 3);
  assert_memory_equal(r.scene.group.item[1].name, "two", 3);
  const struct scene_point *p = r.scene.point.item;
  const uint32_t *c = r.scene.corner.item;
  assert_true(p[c[0]].x == 10 && p[c[0]].y == 0 && p[c[0]].z == 0);
  assert_true(p[c[2]].x == 12 && p[c[2]].y == 2 && p[c[2]].z == 0);
  assert_true(p[c[6]].x == 11 && p[c[6]].y == 1 && p[c[6]].z == 5);
  reading_fini(&r);
}

static void what_is_not_finite_is_skipped(void **state) {
  static const char text[] =
      "OFF\n4 2 0\nnan 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 1 2 3\n";
  struct reading r;
  read_file(&r, temporary_file(state, "a.off", text, sizeof text - 1), NULL);
  assert_read(&r);
  assert_int_equal(scene_face_count(&r.scene), 1);
  assert_true(r.diagnostics.count[SCENE_FAULT_NOT_FINITE] >= 2);
  reading_fini(&r);
}

/* Assimp leaves out faces of OFF files with more than nine corners. */
static void what_is_left_out_is_warned_about(void **state) {
  static const char text[] =
      "OFF\n10 2 0\n0 0 0\n1 0 0\n2 1 0\n3 3 0\n3 5 0\n2 6 0\n1 6 0\n"
      "0 5 0\n-1 3 0\n-1 1 0\n10 0 1 2 3 4 5 6 7 8 9\n3 0 1 2\n";
  struct reading r;
  read_file(&r, temporary_file(state, "a.off", text, sizeof text - 1), NULL);
  assert_read(&r);
  if (scene_face_count(&r.scene) < 2)
    assert_true(r.diagnostics.count[SCENE_FAULT_SYNTAX] >= 1);
  reading_fini(&r);
  read_file(&r, temporary_file(state, "a.off", off, sizeof off - 1), NULL);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_SYNTAX], 0);
  reading_fini(&r);
}

static void a_broken_file_is_an_error(void **state) {
  struct reading r;
  static const char text[] = "not a polygon file";
  read_file(&r, temporary_file(state, "a.dae", text, sizeof text - 1), NULL);
  assert_int_equal(r.status, RECTO_ERROR_FORMAT);
  assert_int_equal(r.error.code, RECTO_ERROR_FORMAT);
  assert_non_null(strstr(r.error.file, "a.dae"));
  assert_true(*r.error.text);
  assert_int_equal(r.scene.point.count, 0);
  reading_fini(&r);
  /* Cut off in its points. */
  read_file(&r, temporary_file(state, "a.dae", dae, 600), NULL);
  assert_int_equal(r.status, RECTO_ERROR_FORMAT);
  reading_fini(&r);
}

static void our_own_readers_come_first(void **state) {
  static const char text[] = "v 0 0 0\nv 1 0 0.1000000000000000055\n"
                             "v 0 1 0\nf 1 2 3\n";
  struct reading r;
  read_file(&r, temporary_file(state, "a.obj", text, sizeof text - 1), NULL);
  assert_read(&r);
  assert_true(r.scene.point.item[1].z == 0.1); /* not in single precision */
  reading_fini(&r);
}

static void running_out_of_memory_is_an_error(void **state) {
  const char *path = temporary_file(state, "a.dae", dae, sizeof dae - 1);
  struct memory_faults faults = {.least = 5};
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    reading_init(&r);
    memory_faults_begin(&faults);
    recto_status status = scene_read(&r.scene, path, NULL, NULL, &r.error);
    memory_faults_end(&faults, status);
    assert_null(reading_fault(&r.scene));
    if (status != RECTO_OK)
      assert_int_equal(r.scene.point.count, 0);
    reading_fini(&r);
  }
}

int main(void) {
#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)
  const struct CMUnitTest tests[] = {
      T(polygons_stay_polygons),
      T(bytes_come_through_a_pipe_too),
      T(bytes_of_no_format_name_no_file_that_is_not_there),
      T(nodes_are_groups_with_their_transforms),
      T(what_is_not_finite_is_skipped),
      T(what_is_left_out_is_warned_about),
      T(a_broken_file_is_an_error),
      T(our_own_readers_come_first),
      T(running_out_of_memory_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
