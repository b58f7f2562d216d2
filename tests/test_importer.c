/* test_importer.c - any failure of the importer, a process of its own, is only
 * an error status of the library. */
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/corner_normals.h"
#include "scene/read.h"
#include "scene/readers/import_format.h"
#include "tests/polled.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"

static const char off[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                          "3 0 1 2\n3 0 2 3\n";

/* A tetrahedron of Collada.  With "count0" for "count" it crashes Assimp
 * 5.2. */
#define DAE(count)                                                             \
  "<?xml version=\"1.0\"?><COLLADA "                                           \
  "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "                    \
  "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset>"                   \
  "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"             \
  "<float_array id=\"pa\" " count "=\"12\">0 0 0 1 0 0 0 1 0 0 0 1"            \
  "</float_array><technique_common><accessor source=\"#pa\" count=\"4\" "      \
  "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "          \
  "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"              \
  "</technique_common></source><vertices id=\"v\"><input "                     \
  "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"4\">"    \
  "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"                    \
  "<p>0 1 2 0 1 3 0 2 3 1 2 3</p></triangles></mesh></geometry>"               \
  "</library_geometries><library_visual_scenes><visual_scene id=\"s\">"        \
  "<node><instance_geometry url=\"#g\"/></node></visual_scene>"                \
  "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/>"         \
  "</scene></COLLADA>"

static recto_status read_path(struct reading *r, const char *path) {
  reading_init(r);
  r->status = scene_read(&r->scene, path, NULL, &r->diagnostics, &r->error);
  return r->status;
}

static void assert_refused(const char *path, recto_status status,
                           const char *text) {
  struct reading r;
  if (read_path(&r, path) != status || !strstr(r.error.text, text))
    fail_msg("status %d: '%s', not %d: '%s'", r.status, r.error.text, status,
             text);
  assert_int_equal(r.scene.point.count, 0);
  reading_fini(&r);
}

static void assert_reads(const char *path, uint32_t faces) {
  struct reading r;
  if (read_path(&r, path) != RECTO_OK)
    fail_msg("%s", r.error.text);
  assert_int_equal(scene_face_count(&r.scene), faces);
  assert_null(reading_fault(&r.scene));
  reading_fini(&r);
}

static const char *model(void *const *state) {
  return temporary_file(state, "a.off", off, sizeof off - 1);
}

/* ---- Importers that fail ------------------------------------------------- */

static char *usual_importer;

static int set_up(void **state) {
  const char *usual = getenv("RECTO_IMPORT");
  usual_importer = usual ? strdup(usual) : NULL;
  return temporary_set_up(state);
}

static int tear_down(void **state) {
  if (usual_importer != NULL)
    setenv("RECTO_IMPORT", usual_importer, 1);
  else
    unsetenv("RECTO_IMPORT");
  unsetenv("RECTO_IMPORT_SECONDS");
  unsetenv("RECTO_IMPORT_MB");
  free(usual_importer);
  return temporary_tear_down(state);
}

/* Makes a shell script the importer. */
static void use_script(void *const *state, const char *script) {
  char text[1000];
  int length = snprintf(text, sizeof text, "#!/bin/sh\n%s\n", script);
  const char *path = temporary_file(state, "importer", text, (size_t)length);
  assert_int_equal(chmod(path, 0700), 0);
  setenv("RECTO_IMPORT", path, 1);
  setenv("RECTO_IMPORT_SECONDS", "1", 1);
}

/* No child is left, running or dead. */
static void assert_alone(void) {
  assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
  assert_int_equal(errno, ECHILD);
}

static void a_crash_is_an_error(void **state) {
  use_script(state, "kill -SEGV $$");
  assert_refused(model(state), RECTO_ERROR_FORMAT,
                 "the importer crashed (signal 11)");
  use_script(state, "exit 3");
  assert_refused(model(state), RECTO_ERROR_FORMAT,
                 "the importer failed (status 3)");
  assert_alone();
}

static void an_importer_that_hangs_is_ended(void **state) {
  static const char *const way[] = {"exec sleep 60",
                                    /* Though it writes no more. */
                                    "exec 3>&-; exec sleep 60",
                                    "trap '' TERM INT; while :; do :; done"};
  for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
    use_script(state, way[i]);
    assert_refused(model(state), RECTO_ERROR_LIMIT,
                   "the importer took longer than 1 s");
    assert_alone();
  }
}

