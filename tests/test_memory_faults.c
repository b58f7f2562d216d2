/* test_memory_faults.c - any allocation of the process may fail, of ours or of
 * a library's: the whole run succeeds or reports an error, and leaves no file.
 *
 * malloc and the like are defined here and replace the C library's: cairo and
 * zlib use them as well. */
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "base/sanitizer.h"
#include "recto.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"

#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

/* ---- An allocation that fails -------------------------------------------- */

static atomic_ulong counted;   /* allocations since the start of the job */
static atomic_ulong to_fail;   /* the one that fails; 0: none */
static atomic_bool from_there; /* and all after it */

#if defined __GLIBC__ && !SANITIZER_OF_ADDRESSES && !SANITIZER_OF_THREADS
#define CAN_FAIL 1

static atomic_long held; /* blocks */

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *block, size_t size);
extern void __libc_free(void *block);
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *block, size_t size);
void free(void *block);

static bool fails(void) {
  unsigned long n = atomic_fetch_add(&counted, 1) + 1, fail = to_fail;
  if (fail == 0 || !(n == fail || (from_there && n > fail)))
    return false;
  errno = ENOMEM;
  return true;
}

static void *hold(void *block) {
  atomic_fetch_add(&held, block != NULL);
  return block;
}

void *malloc(size_t size) { return fails() ? NULL : hold(__libc_malloc(size)); }

void *calloc(size_t count, size_t size) {
  return fails() ? NULL : hold(__libc_calloc(count, size));
}

void *realloc(void *block, size_t size) {
  if (fails())
    return NULL;
  return block == NULL ? hold(__libc_malloc(size))
                       : __libc_realloc(block, size);
}

void free(void *block) {
  atomic_fetch_sub(&held, block != NULL);
  __libc_free(block);
}
#else
#define CAN_FAIL 0
static atomic_long held;
#endif

/* ---- Jobs ---------------------------------------------------------------- */

static const char obj[] =
    "mtllib m.mtl\no a\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 -1\n"
    "v 1 1 1\nv 3 1 .5\nusemtl red\nf 1 2 3 4\nf 1 5 6\ng b\nf 2 3 7\n"
    "f 4 6 7\nl 1 7 3\n";
static const char mtl[] = "newmtl red\nKd 1 0 0\n";
static const char stl[] =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
    "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
static const char ply[] =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n";

