/* test_scene.c - the scene keeps its invariants, whatever is added to it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/stream.h"
#include "scene/name.h"
#include "scene/read.h"
#include "scene/scene.h"
#include "scene/triangulation/self_intersection.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"
#include "tests/scenes/write_obj.h"

static int set_up(void **state) {
  static struct reading reading;
  reading_init(&reading);
  *state = &reading;
  return 0;
}

static int tear_down(void **state) {
  struct reading *reading = *state;
  mem_fail_after(0);
  const char *fault = reading_fault(&reading->scene);
  if (fault != NULL)
    print_error("%s\n", fault);
  reading_fini(reading);
  return fault ? -1 : 0;
}

static void add_point(struct reading *r, double x, double y, double z) {
  struct scene_point point = {x, y, z};
  assert_true(ARRAY_PUSH(&r->scene.point, point));
}

/* Adds a face whose corners are these points, each with an index of its
 * own. */
static void add_polygon(struct reading *r, const double (*point)[3],
                        uint32_t count) {
  uint32_t *corner = calloc(count, sizeof *corner);
  assert_non_null(corner);
  for (uint32_t i = 0; i < count; i++) {
    corner[i] = (uint32_t)r->scene.point.count;
    add_point(r, point[i][0], point[i][1], point[i][2]);
  }
  recto_status status =
      scene_add_face(&r->scene, corner, count, 7, &r->diagnostics, &r->error);
  free(corner);
  assert_int_equal(status, RECTO_OK);
}

#define POLYGON(r, ...)                                                        \
  add_polygon((r), (const double[][3])__VA_ARGS__,                             \
              sizeof((const double[][3])__VA_ARGS__) / (3 * sizeof(double)))

static void assert_fault(const struct reading *r, enum scene_fault fault,
                         unsigned long count) {
  for (int i = 0; i < SCENE_FAULT_COUNT; i++)
    assert_int_equal(r->diagnostics.count[i], i == (int)fault ? count : 0);
}

/* ---- Groups -------------------------------------------------------------- */

static void a_face_without_a_group_gets_one(void **state) {
  struct reading *r = *state;
  assert_int_equal(r->scene.group.count, 0);
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  assert_int_equal(r->scene.group.count, 1);
  assert_string_equal(r->scene.group.item[0].name, "default");
  assert_int_equal(scene_face_group(&r->scene, 0), 0);
}

static void use_group(struct reading *r, const char *name) {
  assert_int_equal(scene_use_group(&r->scene, name, strlen(name), &r->error),
                   RECTO_OK);
}

/* Triangles of one group take no memory for where they begin, nor for the
 * group. */
static void only_what_differs_is_stored_of_faces(void **state) {
  struct reading *r = *state;
  struct scene_snapshot triangles;
  for (int i = 0; i < 3; i++)
    POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  assert_null(r->scene.face_start.item);
  assert_null(r->scene.face_group.item);
  assert_int_equal(scene_face_start(&r->scene, 3), 9);
  scene_snapshot(&r->scene, &triangles);
  for (int round = 0; round < 2; round++) {
    POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    use_group(r, "other");
    POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    static const uint32_t start[] = {0, 3, 6, 9, 13, 16};
    for (uint32_t f = 0; f < 5; f++) {
      assert_int_equal(scene_face_start(&r->scene, f), start[f]);
      assert_int_equal(scene_face_corners(&r->scene, f),
                       start[f + 1] - start[f]);
      assert_int_equal(scene_face_group(&r->scene, f), f == 4);
    }
    assert_null(reading_fault(&r->scene));
    scene_restore(&r->scene, &triangles);
    assert_int_equal(scene_face_count(&r->scene), 3);
    assert_null(reading_fault(&r->scene));
  }
}

