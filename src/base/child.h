/* child.h - runs a helper program in a process of its own and gathers what it
 * writes. */
#ifndef BASE_CHILD_H
#define BASE_CHILD_H

#include "base/memory.h"

/* Where the program writes its output. */
#define CHILD_OUTPUT 3

struct child {
  const char *const *argument; /* the program's path first, NULL last */
  int input;                   /* its standard input; -1: none */
  int seconds;                 /* it may take so long */
  size_t output_max;           /* it may write so many bytes */
};

enum child_end {
  CHILD_EXITED,    /* with `code` as its status; -1 where that is not known */
  CHILD_SIGNALLED, /* by signal `code` */
  CHILD_TOO_LONG,
  CHILD_TOO_MUCH,
  CHILD_CANCELLED,
  CHILD_NOT_STARTED, /* `code` is an errno */
  CHILD_NO_MEMORY
};

struct child_result {
  enum child_end end;
  int code;
  ARRAY(char) output;
};

/* Runs it to its end, whatever that is; frees nothing of the result, whose
 * output is ARRAY_FREE's in any case.  Standard output and error of the
 * program go nowhere.
 * Guarantees  no process and no descriptor is left behind; the signals and
 *             the children of the host are not touched
 * Threads     any number, as posix_spawn does */
void child_run(const struct child *child, struct child_result *result);

/* An unnamed file of these bytes, at its start, for a child's input; -1 and
 * errno where that fails. */
int child_input_of(const char *bytes, size_t count);

#endif
