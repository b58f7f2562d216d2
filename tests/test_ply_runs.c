/* test_ply_runs.c - a binary PLY file, of which several threads read what is
 * plain, is the scene that the same mesh is as text.
 *
 * A text is read element by element.  The meshes have more faces than a thread
 * takes at once, most of them plain, and other ones at random places. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"

enum { COLUMNS = 300, POINTS = COLUMNS * 240, FACES = 100000, CORNERS_MAX = 5 };

struct mesh {
  double point[POINTS][3];
  int corners[FACES];
  long corner[FACES][CORNERS_MAX];
};

/* How a mesh is written. */
struct form {
  bool big_endian, is_double; /* its order of bytes, its coordinates */
  bool has_others;            /* vertices and faces have other properties */
};

struct bytes {
  char *item;
  size_t count;
};

/* ---- Meshes -------------------------------------------------------------- */

/* Points of a grid, of which one in `odd` is not finite; 0: none. */
static void make_points(struct mesh *mesh, struct random *random,
                        uint32_t odd) {
  for (int i = 0; i < POINTS; i++) {
    double *point = mesh->point[i];
    point[0] = i % COLUMNS;
    point[1] = i / COLUMNS;
    point[2] = random_int(random, -3, 3);
    if (odd > 0 && random_below(random, odd) == 0)
      point[random_below(random, 3)] = NAN;
  }
}

/* Any point, or now and then one that is not there. */
static long random_corner(struct random *random) {
  if (random_below(random, 10) > 0)
    return random_int(random, 0, POINTS - 1);
  return random_below(random, 2) ? POINTS : -1;
}

/* A face beside a place of the grid: a triangle or a quadrilateral, or, one in
 * `odd`, any number of any corners, some of which are not there; 0: none. */
static void make_face(struct mesh *mesh, int f, struct random *random,
                      int corners, uint32_t odd) {
  static const long around[4] = {0, 1, COLUMNS + 1, COLUMNS};
  long *corner = mesh->corner[f];
  long at = random_int(random, 0, POINTS - COLUMNS - 2);
  bool is_odd = odd > 0 && random_below(random, odd) == 0;
  mesh->corners[f] = is_odd ? random_int(random, 0, CORNERS_MAX) : corners;
  for (int k = 0; k < mesh->corners[f]; k++)
    corner[k] = is_odd ? random_corner(random) : at + around[k];
}

/* Runs of triangles and quadrilaterals take turns. */
static struct mesh *make_mesh(uint64_t seed, uint32_t odd_points,
                              uint32_t odd_faces) {
  struct random random = {seed};
  struct mesh *mesh = malloc(sizeof *mesh);
  assert_non_null(mesh);
  make_points(mesh, &random, odd_points);
  for (int f = 0, corners = 3; f < FACES; corners = 7 - corners) {
    int end = f + random_int(&random, 1, 60000);
    for (; f < end && f < FACES; f++)
      make_face(mesh, f, &random, corners, odd_faces);
  }
  return mesh;
}

/* ---- Files --------------------------------------------------------------- */

static void put(struct bytes *bytes, const void *item, size_t count,
                bool reversed) {
  const char *from = item;
  for (size_t i = 0; i < count; i++)
    bytes->item[bytes->count++] = from[reversed ? count - 1 - i : i];
}

static void put_text(struct bytes *bytes, const char *format, ...) {
  va_list values;
  va_start(values, format);
  bytes->count += (size_t)vsprintf(bytes->item + bytes->count, format, values);
  va_end(values);
}

static void begin_file(struct bytes *bytes, const char *format,
                       const struct form *form) {
  enum { ROOM = 1 << 24 };
  const char *type = form->is_double ? "double" : "float";
  const char *other = form->has_others ? "property uchar quality\n" : "";
  *bytes = (struct bytes){malloc(ROOM), 0};
  assert_non_null(bytes->item);
  put_text(bytes, "ply\nformat %s 1.0\nelement vertex %d\n%s", format, POINTS,
           other);
  put_text(bytes, "property %s x\nproperty %s y\nproperty %s z\n", type, type,
           type);
  put_text(bytes,
           "element face %d\n%sproperty list uchar int vertex_indices\n%s"
           "end_header\n",
           FACES, other, other);
}

static void write_text(struct bytes *bytes, const struct mesh *mesh) {
  static const struct form form = {false, true, false};
  begin_file(bytes, "ascii", &form);
  for (int i = 0; i < POINTS; i++)
    put_text(bytes, "%g %g %g\n", mesh->point[i][0], mesh->point[i][1],
             mesh->point[i][2]);
  for (int f = 0; f < FACES; f++) {
    put_text(bytes, "%d", mesh->corners[f]);
    for (int k = 0; k < mesh->corners[f]; k++)
      put_text(bytes, " %ld", mesh->corner[f][k]);
    put_text(bytes, "\n");
  }
}

