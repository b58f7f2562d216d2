/* temporary.h - a folder for a test's files, removed at the test's end. */
#ifndef TESTS_TEMPORARY_H
#define TESTS_TEMPORARY_H

#include <stddef.h>

/* cmocka set up and tear down: *state is the folder's path. */
int temporary_set_up(void **state);
int temporary_tear_down(void **state);

/* The path of a name in the folder; kept until the next few calls. */
const char *temporary_path(void *const *state, const char *name);

/* Writes a file of those bytes and returns its path. */
const char *temporary_file(void *const *state, const char *name,
                           const void *bytes, size_t count);

/* The file's bytes, NUL-terminated, in memory that the caller frees; NULL if it
 * cannot be read. */
char *temporary_read(const char *path, size_t *count);

/* How many files there are in the folder. */
size_t temporary_count(void *const *state);

#endif