static void a_name_is_one_group(void **state) {
  struct reading *r = *state;
  char name[32];
  for (int round = 0; round < 2; round++)
    for (uint32_t i = 0; i < 5000; i++) {
      int length = snprintf(name, sizeof name, "group %u", i);
      assert_int_equal(scene_use_group(&r->scene, name, (size_t)length, NULL),
                       RECTO_OK);
      assert_int_equal(r->scene.current_group, i);
    }
  assert_int_equal(r->scene.group.count, 5000);
  assert_string_equal(r->scene.group.item[4999].name, "group 4999");
  /* The beginning of a name is another name. */
  assert_int_equal(scene_use_group(&r->scene, "group 1234", 8, NULL), RECTO_OK);
  assert_int_equal(r->scene.current_group, 12);
}

/* Two faces, one before the file names a group, and one in `group`. */
static void read_file_with_group(struct reading *r, const char *path,
                                 const char *group) {
  char text[100];
  int length =
      snprintf(text, sizeof text,
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng %s\nf 1 2 3\n", group);
  assert_int_equal(scene_read_memory(&r->scene, text, (size_t)length, path,
                                     "obj", NULL, NULL),
                   RECTO_OK);
}

/* A part that is read before the others does not become one with them, and what
 * has no name in a file is called as the file. */
static void files_have_groups_of_their_own(void **state) {
  static const char *const row[][4] = {
      /* path, group; names of both faces' groups */
      {"parts/left.obj", "wheel", "left", "wheel"},
      {"right.obj.gz", "wheel", "right", "right/wheel"},
      {"other/left.obj", "left", "left.2", "left.2"},
      {"right.stl", "wheel", "right.2", "right/wheel.2"},
      {".obj", "right/wheel", ".obj", ".obj/right/wheel"},
      {"-", "left", "default", "left.3"},
      {"/dev/stdin", "x", "default.2", "x"},
      {"", "y", "default.3", "y"},
      {"B\xfctte", "\xfc", "B\xc3\xbctte", "\xc3\xbc"},
      {"B\xfctte", "\xfc", "B\xc3\xbctte.2", "B\xc3\xbctte/\xc3\xbc"}};
  struct reading *r = *state;
  for (uint32_t i = 0; i < sizeof row / sizeof *row; i++) {
    read_file_with_group(r, row[i][0], row[i][1]);
    for (uint32_t k = 0; k < 2; k++) {
      uint32_t group = scene_face_group(&r->scene, 2 * i + k);
      assert_string_equal(r->scene.group.item[group].name, row[i][2 + k]);
    }
  }
}

static void clean(const char *name, const char *expected) {
  char to[200];
  size_t length = name_clean(name, strlen(name), to);
  to[length] = '\0';
  assert_string_equal(to, expected);
}

static void names_become_clean_utf_8(void **state) {
  (void)state;
  clean("plain name_1", "plain name_1");
  clean("\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80", "\xc3\xa4\xe2\x82\xac\xf0\x9f"
                                                "\x98\x80");
  clean("Bl\xfctte", "Bl\xc3\xbctte");   /* Latin-1 */
  clean("a\tb\x1b\x7f", "a?b??");        /* control characters */
  clean("\xc2\x80", "\xc3\x82?");        /* another of those */
  clean("\xc0\xaf", "\xc3\x80\xc2\xaf"); /* longer than needed */
  clean("\xe0\x80\xaf", "\xc3\xa0?\xc2\xaf");
  clean("\xed\xa0\x80", "\xc3\xad\xc2\xa0?");        /* a surrogate */
  clean("\xef\xbf\xbf", "\xc3\xaf\xc2\xbf\xc2\xbf"); /* no character */
  clean("\xf4\x90\x80\x80", "\xc3\xb4???");          /* beyond the last */
  clean("cut \xe2\x82", "cut \xc3\xa2?");
}

/* ---- Faces --------------------------------------------------------------- */

static void a_sound_face_is_kept_as_it_is(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  POLYGON(r, {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}); /* concave */
  POLYGON(r, {{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}});
  POLYGON(r, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}});
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}); /* straight at 1 */
  POLYGON(r, {{0, 0, 0}, {1, 0, 2}, {1, 1, 0}, {0, 1, 2}}); /* warped */
  assert_fault(r, SCENE_FAULT_COUNT, 0);
  assert_int_equal(scene_face_count(&r->scene), 7);
  for (uint32_t i = 0; i < r->scene.corner.count; i++)
    assert_int_equal(r->scene.corner.item[i], i);
}