static void what_makes_no_sense_is_refused(void **state) {
  use_script(state, "echo nonsense >&3");
  assert_refused(model(state), RECTO_ERROR_FORMAT, "the importer failed");
  use_script(state, "printf 'recto i1' >&3");
  assert_refused(model(state), RECTO_ERROR_FORMAT, "the importer failed");
}

static void a_missing_importer_is_reported(void **state) {
  setenv("RECTO_IMPORT", "/none/recto-import", 1);
  assert_refused(model(state), RECTO_ERROR_UNSUPPORTED,
                 "no reader for the format 'off': cannot start the importer "
                 "/none/recto-import: No such file or directory");
}

static bool never(void *user, double share, const char *stage) {
  (void)user;
  (void)share;
  (void)stage;
  return false;
}

static void cancelling_ends_the_importer(void **state) {
  struct reading r;
  use_script(state, "exec sleep 60");
  setenv("RECTO_IMPORT_SECONDS", "50", 1);
  reading_init(&r);
  struct polled polled;
  polled_begin(&polled, never, NULL);
  assert_int_equal(
      scene_read(&r.scene, model(state), NULL, &r.diagnostics, &r.error),
      RECTO_ERROR_CANCELLED);
  polled_end(&polled);
  assert_alone();
  reading_fini(&r);
}

/* ---- The host ------------------------------------------------------------ */

static int count_descriptors(void) {
  DIR *folder = opendir("/proc/self/fd");
  int count = 0;
  if (folder == NULL)
    return 0;
  while (readdir(folder) != NULL)
    count++;
  closedir(folder);
  return count;
}

static void no_descriptor_is_left_open(void **state) {
  const char *path = model(state);
  int before = count_descriptors();
  assert_reads(path, 2);
  use_script(state, "kill -SEGV $$");
  assert_refused(path, RECTO_ERROR_FORMAT, "crashed");
  setenv("RECTO_IMPORT", "/none", 1);
  assert_refused(path, RECTO_ERROR_UNSUPPORTED, "cannot start");
  assert_int_equal(count_descriptors(), before);
}

static void without_descriptors_it_is_an_error(void **state) {
  const char *path = model(state);
  const char *plain = temporary_file(state, "b", off, sizeof off - 1);
  struct rlimit usual;
  int refused = 0, before = count_descriptors();
  assert_int_equal(getrlimit(RLIMIT_NOFILE, &usual), 0);
  for (rlim_t most = 3; most < 20; most++)
    for (int by_path = 0; by_path < 2; by_path++) {
      struct rlimit few = {most, usual.rlim_max};
      struct reading r;
      reading_init(&r);
      assert_int_equal(setrlimit(RLIMIT_NOFILE, &few), 0);
      r.status = scene_read(&r.scene, by_path ? path : plain, "off",
                            &r.diagnostics, &r.error);
      assert_int_equal(setrlimit(RLIMIT_NOFILE, &usual), 0);
      if (r.status != RECTO_OK && r.status != RECTO_ERROR_IO)
        fail_msg("%d descriptors: %s", (int)most, r.error.text);
      refused += strstr(r.error.text, "importer") != NULL;
      reading_fini(&r);
    }
  assert_true(refused > 0);
  assert_int_equal(count_descriptors(), before);
  assert_alone();
}

static int spawn_fails; /* with this errno; 0: it does not */

/* Defined before the C library's. */
int posix_spawn(pid_t *process, const char *path,
                const posix_spawn_file_actions_t *actions,
                const posix_spawnattr_t *attributes, char *const argument[],
                char *const environment[]) {
  union {
    void *object;
    int (*call)(pid_t *, const char *, const posix_spawn_file_actions_t *,
                const posix_spawnattr_t *, char *const[], char *const[]);
  } usual = {dlsym(RTLD_NEXT, "posix_spawn")};
  return spawn_fails ? spawn_fails
                     : usual.call(process, path, actions, attributes, argument,
                                  environment);
}

static void without_processes_it_is_an_error(void **state) {
  const char *path = model(state);
  int before = count_descriptors();
  spawn_fails = EAGAIN;
  assert_refused(path, RECTO_ERROR_IO, "cannot start the importer: ");
  spawn_fails = ENOMEM;
  assert_refused(path, RECTO_ERROR_MEMORY, "out of memory");
  spawn_fails = 0;
  assert_int_equal(count_descriptors(), before);
  assert_alone();
}

