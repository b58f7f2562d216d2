/* target.h - output files that are complete before they have their name. */
#ifndef BASE_TARGET_H
#define BASE_TARGET_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>

#include "base/path.h"
#include "base/status.h"

enum target_kind {
  TARGET_NEW,       /* written to a temporary file, which is then renamed */
  TARGET_IN_PLACE,  /* a file whose bytes are replaced, in one go */
  TARGET_DESCRIPTOR /* a pipe, a device, or what was open already */
};

struct target {
  enum target_kind kind;
  int descriptor;  /* what is written to */
  char *name;      /* as the user wrote it, for messages */
  char *path;      /* with links followed; NULL for what was open already */
  char *temporary; /* TARGET_NEW: its name until it is committed; NULL: it
                      has none */
  bool existed;    /* a regular file is there, and this is what it is */
  struct stat old;
  struct stat folder; /* TARGET_NEW: where it is to appear */
  bool committed;     /* TARGET_NEW: has its name */
  bool exchanged;     /* and the file that it replaced has the temporary one */
};

/* Opens a path for writing; "-" is standard output.  A descriptor of its own
 * is above the standard ones.
 *   A file that is there and has one name is replaced by a new one, which gets
 * its owner, mode, access list and attributes.  Where it has several names, or
 * where what belongs to it cannot be given to another file, or where its folder
 * may not be written to or has too long a path for a temporary name, it is the
 * file itself that is written to.
 * Errors  RECTO_ERROR_IO, RECTO_ERROR_MEMORY */
USE_RESULT recto_status target_open(struct target *target, const char *path,
                                    recto_error *error);

/* Whether target_open is likely to succeed, without a trace; what waits at a
 * pipe is not disturbed. */
USE_RESULT recto_status target_try(const char *path, recto_error *error);

/* Whether two targets are one file, there already or not, or one pipe. */
bool target_is_same(const struct target *a, const struct target *b);

/* Whether two paths, opened as targets, would be the same.  What waits at a
 * pipe is not disturbed: a pipe's or a device's path is no other's. */
bool target_paths_are_same(const char *a, const char *b);

/* Whether it is this file that is replaced or written to. */
bool target_is(const struct target *target, struct file_identity it);

/* Gives a TARGET_NEW, which has been written to its end, its name.  No signal
 * should end the process from here until the target is closed.
 * keep_old  keeps a file that it replaces until then, where the system can
 * Returns false, with errno set, where that cannot be done. */
USE_RESULT bool target_commit(struct target *target, bool keep_old);

/* Restores a file that was kept, and removes the new file where there was none
 * before. */
void target_roll_back(struct target *target);

/* Makes sure, as far as the system can say, that there is room for so many
 * bytes in a TARGET_IN_PLACE, before one of any output is changed.
 * Returns false, with errno set, where there is not. */
USE_RESULT bool target_reserve(struct target *target, size_t count);

/* Replaces the bytes of a TARGET_IN_PLACE, for which there is room. */
USE_RESULT bool target_replace(struct target *target, const char *bytes,
                               size_t count);

/* Closes the target, and removes what has not been committed.
 * Returns false, with errno set, where closing finds that a write failed. */
bool target_close(struct target *target);

#endif