static void repeated_corners_are_left_out(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}});
  POLYGON(r, {{0, 0, 0},
              {1, 0, 0},
              {1, 0, 0},
              {1, 0, 0},
              {0, 1, 0},
              {0, 0, 0},
              {0, 0, 0}});
  assert_fault(r, SCENE_FAULT_COUNT, 0);
  assert_int_equal(scene_face_count(&r->scene), 3);
  assert_int_equal(r->scene.corner.count, 9);
  static const uint32_t kept[9] = {0, 2, 3, 4, 5, 6, 8, 9, 12};
  assert_memory_equal(r->scene.corner.item, kept, sizeof kept);
}

static void fewer_than_three_distinct_corners_are_no_face(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{1, 2, 3}});
  POLYGON(r, {{1, 2, 3}, {3, 4, 5}});
  POLYGON(r, {{1, 2, 3}, {3, 4, 5}, {1, 2, 3}});
  POLYGON(r, {{1, 2, 3}, {3, 4, 5}, {1, 2, 3}, {3, 4, 5}});
  POLYGON(r, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  assert_fault(r, SCENE_FAULT_FEW_CORNERS, 5);
  assert_int_equal(scene_face_count(&r->scene), 0);
  assert_int_equal(scene_add_face(&r->scene, NULL, 0, 1, NULL, NULL), RECTO_OK);
  assert_int_equal(scene_face_count(&r->scene), 0);
}

/* Reported: such a face has three corners and no line goes through them. */
static void a_path_there_and_back_is_no_face(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  POLYGON(r, {{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  POLYGON(r,
          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 9, 9}, {1, 1, 0}, {1, 0, 0}});
  POLYGON(r,
          {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}});
  assert_fault(r, SCENE_FAULT_ZERO_AREA, 4);
  assert_int_equal(scene_face_count(&r->scene), 0);
  /* Something is left of these. */
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}});
  POLYGON(r, {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}});
  assert_int_equal(scene_face_count(&r->scene), 2);
}

static void corners_of_a_face_at_one_place_are_one_point(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}});
  static const uint32_t kept[5] = {0, 1, 2, 1, 4};
  assert_int_equal(r->scene.corner.count, 5);
  assert_memory_equal(r->scene.corner.item, kept, sizeof kept);
}

static void corners_on_one_line_are_no_face(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  POLYGON(r, {{0, 0, 0}, {1, 2, 3}, {-2, -4, -6}});
  POLYGON(r, {{5, 5, 5}, {6, 6, 6}, {7, 7, 7}, {5.5, 5.5, 5.5}});
  /* Thirds that are rounded alike, so the line is exact. */
  POLYGON(r, {{0, 0, 1.0 / 3}, {1.0 / 3, 1.0 / 3, 1.0 / 3}, {1, 1, 1.0 / 3}});
  POLYGON(r, {{0, 0, 0}, {0x1p-1074, 0, 0}, {0x1p1023, 0, 0}});
  assert_fault(r, SCENE_FAULT_ZERO_AREA, 5);
  assert_int_equal(scene_face_count(&r->scene), 0);
}

/* However little that is, and at any scale. */
static void a_face_with_area_is_kept(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {0.1, 0.7, 0}, {0.3, 2.1, 0}}); /* rounded */
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {2, 0x1p-1074, 0}});
  POLYGON(r, {{1e7, 1e7, 0}, {1e7 + 0x1p-29, 1e7, 0}, {1e7, 1e7 + 0x1p-29, 0}});
  POLYGON(r, {{0, 0, 0}, {0x1p-1074, 0, 0}, {0, 0x1p-1074, 0}});
  POLYGON(r, {{-0x1p1023, 0, 0}, {0x1p1023, 1, 0}, {0, 0x1p-1074, 0}});
  assert_fault(r, SCENE_FAULT_COUNT, 0);
  assert_int_equal(scene_face_count(&r->scene), 5);
}

