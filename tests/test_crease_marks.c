/* test_crease_marks.c - normals and smoothing groups of OBJ files mark the
 * edges that they should, and count where they mean something. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/corner_normals.h"
#include "scene/edges/crease_marks.h"
#include "scene/edges/edge_classes.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"

/* ---- Prisms -------------------------------------------------------------- */

enum { ROOM = 1 << 16 };

/* What the file of a prism says. */
enum prism_marks {
  PRISM_GROUPS,           /* its sides are of one group, each cap of another */
  PRISM_HALVES,           /* the same, but half of the sides of a group */
  PRISM_ONE_GROUP,        /* all of it is of one */
  PRISM_OFF,              /* of none */
  PRISM_NORMALS,          /* as PRISM_GROUPS, by normals */
  PRISM_SPLIT,            /* the same, by points at the same places */
  PRISM_FLAT_NORMALS,     /* all faces have their own */
  PRISM_SMOOTH_NORMALS,   /* all points have one */
  PRISM_NORMALS_AND_GROUP /* as PRISM_NORMALS, and all of it of one group */
};

struct prism {
  char text[ROOM], *to;
  int sides, off; /* so many of the sides are of no group */
  enum prism_marks marks;
};

static bool has_normals(const struct prism *p) {
  return p->marks >= PRISM_NORMALS;
}

/* A point of the lower cap, one of the upper one, for each side; the same again
 * for the caps where they are split. */
static void put_points(struct prism *p) {
  double turn = 2 * acos(-1) / p->sides;
  for (int i = 0; i < (p->marks == PRISM_SPLIT ? 2 : 1) * p->sides; i++)
    for (int y = 0; y < 2; y++)
      p->to +=
          sprintf(p->to, "v %.9f %d %.9f\n", cos(i * turn), y, sin(i * turn));
}

/* One a point, then one a side, then those of the caps. */
static void put_normals(struct prism *p) {
  double turn = 2 * acos(-1) / p->sides;
  for (int half = 0; half < 2; half++)
    for (int i = 0; i < p->sides; i++)
      p->to += sprintf(p->to, "vn %.4f 0 %.4f\n", cos((i + half / 2.) * turn),
                       sin((i + half / 2.) * turn));
  p->to += sprintf(p->to, "vn 0 -1 0\nvn 0 1 0\n");
}

/* A corner at a number of side, of the lower or the upper cap.
 * face  the number of the side; those of the caps follow */
static void put_corner(struct prism *p, int side, int y, int face) {
  int n = p->sides, at = side % n;
  bool of_cap = face >= n;
  int point = 2 * (at + (p->marks == PRISM_SPLIT && of_cap ? n : 0)) + y + 1;
  int normal = at;
  if (of_cap && p->marks != PRISM_SMOOTH_NORMALS)
    normal = 2 * n + face - n;
  else if (p->marks == PRISM_FLAT_NORMALS)
    normal = n + face;
  p->to += has_normals(p) ? sprintf(p->to, " %d//%d", point, normal + 1)
                          : sprintf(p->to, " %d", point);
}

/* What is said before a face. */
static void put_group(struct prism *p, int face) {
  int group = face < p->sides ? 1 : face - p->sides + 2;
  if (p->marks == PRISM_HALVES && face < p->sides / 2)
    group = 9;
  if (p->marks == PRISM_OFF || face < p->off)
    p->to += sprintf(p->to, "s off\n");
  else if (p->marks == PRISM_ONE_GROUP || p->marks == PRISM_NORMALS_AND_GROUP)
    p->to += sprintf(p->to, "s 7\n");
  else if (!has_normals(p))
    p->to += sprintf(p->to, "s %d\n", group);
}

static const char *write_prism(struct prism *p) {
  int n = p->sides;
  p->to = p->text;
  put_points(p);
  if (has_normals(p))
    put_normals(p);
  for (int face = 0; face < n + 2; face++) {
    put_group(p, face);
    p->to += sprintf(p->to, "f");
    for (int i = 0; i < n && face >= n; i++)
      put_corner(p, face == n ? i : n - 1 - i, face - n, face);
    if (face < n) {
      put_corner(p, face, 0, face);
      put_corner(p, face, 1, face);
      put_corner(p, face + 1, 1, face);
      put_corner(p, face + 1, 0, face);
    }
    p->to += sprintf(p->to, "\n");
  }
  return p->text;
}

/* ---- Marks --------------------------------------------------------------- */

struct counts {
  int hard, soft;
};