static void write_binary(struct bytes *bytes, const struct mesh *mesh,
                         const struct form *form) {
  static const uint16_t one = 1;
  bool reversed = form->big_endian == (*(const char *)&one == 1);
  begin_file(bytes,
             form->big_endian ? "binary_big_endian" : "binary_little_endian",
             form);
  for (int i = 0; i < POINTS; i++) {
    if (form->has_others)
      put(bytes, "q", 1, false);
    for (int k = 0; k < 3; k++) {
      float single = (float)mesh->point[i][k];
      if (form->is_double)
        put(bytes, &mesh->point[i][k], sizeof mesh->point[i][k], reversed);
      else
        put(bytes, &single, sizeof single, reversed);
    }
  }
  for (int f = 0; f < FACES; f++) {
    unsigned char corners = (unsigned char)mesh->corners[f];
    if (form->has_others)
      put(bytes, "q", 1, false);
    put(bytes, &corners, 1, false);
    for (int k = 0; k < corners; k++) {
      int32_t corner = (int32_t)mesh->corner[f][k];
      put(bytes, &corner, sizeof corner, reversed);
    }
    if (form->has_others)
      put(bytes, "q", 1, false);
  }
}

/* ---- Tests --------------------------------------------------------------- */

/* Reads a mesh as text and in several binary forms. */
static void assert_forms_agree(const struct mesh *mesh) {
  static const struct form forms[] = {
      {false, false, false}, {true, true, false}, {false, true, true}};
  struct bytes text, binary;
  struct reading a, b;
  write_text(&text, mesh);
  reading_init(&a);
  assert_int_equal(reading_bytes(&a, &reader_ply, text.item, text.count),
                   RECTO_OK);
  for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
    write_binary(&binary, mesh, &forms[i]);
    reading_init(&b);
    assert_int_equal(reading_bytes(&b, &reader_ply, binary.item, binary.count),
                     RECTO_OK);
    assert_null(reading_fault(&b.scene));
    if (!reading_same(&a.scene, &b.scene))
      fail_msg("form %zu is another scene", i);
    assert_int_equal(a.scene.face_skipped.count, b.scene.face_skipped.count);
    assert_memory_equal(a.diagnostics.count, b.diagnostics.count,
                        sizeof a.diagnostics.count);
    reading_fini(&b);
    const char *fault =
        reading_parallel_fault(&reader_ply, binary.item, binary.count);
    if (fault != NULL)
      fail_msg("form %zu, several threads: %s", i, fault);
    free(binary.item);
  }
  reading_fini(&a);
  free(text.item);
}

static void plain_meshes_are_read(void **state) {
  (void)state;
  struct mesh *mesh = make_mesh(1, 0, 0);
  assert_forms_agree(mesh);
  free(mesh);
}

static void faces_that_are_not_plain_are_read(void **state) {
  (void)state;
  static const uint32_t odd[] = {20000, 500, 3};
  for (uint64_t i = 0; i < sizeof odd / sizeof *odd; i++) {
    struct mesh *mesh = make_mesh(2 + i, 0, odd[i]);
    assert_forms_agree(mesh);
    free(mesh);
  }
}

static void points_that_are_not_finite_are_read(void **state) {
  (void)state;
  struct mesh *mesh = make_mesh(5, POINTS / 20, 1000);
  assert_forms_agree(mesh);
  free(mesh);
}

/* Faces of a second file are in another group, behind those of the first. */
static void a_second_file_is_added(void **state) {
  (void)state;
  static const struct form form = {false, false, false};
  static const char *const path[] = {"one.ply", "two.ply"};
  struct mesh *mesh = make_mesh(6, 0, 5000);
  struct bytes text, binary;
  struct reading a, b;
  write_text(&text, mesh);
  write_binary(&binary, mesh, &form);
  reading_init(&a);
  reading_init(&b);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(scene_read_memory(&a.scene, text.item, text.count, path[i],
                                       NULL, NULL, &a.error),
                     RECTO_OK);
    assert_int_equal(scene_read_memory(&b.scene, binary.item, binary.count,
                                       path[i], NULL, NULL, &b.error),
                     RECTO_OK);
  }
  assert_int_equal(a.scene.group.count, 2);
  assert_true(reading_same(&a.scene, &b.scene));
  reading_fini(&a);
  reading_fini(&b);
  free(text.item);
  free(binary.item);
  free(mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plain_meshes_are_read),
      cmocka_unit_test(faces_that_are_not_plain_are_read),
      cmocka_unit_test(points_that_are_not_finite_are_read),
      cmocka_unit_test(a_second_file_is_added),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