static void an_index_out_of_range_is_no_face(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  static const uint32_t beyond[] = {0, 1, 3}, none[] = {0, SCENE_NONE, 1};
  assert_int_equal(
      scene_add_face(&r->scene, beyond, 3, 9, &r->diagnostics, NULL), RECTO_OK);
  assert_int_equal(scene_add_wire(&r->scene, none, 3, 9, &r->diagnostics, NULL),
                   RECTO_OK);
  assert_fault(r, SCENE_FAULT_INDEX, 2);
  assert_int_equal(scene_face_count(&r->scene), 1);
  assert_int_equal(scene_wire_count(&r->scene), 0);
}

/* ---- Bow-ties ------------------------------------------------------------ */

static void a_bow_tie_is_kept_with_a_warning(void **state) {
  struct reading *r = *state;
  POLYGON(r, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});
  POLYGON(r, {{0, 0, 0}, {3, 2, 0}, {3, 0, 0}, {0, 1, 0}});
  POLYGON(r, {{0, 0, 0}, {0, 1, 1}, {0, 1, 0}, {0, 0, 1}}); /* seen along x */
  POLYGON(r, {{0, 5, 0}, {1, 5, 1}, {1, 5, 0}, {0, 5, 1}}); /* along y */
  POLYGON(r, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, -1, 0}, {0, 4, 0}});
  assert_fault(r, SCENE_FAULT_BOW_TIE, 5);
  assert_int_equal(scene_face_count(&r->scene), 5);
  assert_string_equal(r->warning[0], "7: face whose sides cross each other");
}

/* What a strictly convex polygon is, and what is not one: a star that goes
 * round twice, a corner on a side, one at the place of another, a dent. */
static void only_convex_polygons_are_strictly_convex(void **state) {
  struct reading *r = *state;
  enum { CIRCLE, STAR, TWICE, DENT, KINDS };
  for (uint32_t count = 5; count <= 40; count++)
    for (int kind = 0; kind < KINDS; kind++) {
      double point[40][3];
      uint32_t corner[40];
      uint32_t step = kind == STAR ? 2 : 1,
               before = (uint32_t)r->scene.point.count;
      for (uint32_t i = 0; i < count; i++) {
        double angle = 2 * 3.14159265358979 * step * i / count;
        point[i][0] = cos(angle);
        point[i][1] = sin(angle);
        point[i][2] = 0.25 * cos(angle) + 1;
        corner[i] = before + i;
      }
      for (int k = 0; k < 3; k++)
        point[3][k] = kind == TWICE  ? point[1][k]
                      : kind == DENT ? (k == 2 ? 1 : 0)
                                     : point[3][k];
      for (uint32_t i = 0; i < count; i++)
        add_point(r, point[i][0], point[i][1], point[i][2]);
      bool expected = kind == CIRCLE;
      assert_int_equal(polygon_is_strictly_convex(&r->scene, corner, count),
                       expected && count <= 32);
    }
  static const double straight[][3] = {
      {0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  uint32_t corner[5];
  for (uint32_t i = 0; i < 5; i++) {
    corner[i] = (uint32_t)r->scene.point.count;
    add_point(r, straight[i][0], straight[i][1], straight[i][2]);
  }
  assert_false(polygon_is_strictly_convex(&r->scene, corner, 5));
}

/* Corners at one position are one point, also of many corners. */
static void corners_at_one_position_are_united(void **state) {
  struct reading *r = *state;
  static const double pinched[][3] = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0},
                                      {2, 1, 0}, {4, 4, 0}, {0, 4, 0},
                                      {2, 1, 0}};
  add_polygon(r, pinched, 7);
  assert_int_equal(r->scene.corner.count, 7);
  assert_int_equal(r->scene.corner.item[3], r->scene.corner.item[6]);
}