static struct counts count_marks(const char *text, recto_crease_marks which,
                                 double crease_deg) {
  struct reading r;
  struct topology topology;
  struct counts counts = {0, 0};
  reading_of(&r, &reader_obj, text);
  assert_int_equal(r.status, RECTO_OK);
  assert_int_equal(r.warnings, 0);
  assert_int_equal(topology_init(&topology, &r.scene, NULL), RECTO_OK);
  assert_true(crease_marks_find(&topology, &r.scene, which, crease_deg));
  for (size_t e = 0; topology.crease_mark && e < topology.edge.count; e++) {
    counts.hard += topology.crease_mark[e] == CREASE_MARK_HARD;
    counts.soft += topology.crease_mark[e] == CREASE_MARK_SOFT;
  }
  topology_fini(&topology);
  reading_fini(&r);
  return counts;
}

static void assert_prism(enum prism_marks marks, int sides, int off,
                         recto_crease_marks which, int hard, int soft) {
  struct prism prism = {.sides = sides, .off = off, .marks = marks};
  struct counts counts = count_marks(write_prism(&prism), which, 30);
  if (counts.hard != hard || counts.soft != soft)
    fail_msg("kind %d, %d sides: %d hard edges and %d smooth, not %d and %d",
             (int)marks, sides, counts.hard, counts.soft, hard, soft);
}

#define ALL RECTO_CREASE_MARKS_ALL
#define AUTO RECTO_CREASE_MARKS_AUTO
#define NONE RECTO_CREASE_MARKS_NONE

static void groups_and_normals_mark_the_same_edges(void **state) {
  (void)state;
  static const enum prism_marks kinds[] = {PRISM_GROUPS, PRISM_NORMALS,
                                           PRISM_SPLIT};
  for (int i = 0; i < 3; i++) {
    assert_prism(kinds[i], 8, 0, AUTO, 16, 8);
    assert_prism(kinds[i], 8, 0, ALL, 16, 8);
    assert_prism(kinds[i], 8, 0, NONE, 0, 0);
  }
}

static void normals_count_before_groups(void **state) {
  (void)state;
  assert_prism(PRISM_NORMALS_AND_GROUP, 8, 0, AUTO, 16, 8);
}

static void one_kind_of_marks_says_nothing(void **state) {
  (void)state;
  assert_prism(PRISM_ONE_GROUP, 8, 0, AUTO, 0, 0);
  assert_prism(PRISM_OFF, 8, 0, AUTO, 0, 0);
  assert_prism(PRISM_FLAT_NORMALS, 8, 0, AUTO, 0, 0);
  assert_prism(PRISM_SMOOTH_NORMALS, 8, 0, AUTO, 0, 0);
  assert_prism(PRISM_ONE_GROUP, 8, 0, ALL, 0, 24);
  assert_prism(PRISM_OFF, 8, 0, ALL, 24, 0);
  assert_prism(PRISM_FLAT_NORMALS, 8, 0, ALL, 24, 0);
  assert_prism(PRISM_SMOOTH_NORMALS, 8, 0, ALL, 0, 24);
}

static void marks_count_about_the_crease_angle(void **state) {
  (void)state;
  /* The sides of four bend by 90 degrees, of sixteen by 22.5. */
  assert_prism(PRISM_GROUPS, 4, 0, AUTO, 8, 0);
  assert_prism(PRISM_GROUPS, 4, 0, ALL, 8, 4);
  assert_prism(PRISM_HALVES, 16, 0, AUTO, 32 + 2, 14);
  assert_prism(PRISM_HALVES, 32, 0, AUTO, 64, 30);
  assert_prism(PRISM_HALVES, 32, 0, ALL, 64 + 2, 30);
}

static void edges_between_flat_faces_count_where_they_are_few(void **state) {
  (void)state;
  assert_prism(PRISM_GROUPS, 16, 2, AUTO, 32 + 3, 13);
  assert_prism(PRISM_GROUPS, 16, 13, AUTO, 32 + 14, 2);
  assert_prism(PRISM_GROUPS, 16, 14, AUTO, 32 + 2, 1);
  assert_prism(PRISM_GROUPS, 16, 14, ALL, 32 + 15, 1);
}

