/* child.c - runs a helper program in a process of its own.
 *
 * It is spawned rather than forked: between fork and exec a process with
 * several threads may call next to nothing, and a host may have any number.
 *
 * Robustness  The host may ignore SIGCHLD or wait for any child: then there is
 * no status to be had, and what the program wrote must show whether it came to
 * its end.  Descriptors 0 to 3 may be closed in the host: ours are moved out of
 * their way. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* pipe2, memfd_create */
#endif
#include "base/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/poll.h"

extern char **environ;

enum {
  LOWEST_DESCRIPTOR = 10, /* descriptors from here on conflict with no other */
  TICK_MS = 100
};

struct child_run {
  const struct child *child;
  struct child_result *result;
  pid_t process;
  int output; /* the end that is read */
  double deadline;
};

/* Moves a descriptor of ours out of the way of those that a child has. */
static int move_descriptor(int descriptor) {
  if (descriptor < 0 || descriptor >= LOWEST_DESCRIPTOR)
    return descriptor;
  int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, LOWEST_DESCRIPTOR);
  int error = errno;
  close(descriptor);
  errno = error;
  return moved;
}

int child_input_of(const char *bytes, size_t count) {
#ifdef MFD_CLOEXEC
  int descriptor = move_descriptor(memfd_create("recto", MFD_CLOEXEC));
#else
  FILE *file = tmpfile();
  int descriptor = -1;
  if (file != NULL) {
    descriptor = fcntl(fileno(file), F_DUPFD_CLOEXEC, (int)LOWEST_DESCRIPTOR);
    fclose(file);
  }
#endif
  for (size_t done = 0; descriptor >= 0 && done < count;) {
    ssize_t written =
        pwrite(descriptor, bytes + done, count - done, (off_t)done);
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0) {
      int error = errno;
      close(descriptor);
      errno = error;
      return -1;
    }
    done += (size_t)written;
  }
  return descriptor;
}

/* ---- Starting ------------------------------------------------------------ */

/* Signals that a host may ignore or block have their usual effect again, but
 * for those that a user may have requested to be ignored. */
static int set_signals(posix_spawnattr_t *attributes) {
  static const int usual[] = {SIGPIPE, SIGCHLD, SIGSEGV, SIGBUS,
                              SIGILL,  SIGFPE,  SIGABRT, SIGXCPU,
                              SIGXFSZ, SIGALRM, SIGTERM};
  sigset_t set;
  sigemptyset(&set);
  int error = posix_spawnattr_setsigmask(attributes, &set);
  for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
    sigaddset(&set, usual[i]);
  if (error == 0)
    error = posix_spawnattr_setsigdefault(attributes, &set);
  if (error == 0)
    error = posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGMASK |
                                                     POSIX_SPAWN_SETSIGDEF);
  return error;
}

static int set_descriptors(posix_spawn_file_actions_t *actions, int input,
                           int output) {
  int error = 0;
  for (int i = 0; i < 3 && error == 0; i++)
    error = i == 0 && input >= 0
                ? posix_spawn_file_actions_adddup2(actions, input, 0)
                : posix_spawn_file_actions_addopen(actions, i, "/dev/null",
                                                   i ? O_WRONLY : O_RDONLY, 0);
  if (error == 0)
    error = posix_spawn_file_actions_adddup2(actions, output, CHILD_OUTPUT);
  return error;
}

/* Returns an errno, 0 where it is started. */
static int spawn(struct child_run *run, int output) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  int error = posix_spawn_file_actions_init(&actions);
  if (error != 0)
    return error;
  error = posix_spawnattr_init(&attributes);
  if (error == 0) {
    error = set_descriptors(&actions, run->child->input, output);
    if (error == 0)
      error = set_signals(&attributes);
    /* The strings are not written to: the interface is older than const. */
    if (error == 0)
      error = posix_spawn(
          &run->process, run->child->argument[0], &actions, &attributes,
          (char *const *)(uintptr_t)run->child->argument, environ);
    posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

static int start_child(struct child_run *run) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return errno;
  run->output = move_descriptor(ends[0]);
  int error = run->output < 0 ? errno : 0;
  int output = move_descriptor(ends[1]);
  if (error == 0 && output < 0)
    error = errno;
  if (error == 0)
    error = spawn(run, output);
  if (output >= 0)
    close(output);
  if (error != 0 && run->output >= 0)
    close(run->output);
  return error;
}

/* ---- Listening ----------------------------------------------------------- */

/* Whether the child may continue; else the result has the reason. */
static bool may_continue(struct child_run *run) {
  if (!poll_share(0, "import"))
    run->result->end = CHILD_CANCELLED;
  else if (clock_wall() > run->deadline)
    run->result->end = CHILD_TOO_LONG;
  else
    return true;
  return false;
}

/* Takes what the child has written; false at its end, or where it may not go
 * on. */
static bool read_output(struct child_run *run) {
  enum { CHUNK = 1 << 16 };
  struct child_result *result = run->result;
  struct pollfd wait = {.fd = run->output, .events = POLLIN};
  int ready = poll(&wait, 1, TICK_MS);
  if (!may_continue(run))
    return false;
  if (ready <= 0)
    return ready == 0 || errno == EINTR;
  if (!ARRAY_RESERVE(&result->output, CHUNK)) {
    result->end = CHILD_NO_MEMORY;
    return false;
  }
  ssize_t got = read(run->output, result->output.item + result->output.count,
                     result->output.capacity - result->output.count);
  if (got <= 0)
    return got < 0 && errno == EINTR;
  result->output.count += (size_t)got;
  if (result->output.count <= run->child->output_max)
    return true;
  result->end = CHILD_TOO_MUCH;
  return false;
}

/* Ends the child, if it is still there and ours: where the host ignores SIGCHLD
 * or waits for any child, its number may be another process's by now. */
static void end_child(struct child_run *run) {
  int status;
  pid_t found;
  while ((found = waitpid(run->process, &status, WNOHANG)) < 0 &&
         errno == EINTR)
    continue;
  if (found != 0)
    return;
  kill(run->process, SIGKILL);
  while (waitpid(run->process, &status, 0) < 0 && errno == EINTR)
    continue;
}

/* Waits for the end of a child that writes no more: it may still hang. */
static void await(struct child_run *run) {
  static const struct timespec moment = {0, 1000000};
  struct child_result *result = run->result;
  int status;
  pid_t found;
  while ((found = waitpid(run->process, &status, WNOHANG)) == 0 ||
         (found < 0 && errno == EINTR)) {
    if (!may_continue(run)) {
      end_child(run);
      return;
    }
    nanosleep(&moment, NULL);
  }
  result->code = -1;
  if (found > 0 && WIFSIGNALED(status)) {
    result->end = CHILD_SIGNALLED;
    result->code = WTERMSIG(status);
  } else if (found > 0) {
    result->code = WEXITSTATUS(status);
  }
}

void child_run(const struct child *child, struct child_result *result) {
  struct child_run run = {.child = child,
                          .result = result,
                          .deadline = clock_wall() + child->seconds};
  *result = (struct child_result){.end = CHILD_EXITED};
  result->code = start_child(&run);
  if (result->code != 0) {
    result->end = CHILD_NOT_STARTED;
    return;
  }
  while (read_output(&run))
    continue;
  close(run.output);
  if (result->end == CHILD_EXITED)
    await(&run);
  else
    end_child(&run);
}
