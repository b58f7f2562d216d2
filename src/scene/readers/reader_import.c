/* reader_import.c - every other format, through Assimp in a process of its own.
 *
 * Assimp reads some fifty formats, and broken files make it crash, loop or take
 * all memory; a library may not end its host.  So a helper program, the
 * importer (src/import), reads the file under limits of time and memory and
 * hands over what import_format.h describes.
 *
 * Robustness  A file that keeps its extension is opened by the importer itself,
 * since formats such as glTF have their data in other files beside it; any
 * other is handed over as bytes. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* secure_getenv */
#endif
#include "scene/scene.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/child.h"
#include "base/input.h"
#include "scene/read.h"
#include "scene/readers/import_format.h"

/* Where it is installed; configure's prefix says so. */
#ifndef RECTO_IMPORT_PATH
#define RECTO_IMPORT_PATH "/usr/local/libexec/recto/recto-import"
#endif

enum { PATH_SIZE = 4096, USUAL_SECONDS = 120 };

struct import_child {
  char program[PATH_SIZE];
  long seconds, mb;
  const char *path, *format;
  recto_error *error;
};

/* ---- The importer -------------------------------------------------------- */

/* Looks for the importer at that place from the folder of the program that
 * runs; false where there is none. */
static bool find_from_program(char path[PATH_SIZE], const char *place) {
  size_t size = strlen(place) + 1;
  ssize_t length = readlink("/proc/self/exe", path, PATH_SIZE - size);
  while (length > 0 && path[length - 1] != '/')
    length--;
  if (length <= 0)
    return false;
  memcpy(path + length, place, size);
  return access(path, X_OK) == 0;
}

/* RECTO_IMPORT, beside the program as where it was built, in libexec beside its
 * folder as where what was installed has been moved, or where configure's
 * prefix says. */
static void find_importer(char path[PATH_SIZE]) {
  const char *own = secure_getenv("RECTO_IMPORT");
  if (own != NULL && *own)
    snprintf(path, PATH_SIZE, "%s", own);
  else if (!find_from_program(path, "recto-import") &&
           !find_from_program(path, "../libexec/recto/recto-import"))
    snprintf(path, PATH_SIZE, "%s", RECTO_IMPORT_PATH);
}

/* A whole number above 0 from the environment, else the usual one. */
static long environment_limit(const char *name, long usual) {
  const char *text = secure_getenv(name);
  long value = text != NULL ? strtol(text, NULL, 10) : 0;
  return value > 0 && value < 1000000000 ? value : usual;
}

/* ---- What came of it ----------------------------------------------------- */

static recto_status fail_to_start(const struct import_child *import, int code) {
  if (code == ENOMEM)
    return error_memory(import->error);
  if (code == EAGAIN || code == EMFILE || code == ENFILE || code == EINVAL)
    return error_set(import->error, RECTO_ERROR_IO, import->path, 0,
                     "cannot start the importer: %s",
                     /* What is said of a number beyond the limit. */
                     strerror(code == EINVAL ? EMFILE : code));
  return error_set(import->error, RECTO_ERROR_UNSUPPORTED, import->path, 0,
                   "no reader for the format '%s': cannot start the importer "
                   "%s: %s (without it: " READ_OWN_FORMATS " alone)",
                   import->format, import->program, strerror(code));
}

/* Tells of an importer that did not come to its end. */
static recto_status check_child_end(const struct import_child *import,
                                    const struct child_result *result) {
  recto_error *error = import->error;
  switch (result->end) {
  case CHILD_NOT_STARTED:
    return fail_to_start(import, result->code);
  case CHILD_NO_MEMORY:
    return error_memory(error);
  case CHILD_CANCELLED:
    return error_cancelled(error);
  case CHILD_TOO_LONG:
    return error_set(error, RECTO_ERROR_LIMIT, import->path, 0,
                     "the importer took longer than %ld s", import->seconds);
  case CHILD_TOO_MUCH:
    return error_set(error, RECTO_ERROR_LIMIT, import->path, 0,
                     "the model takes more than %zu MB",
                     input_size_max() >> 20);
  case CHILD_SIGNALLED:
    if (result->code == SIGXCPU)
      return error_set(error, RECTO_ERROR_LIMIT, import->path, 0,
                       "the importer took longer than %ld s", import->seconds);
    return error_set(error, RECTO_ERROR_FORMAT, import->path, 0,
                     "the importer crashed (signal %d)", result->code);
  case CHILD_EXITED:
    break;
  }
  return error_set(error, RECTO_ERROR_FORMAT, import->path, 0,
                   "the importer failed (status %d)", result->code);
}

/* ---- Reading ------------------------------------------------------------- */

/* Whether the path still leads to these bytes, under the format's own
 * extension. */
static bool is_by_path(const char *path, const char *format, size_t count) {
  const char *point = strrchr(path, '.');
  struct stat attributes;
  return point != NULL && strcasecmp(point + 1, format) == 0 &&
         stat(path, &attributes) == 0 && S_ISREG(attributes.st_mode) &&
         (uintmax_t)attributes.st_size == count;
}

static recto_status run_importer(const struct import_child *import,
                                 const char *bytes, size_t count,
                                 struct child_result *result) {
  char seconds[24], mb[24];
  bool by_path = is_by_path(import->path, import->format, count);
  snprintf(seconds, sizeof seconds, "%ld", import->seconds);
  snprintf(mb, sizeof mb, "%ld", import->mb);
  const char *argument[] = {import->program,
                            seconds,
                            mb,
                            import->format,
                            by_path ? import->path : NULL,
                            NULL};
  struct child child = {.argument = argument,
                        .input = -1,
                        .seconds = (int)import->seconds,
                        .output_max = input_size_max()};
  if (!by_path && (child.input = child_input_of(bytes, count)) < 0)
    return error_set(import->error, RECTO_ERROR_IO, import->path, 0,
                     "cannot hand it to the importer: %s", strerror(errno));
  child_run(&child, result);
  if (child.input >= 0)
    close(child.input);
  return RECTO_OK;
}

static recto_status read_import(struct scene *scene, const char *bytes,
                                size_t count, const char *path,
                                const char *format,
                                struct diagnostics *diagnostics,
                                recto_error *error) {
  struct import_child import = {
      .seconds = environment_limit("RECTO_IMPORT_SECONDS", USUAL_SECONDS),
      .mb =
          environment_limit("RECTO_IMPORT_MB", (long)(input_size_max() >> 20)),
      .path = path,
      .format = format,
      .error = error};
  find_importer(import.program);
  struct child_result result = {.end = CHILD_EXITED};
  size_t first = scene->point.count;
  recto_status status = run_importer(&import, bytes, count, &result);
  if (status == RECTO_OK) {
    bool ended = result.end == CHILD_EXITED || result.end == CHILD_SIGNALLED;
    if (ended &&
        import_format_is_whole(result.output.item, result.output.count))
      status =
          import_format_read(scene, result.output.item, result.output.count,
                             path, format, import.mb, diagnostics, error);
    else
      status = check_child_end(&import, &result);
  }
  ARRAY_FREE(&result.output);
  if (status == RECTO_OK && scene->point.count > first)
    status = scene_state_precision(
        scene, first, (struct precision){0, PRECISION_SINGLE}, error);
  return status;
}

/* What its specification says: +z is up. */
const struct reader reader_3mf = {"3mf", "3mf", {0, 0, 1}, true, read_import};
const struct reader reader_import = {
    "assimp", "", {0, 1, 0}, false, read_import};