/* A cone of eight sides: the normals of its sides differ at the apex alone. */
static void normals_that_differ_at_one_end_say_nothing(void **state) {
  (void)state;
  char text[4000], *to = text;
  double turn = acos(-1) / 4;
  to += sprintf(to, "v 0 1 0\nvn 0 -1 0\n");
  for (int i = 0; i < 8; i++)
    to += sprintf(to, "v %.9f 0 %.9f\nvn %.4f 1 %.4f\nvn %.4f 1 %.4f\n",
                  cos(i * turn), sin(i * turn), cos(i * turn), sin(i * turn),
                  cos((i + .5) * turn), sin((i + .5) * turn));
  for (int i = 0; i < 8; i++)
    to += sprintf(to, "f 1//%d %d//%d %d//%d\n", 2 * i + 3, (i + 1) % 8 + 2,
                  2 * ((i + 1) % 8) + 2, i + 2, 2 * i + 2);
  sprintf(to, "f 2//1 3//1 4//1 5//1 6//1 7//1 8//1 9//1\n");
  struct counts counts = count_marks(text, ALL, 30);
  assert_int_equal(counts.hard, 8);
  assert_int_equal(counts.soft, 0);
}

#define ROOF                                                                   \
  "v 0 0 0\nv 4 0 0\nv 4 1 2\nv 0 1 2\nv 4 0 4\nv 0 0 4\n"                     \
  "v 8 0 0\nv 8 1 2\nv 8 0 4\nvn 0 1 -1\nvn 0 1 1\n"

static void indices_of_normals_are_those_of_points(void **state) {
  (void)state;
  static const char *const roof[] = {
      ROOF "f 1//1 4//1 3//1 2//1\nf 4//2 6//2 5//2 3//2\n",
      ROOF "f 1/7/-2 4//-2 3//-2 2//+1\nf 4//-1 6//2 5//2 3//2\n",
      ROOF "f 1//1 4//1 3//1\nf 1//1 3//1 2//1\nf 4//2 6//2 3//2\n",
      /* One that is not there yet. */
      ROOF "f 1//1 4//1 3//1 2//3\nf 4//2 6//2 5//2 3//4\nvn 0 1 -1\n"
           "vn 0 1 1\n",
  };
  for (size_t i = 0; i < sizeof roof / sizeof *roof; i++)
    assert_int_equal(count_marks(roof[i], ALL, 60).hard, 1);
}

/* ---- What is wrong with them --------------------------------------------- */

