/* test_fuzz_readers.c - readers survive any bytes: what they accept keeps the
 * scene's invariants, what they refuse has a reason and a line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/obj/material.h"
#include "scene/read.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"
#include "tests/valgrind.h"

enum { SIZE_MAX_FUZZED = 4096 };

struct file {
  size_t count;
  char bytes[SIZE_MAX_FUZZED];
};

static int rounds(int count) {
  return is_under_valgrind() ? count / 100 : count;
}

static void put(struct file *file, const char *text) {
  size_t length = strlen(text);
  memcpy(file->bytes + file->count, text, length);
  file->count += length;
}

static void make_obj(struct file *file) {
  put(file, "# seed\nmtllib a.mtl\no Box\nv 0 0 0\nv 1.5 0 -0.25\n"
            "v 1 1e-3 0 1 0.5 0.5\r\nv 0 .1 12345678901234567890.5\n"
            "vt 0 0\nvn 0 0 1\ng a b\nusemtl red\nf 1 2 3\n"
            "f 1/1 2/1 3/1 4/1\nf 1//1 2//1 -1//1\nf -4/1/1 -3/1/1 -2/1/1 \\\n"
            " -1/1/1\nl 1 2 3 4\ng\nf 4 3 2 1\nv nan 0 0\nf 1 2 5\nf 1 2 6\n"
            "v 2 2 2\nf 1 1 2\nf 99 1 2\n");
}

static void make_text_stl(struct file *file) {
  for (int i = 0; i < 2; i++)
    put(file, "solid part one\n facet normal 0 0 1\n  outer loop\n"
              "   vertex 0 0 0\n   vertex 1.0e0 0 0\n   vertex 1 1 0.5\n"
              "  endloop\n endfacet\n facet normal nan nan nan\n"
              "  outer loop\n   vertex 0 0 -0\n   vertex 1 1 0.5\n"
              "   vertex 0 1 0\n  endloop\n endfacet\nendsolid part one\n");
}

static void make_binary_stl(struct file *file) {
  struct random random = {9};
  put(file, "solid binary");
  file->count = 84;
  file->bytes[80] = 12;
  for (int i = 0; i < 12; i++, file->count += 50)
    for (int k = 0; k < 9; k++) {
      float value = (float)random_int(&random, -2, 2);
      memcpy(file->bytes + file->count + 12 + 4 * k, &value, sizeof value);
    }
}

static void make_text_ply(struct file *file) {
  put(file, "ply\nformat ascii 1.0\ncomment seed\nelement vertex 4\n"
            "property float x\nproperty double y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element odd 1\nproperty list uchar int values\nelement face 2\n"
            "property list uchar int vertex_indices\nelement edge 1\n"
            "property int vertex1\nproperty int vertex2\n"
            "element tristrips 1\nproperty list int int vertex_indices\n"
            "end_header\n0 0 0 1 2 3\n1 0.5 0 4 5 6\n1 1e0 0 7 8 9\n"
            "-0 1 0 255 0 0\n2 7 8\n4 0 1 2 3\n3 0 1 2\n0 2\n"
            "6 0 1 2 -1 3 0\n");
}

static void make_binary_ply(struct file *file) {
  struct random random = {9};
  put(file, "ply\nformat binary_little_endian 1.0\nelement vertex 8\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element face 6\nproperty list uchar int vertex_indices\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n");
  for (int i = 0; i < 8; i++, file->count += 15)
    for (int k = 0; k < 3; k++) {
      float value = (float)random_int(&random, -2, 2);
      memcpy(file->bytes + file->count + 4 * k, &value, sizeof value);
    }
  for (int i = 0; i < 6; i++, file->count += 16) {
    file->bytes[file->count] = 3;
    for (int k = 0; k < 3; k++)
      file->bytes[file->count + 1 + 4 * (size_t)k] =
          (char)random_below(&random, 8);
  }
}

/* ---- Mutations ----------------------------------------------------------- */

static const char *const words[] = {"nan",
                                    "inf",
                                    "-",
                                    "1e999",
                                    "1e-999",
                                    "4294967296",
                                    "\\\n",
                                    "\\\r\n",
                                    "\n",
                                    "/",
                                    "//",
                                    "v ",
                                    "f ",
                                    "l ",
                                    "usemtl x\n",
                                    "vertex",
                                    "facet",
                                    "endloop",
                                    "endfacet",
                                    "solid",
                                    "endsolid",
                                    "\0",
                                    " ",
                                    "#",
                                    "element face 9\n",
                                    "property float x\n",
                                    "list ",
                                    "ascii",
                                    "end_header\n",
                                    "-2147483649",
                                    "0",
                                    "0.5",
                                    "\xff\xfe",
                                    "\r",
                                    "\x80\x3f"};

static void insert(struct file *file, size_t at, const char *bytes,
                   size_t count) {
  if (file->count + count > SIZE_MAX_FUZZED)
    return;
  memmove(file->bytes + at + count, file->bytes + at, file->count - at);
  memcpy(file->bytes + at, bytes, count);
  file->count += count;
}

static void erase(struct file *file, size_t at, size_t count) {
  if (count > file->count - at)
    count = file->count - at;
  memmove(file->bytes + at, file->bytes + at + count, file->count - at - count);
  file->count -= count;
}