/* A star of `count` corners around a circle, each side `step` corners wide:
 * one without crossings for a step of 1. */
static bool star_crosses(uint32_t count, uint32_t step, double tilt) {
  struct reading r;
  reading_init(&r);
  uint32_t *corner = calloc(count, sizeof *corner);
  assert_non_null(corner);
  for (uint32_t i = 0; i < count; i++) {
    double angle = 2 * 3.14159265358979 * i / count;
    add_point(&r, cos(angle), sin(angle) * cos(tilt), sin(angle) * sin(tilt));
    corner[i] = (uint32_t)((uint64_t)i * step % count);
  }
  bool answer = polygon_intersects_itself(&r.scene, corner, count);
  free(corner);
  reading_fini(&r);
  return answer;
}

/* A star of five corners, gone around 2,000 times: more tests of equal sides
 * than are made, if each counted. */
static void a_star_gone_around_very_often_crosses(void **state) {
  struct reading *r = *state;
  enum { PLACES = 5, CORNERS = 2000 * PLACES };
  static uint32_t corner[CORNERS];
  for (uint32_t i = 0; i < PLACES; i++) {
    double angle = 2 * 3.14159265358979 * i / PLACES;
    add_point(r, cos(angle), sin(angle), 0);
  }
  for (uint32_t i = 0; i < CORNERS; i++)
    corner[i] = 2 * i % PLACES;
  assert_true(polygon_intersects_itself(&r->scene, corner, CORNERS));
}

static void stars_cross_and_circles_do_not(void **state) {
  (void)state;
  for (int k = 0; k < 7; k++) {
    double tilt = k * 0.5;
    assert_true(star_crosses(5, 2, tilt));
    assert_true(star_crosses(33, 2, tilt));
    assert_true(star_crosses(101, 50, tilt));
    assert_false(star_crosses(5, 1, tilt));
    assert_false(star_crosses(32, 1, tilt));
    assert_false(star_crosses(1000, 1, tilt));
    assert_false(star_crosses(1000, 999, tilt));
  }
}

/* Two sides that share a corner or touch do not cross. */
static void touching_sides_do_not_cross(void **state) {
  struct reading *r = *state;
  /* A ring whose hole is joined to the outside by a bridge walked twice. */
  POLYGON(r, {{0, 0, 0},
              {9, 0, 0},
              {9, 9, 0},
              {0, 9, 0},
              {0, 0, 0},
              {3, 3, 0},
              {3, 6, 0},
              {6, 6, 0},
              {6, 3, 0},
              {3, 3, 0}});
  /* Two squares that meet in a corner. */
  POLYGON(r, {{0, 0, 0},
              {1, 0, 0},
              {1, 1, 0},
              {2, 1, 0},
              {2, 2, 0},
              {1, 2, 0},
              {1, 1, 0},
              {0, 1, 0}});
  assert_fault(r, SCENE_FAULT_COUNT, 0);
  assert_int_equal(scene_face_count(&r->scene), 2);
}

