/* path.h - names of files, and which file they name. */
#ifndef BASE_PATH_H
#define BASE_PATH_H

#include <stdbool.h>
#include <stdint.h>

/* The identity of a file, whatever its names. */
struct file_identity {
  uint64_t device, number;
};

/* The identity of what is open as a descriptor, or stands at a path ("-" is
 * standard input), where that is a regular file; false: it is none, and devices
 * and pipes, which may well be both read and written, count as different. */
bool path_identity_of_descriptor(int descriptor, struct file_identity *it);
bool path_identity(const char *path, struct file_identity *it);

static inline bool file_identity_is_same(struct file_identity a,
                                         struct file_identity b) {
  return a.device == b.device && a.number == b.number;
}

/* Whether two paths name one regular file that is there, by whatever names and
 * links; "-" does not count. */
bool path_is_same(const char *a, const char *b);

/* The descriptor that a path names in words: /dev/stdout, /dev/fd/3 and the
 * like; -1: it is no such path.  "-", which readers and writers take for
 * different ones, is none. */
int path_descriptor(const char *path);

/* Whether what is written to a path goes to standard output: "-" or
 * /dev/stdout or the like. */
bool path_is_standard_output(const char *path);

/* The descriptor, or one above the standard ones in its place, which the
 * caller is to close; -1 as it is.  A file that took the place of a closed
 * standard descriptor would get what is meant for that. */
int path_above_standard(int descriptor);

#endif