/* Then the exit status of the importer is not available. */
static void a_host_may_ignore_its_children(void **state) {
  void (*before)(int) = signal(SIGCHLD, SIG_IGN);
  assert_reads(model(state), 2);
  use_script(state, "kill -SEGV $$");
  assert_refused(model(state), RECTO_ERROR_FORMAT, "the importer failed");
  signal(SIGCHLD, before);
}

static void standard_streams_may_be_closed(void **state) {
  const char *path = model(state);
  const char *plain = temporary_file(state, "b", off, sizeof off - 1);
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    struct scene scene;
    for (int i = 0; i < 10; i++)
      close(i);
    scene_init(&scene);
    int failed = scene_read(&scene, path, NULL, NULL, NULL) != RECTO_OK ||
                 scene_read(&scene, plain, "off", NULL, NULL) != RECTO_OK;
    _exit(failed || scene_face_count(&scene) != 4);
  }
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_int_equal(status, 0);
}

static void a_named_pipe_is_read_once(void **state) {
  const char *path = temporary_path(state, "pipe.off");
  assert_int_equal(mkfifo(path, 0600), 0);
  pid_t child = fork();
  if (child == 0) {
    FILE *file = fopen(path, "w");
    _exit(file == NULL || fputs(off, file) < 0 || fclose(file) != 0);
  }
  assert_reads(path, 2);
  assert_int_equal(waitpid(child, NULL, 0), child);
}

/* ---- Models that break Assimp -------------------------------------------- */

static void a_model_that_crashes_assimp_is_an_error(void **state) {
  const char *good =
      temporary_file(state, "a.dae", DAE("count"), sizeof DAE("count") - 1);
  assert_reads(good, 4);
  const char *bad =
      temporary_file(state, "b.dae", DAE("count0"), sizeof DAE("count0") - 1);
  struct reading r;
  /* Other versions of Assimp may refuse it themselves, or read it. */
  if (read_path(&r, bad) != RECTO_OK)
    assert_int_equal(r.status, RECTO_ERROR_FORMAT);
  reading_fini(&r);
  assert_alone();
}

static void a_model_that_needs_too_much_memory_is_an_error(void **state) {
  struct reading r;
  setenv("RECTO_IMPORT_MB", "1", 1);
  recto_status status = read_path(&r, model(state));
  /* With sanitizers there is no limit of memory. */
  assert_true(status != RECTO_OK || scene_face_count(&r.scene) == 2);
  reading_fini(&r);
}

static void mutated_models_are_survived(void **state) {
  const char *times = getenv("RECTO_MUTATIONS");
  int count = times ? atoi(times) : 40, read = 0;
  setenv("RECTO_IMPORT_SECONDS", "5", 1);
  for (int seed = 0; seed < count; seed++) {
    struct random random = {(uint64_t)seed};
    char text[sizeof DAE("count")] = DAE("count");
    bool is_off = seed % 4 == 3;
    size_t size = is_off ? sizeof off - 1 : sizeof text - 1;
    if (is_off)
      memcpy(text, off, size);
    for (int n = random_int(&random, 1, 4); n > 0; n--)
      text[random_below(&random, (uint32_t)size)] =
          (char)random_int(&random, 1, 126);
    struct reading r;
    const char *path =
        temporary_file(state, is_off ? "a.off" : "a.dae", text, size);
    if (read_path(&r, path) == RECTO_OK) {
      assert_null(reading_fault(&r.scene));
      read++;
    } else {
      assert_true(*r.error.text);
    }
    reading_fini(&r);
  }
  assert_alone();
  print_message("%d of %d were read\n", read, count);
}

/* ---- The form ------------------------------------------------------------ */

static size_t make_form(char *bytes) {
  static const double point[4][3] = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  static const float normal[4][3] = {
      {0, 0, 2}, {0, 0, 2}, {0, 0, 0}, {-1, 0, 0}};
  static const uint32_t size[3] = {3, 2, 4},
                        corner[9] = {0, 1, 2, 0, 3, 0, 1, 3, 2};
  struct import_record mesh = {.kind = IMPORT_MESH,
                               .colour = 0x102030,
                               .has_colour = 1,
                               .name_length = 4,
                               .points = 4,
                               .normals = 4,
                               .elements = 3,
                               .corners = 9},
                       done = {.kind = IMPORT_DONE};
  char *to = bytes;
#define PUT(from) (memcpy(to, from, sizeof(from)), to += sizeof(from))
  to = (char *)memcpy(to, IMPORT_MAGIC, 8) + 8;
  to = (char *)memcpy(to, &mesh, sizeof mesh) + sizeof mesh;
  to = (char *)memcpy(to, "part", 4) + 4;
  PUT(point);
  PUT(normal);
  PUT(size);
  PUT(corner);
#undef PUT
  to = (char *)memcpy(to, &done, sizeof done) + sizeof done;
  return (size_t)(to - bytes);
}