/* All pairs of sides, without any of the shortcuts. */
static bool judge_crossing(const double (*p)[2], int n) {
  for (int i = 0; i < n; i++)
    for (int k = i + 2; k < n; k++) {
      const double *a = p[i], *b = p[(i + 1) % n], *c = p[k],
                   *d = p[(k + 1) % n];
      double abc =
          (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      double abd =
          (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
      double cda =
          (d[0] - c[0]) * (a[1] - c[1]) - (d[1] - c[1]) * (a[0] - c[0]);
      double cdb =
          (d[0] - c[0]) * (b[1] - c[1]) - (d[1] - c[1]) * (b[0] - c[0]);
      if (abc * abd < 0 && cda * cdb < 0)
        return true;
    }
  return false;
}

static bool same_place(const double a[2], const double b[2]) {
  return a[0] == b[0] && a[1] == b[1];
}

/* On small whole numbers, where doubles are exact. */
static void polygons_cross_where_two_sides_do(void **state) {
  struct reading *r = *state;
  struct random random = {1};
  int yes = 0;
  for (int i = 0; i < 20000; i++) {
    double flat[12][2];
    uint32_t corner[12];
    uint32_t n = 3 + random_below(&random, 6);
    r->scene.point.count = 0;
    for (uint32_t k = 0; k < n; k++) {
      const double *before = flat[k ? k - 1 : 0], *first = flat[0];
      do {
        flat[k][0] = random_int(&random, 0, 6);
        flat[k][1] = random_int(&random, 0, 6);
      } while ((k > 0 && same_place(flat[k], before)) ||
               (k == n - 1 && same_place(flat[k], first)));
      add_point(r, flat[k][0], flat[k][1], flat[k][0] * 0.25);
      corner[k] = k;
    }
    bool expected = judge_crossing((const double(*)[2])flat, (int)n);
    assert_int_equal(polygon_intersects_itself(&r->scene, corner, n), expected);
    yes += expected;
  }
  assert_true(yes > 2000 && yes < 18000);
}

/* A comb whose teeth are all active at once has a quarter of a million pairs
 * of sides at 1,000 and would take minutes at 100,000. */
static void a_huge_comb_takes_bounded_time(void **state) {
  struct reading *r = *state;
  enum { TEETH = 50000 };
  uint32_t *corner = calloc(2 * TEETH + 2, sizeof *corner), count = 0;
  assert_non_null(corner);
  for (int i = 0; i < TEETH; i++) {
    add_point(r, i % 2 ? 1 : 0, i, 0);
    add_point(r, i % 2 ? 0 : 1, i + 0.5, 0);
  }
  add_point(r, -1, TEETH, 0);
  add_point(r, -1, -1, 0);
  for (; count < 2 * TEETH + 2; count++)
    corner[count] = count;
  assert_int_equal(
      scene_add_face(&r->scene, corner, count, 1, &r->diagnostics, NULL),
      RECTO_OK);
  free(corner);
  assert_int_equal(scene_face_count(&r->scene), 1);
  assert_fault(r, SCENE_FAULT_COUNT, 0);
}

/* ---- Polylines ----------------------------------------------------------- */

static void polylines_keep_two_distinct_points_at_least(void **state) {
  struct reading *r = *state;
  static const uint32_t lines[][4] = {{0, 1, 2, 0}, {0, 0, 1, 1}, {2, 2, 2, 3}};
  add_point(r, 0, 0, 0);
  add_point(r, 1, 0, 0);
  add_point(r, 1, 1, 0);
  add_point(r, 1, 1, 0);
  for (int i = 0; i < 3; i++)
    assert_int_equal(
        scene_add_wire(&r->scene, lines[i], 4, 1, &r->diagnostics, NULL),
        RECTO_OK);
  assert_int_equal(
      scene_add_wire(&r->scene, lines[0], 1, 1, &r->diagnostics, NULL),
      RECTO_OK);
  assert_fault(r, SCENE_FAULT_FEW_CORNERS, 2);
  assert_int_equal(scene_wire_count(&r->scene), 2);
  static const uint32_t start[3] = {0, 4, 6}, corner[6] = {0, 1, 2, 0, 0, 1};
  assert_memory_equal(r->scene.wire_start.item, start, sizeof start);
  assert_memory_equal(r->scene.wire_corner.item, corner, sizeof corner);
}

/* ---- Diagnostics --------------------------------------------------------- */

static void three_of_a_kind_are_reported_and_the_rest_counted(void **state) {
  struct reading *r = *state;
  for (unsigned long line = 1; line <= 10; line++)
    diagnostics_fault(&r->diagnostics, SCENE_FAULT_INDEX, line, "bad %lu",
                      line);
  diagnostics_fault(&r->diagnostics, SCENE_FAULT_SYNTAX, 11, "odd");
  diagnostics_fault(&r->diagnostics, SCENE_FAULT_WARPED, 12, "bent");
  assert_int_equal(r->warnings, 4);
  diagnostics_finish(&r->diagnostics);
  diagnostics_finish(&r->diagnostics);
  assert_int_equal(r->warnings, 5);
  assert_string_equal(r->warning[0], "1: bad 1");
  assert_string_equal(r->warning[2], "3: bad 3");
  assert_string_equal(r->warning[3], "11: odd");
  assert_string_equal(r->warning[4],
                      "0: ... and 7 more with indices out of range");
  assert_int_equal(r->diagnostics.count[SCENE_FAULT_INDEX], 10);
  assert_int_equal(r->diagnostics.count[SCENE_FAULT_WARPED], 1);
}

static void the_next_file_is_reported_anew(void **state) {
  struct reading *r = *state;
  for (int file = 0; file < 2; file++) {
    for (int i = 0; i < 4; i++)
      diagnostics_fault(&r->diagnostics, SCENE_FAULT_ZERO_AREA, 1, "thin");
    diagnostics_finish(&r->diagnostics);
  }
  assert_int_equal(r->warnings, 8);
  assert_int_equal(r->diagnostics.count[SCENE_FAULT_ZERO_AREA], 8);
  diagnostics_fault(NULL, SCENE_FAULT_INDEX, 1, "nobody");
  diagnostics_finish(NULL);
}

/* ---- Going back ---------------------------------------------------------- */

static void a_snapshot_restores_the_scene(void **state) {
  struct reading *r = *state;
  struct reading fresh;
  struct scene_snapshot empty, mark;
  scene_snapshot(&r->scene, &empty);
  static const uint32_t line[] = {0, 1};
  for (int round = 0; round < 3; round++) {
    assert_int_equal(scene_use_group(&r->scene, "first", 5, NULL), RECTO_OK);
    POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    scene_snapshot(&r->scene, &mark);
    assert_int_equal(scene_use_group(&r->scene, "second", 6, NULL), RECTO_OK);
    POLYGON(r, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    assert_int_equal(scene_add_wire(&r->scene, line, 2, 1, NULL, NULL),
                     RECTO_OK);
    scene_restore(&r->scene, &mark);
    assert_null(reading_fault(&r->scene));
    assert_int_equal(r->scene.point.count, 3);
    assert_int_equal(scene_face_count(&r->scene), 1);
    assert_int_equal(scene_wire_count(&r->scene), 0);
    assert_int_equal(r->scene.group.count, 1);
    assert_int_equal(r->scene.current_group, 0);
    scene_restore(&r->scene, &empty);
    reading_init(&fresh);
    assert_true(reading_same(&r->scene, &fresh.scene));
    reading_fini(&fresh);
  }
}

/* ---- Memory -------------------------------------------------------------- */

static recto_status build(struct scene *scene, recto_error *error) {
  static const uint32_t face[] = {0, 1, 2, 3}, line[] = {0, 2};
  for (int i = 0; i < 4; i++) {
    struct scene_point point = {i % 2, i / 2, 0};
    if (!ARRAY_PUSH(&scene->point, point))
      return error_memory(error);
  }
  recto_status status = RECTO_OK;
  for (int i = 0; i < 40 && status == RECTO_OK; i++) {
    char name[8];
    size_t length = (size_t)snprintf(name, sizeof name, "g%d", i);
    status = scene_use_group(scene, name, length, error);
    if (status == RECTO_OK)
      status = scene_add_face(scene, face, 3, 1, NULL, error);
    if (status == RECTO_OK)
      status = scene_add_wire(scene, line, 2, 1, NULL, error);
  }
  return status;
}

static void running_out_of_memory_leaves_a_sound_scene(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 50};
  while (memory_faults_go_on(&faults)) {
    struct scene scene;
    recto_error error = {.code = RECTO_OK};
    scene_init(&scene);
    memory_faults_begin(&faults);
    recto_status status = build(&scene, &error);
    memory_faults_end(&faults, status);
    assert_int_equal(error.code, status);
    assert_null(reading_fault(&scene));
    scene_fini(&scene);
  }
}

/* ---- Writing ------------------------------------------------------------- */

static void what_is_written_reads_back_the_same(void **state) {
  struct reading *r = *state;
  struct random random = {3};
  static const char *const names[] = {"a", "with space", "\xc3\xa4/b", "a"};
  for (int i = 0; i < 500; i++)
    add_point(
        r, random_between(&random, -1, 1),
        ldexp(random_between(&random, -1, 1), random_int(&random, -60, 60)),
        i * 0.1);
  for (int i = 0; i < 300; i++) {
    const char *name = names[random_below(&random, 4)];
    assert_int_equal(scene_use_group(&r->scene, name, strlen(name), NULL),
                     RECTO_OK);
    uint32_t corner[9], n = 3 + random_below(&random, 7);
    for (uint32_t k = 0; k < n; k++)
      corner[k] = random_below(&random, 500);
    assert_int_equal(scene_add_face(&r->scene, corner, n, 1, NULL, NULL),
                     RECTO_OK);
    assert_int_equal(scene_add_wire(&r->scene, corner, n, 1, NULL, NULL),
                     RECTO_OK);
  }
  struct stream *stream;
  size_t count;
  assert_int_equal(stream_open_memory(&stream, NULL), RECTO_OK);
  scene_write_obj(&r->scene, stream);
  const char *text = stream_memory(stream, &count);
  struct reading again;
  reading_init(&again);
  assert_int_equal(reading_bytes(&again, &reader_obj, text, count), RECTO_OK);
  assert_true(reading_same(&r->scene, &again.scene));
  reading_fini(&again);
  stream_discard(stream);
}

static void the_file_is_plain(void **state) {
  struct reading *r = *state;
  struct stream *stream;
  size_t count;
  POLYGON(r, {{0, 0, 0}, {1, 0, 0}, {0.5, -1e-9, 1e300}});
  static const uint32_t line[] = {2, 0};
  assert_int_equal(scene_add_wire(&r->scene, line, 2, 1, NULL, NULL), RECTO_OK);
  assert_int_equal(stream_open_memory(&stream, NULL), RECTO_OK);
  scene_write_obj(&r->scene, stream);
  assert_string_equal(stream_memory(stream, &count),
                      "v 0 0 0\nv 1 0 0\nv 0.5 -1e-9 1e300\n"
                      "g default\nf 1 2 3\nl 3 1\n");
  stream_discard(stream);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      T(a_face_without_a_group_gets_one),
      T(only_what_differs_is_stored_of_faces),
      T(a_name_is_one_group),
      T(files_have_groups_of_their_own),
      T(names_become_clean_utf_8),
      T(a_sound_face_is_kept_as_it_is),
      T(repeated_corners_are_left_out),
      T(fewer_than_three_distinct_corners_are_no_face),
      T(a_path_there_and_back_is_no_face),
      T(corners_of_a_face_at_one_place_are_one_point),
      T(corners_on_one_line_are_no_face),
      T(a_face_with_area_is_kept),
      T(an_index_out_of_range_is_no_face),
      T(only_convex_polygons_are_strictly_convex),
      T(corners_at_one_position_are_united),
      T(a_bow_tie_is_kept_with_a_warning),
      T(stars_cross_and_circles_do_not),
      T(a_star_gone_around_very_often_crosses),
      T(touching_sides_do_not_cross),
      T(polygons_cross_where_two_sides_do),
      T(a_huge_comb_takes_bounded_time),
      T(polylines_keep_two_distinct_points_at_least),
      T(three_of_a_kind_are_reported_and_the_rest_counted),
      T(the_next_file_is_reported_anew),
      T(a_snapshot_restores_the_scene),
      T(running_out_of_memory_leaves_a_sound_scene),
      T(what_is_written_reads_back_the_same),
      T(the_file_is_plain),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