static void mutate(struct random *random, struct file *file) {
  if (file->count == 0)
    return;
  size_t at = random_below(random, (uint32_t)file->count);
  const char *word = words[random_below(random, sizeof words / sizeof *words)];
  char part[64];
  size_t from = random_below(random, (uint32_t)file->count), length = 0;
  switch (random_below(random, 7)) {
  case 0:
    file->bytes[at] = (char)random_next(random);
    break;
  case 1:
    file->bytes[at] = (char)(file->bytes[at] ^ 1 << random_below(random, 8));
    break;
  case 2:
    insert(file, at, word, *word ? strlen(word) : 1);
    break;
  case 3:
    erase(file, at, 1 + random_below(random, 20));
    break;
  case 4:
    while (length < sizeof part && from + length < file->count &&
           random_below(random, 20)) {
      part[length] = file->bytes[from + length];
      length++;
    }
    insert(file, at, part, length);
    break;
  case 5:
    if (random_below(random, 8) == 0)
      file->count = at; /* cut off */
    break;
  default:
    for (int i = 0; i < 4 && at + 4 < file->count; i++)
      file->bytes[at + (size_t)i] = (char)random_next(random);
    break;
  }
}

/* ---- The claim ----------------------------------------------------------- */

static void assert_survives(const struct reader *reader,
                            const struct file *file, int seed,
                            unsigned count[2]) {
  struct reading r;
  reading_init(&r);
  r.scene.needs_colours = seed % 2 != 0;
  recto_status status = reading_bytes(&r, reader, file->bytes, file->count);
  if (status == RECTO_OK) {
    const char *fault = reading_fault(&r.scene);
    if (fault != NULL)
      fail_msg("seed %d: %s", seed, fault);
  } else if (status != RECTO_ERROR_FORMAT || r.error.line == 0 ||
             !*r.error.text) {
    fail_msg("seed %d: status %d, line %lu, '%s'", seed, status, r.error.line,
             r.error.text);
  }
  count[status != RECTO_OK]++;
  reading_fini(&r);
}

static void fuzz(const struct reader *reader, void (*make)(struct file *),
                 int files) {
  unsigned count[2] = {0, 0};
  for (int seed = 0; seed < rounds(files); seed++) {
    static struct file file;
    struct random random = {(uint64_t)seed};
    memset(&file, 0, sizeof file);
    make(&file);
    for (int n = random_int(&random, 0, 8); n > 0; n--)
      mutate(&random, &file);
    assert_survives(reader, &file, seed, count);
  }
  /* Both ends were reached, often enough to mean something. */
  assert_true(count[0] > (unsigned)rounds(files) / 50);
  assert_true(count[1] > (unsigned)rounds(files) / 50);
}

static void obj_files_of_any_bytes_are_survived(void **state) {
  (void)state;
  fuzz(&reader_obj, make_obj, 40000);
}

static void text_stl_files_of_any_bytes_are_survived(void **state) {
  (void)state;
  fuzz(&reader_stl, make_text_stl, 40000);
}

static void binary_stl_files_of_any_bytes_are_survived(void **state) {
  (void)state;
  fuzz(&reader_stl, make_binary_stl, 40000);
}

static void text_ply_files_of_any_bytes_are_survived(void **state) {
  (void)state;
  fuzz(&reader_ply, make_text_ply, 40000);
}

static void binary_ply_files_of_any_bytes_are_survived(void **state) {
  (void)state;
  fuzz(&reader_ply, make_binary_ply, 40000);
}

static void make_library(struct file *file) {
  put(file, "# seed\nnewmtl red\nKa 0 0 0\nKd 1 0.5 0\n\tmap_Kd a b.png\n"
            "newmtl two words\r\n  Kd 0.25\r\nnewmtl red\nKd nan 0 0\nd 1\n"
            "newmtl last\nKd 1e999 -1e-999 .5");
}

/* No bytes are an error in a material library; its colours are colours. */
static void libraries_of_any_bytes_are_survived(void **state) {
  size_t colours = 0;
  (void)state;
  for (int seed = 0; seed < rounds(40000); seed++) {
    static struct file file;
    struct random random = {(uint64_t)seed};
    memset(&file, 0, sizeof file);
    make_library(&file);
    for (int n = random_int(&random, 0, 8); n > 0; n--)
      mutate(&random, &file);
    struct reading r;
    reading_init(&r);
    /* A block of just this size, with nothing behind it. */
    char *bytes = malloc(file.count ? file.count : 1);
    assert_non_null(bytes);
    memcpy(bytes, file.bytes, file.count);
    assert_int_equal(
        material_read(&r.scene, bytes, file.count, &r.diagnostics, &r.error),
        RECTO_OK);
    free(bytes);
    for (size_t i = 0; i < r.scene.group.count; i++) {
      assert_true(r.scene.group.item[i].colour <= 0xffffff);
      colours += r.scene.group.item[i].has_colour;
    }
    reading_fini(&r);
  }
  assert_true(colours > (size_t)rounds(40000));
}

/* Each reader is given the files of the others as well. */
static void files_of_another_format_are_survived(void **state) {
  (void)state;
  static struct file files[5];
  unsigned count[2] = {0, 0};
  memset(files, 0, sizeof files);
  make_obj(&files[0]);
  make_text_stl(&files[1]);
  make_binary_stl(&files[2]);
  make_text_ply(&files[3]);
  make_binary_ply(&files[4]);
  for (int i = 0; i < 5; i++) {
    assert_survives(&reader_obj, &files[i], 0, count);
    assert_survives(&reader_ply, &files[i], 0, count);
    assert_survives(&reader_stl, &files[i], 0, count);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(obj_files_of_any_bytes_are_survived),
      cmocka_unit_test(text_stl_files_of_any_bytes_are_survived),
      cmocka_unit_test(binary_stl_files_of_any_bytes_are_survived),
      cmocka_unit_test(text_ply_files_of_any_bytes_are_survived),
      cmocka_unit_test(binary_ply_files_of_any_bytes_are_survived),
      cmocka_unit_test(libraries_of_any_bytes_are_survived),
      cmocka_unit_test(files_of_another_format_are_survived),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