static void read_form(struct reading *r, const char *bytes, size_t count) {
  char *block = malloc(count ? count : 1);
  assert_non_null(block);
  memcpy(block, bytes, count);
  reading_init(r);
  r->scene.needs_crease_marks = true;
  r->status = import_format_read(&r->scene, block, count, "file", "off", 7,
                                 &r->diagnostics, &r->error);
  free(block);
}

static void the_form_becomes_a_scene(void **state) {
  char bytes[500];
  struct reading r;
  (void)state;
  read_form(&r, bytes, make_form(bytes));
  assert_int_equal(r.status, RECTO_OK);
  assert_int_equal(scene_face_count(&r.scene), 2);
  assert_int_equal(scene_wire_count(&r.scene), 1);
  assert_string_equal(r.scene.group.item[0].name, "part");
  assert_int_equal(r.scene.group.item[0].colour, 0x102030);
  assert_int_equal(r.scene.point_normal.count, 4);
  assert_int_equal(r.scene.point_normal.item[0], corner_normal_encode(0, 0, 1));
  assert_int_equal(r.scene.point_normal.item[2], 0);
  assert_int_equal(r.scene.point_normal.item[3],
                   corner_normal_encode(-1, 0, 0));
  reading_fini(&r);
}

static void a_form_with_too_few_normals_is_refused(void **state) {
  char bytes[500];
  size_t count = make_form(bytes);
  struct reading r;
  (void)state;
  for (uint64_t normals = 1; normals < 4; normals++) {
    memcpy(bytes + 8 + offsetof(struct import_record, normals), &normals,
           sizeof normals);
    read_form(&r, bytes, count);
    assert_int_equal(r.status, RECTO_ERROR_FORMAT);
    reading_fini(&r);
  }
}

static void a_form_cut_short_is_refused(void **state) {
  char bytes[500];
  size_t count = make_form(bytes);
  (void)state;
  for (size_t cut = 0; cut < count; cut++) {
    struct reading r;
    read_form(&r, bytes, cut);
    assert_int_equal(r.status, RECTO_ERROR_FORMAT);
    reading_fini(&r);
  }
}

static void a_form_of_any_bytes_is_survived(void **state) {
  int rounds = is_under_valgrind() ? 400 : 40000, taken = 0;
  (void)state;
  for (int seed = 0; seed < rounds; seed++) {
    struct random random = {(uint64_t)seed};
    char bytes[500];
    size_t count = make_form(bytes);
    for (int n = random_int(&random, 1, 4); n > 0; n--)
      bytes[random_below(&random, (uint32_t)count)] =
          (char)random_next(&random);
    struct reading r;
    read_form(&r, bytes, count);
    if (r.status == RECTO_OK)
      assert_null(reading_fault(&r.scene));
    taken += r.status == RECTO_OK;
    reading_fini(&r);
  }
  assert_in_range(taken, rounds / 50, rounds - rounds / 50);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      T(a_crash_is_an_error),
      T(an_importer_that_hangs_is_ended),
      T(what_makes_no_sense_is_refused),
      T(a_missing_importer_is_reported),
      T(cancelling_ends_the_importer),
      T(no_descriptor_is_left_open),
      T(without_descriptors_it_is_an_error),
      T(without_processes_it_is_an_error),
      T(a_host_may_ignore_its_children),
      T(standard_streams_may_be_closed),
      T(a_named_pipe_is_read_once),
      T(a_model_that_crashes_assimp_is_an_error),
      T(a_model_that_needs_too_much_memory_is_an_error),
      T(mutated_models_are_survived),
      T(the_form_becomes_a_scene),
      T(a_form_with_too_few_normals_is_refused),
      T(a_form_cut_short_is_refused),
      T(a_form_of_any_bytes_is_survived),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