static void assert_warns(const char *text, const char *warning) {
  struct reading r;
  reading_of(&r, &reader_obj, text);
  assert_int_equal(r.status, RECTO_OK);
  assert_int_equal(r.warnings, warning != NULL);
  if (warning != NULL)
    assert_string_equal(r.warning[0], warning);
  assert_null(reading_fault(&r.scene));
  assert_int_equal(scene_face_count(&r.scene), 1);
  reading_fini(&r);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n"

static void what_cannot_be_read_is_told_and_the_face_drawn(void **state) {
  (void)state;
  assert_warns(TRIANGLE "f 1//1 2//1 3//2\n",
               "5: face with normal 2 where there are 1, drawn without "
               "normals");
  assert_warns(TRIANGLE "f 1//1 2//0 3//1\n",
               "5: face with normal 0 where there are 1, drawn without "
               "normals");
  assert_warns(TRIANGLE "f 1//-2 2//1 3//1\n",
               "5: face with normal -2 where there are 1, drawn without "
               "normals");
  assert_warns(TRIANGLE "vn 0 x 1\nf 1//1 2//2 3//1\n",
               "5: normal that cannot be parsed, skipped");
  assert_warns(TRIANGLE "vn 0 inf 1\nf 1//1 2//2 3//1\n",
               "5: normal that is not finite, taken as none");
  assert_warns(TRIANGLE "s two\nf 1 2 3\n",
               "5: smoothing group that cannot be parsed, skipped");
  assert_warns(TRIANGLE "s -1\nf 1 2 3\n",
               "5: smoothing group that cannot be parsed, skipped");
  assert_warns(TRIANGLE "s\nf 1 2 3\n",
               "5: smoothing group that cannot be parsed, skipped");
  assert_warns(TRIANGLE "s 4294967296\nf 1 2 3\n",
               "5: smoothing group that cannot be parsed, skipped");
  assert_warns(TRIANGLE "vn 0 0 0\ns 0 # none\ns on\nf 1/1/2 2/1/ 3//1\n",
               NULL);
}

static void a_repeated_corner_takes_the_normals_of_its_face(void **state) {
  (void)state;
  struct reading r;
  reading_of(&r, &reader_obj,
             ROOF "f 1//1 4//1 3//1 2//1\nf 4//2 6//2 5//2 5//2 3//2\n");
  assert_int_equal(r.scene.corner.count, 8);
  assert_null(reading_fault(&r.scene));
  assert_int_equal(r.scene.corner_normal.count, 8);
  for (uint32_t c = 4; c < 8; c++)
    assert_int_equal(r.scene.corner_normal.item[c], 0);
  reading_fini(&r);
}

static void normals_of_one_a_point_take_four_bytes_a_point(void **state) {
  (void)state;
  struct prism prism = {.sides = 8, .marks = PRISM_SMOOTH_NORMALS};
  struct reading r;
  reading_of(&r, &reader_obj, write_prism(&prism));
  assert_int_equal(r.scene.point_normal.count, 16);
  assert_int_equal(r.scene.corner_normal.count, 0);
  reading_fini(&r);
}

/* Points that come after a face with normals have room for their own. */
static void each_object_of_a_file_has_its_normals(void **state) {
  (void)state;
  enum { OBJECTS = 200 };
  static char text[ROOM];
  char *to = text;
  struct reading r;
  for (int i = 0; i < OBJECTS; i++)
    to += sprintf(to,
                  "o part%d\nv 0 0 %d\nv 1 0 %d\nv 0 1 %d\nvn 0 0 1\n"
                  "f -3//-1 -2//-1 -1//-1\n",
                  i, i, i, i);
  reading_of(&r, &reader_obj, text);
  assert_int_equal(r.status, RECTO_OK);
  assert_int_equal(r.scene.point_normal.count, 3 * OBJECTS);
  for (uint32_t c = 0; c < 3 * OBJECTS; c++)
    assert_int_equal(corner_normal_of(&r.scene, c),
                     corner_normal_encode(0, 0, 1));
  reading_fini(&r);
}

/* ---- Classes ------------------------------------------------------------- */

static void marks_decide_the_classes_of_edges(void **state) {
  (void)state;
  struct prism prism = {.sides = 8, .marks = PRISM_GROUPS};
  struct reading r;
  struct topology topology;
  uint8_t masks[24];
  int creases = 0;
  reading_of(&r, &reader_obj, write_prism(&prism));
  assert_int_equal(topology_init(&topology, &r.scene, NULL), RECTO_OK);
  assert_true(crease_marks_find(&topology, &r.scene, AUTO, 30));
  assert_int_equal(topology.edge.count, 24);
  assert_true(topology_class_masks(&topology, &r.scene, 30, masks));
  for (uint32_t e = 0; e < 24; e++) {
    assert_int_equal(masks[e], topology_class_mask(&topology, &r.scene, e, 30));
    creases += masks[e] == RECTO_EDGE_CREASE;
    assert_true(masks[e] == RECTO_EDGE_CREASE || masks[e] == RECTO_EDGE_SMOOTH);
  }
  assert_int_equal(creases, 16);
  topology_fini(&topology);
  reading_fini(&r);
}

static void marks_run_out_of_memory(void **state) {
  (void)state;
  struct prism prism = {.sides = 8, .marks = PRISM_SPLIT};
  struct memory_faults faults = {.least = 5};
  const char *text = write_prism(&prism);
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    struct topology topology = {.corner_edge = NULL};
    bool found = false;
    reading_init(&r);
    memory_faults_begin(&faults);
    recto_status status = reading_bytes(&r, &reader_obj, text, strlen(text));
    if (status == RECTO_OK)
      status = topology_init(&topology, &r.scene, &r.error);
    if (status == RECTO_OK &&
        (!crease_marks_find(&topology, &r.scene, AUTO, 30) ||
         !crease_marks_exist(&r.scene, AUTO, &found)))
      status = error_memory(&r.error);
    memory_faults_end(&faults, status);
    assert_true(status != RECTO_OK || found);
    topology_fini(&topology);
    reading_fini(&r);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(groups_and_normals_mark_the_same_edges),
      cmocka_unit_test(normals_count_before_groups),
      cmocka_unit_test(one_kind_of_marks_says_nothing),
      cmocka_unit_test(marks_count_about_the_crease_angle),
      cmocka_unit_test(edges_between_flat_faces_count_where_they_are_few),
      cmocka_unit_test(normals_that_differ_at_one_end_say_nothing),
      cmocka_unit_test(indices_of_normals_are_those_of_points),
      cmocka_unit_test(what_cannot_be_read_is_told_and_the_face_drawn),
      cmocka_unit_test(a_repeated_corner_takes_the_normals_of_its_face),
      cmocka_unit_test(normals_of_one_a_point_take_four_bytes_a_point),
      cmocka_unit_test(each_object_of_a_file_has_its_normals),
      cmocka_unit_test(marks_decide_the_classes_of_edges),
      cmocka_unit_test(marks_run_out_of_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
