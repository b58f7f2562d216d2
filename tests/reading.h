/* reading.h - files given as text to a reader, and the result. */
#ifndef TESTS_READING_H
#define TESTS_READING_H

#include "scene/read.h"
#include "scene/scene.h"

enum { READING_WARNINGS = 16 };

struct reading {
  struct scene scene;
  struct diagnostics diagnostics;
  recto_status status;
  recto_error error;
  int warnings;
  char warning[READING_WARNINGS][300]; /* "LINE: text" of the first few */
};

/* Whether normals and smoothing groups are read by readings that begin; true
 * unless a test sets it. */
extern bool reading_takes_marks;

/* An empty scene with diagnostics that keep the warnings. */
void reading_init(struct reading *reading);
void reading_fini(struct reading *reading);

/* Passes `count` bytes to the reader, in a block that ends with a NUL after
 * them. */
recto_status reading_bytes(struct reading *reading, const struct reader *reader,
                           const char *bytes, size_t count);

/* The same with a text into a new reading. */
void reading_of(struct reading *reading, const struct reader *reader,
                const char *text);

/* Reads bytes, or a file, with up to so many threads into a new reading.
 * bytes  NULL: the file */
void reading_with_threads(struct reading *reading, const struct reader *reader,
                          const char *bytes, size_t count, const char *path,
                          int threads);

/* Why the scene does not keep its invariants; NULL where it does. */
const char *reading_fault(const struct scene *scene);

/* Whether two scenes have the same points, faces, polylines and groups, and
 * the same normals and smoothing groups. */
bool reading_same(const struct scene *a, const struct scene *b);

/* What differs when the bytes are read by several threads; NULL: nothing, or
 * the process has one processor. */
const char *reading_parallel_fault(const struct reader *reader,
                                   const char *bytes, size_t count);
/* The same of a file. */
const char *reading_parallel_file_fault(const struct reader *reader,
                                        const char *path);

#endif