#ifdef HAVE_ASSIMP
static const char off[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                          "3 0 1 2\n3 0 2 3\n";
#endif

struct job {
  const char *model, *from, *format;
  recto_method method;
  recto_fill fill;
  recto_hidden hidden;
  int verify, resolution;
  bool checks; /* checks an SVG file instead of drawing */
};

static const char *folder;

static void path_of(char path[300], const char *name) {
  snprintf(path, 300, "%s/%s", folder, name);
}

static void write_text(const char *name, const char *text) {
  char path[300];
  path_of(path, name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

#ifdef HAVE_ZLIB
static void write_compressed(const char *name, const char *text) {
  char path[300];
  path_of(path, name);
  gzFile file = gzopen(path, "wb");
  assert_non_null(file);
  assert_true(gzputs(file, text) > 0);
  assert_int_equal(gzclose(file), Z_OK);
}
#endif

static recto_status check(const char *model, const recto_options *options,
                          recto_error *error) {
  recto_scene *scene = NULL;
  recto_verdict verdict;
  char drawing[300];
  path_of(drawing, "judged.svg");
  recto_status status = recto_scene_create(&scene, error);
  if (status == RECTO_OK)
    status = recto_scene_read(scene, model, NULL, options, error);
  if (status == RECTO_OK)
    status = recto_scene_check(scene, drawing, options, &verdict, error);
  recto_scene_destroy(scene);
  return status;
}

static recto_status run(const struct job *job, const char *output,
                        recto_error *error) {
  recto_options options;
  char model[300];
  recto_options_init(&options);
  options.solver.method = job->method;
  options.ink.fill = job->fill;
  options.ink.hidden = job->hidden;
  options.verify = job->verify;
  options.solver.resolution = job->resolution;
  path_of(model, job->model);
  if (job->checks)
    return check(model, &options, error);
  return recto_draw_file(model, job->from, output, job->format, &options,
                         error);
}

/* Runs the job with its n-th allocation failing; false where it has fewer. */
static bool survives(const struct job *job, unsigned long n, bool all_after) {
  size_t files = temporary_count((void *const *)&folder);
  long before = held;
  char output[300];
  recto_error error = {0};
  path_of(output, "out");
  from_there = all_after;
  counted = 0;
  to_fail = n;
  recto_status status = run(job, output, &error);
  bool failed = counted >= n;
  long after = held;
  to_fail = 0;
  if (status == RECTO_OK) {
    assert_true(job->checks || remove(output) == 0);
  } else if (status != RECTO_ERROR_MEMORY || error.code != RECTO_ERROR_MEMORY) {
    fail_msg("%s to %s, allocation %lu: status %s, \"%s\"", job->model,
             job->format, n, recto_status_name(status), error.text);
  }
  if (all_after && failed && status == RECTO_OK && n == 1)
    fail_msg("%s to %s without memory is done", job->model, job->format);
  /* Nothing is left. */
  if (after != before)
    fail_msg("%s to %s, allocation %lu: %ld blocks are lost", job->model,
             job->format, n, after - before);
  assert_int_equal(temporary_count((void *const *)&folder), files);
  return failed;
}

/* One by one, or some of them where there are many. */
static void try_all(const struct job *job) {
  enum { MOST = 150 };
  recto_error error;
  char output[300];
  path_of(output, "out");
  counted = to_fail = 0;
  recto_status status = run(job, output, &error);
  if (status == RECTO_ERROR_UNSUPPORTED)
    return; /* a build without cairo */
  assert_int_equal(status, RECTO_OK);
  unsigned long all = counted, step = 1 + all / MOST;
  assert_true(job->checks || remove(output) == 0);
  for (unsigned long n = 1; n <= all; n += step) {
    (void)survives(job, n, false);
    (void)survives(job, n, true);
  }
  assert_false(survives(job, 100 * all, false));
}

static void try_jobs(const struct job *job, size_t count) {
  if (!CAN_FAIL || is_under_valgrind())
    skip();
  for (size_t i = 0; i < count; i++)
    try_all(&job[i]);
}

#define TRY(...)                                                               \
  do {                                                                         \
    static const struct job job[] = {__VA_ARGS__};                             \
    try_jobs(job, sizeof job / sizeof *job);                                   \
  } while (0)

static void readers_survive_failed_allocations(void **state) {
  (void)state;
  TRY({.model = "m.obj", .format = "svg"},
      {.model = "m.obj", .format = "svg", .fill = RECTO_FILL_PAINT},
      {.model = "m.stl", .format = "svg"}, {.model = "m.ply", .format = "svg"});
}

#ifdef HAVE_ZLIB
static void gzip_readers_survive_failed_allocations(void **state) {
  (void)state;
  TRY({.model = "m.stl.gz", .format = "svg"},
      {.model = "z.obj", .format = "svg", .fill = RECTO_FILL_PAINT});
}
#endif

#ifdef HAVE_ASSIMP
static int count_descriptors(void) {
  enum { MOST = 1024 };
  int count = 0;
  for (int i = 0; i < MOST; i++)
    count += fcntl(i, F_GETFD) >= 0;
  return count;
}

/* The process that starts the importer; neither the importer nor a pipe nor a
 * file of ours is left. */
static void the_importer_s_host_survives_failed_allocations(void **state) {
  (void)state;
  int before = count_descriptors();
  TRY({.model = "m.off", .format = "svg"},
      {.model = "off", .from = "off", .format = "svg"});
  assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
  assert_int_equal(errno, ECHILD);
  assert_int_equal(count_descriptors(), before);
}
#endif

static void writers_survive_failed_allocations(void **state) {
  (void)state;
  TRY({.model = "m.obj", .format = "hpgl"},
      {.model = "m.obj", .format = "svg", .hidden = RECTO_HIDDEN_LAYER},
      {.model = "m.obj", .format = "pdf", .fill = RECTO_FILL_PAINT},
      {.model = "m.obj", .format = "eps", .fill = RECTO_FILL_SHADE},
      {.model = "m.obj", .format = "ps", .hidden = RECTO_HIDDEN_DASHED},
      {.model = "m.obj", .format = "png", .fill = RECTO_FILL_HATCH});
}

static void methods_survive_failed_allocations(void **state) {
  (void)state;
  TRY({.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_NEWELL,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_WATKINS,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_WARNOCK,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_TILES,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_BRUTE,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_PAINTER,
       .fill = RECTO_FILL_PAINT},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_ZBUFFER,
       .fill = RECTO_FILL_PAINT,
       .resolution = 32},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_SCANLINE_ZBUFFER,
       .fill = RECTO_FILL_PAINT,
       .resolution = 32},
      {.model = "m.obj",
       .format = "svg",
       .method = RECTO_METHOD_WARNOCK,
       .fill = RECTO_FILL_PAINT,
       .resolution = 32});
}

static void the_judge_survives_failed_allocations(void **state) {
  (void)state;
  TRY({.model = "m.obj", .format = "svg", .verify = 100},
      {.model = "m.obj", .format = "svg", .checks = true});
}

static int start(void **state) {
  if (temporary_set_up(state) != 0)
    return -1;
  folder = *state;
  write_text("m.obj", obj);
  write_text("m.mtl", mtl);
  write_text("m.stl", stl);
  write_text("m.ply", ply);
#ifdef HAVE_ZLIB
  write_compressed("m.stl.gz", stl);
  write_compressed("z.mtl.gz", mtl);
  write_text("z.obj", "mtllib z.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\n"
                      "usemtl red\nf 1 2 3\n");
#endif
#ifdef HAVE_ASSIMP
  write_text("m.off", off);
  write_text("off", off);
#endif
  write_text("judged.svg",
             "<svg width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">"
             "<path stroke=\"#000\" d=\"M1 1L90 90C1 1 50 9 3 3\"/></svg>");
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(readers_survive_failed_allocations),
#ifdef HAVE_ZLIB
      cmocka_unit_test(gzip_readers_survive_failed_allocations),
#endif
#ifdef HAVE_ASSIMP
      cmocka_unit_test(the_importer_s_host_survives_failed_allocations),
#endif
      cmocka_unit_test(writers_survive_failed_allocations),
      cmocka_unit_test(methods_survive_failed_allocations),
      cmocka_unit_test(the_judge_survives_failed_allocations),
  };
  return cmocka_run_group_tests_name("memory_faults", tests, start,
                                     temporary_tear_down);
}
